// The interval oracle: MPFR intervals with outward rounding.
#include "oracle/truth/interval_oracle.hpp"

#include <algorithm>
#include <limits>

#include "oracle/truth/default_environment.hpp"
#include "oracle/truth/interval_cores.hpp"

namespace contact::oracle {
namespace {

constexpr mpfr_prec_t kFirstPrecision = 192;
constexpr mpfr_prec_t kFirstOfConvexes = 384;  // what turned boxes are made of has more digits

// Of each pair at a precision; Undecided is thrown where that is too low.

RoundedAnswer answer(const Boxes& boxes, Distances distances, Scalar /*scalar*/, mpfr_prec_t precision) {
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

RoundedAnswer answer(const RayAndTriangle& shapes, Distances /*distances*/, Scalar scalar, mpfr_prec_t precision) {
  return answer_of_crossing(interval_core(shapes.a, precision), shapes.b, -1, scalar, precision);
}
RoundedAnswer answer(const TriangleAndLine& shapes, Distances /*distances*/, Scalar scalar, mpfr_prec_t precision) {
  return answer_of_crossing(interval_core(shapes.b, precision), shapes.a, 1, scalar, precision);
}

template <class A, class B>
RoundedAnswer answer(const Two<A, B>& shapes, Distances distances, Scalar scalar, mpfr_prec_t precision) {
  const auto& [a, b] = shapes;
  if constexpr (std::same_as<A, Cast>) {
    return answer_of_cast(shapes, scalar, precision);
  } else if constexpr (std::same_as<B, Plane>) {
    return answer_of_cores(interval_core(a, precision), b, distances, scalar, precision);
  } else {
    static_assert(kCoresAreSimple<A, B>);
    return answer_of_cores(interval_core(a, precision), interval_core(b, precision), distances, scalar, precision);
  }
}

RoundedAnswer answer(const Convexes& shapes, Distances distances, Scalar scalar, mpfr_prec_t precision) {
  const auto core = [&](const Convex& convex) {
    return std::visit(
        [&]<class Shape>(const Shape& shape) {
          if constexpr (std::same_as<Shape, Plane>)
            return IntervalCore{};  // it is none
          else
            return interval_core(shape, precision);
        },
        convex.shape);
  };
  const IntervalCore a = core(shapes.a);
  if (const auto* plane = std::get_if<Plane>(&shapes.b.shape))
    return answer_of_cores(a, *plane, distances, scalar, precision);
  return answer_of_convexes(a, core(shapes.b), distances, scalar, precision);
}

}  // namespace

MarginBounds margin_of(const Interval& off, const Interval& reach, Scalar scalar) {
  const Format format = format_of(scalar);
  const std::optional<long> exponent = reach.exponent();
  if (!exponent) return {};
  return off.scaled(format.precision - 1 - std::max<long>(*exponent, format.min_exponent)).ends();
}

RoundedAnswer answer_of_nearest(const IntervalNearest& nearest, const Interval& r1, const Interval& r2,
                                Distances distances, Scalar scalar, mpfr_prec_t precision) {
  const auto& [p, q, over, agreed, unique] = nearest;
  const auto squared_length = [](const Triple& x) { return x[0].squared() + x[1].squared() + x[2].squared(); };
  const Triple delta{q[0] - p[0], q[1] - p[1], q[2] - p[2]};
  const Interval D = squared_length(delta);  // over^2 times that of the cores
  const Interval reach = (Interval(precision, distances.alarm) + r1 + r2) * over;

  RoundedAnswer answer{settled((D - reach.squared()).sign()), settled((D - ((r1 + r2) * over).squared()).sign()), {}};
  answer.margin = margin_of((D.root() - reach) / over, Interval(precision, distances.alarm) + r1 + r2, scalar);
  answer.expected.hit = answer.at_alarm <= 0;
  if (!answer.expected.hit) return answer;

  Contact contact{};
  contact.degenerate = settled(D.sign()) == 0;
  contact.unique = unique;
  const Triple& along = contact.degenerate ? agreed : delta;
  const Interval length = squared_length(along).root();
  // (r along) / length and not r (along / length): the product is exact at some precision, so a tie can be seen. Over
  // the denominator a tie has an exact sum before it, and with it an exact quotient by the length.
  contact.normal = rounded(scalar, [&](std::size_t i) { return along[i] / length; });
  contact.point1 = rounded(
      scalar, [&](std::size_t i) { return (nearest.p[i] + (r1 * nearest.over * along[i]) / length) / nearest.over; });
  contact.point2 = rounded(
      scalar, [&](std::size_t i) { return (nearest.q[i] - (r2 * nearest.over * along[i]) / length) / nearest.over; });
  const Interval less = (r1 + r2 + Interval(precision, distances.contact)) * over;
  contact.value = settled(((D.root() - less) / over).rounded(scalar));
  answer.expected.contact = contact;
  return answer;
}

std::optional<RoundedAnswer> interval_answer_within(int most, const Query& query, Scalar scalar) {
  const DefaultEnvironment environment;
  for (mpfr_prec_t precision = is_convex(query.pair) ? kFirstOfConvexes : kFirstPrecision; precision <= most;
       precision *= 2) {
    try {
      return std::visit([&](const auto& shapes) { return answer(shapes, query.distances, scalar, precision); },
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
