// Columns of doubles in one piece of memory, each at the start of a cache line and no two at the same place in a page:
// loads that look like recent stores to the processor would measure the allocator.
#pragma once

#include <hwy/aligned_allocator.h>

#include <algorithm>
#include <cstddef>
#include <span>

namespace contact::bench {

class Columns {
 public:
  /// Domain: `size` is a multiple of the numbers in a cache line.
  Columns(std::size_t columns, std::size_t size)
      : size_(size), memory_(hwy::AllocateAligned<double>(columns * (size + kStagger))) {
    std::fill_n(memory_.get(), columns * (size + kStagger), 1.0);
  }
  [[nodiscard]] std::span<double> operator[](std::size_t k) const {
    return {memory_.get() + k * (size_ + kStagger), size_};
  }

 private:
  static constexpr std::size_t kStagger = 24;  // three lines: 21 columns spread over a page
  std::size_t size_;
  hwy::AlignedFreeUniquePtr<double[]> memory_;
};

}  // namespace contact::bench
