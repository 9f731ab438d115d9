// A sphere and a capsule in pairs of doubles.
#include "oracle/truth/double_double_segments.hpp"

namespace contact::oracle {

std::optional<RoundedAnswer> double_double_answer(const BallAndCapsule& shapes, Distances distances, Scalar scalar) {
  const auto& [a, b] = shapes;
  return case_of_segments({a.center, a.center}, {b.start, b.end}, a.radius, b.radius, distances, scalar);
}

}  // namespace contact::oracle
