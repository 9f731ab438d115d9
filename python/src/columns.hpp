// Questions and answers as NumPy arrays: docs/python.md.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <chrono>
#include <cstring>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "formats/arrays.hpp"
#include "golden/query_id.hpp"
#include "oracle/truth/query.hpp"
#include "tool/run/process.hpp"

namespace contact::python {

namespace py = pybind11;

/// Gives hulls as many vertices as those of another question of the pair have, where these are more.
void widen(Query& query, const Query& other);
/// The question of a pair whose hulls have most vertices.
[[nodiscard]] Query widest_query(Pair pair);

/// A number outside the domain: what becomes the Python exception.
struct OutsideDomain {
  std::string field;
  std::size_t row;
  double value;
  std::string rule;
};

/// Counts the rows of a call that may take long. Between some it looks for Ctrl-C, and after a second it shows a bar on a
/// terminal. Python's lock is not held meanwhile.
class RowCount {
 public:
  RowCount(std::string_view label, std::size_t total) : label_(label), total_(total) {}
  /// Throws what a handler of signals in Python raised.
  void add(std::size_t rows = 1) {
    done_ += rows;
    if (done_ >= next_look_) look();
  }

 private:
  void look();

  std::string label_;
  std::size_t total_;
  std::size_t done_ = 0;
  std::size_t next_look_ = 0;
  std::size_t shown_ = 0;
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  std::optional<tool::Progress> bar_;
};

/// Questions of one pair as float64 or float32 arrays of any strides: the fields of a, then of b, the alarm and the contact
/// distance, with as many rows each. Vertices of three NaN at the end of a hull's are not there. They are read in place.
class QuestionArrays {
 public:
  /// Throws std::invalid_argument where an array is not of its kind and shape.
  QuestionArrays(Pair pair, const py::list& columns, const py::array& alarm, const py::array& contact);

  [[nodiscard]] Pair pair() const { return pair_; }
  [[nodiscard]] std::size_t size() const { return size_; }
  /// Question `row`, each of its numbers copied to `query`, which is one of this pair.
  void read(std::size_t row, Query& query) const {
    const Column* column = columns_.data();
    for_each_value(query, [&]<class Value>(Value& value) {
      if constexpr (AnyNumberOfVectors<Value>) value.resize(column->vertices);
      const char* at = column->begin + static_cast<py::ssize_t>(row) * column->strides[0];
      if (column->is_single)
        read_value<float>(at, column->strides.data() + 1, value);
      else
        read_value<double>(at, column->strides.data() + 1, value);
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
    std::size_t vertices;  ///< that there is room for in a row of a hull's
    bool is_single;
  };

  template <class Number>
  static void read_value(const char* at, const py::ssize_t*, double& value) {
    Number number;
    std::memcpy(&number, at, sizeof number);
    value = number;
  }
  template <class Number>
  static void read_value(const char* at, const py::ssize_t* strides, Vector3& value) {
    for (int axis = 0; axis < 3; ++axis) read_value<Number>(at + axis * strides[0], nullptr, value[axis]);
  }
  template <class Number>
  static void read_value(const char* at, const py::ssize_t* strides, Quaternion& value) {
    for (double& x : value) read_value<Number>(at, nullptr, x), at += strides[0];
  }
  template <class Number>
  static void read_value(const char* at, const py::ssize_t* strides, std::span<Vector3> value) {
    for (Vector3& v : value) read_value<Number>(at, strides + 1, v), at += strides[0];
  }
  template <class Number>
  static void read_value(const char* at, const py::ssize_t* strides, std::vector<Vector3>& value) {
    read_value<Number>(at, strides, std::span(value));
    while (!value.empty() && value.back().array().isNaN().all()) value.pop_back();
  }

  Pair pair_;
  std::size_t size_ = 0;
  std::vector<py::array> kept_;
  std::vector<Column> columns_;
};

/// Room for the questions of one pair, by the names of a golden file's columns ("a/center"), in numbers of a scalar; for as many
/// vertices of hulls as the widest of them has, those behind a hull's last NaN.
class QuestionColumns {
 public:
  QuestionColumns(const Query& widest, Scalar scalar, std::size_t size);

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
