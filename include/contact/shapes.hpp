// What each shape is made of, described once: files, ids, columns, the C interface, errors and schemas follow from
// here.
#pragma once

#include <array>
#include <concepts>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "contact/geometry.hpp"

namespace contact::inline CONTACT_ABI {

/// What a field of a shape is: a place in space, or several; a length, or three, which are >= 0; a direction, which
/// is not zero and whose own length says nothing; how far along a direction something lies, of either sign; or how a
/// shape is turned, a quaternion, which is not zero and whose own length says nothing.
enum class FieldKind { point, length, direction, offset, orientation };
inline constexpr std::array<std::string_view, 5> kFieldKindNames{"point", "length", "direction", "offset",
                                                                 "orientation"};
/// Whether what a field says does not change with its length, and 0 says nothing.
[[nodiscard]] constexpr bool has_free_length(FieldKind kind) {
  return kind == FieldKind::direction || kind == FieldKind::orientation;
}

/// A field of a shape: its name in files, where it stands in the struct, and what it is.
template <class Shape, class Value>
struct ShapeField {
  std::string_view name;
  Value Shape::*member;
  FieldKind kind;
};

/// A number that breaks a rule of the whole shape, beyond what the kinds of its fields ask for.
struct BrokenRule {
  std::string_view field;
  int axis;
  std::string_view rule;
};

template <class Shape, class... Shapes>
inline constexpr bool kIsOneOf = (std::same_as<Shape, Shapes> || ...);

/// The description of a shape:
///   kName          its name in schemas and tables
///   kFields        its fields, in the order of the canonical bytes, of files and of the C interface
///   broken_rule    the first number that breaks a rule of the whole shape, `less` comparing two numbers
///   break_a_rule   spoils the shape at the number of that index, for questions that must be refused
template <class Shape>
struct ShapeDescription;

/// A shape of which no rule is of the whole, and perhaps none but that every number is finite.
template <class Shape>
struct AnyNumbers {
  template <class Less>
  static std::optional<BrokenRule> broken_rule(const Shape& /*shape*/, Less /*less*/) {
    return std::nullopt;
  }
  static void break_a_rule(Shape& shape, int number, double /*amount*/) {
    for_each_number(shape, [&](double& x) {
      if (number-- == 0) x = std::numeric_limits<double>::infinity();
    });
  }
};

template <>
struct ShapeDescription<Ball> : AnyNumbers<Ball> {
  static constexpr std::string_view kName = "sphere";
  static constexpr std::tuple kFields{ShapeField<Ball, Vector3>{"center", &Ball::center, FieldKind::point},
                                      ShapeField<Ball, double>{"radius", &Ball::radius, FieldKind::length}};
  static void break_a_rule(Ball& ball, int /*number*/, double amount) { ball.radius = -amount; }
};

template <>
struct ShapeDescription<Box> {
  static constexpr std::string_view kName = "cube";
  static constexpr std::tuple kFields{ShapeField<Box, Vector3>{"min", &Box::min, FieldKind::point},
                                      ShapeField<Box, Vector3>{"max", &Box::max, FieldKind::point}};
  template <class Less>
  static std::optional<BrokenRule> broken_rule(const Box& box, Less less) {
    for (int axis = 0; axis < 3; ++axis)
      if (less(box.max[axis], box.min[axis])) return BrokenRule{"min", axis, "must not exceed max"};
    return std::nullopt;
  }
  static void break_a_rule(Box& box, int number, double /*amount*/) {
    std::swap(box.min[number % 3], box.max[number % 3]);
  }
};

template <>
struct ShapeDescription<Capsule> : AnyNumbers<Capsule> {
  static constexpr std::string_view kName = "capsule";
  static constexpr std::tuple kFields{ShapeField<Capsule, Vector3>{"start", &Capsule::start, FieldKind::point},
                                      ShapeField<Capsule, Vector3>{"end", &Capsule::end, FieldKind::point},
                                      ShapeField<Capsule, double>{"radius", &Capsule::radius, FieldKind::length}};
  static void break_a_rule(Capsule& capsule, int /*number*/, double amount) { capsule.radius = -amount; }
};

template <>
struct ShapeDescription<Plane> : AnyNumbers<Plane> {
  static constexpr std::string_view kName = "plane";
  static constexpr std::tuple kFields{ShapeField<Plane, Vector3>{"normal", &Plane::normal, FieldKind::direction},
                                      ShapeField<Plane, double>{"offset", &Plane::offset, FieldKind::offset}};
  static void break_a_rule(Plane& plane, int /*number*/, double /*amount*/) { plane.normal.setZero(); }
};

template <>
struct ShapeDescription<Triangle> : AnyNumbers<Triangle> {
  static constexpr std::string_view kName = "triangle";
  static constexpr std::tuple kFields{
      ShapeField<Triangle, std::array<Vector3, 3>>{"vertices", &Triangle::vertices, FieldKind::point}};
};

template <>
struct ShapeDescription<Obb> : AnyNumbers<Obb> {
  static constexpr std::string_view kName = "obb";
  static constexpr std::tuple kFields{
      ShapeField<Obb, Vector3>{"center", &Obb::center, FieldKind::point},
      ShapeField<Obb, Quaternion>{"orientation", &Obb::orientation, FieldKind::orientation},
      ShapeField<Obb, Vector3>{"extents", &Obb::extents, FieldKind::length}};
  static void break_a_rule(Obb& obb, int number, double amount) {
    if (number < 7)
      obb.orientation.fill(0);
    else
      obb.extents[number - 7] = -amount;
  }
};

template <>
struct ShapeDescription<Hull> : AnyNumbers<Hull> {
  static constexpr std::string_view kName = "hull";
  static constexpr std::tuple kFields{
      ShapeField<Hull, std::vector<Vector3>>{"vertices", &Hull::vertices, FieldKind::point},
      ShapeField<Hull, double>{"radius", &Hull::radius, FieldKind::length}};
  static void break_a_rule(Hull& hull, int /*number*/, double amount) { hull.radius = -amount; }
};

template <>
struct ShapeDescription<Ray> : AnyNumbers<Ray> {
  static constexpr std::string_view kName = "ray";
  static constexpr std::tuple kFields{ShapeField<Ray, Vector3>{"origin", &Ray::origin, FieldKind::point},
                                      ShapeField<Ray, Vector3>{"direction", &Ray::direction, FieldKind::direction},
                                      ShapeField<Ray, double>{"length", &Ray::length, FieldKind::length}};
  static void break_a_rule(Ray& ray, int number, double amount) {
    if (number < 6)
      ray.direction.setZero();
    else
      ray.length = -amount;
  }
};

/// A ray, in a type of its own.
template <>
struct ShapeDescription<Cast> : ShapeDescription<Ray> {};

template <>
struct ShapeDescription<Line> : AnyNumbers<Line> {
  static constexpr std::string_view kName = "line";
  static constexpr std::tuple kFields{ShapeField<Line, Vector3>{"start", &Line::start, FieldKind::point},
                                      ShapeField<Line, Vector3>{"end", &Line::end, FieldKind::point}};
};

/// A field of several vectors: an array, or a span of one, has as many as its shape; of a std::vector a question says how many.
template <class Value>
concept SeveralVectors = std::same_as<typename std::remove_cvref_t<Value>::value_type, Vector3>;
template <class Value>
concept AnyNumberOfVectors = std::same_as<std::remove_cvref_t<Value>, std::vector<Vector3>>;
/// What a field may hold.
template <class Value>
concept FieldValue = SeveralVectors<Value> ||(kIsOneOf<std::remove_const_t<Value>, double, Vector3, Quaternion>);

/// Calls visit(vector&) for every vector of a field: none of a number or a quaternion.
template <FieldValue Value, class Visit>
constexpr void for_each_vector(Value& value, Visit&& visit) {
  if constexpr (SeveralVectors<Value>)
    for (auto& v : value) visit(v);
  else if constexpr (std::same_as<std::remove_const_t<Value>, Vector3>)
    visit(value);
}

/// Calls visit(number&) for every number of a field.
template <FieldValue Value, class Visit>
constexpr void for_each_number_in(Value& value, Visit&& visit) {
  using Plain = std::remove_const_t<Value>;
  if constexpr (std::same_as<Plain, double>) {
    visit(value);
  } else if constexpr (std::same_as<Plain, Quaternion>) {
    for (auto& x : value) visit(x);
  } else {
    for_each_vector(value, [&](auto& v) {
      for (int axis = 0; axis < 3; ++axis) visit(v[axis]);
    });
  }
}

/// Where the k-th number of a field stands in it: nothing for a number, [1] in a vector or a quaternion, [2][1] in several
/// vectors.
template <class Value>
[[nodiscard]] std::string place_in(const Value& /*value*/, int k) {
  if constexpr (std::same_as<Value, double>)
    return "";
  else if constexpr (std::same_as<Value, Vector3> || std::same_as<Value, Quaternion>)
    return "[" + std::to_string(k) + "]";
  else
    return "[" + std::to_string(k / 3) + "][" + std::to_string(k % 3) + "]";
}

template <class Shape>
concept DescribedShape = requires {
  ShapeDescription<std::remove_const_t<Shape>>::kFields;
};
/// One that the pair says the shape of.
template <class Shape>
concept AnyConvex = std::same_as<std::remove_const_t<Shape>, Convex>;
template <class Shape>
concept AShape = DescribedShape<Shape> || AnyConvex<Shape>;

/// Calls visit(field, value&) for every field of a shape, in order.
template <DescribedShape Shape, class Visit>
constexpr void for_each_field(Shape& shape, Visit&& visit) {
  std::apply([&](const auto&... field) { (visit(field, shape.*field.member), ...); },
             ShapeDescription<std::remove_const_t<Shape>>::kFields);
}
template <AnyConvex Shape, class Visit>
constexpr void for_each_field(Shape& convex, Visit&& visit) {
  std::visit([&](auto& shape) { for_each_field(shape, visit); }, convex.shape);
}

/// Calls visit(point&) for every point that a shape is given by, in order.
template <AShape Shape, class Visit>
constexpr void for_each_point(Shape& shape, Visit&& visit) {
  for_each_field(shape, [&](const auto& field, auto& value) {
    if (field.kind == FieldKind::point) for_each_vector(value, visit);
  });
}

/// The names of a shape's fields, in order.
template <class Shape>
inline constexpr auto kFieldNames =
    std::apply([](const auto&... field) { return std::array<std::string_view, sizeof...(field)>{field.name...}; },
               ShapeDescription<Shape>::kFields);
template <DescribedShape Shape>
[[nodiscard]] constexpr std::span<const std::string_view> field_names_of(const Shape& /*shape*/) {
  return kFieldNames<Shape>;
}
[[nodiscard]] constexpr std::span<const std::string_view> field_names_of(const Convex& convex) {
  return std::visit([](const auto& shape) { return field_names_of(shape); }, convex.shape);
}

/// How many numbers a shape has; of a hull and of one that the pair says, the most that it may have.
template <class Shape>
inline constexpr int kNumbersOf = std::apply(
    [](const auto&... field) { return (0 + ... + static_cast<int>(sizeof(Shape{}.*field.member) / sizeof(double))); },
    ShapeDescription<Shape>::kFields);
template <>
inline constexpr int kNumbersOf<Hull> = 3 * static_cast<int>(kMostVertices) + 1;
template <>
inline constexpr int kNumbersOf<Convex> = kNumbersOf<Hull>;

/// Calls visit(number&) for every number of a shape, in the canonical order.
template <AShape Shape, class Visit>
void for_each_number(Shape& shape, Visit&& visit) {
  for_each_field(shape, [&](const auto& /*field*/, auto& value) { for_each_number_in(value, visit); });
}

/// A shape all of whose numbers are 0; of a hull, so many vertices.
template <class Shape>
[[nodiscard]] Shape zero_shape(std::size_t vertices = 1) {
  Shape shape;
  if constexpr (std::same_as<Shape, Hull>) shape.vertices.resize(vertices);
  for_each_number(shape, [](double& number) { number = 0; });
  return shape;
}

}  // namespace contact::inline CONTACT_ABI
