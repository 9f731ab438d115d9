// HDF5's C library with handles that close themselves and errors that are exceptions, never printed.
#pragma once

#include <hdf5.h>

#include <filesystem>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace contact::formats::hdf5 {

/// What went wrong, in the innermost words of HDF5.
struct Error : std::runtime_error {
  Error();
  using std::runtime_error::runtime_error;
};

/// To be held around every use of the library, which is not safe to call from several threads. Whoever holds it may
/// take it again.
class Lock {
 public:
  Lock();

 private:
  std::lock_guard<std::recursive_mutex> lock_;
};

/// Throws Error where a call of the library returned a failure.
template <class Result>
Result checked(Result result) {
  if (result < 0) throw Error();
  return result;
}

/// An object of the library, closed at the end of its life.
class Handle {
 public:
  Handle() = default;
  Handle(hid_t id, herr_t (*close_by)(hid_t)) : id_(checked(id)), close_(close_by) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Handle();

  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): it stands for the id in every call
  /// Closes now; throws Error where that fails, as a file does that cannot be written to its end.
  void close() { checked(close_(std::exchange(id_, -1))); }

 private:
  hid_t id_ = -1;
  herr_t (*close_)(hid_t) = nullptr;
};

/// A file to write from its beginning or to read. Files come whole by being renamed, so none is locked.
[[nodiscard]] Handle create_file(const std::filesystem::path& path);
[[nodiscard]] Handle open_file(const std::filesystem::path& path);
/// Whether the bytes at the beginning of a file are HDF5's.
[[nodiscard]] bool is_hdf5(std::string_view first_bytes);

/// A type of texts of `length` bytes, shorter ones filled up with NUL.
[[nodiscard]] Handle text_type(std::size_t length);
/// A group without what would differ from run to run, such as the time.
void create_group(hid_t file, const std::string& name);

/// An attribute that is a text, a whole number from 0, or an array of one of the two, as a JSON value. Reading refuses
/// with an Error what is none of them.
void write_attribute(hid_t object, const std::string& name, const nlohmann::json& value);
[[nodiscard]] nlohmann::json read_attribute(hid_t object, const std::string& name);
/// A text, also one of no fixed length, as other libraries write them.
[[nodiscard]] std::string read_text_attribute(hid_t object, const std::string& name);
[[nodiscard]] std::vector<std::string> attribute_names(hid_t object);

/// The paths of everything in a file, such as "a" and "a/center"; of what it only points to, "alarm (a link)".
[[nodiscard]] std::set<std::string> object_names(hid_t file);

}  // namespace contact::formats::hdf5
