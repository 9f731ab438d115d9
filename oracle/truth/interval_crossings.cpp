// A segment that crosses a triangle, in intervals, by the Plücker coordinates of lines: d and m = a x d of the
// segment's.
//   side of an edge from v along e     d.(v x e) + m.e     the same sign for all three edges where the line crosses
//   the plane N.x = o is met           at (N x m + o d) / N.d
//   the ends                           on either side of the plane, or on it
#include "oracle/truth/interval_cores.hpp"

#include <cstddef>

namespace contact::oracle {
RoundedAnswer answer_of_crossing(const IntervalCore& segment, const Triangle& triangle, int sign, Scalar scalar,
                                 mpfr_prec_t precision) {
  const RoundedAnswer miss{1, 1, {}};
  const Triple& from = segment.vertices[0];
  const Triple along = difference(segment.vertices[1], from);
  const auto vertex = [&](std::size_t k) { return triple(precision, triangle.vertices[k % 3]); };
  const Triple n = cross(difference(vertex(1), vertex(0)), difference(vertex(2), vertex(0)));
  const Interval through = dot(n, along);
  if (sign_of(through) == 0) return miss;

  const Triple moment = cross(from, along);
  for (std::size_t k = 0; k < 3; ++k) {
    const Triple edge = difference(vertex(k + 1), vertex(k));
    const Interval side = dot(along, cross(vertex(k), edge)) + dot(moment, edge);
    if (sign_of(side) * sign_of(through) < 0) return miss;
  }
  const Interval offset = dot(n, vertex(0));
  const Interval start = dot(n, from) - offset;
  const Interval end = start + through;
  if (sign_of(start) * sign_of(end) > 0) return miss;

  RoundedAnswer answer{-1, -1, {true, std::nullopt}};
  Contact contact{};
  contact.degenerate = false;
  contact.unique = true;
  const Triple turned = cross(n, moment);
  const Interval length = dot(n, n).root();
  const Interval direction(precision, sign);
  contact.normal = rounded(scalar, [&](std::size_t i) { return direction * n[i] / length; });
  contact.point1 = rounded(scalar, [&](std::size_t i) { return (turned[i] + offset * along[i]) / through; });
  contact.point2 = contact.point1;
  contact.value = 0;
  answer.expected.contact = contact;
  return answer;
}

}  // namespace contact::oracle
