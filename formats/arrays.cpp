// Arrays by name in one file, HDF5 or NumPy's .npz: what both forms have in common.
#include "formats/arrays.hpp"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <functional>
#include <numeric>

#include "formats/hdf5.hpp"
#include "formats/json.hpp"

namespace contact::formats {

std::size_t ArrayType::across() const {
  return std::accumulate(row.begin(), row.end(), std::size_t{1}, std::multiplies<>());
}

std::vector<std::uint64_t> ArrayType::shape(std::uint64_t rows) const {
  std::vector<std::uint64_t> all{rows};
  all.insert(all.end(), row.begin(), row.end());
  return all;
}

std::string ArrayType::shape_text(std::uint64_t rows) const {
  return fmt::format("({})", fmt::join(shape(rows), ", "));
}

std::string ArrayType::words() const {
  switch (kind) {
    case Kind::real:
      return fmt::format("{}-bit IEEE numbers", 8 * size);
    case Kind::byte:
      return "8-bit unsigned integers";
    case Kind::bits:
      return "32-bit unsigned integers";
    case Kind::text:
      return fmt::format("texts of {} bytes", size);
    default:
      return "values of another kind";
  }
}

std::string labelled(const std::string& name) { return name + ": attribute names"; }

std::string group_of(const std::string& name) { return name.substr(0, name.find('/')); }

std::optional<ArraysForm> arrays_form(const std::filesystem::path& path) {
  std::ifstream stream = open_to_read(path, true);
  std::array<char, 8> first{};
  stream.read(first.data(), first.size());
  const std::string_view bytes(first.data(), static_cast<std::size_t>(stream.gcount()));
  if (hdf5::is_hdf5(bytes)) return ArraysForm::hdf5;
  if (bytes.starts_with("PK\x03\x04") || bytes.starts_with("PK\x05\x06")) return ArraysForm::npz;
  return std::nullopt;
}

std::optional<ArraysForm> named_arrays_form(const std::filesystem::path& path) {
  if (path.extension() == ".h5") return ArraysForm::hdf5;
  if (path.extension() == ".npz") return ArraysForm::npz;
  return std::nullopt;
}

std::string_view name(ArraysForm form) { return form == ArraysForm::hdf5 ? "HDF5" : ".npz"; }

std::unique_ptr<ArraysFile> open_arrays(const std::filesystem::path& path, ArraysForm form) {
  return form == ArraysForm::hdf5 ? open_hdf5_arrays(path) : open_npz(path);
}

std::unique_ptr<ArraysWriter> create_arrays(const PendingFile& pending, ArraysForm form,
                                            std::vector<ArraysWriter::Array> arrays) {
  if (!pending.replaceable()) pending.fail("columns need a regular file");
  return form == ArraysForm::hdf5 ? create_hdf5_arrays(pending, std::move(arrays))
                                  : create_npz(pending, std::move(arrays));
}

}  // namespace contact::formats
