// Questions about a sphere and a box.
#include <algorithm>
#include <cmath>
#include <utility>

#include "proptests/generators.hpp"

namespace contact::proptests {
namespace {

Query sphere_and_box_of(const std::vector<double>& x) {
  const Vector3 p(x[4], x[5], x[6]);
  const Vector3 q(x[7], x[8], x[9]);
  return {Pair::sphere_cube,
          BallAndBox{{{x[0], x[1], x[2]}, std::abs(x[3])}, {p.cwiseMin(q), p.cwiseMax(q)}},
          {std::abs(x[10]), std::abs(x[11])}};
}

/// Twelve numbers of one kind.
rc::Gen<Query> from(rc::Gen<double> number) { return rc::gen::map(numbers(12, std::move(number)), sphere_and_box_of); }

/// On some axes the centre is moved into the box, or onto a bound of it.
rc::Gen<Query> beside_a_feature(const Range& range, rc::Gen<double> number) {
  return rc::gen::map(rc::gen::tuple(from(std::move(number)), integer(0, 63), integer(-1, 1)),
                      [range](const std::tuple<Query, int, int>& parts) {
                        Query query = std::get<0>(parts);
                        const int where = std::get<1>(parts);
                        const int ulps = std::get<2>(parts);
                        auto& [a, b] = std::get<BallAndBox>(query.shapes);
                        for (int axis = 0; axis < 3; ++axis) {
                          const int how = where >> (2 * axis) & 3;
                          if (how == 1) a.center[axis] = std::clamp(a.center[axis], b.min[axis], b.max[axis]);
                          if (how == 2) a.center[axis] = range.moved(b.min[axis], ulps);
                          if (how == 3) a.center[axis] = range.moved(b.max[axis], ulps);
                        }
                        return query;
                      });
}

/// The centre is the middle of the box, from where no way out is shorter than its opposite.
rc::Gen<Query> in_the_middle(rc::Gen<double> number) {
  return rc::gen::map(from(std::move(number)), [](Query query) {
    auto& [a, b] = std::get<BallAndBox>(query.shapes);
    const Vector3 half = b.max / 2 - b.min / 2;
    b = {a.center - half, a.center + half};
    return query;
  });
}

/// The radius is the distance as double computes it, up to 2 ulps off.
rc::Gen<Query> near_touching(const Range& range, rc::Gen<double> number) {
  return rc::gen::map(rc::gen::tuple(beside_a_feature(range, std::move(number)), integer(-2, 2)),
                      [range](const std::tuple<Query, int>& parts) {
                        Query query = std::get<0>(parts);
                        const int ulps = std::get<1>(parts);
                        auto& [a, b] = std::get<BallAndBox>(query.shapes);
                        const Vector3 delta = a.center - a.center.cwiseMax(b.min).cwiseMin(b.max);
                        if (!delta.allFinite() || !std::isfinite(delta.stableNorm())) return query;
                        a.radius = std::max(0.0, range.moved(range.rounded(delta.stableNorm()), ulps));
                        query.distances.alarm = 0;
                        return query;
                      });
}

}  // namespace

rc::Gen<Query> sphere_on_box(const Range& /*range*/, rc::Gen<double> number) {
  return rc::gen::map(rc::gen::pair(from(std::move(number)), integer(1, 63)), [](std::pair<Query, int> parts) {
    auto& [a, b] = std::get<BallAndBox>(parts.first.shapes);
    a.center = a.center.cwiseMax(b.min).cwiseMin(b.max);
    for (int axis = 0; axis < 3; ++axis) {
      const int how = parts.second >> (2 * axis) & 3;
      if (how != 0) a.center[axis] = how == 1 ? b.min[axis] : how == 2 ? b.max[axis] : a.center[axis];
    }
    return parts.first;
  });
}

rc::Gen<Query> sphere_in_box(const Range& range, rc::Gen<double> number) {
  return rc::gen::map(from(std::move(number)), [range](Query query) {
    auto& [a, b] = std::get<BallAndBox>(query.shapes);
    for (int axis = 0; axis < 3; ++axis) {
      b.min[axis] = std::min(b.min[axis], range.moved(a.center[axis], -1));
      b.max[axis] = std::max(b.max[axis], range.moved(a.center[axis], 1));
    }
    return query;
  });
}

rc::Gen<Query> sphere_touching_box(const Range& range, bool by_alarm) {
  return rc::gen::map(rc::gen::pair(spheres_touching(range, by_alarm), integer(0, 7)),
                      [](const std::pair<Query, int>& parts) {
                        const auto& [touching, thick] = parts;
                        const auto& [a, b] = *touching.balls();
                        const Ball ball{a.center, a.radius + b.radius};
                        Box box{b.center, b.center};
                        for (int axis = 0; axis < 3; ++axis) {
                          // Away from the sphere, or on both sides of it.
                          const double apart = b.center[axis] - a.center[axis];
                          const double size = (thick >> axis & 1) == 0 ? 0 : std::max(ball.radius, std::abs(apart));
                          if (apart >= 0) box.max[axis] += size;
                          if (apart <= 0) box.min[axis] -= size;
                        }
                        return Query{Pair::sphere_cube, BallAndBox{ball, box}, touching.distances};
                      });
}

rc::Gen<Query> queries(const BallAndBox* /*kind*/, const Range& range) {
  return rc::gen::weightedOneOf<Query>({{2, from(any_number(range))},
                                        {2, from(any_bits(range))},
                                        {1, from(subnormal(range))},
                                        {1, from(extreme(range))},
                                        {1, from(huge(range))},
                                        {2, from(small_dyadic(range))},
                                        {2, beside_a_feature(range, any_number(range))},
                                        {3, beside_a_feature(range, ordinary(range))},
                                        {3, beside_a_feature(range, small_dyadic(range))},
                                        {2, in_the_middle(small_dyadic(range))},
                                        {1, near_touching(range, any_bits(range))},
                                        {1, near_touching(range, subnormal(range))},
                                        {2, near_touching(range, small_dyadic(range))},
                                        {3, near_touching(range, ordinary(range))}});
}

}  // namespace contact::proptests
