// Output that is whole or absent: written to a temporary file beside its place and renamed when complete.
#include "golden/output_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "golden/input_error.hpp"

namespace contact::golden {

OutputFile::OutputFile(const std::filesystem::path& path) : path_(std::filesystem::weakly_canonical(path)) {
  if (std::filesystem::is_directory(path_))
    throw InputError({path_.string(), 0}, "", "cannot write: it is a directory");
  // A pipe or a device cannot be replaced: it is written to as it stands.
  const bool replaceable = !std::filesystem::exists(path_) || std::filesystem::is_regular_file(path_);
  if (replaceable) temporary_ = path_.string() + fmt::format(".tmp{}", ::getpid());
  stream_.open(replaceable ? temporary_ : path_, std::ios::binary | std::ios::trunc);
  if (!stream_) fail("cannot write");
}

OutputFile::~OutputFile() {
  std::error_code ignored;
  if (!temporary_.empty()) std::filesystem::remove(temporary_, ignored);
}

void OutputFile::write(std::string_view text) {
  stream_.write(text.data(), static_cast<std::streamsize>(text.size()));
  if (!stream_) fail("cannot write");
}

void OutputFile::commit() {
  stream_.close();
  if (!stream_) fail("cannot write");
  if (temporary_.empty()) return;
  std::error_code error;
  std::filesystem::rename(temporary_, path_, error);
  if (error) throw InputError({path_.string(), 0}, "", "cannot write: " + error.message());
}

void OutputFile::fail(const std::string& what) {
  throw InputError({path_.string(), 0}, "", what + ": " + std::strerror(errno));
}

}  // namespace contact::golden
