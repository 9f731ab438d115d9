// A ray and a sphere in intervals.
#include "oracle/truth/interval_segments.hpp"

namespace contact::oracle {

RoundedAnswer interval_answer(const RayAndBall& shapes, Distances distances, Scalar scalar, mpfr_prec_t precision) {
  const auto& [a, b] = shapes;
  const Interval length(precision, a.length);
  const Triple direction = triple(precision, a.direction);
  const IntervalSegment ray{triple(precision, a.origin),
                            {length * direction[0], length * direction[1], length * direction[2]}};
  return answer_of_segments(ray, point_segment(b.center, precision), 0, b.radius, distances, scalar, precision);
}

}  // namespace contact::oracle
