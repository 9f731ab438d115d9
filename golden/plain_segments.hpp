// Two segments in plain arithmetic: nearest points, and the contact of the capsules around them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <type_traits>

#include "golden/plain.hpp"

namespace contact::golden {

template <class Real>
using Triple = std::array<Real, 3>;

template <class Real>
Triple<Real> in_scalar(const Vector3& v) {
  return {static_cast<Real>(v[0]), static_cast<Real>(v[1]), static_cast<Real>(v[2])};
}
template <class Real>
Vector3 widened(const Triple<Real>& v) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

template <class Real>
Real dot(const Triple<Real>& x, const Triple<Real>& y) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}
template <class Real>
Triple<Real> cross(const Triple<Real>& x, const Triple<Real>& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}
/// x + factor y
template <class Real>
Triple<Real> moved(const Triple<Real>& x, std::type_identity_t<Real> factor, const Triple<Real>& y) {
  return {x[0] + factor * y[0], x[1] + factor * y[1], x[2] + factor * y[2]};
}
/// Zero, or so short that its square is.
template <class Real>
bool is_zero(const Triple<Real>& x) {
  return dot(x, x) == 0;
}

/// A capsule in a scalar. A sphere is one without length.
template <class Real>
struct Segment {
  Triple<Real> start{};
  Triple<Real> end{};
  Real radius{};

  [[nodiscard]] Triple<Real> direction() const { return moved(end, Real{-1}, start); }
  /// start + s direction, the ends exactly.
  [[nodiscard]] Triple<Real> at(Real s) const { return s == 1 ? end : moved(start, s, direction()); }
  /// Where the foot of a point lies, as a part of the segment; 0 of a segment without length.
  [[nodiscard]] Real part_at(const Triple<Real>& point) const {
    const Triple<Real> u = direction();
    return is_zero(u) ? Real{0} : std::clamp(dot(moved(point, Real{-1}, start), u) / dot(u, u), Real{0}, Real{1});
  }
};

template <class Real>
Segment<Real> segment_of(const Capsule& capsule) {
  return {in_scalar<Real>(capsule.start), in_scalar<Real>(capsule.end), static_cast<Real>(capsule.radius)};
}
template <class Real>
Segment<Real> segment_of(const Ball& ball) {
  return {in_scalar<Real>(ball.center), in_scalar<Real>(ball.center), static_cast<Real>(ball.radius)};
}

/// Its end is rounded.
template <class Real>
Segment<Real> segment_of(const Ray& ray) {
  const Triple<Real> start = in_scalar<Real>(ray.origin);
  return {start, moved(start, static_cast<Real>(ray.length), in_scalar<Real>(ray.direction)), 0};
}

template <class Real>
struct NearestPoints {
  Triple<Real> p;
  Triple<Real> q;
  bool unique;
};

/// Closest points of two segments: where the lines are nearest, or in the middle of what parallel segments have beside
/// each other; then each point again for the other one clamped.
///   s = ((w x v) . (u x v)) / |u x v|^2     u, v the directions, w from the first start to the second
/// Source      C. Ericson, Real-Time Collision Detection (2005), section 5.1.9, with the cross product for its
///             determinant.
template <class Real>
NearestPoints<Real> nearest_points(const Segment<Real>& a, const Segment<Real>& b) {
  const Triple<Real> u = a.direction();
  const Triple<Real> v = b.direction();
  const Triple<Real> n = cross(u, v);
  bool unique = true;
  Real s = 0;
  if (!is_zero(n)) {
    s = std::clamp(dot(cross(moved(b.start, Real{-1}, a.start), v), n) / dot(n, n), Real{0}, Real{1});
  } else if (!is_zero(u) && !is_zero(v)) {
    const Real from = a.part_at(b.start);
    const Real to = a.part_at(b.end);
    s = (from + to) / 2;
    unique = from == to;
  }
  const Real t = b.part_at(a.at(s));
  if (unique) s = a.part_at(b.at(t));
  return {a.at(s), b.at(t), unique};
}

/// A unit vector along n; where that is 0 the x axis made perpendicular to u, or the y axis; where u is 0 too the x
/// axis. The first component that is not 0 is positive.
template <class Real>
Triple<Real> parting_normal(Triple<Real> n, const Triple<Real>& u) {
  if (is_zero(u)) return {1, 0, 0};
  if (is_zero(n)) n = {u[1] * u[1] + u[2] * u[2], -(u[0] * u[1]), -(u[0] * u[2])};
  if (is_zero(n)) return {0, 1, 0};
  const Real first = n[0] != 0 ? n[0] : n[1] != 0 ? n[1] : n[2];
  const Real size = first < 0 ? -std::sqrt(dot(n, n)) : std::sqrt(dot(n, n));
  return {n[0] / size, n[1] / size, n[2] / size};
}
/// That parts segments that meet: along both at right angles, or across the first direction that is not 0.
template <class Real>
Triple<Real> parting_normal(const Segment<Real>& a, const Segment<Real>& b) {
  return parting_normal(cross(a.direction(), b.direction()), is_zero(a.direction()) ? b.direction() : a.direction());
}

/// The nearest points as two spheres.
template <class Real>
Balls at_nearest(const NearestPoints<Real>& nearest, Real radius1, Real radius2) {
  return {{widened(nearest.p), static_cast<double>(radius1)}, {widened(nearest.q), static_cast<double>(radius2)}};
}

/// The contact at nearest points, with the normal to take where they are one.
template <class Real>
std::optional<Contact> plain_contact_at(const NearestPoints<Real>& nearest, Real radius1, Real radius2,
                                        const Triple<Real>& n, Distances distances, Scalar scalar,
                                        ContactPoints points) {
  std::optional<Contact> contact = plain_contact(at_nearest(nearest, radius1, radius2), distances, scalar, points);
  if (!contact) return contact;
  contact->unique = nearest.unique;
  if (!contact->degenerate) return contact;
  const auto surface_point = [&](const Triple<Real>& core, PointOn on, Real radius) {
    return widened(moved(core, outward(on, radius), n));
  };
  contact->normal = widened(n);
  contact->point1 = surface_point(nearest.p, points.first, radius1);
  contact->point2 = surface_point(nearest.q, points.second, -radius2);
  return contact;
}

// For capsules, spheres and rays, what plain.hpp declares.

template <class Real, class Shapes>
bool plain_overlap_of_segments(const Shapes& shapes, Distances distances, Scalar scalar) {
  const Segment<Real> a = segment_of<Real>(shapes.a);
  const Segment<Real> b = segment_of<Real>(shapes.b);
  return plain_overlap(at_nearest(nearest_points(a, b), a.radius, b.radius), distances, scalar);
}

template <class Real, class Shapes>
std::optional<Contact> plain_contact_of_segments(const Shapes& shapes, Distances distances, Scalar scalar,
                                                 ContactPoints points) {
  const Segment<Real> a = segment_of<Real>(shapes.a);
  const Segment<Real> b = segment_of<Real>(shapes.b);
  return plain_contact_at(nearest_points(a, b), a.radius, b.radius, parting_normal(a, b), distances, scalar, points);
}

}  // namespace contact::golden
