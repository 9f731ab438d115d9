// Numbers and answers as bytes that any language can make: what ids and digests are taken over.
#pragma once

#include <cstdint>
#include <string>

#include "contact/domain.hpp"
#include "oracle/truth/expectation.hpp"

namespace contact::golden {

/// The bits of a number: those of +0 for -0, and 0x7ff8000000000000 for NaN.
[[nodiscard]] std::uint64_t canonical_bits(double x);

/// Appends a number as big-endian binary64, its canonical bits.
void add_big_endian(std::string& bytes, double x);

/// The bytes of one answer, docs/formats.md#digests:
///   one byte hit, 0 or 1; of a contact with numbers one byte, 1 for degenerate and 2 for not unique, then normal,
///   point1, point2 and value as big-endian binary64, +0 for -0
[[nodiscard]] std::string digest_bytes(const Expectation& expect);
/// Outside the domain: the first field there in ASCII and one zero byte.
[[nodiscard]] std::string digest_bytes(const DomainError& error);

}  // namespace contact::golden
