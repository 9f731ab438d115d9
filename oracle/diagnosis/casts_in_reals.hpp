// Rays that are cast, in plain arithmetic of any format: the formulas that people write.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "contact/pairs.hpp"

namespace contact::oracle {

/// The line of a ray, and a shape that it may go through. Sums and products in the order that is written here.
template <class Real, class Shape>
struct CastInPlain {
  using Vector = std::array<Real, 3>;

  Vector o;
  Vector d;
  Real length;
  const Shape& shape;

  explicit CastInPlain(const CastAt<Shape>& shapes)
      : o(in_plain(shapes.a.origin)),
        d(in_plain(shapes.a.direction)),
        length(static_cast<Real>(shapes.a.length)),
        shape(shapes.b) {}

  static Vector in_plain(const Vector3& v) {
    return {static_cast<Real>(v[0]), static_cast<Real>(v[1]), static_cast<Real>(v[2])};
  }
  static Vector moved(const Vector& from, Real t, const Vector& v) {
    return {from[0] + t * v[0], from[1] + t * v[1], from[2] + t * v[2]};
  }
  static Vector minus(const Vector& v, const Vector& w) { return {v[0] - w[0], v[1] - w[1], v[2] - w[2]}; }
  static Vector divided(const Vector& v, Real by) { return {v[0] / by, v[1] / by, v[2] / by}; }
  static Real dot(const Vector& v, const Vector& w) { return v[0] * w[0] + v[1] * w[1] + v[2] * w[2]; }
  static Vector cross(const Vector& v, const Vector& w) {
    return {v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2], v[0] * w[1] - v[1] * w[0]};
  }

  [[nodiscard]] Vector at(Real t) const { return moved(o, t, d); }
  [[nodiscard]] Real speed() const { return std::sqrt(dot(d, d)); }
  /// Where the line enters the shape, also before the origin.
  [[nodiscard]] std::optional<Real> first() const { return enter(shape, d); }
  /// And where it leaves it.
  [[nodiscard]] std::optional<Real> last() const {
    const auto t = enter(shape, moved({}, Real{-1}, d));
    return t ? std::optional(-*t) : std::nullopt;
  }
  [[nodiscard]] bool begins_inside() const { return contains(shape); }
  [[nodiscard]] Vector normal(Real t) const {
    if constexpr (std::same_as<Shape, Box>)
      for (std::size_t i = 0; i < 3; ++i) {
        const bool upward = d[i] > 0;
        if (d[i] != 0 && (in_plain(upward ? shape.min : shape.max)[i] - o[i]) / d[i] == t) {
          Vector n{};
          n[i] = upward ? Real{-1} : Real{1};
          return n;
        }
      }
    return normal(shape, at(t));
  }

 private:
  /// The quadratic formula.
  static std::optional<Real> enter_sphere(const Vector& w, const Vector& way, Real radius) {
    const Real a = dot(way, way);
    const Real b = dot(w, way);
    const Real h = b * b - a * (dot(w, w) - radius * radius);
    if (!(h >= 0)) return std::nullopt;
    return (-b - std::sqrt(h)) / a;
  }
  [[nodiscard]] std::optional<Real> enter(const Ball& ball, const Vector& way) const {
    return enter_sphere(minus(o, in_plain(ball.center)), way, static_cast<Real>(ball.radius));
  }
  [[nodiscard]] bool contains(const Ball& ball) const {
    const Vector w = minus(o, in_plain(ball.center));
    return dot(w, w) <= static_cast<Real>(ball.radius) * static_cast<Real>(ball.radius);
  }
  static Vector normal(const Ball& ball, const Vector& x) {
    return divided(minus(x, in_plain(ball.center)), static_cast<Real>(ball.radius));
  }

  /// The cylinder, then the sphere around the end that the line enters it beside.
  [[nodiscard]] std::optional<Real> enter(const Capsule& capsule, const Vector& way) const {
    const auto radius = static_cast<Real>(capsule.radius);
    const Vector start = in_plain(capsule.start);
    const Vector end = in_plain(capsule.end);
    const Vector u = minus(end, start);
    const Vector w = minus(o, start);
    const Real uu = dot(u, u);
    const Real ud = dot(u, way);
    const Real uw = dot(u, w);
    const Real a = uu * dot(way, way) - ud * ud;
    const Real b = uu * dot(way, w) - uw * ud;
    const Real c = uu * dot(w, w) - uw * uw - radius * radius * uu;
    const Real h = b * b - a * c;
    if (!(h >= 0)) return std::nullopt;
    Real level = ud > 0 ? Real{-1} : uu + 1;  // along the axis: the end that comes first
    if (a > 0) {
      const Real t = (-b - std::sqrt(h)) / a;
      level = uw + t * ud;
      if (level >= 0 && level <= uu) return t;
    }
    return enter_sphere(level < 0 ? w : minus(o, end), way, radius);
  }
  static Real part_of(const Capsule& capsule, const Vector& x) {
    const Vector u = minus(in_plain(capsule.end), in_plain(capsule.start));
    const Real uu = dot(u, u);
    const Real part = uu > 0 ? dot(minus(x, in_plain(capsule.start)), u) / uu : Real{0};
    return std::min(std::max(part, Real{0}), Real{1});
  }
  static Vector from_axis(const Capsule& capsule, const Vector& x) {
    const Vector start = in_plain(capsule.start);
    return minus(x, moved(start, part_of(capsule, x), minus(in_plain(capsule.end), start)));
  }
  [[nodiscard]] bool contains(const Capsule& capsule) const {
    const Vector w = from_axis(capsule, o);
    return dot(w, w) <= static_cast<Real>(capsule.radius) * static_cast<Real>(capsule.radius);
  }
  static Vector normal(const Capsule& capsule, const Vector& x) {
    return divided(from_axis(capsule, x), static_cast<Real>(capsule.radius));
  }

