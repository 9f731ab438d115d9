// A segment, which may be a point, and a half-space, in pairs of doubles.
#pragma once

#include "oracle/truth/double_double_segments.hpp"

namespace contact::oracle {

/// The answer for a segment blown up by a radius, as double_double_answer has it.
[[nodiscard]] std::optional<RoundedAnswer> case_over_plane(const Ends& ends, double radius, const Plane& plane,
                                                           Distances distances, Scalar scalar);

}  // namespace contact::oracle
