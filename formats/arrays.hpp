// Arrays by name in one file, HDF5 or NumPy's .npz, read and written some rows at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "formats/output_file.hpp"

namespace contact::formats {

/// What an array holds: rows of values. Bytes in memory are those of this processor; texts are filled up with NUL.
struct ArrayType {
  enum class Kind { real, byte, bits, text, other };  ///< bits: 32-bit unsigned integers
  Kind kind = Kind::real;
  std::size_t size = sizeof(double);    ///< bytes of a value; of a real 4 or 8
  std::vector<std::uint64_t> row = {};  ///< the shape of a row: none of one value, (3) of a vector, (3, 3) of three

  /// Values and bytes of a row.
  [[nodiscard]] std::size_t across() const;
  [[nodiscard]] std::size_t row_size() const { return across() * size; }
  /// The shape of so many rows, and the same in words: "(40, 3)".
  [[nodiscard]] std::vector<std::uint64_t> shape(std::uint64_t rows) const;
  [[nodiscard]] std::string shape_text(std::uint64_t rows) const;
  /// "64-bit IEEE numbers"
  [[nodiscard]] std::string words() const;

  friend bool operator==(const ArrayType&, const ArrayType&) = default;
};

/// An array that is read. Both it and its file throw InputError naming the file, the row and the array.
class ArrayReader {
 public:
  ArrayReader(ArrayType type, std::uint64_t rows) : type_(std::move(type)), rows_(rows) {}
  ArrayReader(const ArrayReader&) = delete;
  ArrayReader& operator=(const ArrayReader&) = delete;
  virtual ~ArrayReader() = default;

  [[nodiscard]] const ArrayType& type() const { return type_; }
  [[nodiscard]] std::uint64_t rows() const { return rows_; }
  /// Gives `bytes` the rows from `first` on. Memory is bounded by what is asked for and by a chunk of the file.
  virtual void read(std::uint64_t first, std::uint64_t count, std::vector<char>& bytes) = 0;

 private:
  ArrayType type_;
  std::uint64_t rows_;
};

/// A file of arrays that is read; one thread at a time, but for the rows of different arrays where it says so.
class ArraysFile {
 public:
  ArraysFile() = default;
  ArraysFile(const ArraysFile&) = delete;
  ArraysFile& operator=(const ArraysFile&) = delete;
  virtual ~ArraysFile() = default;

  /// What stands beside the arrays: HDF5's attributes of the file, or of .npz the member `header`, as a JSON object.
  [[nodiscard]] virtual nlohmann::json header() = 0;
  /// The text of one that is called `header`; nothing where there is none.
  [[nodiscard]] virtual std::optional<std::string> header_text() = 0;
  /// Arrays, the groups that they are in, and whatever else a file may hold, by a name that says what it is.
  [[nodiscard]] virtual std::set<std::string> names() = 0;
  [[nodiscard]] virtual std::unique_ptr<ArrayReader> open(const std::string& name) = 0;
  /// The texts that belong to an array: labelled() is what names() has of them.
  [[nodiscard]] virtual nlohmann::json labels(const std::string& name) = 0;
  [[nodiscard]] virtual bool reads_in_parallel() const { return false; }
};
/// Of an array with labels, and the group of a name; the name itself where it is in none.
[[nodiscard]] std::string labelled(const std::string& name);
[[nodiscard]] std::string group_of(const std::string& name);

/// A file of arrays that is written, each with as many rows as it was created for.
class ArraysWriter {
 public:
  struct Array {
    std::string name;
    std::uint64_t rows;
    nlohmann::json labels = {};  ///< none
  };

  ArraysWriter() = default;
  ArraysWriter(const ArraysWriter&) = delete;
  ArraysWriter& operator=(const ArraysWriter&) = delete;
  virtual ~ArraysWriter() = default;

  /// Appends rows to an array, whose texts may have become wider since the last time. Called once at least for each.
  virtual void append(std::size_t array, const ArrayType& type, const std::vector<char>& rows) = 0;
  /// Completes the file and closes it. Precondition: every array has its rows.
  virtual void finish(const nlohmann::json& header) = 0;
};

/// The forms of such files, by how a file begins and how its name ends.
enum class ArraysForm { hdf5, npz };
[[nodiscard]] std::optional<ArraysForm> arrays_form(const std::filesystem::path& path);
[[nodiscard]] std::optional<ArraysForm> named_arrays_form(const std::filesystem::path& path);
/// "HDF5", ".npz"
[[nodiscard]] std::string_view name(ArraysForm form);

[[nodiscard]] std::unique_ptr<ArraysFile> open_arrays(const std::filesystem::path& path, ArraysForm form);
/// Writes to the temporary of `pending`, which is the caller's to commit, and fails through it.
[[nodiscard]] std::unique_ptr<ArraysWriter> create_arrays(const PendingFile& pending, ArraysForm form,
                                                          std::vector<ArraysWriter::Array> arrays);

/// The two forms themselves.
[[nodiscard]] std::unique_ptr<ArraysFile> open_hdf5_arrays(const std::filesystem::path& path);
[[nodiscard]] std::unique_ptr<ArraysWriter> create_hdf5_arrays(const PendingFile& pending,
                                                               std::vector<ArraysWriter::Array> arrays);
[[nodiscard]] std::unique_ptr<ArraysFile> open_npz(const std::filesystem::path& path);
[[nodiscard]] std::unique_ptr<ArraysWriter> create_npz(const PendingFile& pending,
                                                       std::vector<ArraysWriter::Array> arrays);

inline constexpr std::uint64_t kArrayBlock = 4096;  ///< rows in a chunk of a file that is written

}  // namespace contact::formats
