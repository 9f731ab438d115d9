// Two axis-aligned boxes, exactly: on each axis the gap max(min1 - max2, min2 - max1).
#include <algorithm>
#include <cstddef>

#include "oracle/truth/exact_truth.hpp"

namespace contact::oracle {

ExactTruth exact_truth(const Boxes& boxes, Distances distances) {
  std::array<Rational, 3> gap;
  for (int axis = 0; axis < 3; ++axis)
    gap[static_cast<std::size_t>(axis)] = std::max(Rational(boxes.a.min[axis]) - Rational(boxes.b.max[axis]),
                                                   Rational(boxes.b.min[axis]) - Rational(boxes.a.max[axis]));
  return {GapTruth(std::move(gap), Rational(distances.alarm))};
}

Meet cores_meet(const Boxes& /*boxes*/) { return Meet::no; }

}  // namespace contact::oracle
