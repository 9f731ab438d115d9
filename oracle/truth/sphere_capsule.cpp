// A sphere and a capsule: a point and a segment, exactly.
#include "oracle/truth/segments.hpp"

namespace contact::oracle {

ExactTruth exact_truth(const BallAndCapsule& shapes, Distances distances) {
  return truth_of_segments(segment_of(shapes.a), segment_of(shapes.b), distances);
}

Meet cores_meet(const BallAndCapsule& shapes) {
  const auto& [a, b] = shapes;
  if (!boxes_meet({a.center}, {b.start, b.end}) || surely_off_line(a.center, b.start, b.end)) return Meet::no;
  return segments_meet(segment_of(a), segment_of(b));
}

}  // namespace contact::oracle
