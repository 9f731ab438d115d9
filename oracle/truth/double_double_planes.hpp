// A segment, which may be a point, and a half-space, in pairs of doubles.
#pragma once

#include "oracle/truth/double_double_segments.hpp"

namespace contact::oracle {

/// The answer for a segment blown up by a radius, as double_double_case has it.
[[nodiscard]] std::optional<DoubleDoubleCase> case_over_plane(const Ends& ends, double radius, const Plane& plane,
                                                              Distances distances, Scalar scalar, bool with_margin);

}  // namespace contact::oracle
