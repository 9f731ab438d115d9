// SHA-256 (OpenSSL): the digest of a text or of a file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace contact::formats {

/// SHA-256 over pieces of text, as they come.
class Sha256 {
 public:
  using Digest = std::array<std::uint8_t, 32>;

  Sha256();
  Sha256& add(std::string_view bytes);
  [[nodiscard]] Digest digest() const;
  [[nodiscard]] std::string hex() const;
  /// The digest of one text; cheaper than an object for it.
  [[nodiscard]] static Digest digest_of(std::string_view bytes);

 private:
  struct Free {
    void operator()(void* context) const;
  };
  std::unique_ptr<void, Free> context_;
};

}  // namespace contact::formats
