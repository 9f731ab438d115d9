// Two cores, or a core and a half-space, in intervals.
#pragma once

#include "oracle/truth/core.hpp"
#include "oracle/truth/interval.hpp"

namespace contact::oracle {

using IntervalCore = Core<Interval>;
template <class Shape>
[[nodiscard]] IntervalCore interval_core(const Shape& shape, mpfr_prec_t precision) {
  return core_of([precision](double x) { return Interval(precision, x); }, shape);
}

[[nodiscard]] RoundedAnswer answer_of_cores(const IntervalCore& a, const IntervalCore& b, Distances distances,
                                            Scalar scalar, mpfr_prec_t precision);
[[nodiscard]] RoundedAnswer answer_of_cores(const IntervalCore& a, const Plane& plane, Distances distances,
                                            Scalar scalar, mpfr_prec_t precision);

}  // namespace contact::oracle
