// Any two convex cores, or one over a half-space, in pairs of doubles.
#pragma once

#include "oracle/truth/double_double_nearest.hpp"

namespace contact::oracle {

/// As double_double_answer has it.
[[nodiscard]] std::optional<RoundedAnswer> case_of_convexes(const Convexes& shapes, Distances distances, Scalar scalar);

}  // namespace contact::oracle
