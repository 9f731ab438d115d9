// Two segments, each of which may be a point, in intervals.
#pragma once

#include "oracle/truth/interval.hpp"

namespace contact::oracle {

/// A segment: a point, and the way from there to the other end.
struct IntervalSegment {
  Triple from;
  Triple along;
};
[[nodiscard]] IntervalSegment point_segment(const Vector3& c, mpfr_prec_t precision);
[[nodiscard]] IntervalSegment segment_between(const Vector3& start, const Vector3& end, mpfr_prec_t precision);
[[nodiscard]] IntervalSegment segment_along(const Ray& ray, mpfr_prec_t precision);

/// The answer for two segments blown up by radii.
[[nodiscard]] RoundedAnswer answer_of_segments(const IntervalSegment& first, const IntervalSegment& second,
                                               double radius1, double radius2, Distances distances, Scalar scalar,
                                               mpfr_prec_t precision);
/// The normal by agreement of cores that meet: along `across`, else across a direction.
[[nodiscard]] Triple agreed_normal(const Triple& across, const Triple& along, mpfr_prec_t precision);

}  // namespace contact::oracle
