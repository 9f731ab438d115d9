// Output that is whole or absent: written to a temporary file beside its place and renamed when complete.
#include "formats/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <mutex>
#include <random>
#include <set>
#include <system_error>
#include <utility>

#include "formats/input_error.hpp"

namespace contact::formats {
namespace {

constexpr int kMostLinks = 40;  // as many as Linux follows

/// Where a name leads, through links to what is not there yet as well.
std::filesystem::path resolved(std::filesystem::path path, std::error_code& error) {
  for (int links = 0; links < kMostLinks; ++links) {
    std::error_code ignored;
    if (std::filesystem::status(path, ignored).type() != std::filesystem::file_type::not_found ||
        !std::filesystem::is_symlink(std::filesystem::symlink_status(path, ignored)))
      break;
    path = path.parent_path() / std::filesystem::read_symlink(path, ignored);
  }
  return std::filesystem::weakly_canonical(path, error);
}

/// The places that this process writes: one file cannot be two outputs.
class Places {
 public:
  bool add(const std::filesystem::path& path) {
    const std::lock_guard lock(mutex_);
    return places_.insert(path).second;
  }
  void remove(const std::filesystem::path& path) {
    const std::lock_guard lock(mutex_);
    places_.erase(path);
  }

 private:
  std::mutex mutex_;
  std::set<std::filesystem::path> places_;
} places;

/// The names of temporary files, for the handler of a signal. What finds no room here may be left behind.
class Unfinished {
 public:
  void add(const char* name) { exchange(nullptr, name); }
  void remove(const char* name) { exchange(name, nullptr); }
  void unlink_all() noexcept {
    for (std::atomic<const char*>& one : names_)
      if (const char* name = one.load()) ::unlink(name);
  }

 private:
  void exchange(const char* from, const char* to) {
    for (std::atomic<const char*>& one : names_) {
      const char* expected = from;
      if (one.compare_exchange_strong(expected, to)) return;
    }
  }

  static_assert(std::atomic<const char*>::is_always_lock_free);
  std::array<std::atomic<const char*>, 64> names_{};
} unfinished;

}  // namespace

void remove_unfinished() noexcept { unfinished.unlink_all(); }

PendingFile::PendingFile(const std::filesystem::path& path) : path_(path), temporary_(path) {
  std::error_code error;
  const auto type = std::filesystem::status(path, error).type();
  if (type == std::filesystem::file_type::directory) fail("it is a directory");
  const bool is_ours = type == std::filesystem::file_type::regular || type == std::filesystem::file_type::not_found;
  if (is_ours) {
    error.clear();
    path_ = resolved(std::filesystem::absolute(path), error);
  }
  if (error) fail(error.message());
  if (!is_ours) return;
  if (!places.add(path_)) fail("this run has another output of that name");
  do {
    temporary_ = fmt::format("{}.{:08x}.unfinished", path_.string(), std::random_device{}());
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (descriptor_ < 0 && errno == EEXIST);
  if (descriptor_ >= 0) {
    unfinished.add(temporary_.c_str());
    return;
  }
  const std::string why = std::strerror(errno);
  places.remove(path_);
  fail(why);
}

PendingFile::~PendingFile() {
  if (descriptor_ < 0) return;
  ::unlink(temporary_.c_str());
  unfinished.remove(temporary_.c_str());
  ::close(descriptor_);
  places.remove(path_);
}

void PendingFile::commit() {
  if (descriptor_ < 0) return;
  if (::fsync(descriptor_) != 0 || std::rename(temporary_.c_str(), path_.c_str()) != 0) fail(std::strerror(errno));
  unfinished.remove(temporary_.c_str());
  ::close(std::exchange(descriptor_, -1));
  places.remove(path_);
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

}  // namespace contact::formats
