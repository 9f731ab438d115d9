// Nearest points of two cores that are numbers of the question, or halves of sums of two: of segments along axes, and of a
// point and a triangle's corner, edge along an axis or face across one. Scenes of floors, walls and things that stand
// upright are full of them. The contact is that of two balls at these points then, and no stage has to tell 0 from
// what is near it.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/batch_bounds.hpp"
#include "kernel/segment_cores.hpp"
#include "kernel/sphere_sphere_numbers.hpp"
#include "kernel/sum_of_two.hpp"
#include "kernel/triangle_cores.hpp"

namespace contact::kernel {

/// The nearest points p and q of two cores. Where there are many, p is the middle of those of the first core.
struct SimplePoints {
  Vector3 p;
  Vector3 q;
  bool unique;
};

inline bool is_along_axis(const Segment& segment) {
  const auto& [start, end] = segment;
  return (start[0] == end[0] ? 1 : 0) + (start[1] == end[1] ? 1 : 0) + (start[2] == end[2] ? 1 : 0) >= 2;
}

// False where the points are not so simple.

/// Segments along axes are products of intervals, so each axis is on its own.
inline bool simple_points(const Segment& first, const Segment& second, SimplePoints& points) {
  if (!is_along_axis(first) || !is_along_axis(second)) return false;
  points.unique = true;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const double low1 = std::min(first.start[k], first.end[k]);
    const double high1 = std::max(first.start[k], first.end[k]);
    const double low2 = std::min(second.start[k], second.end[k]);
    const double high2 = std::max(second.start[k], second.end[k]);
    if (high1 < low2 || high2 < low1) {
      points.p[k] = high1 < low2 ? high1 : low1;
      points.q[k] = high1 < low2 ? low2 : high2;
      continue;
    }
    const double from = std::max(low1, low2);
    const double to = std::min(high1, high2);
    // The sum is exact where its half is subnormal, so that the half is rounded once.
    const double middle = from == to ? from : 0.5 * (from + to);
    if (!std::isfinite(middle)) return false;
    points.p[k] = points.q[k] = middle;
    points.unique = points.unique && from == to;
  }
  return true;
}
inline bool simple_points(const Vector3& c, const Segment& segment, SimplePoints& points) {
  return simple_points(Segment{c, c}, segment, points);
}
/// Left are rays whose end is no double and not surely farther than c.
inline bool simple_points(const DirectedSegment& segment, const Vector3& c, SimplePoints& points) {
  const auto& [start, direction, length] = segment;
  Segment along{start, start};
  bool moves = false;  // a way that is nothing beside `start` counts, too
  for (Eigen::Index k = 0; k < 3; ++k) {
    if (length == 0 || direction[k] == 0) continue;
    if (std::exchange(moves, true)) return false;
    const double way = length * direction[k];
    along.end[k] = start[k] + way;
    const bool exact = std::fma(length, direction[k], -way) == 0 && std::abs(way) >= ForDouble::kLeast &&
                       two_sum(start[k], way).low == 0;
    // Rounding is monotone, and the difference is less than half of what is cut off.
    const double ahead = way > 0 ? c[k] - start[k] : start[k] - c[k];
    if (!exact && !(ahead < 0.5 * std::abs(way))) return false;
  }
  return simple_points(along, Segment{c, c}, points);
}
inline bool simple_points(const Vector3& c, const Corners& triangle, SimplePoints& points) {
  if (!in_short_range(c) || !in_short_range(triangle)) return false;
  const auto& v = triangle.vertices;
  const NearestFeature nearest = nearest_feature(plain_view(c, triangle), triangle);
  points = {c, c, true};
  switch (nearest.kind) {
    case NearestFeature::Kind::face:
      for (Eigen::Index k = 0; k < 3; ++k)
        if (v[0][k] == v[1][k] && v[0][k] == v[2][k]) {
          points.q[k] = v[0][k];
          return true;
        }
      return false;
    case NearestFeature::Kind::edge:
      return simple_points(c, Segment{v[nearest.from], v[nearest.to]}, points);
    case NearestFeature::Kind::corner:
      points.q = v[nearest.from];
      return true;
    default:
      return false;
  }
}

/// Whether two kinds of core may have such points.
template <class First, class Second>
concept MayBeSimple = requires(const First& first, const Second& second, SimplePoints& points) {
  simple_points(first, second, points);
};

/// Settles the second point where it alone is open and the foot of c on an edge along a diagonal of two axes: half of a sum
/// of four numbers, often half way between two doubles. Returns what is open then.
inline unsigned settle_foot(const Vector3& c, const Corners& triangle, unsigned open, Contact& contact) {
  if ((open & ((1U << 2 * kPointNumber) - 1)) != 0 || (open >> kValueNumber) != 0) return open;
  const NearestFeature nearest = nearest_feature(plain_view(c, triangle), triangle);
  if (nearest.kind != NearestFeature::Kind::edge) return open;
  const Vector3& a = triangle.vertices[nearest.from];
  const Vector3& b = triangle.vertices[nearest.to];
  for (Eigen::Index k = 0; k < 3; ++k) {
    const Eigen::Index i = (k + 1) % 3;
    const Eigen::Index j = (k + 2) % 3;
    const DoubleDouble<double> x = two_difference(b[i], a[i]);
    const DoubleDouble<double> y = two_difference(b[j], a[j]);
    if (a[k] != b[k] || std::abs(x.high) != std::abs(y.high) || x.high == 0) continue;
    const double sign = x.high == y.high ? 1 : -1;
    if (x.low != sign * y.low) continue;
    Vector3 q = a;
    const auto take = [&](Eigen::Index axis, Eigen::Index other) {
      one_number::SumOfTwo<double> twice(a[axis], c[axis]);
      twice.add(sign * c[other]);
      twice.add(-sign * a[other]);
      q[axis] = 0.5 * twice.rounded();
      // Rounding is monotone: what is between the ends after it is so before.
      return twice.lost == 0 && (q[axis] - a[axis] > 0) == (b[axis] - q[axis] > 0) && q[axis] != a[axis] &&
             q[axis] != b[axis];
    };
    if (!take(i, j) || !take(j, i)) return open;
    for (Eigen::Index axis = 0; axis < 3; ++axis) contact.point2[axis] = q[axis] == 0 ? 0 : q[axis];
    return 0;
  }
  return open;
}
template <class First, class Second>
unsigned settle_foot(const First& /*first*/, const Second& /*second*/, unsigned open, Contact& /*contact*/) {
  return open;
}

}  // namespace contact::kernel
