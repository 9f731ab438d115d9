// The elements of a model in the order of space, and a tree of boxes over them: which of them may be near another?
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "component/large_vector.hpp"
#include "contact/detect.hpp"
#include "contact/sphere_model.hpp"

namespace contact::component {

/// So many boxes or balls are tested together: a vector of doubles where vectors are widest.
inline constexpr std::size_t kTogether = 8;

/// Boxes, one column a bound. Those behind the last one are empty: they meet nothing.
struct alignas(64) BoxBlock {
  std::array<std::array<double, kTogether>, 3> min;
  std::array<std::array<double, kTogether>, 3> max;
};

/// Balls, one column a number. What stands behind the last one means nothing.
struct alignas(64) BallBlock {
  std::array<std::array<double, kTogether>, 3> center;
  std::array<double, kTogether> radius;
};

/// The elements lie in places that follow a curve through space, so that neighbours are near each other; large ones
/// stand apart from small ones. Above them the boxes of eight stand in one box, the boxes of eight of these in another,
/// and so on.
///
/// Only comparisons and a choice of order are made of the boxes, so that no rounding can lose a meeting.
struct BoxTree {
  std::size_t size = 0;
  LargeVector<std::uint32_t> element;         ///< the element at each place
  LargeVector<BallBlock> balls;               ///< of sphere models, in the place of levels[0]
  std::vector<LargeVector<BoxBlock>> levels;  ///< levels[0] of the elements, levels[k] of the blocks of levels[k - 1]

  /// The lanes of a block of elements that hold one.
  [[nodiscard]] unsigned used(std::size_t block) const {
    const std::size_t left = size - block * kTogether;
    return left >= kTogether ? 0xff : (1U << left) - 1;
  }
};

/// The tree of a model; where there are `balls`, these are the model's elements.
/// Throws std::logic_error if the box of an element has a NaN or min > max, of the first such element.
[[nodiscard]] BoxTree tree_of(const CollisionModel& model, const BallArray* balls, const ParallelFor& parallel_for);

/// work(begin, end) on parts of 0 .. n - 1, in the default floating-point environment.
void for_parts(std::size_t n, std::size_t part, const ParallelFor& parallel_for,
               const std::function<void(std::size_t, std::size_t)>& work);

}  // namespace contact::component
