// A ray and a sphere: a segment, whose end is a product, and a point, exactly.
#include "oracle/truth/segments.hpp"

namespace contact::oracle {

ExactTruth exact_truth(const RayAndBall& shapes, Distances distances) {
  return truth_of_segments(segment_of(shapes.a), segment_of(shapes.b), distances);
}

Meet cores_meet(const RayAndBall& shapes) {
  const auto& [a, b] = shapes;
  // Beside the line of the direction, wherever the ray ends.
  if (surely_beside_line(b.center, a.origin, a.direction)) return Meet::no;
  return segments_meet(segment_of(a), segment_of(b));
}

}  // namespace contact::oracle
