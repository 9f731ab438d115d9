// What a pair asks of pairs of doubles: two segments, each of which may be a point; a core and a half-space; a segment that crosses a triangle; any two cores.
#pragma once

#include "oracle/truth/double_double_nearest.hpp"

namespace contact::oracle {

/// From the first of these points to the second.
using Ends = std::array<Vector3, 2>;

/// Within this, numbers of degree 4 in the coordinates stay in the range of the arithmetic.
[[nodiscard]] inline bool in_short_range(const Ends& ends) {
  constexpr int kMost = 80;
  return in_range(ends[0], kMost) && in_range(ends[1], kMost);
}

[[nodiscard]] inline DoubleDoubles cross(const DoubleDoubles& x, const DoubleDoubles& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

/// A segment: a point, and the way from there to the other end.
struct DoubleDoubleSegment {
  Vector3 from;
  DoubleDoubles along;
  DoubleDoubles end;
  bool is_point;
};
[[nodiscard]] inline DoubleDoubleSegment segment_between(const Vector3& start, const Vector3& end) {
  return {start, difference(end, start), exactly(end), start == end};
}
/// The way from a ray's origin to its end, a product.
[[nodiscard]] inline DoubleDoubles along(const Ray& ray) {
  DoubleDoubles along = exactly(ray.direction);
  for (DoubleDouble& x : along) x = DoubleDouble{ray.length} * x;
  return along;
}
/// Whether that is in_short_range.
[[nodiscard]] inline bool in_range_of_factors(const Ray& ray) {
  constexpr int kMost = 40;
  return in_range(ray.direction, kMost) && in_range(ray.length, kMost);
}
/// The second point's nearest one instead of the first's.
[[nodiscard]] inline DoubleDoubleNearest turned_round(const DoubleDoubleNearest& x) {
  return {x.q, x.p, {-x.delta[0], -x.delta[1], -x.delta[2]}};
}
/// A point and its nearest one on a segment; nothing where an end may be it or not.
[[nodiscard]] std::optional<DoubleDoubleNearest> foot(const Vector3& c, const DoubleDoubleSegment& segment);
/// Puts the nearer one of two into `best`; false where it is not certain which that is.
[[nodiscard]] bool keep_nearer(std::optional<DoubleDoubleNearest>& best, const DoubleDoubleNearest& other);

/// The answer at nearest points that are apart, as double_double_answer has it; nothing where there are none.
[[nodiscard]] std::optional<RoundedAnswer> case_of_apart(const std::optional<DoubleDoubleNearest>& nearest,
                                                         double radius1, double radius2, Distances distances,
                                                         Scalar scalar);
/// The answer for two segments blown up by radii, as double_double_answer has it.
[[nodiscard]] std::optional<RoundedAnswer> case_of_segments(const Ends& first, const Ends& second, double radius1,
                                                            double radius2, Distances distances, Scalar scalar);

/// A point of a core that none of it lies below; normal.p where the normal is the half-space's; and whether it is the only one.
struct DoubleDoubleLowest {
  DoubleDoubles p;
  DoubleDouble along_normal;
  bool unique;
};
/// The answer for a core over a half-space, blown up by a radius, as double_double_answer has it.
[[nodiscard]] std::optional<RoundedAnswer> case_over_plane(const DoubleDoubleLowest& lowest, double radius,
                                                           const Plane& plane, Distances distances, Scalar scalar);
/// The same for a segment.
[[nodiscard]] std::optional<RoundedAnswer> case_over_plane(const Ends& ends, double radius, const Plane& plane,
                                                           Distances distances, Scalar scalar);

/// The answer for a segment that crosses a triangle, as double_double_answer has it; `sign` turns the normal of the
/// triangle. Domain: a segment in_short_range.
[[nodiscard]] std::optional<RoundedAnswer> case_of_crossing(const Vector3& from, const DoubleDoubles& along,
                                                            const Triangle& triangle, int sign, Scalar scalar);

/// The answer for any two convex cores, or one over a half-space, as double_double_answer has it.
[[nodiscard]] std::optional<RoundedAnswer> case_of_convexes(const Convexes& shapes, Distances distances, Scalar scalar);

}  // namespace contact::oracle
