// The nearest point of a triangle, exactly: the best of all its features, which are three vertices, the feet on three
// edges, the foot on the face. All of these that lie in it are tried, and nobody asks in which region the other point
// lies.
#include "oracle/truth/triangles.hpp"

#include <algorithm>
#include <cstddef>

namespace contact::oracle {
namespace {

/// The foot of a point on the plane, where it lies in the triangle: v_0 + s u + t v with (w - s u - t v) at right
/// angles to u and v, by Cramer's rule. Nothing of a triangle without an inside.
std::optional<Point> foot_on_face(const Point& c, const Vertices& vertices) {
  const Point u = vertices[1] - vertices[0];
  const Point v = vertices[2] - vertices[0];
  const Point w = c - vertices[0];
  const Rational determinant = dot(u, u) * dot(v, v) - dot(u, v) * dot(u, v);
  if (CGAL::is_zero(determinant)) return std::nullopt;
  const Rational s = (dot(w, u) * dot(v, v) - dot(w, v) * dot(u, v)) / determinant;
  const Rational t = (dot(w, v) * dot(u, u) - dot(w, u) * dot(u, v)) / determinant;
  const Rational none(0);
  if (s < none || t < none || s + t > Rational(1)) return std::nullopt;
  return vertices[0] + s * u + t * v;
}

std::vector<Point> candidates(const Point& c, const Vertices& vertices) {
  std::vector<Point> all(vertices.begin(), vertices.end());
  for (std::size_t k = 0; k < 3; ++k)
    if (const auto q = foot(c, {vertices[k], vertices[(k + 1) % 3] - vertices[k], 0})) all.push_back(*q);
  if (const auto q = foot_on_face(c, vertices)) all.push_back(*q);
  return all;
}

}  // namespace

Vertices vertices_of(const Triangle& triangle) {
  Vertices v;
  std::transform(triangle.vertices.begin(), triangle.vertices.end(), v.begin(), point_of);
  return v;
}

Point nearest_on_triangle(const Point& c, const Vertices& vertices) {
  const auto squared = [&](const Point& q) { return dot(q - c, q - c); };
  const std::vector<Point> all = candidates(c, vertices);
  return *std::min_element(all.begin(), all.end(),
                           [&](const Point& x, const Point& y) { return squared(x) < squared(y); });
}

}  // namespace contact::oracle
