// Sums of a few doubles that two hold: sum_of_two-inl.h on the numbers of one pair.
#pragma once

#include <cmath>
#include <initializer_list>

#include "contact/exact_sum.hpp"

namespace contact::kernel::one_number {

#define CONTACT_LANES [[gnu::always_inline]] inline
#include "kernel/one_pair_lanes-inl.h"
// On these lanes:
#include "kernel/double_double-inl.h"
#include "kernel/sum_of_two-inl.h"
#undef CONTACT_LANES

/// rounded_sum of contact/exact_sum.hpp without a look at the environment, which is to nearest: that takes as long as a contact.
inline double rounded(std::initializer_list<double> terms) {
  const double* const first = terms.begin();
  SumOfTwo<double> sum(first[0], first[1]);
  for (const double* term = first + 2; term != terms.end(); ++term) sum.add(*term);
  return sum.lost == 0 ? sum.rounded() : rounded_sum(terms);
}

}  // namespace contact::kernel::one_number
