// A shape as the exact and the interval oracle see it: its core, which is the convex hull of some points, blown up by a radius. Where the vertices of
// each shape are, and which of them an edge or a face lies between, is said here alone.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "contact/pairs.hpp"

namespace contact::oracle {

/// A vertex, an edge or a face of a core, by the places of its corners among the core's vertices: one of them, those next to it, and of a
/// parallelogram the one across.
struct Feature {
  std::size_t size;
  std::array<std::size_t, 4> places;

  [[nodiscard]] std::span<const std::size_t> corners() const { return std::span(places).first(size); }
  [[nodiscard]] std::size_t dimension() const { return std::min<std::size_t>(size - 1, 2); }
  [[nodiscard]] bool is_parallelogram() const { return size == 4; }
  [[nodiscard]] bool has(std::size_t vertex) const {
    return std::find(corners().begin(), corners().end(), vertex) != corners().end();
  }
};

/// Number is what an oracle computes with.
template <class Number>
struct Core {
  using Vec = std::array<Number, 3>;

  std::vector<Vec> vertices;
  std::span<const Feature> features;  ///< vertices before edges before faces
  double radius = 0;
  /// Of a core with an inside: a normal of each face that points out of it, of any length, in the order of `features`.
  std::vector<Vec> outward = {};
  /// What the vertices are still to be divided by, if by something.
  std::optional<Number> over = {};

  /// Those that `outward` has a normal of.
  [[nodiscard]] std::span<const Feature> faces() const { return features.last(outward.size()); }
  /// An edge of each direction: those of a box at its first corner, or all.
  [[nodiscard]] std::vector<Feature> directions() const {
    std::vector<Feature> all;
    for (const Feature& feature : features)
      if (feature.dimension() == 1 && (!features.back().is_parallelogram() || feature.has(0))) all.push_back(feature);
    return all;
  }
};

/// Whether the rules of `docs/specification.md#any-two-convex-shapes` are not asked for: of a point and anything, or two segments.
/// Between others an edge can cross a face, and a depth can be a root.
template <class A, class B>
inline constexpr bool kCoresAreSimple = std::same_as<A, Ball> ||
                                        (kIsOneOf<A, Capsule, Ray, Line> && kIsOneOf<B, Ball, Capsule, Ray, Line>);

namespace features {

constexpr Feature vertex(std::size_t v) { return {1, {v}}; }
constexpr Feature edge(std::size_t v, std::size_t w) { return {2, {v, w}}; }

inline constexpr std::array kPoint{vertex(0)};
inline constexpr std::array kSegment{vertex(0), vertex(1), edge(0, 1)};
inline constexpr std::array kTriangle{
    vertex(0), vertex(1), vertex(2), edge(0, 1), edge(1, 2), edge(2, 0), Feature{3, {0, 1, 2}}};
/// Bit i of a corner's place says whether it is at the upper end of axis i. Of the faces the lower one comes before the upper one.
inline constexpr std::array kBox = [] {
  std::array<Feature, 26> all{};
  std::size_t size = 0;
  for (std::size_t corner = 0; corner < 8; ++corner) all[size++] = vertex(corner);
  for (std::size_t axis = 1; axis < 8; axis *= 2)
    for (std::size_t corner = 0; corner < 8; ++corner)
      if ((corner & axis) == 0) all[size++] = edge(corner, corner | axis);
  for (std::size_t axis = 1; axis < 8; axis *= 2) {
    const std::size_t u = axis == 1 ? 2 : 1;
    const std::size_t v = axis == 4 ? 2 : 4;
    for (const std::size_t corner : {std::size_t{0}, axis})
      all[size++] = {4, {corner, corner | u, corner | v, corner | u | v}};
  }
  return all;
}();

}  // namespace features

// The core of each shape. make(x) is the number that a double is.

template <class Make>
using NumberOf = decltype(std::declval<Make>()(0.0));
template <class Make>
using CoreBy = Core<NumberOf<Make>>;

template <class Make>
typename CoreBy<Make>::Vec vec(const Make& make, const Vector3& v) {
  return {make(v[0]), make(v[1]), make(v[2])};
}

template <class Make>
CoreBy<Make> core_of(const Make& make, const Ball& ball) {
  return {{vec(make, ball.center)}, features::kPoint, ball.radius};
}
template <class Make>
CoreBy<Make> core_of(const Make& make, const Capsule& capsule) {
  return {{vec(make, capsule.start), vec(make, capsule.end)}, features::kSegment, capsule.radius};
}
template <class Make>
CoreBy<Make> core_of(const Make& make, const Ray& ray) {
  const auto length = make(ray.length);
  const auto end = [&](Eigen::Index i) { return make(ray.origin[i]) + length * make(ray.direction[i]); };
  return {{vec(make, ray.origin), {end(0), end(1), end(2)}}, features::kSegment};
}
template <class Make>
CoreBy<Make> core_of(const Make& make, const Line& line) {
  return {{vec(make, line.start), vec(make, line.end)}, features::kSegment};
}
template <class Make>
CoreBy<Make> core_of(const Make& make, const Triangle& triangle) {
  const auto& [v0, v1, v2] = triangle.vertices;
  return {{vec(make, v0), vec(make, v1), vec(make, v2)}, features::kTriangle};
}
template <class Make>
CoreBy<Make> core_of(const Make& make, const Box& box) {
  CoreBy<Make> core{{}, features::kBox};
  for (unsigned corner = 0; corner < 8; ++corner) {
    const auto at = [&](unsigned axis) { return (corner >> axis & 1U ? box.max : box.min)[axis]; };
    core.vertices.push_back(vec(make, {at(0), at(1), at(2)}));
  }
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) core.outward.push_back(vec(make, Vector3::Unit(axis) * side));
  return core;
}

