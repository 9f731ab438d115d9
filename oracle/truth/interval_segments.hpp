// Two segments, each of which may be a point, in intervals.
#pragma once

#include "oracle/truth/interval.hpp"

namespace contact::oracle {

/// The answer for two segments, from the first of two points to the second, blown up by radii.
[[nodiscard]] RoundedAnswer answer_of_segments(const std::array<Vector3, 2>& first,
                                               const std::array<Vector3, 2>& second, double radius1, double radius2,
                                               Distances distances, Scalar scalar, mpfr_prec_t precision);

}  // namespace contact::oracle
