// A segment that crosses a triangle, exactly: the point of its line that the plane through the triangle has too, in the
// coordinates of the triangle and of the segment, by Cramer's rule.
//   v0 + s u + t v = a + r d     0 <= s, t, s + t <= 1     0 <= r <= 1
#include "oracle/truth/crossings.hpp"

#include <algorithm>

namespace contact::oracle {

ExactTruth truth_of_crossing(const Segment& segment, const Triangle& triangle, int inward) {
  const Point v0 = point_of(triangle.vertices[0]);
  const Point u = point_of(triangle.vertices[1]) - v0;
  const Point v = point_of(triangle.vertices[2]) - v0;
  const Point& d = segment.along;
  const Point w = segment.from - v0;
  const auto determinant = [](const Point& x, const Point& y, const Point& z) { return dot(x, cross(y, z)); };
  const Rational all = determinant(u, v, Rational(-1) * d);
  if (CGAL::is_zero(all)) return {CrossingTruth()};
  const Rational s = determinant(w, v, Rational(-1) * d) / all;
  const Rational t = determinant(u, w, Rational(-1) * d) / all;
  const Rational r = determinant(u, v, w) / all;
  const Rational none(0);
  const Rational one(1);
  if (s < none || t < none || s + t > one || r < none || r > one) return {CrossingTruth()};
  const Point at = v0 + s * u + t * v;
  Rational farthest(0);
  for (const Point& x : {v0, v0 + u, v0 + v, segment.from, segment.from + d})
    for (const Rational& coordinate : x) farthest = std::max(farthest, Rational(CGAL::abs(coordinate)));
  return {CrossingTruth(at, Rational(inward) * cross(u, v), farthest)};
}

Rational distance2_to_change(const Segment& segment, const Triangle& triangle) {
  std::array<Point, 3> v;
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = point_of(triangle.vertices[i]);
  std::vector<Rational> all;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const Segment edge{v[i], v[(i + 1) % v.size()] - v[i], 0};
    all.push_back(std::get<DistanceTruth>(truth_of_segments(segment, edge, {0, 0}).numbers).distance2());
  }
  const Point normal = cross(v[1] - v[0], v[2] - v[0]);
  if (!is_zero(normal))
    for (const Point& end : segment.ends()) {
      const Rational height = dot(end - v[0], normal);
      all.push_back(height * height / dot(normal, normal));
    }
  return *std::min_element(all.begin(), all.end());
}

Witness witness_of(const CrossingTruth& crossing) {
  Witness w;
  if (!crossing.at()) return w;
  w.crossing.emplace();
  for (std::size_t axis = 0; axis < 3; ++axis) (*w.crossing)[axis] = exact_string((*crossing.at())[axis]);
  return w;
}

}  // namespace contact::oracle
