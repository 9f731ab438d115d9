// Generators of questions for the laws.
#include "proptests/generators.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <ostream>
#include <string>
#include <tuple>

#include "golden/dataset.hpp"
#include "golden/families.hpp"
#include "oracle/exact.hpp"

namespace contact {

void showValue(const Query& query, std::ostream& out) { out << golden::query_line(query, Scalar::binary64); }

}  // namespace contact

namespace contact::proptests {
namespace {

double largest(Scalar scalar) {
  return scalar == Scalar::binary32 ? static_cast<double>(std::numeric_limits<float>::max())
                                    : std::numeric_limits<double>::max();
}

rc::Gen<std::uint64_t> bits() { return full_size(rc::gen::arbitrary<std::uint64_t>()); }

/// A number made of 64 random bits.
template <class Make>
rc::Gen<double> from_bits(const Range& range, Make make) {
  return rc::gen::map(bits(), [range, make](std::uint64_t word) {
    const double x = range.fitted(make(range, word >> 1));
    return (word & 1) == 0 ? x : -x;
  });
}

/// A full significand of the scalar from the topmost of 63 bits: in [1,2).
double significand(const Range& range, std::uint64_t word) {
  const int precision = format_of(range.scalar).precision;
  const std::uint64_t digits = (word >> (64 - precision)) | (std::uint64_t{1} << (precision - 1));
  return std::ldexp(static_cast<double>(digits), 1 - precision);
}

Query spheres_of(const std::vector<double>& x) {
  return {Pair::sphere_sphere,
          Balls{{{x[0], x[1], x[2]}, std::abs(x[3])}, {{x[4], x[5], x[6]}, std::abs(x[7])}},
          {std::abs(x[8]), std::abs(x[9])}};
}

/// Ten numbers of one kind.
rc::Gen<Query> spheres_from(rc::Gen<double> number) { return rc::gen::map(numbers(10, std::move(number)), spheres_of); }

/// Boxes that overlap on two axes and on the third are the alarm distance apart as double computes it, up to 2 ulps
/// off.
rc::Gen<Query> boxes_near_touching(const Range& range, rc::Gen<double> number) {
  return rc::gen::map(rc::gen::tuple(boxes_from(std::move(number)), integer(0, 2), integer(-2, 2), integer(0, 1)),
                      [range](const std::tuple<Query, int, int, int>& parts) {
                        auto [query, touching, ulps, second_first] = parts;
                        auto& [a, b] = std::get<Boxes>(query.shapes);
                        for (int axis = 0; axis < 3; ++axis) {
                          if (axis != touching) {
                            b.min[axis] = std::min(b.min[axis], a.max[axis]);
                            b.max[axis] = std::max(b.max[axis], a.min[axis]);
                            continue;
                          }
                          const double low = range.moved(range.rounded(a.max[axis] + query.distances.alarm), ulps);
                          b.min[axis] = low;
                          b.max[axis] = std::max(b.max[axis], low);
                        }
                        if (second_first == 1) std::swap(a, b);
                        return query;
                      });
}

/// The second box within the first on every axis, and flat on some.
rc::Gen<Query> boxes_nested(rc::Gen<double> number) {
  return rc::gen::map(rc::gen::pair(boxes_from(std::move(number)), integer(0, 7)), [](std::pair<Query, int> parts) {
    auto& [a, b] = std::get<Boxes>(parts.first.shapes);
    b.min = b.min.cwiseMax(a.min).cwiseMin(a.max);
    b.max = b.max.cwiseMax(a.min).cwiseMin(a.max);
    for (int axis = 0; axis < 3; ++axis)
      if ((parts.second >> axis & 1) == 1) b.max[axis] = b.min[axis];
    return parts.first;
  });
}

using Quadruple = std::array<int, 4>;
const std::vector<Quadruple> kQuadruples{{1, 2, 2, 3}, {2, 3, 6, 7},  {3, 4, 0, 5},  {1, 4, 8, 9},
                                         {0, 0, 1, 1}, {2, 6, 9, 11}, {8, 9, 12, 17}};

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

rc::Gen<std::vector<double>> numbers(std::size_t count, rc::Gen<double> number) {
  return rc::gen::container<std::vector<double>>(count, std::move(number));
}

Query boxes_of(const std::vector<double>& x) {
  const auto box = [&](std::size_t at) {
    const Vector3 p(x[at], x[at + 1], x[at + 2]);
    const Vector3 q(x[at + 3], x[at + 4], x[at + 5]);
    return Box{p.cwiseMin(q), p.cwiseMax(q)};
  };
  return {Pair::cube_cube, Boxes{box(0), box(6)}, {std::abs(x[12]), 0}};
}
rc::Gen<Query> boxes_from(rc::Gen<double> number) { return rc::gen::map(numbers(13, std::move(number)), boxes_of); }

Range::Range(Scalar of, double least_magnitude, double most_magnitude)
    : scalar(of), least(least_magnitude), most(std::min(most_magnitude, largest(of))) {
  const Format format = format_of(scalar);
  bottom = format.min_exponent - format.precision + 1;
  if (least > 0) {
    int exponent = 0;
    const double digits = std::frexp(least, &exponent);
    bottom = std::max(bottom, digits == 0.5 ? exponent - 1 : exponent);
  }
  top = most == largest(scalar) ? format.max_exponent : std::ilogb(most) - 1;
  top = std::max(top, bottom);
}

bool Range::contains(double x) const {
  return x == 0 || (std::abs(x) >= least && std::abs(x) <= most && rounded(x) == x);
}

bool Range::contains(const Query& query) const {
  bool all = !outside_domain(query);
  for_each_number(query, [&](const std::string&, double x) { all = all && contains(x); });
  return all;
}

double Range::rounded(double x) const {
  const double finite = std::clamp(x, -largest(scalar), largest(scalar));
  return scalar == Scalar::binary32 ? static_cast<double>(static_cast<float>(finite)) : finite;
}

double Range::fitted(double x) const {
  if (x == 0 || !std::isfinite(x)) return 0;
  const int exponent = std::ilogb(x);
  const int span = top - bottom + 1;
  const int steps = exponent < bottom ? (bottom - exponent + span - 1) / span : -((exponent - bottom) / span);
  return rounded(std::ldexp(x, steps * span));
}

double Range::moved(double x, int ulps) const {
  for (; ulps != 0; ulps += ulps > 0 ? -1 : 1) {
    const double next = ulps > 0 ? oracle::next_up(x, scalar) : oracle::next_down(x, scalar);
    if (std::isfinite(next)) x = next;
  }
  return x;
}

rc::Gen<int> integer(int least, int most) { return full_size(rc::gen::inRange(least, most + 1)); }

rc::Gen<double> any_bits(const Range& range) {
  return from_bits(range, [](const Range& r, std::uint64_t word) {
    const int exponent =
        r.bottom + static_cast<int>((word & 0xffff) % static_cast<std::uint64_t>(r.top - r.bottom + 1));
    return std::ldexp(significand(r, word), exponent);
  });
}

rc::Gen<double> subnormal(const Range& range) {
  return from_bits(range, [](const Range& r, std::uint64_t word) {
    if (r.least > 0) return std::ldexp(significand(r, word), r.bottom);
    const int digits = format_of(r.scalar).precision - 1 - static_cast<int>(word % 8 == 0 ? (word >> 3) % 20 : 0);
    return std::ldexp(static_cast<double>(word >> (63 - digits)), r.bottom);
  });
}

rc::Gen<double> extreme(const Range& range) {
  const Format format = format_of(range.scalar);
  const int lowest = format.min_exponent - format.precision + 1;
  std::vector<double> ends{0};
  for (const int exponent :
       {0, lowest, format.min_exponent, lowest / 2, lowest * 450 / 1074, format.max_exponent / 2 - 11,
        format.max_exponent / 2, format.max_exponent, range.bottom, range.top})
    if (range.contains(std::ldexp(1.0, exponent))) ends.push_back(std::ldexp(1.0, exponent));
  ends.push_back(range.rounded(range.most));
  return rc::gen::map(rc::gen::tuple(rc::gen::elementOf(ends), integer(-1, 1), integer(0, 1)),
                      [range](const std::tuple<double, int, int>& parts) {
                        const auto& [end, ulps, negative] = parts;
                        const double moved = range.moved(end, ulps);
                        const double x = range.contains(moved) ? moved : end;
                        return negative == 0 ? x : -x;
                      });
}

rc::Gen<double> huge(const Range& range) {
  return from_bits(range, [](const Range& r, std::uint64_t word) {
    return std::ldexp(significand(r, word), std::max(r.bottom, r.top - static_cast<int>(word % 3)));
  });
}

rc::Gen<double> small_dyadic(const Range& range) {
  // Around 1 where the range holds 2^-8 to 2^12, else around its middle.
  const bool around_one = range.bottom <= -8 && range.top >= 12;
  const int middle = around_one ? 0 : (range.bottom + range.top) / 2 - 2;
  const int reach = around_one ? 8 : std::clamp((range.top - range.bottom - 4) / 2, 0, 8);
  return rc::gen::map(rc::gen::pair(integer(-12, 12), integer(-reach, reach)),
                      [range, middle](const std::pair<int, int>& parts) {
                        return range.fitted(std::ldexp(static_cast<double>(parts.first), middle + parts.second));
                      });
}

rc::Gen<double> beside_dyadic(const Range& range) {
  return rc::gen::map(rc::gen::pair(small_dyadic(range), integer(-2, 2)), [range](const std::pair<double, int>& parts) {
    const double x = range.moved(parts.first, parts.second);
    return range.contains(x) ? x : parts.first;
  });
}

rc::Gen<double> ordinary(const Range& range) {
  return from_bits(range, [](const Range& r, std::uint64_t word) {
    const int precision = format_of(r.scalar).precision;
    return std::ldexp(static_cast<double>(word >> (63 - precision)), 3 - precision);  // below 8
  });
}

rc::Gen<double> any_number(const Range& range) {
  return rc::gen::oneOf(any_bits(range), subnormal(range), extreme(range), huge(range), small_dyadic(range),
                        beside_dyadic(range), ordinary(range));
}

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
        // The distance is shared out to both radii, or to one radius and the alarm; the last part
        // moves by ulps.
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

rc::Gen<Query> boxes_touching(const Range& range, bool by_alarm) {
  // Corners and the alarm on one grid of integers, so that their sums are exact: below 2^50, or 2^20 in binary32.
  const int digits = range.scalar == Scalar::binary32 ? 18 : 48;
  const int most = std::max(range.bottom, std::min(range.top, format_of(range.scalar).max_exponent) - digits - 4);
  const auto whole = full_size(rc::gen::inRange<std::int64_t>(-(std::int64_t{1} << digits), std::int64_t{1} << digits));
  return rc::gen::map(rc::gen::tuple(rc::gen::container<std::vector<std::int64_t>>(8, whole),
                                     integer(range.bottom, most), integer(0, 2), integer(0, 1)),
                      [by_alarm](const std::tuple<std::vector<std::int64_t>, int, int, int>& parts) {
                        const auto& [k, exponent, axis, below] = parts;
                        const auto at = [e = exponent](std::int64_t n) {
                          return std::ldexp(static_cast<double>(n), e);
                        };
                        const Vector3 p(at(k[0]), at(k[1]), at(k[2]));
                        const Vector3 q(at(k[3]), at(k[4]), at(k[5]));
                        const Box a{p.cwiseMin(q), p.cwiseMax(q)};
                        Box b = a;
                        const double alarm = by_alarm ? at(std::abs(k[6])) : 0;
                        const double width = at(std::abs(k[7]));
                        if (below == 0) {
                          b.min[axis] = a.max[axis] + alarm;
                          b.max[axis] = b.min[axis] + width;
                        } else {
                          b.max[axis] = a.min[axis] - alarm;
                          b.min[axis] = b.max[axis] - width;
                        }
                        return Query{Pair::cube_cube, Boxes{a, b}, {alarm, 0}};
                      });
}

rc::Gen<Query> box_queries(const Range& range) {
  return rc::gen::weightedOneOf<Query>({{2, boxes_from(any_number(range))},
                                        {2, boxes_from(any_bits(range))},
                                        {1, boxes_from(subnormal(range))},
                                        {1, boxes_from(extreme(range))},
                                        {2, boxes_from(small_dyadic(range))},
                                        {1, boxes_nested(any_number(range))},
                                        {1, boxes_near_touching(range, any_bits(range))},
                                        {1, boxes_near_touching(range, subnormal(range))},
                                        {1, boxes_near_touching(range, extreme(range))},
                                        {2, boxes_near_touching(range, small_dyadic(range))},
                                        {2, boxes_near_touching(range, beside_dyadic(range))},
                                        {1, boxes_near_touching(range, huge(range))},
                                        {2, boxes_near_touching(range, ordinary(range))}});
}

rc::Gen<Query> queries(Pair pair, const Range& range) {
  return rc::gen::map(pair == Pair::cube_cube ? box_queries(range) : sphere_queries(range), [pair](Query query) {
    query.pair = pair;
    return query;
  });
}

rc::Gen<Query> bad_queries(Pair pair, const Range& range) {
  return rc::gen::map(rc::gen::pair(queries(pair, range), integer(0, 1'000'000)),
                      [](const std::pair<Query, int>& parts) {
                        Query query = parts.first;
                        golden::Random random({}, static_cast<std::uint64_t>(parts.second));
                        golden::spoil(query, random);
                        return query;
                      });
}

std::vector<Query> sample(const rc::Gen<Query>& gen, int count) {
  rc::Random random(20);
  std::vector<Query> queries;
  for (int i = 0; i < count; ++i) {
    const rc::Random here = random.split();
    queries.push_back(gen(here, rc::kNominalSize).value());
  }
  return queries;
}

}  // namespace contact::proptests
