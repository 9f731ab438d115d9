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

/// The first byte of the rest of an input, which it leaves; 0 behind the end.
[[nodiscard]] inline std::size_t next(Bytes& rest) {
  if (rest.empty()) return 0;
  const std::size_t byte = rest.front();
  rest = rest.subspan(1);
  return byte;
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

/// A path of this process for a file, or for a folder, which is removed at the end of its life.
class Temporary {
 public:
  explicit Temporary(const std::string& name);
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  ~Temporary() { std::filesystem::remove_all(path_); }

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};
struct TemporaryFolder : Temporary {
  explicit TemporaryFolder(const std::string& name) : Temporary(name) { std::filesystem::create_directories(path()); }
};

/// What is done with one input, under the name of its corpus. A program of libFuzzer's has one target; otherwise one has all.
struct Target {
  Target(std::string_view name, void (*try_input)(Bytes));
};

}  // namespace contact::fuzz
