// A segment that crosses a triangle, in intervals.
#pragma once

#include "oracle/truth/interval_cores.hpp"

namespace contact::oracle {

/// The answer; `sign` turns the normal of the triangle.
[[nodiscard]] RoundedAnswer answer_of_crossing(const IntervalCore& segment, const Triangle& triangle, int sign,
                                               Scalar scalar, mpfr_prec_t precision);

}  // namespace contact::oracle
