// A pair of capsules in pairs of doubles.
#include "oracle/truth/double_double_segments.hpp"

namespace contact::oracle {

std::optional<DoubleDoubleCase> double_double_case(const Capsules& shapes, Distances distances, Scalar scalar,
                                                   bool with_margin) {
  const auto& [a, b] = shapes;
  return case_of_segments({a.start, a.end}, {b.start, b.end}, a.radius, b.radius, distances, scalar, with_margin);
}

}  // namespace contact::oracle
