// Output that is whole or absent: written to a temporary file beside its place and renamed when complete.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace contact::formats {

/// A file to be: what is written to temporary() becomes the file by commit(), and without it nothing is left behind,
/// but where the process is killed: then a `FILE.XXXXXXXX.unfinished` stays, which nothing reads. Two runs at once have
/// one each, and the last to commit stands. Links are followed, also to what is not there yet; a pipe or a device
/// cannot be replaced, and is its own temporary.
class PendingFile {
 public:
  explicit PendingFile(const std::filesystem::path& path);
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;
  ~PendingFile();

  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }
  [[nodiscard]] bool replaceable() const { return temporary_ != path_; }
  /// Puts the file in its place, its bytes on the disk before its name.
  void commit();
  /// Throws InputError naming the file: "cannot write: why".
  [[noreturn]] void fail(const std::string& why) const;

 private:
  std::filesystem::path path_;
  std::filesystem::path temporary_;
  int descriptor_ = -1;  ///< of the temporary; -1 where there is none
};

/// Removes what has not been committed, in the handler of a signal that ends the process: it calls nothing that such a
/// handler may not.
void remove_unfinished() noexcept;

/// Text that is written as a whole or not at all.
class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& path);

  void write(std::string_view text);
  /// Flushes, checks and renames. Throws InputError naming the file where any of it fails (a full disk, no right).
  void commit();

 private:
  void check();

  PendingFile file_;
  std::ofstream stream_;
};

}  // namespace contact::formats
