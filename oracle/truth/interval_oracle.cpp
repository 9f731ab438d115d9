// The second oracle: MPFR intervals with outward rounding.
#include "oracle/truth/interval_oracle.hpp"

#include <limits>

#include "oracle/truth/default_environment.hpp"
#include "oracle/truth/interval.hpp"

namespace contact::oracle {
namespace {

constexpr mpfr_prec_t kFirstPrecision = 192;

}  // namespace

RoundedAnswer answer_of_nearest(const Triple& p, const Triple& q, const Interval& r1, const Interval& r2,
                                Distances distances, Scalar scalar, mpfr_prec_t precision) {
  const Triple delta{q[0] - p[0], q[1] - p[1], q[2] - p[2]};
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
    contact.point1[i] = settled((p[axis] + along1).rounded(scalar));
    contact.point2[i] = settled((q[axis] - along2).rounded(scalar));
  }
  contact.value = settled((root - (r1 + r2) - Interval(precision, distances.contact)).rounded(scalar));
  answer.expected.contact = contact;
  return answer;
}

std::optional<RoundedAnswer> interval_answer_within(int most, const Query& query, Scalar scalar) {
  const DefaultEnvironment environment;
  for (mpfr_prec_t precision = kFirstPrecision; precision <= most; precision *= 2) {
    try {
      return std::visit([&](const auto& shapes) { return interval_answer(shapes, query.distances, scalar, precision); },
                        query.shapes);
    } catch (const Undecided&) {
    }
  }
  return std::nullopt;
}

RoundedAnswer interval_answer(const Query& query, Scalar scalar) {
  return *interval_answer_within(std::numeric_limits<int>::max(), query, scalar);
}

}  // namespace contact::oracle
