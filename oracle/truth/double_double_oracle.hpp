// The double-double stage: pairs of doubles with a radius of error. It proves an answer, or has none.
#pragma once

#include <optional>

#include "oracle/truth/query.hpp"
#include "oracle/truth/rounded_answer.hpp"

namespace contact::oracle {

/// The answer of the exact oracle where sums and products of two doubles with a proved bound of their error settle
/// every decision and every rounding; nothing otherwise, and nothing for numbers that are neither 0 nor of magnitude
/// 2^-200 .. 2^200.
///
/// Domain      every number of the question finite and inside the domain
/// Error       none: the interval around the real number lies on one side of the boundary, or rounds to one number
/// Source      docs/oracle-stages.md#the-double-double-stage
/// Evidence    oracle/truth/double_double_oracle_test.cpp
[[nodiscard]] std::optional<RoundedAnswer> double_double_answer(const Query& query, Scalar scalar);

// The same of each pair, in files of its own.
#define CONTACT_DECLARE(A, B)                                                                                   \
  [[nodiscard]] std::optional<RoundedAnswer> double_double_answer(const Two<A, B>& shapes, Distances distances, \
                                                                  Scalar scalar);
CONTACT_KINDS(CONTACT_DECLARE)
#undef CONTACT_DECLARE

}  // namespace contact::oracle
