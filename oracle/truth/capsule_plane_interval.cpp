// A capsule and a plane in intervals.
#include "oracle/truth/interval_planes.hpp"

namespace contact::oracle {

RoundedAnswer interval_answer(const CapsuleAndPlane& shapes, Distances distances, Scalar scalar,
                              mpfr_prec_t precision) {
  const auto& [a, b] = shapes;
  return answer_over_plane({a.start, a.end}, a.radius, b, distances, scalar, precision);
}

}  // namespace contact::oracle
