// Two segments, each of which may be a point: what the pairs of capsules share of the exact truth.
#pragma once

#include "oracle/truth/exact_truth.hpp"

namespace contact::oracle {

/// A segment, from start to end, blown up by a radius.
struct Segment {
  Vector3 start;
  Vector3 end;
  double radius;
};
[[nodiscard]] inline Segment segment_of(const Ball& ball) { return {ball.center, ball.center, ball.radius}; }
[[nodiscard]] inline Segment segment_of(const Capsule& capsule) { return {capsule.start, capsule.end, capsule.radius}; }

[[nodiscard]] ExactTruth truth_of_segments(const Segment& first, const Segment& second, Distances distances);
/// Without the margin.
[[nodiscard]] Witness witness_of_segments(const Segment& first, const Segment& second, Distances distances);
[[nodiscard]] Meet segments_meet(const Segment& first, const Segment& second);

}  // namespace contact::oracle
