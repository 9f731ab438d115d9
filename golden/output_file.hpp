// Output that is whole or absent: written to a temporary file beside its place and renamed when complete.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace contact::golden {

/// Writes to `path` as a whole or not at all: without commit() nothing is left behind, whatever happened. Links are
/// followed; a pipe or a device is written to in place.
class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& path);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  void write(std::string_view text);
  /// Flushes, checks and renames. Throws InputError naming the file where any of it fails (a full disk, no right).
  void commit();

 private:
  [[noreturn]] void fail(const std::string& what);

  std::filesystem::path path_;
  std::filesystem::path temporary_;  ///< empty where path_ is a pipe or a device
  std::ofstream stream_;
};

}  // namespace contact::golden
