// A triangle and a line in intervals.
#include "oracle/truth/interval_crossings.hpp"

namespace contact::oracle {

RoundedAnswer interval_answer(const TriangleAndLine& shapes, Distances /*distances*/, Scalar scalar,
                              mpfr_prec_t precision) {
  return answer_of_crossing(segment_between(shapes.b.start, shapes.b.end, precision), shapes.a, 1, scalar, precision);
}

}  // namespace contact::oracle
