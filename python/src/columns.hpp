// Questions and answers as NumPy arrays: docs/python.md.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "formats/arrays.hpp"
#include "golden/query_id.hpp"
#include "oracle/truth/query.hpp"

namespace contact::python {

namespace py = pybind11;

/// The shape of a field's value in an array.
inline std::vector<py::ssize_t> shape_of(double) { return {}; }
inline std::vector<py::ssize_t> shape_of(const Vector3&) { return {3}; }
inline std::vector<py::ssize_t> shape_of(const Quaternion&) { return {4}; }
inline std::vector<py::ssize_t> shape_of(const std::array<Vector3, 3>&) { return {3, 3}; }

/// A number outside the domain: what becomes the Python exception.
struct OutsideDomain {
  std::string field;
  std::size_t row;
  double value;
  std::string rule;
};

/// Questions of one pair as float64 arrays of any strides: the fields of a, then of b, the alarm and the contact
/// distance, with as many rows each. They are read in place.
class QuestionArrays {
 public:
  /// Throws std::invalid_argument where an array is not of its kind and shape.
  QuestionArrays(Pair pair, const py::list& columns, const py::array& alarm, const py::array& contact);

  [[nodiscard]] Pair pair() const { return pair_; }
  [[nodiscard]] std::size_t size() const { return size_; }
  /// Question `row`, each of its numbers copied to `query`, which is one of this pair.
  void read(std::size_t row, Query& query) const {
    const Column* column = columns_.data();
    for_each_value(query, [&](auto& value) {
      const char* at = column->begin + static_cast<py::ssize_t>(row) * column->strides[0];
      read_value(at, column->strides.data() + 1, value);
      ++column;
    });
  }
  /// The same. Throws OutsideDomain where a number breaks a rule.
  void read_checked(std::size_t row, Query& query) const {
    read(row, query);
    if (inside_domain(query)) return;
    const auto error = outside_domain(query);
    throw OutsideDomain{error->field, row, error->value, error->rule};
  }

 private:
  struct Column {
    const char* begin;
    std::array<py::ssize_t, 3> strides;
  };

  static void read_value(const char* at, const py::ssize_t*, double& value) { std::memcpy(&value, at, sizeof value); }
  static void read_value(const char* at, const py::ssize_t* strides, Vector3& value) {
    for (int axis = 0; axis < 3; ++axis) std::memcpy(&value[axis], at + axis * strides[0], sizeof(double));
  }
  static void read_value(const char* at, const py::ssize_t* strides, Quaternion& value) {
    for (double& x : value) std::memcpy(&x, at, sizeof x), at += strides[0];
  }
  static void read_value(const char* at, const py::ssize_t* strides, std::array<Vector3, 3>& value) {
    for (std::size_t i = 0; i < value.size(); ++i)
      read_value(at + static_cast<py::ssize_t>(i) * strides[0], strides + 1, value[i]);
  }

  Pair pair_;
  std::size_t size_ = 0;
  std::vector<py::array> kept_;
  std::vector<Column> columns_;
};

/// Room for the questions of one pair, by the names of a golden file's columns ("a/center"), in numbers of a scalar.
class QuestionColumns {
 public:
  QuestionColumns(Pair pair, Scalar scalar, std::size_t size);

  void set(std::size_t row, const Query& query);
  void set_id(std::size_t row, const std::string& id) {
    std::memcpy(ids_ + row * golden::kIdLength, id.data(), golden::kIdLength);
  }
  [[nodiscard]] py::dict arrays() const { return arrays_; }
  /// Without the ids: the arrays in their order, then the alarm and the contact distance.
  [[nodiscard]] py::tuple as_columns() const;

 private:
  struct Column {
    char* begin;
    std::size_t across;
  };

  Scalar scalar_;
  py::dict arrays_;
  char* ids_ = nullptr;
  std::vector<Column> columns_;
};

/// Arrays in memory, read as a file of arrays. Throws formats::InputError, which names `what`.
[[nodiscard]] std::unique_ptr<formats::ArraysFile> arrays_in_memory(std::string what, const py::dict& arrays,
                                                                    std::string header);

}  // namespace contact::python
