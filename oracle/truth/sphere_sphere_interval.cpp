// Two spheres in intervals.
#include "oracle/truth/interval.hpp"

namespace contact::oracle {

RoundedAnswer interval_answer(const Balls& balls, Distances distances, Scalar scalar, mpfr_prec_t precision) {
  const Triple p = triple(precision, balls.a.center);
  return answer_of_nearest(nearest_of_points(p, triple(precision, balls.b.center), precision),
                           Interval(precision, balls.a.radius), Interval(precision, balls.b.radius), distances, scalar,
                           precision);
}

}  // namespace contact::oracle
