// The digest of answers: SHA-256 over bytes that any language can make, so that a billion answers need no file.
#pragma once

#include <string>

#include "golden/answer_bytes.hpp"
#include "golden/dataset.hpp"

namespace contact::golden {

/// The bytes of a case's answer.
[[nodiscard]] std::string digest_bytes(const Case& c);

}  // namespace contact::golden
