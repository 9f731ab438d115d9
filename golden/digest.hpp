// The digest of answers: SHA-256 over bytes that any language can make, so that a billion answers need no file.
#pragma once

#include <string>

#include "golden/dataset.hpp"

namespace contact::golden {

/// The bytes of one answer, docs/formats.md#digests:
///   one byte hit, 0 or 1; of two spheres that hit one byte degenerate, then normal, point1, point2 and value as
///   big-endian binary64, +0 for -0
[[nodiscard]] std::string digest_bytes(const Expectation& expect);
/// Outside the domain: the first field there in ASCII and one zero byte.
[[nodiscard]] std::string digest_bytes(const DomainError& error);
[[nodiscard]] std::string digest_bytes(const Case& c);

}  // namespace contact::golden
