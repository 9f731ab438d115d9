// A shape as the exact and the interval oracle see it: its core, which is the convex hull of some points, blown up by a radius. Where the vertices of
// each shape are, and which of them an edge or a face lies between, is said here alone.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "contact/pairs.hpp"
#include "oracle/truth/hull.hpp"

namespace contact::oracle {

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
  /// Where the features stand of a core that has its own.
  std::shared_ptr<const std::vector<Feature>> own = {};

  /// Those that `outward` has a normal of.
  [[nodiscard]] std::span<const Feature> faces() const { return features.last(outward.size()); }
  /// All of a dimension; of edges or faces of a box that are parallel, the one at its first corner.
  [[nodiscard]] std::vector<const Feature*> features_of(std::size_t dimension) const {
    const bool is_box = features.back().is_parallelogram();
    std::vector<const Feature*> all;
    for (const Feature& feature : features)
      if (feature.dimension() == dimension && (!is_box || feature.has(0))) all.push_back(&feature);
    return all;
  }
};

/// Whether the rules of `docs/specification.md#any-two-convex-shapes` are not asked for: of a point and anything, or two segments.
/// Between others an edge can cross a face, and a depth can be a root.
template <class A, class B>
inline constexpr bool kCoresAreSimple = std::same_as<A, Ball> ||
                                        (kIsOneOf<A, Capsule, Ray, Line> && kIsOneOf<B, Ball, Capsule, Ray, Line>);

// The core of each shape. make(x) is the number that a double is.

template <class Make>
using NumberOf = decltype(std::declval<Make>()(0.0));
template <class Make>
using CoreBy = Core<NumberOf<Make>>;

template <class Make>
typename CoreBy<Make>::Vec vec(const Make& make, const Vector3& v) {
  return {make(v[0]), make(v[1]), make(v[2])};
}

template <class Make, class Shape>
std::vector<typename CoreBy<Make>::Vec> points_of(const Make& make, const Shape& shape) {
  std::vector<typename CoreBy<Make>::Vec> points;
  for_each_point(shape, [&](const Vector3& x) { points.push_back(vec(make, x)); });
  return points;
}

/// Of a shape that is given by the vertices of a simplex.
template <class Make, class Shape>
requires kIsOneOf<Shape, Ball, Capsule, Line, Triangle> CoreBy<Make> core_of(const Make& make, const Shape& shape) {
  auto points = points_of(make, shape);
  const auto all = features::of_simplex(points.size());
  return {std::move(points), all, radius_of(shape)};
}
template <class Make>
CoreBy<Make> core_of(const Make& make, const Ray& ray) {
  const auto length = make(ray.length);
  const auto end = [&](Eigen::Index i) { return make(ray.origin[i]) + length * make(ray.direction[i]); };
  return {{vec(make, ray.origin), {end(0), end(1), end(2)}}, features::kSegment};
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

/// The hull of some points; `sign` is that of HullMaker.
template <class Number, class Sign>
Core<Number> core_of_points(const std::vector<std::array<Number, 3>>& points, double radius, const Sign& sign) {
  HullFeatures hull = HullMaker(points.size(), sign).make();
  Core<Number> core{{}, {}, radius};
  for (const std::size_t k : hull.corners) core.vertices.push_back(points[k]);
  core.own = std::make_shared<const std::vector<Feature>>(std::move(hull.features));
  core.features = *core.own;
  for (const Feature& face : core.features.last(hull.faces))
    core.outward.push_back(area_between(core.vertices, face.places[0], face.places[1], face.places[2]));
  return core;
}

}  // namespace contact::oracle
