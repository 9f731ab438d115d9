// Questions about a sphere and a box.
#include <algorithm>
#include <cmath>
#include <utility>

#include "proptests/generators.hpp"

namespace contact::proptests {
namespace {

rc::Gen<Query> from(rc::Gen<double> number) { return made_of(Pair::sphere_cube, std::move(number)); }

/// On some axes the centre is moved into the box, or onto a bound of it.
rc::Gen<Query> beside_a_feature(const Range& range, rc::Gen<double> number) {
  return rc::gen::map(rc::gen::tuple(from(std::move(number)), integer(0, 63), integer(-1, 1)),
                      [range](const std::tuple<Query, int, int>& parts) {
                        auto [query, where, ulps] = parts;
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

/// The centre is the middle of the box, from where no way out is shorter than its opposite: of numbers that plain
/// arithmetic rounds it would take another.
rc::Gen<Query> in_the_middle(const Range& range) {
  return rc::gen::map(from(small_dyadic(range)), [](Query query) {
    auto& [a, b] = std::get<BallAndBox>(query.shapes);
    const Vector3 half = b.max / 2 - b.min / 2;
    b = {a.center - half, a.center + half};
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
  return at_every_scale(
      Pair::sphere_cube, range, [&](rc::Gen<double> number) { return beside_a_feature(range, std::move(number)); },
      rc::gen::oneOf(sphere_touching_box(range, false), sphere_touching_box(range, true), in_the_middle(range)));
}

}  // namespace contact::proptests
