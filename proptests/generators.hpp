// Generators of questions for the laws: RapidCheck's own doubles are never subnormal or one ulp from anything.
#pragma once

#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <ostream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "oracle/query.hpp"

namespace contact {

/// A question as a line that `contact-oracle explain` accepts, so that a shrunk counterexample can be pasted into it.
inline void showValue(const Query& query, std::ostream& out) {
  const auto number = [](double x) {
    std::array<char, 32> text{};
    return std::string(text.data(), std::to_chars(text.data(), text.data() + text.size(), x == 0 ? 0.0 : x).ptr);
  };
  const auto vector = [&](const Vector3& v) {
    return "[" + number(v[0]) + "," + number(v[1]) + "," + number(v[2]) + "]";
  };
  const auto shape = [&](const auto& s) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(s)>, Ball>)
      return R"({"center":)" + vector(s.center) + R"(,"radius":)" + number(s.radius) + "}";
    else
      return R"({"min":)" + vector(s.min) + R"(,"max":)" + vector(s.max) + "}";
  };
  std::visit(
      [&](const auto& shapes) {
        out << R"({"pair":")" << name(query.pair) << R"(","a":)" << shape(shapes.a) << R"(,"b":)" << shape(shapes.b);
      },
      query.shapes);
  out << R"(,"alarm":)" << number(query.distances.alarm) << R"(,"contact":)" << number(query.distances.contact) << "}";
}

namespace proptests {

/// A generator of full width whatever the case's size: RapidCheck's integers are small in its first cases.
template <class T>
rc::Gen<T> full_size(rc::Gen<T> gen) {
  return rc::gen::resize(rc::kNominalSize, std::move(gen));
}
inline rc::Gen<int> integer(int least, int most) { return full_size(rc::gen::inRange(least, most + 1)); }

/// x moved by a number of ulps, never past the largest finite number.
inline double moved(double x, int ulps) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (; ulps != 0; ulps += ulps > 0 ? -1 : 1) {
    const double next = std::nextafter(x, ulps > 0 ? kInfinity : -kInfinity);
    if (std::isfinite(next)) x = next;
  }
  return x;
}

// Numbers, each kind for a reason.

/// Any finite bit pattern: every scale beside every other.
inline rc::Gen<double> any_bits() {
  return rc::gen::map(full_size(rc::gen::arbitrary<std::uint64_t>()), [](std::uint64_t bits) {
    const auto x = std::bit_cast<double>(bits);
    return std::isfinite(x) ? x : std::bit_cast<double>(bits & ~(std::uint64_t{1} << 62));
  });
}
/// Subnormals, where plain products vanish.
inline rc::Gen<double> subnormal() {
  return rc::gen::map(full_size(rc::gen::arbitrary<std::uint64_t>()),
                      [](std::uint64_t bits) { return std::bit_cast<double>(bits & 0x800fffffffffffffU); });
}
/// The ends of the range and of its parts, and both zeros.
inline rc::Gen<double> extreme() {
  return rc::gen::map(
      rc::gen::pair(rc::gen::elementOf(std::vector<double>{0, 1, 0x1p-1074, 0x1p-1022, 0x1p-537, 0x1p-450, 0x1p500,
                                                           0x1p511, 0x1p1023, std::numeric_limits<double>::max()}),
                    rc::gen::pair(integer(-1, 1), integer(0, 1))),
      [](const std::pair<double, std::pair<int, int>>& parts) {
        const double x = moved(parts.first, parts.second.first);
        return parts.second.second == 0 ? x : -x;
      });
}
/// Numbers of the topmost binades, where sums of a few overflow.
inline rc::Gen<double> huge() {
  return rc::gen::map(full_size(rc::gen::arbitrary<std::uint64_t>()), [](std::uint64_t bits) {
    return std::bit_cast<double>((bits & 0x801fffffffffffffU) | 0x7fc0000000000000U);  // from 2^1021
  });
}
/// A small integer times a power of two: sums, products and roots that are exact, and so ties.
inline rc::Gen<double> small_dyadic() {
  return rc::gen::map(rc::gen::pair(integer(-12, 12), integer(-8, 8)), [](const std::pair<int, int>& parts) {
    return std::ldexp(static_cast<double>(parts.first), parts.second);
  });
}
/// A neighbour of such a number: one ulp from everything that it meets.
inline rc::Gen<double> beside_dyadic() {
  return rc::gen::map(rc::gen::pair(small_dyadic(), integer(-2, 2)),
                      [](const std::pair<double, int>& parts) { return moved(parts.first, parts.second); });
}
/// One that a power of two scales exactly: no neighbour of 0.
inline rc::Gen<double> beside_dyadic_or_zero() {
  return rc::gen::map(beside_dyadic(), [](double x) { return std::abs(x) < 0x1p-100 ? 0.0 : x; });
}
/// A full significand of ordinary size.
inline rc::Gen<double> ordinary() {
  return rc::gen::map(full_size(rc::gen::arbitrary<std::uint64_t>()), [](std::uint64_t bits) {
    const double x = static_cast<double>(bits >> 11) * 0x1p-50;  // below 8
    return (bits & 1) == 0 ? x : -x;
  });
}
inline rc::Gen<double> any_number() {
  return rc::gen::oneOf(any_bits(), subnormal(), extreme(), huge(), small_dyadic(), beside_dyadic(), ordinary());
}
/// A length: any of these without its sign.
inline rc::Gen<double> any_length() {
  return rc::gen::map(any_number(), [](double x) { return std::abs(x); });
}

