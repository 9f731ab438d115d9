// Two spheres in pairs of doubles.
#include "oracle/truth/double_double_nearest.hpp"

namespace contact::oracle {

std::optional<DoubleDoubleCase> double_double_case(const Balls& balls, Distances distances, Scalar scalar,
                                                   bool with_margin) {
  constexpr int kMost = 200;
  const auto& [a, b] = balls;
  if (!in_range(a.center, kMost) || !in_range(b.center, kMost) || !in_range(a.radius, kMost) ||
      !in_range(b.radius, kMost) || !in_range(distances.alarm, kMost) || !in_range(distances.contact, kMost))
    return std::nullopt;
  return case_of_nearest({exactly(a.center), exactly(b.center), difference(b.center, a.center)}, a.radius, b.radius,
                         distances, scalar, with_margin);
}

}  // namespace contact::oracle
