// Chooses few candidates that together cover much.
#include "oracle/diagnosis/cover.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace contact::oracle {

std::vector<Choice> greedy_cover(std::size_t elements, std::size_t candidates, const GainOf& gain_of,
                                 const CoverLimits& limits) {
  std::vector<std::size_t> left(elements);
  std::iota(left.begin(), left.end(), std::size_t{0});
  std::vector<Choice> chosen;
  while (chosen.size() < limits.most && !left.empty()) {
    Choice best{};
    for (std::size_t candidate = 0; candidate < candidates; ++candidate) {
      Gain gain = gain_of(candidate, left);
      if (gain.score > best.gain.score) best = {candidate, std::move(gain)};
    }
    const Gain& gain = best.gain;
    if (gain.score == 0 || gain.covered * limits.one_in < limits.whole) break;
    std::erase_if(left, [&](std::size_t element) {
      return std::binary_search(gain.elements.begin(), gain.elements.end(), element);
    });
    chosen.push_back(std::move(best));
  }
  return chosen;
}

}  // namespace contact::oracle
