// The input domain. Every place where data enter the project checks it here; the kernels state it and check nothing.
//
// Everything here is inline, so it is compiled with the caller's flags. -ffast-math lets a compiler assume that every
// number is finite, flushing turns negative subnormal numbers into zero, and a comparison with NaN may trap. So the
// functions look at the bits of the numbers, which none of these changes.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "contact/shapes.hpp"

namespace contact::inline CONTACT_ABI {

/// Neither infinite nor NaN, whatever the compiler may assume.
[[nodiscard]] constexpr bool is_finite_by_bits(double x) {
  return (std::bit_cast<std::uint64_t>(x) >> 52 & 0x7ff) != 0x7ff;
}

/// a < b, in every floating-point environment and without an exception. Domain: neither is NaN.
[[nodiscard]] constexpr bool is_less_by_bits(double a, double b) {
  const auto ordered = [](double x) {  // integers in the order of the numbers; both zeros are 0
    const auto bits = std::bit_cast<std::int64_t>(x);
    return bits < 0 ? std::numeric_limits<std::int64_t>::min() - bits : bits;
  };
  return ordered(a) < ordered(b);
}

/// A number outside the domain: the field's path (such as `center[1]`), its value and the rule that it breaks.
struct DomainError {
  std::string field;
  double value;
  std::string rule;
};

/// The first rule that a length (radius, alarm or contact distance) breaks, or nothing.
[[nodiscard]] inline std::optional<DomainError> outside_domain(const std::string& field, double length) {
  if (!is_finite_by_bits(length)) return DomainError{field, length, "must be finite"};
  if (is_less_by_bits(length, 0)) return DomainError{field, length, "must not be negative"};
  return std::nullopt;
}

/// The first non-finite coordinate, or nothing.
[[nodiscard]] inline std::optional<DomainError> outside_domain(const std::string& field, const Vector3& point) {
  for (int axis = 0; axis < 3; ++axis)
    if (!is_finite_by_bits(point[axis]))
      return DomainError{field + place_in(point, axis), point[axis], "must be finite"};
  return std::nullopt;
}

/// Zero of either sign, in every floating-point environment.
[[nodiscard]] constexpr bool is_zero_by_bits(double x) { return std::bit_cast<std::uint64_t>(x) << 1 == 0; }

/// The first rule that a field of a shape breaks, or nothing.
template <class Value>
[[nodiscard]] std::optional<DomainError> outside_domain(const std::string& path, const Value& value, FieldKind kind) {
  std::optional<DomainError> error;
  bool is_zero = true;
  int k = 0;
  if constexpr (AnyNumberOfVectors<Value>)
    if (value.empty() || value.size() > kMostVertices)
      return DomainError{path, static_cast<double>(value.size()), "must be from 1 to 64 points"};
  for_each_number_in(value, [&](const double& number) {
    if (!error && !is_finite_by_bits(number)) error = DomainError{path + place_in(value, k), number, "must be finite"};
    if (!error && kind == FieldKind::length) error = outside_domain(path + place_in(value, k), number);
    is_zero = is_zero && is_zero_by_bits(number);
    ++k;
  });
  if (!error && has_free_length(kind) && is_zero)
    error = DomainError{path, 0, kind == FieldKind::direction ? "must not be the zero vector" : "must not be all zero"};
  return error;
}

/// The first number of a shape that breaks a rule: those of its fields, then those of the whole.
template <DescribedShape Shape>
[[nodiscard]] std::optional<DomainError> outside_domain(const std::string& path, const Shape& shape) {
  std::optional<DomainError> error;
  for_each_field(shape, [&](const auto& field, const auto& value) {
    if (!error) error = outside_domain(path + "." + std::string(field.name), value, field.kind);
  });
  if (error) return error;
  if (const auto broken = ShapeDescription<Shape>::broken_rule(shape, is_less_by_bits))
    for_each_field(shape, [&](const auto& field, const auto& value) {
      if constexpr (std::same_as<std::remove_cvref_t<decltype(value)>, Vector3>)
        if (field.name == broken->field)
          error = DomainError{path + "." + std::string(field.name) + "[" + std::to_string(broken->axis) + "]",
                              value[broken->axis], std::string(broken->rule)};
    });
  return error;
}

/// Whether there is no such number, without the words of an error.
template <DescribedShape Shape>
[[nodiscard]] bool inside_domain(const Shape& shape) {
  bool inside = true;
  for_each_field(shape, [&](const auto& field, const auto& value) {
    bool is_zero = true;
    if constexpr (AnyNumberOfVectors<decltype(value)>)
      inside = inside && !value.empty() && value.size() <= kMostVertices;
    for_each_number_in(value, [&](const double& x) {
      inside = inside && is_finite_by_bits(x) && !(field.kind == FieldKind::length && is_less_by_bits(x, 0));
      is_zero = is_zero && is_zero_by_bits(x);
    });
    inside = inside && !(has_free_length(field.kind) && is_zero);
  });
  return inside && !ShapeDescription<Shape>::broken_rule(shape, is_less_by_bits);
}
[[nodiscard]] inline std::optional<DomainError> outside_domain(const std::string& path, const Convex& convex) {
  return std::visit([&](const auto& shape) { return outside_domain(path, shape); }, convex.shape);
}
[[nodiscard]] inline bool inside_domain(const Convex& convex) {
  return std::visit([](const auto& shape) { return inside_domain(shape); }, convex.shape);
}

[[nodiscard]] inline std::optional<DomainError> outside_domain(Distances distances) {
  if (auto error = outside_domain("alarm", distances.alarm)) return error;
  return outside_domain("contact", distances.contact);
}

}  // namespace contact::inline CONTACT_ABI
