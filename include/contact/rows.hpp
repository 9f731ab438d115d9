// Rows of numbers that pass between a program and the library, in storage that no compiler flag changes.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "contact/geometry.hpp"

namespace contact::inline CONTACT_ABI {

/// Rows of `Width` numbers, or of any one width if `Width` is Eigen::Dynamic.
///
/// Eigen's dynamic matrices never pass between a program and the library. The instruction set that a file is compiled
/// for decides how they are aligned, allocated and freed, and the library's files may be compiled for another one than
/// its caller's. Matrices go in by copying and come out as maps, in functions that the caller compiles.
template <int Width>
class Rows {
 public:
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Width, Eigen::ColMajor>;

  Rows() : cols_(Width == Eigen::Dynamic ? 0 : Width) {}
  Rows(const Rows&) = default;
  /// What is moved from has no rows.
  Rows(Rows&& other) noexcept
      : numbers_(std::move(other.numbers_)), rows_(std::exchange(other.rows_, 0)), cols_(other.cols_) {}
  Rows& operator=(Rows other) noexcept {
    numbers_.swap(other.numbers_);
    rows_ = other.rows_;
    cols_ = other.cols_;
    return *this;
  }
  ~Rows() = default;
  Rows(Index rows, Index cols, double value = 0)
      : numbers_(static_cast<std::size_t>(rows * cols), value), rows_(rows), cols_(cols) {
    expect_width();
  }
  /// Copies a matrix of this width. If the width is 1, a single row is taken as a column.
  template <class Derived>
  Rows(const Eigen::DenseBase<Derived>& matrix)  // NOLINT(google-explicit-constructor): a matrix is meant
      : Rows(Width == 1 ? matrix.size() : matrix.rows(), Width == 1 ? 1 : matrix.cols()) {
    static_assert(Width == Eigen::Dynamic || Width == 1 || Derived::ColsAtCompileTime == Eigen::Dynamic ||
                      Derived::ColsAtCompileTime == Width,
                  "a matrix of another number of columns");
    if (Width == 1 && matrix.cols() != 1 && matrix.rows() != 1) refuse(matrix.cols());
    const auto& numbers = matrix.derived();
    for (Index k = 0; k < numbers.cols(); ++k)
      for (Index i = 0; i < numbers.rows(); ++i)
        Width == 1 ? (*this)(i + k, 0) = numbers.coeff(i, k) : (*this)(i, k) = numbers.coeff(i, k);
  }
  template <int Other>
  Rows(Rows<Other> other)  // NOLINT(google-explicit-constructor): the same numbers
      : numbers_(std::move(other.numbers_)), rows_(other.rows_), cols_(other.cols_) {
    expect_width();
  }

  [[nodiscard]] Index rows() const { return rows_; }
  [[nodiscard]] Index cols() const { return cols_; }
  [[nodiscard]] Index size() const { return rows_ * cols_; }
  /// Column after column.
  [[nodiscard]] const double* data() const { return numbers_.data(); }
  [[nodiscard]] double operator()(Index row, Index col) const { return numbers_[at(row, col)]; }
  [[nodiscard]] double& operator()(Index row, Index col) { return numbers_[at(row, col)]; }
  /// The i-th number, column after column.
  [[nodiscard]] double operator()(Index i) const { return numbers_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] double& operator()(Index i) { return numbers_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] Vector3 vector(Index row) const requires(Width == 3) {
    return {(*this)(row, 0), (*this)(row, 1), (*this)(row, 2)};
  }
  void set(Index row, const Vector3& vector) requires(Width == 3) {
    for (int axis = 0; axis < 3; ++axis) (*this)(row, axis) = vector[axis];
  }

  /// The numbers where they lie, as Eigen sees them.
  [[nodiscard]] Eigen::Map<const Matrix> matrix() const { return {numbers_.data(), rows_, cols_}; }
  /// A copy of them.
  template <int Cols>
  operator Eigen::Matrix<double, Eigen::Dynamic, Cols>() const {  // NOLINT(google-explicit-constructor)
    if (Cols != Eigen::Dynamic && Cols != cols_) refuse(cols_, Cols);
    Eigen::Matrix<double, Eigen::Dynamic, Cols> copy(rows_, cols_);
    for (Index k = 0; k < cols_; ++k)
      for (Index i = 0; i < rows_; ++i) copy(i, k) = (*this)(i, k);
    return copy;
  }

 private:
  template <int>
  friend class Rows;

  [[nodiscard]] std::size_t at(Index row, Index col) const { return static_cast<std::size_t>(col * rows_ + row); }
  void expect_width() const {
    if (Width != Eigen::Dynamic && cols_ != Width) refuse(cols_);
  }
  [[noreturn]] static void refuse(Index width, Index wanted = Width) {
    throw std::invalid_argument(std::to_string(width) + " numbers a row where " + std::to_string(wanted) +
                                " are wanted");
  }

  std::vector<double> numbers_;
  Index rows_ = 0;
  Index cols_;
};

}  // namespace contact::inline CONTACT_ABI