/// The same box, with a quaternion of numbers near 1 where none is lost by that: it says the same at any length.
inline Obb with_short_orientation(const Obb& given) {
  Obb box = given;
  double largest = 0;
  for (const double x : given.orientation) largest = std::max(largest, std::abs(x));
  const int exponent = std::ilogb(largest);
  for (double& x : box.orientation) x = std::ldexp(x, -exponent);
  for (std::size_t i = 0; i < 4; ++i)
    if (std::ldexp(box.orientation[i], exponent) != given.orientation[i]) return given;
  return box;
}

/// |q|^2 times the matrix of a rotation: its columns; and |q|^2.
template <class Make>
CoreBy<Make> core_of(const Make& make, const Obb& box) {
  using Number = NumberOf<Make>;
  const Number x = make(box.orientation[0]);
  const Number y = make(box.orientation[1]);
  const Number z = make(box.orientation[2]);
  const Number w = make(box.orientation[3]);
  const Number two = make(2);
  const std::array<typename CoreBy<Make>::Vec, 3> columns{{
      {w * w + x * x - y * y - z * z, two * (x * y + w * z), two * (x * z - w * y)},
      {two * (x * y - w * z), w * w - x * x + y * y - z * z, two * (y * z + w * x)},
      {two * (x * z + w * y), two * (y * z - w * x), w * w - x * x - y * y + z * z},
  }};
  const Number over = w * w + x * x + y * y + z * z;
  CoreBy<Make> core{{}, features::kBox};
  for (unsigned corner = 0; corner < 8; ++corner) {
    auto at = vec(make, box.center);
    for (std::size_t i = 0; i < 3; ++i) {
      at[i] = over * at[i];
      for (unsigned axis = 0; axis < 3; ++axis)
        at[i] = at[i] + make((corner >> axis & 1U ? 1 : -1) * box.extents[axis]) * columns[axis][i];
    }
    core.vertices.push_back(at);
  }
  for (const auto& column : columns)
    for (const double side : {-1.0, 1.0})
      core.outward.push_back({make(side) * column[0], make(side) * column[1], make(side) * column[2]});
  core.over = over;
  return core;
}

}  // namespace contact::oracle
