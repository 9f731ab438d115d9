// A segment that crosses a triangle, exactly: the point of its line that the plane through the triangle has too, in the
// coordinates of the triangle and of the segment, by Cramer's rule.
//   v0 + s u + t v = a + r d     0 <= s, t, s + t <= 1     0 <= r <= 1
#include "oracle/truth/crossings.hpp"

#include <algorithm>

namespace contact::oracle {

CrossingTruth truth_of_crossing(const ExactCore& segment, const Triangle& triangle, int inward) {
  const Point v0 = point_of(triangle.vertices[0]);
  const Point u = point_of(triangle.vertices[1]) - v0;
  const Point v = point_of(triangle.vertices[2]) - v0;
  const Point& start = segment.vertices[0];
  const Point d = segment.vertices[1] - start;
  const Point w = start - v0;
  const auto determinant = [](const Point& x, const Point& y, const Point& z) { return dot(x, cross(y, z)); };
  const Rational all = determinant(u, v, Rational(-1) * d);
  if (CGAL::is_zero(all)) return {};
  const Rational s = determinant(w, v, Rational(-1) * d) / all;
  const Rational t = determinant(u, w, Rational(-1) * d) / all;
  const Rational r = determinant(u, v, w) / all;
  const Rational none(0);
  const Rational one(1);
  if (s < none || t < none || s + t > one || r < none || r > one) return {};
  const Point at = v0 + s * u + t * v;
  const Rational farthest = largest_coordinate({v0, v0 + u, v0 + v, start, start + d});
  return {at, Rational(inward) * cross(u, v), farthest};
}

Crossed crossed(const Query& query) {
  if (const auto* ray = std::get_if<RayAndTriangle>(&query.shapes)) return {exact_core(ray->a), ray->b};
  const auto& line = std::get<TriangleAndLine>(query.shapes);
  return {exact_core(line.b), line.a};
}

Rational distance2_to_change(const ExactCore& segment, const Triangle& triangle) {
  const std::vector<Point> v = exact_core(triangle).vertices;
  std::vector<Rational> all;
  for (std::size_t i = 0; i < v.size(); ++i)
    all.push_back(squared_distance(segment, exact_core({v[i], v[(i + 1) % v.size()]}, features::kSegment)));
  const Point normal = cross(v[1] - v[0], v[2] - v[0]);
  if (!is_zero(normal))
    for (const Point& end : segment.vertices) {
      const Rational height = dot(end - v[0], normal);
      all.push_back(height * height / dot(normal, normal));
    }
  return *std::min_element(all.begin(), all.end());
}

}  // namespace contact::oracle
