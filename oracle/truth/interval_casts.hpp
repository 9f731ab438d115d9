// Rays that are cast, in intervals.
#pragma once

#include "oracle/truth/interval.hpp"

namespace contact::oracle {

template <class Target>
[[nodiscard]] RoundedAnswer answer_of_cast(const CastAt<Target>& shapes, Scalar scalar, mpfr_prec_t precision);

}  // namespace contact::oracle
