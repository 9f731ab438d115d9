// Two spheres in intervals.
#include "oracle/truth/interval.hpp"

namespace contact::oracle {

RoundedAnswer interval_answer(const Balls& balls, Distances distances, Scalar scalar, mpfr_prec_t precision) {
  return answer_of_nearest(triple(precision, balls.a.center), triple(precision, balls.b.center),
                           Interval(precision, balls.a.radius), Interval(precision, balls.b.radius), distances, scalar,
                           precision);
}

}  // namespace contact::oracle
