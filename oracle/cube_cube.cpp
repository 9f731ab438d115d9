// What is exactly true of two axis-aligned boxes.
#include <algorithm>
#include <cstddef>

#include "oracle/truth.hpp"

namespace contact::oracle {

CubeTruth::CubeTruth(const Boxes& boxes, Distances distances) : alarm(distances.alarm) {
  for (int axis = 0; axis < 3; ++axis)
    gap[static_cast<std::size_t>(axis)] = std::max(Rational(boxes.a.min[axis]) - Rational(boxes.b.max[axis]),
                                                   Rational(boxes.b.min[axis]) - Rational(boxes.a.max[axis]));
}

CGAL::Sign CubeTruth::at_alarm() const { return CGAL::sign(*std::max_element(gap.begin(), gap.end()) - alarm); }
CGAL::Sign CubeTruth::at_zero() const { return CGAL::sign(*std::max_element(gap.begin(), gap.end())); }

}  // namespace contact::oracle
