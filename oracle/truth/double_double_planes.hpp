// A core and a half-space, in pairs of doubles.
#pragma once

#include "oracle/truth/double_double_segments.hpp"

namespace contact::oracle {

/// A point of a core that none of it lies below; normal.p where the normal is the half-space's; and whether it is the only one.
struct DoubleDoubleLowest {
  DoubleDoubles p;
  DoubleDouble along_normal;
  bool unique;
};
/// The answer for a core blown up by a radius, as double_double_answer has it.
[[nodiscard]] std::optional<RoundedAnswer> case_over_plane(const DoubleDoubleLowest& lowest, double radius,
                                                           const Plane& plane, Distances distances, Scalar scalar);
/// The same for a segment.
[[nodiscard]] std::optional<RoundedAnswer> case_over_plane(const Ends& ends, double radius, const Plane& plane,
                                                           Distances distances, Scalar scalar);

}  // namespace contact::oracle
