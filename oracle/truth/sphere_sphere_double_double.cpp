// Two spheres in pairs of doubles.
#include "oracle/truth/double_double_nearest.hpp"
#include "oracle/truth/grid.hpp"

namespace contact::oracle {
namespace {

/// Both decisions in whole numbers of two words, where the question has room in them.
std::optional<Sides> sides(const Balls& balls, Distances distances) {
  const auto& [a, b] = balls;
  const OnWords<9> words({a.center[0], a.center[1], a.center[2], b.center[0], b.center[1], b.center[2], a.radius,
                          b.radius, distances.alarm});
  if (!words.fit()) return std::nullopt;
  TwoWords D = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) D += square(words[axis] - words[axis + 3]);
  const auto side = [&](std::int64_t reach) { return D < square(reach) ? -1 : D == square(reach) ? 0 : 1; };
  return Sides{side(words[6] + words[7] + words[8]), side(words[6] + words[7])};
}

}  // namespace

std::optional<RoundedAnswer> double_double_answer(const Balls& balls, Distances distances, Scalar scalar) {
  constexpr int kMost = 200;
  const auto& [a, b] = balls;
  if (!in_range(a.center, kMost) || !in_range(b.center, kMost) || !in_range(a.radius, kMost) ||
      !in_range(b.radius, kMost) || !in_range(distances.alarm, kMost) || !in_range(distances.contact, kMost))
    return std::nullopt;
  const DoubleDoubleNearest nearest{exactly(a.center), exactly(b.center), difference(b.center, a.center)};
  if (auto found = case_of_nearest(nearest, a.radius, b.radius, distances, scalar)) return found;
  const auto known = sides(balls, distances);
  if (!known) return std::nullopt;
  return case_of_nearest(nearest, a.radius, b.radius, distances, scalar, known);
}

}  // namespace contact::oracle
