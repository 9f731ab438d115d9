// The fast stage of sphere against sphere: every output in double-double arithmetic, with a bound on its error.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "contact/contact.hpp"
#include "contact/geometry.hpp"
#include "kernel/proved_bounds.hpp"

namespace contact::kernel {

/// high + low, unevaluated: |low| <= u |high| after two_sum, u = 2^-53.
struct DoubleDouble {
  double high;
  double low;
};

/// a + b exactly (Knuth). Domain: to nearest; no overflow, and no subnormal number.
[[nodiscard]] inline DoubleDouble two_sum(double a, double b) {
  const double high = a + b;
  const double b_part = high - a;
  return {high, (a - (high - b_part)) + (b - b_part)};
}

/// Whether sums round to nearest; asked of the arithmetic itself, since engines set the processor's mode behind the
/// back of the standard library.
inline bool rounds_to_nearest() {
  static const volatile double one = 1;
  static const volatile double tiny = 0x1p-60;
  const double x = one;
  const double t = tiny;
  return x + t == x && x - t == x;
}

/// Whether x is 0 or 2^-220 <= |x| <= 2^220. Asked of the bits: a comparison may take a subnormal number for 0.
inline bool in_range(double x) {
  constexpr std::uint64_t kLow = std::uint64_t{1023 - 220} << 52;
  constexpr std::uint64_t kHigh = std::uint64_t{1023 + 220} << 52;
  const std::uint64_t magnitude = std::bit_cast<std::uint64_t>(x) & ~(std::uint64_t{1} << 63);
  return magnitude == 0 || magnitude - kLow <= kHigh - kLow;
}

inline bool in_range(const Ball& ball) {
  return in_range(ball.center[0]) && in_range(ball.center[1]) && in_range(ball.center[2]) && in_range(ball.radius);
}

/// A real number within `error` of high + low.
struct Approximation {
  double high;
  double low;
  double error;

  /// The real number rounded once, to nearest, ties to even, or nothing where both ends of the interval do not round to
  /// the same double. The sums below round `low -+ error` once more; every `error` has room for that.
  [[nodiscard]] std::optional<double> rounded() const {
    const double below = high + (low - error);
    const double above = high + (low + error);
    if (below == above) return below + 0.0;  // + 0.0: every zero is +0
    return std::nullopt;
  }
};

/// Two balls, their delta and its length in double-double.
///   delta = c2 - c1 = dh + dl exactly     D = |delta|^2     s = sqrt(D)     n = delta / s     t = r1 + r2 + contact
/// Errors, in units of u^2 = 2^-106. A sum of terms that are together at most k u x is rounded by at most k u^2 x;
/// |low| <= u |high| after two_sum; residuals of products, quotients and roots are exact with a fused multiply-add.
///   D      on each axis 2 dh dl + residual, at most 3 u dh^2, is rounded (3) and dl^2 left out (1); these are added
///          (3 + 3), the two low parts of the squares' sum are added (2), and both (5)                  17 D
///   s      half of D's (8.5), the next term of the root's series (1.2), residual + D.low, at most 3 u D, rounded
///   (1.5),
///          its quotient by 2 root rounded (1.5)                                                        13 s
///   n_i    s's (13); remainder - q s.low, at most 3.5 u |q| s, built in two roundings (2 + 3.5), divided by root
///   instead
///          of s (5.3), the quotient rounded (3.5)                                                      28 |n_i|
///   point  n's (28); the product's low part, at most 2 u |w|, rounded (2), added to the sum's (2, and 1 |h|)
///                                                                                                      32 |w| + 1 |h|
///   value  s's (13), t's (2); s.low - t.low, at most 1.5 u s + 2 u t, rounded (1.5 and 2), added to the sum's low part
///          (the same again, and 1 |h|)                                                        16 s + 6 t + 1 |h|
/// rounded() rounds `low` once more: 1 |n_i|; 2 |w| + 1 |h|; 1.5 s + 2 t + 1 |h|.
class DoubleDoublePair {
 public:
  // The totals, rounded() included, and rounded up for the factors (1 + u)^k left out above.
  static constexpr double kNormalError = 30 * 0x1p-106;     // of |n_i|
  static constexpr double kPointError = 35 * 0x1p-106;      // of |w| = r |n_i|
  static constexpr double kValueRootError = 19 * 0x1p-106;  // of s
  static constexpr double kValueLessError = 9 * 0x1p-106;   // of t
  static constexpr double kLastSumError = 3 * 0x1p-106;     // of |h|, the sum of the high parts
  // docs/proofs, pair_*.g
  static_assert(kNormalError >= proved::kPairNormalNeeded && kPointError >= proved::kPairPointNeeded);
  static_assert(kValueRootError >= proved::kPairValueRootNeeded && kValueLessError >= proved::kPairValueLessNeeded);
  static_assert(kLastSumError >= proved::kPairLastSumNeeded);

