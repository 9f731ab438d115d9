// What the first loop of batch_cores-inl.h leaves to the second one.
#pragma once

#include "kernel/batch.hpp"
#include "kernel/batch_strips.hpp"

namespace contact::kernel {

/// The nearest points p and p + d of a strip of pairs, high and low parts axis by axis. The coordinates of p are within
/// p_error and the vector d is within d_error, which is infinite where that is not known. Some room between columns
/// keeps them from the same place in a page, where loads look like recent stores to the processor.
struct CoreColumns {
  static constexpr std::size_t kRoom = kStrip + 24;
  double d[6][kRoom];
  double d_error[kRoom];
  double decision[kRoom];  ///< 1 a hit, 0 a miss
  double p[6][kRoom];      ///< of a first core that is no point
  double p_error[kRoom];
};

// For tests: the cores of a strip of whole vectors. False where the instruction set that serves finds none.
bool find_cores(const SphereCapsulePairs& pairs, CoreColumns& to);
bool find_cores(const CapsulePairs& pairs, CoreColumns& to);

}  // namespace contact::kernel
