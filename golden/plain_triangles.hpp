// A point and a triangle in plain arithmetic: the nearest point, and the contact of the sphere around the one.
#pragma once

#include <limits>

#include "golden/plain_segments.hpp"

namespace contact::golden {

template <class Real>
using Vertices = std::array<Triple<Real>, 3>;

template <class Real>
Vertices<Real> vertices_of(const Triangle& triangle) {
  const auto& [v0, v1, v2] = triangle.vertices;
  return {in_scalar<Real>(v0), in_scalar<Real>(v1), in_scalar<Real>(v2)};
}

/// The nearest of the edges' points, each by its clamped foot.
template <class Real>
Triple<Real> nearest_on_edges(const Triple<Real>& p, const Vertices<Real>& vertices) {
  Triple<Real> nearest = vertices[0];
  Real least = std::numeric_limits<Real>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Segment<Real> edge{vertices[k], vertices[(k + 1) % 3], 0};
    const Triple<Real> point = edge.at(edge.part_at(p));
    const Triple<Real> delta = moved(point, Real{-1}, p);
    if (!(dot(delta, delta) < least)) continue;
    least = dot(delta, delta);
    nearest = point;
  }
  return nearest;
}

/// The point of a triangle nearest to p, by the regions of its vertices, edges and face; of one without an inside, the
/// edges' alone.
/// Source      C. Ericson, Real-Time Collision Detection (2005), section 5.1.5.
template <class Real>
Triple<Real> nearest_point(const Triple<Real>& p, const Vertices<Real>& vertices) {
  const auto& [a, b, c] = vertices;
  const Triple<Real> ab = moved(b, Real{-1}, a);
  const Triple<Real> ac = moved(c, Real{-1}, a);
  if (is_zero(cross(ab, ac))) return nearest_on_edges(p, vertices);
  const Triple<Real> ap = moved(p, Real{-1}, a);
  const Real d1 = dot(ab, ap);
  const Real d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const Triple<Real> bp = moved(p, Real{-1}, b);
  const Real d3 = dot(ab, bp);
  const Real d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const Real vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return moved(a, d1 / (d1 - d3), ab);
  const Triple<Real> cp = moved(p, Real{-1}, c);
  const Real d5 = dot(ab, cp);
  const Real d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const Real vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return moved(a, d2 / (d2 - d6), ac);
  const Real va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    return moved(b, (d4 - d3) / ((d4 - d3) + (d5 - d6)), moved(c, Real{-1}, b));
  if (!(va + vb + vc > 0)) return nearest_on_edges(p, vertices);
  const Real over = Real{1} / (va + vb + vc);
  return moved(moved(a, vb * over, ab), vc * over, ac);
}

/// Along the triangle's normal, or across its first edge that is not 0.
template <class Real>
Triple<Real> parting_normal(const Vertices<Real>& v) {
  const Triple<Real> u = moved(v[1], Real{-1}, v[0]);
  const Triple<Real> w = moved(v[2], Real{-1}, v[0]);
  return parting_normal(cross(u, w), is_zero(u) ? w : u);
}

}  // namespace contact::golden
