// What a pair asks of intervals: two cores, or a core and a half-space; a segment that crosses a triangle; rays that are cast.
#pragma once

#include "oracle/truth/core.hpp"
#include "oracle/truth/interval.hpp"
#include "oracle/truth/interval_rough.hpp"

namespace contact::oracle {

using IntervalCore = Core<Interval>;
template <class Shape>
[[nodiscard]] IntervalCore interval_core(const Shape& shape, mpfr_prec_t precision) {
  return core_of([precision](double x) { return Interval(precision, x); }, shape);
}

template <HullOfVertices Shape>
[[nodiscard]] IntervalCore interval_core(const Shape& hull, mpfr_prec_t precision) {
  const auto points = points_of([precision](double x) { return Interval(precision, x); }, hull);
  const std::vector<RoughTriple> roughly = rough(points, power_of(points));
  return core_of_points(points, radius_of(hull), [&](const auto& ask) {
    const auto known = ask(roughly).sign();
    return known ? *known : sign_of(ask(points));
  });
}

/// A feature of each of two cores.
using FeaturePair = std::pair<const Feature*, const Feature*>;
/// The nearest points of two cores over one denominator, of which neither has a point in its inside that is the other's; what
/// their own denominators are is not asked. All ends of what is nearest lie in features of `tried`.
[[nodiscard]] IntervalNearest nearest_of_cores(const IntervalCore& a, const IntervalCore& b,
                                               const std::vector<FeaturePair>& tried, mpfr_prec_t precision);
/// Every two of them.
[[nodiscard]] std::vector<FeaturePair> all_features(const IntervalCore& a, const IntervalCore& b);

/// What two sets of points in one plane or line have in common, which is something: a point over a denominator, the middle between the lexicographically
/// least and greatest vertex, and whether it is the only one. Each set is what some features of a core are together.
struct IntervalCommon {
  Triple p;
  Interval over;
  bool unique;
};
[[nodiscard]] IntervalCommon common_of_cores(const IntervalCore& a, const std::vector<const Feature*>& of_a,
                                             const IntervalCore& b, const std::vector<const Feature*>& of_b,
                                             mpfr_prec_t precision);

[[nodiscard]] RoundedAnswer answer_of_cores(const IntervalCore& a, const IntervalCore& b, Distances distances,
                                            Scalar scalar, mpfr_prec_t precision);
[[nodiscard]] RoundedAnswer answer_of_cores(const IntervalCore& a, const Plane& plane, Distances distances,
                                            Scalar scalar, mpfr_prec_t precision);
/// Any two cores, which may overlap.
[[nodiscard]] RoundedAnswer answer_of_convexes(const IntervalCore& a, const IntervalCore& b, Distances distances,
                                               Scalar scalar, mpfr_prec_t precision);
/// Of a segment that crosses a triangle; `sign` turns the normal of the triangle.
[[nodiscard]] RoundedAnswer answer_of_crossing(const IntervalCore& segment, const Triangle& triangle, int sign,
                                               Scalar scalar, mpfr_prec_t precision);
template <class Target>
[[nodiscard]] RoundedAnswer answer_of_cast(const CastAt<Target>& shapes, Scalar scalar, mpfr_prec_t precision);

}  // namespace contact::oracle
