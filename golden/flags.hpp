// The flags of a case: facts about a question, derived from the exact answer, that say why it is worth asking.
#pragma once

#include <string>
#include <vector>

#include "golden/names.hpp"
#include "oracle/truth/query.hpp"
#include "oracle/truth/truth.hpp"

namespace contact::golden {

/// The names of the flags that hold. `right` is oracle::expectation(truth, scalar), `margin_ulps` that of oracle::witness(truth, scalar).
/// Domain: the question is inside the domain.
[[nodiscard]] std::vector<std::string> flags_of(const Query& query, const oracle::Truth& truth, Scalar scalar,
                                                const Expectation& right, double margin_ulps);

}  // namespace contact::golden