inline rc::Gen<std::vector<double>> numbers(std::size_t count, rc::Gen<double> number) {
  return rc::gen::container<std::vector<double>>(count, std::move(number));
}

// Pairs of spheres.

inline Query spheres_of(const std::vector<double>& x) {
  return {Pair::sphere_sphere,
          Balls{{{x[0], x[1], x[2]}, std::abs(x[3])}, {{x[4], x[5], x[6]}, std::abs(x[7])}},
          {std::abs(x[8]), std::abs(x[9])}};
}

/// Ten numbers of one kind.
inline rc::Gen<Query> spheres_from(rc::Gen<double> number) {
  return rc::gen::map(numbers(10, std::move(number)), spheres_of);
}
/// The alarm distance, or the second radius where the alarm is 0, puts the pair at touching as plain double computes
/// it, and up to 2 ulps off: exact decisions part from rounded ones here.
inline rc::Gen<Query> spheres_near_touching(rc::Gen<double> number) {
  return rc::gen::map(rc::gen::pair(spheres_from(std::move(number)), rc::gen::pair(integer(-2, 2), integer(0, 1))),
                      [](std::pair<Query, std::pair<int, int>> parts) {
                        Query query = std::move(parts.first);
                        auto& [a, b] = std::get<Balls>(query.shapes);
                        const Vector3 delta = b.center - a.center;
                        const double distance = delta.stableNorm();
                        if (!std::isfinite(distance)) return query;
                        const auto [ulps, by_alarm] = parts.second;
                        if (a.radius > distance) a.radius = distance / 2;
                        if (by_alarm == 0) {
                          query.distances.alarm = 0;
                          b.radius = std::max(0.0, moved(distance - a.radius, ulps));
                        } else {
                          b.radius = std::min(b.radius, (distance - a.radius) / 2);
                          query.distances.alarm = std::max(0.0, moved(distance - (a.radius + b.radius), ulps));
                        }
                        return query;
                      });
}
/// Pythagorean quadruples at any scale: the distance is an integer, so touching is exact and one ulp less is a miss.
inline rc::Gen<Query> spheres_on_a_quadruple() {
  using Quadruple = std::array<int, 4>;
  return rc::gen::map(
      rc::gen::tuple(
          rc::gen::elementOf(std::vector<Quadruple>{
              {1, 2, 2, 3}, {2, 3, 6, 7}, {3, 4, 0, 5}, {1, 4, 8, 9}, {0, 0, 1, 1}, {2, 6, 9, 11}, {8, 9, 12, 17}}),
          rc::gen::container<std::vector<int>>(7, integer(-9, 9)), integer(-1074, 1010), integer(-2, 1), integer(0, 2)),
      [](const std::tuple<Quadruple, std::vector<int>, int, int, int>& parts) {
        const auto& [quadruple, k, exponent, ulps, lengths] = parts;
        const auto at = [e = exponent](int n) { return std::ldexp(static_cast<double>(n), e); };
        Ball a{{at(k[0]), at(k[1]), at(k[2])}, 0};
        Ball b = a;
        for (int axis = 0; axis < 3; ++axis) {
          const auto i = static_cast<std::size_t>(axis);
          const int step = quadruple[(i + static_cast<std::size_t>(k[3] + 9)) % 3];
          b.center[axis] = at(k[i] + (k[4 + i % 2] % 2 == 0 ? step : -step));
        }
        // The distance is shared out to both radii, or to one radius and the alarm; the last part moves by ulps.
        const int first = std::abs(k[6]) % (quadruple[3] + 1);
        const double last = std::max(0.0, moved(at(quadruple[3] - first), ulps));
        a.radius = lengths == 2 ? 0 : at(first);
        b.radius = lengths == 1 ? 0 : lengths == 2 ? at(first) : last;
        return Query{Pair::sphere_sphere, Balls{a, b}, {lengths == 0 ? 0 : last, at(std::abs(k[5]))}};
      });
}
/// Coincident centres, or centres that differ by the smallest subnormal on one axis.
inline rc::Gen<Query> spheres_coincident(rc::Gen<double> number) {
  return rc::gen::map(rc::gen::pair(spheres_from(std::move(number)), integer(0, 3)), [](std::pair<Query, int> parts) {
    auto& [a, b] = std::get<Balls>(parts.first.shapes);
    b.center = a.center;
    if (parts.second == 0) b.center = -b.center.cwiseAbs().cwiseMin(0x1p-1074);
    return parts.first;
  });
}

