// The exact answer to a question, in words and numbers, beside what plain double arithmetic would have said.
#pragma once

#include <string>

#include "oracle/truth/truth.hpp"

namespace contact::tool {

/// What `explain` prints of a question.
/// Domain: every number of the question finite and inside the domain; `truth` is its own.
[[nodiscard]] std::string explanation(const Query& query, const oracle::Truth& truth, Scalar scalar);

}  // namespace contact::tool
