// Two balls that plain double-double arithmetic leaves: their numbers are too large, too small or too far apart for it,
// or they nearly touch. Lengths and delta are multiplied by a power of two each, and D - t^2 is summed without error.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "kernel/sphere_sphere_double_double.hpp"

namespace contact::kernel {

/// A power of two, as two factors that are normal numbers; beyond 2^-2044 and 2^2046 these.
class PowerOfTwo {
 public:
  explicit PowerOfTwo(int exponent) : first_(power(exponent / 2)), second_(power(exponent - exponent / 2)) {}
  /// x times the power; below the normal range within 2^-1074 of it.
  friend double operator*(double x, const PowerOfTwo& power) { return x * power.first_ * power.second_; }

 private:
  static double power(int exponent) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(std::clamp(1023 + exponent, 1, 2046)) << 52);
  }

  double first_;
  double second_;
};

/// The exponent of the power of two that is at most |x|. Domain: x is finite and not 0.
inline int exponent_of(double x) {
  const auto biased = static_cast<int>(std::bit_cast<std::uint64_t>(x) >> 52 & 0x7ff);
  return biased == 0 ? std::ilogb(x) : biased - 1023;
}

/// Two balls, and lengths t = r1 + r2 + distance.
/// Each number is computed in a unit of its own, a power of two, in which the largest part of it is in [1/4, 4):
///   delta, s    the largest component of delta; each n_i also has a unit
///   s - t       the largest of s, r1, r2 and distance
///   a point     the larger of c and r n
///
/// Every number is that of DoubleDoublePair but for what underflows: parts that are scaled down, products and low
/// parts. Each loses at most 2^-1074, fewer than 2^8 go into a number, by factors below 2^4, and kLost is more than
/// 2^60 times all of that.
class ScaledPair {
 public:
  /// What underflows, in the number's unit.
  static constexpr double kLost = 0x1p-1000;
  /// The square of a component from here on has all its bits in two numbers.
  static constexpr double kLeastFactor = 0x1p-450;
  /// Of |value| = |D - t^2| / (s + t). In units of u^2: D - t^2 in two numbers (six sums of at most 3 u: 18); s (13)
  /// and its sum with t (2); the quotient's remainder, at most 5 u of it, is built in three roundings (2, 3 and 4),
  /// divided by the sum's high part alone (10) and rounded, and rounded() rounds once more (5 and 5). 62
  static constexpr double kGapError = 128 * DoubleDoublePair::kUnitSquared;

  /// Nothing where the bounds do not hold: coincident centres, two coordinates of an axis of which one is more than
  /// 2^1974 times the other, or an arithmetic that does not round to nearest or flushes subnormals.
  [[nodiscard]] static std::optional<ScaledPair> of(const Ball& a, const Ball& b) {
    if (!rounds_to_nearest<double>() || !keeps_subnormals()) return std::nullopt;
    ScaledPair pair;
    std::array<DoubleDouble<double>, 3> delta;  // each component in its unit
    std::array<int, 3> exponent{};
    int& largest = pair.exponent_;
    largest = kNone;
    for (std::size_t i = 0; i < 3; ++i) {
      double from = a.center[static_cast<Eigen::Index>(i)];
      double to = b.center[static_cast<Eigen::Index>(i)];
      int room = 0;
      if (std::max(std::abs(from), std::abs(to)) >= 0x1p1000) {  // their difference may be twice as large
        const double from_before = std::exchange(from, from * 0x1p-100);
        const double to_before = std::exchange(to, to * 0x1p-100);
        if (from * 0x1p100 != from_before || to * 0x1p100 != to_before) return std::nullopt;
        room = 100;
      }
      delta[i] = two_sum(to, -from);
      pair.single_[i] = delta[i].low == 0;
      if (delta[i].high == 0) continue;
      const int own = exponent_of(delta[i].high);
      delta[i] = scaled(delta[i], PowerOfTwo(-own));
      exponent[i] = own + room;
      largest = std::max(largest, exponent[i]);
    }
    if (largest == kNone) return std::nullopt;
    for (std::size_t i = 0; i < 3; ++i)
      pair.delta_[i] =
          delta[i].high == 0 ? DoubleDouble<double>{0, 0} : scaled(delta[i], PowerOfTwo(exponent[i] - largest));
    const auto plain = DoubleDoublePair::of(pair.delta_, {0, 0});
    if (!plain) return std::nullopt;
    pair.root_ = plain->root();
    for (std::size_t i = 0; i < 3; ++i) {
      pair.normal_[i] = DoubleDoublePair::over_root(delta[i], pair.root_);
      pair.exponent_of_normal_[i] = exponent[i] - largest;
    }
    pair.radius_ = {a.radius, b.radius};
    return pair;
  }

