// A ray and a triangle in intervals.
#include "oracle/truth/interval_crossings.hpp"

namespace contact::oracle {

RoundedAnswer interval_answer(const RayAndTriangle& shapes, Distances /*distances*/, Scalar scalar,
                              mpfr_prec_t precision) {
  return answer_of_crossing(segment_along(shapes.a, precision), shapes.b, -1, scalar, precision);
}

}  // namespace contact::oracle
