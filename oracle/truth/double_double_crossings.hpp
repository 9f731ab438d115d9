// A segment that crosses a triangle, in pairs of doubles.
#pragma once

#include "oracle/truth/double_double_segments.hpp"

namespace contact::oracle {

/// The answer, as double_double_answer has it; `sign` turns the normal of the triangle. Domain: a segment
/// in_short_range.
[[nodiscard]] std::optional<RoundedAnswer> case_of_crossing(const Vector3& from, const DoubleDoubles& along,
                                                            const Triangle& triangle, int sign, Scalar scalar);

}  // namespace contact::oracle
