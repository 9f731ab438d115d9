// The double-double stage: pairs of doubles with a radius of error. It proves an answer, or has none.
#include "oracle/truth/double_double_oracle.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "oracle/truth/default_environment.hpp"
#include "oracle/truth/double_double_segments.hpp"

namespace contact::oracle {
namespace {

#if defined(__x86_64__) && !defined(__FMA__)
/// Never inlined: the environment must be set before anything is computed.
template <class Work>
[[gnu::noinline, gnu::flatten, gnu::target("fma")]] auto by_fma(const Work& work) {
  return work();
}
#endif
/// What work() returns, std::fma being an instruction and no function where the processor has one: the same bits. As in
/// production, with which an oracle shares no code.
template <class Work>
auto with_fma(const Work& work) {
#if defined(__x86_64__) && !defined(__FMA__)
  if (__builtin_cpu_supports("fma")) return by_fma(work);
#endif
  return work();
}

}  // namespace

MarginBounds margin_of(const DoubleDouble& past, const DoubleDouble& reach, Scalar scalar) {
  const Format format = format_of(scalar);
  // The unit is a power of two and, as the answer, far from the ends of the range: scaling commutes with rounding.
  const auto [low, high] = bracket(past);
  if (!in_range(low, 500) || !in_range(high, 500)) return {};
  if (reach.high == 0) {
    const int power = format.precision - 1 - format.min_exponent;
    return {std::ldexp(low, power), std::ldexp(high, power)};
  }
  // No other double lies between high and the real number, so both have one exponent, but for a power of two that is
  // approached from below.
  const auto bits = std::bit_cast<std::uint64_t>(reach.high);
  if (bits << 12 == 0 && (reach.low < 0 || reach.radius != 0)) return {};
  const int exponent = std::max(static_cast<int>(bits >> 52) - 1023, format.min_exponent);
  const auto scale = std::bit_cast<double>(static_cast<std::uint64_t>(1023 + format.precision - 1 - exponent) << 52);
  return {low * scale, high * scale};
}

std::optional<RoundedAnswer> case_along(const DoubleDoubleAlong& along, double radius1, double radius2,
                                        Distances distances, Scalar scalar) {
  const DoubleDouble radii = two_sum(radius1, radius2);
  RoundedAnswer found{along.at_alarm, along.at_zero, {along.at_alarm <= 0, std::nullopt}};
  const DoubleDouble reach = plus(radii, distances.alarm);
  found.margin = margin_of(along.past_reach.value_or(along.distance - reach), reach, scalar);
  if (!found.expected.hit) return found;

  bool all_known = true;
  const auto rounded = [&](const DoubleDouble& x) {
    const std::optional<double> number = round_to_nearest(x, scalar);
    all_known = all_known && number.has_value();
    return number.value_or(0);
  };
  Contact contact;  // every member is set below: nothing is cleared before
  contact.degenerate = along.degenerate;
  contact.unique = along.unique;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    const DoubleDouble& n = along.normal[i];
    contact.normal[axis] = rounded(n);
    contact.point1[axis] = rounded(along.p[i] + DoubleDouble{radius1} * n);
    contact.point2[axis] = rounded(along.q[i] - DoubleDouble{radius2} * n);
  }
  contact.value = rounded(along.value.value_or(along.distance - plus(radii, distances.contact)));
  if (!all_known) return std::nullopt;
  found.expected.contact = contact;
  return found;
}

std::optional<RoundedAnswer> case_of_nearest(const DoubleDoubleNearest& nearest, double radius1, double radius2,
                                             Distances distances, Scalar scalar, const std::optional<Excess>& excess) {
  const auto& [p, q, delta] = nearest;
  const DoubleDouble D = dot(delta, delta);
  if (D.radius > D.high * 0x1p-20) return std::nullopt;
  const DoubleDouble radii = two_sum(radius1, radius2);
  const DoubleDouble reach = plus(radii, distances.alarm);
  const auto at_alarm = (excess ? excess->at_alarm : D - reach * reach).sign();
  const auto at_zero = (excess ? excess->at_zero : D - radii * radii).sign();
  if (!at_alarm || !at_zero) return std::nullopt;
  if (D.high == 0) {
    const DoubleDoubles agreed{{{1.0}, {0.0}, {0.0}}};
    return case_along({p, q, agreed, {}, *at_alarm, *at_zero, true, true}, radius1, radius2, distances, scalar);
  }
  // Where they touch, the distance is a sum of lengths, which a root could only come near.
  const DoubleDouble distance = *at_zero == 0 ? radii : *at_alarm == 0 ? reach : root(D);
  const DoubleDouble inverse = reciprocal(distance);
  const DoubleDoubles normal{delta[0] * inverse, delta[1] * inverse, delta[2] * inverse};
  std::optional<DoubleDouble> past_reach;
  std::optional<DoubleDouble> value;
  if (excess && *at_zero != 0 && *at_alarm != 0) {
    // s - T = (D - T^2) / (s + T)
    const auto past = [&](const DoubleDouble& by, const DoubleDouble& length) {
      return by * reciprocal(distance + length);
    };
    past_reach = past(excess->at_alarm, reach);
    value = past(excess->at_contact, plus(radii, distances.contact));
  }
  return case_along({p, q, normal, distance, *at_alarm, *at_zero, false, true, past_reach, value}, radius1, radius2,
                    distances, scalar);
}