  /// Nothing where the bounds do not hold: coincident centres, a number other than 0 outside [2^-220, 2^220], or a
  /// rounding mode that is not to nearest. Within them nothing overflows, D's terms are multiples of 2^-544, |n_i| and
  /// |w| are 0 or at least 2^-494 and 2^-715, and an underflow, gradual or flushed, loses at most 2^-1022: less than
  /// 2^-200 of every bound.
  [[nodiscard]] static std::optional<DoubleDoublePair> of(const Ball& a, const Ball& b, Distances distances);

  [[nodiscard]] Approximation normal(std::size_t axis) const {
    const auto& n = normal_[axis];
    return {n.high, n.low, kNormalError * std::abs(n.high)};
  }

  /// center + sign radius n on one axis.
  [[nodiscard]] Approximation point(double center, double signed_radius, std::size_t axis) const {
    const auto& n = normal_[axis];
    const double w = signed_radius * n.high;
    const double w_low = std::fma(signed_radius, n.low, std::fma(signed_radius, n.high, -w));
    const DoubleDouble h = two_sum(center, w);
    return {h.high, h.low + w_low, kPointError * std::abs(w) + kLastSumError * std::abs(h.high)};
  }

  /// s - (r1 + r2 + contact).
  [[nodiscard]] Approximation value() const {
    const DoubleDouble h = two_sum(root_.high, -less_.high);
    return {h.high, h.low + (root_.low - less_.low),
            (kValueRootError * root_.high + kValueLessError * less_.high) + kLastSumError * std::abs(h.high)};
  }

 private:
  DoubleDoublePair() = default;

  DoubleDouble root_;                   ///< s
  DoubleDouble less_;                   ///< t = r1 + r2 + contact
  std::array<DoubleDouble, 3> normal_;  ///< n
};

[[gnu::always_inline]] inline std::optional<DoubleDoublePair> DoubleDoublePair::of(const Ball& a, const Ball& b,
                                                                                   Distances distances) {
  if (!in_range(a) || !in_range(b) || !in_range(distances.contact) || !rounds_to_nearest()) return std::nullopt;

  std::array<DoubleDouble, 3> delta;
  std::array<double, 3> square;
  double residual = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    delta[i] = two_sum(b.center[axis], -a.center[axis]);
    const auto [high, low] = delta[i];
    square[i] = high * high;
    residual += std::fma(2 * high, low, std::fma(high, high, -square[i]));
  }
  const DoubleDouble xy = two_sum(square[0], square[1]);
  const DoubleDouble xyz = two_sum(xy.high, square[2]);
  if (xyz.high == 0) return std::nullopt;
  const DoubleDouble D = two_sum(xyz.high, (xy.low + xyz.low) + residual);

  DoubleDoublePair pair;
  const double root = std::sqrt(D.high);
  pair.root_ = {root, (std::fma(-root, root, D.high) + D.low) / (2 * root)};
  const DoubleDouble radii = two_sum(a.radius, b.radius);
  const DoubleDouble less = two_sum(radii.high, distances.contact);
  pair.less_ = {less.high, radii.low + less.low};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [high, low] = delta[i];
    const double q = high / root;
    const double remainder = std::fma(-q, root, high) + low;
    pair.normal_[i] = two_sum(q, std::fma(-q, pair.root_.low, remainder) / root);
  }
  return pair;
}

}  // namespace contact::kernel