  /// Whether s <= r1 + r2 + alarm, or nothing where that is not certain.
  [[nodiscard]] std::optional<bool> hit(double alarm) const {
    if (!std::isfinite(alarm)) return true;
    const Length length(*this, alarm);
    const Approximation difference = less(length);
    const double sum = difference.high + difference.low;
    if (std::abs(sum) > 2 * difference.error) return sum < 0;
    if (const auto gap = square_gap(length)) return gap->high <= 0;
    // s is more than a component that is t already, if another is not 0.
    if (!length.is_one_number()) return std::nullopt;
    const double t = beside_delta(length);
    for (std::size_t i = 0; i < 3; ++i)
      if (single_[i] && std::abs(delta_[i].high) == t && t >= 1)
        return normal_[(i + 1) % 3].high == 0 && normal_[(i + 2) % 3].high == 0;
    return std::nullopt;
  }

  /// n_i rounded once, or nothing where that is not certain; the other numbers too.
  [[nodiscard]] std::optional<double> normal(std::size_t axis) const {
    const auto& n = normal_[axis];
    if (n.high == 0) return 0;
    return rounded_in_unit({n.high, n.low, DoubleDoublePair::kNormalError * std::abs(n.high)},
                           exponent_of_normal_[axis]);
  }

  /// center + radius n_i.
  [[nodiscard]] std::optional<double> point(double center, double radius, std::size_t axis) const {
    const auto& n = normal_[axis];
    if (n.high == 0 || radius == 0) return center + 0.0;
    const int exponent_of_radius = exponent_of(radius);
    const int exponent_of_product = exponent_of_radius + exponent_of_normal_[axis];
    const int exponent = center == 0 ? exponent_of_product : std::max(exponent_of(center), exponent_of_product);
    Approximation number = DoubleDoublePair::point(center == 0 ? 0 : center * PowerOfTwo(-exponent),
                                                   radius * PowerOfTwo(-exponent_of_radius),
                                                   scaled(n, PowerOfTwo(exponent_of_product - exponent)));
    number.error += kLost;
    return rounded_in_unit(number, exponent);
  }

  /// s - (r1 + r2 + distance).
  [[nodiscard]] std::optional<double> value(double distance) const {
    const Length length(*this, distance);
    if (const auto rounded = rounded_in_unit(less(length), length.exponent)) return rounded;
    if (const auto gap = square_gap(length)) {
      if (gap->high == 0) return 0;
      const DoubleDouble<double> sum = two_sum(root_.high, beside_delta(length));
      const double sum_low = sum.low + root_.low;
      const double q = gap->high / sum.high;
      const double low = (std::fma(-q, sum.high, gap->high) + (gap->low - q * sum_low)) / sum.high;
      return rounded_in_unit({q, low, kGapError * std::abs(q) + kLost}, exponent_);
    }
    // s so small that no double lies between -t.low and s - t.low: the sum is a tie at most where t.low is a power of
    // two, and then s decides it.
    const auto [t, t_low] = length.sum;
    if (!length.is_exact || !(root_.high * PowerOfTwo(exponent_ - length.exponent) < std::abs(t_low) * 0x1p-54))
      return std::nullopt;
    int exponent = 0;
    const bool tie = std::abs(std::frexp(t_low, &exponent)) == 0.5;
    const double low = tie ? std::nextafter(-t_low, std::numeric_limits<double>::infinity()) : -t_low;
    return rounded_in_unit({-t, low, kLost}, length.exponent);
  }

 private:
  ScaledPair() = default;

  static bool keeps_subnormals() {
    static const volatile double least = std::numeric_limits<double>::min();
    const double half = least / 2;
    return half != 0 && half + half == least;
  }
  static DoubleDouble<double> scaled(const DoubleDouble<double>& x, const PowerOfTwo& by) {
    return {x.high * by, x.low * by};
  }
  /// t, in the unit of s - t.
  struct Length {
    int exponent;  ///< of the unit
    DoubleDouble<double> sum;
    bool is_exact = true;

