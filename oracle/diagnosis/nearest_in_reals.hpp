// Nearest points in long double, for formulas that only have to come near what an engine said.
#pragma once

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "contact/pairs.hpp"

namespace contact::oracle {

using Real = long double;
using Numbers = std::array<Real, 3>;

/// The axis of a capsule, or a ray: from + t along for t from 0 to 1; of a sphere its centre.
struct AxisInReals {
  Numbers from{};
  Numbers along{};

  AxisInReals() = default;
  explicit AxisInReals(const Ball& ball) : from{ball.center[0], ball.center[1], ball.center[2]} {}
  explicit AxisInReals(const Capsule& capsule) : from{capsule.start[0], capsule.start[1], capsule.start[2]} {
    for (std::size_t i = 0; i < 3; ++i) along[i] = Real{capsule.end[static_cast<Eigen::Index>(i)]} - from[i];
  }
  explicit AxisInReals(const Ray& ray) : from{ray.origin[0], ray.origin[1], ray.origin[2]} {
    for (std::size_t i = 0; i < 3; ++i) along[i] = Real{ray.length} * ray.direction[static_cast<Eigen::Index>(i)];
  }

  [[nodiscard]] Numbers at(Real t) const {
    return {from[0] + t * along[0], from[1] + t * along[1], from[2] + t * along[2]};
  }
};

/// What is nearest to each other: the parameters on both axes. The middle where they are parallel side by side.
[[nodiscard]] inline std::array<Real, 2> nearest_parameters(const AxisInReals& first, const AxisInReals& second) {
  const auto dot = [](const Numbers& v, const Numbers& w) { return v[0] * w[0] + v[1] * w[1] + v[2] * w[2]; };
  const auto clamped = [](Real t) { return std::clamp(t, Real{0}, Real{1}); };
  const Numbers& u = first.along;
  const Numbers& v = second.along;
  const Numbers w{second.from[0] - first.from[0], second.from[1] - first.from[1], second.from[2] - first.from[2]};
  const Real A = dot(u, u);
  const Real B = dot(u, v);
  const Real E = dot(v, v);
  const Real C = dot(u, w);
  const Real F = dot(v, w);
  if (!(E > 0)) return {A > 0 ? clamped(C / A) : 0, 0};
  if (!(A > 0)) return {0, clamped(-F / E)};
  const Real det = A * E - B * B;
  Real s = clamped((C * E - B * F) / det);
  if (!(det > A * E * 1e-15L)) {  // as good as parallel
    const Real ends[2] = {C / A, (C + B) / A};
    const Real low = std::max(Real{0}, std::min(ends[0], ends[1]));
    const Real high = std::min(Real{1}, std::max(ends[0], ends[1]));
    s = clamped((low + high) / 2);
  }
  const Real free = (B * s - F) / E;
  const Real t = clamped(free);
  return {t == free ? s : clamped((B * t + C) / A), t};
}

/// A triangle seen from a point: the weights of its vertices in the point nearest to the origin of w.
[[nodiscard]] inline std::array<Real, 3> nearest_weights(const std::array<Numbers, 3>& w) {
  const auto dot = [](const Numbers& v, const Numbers& x) { return v[0] * x[0] + v[1] * x[1] + v[2] * x[2]; };
  const auto minus = [](const Numbers& v, const Numbers& x) { return Numbers{v[0] - x[0], v[1] - x[1], v[2] - x[2]}; };
  const auto cross = [](const Numbers& v, const Numbers& x) {
    return Numbers{v[1] * x[2] - v[2] * x[1], v[2] * x[0] - v[0] * x[2], v[0] * x[1] - v[1] * x[0]};
  };
  const Numbers n = cross(minus(w[1], w[0]), minus(w[2], w[0]));
  std::array<Real, 3> over_edge{};
  for (std::size_t k = 0; k < 3; ++k) over_edge[k] = dot(n, cross(w[k], w[(k + 1) % 3]));
  if (std::min({over_edge[0], over_edge[1], over_edge[2]}) > 0) {
    const Real all = over_edge[0] + over_edge[1] + over_edge[2];
    return {over_edge[1] / all, over_edge[2] / all, over_edge[0] / all};
  }
  std::array<Real, 3> best{};
  Real least = std::numeric_limits<Real>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    const Numbers u = minus(w[next], w[k]);
    const Real length2 = dot(u, u);
    const Real t = length2 > 0 ? std::clamp(-dot(w[k], u) / length2, Real{0}, Real{1}) : Real{0};
    const Numbers there{w[k][0] + t * u[0], w[k][1] + t * u[1], w[k][2] + t * u[2]};
    if (!(dot(there, there) < least)) continue;
    least = dot(there, there);
    best = {};
    best[k] = 1 - t;
    best[next] = t;
  }
  return best;
}

/// The points of the cores of two shapes that are nearest to each other.
template <class A, class B>
[[nodiscard]] std::array<Numbers, 2> nearest_in_reals(const Two<A, B>& shapes) {
  const AxisInReals first(shapes.a);
  const AxisInReals second(shapes.b);
  const auto [s, t] = nearest_parameters(first, second);
  return {first.at(s), second.at(t)};
}
[[nodiscard]] inline std::array<Numbers, 2> nearest_in_reals(const BallAndTriangle& shapes) {
  const Numbers c = AxisInReals(shapes.a).from;
  std::array<Numbers, 3> w;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < 3; ++i) w[k][i] = Real{shapes.b.vertices[k][static_cast<Eigen::Index>(i)]} - c[i];
  const std::array<Real, 3> weights = nearest_weights(w);
  Numbers q = c;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < 3; ++i) q[i] += weights[k] * w[k][i];
  return {c, q};
}

