// Questions about two spheres.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "proptests/generators.hpp"

namespace contact::proptests {
namespace {

Query spheres_of(const std::vector<double>& x) {
  return {Pair::sphere_sphere,
          Balls{{{x[0], x[1], x[2]}, std::abs(x[3])}, {{x[4], x[5], x[6]}, std::abs(x[7])}},
          {std::abs(x[8]), std::abs(x[9])}};
}

/// Ten numbers of one kind.
rc::Gen<Query> spheres_from(rc::Gen<double> number) { return rc::gen::map(numbers(10, std::move(number)), spheres_of); }

/// Two centres a quadruple apart, on integers below 32 times a power of two.
struct Apart {
  Ball a;
  Ball b;
  int distance;
  std::vector<int> k;  ///< seven more integers, -9 .. 9
  double unit;
};
rc::Gen<Apart> apart(const Range& range, int highest) {
  const int most = std::max(range.bottom, std::min(range.top, highest) - 5);
  return rc::gen::map(
      rc::gen::tuple(rc::gen::elementOf(kQuadruples), rc::gen::container<std::vector<int>>(7, integer(-9, 9)),
                     integer(range.bottom, most)),
      [](const std::tuple<Quadruple, std::vector<int>, int>& parts) {
        const auto& [quadruple, k, exponent] = parts;
        const double unit = std::ldexp(1.0, exponent);
        Apart made{{{k[0] * unit, k[1] * unit, k[2] * unit}, 0}, {}, quadruple[3], k, unit};
        made.b = made.a;
        for (int axis = 0; axis < 3; ++axis) {
          const auto i = static_cast<std::size_t>(axis);
          const int step = quadruple[(i + static_cast<std::size_t>(k[3] + 9)) % 3];
          made.b.center[axis] = (k[i] + (k[4 + i % 2] % 2 == 0 ? step : -step)) * unit;
        }
        return made;
      });
}

}  // namespace

rc::Gen<Query> spheres_near_touching(const Range& range, rc::Gen<double> number) {
  return rc::gen::map(rc::gen::tuple(spheres_from(std::move(number)), integer(-2, 2), integer(0, 1)),
                      [range](const std::tuple<Query, int, int>& parts) {
                        auto [query, ulps, by_alarm] = parts;
                        auto& [a, b] = std::get<Balls>(query.shapes);
                        const Vector3 delta = b.center - a.center;
                        const double distance = range.rounded(delta.stableNorm());
                        if (!delta.allFinite() || !std::isfinite(delta.stableNorm())) return query;
                        if (a.radius > distance) a.radius = range.rounded(distance / 2);
                        if (by_alarm == 0) {
                          query.distances.alarm = 0;
                          b.radius = std::max(0.0, range.moved(range.rounded(distance - a.radius), ulps));
                        } else {
                          b.radius = std::min(b.radius, range.rounded((distance - a.radius) / 2));
                          query.distances.alarm =
                              std::max(0.0, range.moved(range.rounded(distance - (a.radius + b.radius)), ulps));
                        }
                        return query;
                      });
}

rc::Gen<Query> spheres_on_a_quadruple(const Range& range) {
  return rc::gen::map(
      rc::gen::tuple(apart(range, format_of(range.scalar).max_exponent), integer(-2, 1), integer(0, 2)),
      [range](const std::tuple<Apart, int, int>& parts) {
        auto [made, ulps, lengths] = parts;
        auto& [a, b, distance, k, unit] = made;
        // The distance is shared out to both radii, or to one radius and the alarm; the last part moves by ulps.
        const int first = std::abs(k[6]) % (distance + 1);
        const double last = std::max(0.0, range.moved((distance - first) * unit, ulps));
        a.radius = lengths == 2 ? 0 : first * unit;
        b.radius = lengths == 1 ? 0 : lengths == 2 ? first * unit : last;
        return Query{Pair::sphere_sphere, Balls{a, b}, {lengths == 0 ? 0 : last, std::abs(k[5]) * unit}};
      });
}

rc::Gen<Query> spheres_coincident(const Range& range, rc::Gen<double> number, bool exactly) {
  return rc::gen::map(rc::gen::pair(spheres_from(std::move(number)), integer(0, 3)),
                      [range, exactly](std::pair<Query, int> parts) {
                        auto& [a, b] = std::get<Balls>(parts.first.shapes);
                        b.center = a.center;
                        if (parts.second == 0 && !exactly)
                          b.center = -b.center.cwiseAbs().cwiseMin(std::ldexp(1.0, range.bottom));
                        return parts.first;
                      });
}

rc::Gen<Query> spheres_touching(const Range& range, bool by_alarm) {
  return rc::gen::map(apart(range, format_of(range.scalar).max_exponent), [by_alarm](const Apart& made) {
    auto [a, b, distance, k, unit] = made;
    const int first = std::abs(k[6]) % (distance + 1);
    const int second = by_alarm ? std::abs(k[4]) % (distance - first + 1) : distance - first;
    a.radius = first * unit;
    b.radius = second * unit;
    const double alarm = (distance - first - second) * unit;
    return Query{Pair::sphere_sphere, Balls{a, b}, {alarm, std::abs(k[5]) * unit}};
  });
}

rc::Gen<Query> sphere_queries(const Range& range) {
  return rc::gen::weightedOneOf<Query>({{2, spheres_from(any_number(range))},
                                        {2, spheres_from(any_bits(range))},
                                        {1, spheres_from(subnormal(range))},
                                        {1, spheres_from(extreme(range))},
                                        {2, spheres_from(huge(range))},
                                        {2, spheres_from(small_dyadic(range))},
                                        {1, spheres_from(beside_dyadic(range))},
                                        {2, spheres_from(ordinary(range))},
                                        {4, spheres_near_touching(range, ordinary(range))},
                                        {1, spheres_near_touching(range, any_bits(range))},
                                        {1, spheres_near_touching(range, subnormal(range))},
                                        {5, spheres_on_a_quadruple(range)},
                                        {2, spheres_coincident(range, any_number(range), false)},
                                        {1, spheres_coincident(range, huge(range), false)}});
}

rc::Gen<Query> queries(const Balls* /*kind*/, const Range& range) { return sphere_queries(range); }

}  // namespace contact::proptests
