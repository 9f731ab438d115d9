// Two spheres in intervals.
#include <cstddef>

#include "oracle/truth/interval.hpp"

namespace contact::oracle {

RoundedAnswer interval_answer(const Balls& balls, Distances distances, Scalar scalar, mpfr_prec_t precision) {
  const Triple c1 = triple(precision, balls.a.center);
  const Triple c2 = triple(precision, balls.b.center);
  const Triple delta{c2[0] - c1[0], c2[1] - c1[1], c2[2] - c1[2]};
  const Interval r1(precision, balls.a.radius);
  const Interval r2(precision, balls.b.radius);
  const Interval D = delta[0].squared() + delta[1].squared() + delta[2].squared();
  const Interval reach = Interval(precision, distances.alarm) + r1 + r2;

  RoundedAnswer answer{settled((D - reach.squared()).sign()), settled((D - (r1 + r2).squared()).sign()), {}};
  answer.expected.hit = answer.at_alarm <= 0;
  if (!answer.expected.hit) return answer;

  Contact contact{};
  contact.degenerate = settled(D.sign()) == 0;
  const Interval root = D.root();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Interval n = contact.degenerate ? Interval(precision, axis == 0 ? 1.0 : 0.0) : delta[axis] / root;
    // (r delta) / root and not r (delta / root): the product is exact at some precision, so a tie can be seen.
    const Interval along1 = contact.degenerate ? r1 * n : (r1 * delta[axis]) / root;
    const Interval along2 = contact.degenerate ? r2 * n : (r2 * delta[axis]) / root;
    const auto i = static_cast<Eigen::Index>(axis);
    contact.normal[i] = settled(n.rounded(scalar));
    contact.point1[i] = settled((c1[axis] + along1).rounded(scalar));
    contact.point2[i] = settled((c2[axis] - along2).rounded(scalar));
  }
  contact.value = settled((root - (r1 + r2) - Interval(precision, distances.contact)).rounded(scalar));
  answer.expected.contact = contact;
  return answer;
}

}  // namespace contact::oracle
