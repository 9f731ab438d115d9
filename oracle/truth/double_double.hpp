// Real numbers enclosed by pairs of doubles with a radius: high + low within `radius`.
#pragma once

#include <cmath>
#include <limits>
#include <optional>

#include "oracle/truth/proved_bounds.hpp"
#include "oracle/truth/query.hpp"

namespace contact::oracle {

// How far the result of an operation lies from the exact result for the midpoints, relative to that result, in units of
// u^2 = 2^-106. Each covers the proved bound, the second-order terms, and products of low parts that underflow:
// docs/oracle-stages.md#bounds derives them.
inline constexpr double kU2 = 0x1p-106;
inline constexpr double kSumError = 4 * kU2;
inline constexpr double kProductError = 8 * kU2;
inline constexpr double kReciprocalError = 9 * kU2;
inline constexpr double kRootError = 5 * kU2;
/// More than the roundings of any one radius, to nearest, take off it.
inline constexpr double kRadiusRounding = 1 + 0x1p-49;
// proofs, oracle_*.g; the sum's bound is the cited theorem's.
static_assert(kProductError >= proved::kOracleProduct && kReciprocalError >= proved::kOracleReciprocal &&
              kRootError >= proved::kOracleRoot && kRadiusRounding >= proved::kRadiusRounding);

/// A real number x with |x - (high + low)| <= radius, and high = high + low rounded to nearest.
/// The operations expect round-to-nearest, no overflow, and of a product that its operands are 0 or of magnitude 2^-480
/// and more. They are exact, with no radius of their own, where both low parts are 0 and nothing has to be divided.
struct DoubleDouble {
  double high = 0;
  double low = 0;
  double radius = 0;

  /// The sign, where the whole enclosure has it.
  [[nodiscard]] std::optional<int> sign() const {
    if (high == 0) return radius == 0 ? std::optional(0) : std::nullopt;  // high = 0 has low = 0
    // |low| <= u |high|.
    if (!(std::abs(high) * (1 - 0x1p-50) > radius)) return std::nullopt;
    return high > 0 ? 1 : -1;
  }
};

/// high + low = x + y exactly.
[[nodiscard]] inline DoubleDouble two_sum(double x, double y) {
  const double s = x + y;
  const double t = s - x;
  return {s, (x - (s - t)) + (y - t), 0};
}

/// The same where |x| >= |y| or x = 0.
[[nodiscard]] inline DoubleDouble fast_two_sum(double x, double y) {
  const double s = x + y;
  return {s, y - (s - x), 0};
}

[[nodiscard]] inline DoubleDouble operator-(const DoubleDouble& x) { return {-x.high, -x.low, x.radius}; }

[[nodiscard]] inline DoubleDouble operator+(const DoubleDouble& x, const DoubleDouble& y) {
  const DoubleDouble s = two_sum(x.high, y.high);
  if (x.low == 0 && y.low == 0) return {s.high, s.low, (x.radius + y.radius) * kRadiusRounding};
  const DoubleDouble t = two_sum(x.low, y.low);
  const DoubleDouble v = fast_two_sum(s.high, s.low + t.high);
  const DoubleDouble r = fast_two_sum(v.high, t.low + v.low);
  return {r.high, r.low, (x.radius + y.radius + kSumError * std::abs(r.high)) * kRadiusRounding};
}
[[nodiscard]] inline DoubleDouble operator-(const DoubleDouble& x, const DoubleDouble& y) { return x + -y; }

[[nodiscard]] inline DoubleDouble operator*(const DoubleDouble& x, const DoubleDouble& y) {
  const double p = x.high * y.high;
  const double e = std::fma(x.high, y.high, -p);  // p + e = x.high y.high exactly
  const double carried = (std::abs(x.high) + x.radius) * y.radius + std::abs(y.high) * x.radius;
  if (x.low == 0 && y.low == 0) return {p, e, carried * kRadiusRounding};
  const double crossed = std::fma(x.low, y.high, std::fma(x.high, y.low, x.low * y.low));
  const DoubleDouble r = fast_two_sum(p, e + crossed);
  return {r.high, r.low, (carried + kProductError * std::abs(r.high)) * kRadiusRounding};
}

/// 1 / x, x.high > 0 and far above its radius.
[[nodiscard]] inline DoubleDouble reciprocal(const DoubleDouble& x) {
  const double t = 1 / x.high;
  const double rest = std::fma(-x.high, t, 1.0);  // exact
  // |1 / x' - 1 / x| = |x' - x| / (x' x), and x' >= x / 2 doubles it at most.
  const double carried = 2 * x.radius * (t * t);
  if (x.low == 0 && rest == 0) return {t, 0, carried * kRadiusRounding};
  const DoubleDouble r = fast_two_sum(t, t * std::fma(-x.low, t, rest));
  return {r.high, r.low, (carried + kReciprocalError * r.high) * kRadiusRounding};
}

/// sqrt(x), x.high > 0 and far above its radius.
[[nodiscard]] inline DoubleDouble root(const DoubleDouble& x) {
  const double s = std::sqrt(x.high);
  const double rest = std::fma(-s, s, x.high) + x.low;  // x - s^2: the product is exact, the sum rounded
  // |sqrt(x') - sqrt(x)| = |x' - x| / (sqrt(x') + sqrt(x)) <= |x' - x| / sqrt(x).
  const double carried = x.radius / s;
  if (rest == 0) return {s, 0, carried * kRadiusRounding};
  const DoubleDouble r = fast_two_sum(s, rest / (2 * s));
  return {r.high, r.low, (carried + kRootError * r.high) * kRadiusRounding};
}

/// Two doubles with the rounding of the real number to binary64 between them.
struct Bracket {
  double low;
  double high;
};
/// Domain: |x.high| < 2^1000.
[[nodiscard]] inline Bracket bracket(const DoubleDouble& x) {
  if (x.radius == 0) return {x.high, x.high};
  // More than the radius by more than the rounding of low -+ off takes off it.
  const double off = x.radius * (1 + 0x1p-49) + std::abs(x.low) * 0x1p-52;
  return {x.high + (x.low - off), x.high + (x.low + off)};
}

/// x rounded once to the scalar, to nearest, ties to even, +0 for zero; nothing where the enclosure holds numbers that
/// round differently. Domain: |x.high| < 2^1000.
[[nodiscard]] inline std::optional<double> round_to_nearest(const DoubleDouble& x, Scalar scalar) {
  auto [low, high] = bracket(x);
  if (scalar == Scalar::binary32) {
    // The ends have been rounded to binary64: the real number lies between the neighbours beyond them.
    if (x.radius != 0 || x.low != 0) {
      low = std::nextafter(low, -std::numeric_limits<double>::infinity());
      high = std::nextafter(high, std::numeric_limits<double>::infinity());
    }
    low = static_cast<double>(static_cast<float>(low));
    high = static_cast<double>(static_cast<float>(high));
  }
  if (low != high) return std::nullopt;
  return low == 0 ? 0.0 : low;
}

}  // namespace contact::oracle
