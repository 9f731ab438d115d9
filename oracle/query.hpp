// A question: pair kind, two shapes, alarm and contact distance. Plain data, shared by every floor.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "contact/domain.hpp"
#include "contact/geometry.hpp"

namespace contact {

enum class Pair { sphere_sphere, rigid_sphere_rigid_sphere, sphere_rigid_sphere, cube_cube };
inline constexpr std::array kPairs{Pair::sphere_sphere, Pair::rigid_sphere_rigid_sphere, Pair::sphere_rigid_sphere,
                                   Pair::cube_cube};

[[nodiscard]] constexpr std::string_view name(Pair pair) {
  switch (pair) {
    case Pair::sphere_sphere:
      return "sphere_sphere";
    case Pair::rigid_sphere_rigid_sphere:
      return "rigid_sphere_rigid_sphere";
    case Pair::sphere_rigid_sphere:
      return "sphere_rigid_sphere";
    case Pair::cube_cube:
      return "cube_cube";
  }
  return "";
}

/// The number format that answers are rounded to.
enum class Scalar { binary32, binary64 };
inline constexpr std::array kScalars{Scalar::binary64, Scalar::binary32};

[[nodiscard]] constexpr std::string_view name(Scalar scalar) {
  return scalar == Scalar::binary32 ? "binary32" : "binary64";
}

/// Radix 2, `precision` significant bits, normal numbers from 2^min_exponent, all numbers below 2^(max_exponent + 1).
struct Format {
  int precision;
  int min_exponent;
  int max_exponent;
};
[[nodiscard]] constexpr Format format_of(Scalar scalar) {
  return scalar == Scalar::binary32 ? Format{24, -126, 127} : Format{53, -1022, 1023};
}

struct Balls {
  Ball a;
  Ball b;
};
struct Boxes {
  Box a;
  Box b;
};

struct Query {
  Pair pair;
  std::variant<Balls, Boxes> shapes;
  Distances distances;

  [[nodiscard]] const Balls* balls() const { return std::get_if<Balls>(&shapes); }
  [[nodiscard]] const Boxes* boxes() const { return std::get_if<Boxes>(&shapes); }
  /// A rigid sphere reports its nearest surface point under upstream's convention, a deformable one its centre.
  [[nodiscard]] bool first_is_rigid() const { return pair == Pair::rigid_sphere_rigid_sphere; }
  [[nodiscard]] bool second_is_rigid() const { return pair != Pair::sphere_sphere; }
};

/// Calls visit("a.center[0]", value&) for every number of a question in the canonical order: a, b, alarm, contact.
template <class AnyQuery, class Visit>
requires std::same_as<std::remove_const_t<AnyQuery>, Query>
void for_each_number(AnyQuery& query, Visit&& visit) {
  const auto vector = [&](const std::string& field, auto& v) {
    for (int axis = 0; axis < 3; ++axis) visit(field + "[" + std::to_string(axis) + "]", v[axis]);
  };
  std::visit(
      [&](auto& shapes) {
        const auto shape = [&](const std::string& field, auto& s) {
          if constexpr (std::same_as<std::remove_cvref_t<decltype(s)>, Ball>) {
            vector(field + ".center", s.center);
            visit(field + ".radius", s.radius);
          } else {
            vector(field + ".min", s.min);
            vector(field + ".max", s.max);
          }
        };
        shape("a", shapes.a);
        shape("b", shapes.b);
      },
      query.shapes);
  visit(std::string("alarm"), query.distances.alarm);
  visit(std::string("contact"), query.distances.contact);
}

/// Whether every number of a question lies inside the domain.
[[nodiscard]] inline bool inside_domain(const Query& query) {
  const auto length = [](double x) { return std::isfinite(x) && x >= 0; };
  const auto shape = [&](const auto& s) {
    if constexpr (std::same_as<std::remove_cvref_t<decltype(s)>, Ball>)
      return s.center.allFinite() && length(s.radius);
    else
      return s.min.allFinite() && s.max.allFinite() && (s.min.array() <= s.max.array()).all();
  };
  return length(query.distances.alarm) && length(query.distances.contact) &&
         std::visit([&](const auto& shapes) { return shape(shapes.a) && shape(shapes.b); }, query.shapes);
}

/// The first number of a question that lies outside the domain, or nothing.
[[nodiscard]] inline std::optional<DomainError> outside_domain(const Query& query) {
  if (inside_domain(query)) return std::nullopt;
  return std::visit(
      [&](const auto& shapes) -> std::optional<DomainError> {
        if (auto error = outside_domain("a", shapes.a)) return error;
        if (auto error = outside_domain("b", shapes.b)) return error;
        return outside_domain(query.distances);
      },
      query.shapes);
}

}  // namespace contact
