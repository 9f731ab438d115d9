// The digest of answers: SHA-256 over bytes that any language can make, so that a billion answers need no file.
#include "golden/digest.hpp"

namespace contact::golden {

std::string digest_bytes(const Case& c) { return c.rejected ? *c.rejected + '\0' : digest_bytes(c.expect); }

}  // namespace contact::golden
