// A segment and a triangle in plain arithmetic: where the one crosses the other.
#pragma once

#include "golden/plain_triangles.hpp"

namespace contact::golden {

/// From start, along direction, `length` times.
template <class Real>
struct Directed {
  Triple<Real> start{};
  Triple<Real> direction{};
  Real length{1};

  explicit Directed(const Ray& ray)
      : start(in_scalar<Real>(ray.origin)),
        direction(in_scalar<Real>(ray.direction)),
        length(static_cast<Real>(ray.length)) {}
  explicit Directed(const Line& line)
      : start(in_scalar<Real>(line.start)), direction(moved(in_scalar<Real>(line.end), Real{-1}, start)) {}
};

/// The contact, the normal turned by `sign`.
/// Source      T. Moller, B. Trumbore, Fast, Minimum Storage Ray/Triangle Intersection (1997), without its epsilon.
template <class Real>
std::optional<Contact> plain_crossing(const Directed<Real>& segment, const Triangle& triangle, Real sign) {
  const auto [v0, v1, v2] = vertices_of<Real>(triangle);
  const Triple<Real>& d = segment.direction;
  const Triple<Real> u = moved(v1, Real{-1}, v0);
  const Triple<Real> v = moved(v2, Real{-1}, v0);
  const Triple<Real> across = cross(d, v);
  const Real determinant = dot(u, across);
  if (determinant == 0) return std::nullopt;
  const Triple<Real> w = moved(segment.start, Real{-1}, v0);
  const Real s = dot(w, across) / determinant;
  if (!(s >= 0 && s <= 1)) return std::nullopt;
  const Triple<Real> turned = cross(w, u);
  const Real t = dot(d, turned) / determinant;
  if (!(t >= 0 && s + t <= 1)) return std::nullopt;
  const Real part = dot(v, turned) / determinant;
  if (!(part >= 0 && part <= segment.length)) return std::nullopt;
  const Triple<Real> n = cross(u, v);
  const Real length = std::sqrt(dot(n, n));
  const Vector3 at = widened(moved(segment.start, part, d));
  return Contact{widened(Triple<Real>{sign * n[0] / length, sign * n[1] / length, sign * n[2] / length}), at, at, 0,
                 false};
}

inline std::optional<Contact> plain_crossing(const RayAndTriangle& shapes, Scalar scalar) {
  return scalar == Scalar::binary32 ? plain_crossing(Directed<float>(shapes.a), shapes.b, -1.0F)
                                    : plain_crossing(Directed<double>(shapes.a), shapes.b, -1.0);
}
inline std::optional<Contact> plain_crossing(const TriangleAndLine& shapes, Scalar scalar) {
  return scalar == Scalar::binary32 ? plain_crossing(Directed<float>(shapes.b), shapes.a, 1.0F)
                                    : plain_crossing(Directed<double>(shapes.b), shapes.a, 1.0);
}

}  // namespace contact::golden
