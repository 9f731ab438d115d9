// A pair of capsules in intervals.
#include "oracle/truth/interval_segments.hpp"

namespace contact::oracle {

RoundedAnswer interval_answer(const Capsules& shapes, Distances distances, Scalar scalar, mpfr_prec_t precision) {
  const auto& [a, b] = shapes;
  return answer_of_segments(segment_between(a.start, a.end, precision), segment_between(b.start, b.end, precision),
                            a.radius, b.radius, distances, scalar, precision);
}

}  // namespace contact::oracle
