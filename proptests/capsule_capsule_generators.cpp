// Questions about two capsules; about a sphere and a capsule; and about a ray, which is such an axis, and a sphere.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "proptests/generators.hpp"

namespace contact::proptests {
namespace {

/// The point of the range next to start + part (end - start) + off.
Vector3 along(const Range& range, const Capsule& capsule, double part, const Vector3& off) {
  return range.rounded(capsule.start + part * (capsule.end - capsule.start) + off);
}

/// How the second capsule lies to the first, or the first one to a sphere that is its first end.
enum class Lying { across, level_with_an_end, parallel, collinear, meeting, without_length, tiny };

/// What is exact for small integers is nearly so for other numbers. `zeros` are the axes that the second one is level
/// with.
Query laid(const Range& range, Query query, Lying lying, int zeros, double part, double length, int ulps) {
  auto& [a, b] = std::get<Capsules>(query.shapes);
  for (int axis = 0; axis < 3; ++axis)
    if ((zeros >> axis & 1) != 0) b.end[axis] = b.start[axis];
  const Vector3 u = b.end - b.start;
  const Vector3 off = u.cross(a.end);  // at right angles
  const Capsule whole = b;
  switch (lying) {
    case Lying::across:
      a.start = along(range, b, part, off);
      break;
    case Lying::level_with_an_end:
      a.start = along(range, b, part < 0.5 ? 0 : 1, off);
      a.start[0] = range.moved(a.start[0], ulps);
      a.end = along(range, {a.start, a.start + off, 0}, std::abs(length), Vector3::Zero());
      break;
    case Lying::parallel:
      a.start = along(range, b, part, a.end);
      a.end = along(range, {a.start, a.start + u, 0}, length, Vector3::Zero());
      a.end[1] = range.moved(a.end[1], ulps);
      break;
    case Lying::collinear:
      a.start = along(range, b, part, Vector3::Zero());
      a.end = along(range, b, part + length, Vector3::Zero());
      break;
    case Lying::meeting:
      b.start = along(range, whole, 0, a.start - along(range, whole, part, Vector3::Zero()));
      b.end = along(range, whole, 1, b.start - whole.start);
      a = {along(range, a, -length, Vector3::Zero()), a.end, a.radius};
      break;
    case Lying::without_length:
      (length < 0 ? a.end : b.end) = length < 0 ? a.start : b.start;
      if (part == 0) a.end = a.start = b.start;
      break;
    case Lying::tiny:
      b.end = b.start;
      b.end[1] = range.moved(b.end[1], ulps);
      b.end[2] = range.moved(b.end[2], -ulps);
      break;
  }
  return query;
}

rc::Gen<Query> laid_out(const Range& range, rc::Gen<double> number) {
  return rc::gen::map(rc::gen::tuple(made_of(Pair::capsule_capsule, std::move(number)), integer(0, 6), integer(0, 15),
                                     integer(-2, 6), integer(1, 12), integer(-1, 1)),
                      [range](const std::tuple<Query, int, int, int, int, int>& parts) {
                        const auto& [query, how, zeros, quarters, length, ulps] = parts;
                        return laid(range, query, static_cast<Lying>(how), zeros < 8 ? zeros : 0, quarters / 4.0,
                                    (length - 6.5) / 2 + 0.25, ulps);
                      });
}

Query as_asked(Query query, bool first_is_a_sphere) {
  if (!first_is_a_sphere) return query;
  const auto [a, b] = std::get<Capsules>(query.shapes);
  return {Pair::sphere_capsule, BallAndCapsule{{a.start, a.radius}, b}, query.distances};
}

/// Capsules that reach each other exactly, at alarm 0 or by an alarm distance: axes at right angles to a quadruple,
/// from one end of it to the other, on integers times a power of two.
rc::Gen<Query> exactly_touching(const Range& range, bool first_is_a_sphere) {
  return rc::gen::map(
      rc::gen::tuple(rc::gen::elementOf(kQuadruples), rc::gen::container<std::vector<int>>(9, integer(0, 9)),
                     integer(range.bottom, std::max(range.bottom, range.top - 12))),
      [first_is_a_sphere](const std::tuple<Quadruple, std::vector<int>, int>& parts) {
        const auto& [quadruple, k, exponent] = parts;
        const Vector3 delta(quadruple[0], quadruple[1], k[0] < 5 ? quadruple[2] : -quadruple[2]);
        const auto across = [&](int axis) {
          const Vector3 way = delta.cross(Vector3::Unit(axis % 3));
          return way.isZero() ? delta.cross(Vector3::Unit((axis + 1) % 3)) : way;
        };
        const Vector3 q(k[0], k[1], k[2]);
        const Vector3 p = q - delta;
        const int back = first_is_a_sphere ? 0 : k[5];
        const double first = std::min(k[3], quadruple[3]);
        const double alarm = k[4] < 5 ? 0 : (quadruple[3] - first) / 2;
        const double unit = std::ldexp(1.0, exponent);
        return Query{Pair::capsule_capsule,
                     Capsules{{unit * (p - back * across(k[1])), unit * (p + k[6] * across(k[1])), unit * first},
                              {unit * (q - k[7] * across(k[2])), unit * (q + k[8] * across(k[2])),
                               unit * (quadruple[3] - first - alarm)}},
                     {unit * alarm, unit * k[4]}};
      });
}

/// `exponent` moves powers of two from the direction to the length.
Query along_axis(const Range& range, const Query& query, int exponent) {
  const auto& [ball, capsule] = std::get<BallAndCapsule>(query.shapes);
  const double times = std::ldexp(1.0, exponent);
  Vector3 direction = (capsule.end - capsule.start) / times;
  for (double& x : direction) x = std::isfinite(x) ? range.rounded(x) : range.rounded(1);
  const bool none = direction.isZero(0);
  if (none) direction = Vector3(1, 2, -2);
  const double radius = range.rounded(ball.radius + capsule.radius);
  return {Pair::ray_sphere,
          RayAndBall{{capsule.start, direction, none ? 0 : times}, {ball.center, std::isfinite(radius) ? radius : 1}},
          query.distances};
}

/// Of two capsules, or of a sphere that is the first start and a capsule.
rc::Gen<Query> capsule_queries(const Range& range, bool first_is_a_sphere) {
  const auto asked = [&](rc::Gen<Query> gen) {
    return rc::gen::map(std::move(gen),
                        [first_is_a_sphere](const Query& query) { return as_asked(query, first_is_a_sphere); });
  };
  return at_every_scale(
      first_is_a_sphere ? Pair::sphere_capsule : Pair::capsule_capsule, range,
      [&](rc::Gen<double> number) { return asked(laid_out(range, std::move(number))); },
      asked(exactly_touching(range, first_is_a_sphere)));
}

}  // namespace

rc::Gen<Query> queries(const Capsules* /*kind*/, const Range& range) { return capsule_queries(range, false); }
rc::Gen<Query> queries(const BallAndCapsule* /*kind*/, const Range& range) { return capsule_queries(range, true); }

rc::Gen<Query> queries(const RayAndBall* /*kind*/, const Range& range) {
  const auto of_axes = rc::gen::map(
      rc::gen::pair(capsule_queries(range, true), integer(-3, 3)),
      [range](const std::pair<Query, int>& parts) { return along_axis(range, parts.first, parts.second); });
  return rc::gen::weightedOneOf<Query>({{8, of_axes},
                                        {1, made_of(Pair::ray_sphere, any_number(range))},
                                        {1, made_of(Pair::ray_sphere, any_bits(range))},
                                        {1, made_of(Pair::ray_sphere, ordinary(range))},
                                        {2, made_of(Pair::ray_sphere, small_dyadic(range))}});
}

}  // namespace contact::proptests
