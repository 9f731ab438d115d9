// A triangle and a line in pairs of doubles.
#include "oracle/truth/double_double_crossings.hpp"

namespace contact::oracle {

std::optional<RoundedAnswer> double_double_answer(const TriangleAndLine& shapes, Distances /*distances*/,
                                                  Scalar scalar) {
  const auto& [a, b] = shapes;
  if (!in_short_range({b.start, b.end})) return std::nullopt;
  return case_of_crossing(b.start, difference(b.end, b.start), a, 1, scalar);
}

}  // namespace contact::oracle