/// Where the line of a segment goes through the plane of a triangle.
struct CrossingInReals {
  using Vector = Eigen::Matrix<Real, 3, 1>;

  std::array<Vector, 3> v;
  Vector start;
  Vector along;
  Vector direction;           ///< of a ray, which length times is `along`; of a line that itself
  Vector n = Vector::Zero();  ///< of the triangle, of length 1; 0 where it has none
  Real turn = 1;              ///< -1 where the normal of a contact is -n
  Real sine = 0;              ///< of the angle at the first vertex
  Vector at;                  ///< the start where the line goes along the plane

  explicit CrossingInReals(const RayAndTriangle& shapes)
      : CrossingInReals(shapes.b, shapes.a.origin.cast<Real>(),
                        Real{shapes.a.length} * shapes.a.direction.cast<Real>()) {
    turn = -1;
    direction = shapes.a.direction.cast<Real>();
  }
  explicit CrossingInReals(const TriangleAndLine& shapes)
      : CrossingInReals(shapes.a, shapes.b.start.cast<Real>(),
                        shapes.b.end.cast<Real>() - shapes.b.start.cast<Real>()) {}

  [[nodiscard]] Real through() const { return n.dot(along); }
  /// Along the segment, from 0 to 1.
  [[nodiscard]] Real part() const { return n.dot(v[0] - start) / through(); }
  /// direction . (v1 - v0) x (v2 - v0), as engines compare it with 0.
  [[nodiscard]] Real determinant() const { return direction.dot((v[1] - v[0]).cross(v[2] - v[0])); }
  /// How far inside of edge k a point of the plane lies.
  [[nodiscard]] Real inside(std::size_t k, const Vector& x) const {
    const Vector edge = v[(k + 1) % 3] - v[k];
    return n.dot(edge.cross(x - v[k])) / edge.norm();
  }
  /// How far an end of the segment, or the place where its line goes through the plane, is from making it a miss where
  /// it crosses, or else at least from making it cross.
  [[nodiscard]] Real slack() const {
    if (!(sine > 0) || through() == 0) return 0;
    const Real low = std::min(n.dot(start - v[0]), n.dot(start + along - v[0]));
    const Real high = std::max(n.dot(start - v[0]), n.dot(start + along - v[0]));
    const Real least = std::min({-low, high, inside(0, at), inside(1, at), inside(2, at)});
    return std::abs(least);
  }
  [[nodiscard]] const Vector& at_vector() const { return at; }
  [[nodiscard]] Vector normal_vector() const { return turn * n; }

 private:
  CrossingInReals(const Triangle& triangle, const Vector& from, const Vector& way)
      : start(from), along(way), direction(way), at(from) {
    for (std::size_t k = 0; k < 3; ++k) v[k] = triangle.vertices[k].cast<Real>();
    const Vector u = v[1] - v[0];
    const Vector w = v[2] - v[0];
    const Vector across = u.stableNormalized().cross(w.stableNormalized());
    sine = across.norm();
    if (!(sine > 0)) return;
    n = across / sine;
    if (through() != 0) at = start + part() * along;
  }
};

/// A plane's normal of length 1, and how far from the origin it lies along that.
struct PlaneInReals {
  Numbers n{};
  Real offset = 0;

  explicit PlaneInReals(const Plane& plane) {
    const Numbers normal{plane.normal[0], plane.normal[1], plane.normal[2]};
    const Real length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    for (std::size_t i = 0; i < 3; ++i) n[i] = normal[i] / length;
    offset = Real{plane.offset} / length;
  }
  [[nodiscard]] Real height(const Numbers& x) const { return n[0] * x[0] + n[1] * x[1] + n[2] * x[2] - offset; }
  [[nodiscard]] Numbers foot(const Numbers& x) const {
    const Real s = height(x);
    return {x[0] - s * n[0], x[1] - s * n[1], x[2] - s * n[2]};
  }
};
/// Of an axis over a plane: the lower end, 0 or 1, or the middle where both are as good as level.
[[nodiscard]] inline Real lowest_parameter(const AxisInReals& axis, const PlaneInReals& plane) {
  Real rise = 0;
  Real size = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    rise += plane.n[i] * axis.along[i];
    size += std::abs(plane.n[i] * axis.along[i]);
  }
  if (std::abs(rise) <= 8 * std::numeric_limits<Real>::epsilon() * size) return 0.5L;
  return rise < 0 ? 1 : 0;
}
template <class A>
[[nodiscard]] std::array<Numbers, 2> nearest_in_reals(const Two<A, Plane>& shapes) {
  const AxisInReals axis(shapes.a);
  const PlaneInReals plane(shapes.b);
  const Numbers p = axis.at(lowest_parameter(axis, plane));
  return {p, plane.foot(p)};
}

}  // namespace contact::oracle
