// A sphere and a solid box, exactly. The nearest point of the box is the best of all its features: on each axis it has
// one of both bounds, or the centre's coordinate where that lies between them. These are 8 corners, 12 edges, 6 faces
// and the inside, and nobody asks in which region the centre lies.
#include <algorithm>
#include <cstddef>

#include "oracle/truth/exact_truth.hpp"

namespace contact::oracle {
namespace {

/// What a coordinate of the nearest point may be.
std::vector<Rational> candidates(const Rational& c, const Rational& min, const Rational& max) {
  std::vector<Rational> all{min, max};
  if (min <= c && c <= max) all.push_back(c);
  return all;
}

Rational squared_distance(const Point& p, const Point& q) {
  Rational sum(0);
  for (std::size_t axis = 0; axis < 3; ++axis) sum += (q[axis] - p[axis]) * (q[axis] - p[axis]);
  return sum;
}

Point nearest_point(const Point& c, const Point& min, const Point& max) {
  Point nearest = min;
  for (const Rational& x : candidates(c[0], min[0], max[0]))
    for (const Rational& y : candidates(c[1], min[1], max[1]))
      for (const Rational& z : candidates(c[2], min[2], max[2]))
        if (const Point q{x, y, z}; squared_distance(c, q) < squared_distance(c, nearest)) nearest = q;
  return nearest;
}

/// The ways out through the six faces, the shortest of them.
Meeting meeting(const Point& c, const Point& min, const Point& max) {
  Meeting found{c[0] - min[0], {}, {}};
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const bool is_min : {true, false}) {
      const Rational& face = is_min ? min[axis] : max[axis];
      const Rational depth = is_min ? Rational(c[axis] - face) : Rational(face - c[axis]);
      if (depth > found.depth) continue;
      if (depth < found.depth) found.ways.clear();
      found.depth = depth;
      WayOut way{{Rational(0), Rational(0), Rational(0)}, c};
      way.direction[axis] = Rational(is_min ? 1 : -1);
      way.nearest[axis] = face;
      found.ways.push_back(way);
    }
  if (!CGAL::is_zero(found.depth)) return found;
  found.ways.resize(1);
  for (int corner = 0; corner < 8; ++corner) {
    Point apart;
    for (std::size_t axis = 0; axis < 3; ++axis) apart[axis] = ((corner >> axis & 1) == 0 ? min : max)[axis] - c[axis];
    found.apart.push_back(apart);
  }
  return found;
}

}  // namespace

ExactTruth exact_truth(const BallAndBox& shapes, Distances distances) {
  const auto& [ball, box] = shapes;
  const Point c = point_of(ball.center);
  const Point min = point_of(box.min);
  const Point max = point_of(box.max);
  const Rational farthest(
      std::max({ball.center.cwiseAbs().maxCoeff(), box.min.cwiseAbs().maxCoeff(), box.max.cwiseAbs().maxCoeff()}));
  Cores cores{{c, nearest_point(c, min, max)}, {Rational(ball.radius), Rational(0)}, {farthest, farthest}};
  if (cores.nearest[0] == cores.nearest[1]) cores.meeting = meeting(c, min, max);
  return {DistanceTruth(std::move(cores), distances)};
}

Meet cores_meet(const BallAndBox& shapes) {
  const auto c = shapes.a.center.array();
  const auto min = shapes.b.min.array();
  const auto max = shapes.b.max.array();
  if (!((min <= c).all() && (c <= max).all())) return Meet::no;
  return (min < c).all() && (c < max).all() ? Meet::inside : Meet::touching;
}

}  // namespace contact::oracle
