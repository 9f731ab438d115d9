// Segments that cross a triangle, or pass it: what the generators of both such pairs share.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>
#include <vector>

#include "proptests/generators.hpp"

namespace contact::proptests {

/// A triangle, and a segment from a start along a direction, the length in directions.
struct Laid {
  Triangle triangle;
  Vector3 start;
  Vector3 direction;
  double length;
};
using MakeQuery = std::function<Query(const Laid&, Distances)>;

/// Numbers of one kind, whatever they make.
inline rc::Gen<Query> crossings_from(rc::Gen<double> number, const MakeQuery& make) {
  return rc::gen::map(numbers(18, std::move(number)), [make](const std::vector<double>& x) {
    return make({{{Vector3(x[0], x[1], x[2]), Vector3(x[3], x[4], x[5]), Vector3(x[6], x[7], x[8])}},
                 {x[9], x[10], x[11]},
                 {x[12], x[13], x[14]},
                 std::abs(x[15])},
                {std::abs(x[16]), std::abs(x[17])});
  });
}

/// The segment goes through a point of the triangle's plane, and begins some eighths of it before that; what is exact
/// for small integers is nearly so for other numbers. With eighths of 0 and 8 it crosses the boundary, or ends there.
inline rc::Gen<Query> crossings_laid(const Range& range, rc::Gen<double> number, const MakeQuery& make) {
  const auto eighths = integer(-1, 5);
  const auto ulps = rc::gen::weightedElement<int>({{6, 0}, {1, -1}, {1, 1}});
  return rc::gen::map(rc::gen::pair(numbers(17, std::move(number)),
                                    rc::gen::tuple(eighths, eighths, integer(-1, 9), integer(0, 5), ulps)),
                      [range, make](const std::pair<std::vector<double>, std::tuple<int, int, int, int, int>>& drawn) {
                        const auto& x = drawn.first;
                        const auto [s, t, part, kind, step] = drawn.second;
                        const auto in_range = [&](const Vector3& v) -> Vector3 {
                          return v.unaryExpr([&](double y) { return std::isfinite(y) ? range.rounded(y) : 0.0; });
                        };
                        Laid laid{{{Vector3(x[0], x[1], x[2]), Vector3(x[3], x[4], x[5]), Vector3(x[6], x[7], x[8])}},
                                  Vector3::Zero(),
                                  {x[9], x[10], x[11]},
                                  1};
                        auto& v = laid.triangle.vertices;
                        if (kind == 0) v[2] = in_range(v[0] + t / 4.0 * (v[1] - v[0]));  // on a line
                        if (kind == 1)
                          laid.direction = in_range(s / 8.0 * (v[1] - v[0]) + t / 8.0 * (v[2] - v[0]));  // in the plane
                        if (kind == 2) laid.length = 2;
                        const double third = kind == 3 ? 1 - s / 8.0 : t / 8.0;  // through the edge from v1 to v2
                        const Vector3 at = v[0] + s / 8.0 * (v[1] - v[0]) + third * (v[2] - v[0]);
                        laid.start = in_range(at - part / 8.0 * laid.length * laid.direction);
                        laid.start[kind % 3] = range.moved(laid.start[kind % 3], step);
                        return make(laid, {std::abs(x[12]), std::abs(x[13])});
                      });
}

inline rc::Gen<Query> crossings(const Range& range, const MakeQuery& make) {
  return rc::gen::weightedOneOf<Query>({{6, crossings_laid(range, ordinary(range), make)},
                                        {6, crossings_laid(range, small_dyadic(range), make)},
                                        {1, crossings_laid(range, any_number(range), make)},
                                        {1, crossings_from(any_number(range), make)},
                                        {1, crossings_from(any_bits(range), make)},
                                        {2, crossings_from(small_dyadic(range), make)}});
}

}  // namespace contact::proptests
