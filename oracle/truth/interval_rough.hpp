// Numbers of which the interval oracle first asks a double: most signs are far from any doubt.
#pragma once

#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <optional>
#include <vector>

#include "oracle/truth/interval.hpp"

namespace contact::oracle {

/// A real number that lies no farther than `off` from `value`. Where a double overflows nothing is known. Domain: doubles are rounded to nearest.
struct Rough {
  double value;
  double off;

  [[nodiscard]] static Rough of(const Interval& x) {
    const auto [low, high] = x.ends();
    return {low, kMore * ((high - low) + kHalfUlp * (std::abs(low) + std::abs(high))) + kLeast};
  }

  friend Rough operator+(const Rough& x, const Rough& y) { return rounded(x.value + y.value, x.off + y.off); }
  friend Rough operator-(const Rough& x, const Rough& y) { return rounded(x.value - y.value, x.off + y.off); }
  friend Rough operator*(const Rough& x, const Rough& y) {
    return rounded(x.value * y.value, std::abs(x.value) * y.off + std::abs(y.value) * x.off + x.off * y.off);
  }

  /// The sign, where it has only one.
  [[nodiscard]] std::optional<int> sign() const {
    if (value > off) return 1;
    if (-value > off) return -1;
    return std::nullopt;
  }

 private:
  static constexpr double kHalfUlp = 0x1p-53;
  static constexpr double kMore = 1 + 0x1p-48;  // what sums and products of offs are rounded by
  static constexpr double kLeast = 0x1p-1070;   // what all of them underflow by
  static Rough rounded(double value, double off) {
    return {value, kMore * (off + kHalfUlp * std::abs(value)) + kLeast};
  }
};

using RoughTriple = std::array<Rough, 3>;
/// A power of two near the largest of all coordinates.
[[nodiscard]] inline long power_of(const std::vector<Triple>& points) {
  long largest = LONG_MIN;
  for (const Triple& point : points)
    for (const Interval& x : point) largest = std::max(largest, x.exponent().value_or(LONG_MIN));
  return largest == LONG_MIN ? 0 : largest;
}
/// Points over 2^power: of numbers near 1 no product overflows, and the sign of no product of their differences is another.
[[nodiscard]] inline std::vector<RoughTriple> rough(const std::vector<Triple>& points, long power) {
  std::vector<RoughTriple> all;
  all.reserve(points.size());
  const auto of = [&](const Interval& x) { return Rough::of(x.scaled(-power)); };
  for (const Triple& x : points) all.push_back({of(x[0]), of(x[1]), of(x[2])});
  return all;
}
[[nodiscard]] inline RoughTriple rough_direction(const Triple& n) { return rough({n}, power_of({n})).front(); }
[[nodiscard]] inline RoughTriple difference(const RoughTriple& x, const RoughTriple& y) {
  return {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
}
[[nodiscard]] inline Rough dot(const RoughTriple& x, const RoughTriple& y) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}
[[nodiscard]] inline RoughTriple cross(const RoughTriple& x, const RoughTriple& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

}  // namespace contact::oracle
