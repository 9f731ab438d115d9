// Output that is whole or absent: written to a temporary file beside its place and renamed when complete.
#include "golden/output_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <mutex>
#include <set>
#include <system_error>
#include <utility>

#include "golden/input_error.hpp"

namespace contact::golden {
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

constexpr int kOpen = O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;

/// The descriptor, locked, where it is of a file like ours that still has the name; else -1, and it is closed. Where no
/// file can be locked, a `fresh` one is ours all the same, and none is ever taken over.
int locked(int file, const std::string& name, bool fresh) {
  if (file < 0) return -1;
  struct stat opened {};
  struct stat named {};
  const bool is_locked = ::flock(file, LOCK_EX | LOCK_NB) == 0;
  // Before it was locked, somebody else may have had it, and renamed or removed it.
  if (is_locked ? ::fstat(file, &opened) == 0 && ::lstat(name.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
                      opened.st_dev == named.st_dev && S_ISREG(opened.st_mode) && opened.st_nlink == 1
                : fresh && errno != EWOULDBLOCK)
    return file;
  ::close(file);
  return -1;
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

}  // namespace

PendingFile::PendingFile(const std::filesystem::path& path) : path_(path) {
  std::error_code error;
  const auto type = std::filesystem::status(path, error).type();
  if (type == std::filesystem::file_type::directory) fail("it is a directory");
  if (type == std::filesystem::file_type::regular || type == std::filesystem::file_type::not_found) {
    error.clear();
    path_ = resolved(std::filesystem::absolute(path), error);
    if (!error) take_temporary();
  } else {
    temporary_ = path_;
  }
  if (error) fail(error.message());
}

void PendingFile::take_temporary() {
  if (!places.add(path_)) fail("this run has another output of that name");
  const auto name = [&](int n) { return path_.string() + ".unfinished" + (n == 0 ? "" : std::to_string(n)); };
  int n = 0;
  for (; lock_ < 0; ++n) {
    temporary_ = name(n);
    const int made = ::open(temporary_.c_str(), kOpen | O_CREAT | O_EXCL, 0666);
    if (made < 0 && errno != EEXIST) {
      const std::string why = std::strerror(errno);
      places.remove(path_);
      fail(why);
    }
    lock_ = made >= 0 ? locked(made, temporary_, true) : locked(::open(temporary_.c_str(), kOpen), temporary_, false);
  }
  // What other killed runs left behind it goes.
  for (; std::filesystem::exists(std::filesystem::symlink_status(name(n))); ++n)
    if (const int left = locked(::open(name(n).c_str(), kOpen), name(n), false); left >= 0) {
      ::unlink(name(n).c_str());
      ::close(left);
    }
}

PendingFile::~PendingFile() {
  if (lock_ < 0) return;
  ::unlink(temporary_.c_str());
  ::close(lock_);
  places.remove(path_);
}

void PendingFile::commit() {
  if (lock_ < 0) return;
  if (::fsync(lock_) != 0 || std::rename(temporary_.c_str(), path_.c_str()) != 0) fail(std::strerror(errno));
  ::close(std::exchange(lock_, -1));
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

}  // namespace contact::golden
