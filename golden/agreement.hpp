// Do the oracles agree on a question?
#pragma once

#include <stdexcept>
#include <string_view>

#include "oracle/truth/staged_oracle.hpp"

namespace contact::golden {

/// The oracles disagree with each other: nothing that a run says can be believed.
struct OracleFault : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws OracleFault where another oracle differs from the exact one on a question.
void require_agreement(const Query& query, const oracle::RoundedAnswer& exact, const oracle::RoundedAnswer& second,
                       Scalar scalar, std::string_view second_name = "interval");

/// Asks the exact and the interval oracle what a stage has answered: throws OracleFault where they say otherwise. `truth` is the exact one's.
void check_stage(const Query& query, const oracle::Truth& truth, const oracle::StagedAnswer& staged, Scalar scalar);

}  // namespace contact::golden
