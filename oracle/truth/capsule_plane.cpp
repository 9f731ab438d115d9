// A capsule and a plane, exactly.
#include "oracle/truth/planes.hpp"

namespace contact::oracle {

ExactTruth exact_truth(const CapsuleAndPlane& shapes, Distances distances) {
  return truth_over_plane(segment_of(shapes.a), shapes.b, distances);
}

Meet cores_meet(const CapsuleAndPlane& /*shapes*/) { return Meet::no; }

}  // namespace contact::oracle
