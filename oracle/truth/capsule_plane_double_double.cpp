// A capsule and a plane in pairs of doubles.
#include "oracle/truth/double_double_planes.hpp"

namespace contact::oracle {

std::optional<DoubleDoubleCase> double_double_case(const CapsuleAndPlane& shapes, Distances distances, Scalar scalar,
                                                   bool with_margin) {
  const auto& [a, b] = shapes;
  return case_over_plane({a.start, a.end}, a.radius, b, distances, scalar, with_margin);
}

}  // namespace contact::oracle
