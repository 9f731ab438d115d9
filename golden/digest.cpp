// The digest of answers: SHA-256 over bytes that any language can make, so that a billion answers need no file.
#include "golden/digest.hpp"

#include "golden/query_id.hpp"

namespace contact::golden {

std::string digest_bytes(const Expectation& expect) {
  std::string bytes(1, expect.hit ? '\1' : '\0');
  if (!expect.contact) return bytes;
  const Contact& k = *expect.contact;
  bytes.push_back(k.degenerate ? '\1' : '\0');
  for (const Vector3& v : {k.normal, k.point1, k.point2})
    for (const double x : v) add_big_endian(bytes, x);
  add_big_endian(bytes, k.value);
  return bytes;
}

std::string digest_bytes(const DomainError& error) { return error.field + '\0'; }

std::string digest_bytes(const Case& c) { return c.rejected ? *c.rejected + '\0' : digest_bytes(c.expect); }

}  // namespace contact::golden
