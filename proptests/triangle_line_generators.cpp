// Questions about a triangle and a line.
#include "proptests/crossing_generators.hpp"

namespace contact::proptests {

rc::Gen<Query> queries(const TriangleAndLine* /*kind*/, const Range& range) {
  return crossings(range, [range](const Laid& laid, Distances distances) {
    const Vector3 end = (laid.start + laid.length * laid.direction).unaryExpr([&](double x) {
      return std::isfinite(x) ? range.rounded(x) : 0.0;
    });
    return Query{Pair::triangle_line, TriangleAndLine{laid.triangle, {laid.start, end}}, distances};
  });
}

}  // namespace contact::proptests
