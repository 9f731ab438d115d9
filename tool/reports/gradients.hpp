// The derivatives of a contact's numbers, as a table for people and as JSON.
#pragma once

#include <string>

#include "oracle/truth/truth.hpp"

namespace contact::tool {

/// What `explain --gradient` adds to the words of a question.
/// Domain: every number of the question finite and inside the domain; `truth` is its own.
[[nodiscard]] std::string gradient_text(const Query& query, const oracle::Truth& truth);
/// The object "gradient" in "exact".
[[nodiscard]] std::string gradient_json(const Query& query, const oracle::Truth& truth);

}  // namespace contact::tool
