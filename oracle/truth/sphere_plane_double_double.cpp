// A sphere and a plane in pairs of doubles.
#include "oracle/truth/double_double_planes.hpp"

namespace contact::oracle {

std::optional<RoundedAnswer> double_double_answer(const BallAndPlane& shapes, Distances distances, Scalar scalar) {
  const auto& [a, b] = shapes;
  return case_over_plane({a.center, a.center}, a.radius, b, distances, scalar);
}

}  // namespace contact::oracle