  /// Slabs.
  [[nodiscard]] std::optional<Real> enter(const Box& box, const Vector& way) const {
    Real in = -std::numeric_limits<Real>::infinity();
    Real out = std::numeric_limits<Real>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
      const Real first = (in_plain(box.min)[i] - o[i]) / way[i];
      const Real second = (in_plain(box.max)[i] - o[i]) / way[i];
      in = std::max(in, std::min(first, second));
      out = std::min(out, std::max(first, second));
    }
    return in <= out ? std::optional(in) : std::nullopt;
  }
  [[nodiscard]] bool contains(const Box& box) const {
    const Vector low = in_plain(box.min);
    const Vector high = in_plain(box.max);
    bool inside = true;
    for (std::size_t i = 0; i < 3; ++i) inside = inside && low[i] <= o[i] && o[i] <= high[i];
    return inside;
  }
  /// Of the nearest face, where the ray does not come in.
  static Vector normal(const Box& box, const Vector& x) {
    const Vector low = in_plain(box.min);
    const Vector high = in_plain(box.max);
    Vector n{};
    Real least = std::numeric_limits<Real>::infinity();
    for (std::size_t i = 0; i < 3; ++i)
      for (const Real side : {Real{1}, Real{-1}}) {
        const Real off = std::abs(side > 0 ? high[i] - x[i] : x[i] - low[i]);
        if (!(off < least)) continue;
        least = off;
        n = {};
        n[i] = side;
      }
    return n;
  }

  /// T. Moller, B. Trumbore, Fast, Minimum Storage Ray/Triangle Intersection (1997), without its epsilon.
  [[nodiscard]] std::optional<Real> enter(const Triangle& triangle, const Vector& way) const {
    const Vector v0 = in_plain(triangle.vertices[0]);
    const Vector u = minus(in_plain(triangle.vertices[1]), v0);
    const Vector v = minus(in_plain(triangle.vertices[2]), v0);
    const Vector across = cross(way, v);
    const Real determinant = dot(u, across);
    if (determinant == 0) return std::nullopt;
    const Vector w = minus(o, v0);
    const Real first = dot(w, across) / determinant;
    if (!(first >= 0 && first <= 1)) return std::nullopt;
    const Vector turned = cross(w, u);
    const Real second = dot(way, turned) / determinant;
    if (!(second >= 0 && first + second <= 1)) return std::nullopt;
    return dot(v, turned) / determinant;
  }
  [[nodiscard]] bool contains(const Triangle& triangle) const { return enter(triangle, d) == Real{0}; }
  static Vector normal(const Triangle& triangle, const Vector& /*x*/) {
    const Vector v0 = in_plain(triangle.vertices[0]);
    const Vector n = cross(minus(in_plain(triangle.vertices[1]), v0), minus(in_plain(triangle.vertices[2]), v0));
    return divided(n, std::sqrt(dot(n, n)));
  }

  [[nodiscard]] std::optional<Real> enter(const Plane& plane, const Vector& way) const {
    const Vector n = in_plain(plane.normal);
    const Real rise = dot(n, way);
    if (!(rise < 0)) return std::nullopt;
    return (static_cast<Real>(plane.offset) - dot(n, o)) / rise;
  }
  [[nodiscard]] bool contains(const Plane& plane) const {
    return dot(in_plain(plane.normal), o) <= static_cast<Real>(plane.offset);
  }
  static Vector normal(const Plane& plane, const Vector& /*x*/) {
    const Vector n = in_plain(plane.normal);
    return divided(n, std::sqrt(dot(n, n)));
  }
};

/// Calls work(cast in long double) of a question about one; else its result is nothing.
template <class Work>
auto of_cast(const Shapes& shapes, Work&& work) {
  using Result = std::invoke_result_t<Work&, CastInPlain<long double, Ball>>;
  return std::visit(
      [&]<class A, class B>(const Two<A, B>& two) -> Result {
        if constexpr (std::same_as<A, Cast>) return work(CastInPlain<long double, B>(two));
        return {};
      },
      shapes);
}

}  // namespace contact::oracle
