// What a law is tried on: a question, what else the law needs, and the steps towards one that a person can read.
#pragma once

#include <rapidcheck.h>

#include <array>
#include <cstdint>
#include <vector>

#include "oracle/truth/query.hpp"
#include "proptests/generators.hpp"

namespace contact::proptests {

/// What a law does with a question. Each law uses what it needs and brings it within what the question allows.
struct Change {
  int exponent = 1;                   ///< a power of two
  std::array<int, 3> order{0, 1, 2};  ///< the axes in another order
  std::array<bool, 3> reflected{};    ///< and turned round
  std::array<int, 3> steps{};         ///< a translation, in steps of the grid of the question's own numbers
  double length = 1;                  ///< another alarm or contact distance, or how much something grows
  int choice = 0;                     ///< which of a few
};

struct Trial {
  Query query;
  Change change;
  std::vector<Query> others;  ///< questions asked in between
};

/// How hard a trial is to read: digits and magnitudes of its numbers, and how much there is. 0 bits for 0.
[[nodiscard]] std::int64_t difficulty(const Trial& trial);
/// Digits of a number in binary, from the first to the last that is 1.
[[nodiscard]] int significant_bits(double x);

/// Easier trials in the range, the boldest first: numbers to 0, to integers, to few digits; equal radii; the first
/// centre at the origin; no alarm and no contact distance. Each is easier by `difficulty`, so that shrinking ends.
[[nodiscard]] std::vector<Trial> easier(const Trial& trial, const Range& range);

/// The trial with its easier ones, and theirs.
[[nodiscard]] rc::Shrinkable<Trial> shrinkable(const Trial& trial, const Range& range);

/// Draws what stands in a trial beside its question.
[[nodiscard]] rc::Gen<Change> changes(const Range& range);

}  // namespace contact::proptests
