// Production's answers to generated questions, as the bytes of a digest.
#pragma once

#include <string>

#include "golden/families.hpp"

namespace contact::golden {

/// Whether production's answers to a file's generator are the right ones: it rounds to binary64, and what is no number
/// has no scalar.
[[nodiscard]] bool production_answers(const CommittedFile& stream);

/// golden/answer_bytes.hpp
[[nodiscard]] std::string production_bytes(const Query& query);

}  // namespace contact::golden
