// Two axis-aligned boxes in intervals.
#include <algorithm>
#include <cstddef>

#include "oracle/truth/interval.hpp"

namespace contact::oracle {

RoundedAnswer interval_answer(const Boxes& boxes, Distances distances, Scalar /*scalar*/, mpfr_prec_t precision) {
  const Triple min1 = triple(precision, boxes.a.min);
  const Triple max1 = triple(precision, boxes.a.max);
  const Triple min2 = triple(precision, boxes.b.min);
  const Triple max2 = triple(precision, boxes.b.max);
  const Interval alarm(precision, distances.alarm);
  RoundedAnswer answer{-1, -1, {}};
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const Interval& gap : {min1[axis] - max2[axis], min2[axis] - max1[axis]}) {
      answer.at_alarm = std::max(answer.at_alarm, settled((gap - alarm).sign()));
      answer.at_zero = std::max(answer.at_zero, settled(gap.sign()));
    }
  answer.expected.hit = answer.at_alarm <= 0;
  return answer;
}

}  // namespace contact::oracle
