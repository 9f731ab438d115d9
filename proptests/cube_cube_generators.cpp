// Questions about two axis-aligned boxes.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "proptests/generators.hpp"

namespace contact::proptests {
namespace {

rc::Gen<Query> boxes_from(rc::Gen<double> number) { return made_of(Pair::cube_cube, std::move(number)); }

/// Boxes that overlap on two axes and on the third are the alarm distance apart as double computes it, up to 2 ulps
/// off; or by as much more as the first is wide.
rc::Gen<Query> boxes_near_touching(const Range& range, rc::Gen<double> number) {
  return rc::gen::map(rc::gen::tuple(boxes_from(std::move(number)), integer(0, 2), integer(-2, 3), integer(0, 1)),
                      [range](const std::tuple<Query, int, int, int>& parts) {
                        auto [query, touching, ulps, second_first] = parts;
                        auto& [a, b] = std::get<Boxes>(query.shapes);
                        for (int axis = 0; axis < 3; ++axis) {
                          if (axis != touching) {
                            b.min[axis] = std::min(b.min[axis], a.max[axis]);
                            b.max[axis] = std::max(b.max[axis], a.min[axis]);
                            continue;
                          }
                          const double width = ulps == 3 ? a.max[axis] - a.min[axis] : 0;
                          const double low =
                              range.moved(range.rounded(a.max[axis] + query.distances.alarm + width), ulps);
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

}  // namespace

rc::Gen<Query> boxes_touching(const Range& range, bool by_alarm) {
  // Corners and the alarm on one grid of integers, so that their sums are exact: below 2^50, or 2^20 in binary32, and
  // no wider than the range.
  const int digits = std::clamp(range.top - range.bottom - 3, 1, range.scalar == Scalar::binary32 ? 18 : 48);
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

rc::Gen<Query> queries(const Boxes* /*kind*/, const Range& range) {
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

}  // namespace contact::proptests