inline rc::Gen<Query> sphere_queries() {
  return rc::gen::weightedOneOf<Query>({{2, spheres_from(any_number())},
                                        {2, spheres_from(any_bits())},
                                        {1, spheres_from(subnormal())},
                                        {1, spheres_from(extreme())},
                                        {2, spheres_from(huge())},
                                        {2, spheres_from(small_dyadic())},
                                        {1, spheres_from(ordinary())},
                                        {3, spheres_near_touching(ordinary())},
                                        {1, spheres_near_touching(any_bits())},
                                        {1, spheres_near_touching(subnormal())},
                                        {5, spheres_on_a_quadruple()},
                                        {2, spheres_coincident(any_number())},
                                        {1, spheres_coincident(huge())}});
}
/// Questions whose numbers and answers stay away from both ends of the range: what a power of two scales exactly.
inline rc::Gen<Query> moderate_sphere_queries() {
  return rc::gen::weightedOneOf<Query>({{1, spheres_from(small_dyadic())},
                                        {1, spheres_from(beside_dyadic_or_zero())},
                                        {1, spheres_from(ordinary())},
                                        {2, spheres_near_touching(ordinary())}});
}

// Pairs of boxes.

inline Query boxes_of(const std::vector<double>& x) {
  const auto box = [&](std::size_t at) {
    const Vector3 p(x[at], x[at + 1], x[at + 2]);
    const Vector3 q(x[at + 3], x[at + 4], x[at + 5]);
    return Box{p.cwiseMin(q), p.cwiseMax(q)};
  };
  return {Pair::cube_cube, Boxes{box(0), box(6)}, {std::abs(x[12]), 0}};
}
/// Thirteen numbers of one kind.
inline rc::Gen<Query> boxes_from(rc::Gen<double> number) {
  return rc::gen::map(numbers(13, std::move(number)), boxes_of);
}
/// Boxes that overlap on two axes and on the third are the alarm distance apart as plain double computes it, up to 2
/// ulps off.
inline rc::Gen<Query> boxes_near_touching(rc::Gen<double> number) {
  return rc::gen::map(rc::gen::tuple(boxes_from(std::move(number)), integer(0, 2), integer(-2, 2), integer(0, 1)),
                      [](std::tuple<Query, int, int, int> parts) {
                        auto& [query, touching, ulps, second_first] = parts;
                        auto& [a, b] = std::get<Boxes>(query.shapes);
                        for (int axis = 0; axis < 3; ++axis) {
                          if (axis != touching) {
                            b.min[axis] = std::min(b.min[axis], a.max[axis]);
                            b.max[axis] = std::max(b.max[axis], a.min[axis]);
                            continue;
                          }
                          const double low = moved(a.max[axis] + query.distances.alarm, ulps);
                          if (!std::isfinite(low)) continue;
                          b.min[axis] = low;
                          b.max[axis] = std::max(b.max[axis], low);
                        }
                        if (second_first == 1) std::swap(a, b);
                        return query;
                      });
}

inline rc::Gen<Query> box_queries() {
  return rc::gen::weightedOneOf<Query>({{2, boxes_from(any_number())},
                                        {2, boxes_from(any_bits())},
                                        {1, boxes_from(subnormal())},
                                        {1, boxes_from(extreme())},
                                        {2, boxes_from(small_dyadic())},
                                        {1, boxes_near_touching(any_bits())},
                                        {1, boxes_near_touching(subnormal())},
                                        {1, boxes_near_touching(extreme())},
                                        {2, boxes_near_touching(small_dyadic())},
                                        {2, boxes_near_touching(beside_dyadic())},
                                        {1, boxes_near_touching(huge())},
                                        {2, boxes_near_touching(ordinary())}});
}

/// The first `count` questions of a generator for one fixed seed.
inline std::vector<Query> sample(const rc::Gen<Query>& gen, int count) {
  rc::Random random(20);
  std::vector<Query> queries;
  for (int i = 0; i < count; ++i) {
    const rc::Random here = random.split();
    queries.push_back(gen(here, rc::kNominalSize).value());
  }
  return queries;
}

}  // namespace proptests
}  // namespace contact
