// A sphere and a capsule in intervals.
#include "oracle/truth/interval_segments.hpp"

namespace contact::oracle {

RoundedAnswer interval_answer(const BallAndCapsule& shapes, Distances distances, Scalar scalar, mpfr_prec_t precision) {
  const auto& [a, b] = shapes;
  return answer_of_segments(point_segment(a.center, precision), segment_between(b.start, b.end, precision), a.radius,
                            b.radius, distances, scalar, precision);
}

}  // namespace contact::oracle
