// What each shape is made of, described once: files, ids, columns, the C interface, errors and schemas follow from
// here.
#pragma once

#include <array>
#include <concepts>
#include <optional>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "contact/geometry.hpp"

namespace contact {

/// What a field of a shape is: a place in space, or a length, which is >= 0.
enum class FieldKind { point, length };

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

/// The description of a shape:
///   kName          its name in schemas and tables
///   kFields        its fields, in the order of the canonical bytes, of files and of the C interface
///   broken_rule    the first number that breaks a rule of the whole shape, `less` comparing two numbers
///   break_a_rule   spoils the shape at the number of that index, for questions that must be refused
template <class Shape>
struct ShapeDescription;

template <>
struct ShapeDescription<Ball> {
  static constexpr std::string_view kName = "sphere";
  static constexpr std::tuple kFields{ShapeField<Ball, Vector3>{"center", &Ball::center, FieldKind::point},
                                      ShapeField<Ball, double>{"radius", &Ball::radius, FieldKind::length}};
  template <class Less>
  static std::optional<BrokenRule> broken_rule(const Ball& /*ball*/, Less /*less*/) {
    return std::nullopt;
  }
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
struct ShapeDescription<Capsule> {
  static constexpr std::string_view kName = "capsule";
  static constexpr std::tuple kFields{ShapeField<Capsule, Vector3>{"start", &Capsule::start, FieldKind::point},
                                      ShapeField<Capsule, Vector3>{"end", &Capsule::end, FieldKind::point},
                                      ShapeField<Capsule, double>{"radius", &Capsule::radius, FieldKind::length}};
  template <class Less>
  static std::optional<BrokenRule> broken_rule(const Capsule& /*capsule*/, Less /*less*/) {
    return std::nullopt;
  }
  static void break_a_rule(Capsule& capsule, int /*number*/, double amount) { capsule.radius = -amount; }
};

template <class Shape>
concept DescribedShape = requires {
  ShapeDescription<std::remove_const_t<Shape>>::kFields;
};

/// Calls visit(field, value&) for every field of a shape, in order.
template <DescribedShape Shape, class Visit>
constexpr void for_each_field(Shape& shape, Visit&& visit) {
  std::apply([&](const auto&... field) { (visit(field, shape.*field.member), ...); },
             ShapeDescription<std::remove_const_t<Shape>>::kFields);
}

/// The names of a shape's fields, in order.
template <class Shape>
inline constexpr auto kFieldNames =
    std::apply([](const auto&... field) { return std::array<std::string_view, sizeof...(field)>{field.name...}; },
               ShapeDescription<Shape>::kFields);

/// How many numbers a shape has.
template <class Shape>
inline constexpr int kNumbersOf =
    std::apply([](const auto&... field) { return (0 + ... + (field.kind == FieldKind::length ? 1 : 3)); },
               ShapeDescription<Shape>::kFields);

/// A shape all of whose numbers are 0.
template <class Shape>
[[nodiscard]] Shape zero_shape() {
  Shape shape;
  for_each_field(shape, [](const auto& /*field*/, auto& value) {
    if constexpr (std::same_as<std::remove_reference_t<decltype(value)>, double>)
      value = 0;
    else
      value.setZero();
  });
  return shape;
}

/// Calls visit(number&) for every number of a shape, in the canonical order.
template <DescribedShape Shape, class Visit>
void for_each_number(Shape& shape, Visit&& visit) {
  for_each_field(shape, [&](const auto& /*field*/, auto& value) {
    if constexpr (std::same_as<std::remove_cvref_t<decltype(value)>, double>)
      visit(value);
    else
      for (int axis = 0; axis < 3; ++axis) visit(value[axis]);
  });
}

}  // namespace contact
