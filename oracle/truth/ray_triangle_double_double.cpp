// A ray and a triangle in pairs of doubles.
#include "oracle/truth/double_double_crossings.hpp"

namespace contact::oracle {

std::optional<RoundedAnswer> double_double_answer(const RayAndTriangle& shapes, Distances /*distances*/,
                                                  Scalar scalar) {
  const auto& [a, b] = shapes;
  constexpr int kMost = 40;  // of two factors, so that their product is short
  if (!in_short_range({a.origin, a.origin}) || !in_range(a.direction, kMost) || !in_range(a.length, kMost))
    return std::nullopt;
  DoubleDoubles along = exactly(a.direction);
  for (DoubleDouble& x : along) x = DoubleDouble{a.length} * x;
  return case_of_crossing(a.origin, along, b, -1, scalar);
}

}  // namespace contact::oracle
