// SHA-256 (OpenSSL): the digest of a text or of a file.
#include "formats/sha256.hpp"

#include <fmt/ranges.h>
// The functions below EVP are slower to go away than to call: EVP takes three times as long for an id, and before its
// first digest it reads OpenSSL's configuration and registers all of its algorithms: a tenth of a short command's time.
#define OPENSSL_SUPPRESS_DEPRECATED
#include <openssl/sha.h>

#include <stdexcept>

namespace contact::formats {
namespace {

void require(int ok) {
  if (ok != 1) throw std::runtime_error("OpenSSL's SHA-256 failed");
}

SHA256_CTX* as_context(void* p) { return static_cast<SHA256_CTX*>(p); }

}  // namespace

void Sha256::Free::operator()(void* context) const { delete as_context(context); }

Sha256::Sha256() : context_(new SHA256_CTX) { require(SHA256_Init(as_context(context_.get()))); }

Sha256& Sha256::add(std::string_view bytes) {
  require(SHA256_Update(as_context(context_.get()), bytes.data(), bytes.size()));
  return *this;
}

Sha256::Digest Sha256::digest() const {
  Digest bytes{};
  SHA256_CTX copy = *as_context(context_.get());  // finishing ends a context, and a const call must not
  require(SHA256_Final(bytes.data(), &copy));
  return bytes;
}

std::string Sha256::hex() const { return fmt::format("{:02x}", fmt::join(digest(), "")); }

Sha256::Digest Sha256::digest_of(std::string_view bytes) {
  Digest result{};
  SHA256_CTX hash;
  require(SHA256_Init(&hash));
  require(SHA256_Update(&hash, bytes.data(), bytes.size()));
  require(SHA256_Final(result.data(), &hash));
  return result;
}

}  // namespace contact::formats
