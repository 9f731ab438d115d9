// The exact answer to a question, in words and numbers, beside what plain double arithmetic would have said.
#pragma once

#include <optional>
#include <string>

#include "oracle/truth/truth.hpp"

namespace contact::tool {

/// What `explain` prints of a question.
/// Domain: every number of the question finite and inside the domain; `truth` is its own.
[[nodiscard]] std::string explanation(const Query& query, const oracle::Truth& truth, Scalar scalar);
/// The signed distance between the two shapes, rounded to the scalar: of a miss too, which has no contact. Nothing of a
/// pair without one.
[[nodiscard]] std::optional<double> distance(const oracle::Truth& truth, Scalar scalar);

}  // namespace contact::tool
