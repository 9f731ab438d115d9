// Two segments, each of which may be a point: what the pairs of capsules share of the exact truth.
#pragma once

#include <initializer_list>

#include "oracle/truth/exact_truth.hpp"

namespace contact::oracle {

/// A segment with a vector from one end to the other, blown up by a radius.
struct Segment {
  Point from;
  Point along;
  double radius;
  [[nodiscard]] std::array<Point, 2> ends() const { return {from, from + along}; }
};
[[nodiscard]] Segment segment_of(const Ball& ball);
[[nodiscard]] Segment segment_of(const Capsule& capsule);
[[nodiscard]] Segment segment_of(const Ray& ray);

[[nodiscard]] ExactTruth truth_of_segments(const Segment& first, const Segment& second, Distances distances);
/// Without the margin.
[[nodiscard]] Witness witness_of(const ExactTruth& truth);
/// Slow: asked where nothing quicker tells that they are apart.
[[nodiscard]] Meet segments_meet(const Segment& first, const Segment& second);
/// Whether the box around some points and that around others have a point in common.
[[nodiscard]] bool boxes_meet(std::initializer_list<Vector3> first, std::initializer_list<Vector3> second);
// Whether points are surely not in one plane, or not on one line; else they may be. Quick: CGAL's intervals of doubles
// tell, unless they are, or nearly so.
[[nodiscard]] bool surely_off_plane(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d);
[[nodiscard]] bool surely_off_line(const Vector3& a, const Vector3& b, const Vector3& c);
/// The same of a point, and the line through another along a direction.
[[nodiscard]] bool surely_beside_line(const Vector3& a, const Vector3& b, const Vector3& direction);

/// The foot of a point on a line, where it lies on the segment.
[[nodiscard]] std::optional<Point> foot(const Point& c, const Segment& segment);
/// The normal by agreement of cores that meet: along `across`, else across a direction.
[[nodiscard]] Point agreed_normal(const Point& across, const Point& along);

}  // namespace contact::oracle
