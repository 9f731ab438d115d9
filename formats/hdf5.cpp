// HDF5's C library with handles that close themselves and errors that are exceptions, never printed.
#include "formats/hdf5.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#ifdef CONTACT_SANITIZED
// HDF5 1.10 loses some memory where it meets a damaged file.
extern "C" const char* __lsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier)
  return "leak:libhdf5\n";
}
extern "C" const char* __lsan_default_options() {  // NOLINT(bugprone-reserved-identifier)
  return "print_suppressions=0";
}
#endif

namespace contact::formats::hdf5 {
namespace {

std::recursive_mutex& mutex() {
  static std::recursive_mutex one;
  return one;
}

// More of either than any file here has: whoever nests or repeats them without end is stopped at so many.
constexpr std::size_t kMostAttributes = 64;
constexpr std::size_t kMostNames = 256;
constexpr std::size_t kLongestText = 65536;  // bytes of an attribute

std::string innermost_error() {
  std::string text = "HDF5 does not say why";
  const auto visit = [](unsigned depth, const H5E_error2_t* error, void* found) -> herr_t {
    if (depth == 0 && error->desc != nullptr) *static_cast<std::string*>(found) = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, visit, &text);
  // "file write failed: time = ..., error message = 'No space left on device', buf = 0x55...": the system's own words.
  constexpr std::string_view kSystem = "error message = '";
  if (const auto begin = text.find(kSystem); begin != std::string::npos)
    text = text.substr(begin + kSystem.size(), text.find('\'', begin + kSystem.size()) - begin - kSystem.size());
  return text;
}

Handle file_access() {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  checked(H5Pset_fclose_degree(access, H5F_CLOSE_STRONG));
  checked(H5Pset_file_locking(access, false, true));
  // The first format in which everything but the chunks, which have their own, is under a checksum.
  checked(H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110));
  return access;
}

std::vector<std::string> texts(const std::vector<char>& bytes, std::size_t length) {
  std::vector<std::string> found;
  for (std::size_t at = 0; at < bytes.size(); at += length)
    found.emplace_back(bytes.data() + at, std::find(bytes.data() + at, bytes.data() + at + length, '\0'));
  return found;
}

/// A type of whole numbers or texts with the values of an attribute in it.
struct Values {
  Handle type;
  std::vector<char> bytes;
};

Values values_of(const std::vector<nlohmann::json>& items) {
  if (items.front().is_string()) {
    std::size_t length = 1;
    for (const auto& item : items) length = std::max(length, item.get_ref<const std::string&>().size());
    Values values{text_type(length), {}};
    for (const auto& item : items) {
      const auto& text = item.get_ref<const std::string&>();
      if (text.find('\0') != std::string::npos) throw Error("a text with a NUL in it");
      const std::size_t end = values.bytes.size() + length;
      values.bytes.insert(values.bytes.end(), text.begin(), text.end());
      values.bytes.resize(end);
    }
    return values;
  }
  Values values{Handle(H5Tcopy(H5T_STD_U64LE), H5Tclose), {}};
  for (const auto& item : items) {
    const auto x = item.get<std::uint64_t>();
    for (int shift = 0; shift < 64; shift += 8) values.bytes.push_back(static_cast<char>((x >> shift) & 0xff));
  }
  return values;
}

}  // namespace

Error::Error() : std::runtime_error(innermost_error()) {}

Lock::Lock() : lock_(mutex()) {
  static const herr_t once = [] {
    // At the end of the process the library would write again what could not be written, and complain.
    checked(H5dont_atexit());
    return H5PLset_loading_state(0);  // a file does not choose the code that reads it
  }();
  static_cast<void>(once);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // a thread's own setting where the library knows threads
}

Handle::~Handle() {
  if (id_ < 0) return;
  const Lock lock;
  close_(id_);
}

Handle create_file(const std::filesystem::path& path) {
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  checked(H5Pset_obj_track_times(creation, false));
  return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, file_access()), H5Fclose};
}

Handle open_file(const std::filesystem::path& path) {
  return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, file_access()), H5Fclose};
}

bool is_hdf5(std::string_view first_bytes) { return first_bytes.starts_with("\x89HDF\r\n\x1a\n"); }

Handle text_type(std::size_t length) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  checked(H5Tset_size(type, length));
  checked(H5Tset_strpad(type, H5T_STR_NULLPAD));
  return type;
}

