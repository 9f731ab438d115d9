// The identity of a question and of a file: SHA-256 (OpenSSL).
#include "golden/query_id.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <algorithm>
#include <charconv>
#include <concepts>
#include <span>
#include <stdexcept>

#include "golden/answer_bytes.hpp"

namespace contact::golden {
namespace {

void require(int ok) {
  if (ok != 1) throw std::runtime_error("OpenSSL's SHA-256 failed");
}

EVP_MD_CTX* as_context(void* p) { return static_cast<EVP_MD_CTX*>(p); }

/// The longest name, one zero byte and the numbers of two boxes and two distances.
constexpr std::size_t kLongestCanonical = name(Pair::rigid_sphere_rigid_sphere).size() + 1 + 14 * 8;

/// A context that is used again and again: making one costs more than a short digest.
class Context {
 public:
  Context() : context_(EVP_MD_CTX_new()) { require(EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr)); }

  [[nodiscard]] std::array<unsigned char, 32> digest(std::span<const unsigned char> bytes) const {
    std::array<unsigned char, 32> result{};
    require(EVP_DigestInit_ex(context_.get(), nullptr, nullptr));  // the digest that it has
    require(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()));
    require(EVP_DigestFinal_ex(context_.get(), result.data(), nullptr));
    return result;
  }

 private:
  struct Free {
    void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
  };
  std::unique_ptr<EVP_MD_CTX, Free> context_;
};

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
  // One context a thread and no text on the way: every question of a run has its id computed and compared.
  static thread_local const Context context;
  std::array<unsigned char, kLongestCanonical> bytes{};
  auto at = std::copy(name(query.pair).begin(), name(query.pair).end(), bytes.begin()) + 1;
  const auto put = [&](double x) {
    const std::uint64_t bits = canonical_bits(x);
    for (int shift = 56; shift >= 0; shift -= 8) *at++ = static_cast<unsigned char>((bits >> shift) & 0xff);
  };
  const auto vector = [&](const Vector3& v) { put(v[0]), put(v[1]), put(v[2]); };
  const auto shape = [&](const auto& s) {
    if constexpr (std::same_as<std::remove_cvref_t<decltype(s)>, Ball>)
      vector(s.center), put(s.radius);
    else
      vector(s.min), vector(s.max);
  };
  std::visit([&](const auto& shapes) { shape(shapes.a), shape(shapes.b); }, query.shapes);
  put(query.distances.alarm);
  put(query.distances.contact);
  const auto digest = context.digest({bytes.begin(), at});
  std::string id(kIdLength, '\0');
  for (std::size_t i = 0; i < id.size(); ++i) id[i] = "0123456789abcdef"[digest[i / 2] >> (i % 2 == 0 ? 4 : 0) & 15];
  return id;
}

bool is_query_id(std::string_view text) {
  return text.size() == kIdLength && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

std::uint64_t id_digits(std::string_view id, std::size_t first, std::size_t count) {
  const std::string_view digits = id.substr(first, count);
  std::uint64_t number = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), number, 16);
  return number;
}

}  // namespace contact::golden
