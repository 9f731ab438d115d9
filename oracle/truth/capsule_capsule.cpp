// Two capsules: two segments, exactly.
#include "oracle/truth/segments.hpp"

namespace contact::oracle {

ExactTruth exact_truth(const Capsules& shapes, Distances distances) {
  return truth_of_segments(segment_of(shapes.a), segment_of(shapes.b), distances);
}

Meet cores_meet(const Capsules& shapes) {
  const auto& [a, b] = shapes;
  if (!boxes_meet({a.start, a.end}, {b.start, b.end}) || surely_off_plane(a.start, a.end, b.start, b.end))
    return Meet::no;
  // A capsule that is a ball lies in a plane with every other.
  if (a.start == a.end && surely_off_line(a.start, b.start, b.end)) return Meet::no;
  if (b.start == b.end && surely_off_line(b.start, a.start, a.end)) return Meet::no;
  return segments_meet(segment_of(a), segment_of(b));
}

}  // namespace contact::oracle
