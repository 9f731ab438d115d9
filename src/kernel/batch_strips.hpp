// Columns of pairs strip by strip: what one function writes for the next stays in the first level cache.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "kernel/batch.hpp"

namespace contact::kernel {

/// Pairs of a strip.
constexpr std::size_t kStrip = 256;

/// Calls work(strip, begin) for every strip of pairs, the last of which may be shorter.
template <std::size_t most = kStrip, class A, class B, class Work>
void for_each_strip(const PairColumns<A, B>& pairs, const Work& work) {
  for (std::size_t begin = 0; begin < pairs.size; begin += most)
    work(pairs.from(begin, std::min(most, pairs.size - begin)), begin);
}

}  // namespace contact::kernel
