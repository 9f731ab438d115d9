// Output that is whole or absent: written to a temporary file beside its place and renamed when complete.
#include "golden/output_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "golden/input_error.hpp"

namespace contact::golden {

PendingFile::PendingFile(const std::filesystem::path& path) : path_(std::filesystem::weakly_canonical(path)) {
  if (std::filesystem::is_directory(path_)) fail("it is a directory");
  const bool replace = !std::filesystem::exists(path_) || std::filesystem::is_regular_file(path_);
  temporary_ = replace ? path_.string() + fmt::format(".tmp{}", ::getpid()) : path_.string();
}

PendingFile::~PendingFile() {
  std::error_code ignored;
  if (replaceable()) std::filesystem::remove(temporary_, ignored);
}

void PendingFile::commit() {
  if (!replaceable()) return;
  std::error_code error;
  std::filesystem::rename(temporary_, path_, error);
  if (error) fail(error.message());
}

void PendingFile::fail(const std::string& why) const {
  throw InputError({path_.string(), 0}, "", "cannot write: " + why);
}

OutputFile::OutputFile(const std::filesystem::path& path)
    : file_(path), stream_(file_.temporary(), std::ios::binary | std::ios::trunc) {
  check();
}

void OutputFile::write(std::string_view text) {
  stream_.write(text.data(), static_cast<std::streamsize>(text.size()));
  check();
}

void OutputFile::commit() {
  stream_.close();
  check();
  file_.commit();
}

void OutputFile::check() {
  if (!stream_) file_.fail(std::strerror(errno));
}

}  // namespace contact::golden
