// A well-formed HDF5 file whose columns hold anything, lack anything or are of another kind: refused, or read as what
// it was made of. (Files that are no HDF5 at all are that library's to refuse; fuzzing those would be fuzzing it.)
#include <hdf5.h>

#include <array>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "formats/hdf5.hpp"
#include "formats/input_error.hpp"
#include "fuzz/cases_in_form.hpp"
#include "fuzz/fuzz.hpp"

namespace contact::fuzz::columns {
namespace {

using formats::hdf5::checked;
using formats::hdf5::Handle;

/// A file of some cases, its bytes and its lines.
struct Made {
  explicit Made(Pair pair, bool invalid) {
    const Temporary made("made.h5");
    lines = write_columns(made.path(), formats::ArraysForm::hdf5, pair, invalid, 5);
    std::ifstream file(made.path(), std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(file), {});
  }

  std::string bytes;
  std::vector<std::string> lines;
};

/// Overwrites some bytes of a column's rows by others.
void overwrite(const Handle& column, Bytes& changes) {
  const Handle type(H5Dget_type(column), H5Tclose);
  const Handle space(H5Dget_space(column), H5Sclose);
  std::vector<unsigned char> rows(static_cast<std::size_t>(checked(H5Sget_simple_extent_npoints(space))) *
                                  H5Tget_size(type));
  checked(H5Dread(column, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data()));
  const std::size_t at = rows.empty() ? 0 : (next(changes) << 8 | next(changes)) % rows.size();
  for (std::size_t n = next(changes) % 16, k = at; n > 0 && k < rows.size(); --n, ++k)
    rows[k] = static_cast<unsigned char>(next(changes));
  checked(H5Dwrite(column, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data()));
}

/// A column of the same name and another kind or length, its rows 0.
void replace(const Handle& file, const std::string& name, Bytes& changes) {
  const std::array<hid_t, 5> kinds{H5T_NATIVE_DOUBLE, H5T_NATIVE_FLOAT, H5T_NATIVE_UINT8, H5T_NATIVE_INT64, H5T_C_S1};
  const std::array<hsize_t, 3> length{next(changes) % 8, next(changes) % 4, 2};
  const Handle space(H5Screate_simple(static_cast<int>(next(changes) % 4), length.data(), nullptr), H5Sclose);
  checked(H5Ldelete(file, name.c_str(), H5P_DEFAULT));
  const Handle made(
      H5Dcreate2(file, name.c_str(), kinds[next(changes) % kinds.size()], space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      H5Dclose);
}

void change(const Handle& file, Bytes& changes) {
  const std::size_t which = next(changes);
  const std::set<std::string> names = formats::hdf5::object_names(file);
  if (names.empty()) return;
  const std::string name = *std::next(names.begin(), static_cast<std::ptrdiff_t>(which % names.size()));
  const Handle object(H5Oopen(file, name.c_str(), H5P_DEFAULT), H5Oclose);
  const bool is_column = H5Iget_type(object) == H5I_DATASET;
  switch (next(changes) % 5) {
    case 0:
      checked(H5Ldelete(file, name.c_str(), H5P_DEFAULT));
      break;
    case 1:
      if (is_column) replace(file, name, changes);
      break;
    case 2: {
      const auto attributes = formats::hdf5::attribute_names(file);
      if (attributes.empty()) break;
      const std::string& attribute = attributes.at(next(changes) % attributes.size());
      checked(H5Adelete(file, attribute.c_str()));
      const std::size_t value = next(changes);
      if (value % 3 == 1) formats::hdf5::write_attribute(file, attribute, value);
      if (value % 3 == 2) formats::hdf5::write_attribute(file, attribute, std::string(value, 'x'));
      break;
    }
    default:
      if (is_column) overwrite(object, changes);
  }
}

void try_input(Bytes bytes) {
  static const std::array made{Made(Pair::sphere_sphere, false), Made(Pair::sphere_sphere, true),
                               Made(Pair::cube_cube, false)};
  const Made& from = made[next(bytes) % made.size()];
  // HDF5 changes no file that has no name.
  const Temporary file("changed.h5");
  std::ofstream(file.path(), std::ios::binary) << from.bytes;
  {
    const formats::hdf5::Lock lock;
    const Handle open(H5Fopen(file.path().c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    try {
      while (!bytes.empty()) change(open, bytes);
    } catch (const formats::hdf5::Error&) {
      // A change that HDF5 refuses is none.
    }
  }
  try {
    require(lines_of(file.path()) == from.lines, "changed rows pass for whole");
  } catch (const formats::InputError&) {
  }
}

const Target target("columns", try_input);

}  // namespace
}  // namespace contact::fuzz::columns
