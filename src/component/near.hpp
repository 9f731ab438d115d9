// Which elements of a tree are near which of another.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "component/box_tree.hpp"

namespace contact::component {

/// Where the elements near one element stand: in the list `list`, from `begin`.
struct Near {
  std::size_t begin;
  std::uint32_t count;
  std::uint32_t list;
};

/// The elements near those of `asking` from `first` to `last`.
///
/// Candidates  boxes: those whose bounds, with `alarm` added to the asking one's and rounded to nearest, meet. Rounding
///             is monotone and a bound is a number that it leaves alone, so that no boxes that meet are lost.
///             Balls: at least those that are hits, seldom others.
struct Search {
  const BoxTree& asking;
  const BoxTree& asked;
  double alarm;
  bool self;  ///< both are one tree: of two elements the one with the lower index asks
  std::size_t first;
  std::size_t last;
  std::size_t most;                 ///< the search is given up where more than so many are found
  std::atomic<std::size_t>& found;  ///< so many, by all who search
  LargeVector<Near>& near;          ///< one for each element from first to last
};

/// Asks for the elements in some blocks of places, and appends those near them to `elements`, ascending for each.
void find_near(const Search& search, std::size_t first_block, std::size_t last_block, std::uint32_t list,
               std::vector<std::uint32_t>& elements);

}  // namespace contact::component
