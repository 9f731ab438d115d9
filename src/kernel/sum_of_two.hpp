// Sums of a few doubles that two hold: sum_of_two-inl.h on the numbers of one pair.
#pragma once

#include <cmath>

namespace contact::kernel::one_number {

#define CONTACT_LANES [[gnu::always_inline]] inline
#include "kernel/one_pair_lanes-inl.h"
// On these lanes:
#include "kernel/double_double-inl.h"
#include "kernel/sum_of_two-inl.h"
#undef CONTACT_LANES

}  // namespace contact::kernel::one_number
