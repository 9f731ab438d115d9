// Questions about a capsule and a plane, and about a sphere and a plane.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "proptests/generators.hpp"

namespace contact::proptests {
namespace {

/// What is exact for small integers is nearly so for other numbers. The plane goes through the start of the axis, or
/// is moved from there by a multiple of the normal's length as plain arithmetic has it; the axis goes along it or not.
enum class LyingOverPlane { anyhow, along, nearly_along, without_length };
Query laid_over(const Range& range, Query query, LyingOverPlane lying, int axis, int height, int ulps) {
  auto& [a, b] = std::get<CapsuleAndPlane>(query.shapes);
  if (axis < 3) {  // a floor or a wall
    const double size = b.normal[axis];
    b.normal.setZero();
    b.normal[axis] = size == 0 ? 1 : size;
  }
  if (lying == LyingOverPlane::along || lying == LyingOverPlane::nearly_along) {
    a.end = range.rounded(a.start + range.rounded(b.normal.cross(a.end)));
    if (axis < 3) a.end[axis] = a.start[axis];
  }
  if (lying == LyingOverPlane::nearly_along) a.end[ulps & 1] = range.moved(a.end[ulps & 1], ulps < 0 ? -1 : 1);
  if (lying == LyingOverPlane::without_length) a.end = a.start;
  if (height > 8) height = 0;  // on the plane
  const double length = b.normal.stableNorm();
  b.offset = range.rounded(b.normal.dot(a.start) - height * (std::isfinite(length) ? length : 0) / 2);
  if (std::isnan(b.offset)) b.offset = 0;
  b.offset = range.moved(b.offset, ulps);
  return query;
}
rc::Gen<Query> laid_over_plane(const Range& range, rc::Gen<double> number, bool is_a_sphere) {
  return rc::gen::map(rc::gen::tuple(made_of(Pair::capsule_plane, std::move(number)), integer(0, 3), integer(0, 5),
                                     integer(-3, 12), integer(-1, 1)),
                      [range, is_a_sphere](const std::tuple<Query, int, int, int, int>& parts) {
                        const auto& [query, how, axis, height, ulps] = parts;
                        const auto lying =
                            is_a_sphere ? LyingOverPlane::without_length : static_cast<LyingOverPlane>(how);
                        return laid_over(range, query, lying, axis, height, ulps);
                      });
}

/// Exactly touching, at alarm 0 or by an alarm distance, with the start, the end or all along: a quadruple is the
/// normal, on integers times a power of two.
rc::Gen<Query> exactly_touching_plane(const Range& range) {
  return rc::gen::map(
      rc::gen::tuple(rc::gen::elementOf(kQuadruples), rc::gen::container<std::vector<int>>(8, integer(0, 9)),
                     integer(range.bottom, std::max(range.bottom, range.top - 12))),
      [](const std::tuple<Quadruple, std::vector<int>, int>& parts) {
        const auto& [quadruple, k, exponent] = parts;
        const Vector3 n(quadruple[0], quadruple[1], k[0] < 5 ? quadruple[2] : -quadruple[2]);
        const Vector3 p(k[1], k[2], k[3]);
        Vector3 way = n.cross(Vector3::Unit(k[4] % 3));
        if (k[4] > 3) way += k[5] % 4 * n;
        const double height = k[6] + 1;
        const double alarm = k[5] < 5 ? 0 : height / 2;
        const double unit = std::ldexp(1.0, exponent);
        const double offset = n.dot(p) - height * quadruple[3];
        Capsule capsule{unit * p, unit * (p + way), unit * (height - alarm)};
        if (k[7] < 5) std::swap(capsule.start, capsule.end);
        return Query{Pair::capsule_plane, CapsuleAndPlane{capsule, {n, unit * offset}}, {unit * alarm, unit * k[7]}};
      });
}

Query as_asked_of_plane(Query query, bool is_a_sphere) {
  if (!is_a_sphere) return query;
  const auto [a, b] = std::get<CapsuleAndPlane>(query.shapes);
  const bool end_is_lower = b.normal.dot(a.end - a.start) < 0;
  return {Pair::sphere_plane, BallAndPlane{{end_is_lower ? a.end : a.start, a.radius}, b}, query.distances};
}

rc::Gen<Query> plane_queries(const Range& range, bool is_a_sphere) {
  const auto asked = [&](rc::Gen<Query> gen) {
    return rc::gen::map(std::move(gen),
                        [is_a_sphere](const Query& query) { return as_asked_of_plane(query, is_a_sphere); });
  };
  return at_every_scale(
      is_a_sphere ? Pair::sphere_plane : Pair::capsule_plane, range,
      [&](rc::Gen<double> number) { return asked(laid_over_plane(range, std::move(number), is_a_sphere)); },
      asked(exactly_touching_plane(range)));
}

}  // namespace

rc::Gen<Query> queries(const CapsuleAndPlane* /*kind*/, const Range& range) { return plane_queries(range, false); }
rc::Gen<Query> queries(const BallAndPlane* /*kind*/, const Range& range) { return plane_queries(range, true); }

}  // namespace contact::proptests
