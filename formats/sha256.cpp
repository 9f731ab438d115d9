// SHA-256 (OpenSSL): the digest of a text or of a file.
#include "formats/sha256.hpp"

#include <fmt/ranges.h>
// The functions below EVP are slower to go away than to call: EVP takes three times as long for an id.
#define OPENSSL_SUPPRESS_DEPRECATED
#include <openssl/evp.h>
#include <openssl/sha.h>

#include <stdexcept>

namespace contact::formats {
namespace {

void require(int ok) {
  if (ok != 1) throw std::runtime_error("OpenSSL's SHA-256 failed");
}

EVP_MD_CTX* as_context(void* p) { return static_cast<EVP_MD_CTX*>(p); }

}  // namespace

void Sha256::Free::operator()(void* context) const { EVP_MD_CTX_free(as_context(context)); }

Sha256::Sha256() : context_(EVP_MD_CTX_new()) {
  require(EVP_DigestInit_ex(as_context(context_.get()), EVP_sha256(), nullptr));
}

Sha256& Sha256::add(std::string_view bytes) {
  require(EVP_DigestUpdate(as_context(context_.get()), bytes.data(), bytes.size()));
  return *this;
}

Sha256::Digest Sha256::digest() const {
  Digest bytes{};
  const std::unique_ptr<void, Free> copy(EVP_MD_CTX_new());  // finishing ends a context, and a const call must not
  require(EVP_MD_CTX_copy_ex(as_context(copy.get()), as_context(context_.get())));
  require(EVP_DigestFinal_ex(as_context(copy.get()), bytes.data(), nullptr));
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
