// The rules that columns of numbers are held to before a model takes them.
#pragma once

#include <optional>
#include <string>

#include "contact/collision_model.hpp"
#include "contact/rows.hpp"

namespace contact::component {

/// field[i]
[[nodiscard]] inline std::string row(const std::string& field, Index i) {
  return field + "[" + std::to_string(i) + "]";
}

/// The first number that is not finite, row by row, or nothing.
template <int Width>
[[nodiscard]] std::optional<DomainError> not_finite(const std::string& field, const Rows<Width>& columns) {
  for (Index i = 0; i < columns.rows(); ++i)
    for (Index k = 0; k < columns.cols(); ++k)
      if (!is_finite_by_bits(columns(i, k))) return DomainError{row(row(field, i), k), columns(i, k), "must be finite"};
  return std::nullopt;
}

/// The first number that is no length, or nothing.
[[nodiscard]] inline std::optional<DomainError> not_a_length(const std::string& field, const Rows<1>& column) {
  for (Index i = 0; i < column.rows(); ++i)
    if (auto error = outside_domain(row(field, i), column(i))) return error;
  return std::nullopt;
}

/// An error where one column is not as long as another.
[[nodiscard]] inline std::optional<DomainError> wrong_length(const std::string& field, Index length,
                                                             const std::string& other, Index expected) {
  if (length == expected) return std::nullopt;
  return DomainError{"number of " + field, static_cast<double>(length),
                     "must be that of " + other + ", " + std::to_string(expected)};
}

}  // namespace contact::component
