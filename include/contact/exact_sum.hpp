// Exact sums of doubles, for your own intersectors that must decide and round as the built-in ones do.
#pragma once

#include <initializer_list>

#include "contact/version.h"

namespace contact::inline CONTACT_ABI {

/// The sign of the real sum of the terms: -1, 0 or 1.
/// Domain      finite terms; subnormals and the largest finite numbers included.
/// Environment any rounding mode, flush-to-zero and denormals-are-zero: the answer is the same.
[[nodiscard]] int sign_of_sum(std::initializer_list<double> terms);

/// The real sum of the terms times 2^exponent, rounded once to nearest, ties to even; +0 for zero, infinite beyond the
/// range. Domain and environment as sign_of_sum.
[[nodiscard]] double rounded_sum(std::initializer_list<double> terms, int exponent = 0);

}  // namespace contact::inline CONTACT_ABI
