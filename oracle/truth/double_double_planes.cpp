// A core over a plane in pairs of doubles. Which end of a segment is lower is told by the heights of both; where that is not certain
// there is no answer.
#include "oracle/truth/double_double_segments.hpp"

#include <cstddef>

namespace contact::oracle {

std::optional<RoundedAnswer> case_over_plane(const DoubleDoubleLowest& lowest, double radius, const Plane& plane,
                                             Distances distances, Scalar scalar) {
  constexpr int kMost = 80;
  for (const double x : {radius, plane.offset, distances.alarm, distances.contact})
    if (!in_range(x, kMost)) return std::nullopt;
  if (!in_range(plane.normal, kMost)) return std::nullopt;

  const DoubleDoubles n = exactly(plane.normal);
  const DoubleDouble length = root(dot(n, n));
  const DoubleDouble height = lowest.along_normal - DoubleDouble{plane.offset};
  const auto side = [&](const DoubleDouble& reach) { return (height - reach * length).sign(); };
  const auto at_alarm = side(two_sum(radius, distances.alarm));
  const auto at_zero = side(DoubleDouble{radius});
  if (!at_alarm || !at_zero) return std::nullopt;

  const DoubleDouble inverse = reciprocal(length);
  DoubleDoubleAlong along{lowest.p, {}, {}, height * inverse, *at_alarm, *at_zero, false, lowest.unique};
  for (std::size_t i = 0; i < 3; ++i) {
    along.normal[i] = -n[i] * inverse;
    along.q[i] = along.p[i] + along.distance * along.normal[i];
  }
  return case_along(along, radius, 0, distances, scalar);
}

std::optional<RoundedAnswer> case_over_plane(const Ends& ends, double radius, const Plane& plane, Distances distances,
                                             Scalar scalar) {
  if (!in_short_range(ends)) return std::nullopt;
  const DoubleDoubles n = exactly(plane.normal);
  const auto rise = dot(n, difference(ends[1], ends[0])).sign();
  if (!rise) return std::nullopt;
  const Vector3& low = ends[*rise < 0 ? 1 : 0];
  DoubleDoubleLowest lowest{exactly(low), dot(n, exactly(low)), *rise != 0 || ends[0] == ends[1]};
  for (std::size_t i = 0; !lowest.unique && i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    lowest.p[i] = two_sum(ends[0][axis] / 2, ends[1][axis] / 2);
  }
  return case_over_plane(lowest, radius, plane, distances, scalar);
}

}  // namespace contact::oracle
