// The identity of a question and of a file: SHA-256 (OpenSSL).
#include "golden/query_id.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <stdexcept>

#include "golden/answer_bytes.hpp"

namespace contact::golden {
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

std::array<std::uint8_t, 32> Sha256::digest() const {
  std::array<std::uint8_t, 32> bytes{};
  const std::unique_ptr<void, Free> copy(EVP_MD_CTX_new());  // finishing ends a context, and a const call must not
  require(EVP_MD_CTX_copy_ex(as_context(copy.get()), as_context(context_.get())));
  require(EVP_DigestFinal_ex(as_context(copy.get()), bytes.data(), nullptr));
  return bytes;
}

std::string Sha256::hex() const {
  const auto bytes = digest();
  return fmt::format("{:02x}", fmt::join(bytes, ""));
}

std::string query_id(const Query& query) {
  std::string bytes(name(query.pair));
  bytes.push_back('\0');
  for_each_number(query, [&](const std::string&, double x) { add_big_endian(bytes, x); });
  return Sha256().add(bytes).hex().substr(0, 24);
}

}  // namespace contact::golden
