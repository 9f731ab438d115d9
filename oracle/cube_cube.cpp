// What is exactly true of two axis-aligned boxes.
#include <algorithm>
#include <cstddef>

#include "oracle/default_environment.hpp"
#include "oracle/truth.hpp"

namespace contact::oracle {

const CubeTruth::Numbers& CubeTruth::exact() const {
  if (exact_) return *exact_;
  const DefaultEnvironment environment;
  Numbers& n = exact_.emplace();
  n.alarm = Rational(distances_.alarm);
  for (int axis = 0; axis < 3; ++axis)
    n.gap[static_cast<std::size_t>(axis)] = std::max(Rational(boxes_.a.min[axis]) - Rational(boxes_.b.max[axis]),
                                                     Rational(boxes_.b.min[axis]) - Rational(boxes_.a.max[axis]));
  return n;
}

const Rational& CubeTruth::widest_gap() const { return *std::max_element(gap().begin(), gap().end()); }

}  // namespace contact::oracle
