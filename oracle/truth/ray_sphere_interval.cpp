// A ray and a sphere in intervals.
#include "oracle/truth/interval_segments.hpp"

namespace contact::oracle {

RoundedAnswer interval_answer(const RayAndBall& shapes, Distances distances, Scalar scalar, mpfr_prec_t precision) {
  const auto& [a, b] = shapes;
  return answer_of_segments(segment_along(a, precision), point_segment(b.center, precision), 0, b.radius, distances,
                            scalar, precision);
}

}  // namespace contact::oracle
