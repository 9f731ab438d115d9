// Any two cores in intervals.
#pragma once

#include "oracle/truth/interval_cores.hpp"

namespace contact::oracle {

[[nodiscard]] RoundedAnswer answer_of_convexes(const IntervalCore& a, const IntervalCore& b, Distances distances,
                                               Scalar scalar, mpfr_prec_t precision);

}  // namespace contact::oracle
