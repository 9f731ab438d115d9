// A segment, which may be a point, and a half-space, in intervals.
#pragma once

#include <initializer_list>

#include "oracle/truth/interval.hpp"

namespace contact::oracle {

/// The answer for the points between some, blown up by a radius.
[[nodiscard]] RoundedAnswer answer_over_plane(std::initializer_list<Vector3> ends, double radius, const Plane& plane,
                                              Distances distances, Scalar scalar, mpfr_prec_t precision);

}  // namespace contact::oracle
