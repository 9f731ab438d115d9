// Questions about two spheres.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "proptests/generators.hpp"

namespace contact::proptests {
namespace {

rc::Gen<Query> spheres_from(rc::Gen<double> number) { return made_of(Pair::sphere_sphere, std::move(number)); }

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

rc::Gen<Query> queries(const Balls* /*kind*/, const Range& range) {
  const auto near = [&](rc::Gen<double> number) { return nearly_touching(range, spheres_from(std::move(number))); };
  return rc::gen::weightedOneOf<Query>({{2, spheres_from(any_number(range))},
                                        {2, spheres_from(any_bits(range))},
                                        {1, spheres_from(subnormal(range))},
                                        {1, spheres_from(extreme(range))},
                                        {2, spheres_from(huge(range))},
                                        {2, spheres_from(small_dyadic(range))},
                                        {1, spheres_from(beside_dyadic(range))},
                                        {2, spheres_from(ordinary(range))},
                                        {4, near(ordinary(range))},
                                        {1, near(any_bits(range))},
                                        {1, near(subnormal(range))},
                                        {5, spheres_on_a_quadruple(range)},
                                        {2, spheres_coincident(range, any_number(range), false)},
                                        {1, spheres_coincident(range, huge(range), false)}});
}

}  // namespace contact::proptests
