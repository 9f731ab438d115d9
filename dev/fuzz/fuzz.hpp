// What the fuzz targets share: a file in memory, numbers from bytes, and one way to fail.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace contact::fuzz {

using Bytes = std::span<const std::uint8_t>;

[[nodiscard]] inline std::string_view text_of(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Ends the process, saying what does not hold. What a reader refuses with an InputError is no failure.
[[noreturn]] void fail(const std::string& what);
inline void require(bool holds, const std::string& what) {
  if (!holds) fail(what);
}

/// A file of these bytes that no disk sees.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view bytes);
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  int descriptor_;
  std::filesystem::path path_;
};

/// What is done with one input, under the name of its corpus. A program of libFuzzer's has one target; otherwise one has all.
struct Target {
  Target(std::string_view name, void (*try_input)(Bytes));
};

}  // namespace contact::fuzz