void create_group(hid_t file, const std::string& name) {
  const Handle creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  checked(H5Pset_obj_track_times(creation, false));
  Handle(H5Gcreate2(file, name.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT), H5Gclose).close();
}

void write_attribute(hid_t object, const std::string& name, const nlohmann::json& value) {
  const bool array = value.is_array();
  const Values values = values_of(array ? value.get<std::vector<nlohmann::json>>() : std::vector{value});
  const hsize_t size = value.size();
  const Handle space(array ? H5Screate_simple(1, &size, nullptr) : H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(object, name.c_str(), values.type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  checked(H5Awrite(attribute, values.type, values.bytes.data()));
}

nlohmann::json read_attribute(hid_t object, const std::string& name) {
  constexpr hssize_t kMost = 64;  // of entries and bytes, more than any attribute here has
  const Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose);
  const Handle space(H5Aget_space(attribute), H5Sclose);
  const Handle type(H5Aget_type(attribute), H5Tclose);
  const H5S_class_t extent = H5Sget_simple_extent_type(space);
  const hssize_t size = extent == H5S_NULL ? 0 : checked(H5Sget_simple_extent_npoints(space));
  if (size < 1 || size > kMost || checked(H5Sget_simple_extent_ndims(space)) > 1)
    throw Error("expected one value or a short list");
  const auto count = static_cast<std::size_t>(size);
  nlohmann::json values = nlohmann::json::array();
  if (checked(H5Tget_class(type)) == H5T_STRING && checked(H5Tis_variable_str(type)) == 0) {
    const std::size_t length = H5Tget_size(type);
    if (length == 0 || length > kLongestText) throw Error(fmt::format("a text of {} bytes", length));
    std::vector<char> bytes(count * length);
    checked(H5Aread(attribute, type, bytes.data()));
    values = texts(bytes, length);
  } else if (checked(H5Tequal(type, H5T_STD_U64LE)) > 0) {
    std::vector<std::uint64_t> numbers(count);
    checked(H5Aread(attribute, H5T_NATIVE_UINT64, numbers.data()));
    values = numbers;
  } else {
    throw Error("expected a text of fixed length or 64-bit unsigned integers");
  }
  return extent == H5S_SCALAR ? values.front() : values;
}

std::string read_text_attribute(hid_t object, const std::string& name) {
  const Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose);
  const Handle space(H5Aget_space(attribute), H5Sclose);
  const Handle type(H5Aget_type(attribute), H5Tclose);
  if (checked(H5Tget_class(type)) != H5T_STRING || checked(H5Sget_simple_extent_npoints(space)) != 1)
    throw Error("expected a text");
  if (checked(H5Tis_variable_str(type)) == 0) {
    const auto text = read_attribute(object, name);
    return (text.is_array() ? text.front() : text).get<std::string>();
  }
  char* bytes = nullptr;
  checked(H5Aread(attribute, type, &bytes));
  if (bytes == nullptr) return {};
  const std::string text(bytes, strnlen(bytes, kLongestText + 1));
  checked(H5Dvlen_reclaim(type, space, H5P_DEFAULT, &bytes));
  if (text.size() > kLongestText) throw Error(fmt::format("a text of more than {} bytes", kLongestText));
  return text;
}

std::vector<std::string> attribute_names(hid_t object) {
  std::vector<std::string> names;
  const auto visit = [](hid_t, const char* name, const H5A_info_t*, void* found) -> herr_t {
    auto& all = *static_cast<std::vector<std::string>*>(found);
    all.emplace_back(name);
    return all.size() > kMostAttributes ? 1 : 0;
  };
  if (checked(H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, visit, &names)) > 0)
    throw Error(fmt::format("more than {} attributes", kMostAttributes));
  return names;
}

std::set<std::string> object_names(hid_t file) {
  std::set<std::string> names;
  const auto visit = [](hid_t, const char* name, const H5L_info_t* link, void* found) -> herr_t {
    const bool here = link->type == H5L_TYPE_HARD;
    auto& all = *static_cast<std::set<std::string>*>(found);
    all.insert(std::string(name) + (here ? "" : " (a link)"));
    return all.size() > kMostNames ? 1 : 0;
  };
  if (checked(H5Lvisit(file, H5_INDEX_NAME, H5_ITER_NATIVE, visit, &names)) > 0)
    throw Error(fmt::format("more than {} groups and columns", kMostNames));
  return names;
}

}  // namespace contact::formats::hdf5
