// What the last bit of a question's numbers would have done to its answer: docs/specification.md#conditioning.
#pragma once

#include <array>

#include "oracle/judge/judge.hpp"

namespace contact::oracle {

/// How much the right answer changes where each number of the question moves to a neighbour in the engine's scalar: by
/// field, the sum over the numbers of the larger change, rounded down; a normal in radians, else the coordinate that
/// changes most. The neighbours' answers are the oracle's, so it holds where a derivative does not exist.
struct LastBit {
  std::array<double, kFields.size()> effect{};

  [[nodiscard]] double at(Field field) const { return effect[static_cast<std::size_t>(field)]; }
};
/// Domain: a hit with numbers. Nothing changes where the cores meet, or where more points than one are nearest: there
/// the judge knows every right answer.
[[nodiscard]] LastBit last_bit(const Query& query, const Declaration& declared);

/// Whether some question whose numbers are all neighbours of this one's has the other decision: those are taken that
/// move the distance most, one by one for a pair without a distance.
[[nodiscard]] bool last_bit_decides(const Query& query, const Truth& truth, const Declaration& declared);

/// Marks what is wrong in a verdict and no worse than the inputs' last bit.
void mark_last_bit(const Query& query, const Truth& truth, const Declaration& declared, Verdict& verdict);

}  // namespace contact::oracle
