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

/// Which of the rows below `size` are so, in order, and how many. Without a branch: they come in no order.
template <class IsSo>
std::size_t those_of(std::size_t size, std::uint16_t (&rows)[kStrip], const IsSo& is_so) {
  std::size_t count = 0;
  for (std::size_t row = 0; row < size; ++row) {
    rows[count] = static_cast<std::uint16_t>(row);
    count += is_so(row) ? 1U : 0U;
  }
  return count;
}

/// The hits alone, for a kernel that has no way of its own: all contacts of a strip, and those of misses taken out.
template <class A, class B>
batch::Count compute_hits_by_strips(const PairColumns<A, B>& pairs, const ContactQuestion& question,
                                    std::uint32_t* index, const ContactRows& out) {
  batch::Count count;
  for_each_strip(pairs, [&](const PairColumns<A, B>& strip, std::size_t begin) {
    const ContactRows rows = out.from(count.hits);
    std::uint32_t* const found = index + count.hits;
    count += compute_vectors(strip, question, rows);
    std::uint16_t hits[kStrip];
    const std::size_t size =
        those_of(strip.size, hits, [&](std::size_t i) { return rows.state[i] != batch::PairState::miss; });
    for (double* column : rows.number)
      for (std::size_t row = 0; row < size; ++row) column[row] = column[hits[row]];
    for (std::size_t row = 0; row < size; ++row) {
      rows.state[row] = rows.state[hits[row]];
      found[row] = static_cast<std::uint32_t>(begin + hits[row]);
    }
  });
  return count;
}

}  // namespace contact::kernel
