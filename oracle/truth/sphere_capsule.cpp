// A sphere and a capsule: a point and a segment, exactly.
#include "oracle/truth/segments.hpp"

namespace contact::oracle {

ExactTruth exact_truth(const BallAndCapsule& shapes, Distances distances) {
  return truth_of_segments(segment_of(shapes.a), segment_of(shapes.b), distances);
}

Meet cores_meet(const BallAndCapsule& shapes) { return segments_meet(segment_of(shapes.a), segment_of(shapes.b)); }

}  // namespace contact::oracle
