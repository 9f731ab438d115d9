// The kernels of production, on numbers of few bits.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "dev/short_numbers/harness.hpp"
#include "dev/short_numbers/places.hpp"

namespace contact::kernel::tiny {

struct NamedKernel {
  std::string name;
  int bits;
  Kernel answer;
  bool quick = true;               ///< among those of a quick run
  bool computes = true;            ///< numbers, and not only decisions
  const Places* places = nullptr;  ///< of a source that counts its masks
};

/// The filter and the fast stage of one pair; the filter alone in other rounding modes; the pair in one vector.
std::vector<NamedKernel> one_pair_kernels();
std::vector<NamedKernel> one_vector_kernels();
/// The vector kernels, a target each.
std::vector<NamedKernel> batch_kernels();

}  // namespace contact::kernel::tiny