    Length(const ScaledPair& pair, double distance) {
      const double largest = std::max({pair.radius_[0], pair.radius_[1], distance});
      exponent = largest == 0 ? pair.exponent_ : std::max(pair.exponent_, exponent_of(largest));
      const PowerOfTwo unit(-exponent);
      const auto in_unit = [&](double x) {
        const double length = x * unit;
        if (x != 0 && length < std::numeric_limits<double>::min()) is_exact = false;
        return length;
      };
      const DoubleDouble<double> radii = two_sum(in_unit(pair.radius_[0]), in_unit(pair.radius_[1]));
      const DoubleDouble<double> upper = two_sum(radii.high, in_unit(distance));
      const DoubleDouble<double> lower = two_sum(radii.low, upper.low);
      sum = {upper.high, lower.high};
      if (lower.low != 0) is_exact = false;
    }
    [[nodiscard]] bool is_one_number() const { return is_exact && sum.low == 0; }
  };

  /// s - t in its unit.
  [[nodiscard]] Approximation less(const Length& t) const {
    Approximation difference = DoubleDoublePair::root_less(scaled(root_, PowerOfTwo(exponent_ - t.exponent)), t.sum);
    difference.error += kLost;
    return difference;
  }

  /// t in units of delta.
  [[nodiscard]] double beside_delta(const Length& t) const { return t.sum.high * PowerOfTwo(t.exponent - exponent_); }

  /// D - t^2 in units of delta, without error but for a last sum: 0 and its sign are certain. Nothing where t or a
  /// component of delta is no single number, or too small beside the largest one.
  [[nodiscard]] std::optional<DoubleDouble<double>> square_gap(const Length& length) const {
    const double t = beside_delta(length);
    if (!length.is_one_number() || !(t > 0.5 && t < 8)) return std::nullopt;
    std::array<double, 8> sum{};  // numbers that do not overlap, the least first
    std::size_t size = 0;
    const auto add = [&](double x) {
      std::size_t kept = 0;
      for (std::size_t k = 0; k < size; ++k) {
        const DoubleDouble<double> both = two_sum(x, sum[k]);
        if (both.low != 0) sum[kept++] = both.low;
        x = both.high;
      }
      if (x != 0) sum[kept++] = x;
      size = kept;
    };
    for (std::size_t i = 0; i < 3; ++i) {
      if (normal_[i].high == 0) continue;
      const double component = delta_[i].high;
      if (!single_[i] || std::abs(component) < kLeastFactor) return std::nullopt;
      const double square = component * component;
      add(std::fma(component, component, -square));
      add(square);
    }
    add(-std::fma(t, t, -(t * t)));
    add(-(t * t));
    DoubleDouble<double> gap{0, 0};
    for (std::size_t k = size; k-- > 0;) {  // neighbours may be of about one size: high takes each in turn
      const DoubleDouble<double> both = two_sum(gap.high, sum[k]);
      gap = {both.high, gap.low + both.low};
    }
    return two_sum(gap.high, gap.low);
  }

  /// `number` times 2^exponent rounded once: as a subnormal number where it is one.
  [[nodiscard]] static std::optional<double> rounded_in_unit(const Approximation& number, int exponent) {
    const PowerOfTwo unit(exponent);
    const double least = exponent < 0 ? std::numeric_limits<double>::min() * PowerOfTwo(-exponent) : 0;
    if (std::abs(number.high) >= least) {
      const auto rounded = number.rounded();
      if (!rounded || std::abs(*rounded) < least) return std::nullopt;
      return *rounded * unit;  // infinite beyond the range
    }
    // A sum with 2^52 steps of the grid rounds to whole steps, which are numbers once they are multiplied.
    const double steps = std::copysign(least, number.high);
    const double whole = (number.high + steps) - steps;
    const double rest = (number.high - whole) + number.low;
    const double half_step = least * 0x1p-53;
    if (!(std::abs(rest) + 2 * number.error < half_step * (1 - 0x1p-40))) return std::nullopt;
    return whole * unit + 0.0;
  }

  static constexpr int kNone = std::numeric_limits<int>::min();

  int exponent_ = 0;  ///< of the unit of delta, s and D
  std::array<DoubleDouble<double>, 3> delta_;
  std::array<bool, 3> single_{};  ///< of delta: a component is one number, whatever underflows
  DoubleDouble<double> root_;     ///< s
  std::array<int, 3> exponent_of_normal_{};
  std::array<DoubleDouble<double>, 3> normal_;
  std::array<double, 2> radius_{};  ///< as they are
};

}  // namespace contact::kernel
