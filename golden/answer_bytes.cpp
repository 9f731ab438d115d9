// Numbers and answers as bytes that any language can make: what ids and digests are taken over.
#include "golden/answer_bytes.hpp"

#include <bit>
#include <cmath>

namespace contact::golden {

std::uint64_t canonical_bits(double x) {
  if (std::isnan(x)) return 0x7ff8000000000000;
  return std::bit_cast<std::uint64_t>(x == 0 ? 0.0 : x);
}

void add_big_endian(std::string& bytes, double x) {
  const std::uint64_t bits = canonical_bits(x);
  for (int shift = 56; shift >= 0; shift -= 8) bytes.push_back(static_cast<char>((bits >> shift) & 0xff));
}

std::string digest_bytes(const Expectation& expect) {
  std::string bytes(1, expect.hit ? '\1' : '\0');
  if (!expect.contact) return bytes;
  const Contact& k = *expect.contact;
  bytes.push_back(static_cast<char>((k.degenerate ? 1 : 0) + (k.unique ? 0 : 2)));
  for (const Vector3& v : {k.normal, k.point1, k.point2})
    for (const double x : v) add_big_endian(bytes, x);
  add_big_endian(bytes, k.value);
  return bytes;
}

std::string digest_bytes(const DomainError& error) { return error.field + '\0'; }

}  // namespace contact::golden
