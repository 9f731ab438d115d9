// Questions about a ray and a sphere: those about a sphere and a capsule, whose axis is the ray; and rays of any
// numbers.
#include <algorithm>
#include <cmath>

#include "proptests/generators.hpp"

namespace contact::proptests {
namespace {

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

Query ray_of(const std::vector<double>& x) {
  Vector3 direction(x[3], x[4], x[5]);
  if (direction.isZero(0)) direction[0] = 1;
  return {Pair::ray_sphere,
          RayAndBall{{{x[0], x[1], x[2]}, direction, std::abs(x[6])}, {{x[7], x[8], x[9]}, std::abs(x[10])}},
          {std::abs(x[11]), std::abs(x[12])}};
}

}  // namespace

rc::Gen<Query> queries(const RayAndBall* /*kind*/, const Range& range) {
  const auto of_axes = rc::gen::map(
      rc::gen::pair(capsule_queries(range, true), integer(-3, 3)),
      [range](const std::pair<Query, int>& parts) { return along_axis(range, parts.first, parts.second); });
  const auto of = [](rc::Gen<double> number) { return rc::gen::map(numbers(13, std::move(number)), ray_of); };
  return rc::gen::weightedOneOf<Query>({{8, of_axes},
                                        {1, of(any_number(range))},
                                        {1, of(any_bits(range))},
                                        {1, of(ordinary(range))},
                                        {2, of(small_dyadic(range))}});
}

}  // namespace contact::proptests
