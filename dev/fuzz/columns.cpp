// A well-formed HDF5 file whose columns hold anything, lack anything or are of another kind: refused, or read as what
// it was made of. (Files that are no HDF5 at all are that library's to refuse; fuzzing those would be fuzzing it.)
#include <hdf5.h>
#include <unistd.h>

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
#include "golden/columns.hpp"

namespace contact::fuzz::columns {
namespace {

using formats::hdf5::checked;
using formats::hdf5::Handle;

/// A file of some cases, its bytes and its lines.
struct Made {
  explicit Made(Pair pair, bool invalid) {
    golden::DatasetHeader header;
    header.pair = pair;
    header.family = invalid ? golden::kInvalidFamily : "made";
    header.count = 5;
    const std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("fuzz-" + std::to_string(::getpid()) + ".h5");
    const auto writer = golden::create_columns(path, formats::ArraysForm::hdf5, header);
    for (const golden::Case& c : cases_in_form(pair, invalid, header.count)) {
      lines.push_back(golden::to_line(c));
      writer->write(c, lines.back());
    }
    writer->commit();
    std::ifstream file(path, std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(file), {});
    std::filesystem::remove(path);
  }

  std::string bytes;
  std::vector<std::string> lines;
};

class Changes {
 public:
  explicit Changes(Bytes bytes) : rest_(bytes) {}
  [[nodiscard]] bool any() const { return !rest_.empty(); }
  [[nodiscard]] std::size_t next() {
    if (rest_.empty()) return 0;
    const std::size_t byte = rest_.front();
    rest_ = rest_.subspan(1);
    return byte;
  }

 private:
  Bytes rest_;
};

/// Overwrites some bytes of a column's rows by others.
void overwrite(const Handle& column, Changes& changes) {
  const Handle type(H5Dget_type(column), H5Tclose);
  const Handle space(H5Dget_space(column), H5Sclose);
  std::vector<unsigned char> rows(static_cast<std::size_t>(checked(H5Sget_simple_extent_npoints(space))) *
                                  H5Tget_size(type));
  checked(H5Dread(column, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data()));
  const std::size_t at = rows.empty() ? 0 : (changes.next() << 8 | changes.next()) % rows.size();
  for (std::size_t n = changes.next() % 16, k = at; n > 0 && k < rows.size(); --n, ++k)
    rows[k] = static_cast<unsigned char>(changes.next());
  checked(H5Dwrite(column, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data()));
}

/// A column of the same name and another kind or length, its rows 0.
void replace(const Handle& file, const std::string& name, Changes& changes) {
  const std::array<hid_t, 5> kinds{H5T_NATIVE_DOUBLE, H5T_NATIVE_FLOAT, H5T_NATIVE_UINT8, H5T_NATIVE_INT64, H5T_C_S1};
  const std::array<hsize_t, 3> length{changes.next() % 8, changes.next() % 4, 2};
  const Handle space(H5Screate_simple(static_cast<int>(changes.next() % 4), length.data(), nullptr), H5Sclose);
  checked(H5Ldelete(file, name.c_str(), H5P_DEFAULT));
  const Handle made(H5Dcreate2(file, name.c_str(), kinds[changes.next() % kinds.size()], space, H5P_DEFAULT,
                               H5P_DEFAULT, H5P_DEFAULT),
                    H5Dclose);
}

void change(const Handle& file, Changes& changes) {
  const std::size_t which = changes.next();
  const std::set<std::string> names = formats::hdf5::object_names(file);
  if (names.empty()) return;
  const std::string name = *std::next(names.begin(), static_cast<std::ptrdiff_t>(which % names.size()));
  const Handle object(H5Oopen(file, name.c_str(), H5P_DEFAULT), H5Oclose);
  const bool is_column = H5Iget_type(object) == H5I_DATASET;
  switch (changes.next() % 5) {
    case 0:
      checked(H5Ldelete(file, name.c_str(), H5P_DEFAULT));
      break;
    case 1:
      if (is_column) replace(file, name, changes);
      break;
    case 2: {
      const auto attributes = formats::hdf5::attribute_names(file);
      if (attributes.empty()) break;
      const std::string& attribute = attributes.at(changes.next() % attributes.size());
      checked(H5Adelete(file, attribute.c_str()));
      const std::size_t value = changes.next();
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
  Changes changes(bytes);
  const Made& from = made[changes.next() % made.size()];
  // HDF5 changes no file that has no name.
  const struct File {
    explicit File(const std::string& content) { std::ofstream(path, std::ios::binary) << content; }
    ~File() { std::filesystem::remove(path); }
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("fuzz-" + std::to_string(::getpid()) + "-changed.h5");
  } file(from.bytes);
  {
    const formats::hdf5::Lock lock;
    const Handle open(H5Fopen(file.path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    try {
      while (changes.any()) change(open, changes);
    } catch (const formats::hdf5::Error&) {
      // A change that HDF5 refuses is none.
    }
  }
  try {
    golden::DatasetReader reader(file.path, none_is_made);
    std::vector<std::string> lines;
    while (reader.next()) lines.push_back(reader.text());
    // Behind the last row their digest has been compared.
    require(lines == from.lines, "changed rows pass for whole");
  } catch (const formats::InputError&) {
  }
}

const Target target("columns", try_input);

}  // namespace
}  // namespace contact::fuzz::columns
