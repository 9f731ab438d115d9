// A line that crosses a triangle, exactly.
#include "oracle/truth/crossings.hpp"

namespace contact::oracle {

ExactTruth exact_truth(const TriangleAndLine& shapes, Distances /*distances*/) {
  const Point start = point_of(shapes.b.start);
  return truth_of_crossing({start, point_of(shapes.b.end) - start, 0}, shapes.a, 1);
}

Meet cores_meet(const TriangleAndLine& /*shapes*/) { return Meet::no; }

}  // namespace contact::oracle