namespace {

std::optional<RoundedAnswer> answer(const Boxes& boxes, Distances distances, Scalar /*scalar*/) {
  const auto& [a, b] = boxes;
  constexpr double kLargest = 0x1p1000;  // sums of three, which is all that boxes need, stay finite
  const auto most = [](const Vector3& v) { return v.array().abs().maxCoeff(); };
  if (!(std::max({most(a.min), most(a.max), most(b.min), most(b.max), distances.alarm}) <= kLargest))
    return std::nullopt;
  RoundedAnswer found{-1, -1, {}};
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    for (const DoubleDouble& gap : {two_sum(a.min[axis], -b.max[axis]), two_sum(b.min[axis], -a.max[axis])}) {
      const auto at_alarm = (gap - DoubleDouble{distances.alarm}).sign();
      const auto at_zero = gap.sign();
      if (!at_alarm || !at_zero) return std::nullopt;
      found.at_alarm = std::max(found.at_alarm, *at_alarm);
      found.at_zero = std::max(found.at_zero, *at_zero);
    }
  found.expected.hit = found.at_alarm <= 0;
  return found;
}

Ends ends_of(const Ball& ball) { return {ball.center, ball.center}; }
Ends ends_of(const Capsule& capsule) { return {capsule.start, capsule.end}; }

std::optional<RoundedAnswer> answer(const RayAndBall& shapes, Distances distances, Scalar scalar) {
  const auto& [a, b] = shapes;
  if (!in_short_range({a.origin, b.center}) || !in_range_of_factors(a)) return std::nullopt;
  DoubleDoubleSegment ray{a.origin, along(a), exactly(a.origin), a.length == 0};
  for (std::size_t i = 0; i < 3; ++i) ray.end[i] = ray.end[i] + ray.along[i];
  const auto nearest = foot(b.center, ray);
  return case_of_apart(nearest ? std::optional(turned_round(*nearest)) : std::nullopt, 0, b.radius, distances, scalar);
}
std::optional<RoundedAnswer> answer(const RayAndTriangle& shapes, Distances /*distances*/, Scalar scalar) {
  const auto& [a, b] = shapes;
  if (!in_short_range({a.origin, a.origin}) || !in_range_of_factors(a)) return std::nullopt;
  return case_of_crossing(a.origin, along(a), b, -1, scalar);
}
std::optional<RoundedAnswer> answer(const TriangleAndLine& shapes, Distances /*distances*/, Scalar scalar) {
  const auto& [a, b] = shapes;
  if (!in_short_range({b.start, b.end})) return std::nullopt;
  return case_of_crossing(b.start, difference(b.end, b.start), a, 1, scalar);
}

template <class A, class B>
std::optional<RoundedAnswer> answer(const Two<A, B>& shapes, Distances distances, Scalar scalar) {
  const auto& [a, b] = shapes;
  if constexpr (std::same_as<A, Cast>)
    return std::nullopt;  // other oracles are asked
  else if constexpr (std::same_as<A, Convex>)
    return case_of_convexes(shapes, distances, scalar);
  else if constexpr (std::same_as<B, Plane>)
    return case_over_plane(ends_of(a), a.radius, b, distances, scalar);
  else if constexpr (std::same_as<B, Capsule>)
    return case_of_segments(ends_of(a), ends_of(b), a.radius, b.radius, distances, scalar);
  else
    return double_double_answer(shapes, distances, scalar);
}

}  // namespace

std::optional<RoundedAnswer> double_double_answer_without_fma(const Query& query, Scalar scalar) {
  const DefaultEnvironment environment;
  return std::visit([&](const auto& shapes) { return answer(shapes, query.distances, scalar); }, query.shapes);
}

std::optional<RoundedAnswer> double_double_answer(const Query& query, Scalar scalar) {
  const DefaultEnvironment environment;
  return std::visit(
      [&](const auto& shapes) { return with_fma([&] { return answer(shapes, query.distances, scalar); }); },
      query.shapes);
}

}  // namespace contact::oracle
