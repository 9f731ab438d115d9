// A pair of capsules in intervals.
#include "oracle/truth/interval_segments.hpp"

namespace contact::oracle {

RoundedAnswer interval_answer(const Capsules& shapes, Distances distances, Scalar scalar, mpfr_prec_t precision) {
  const auto& [a, b] = shapes;
  return answer_of_segments({a.start, a.end}, {b.start, b.end}, a.radius, b.radius, distances, scalar, precision);
}

}  // namespace contact::oracle
