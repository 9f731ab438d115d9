// Chooses few candidates that together cover much.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace contact::oracle {

/// What a candidate gains from the elements that are left.
struct Gain {
  double score = 0;                   ///< the candidate with the highest is chosen, and none with 0 or less
  double covered = 0;                 ///< the weight of the elements that it covers
  std::vector<std::size_t> elements;  ///< those elements, in ascending order
};
/// The gain of a candidate from elements, which are given in ascending order.
using GainOf = std::function<Gain(std::size_t candidate, std::span<const std::size_t> left)>;

struct CoverLimits {
  std::size_t most;  ///< how many candidates may be chosen
  double whole;      ///< the weight of all elements
  double one_in;     ///< a chosen candidate covers at least one in so many of the whole
};

struct Choice {
  std::size_t candidate;
  Gain gain;
};

/// Greedy weighted set cover. To find the fewest candidates that cover everything is NP-hard; this finds few. Each
/// round asks every candidate for its gain from the elements that are left, chooses the one with the highest score, and
/// takes away what it covers. The rounds end when `most` candidates are chosen, when no element is left, when no score
/// is above 0, or when the candidate with the highest score covers too little, even if another covers more.
///
/// Ties: of equal scores the lowest candidate wins, so the order of the candidates is their priority.
///
/// Cost: at most `most` rounds, and one call of `gain_of` for each candidate in each. A call that looks at every
/// element left makes that O(most * candidates * elements).
///
/// Where the score is the number of elements covered, as many rounds as needed cover everything with at most ln(n) + 1
/// times the fewest candidates, for n elements. A score that also counts what speaks against a candidate has no such
/// bound.
[[nodiscard]] std::vector<Choice> greedy_cover(std::size_t elements, std::size_t candidates, const GainOf& gain_of,
                                               const CoverLimits& limits);

}  // namespace contact::oracle
