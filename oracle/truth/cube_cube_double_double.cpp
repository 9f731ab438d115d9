// Two axis-aligned boxes in pairs of doubles.
#include <algorithm>

#include "oracle/truth/double_double.hpp"
#include "oracle/truth/double_double_oracle.hpp"

namespace contact::oracle {
namespace {

// Sums of three, which is all that boxes need, stay below the largest finite number.
constexpr double kLargestOfBoxes = 0x1p1000;

}  // namespace

std::optional<RoundedAnswer> double_double_answer(const Boxes& boxes, Distances distances, Scalar /*scalar*/) {
  const auto& [a, b] = boxes;
  const auto most = [](const Vector3& v) { return v.array().abs().maxCoeff(); };
  if (!(std::max({most(a.min), most(a.max), most(b.min), most(b.max), distances.alarm}) <= kLargestOfBoxes))
    return std::nullopt;
  RoundedAnswer found{-1, -1, {}};
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    for (const DoubleDouble& gap : {two_sum(a.min[axis], -b.max[axis]), two_sum(b.min[axis], -a.max[axis])}) {
      const auto at_alarm = (gap - DoubleDouble{distances.alarm}).sign();
      const auto at_zero = gap.sign();
      if (!at_alarm || !at_zero) return std::nullopt;
      found.at_alarm = std::max(found.at_alarm, *at_alarm);
      found.at_zero = std::max(found.at_zero, *at_zero);
    }
  found.expected.hit = found.at_alarm <= 0;
  return found;
}

}  // namespace contact::oracle
