// The digest of answers: SHA-256 over bytes that any language can make, so that a billion answers need no file.
#include "golden/digest.hpp"

#include "oracle/truth.hpp"

namespace contact::golden {

std::string digest_bytes(const Case& c) { return c.rejected ? *c.rejected + '\0' : digest_bytes(c.expect); }

std::string digest_bytes(const Query& query, Scalar scalar) {
  if (const auto error = outside_domain(query)) return digest_bytes(*error);
  return digest_bytes(oracle::expectation(oracle::truth_of(query), scalar));
}

}  // namespace contact::golden
