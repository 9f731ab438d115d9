// A segment over a plane, exactly: no point of it is lower than both of its ends.
#include "oracle/truth/planes.hpp"

#include <algorithm>

namespace contact::oracle {

ExactTruth truth_over_plane(const Segment& segment, const Plane& plane, Distances distances) {
  const Point n = point_of(plane.normal);
  const Rational offset(plane.offset);
  const Rational N = dot(n, n);
  const auto [start, end] = segment.ends();
  const Rational half(1, 2);
  const auto height = [&](const Point& x) { return (dot(n, x) - offset) / N; };  // in normals
  const bool level = height(start) == height(end);
  const Point p = level ? half * (start + end) : height(start) < height(end) ? start : end;
  Rational scale(0);
  for (const Point& x : {start, end})
    for (const Rational& coordinate : x) scale = std::max(scale, Rational(CGAL::abs(coordinate)));
  Cores cores{{p, p - height(p) * n}, {Rational(segment.radius), Rational(0)}, {scale, scale}};
  cores.half_space = HalfSpace{Rational(-1) * n, offset * offset / N};
  if (level && start != end) cores.spread = half * (end - start);
  return {DistanceTruth(std::move(cores), distances)};
}

}  // namespace contact::oracle
