// A ray that crosses a triangle, exactly.
#include "oracle/truth/crossings.hpp"

namespace contact::oracle {

ExactTruth exact_truth(const RayAndTriangle& shapes, Distances /*distances*/) {
  return truth_of_crossing(segment_of(shapes.a), shapes.b, -1);
}

Meet cores_meet(const RayAndTriangle& /*shapes*/) { return Meet::no; }

}  // namespace contact::oracle
