// The input domain: what every boundary that data enters by asks before a kernel, which states it and checks nothing.
#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "contact/geometry.hpp"

namespace contact {

/// A number outside the domain: the field's path (such as `center[1]`), its value and the rule that it breaks.
struct DomainError {
  std::string field;
  double value;
  std::string rule;
};

/// The first rule that a length (radius, alarm or contact distance) breaks, or nothing.
[[nodiscard]] inline std::optional<DomainError> outside_domain(const std::string& field, double length) {
  if (!std::isfinite(length)) return DomainError{field, length, "must be finite"};
  if (length < 0) return DomainError{field, length, "must not be negative"};
  return std::nullopt;
}

/// The first non-finite coordinate, or nothing.
[[nodiscard]] inline std::optional<DomainError> outside_domain(const std::string& field, const Vector3& point) {
  for (int axis = 0; axis < 3; ++axis)
    if (!std::isfinite(point[axis]))
      return DomainError{field + "[" + std::to_string(axis) + "]", point[axis], "must be finite"};
  return std::nullopt;
}

[[nodiscard]] inline std::optional<DomainError> outside_domain(const std::string& field, const Ball& ball) {
  if (auto error = outside_domain(field + ".center", ball.center)) return error;
  return outside_domain(field + ".radius", ball.radius);
}

[[nodiscard]] inline std::optional<DomainError> outside_domain(const std::string& field, const Box& box) {
  if (auto error = outside_domain(field + ".min", box.min)) return error;
  if (auto error = outside_domain(field + ".max", box.max)) return error;
  for (int axis = 0; axis < 3; ++axis)
    if (box.min[axis] > box.max[axis])
      return DomainError{field + ".min[" + std::to_string(axis) + "]", box.min[axis], "must not exceed max"};
  return std::nullopt;
}

[[nodiscard]] inline std::optional<DomainError> outside_domain(Distances distances) {
  if (auto error = outside_domain("alarm", distances.alarm)) return error;
  return outside_domain("contact", distances.contact);
}

}  // namespace contact
