// The fast stage of sphere against sphere: every output in double-double arithmetic, with a bound on its error. Written
// over the number type: production computes with double, and tests with numbers so short that all of them can be tried.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "contact/geometry.hpp"
#include "kernel/proved_bounds.hpp"

namespace contact::kernel {

#define CONTACT_LANES [[gnu::always_inline]] inline
#include "kernel/one_pair_lanes-inl.h"
// On these lanes:
#include "kernel/double_double-inl.h"
#undef CONTACT_LANES

/// Whether sums round to nearest; asked of the arithmetic itself, since engines set the processor's mode behind the
/// back of the standard library.
template <class Real>
bool rounds_to_nearest() {
  static const volatile double one = 1;
  static const volatile double tiny = static_cast<double>(std::numeric_limits<Real>::epsilon()) / 256;
  const Real x = one;
  const Real t = tiny;
  return x + t == x && x - t == x;
}

/// Whether x is 0 or 2^-kMost <= |x| <= 2^kMost. Asked of the bits: a comparison may take a subnormal number for 0.
template <class Real, int kMost = 220>
bool in_range(Real x) {
  constexpr std::uint64_t kLow = std::uint64_t{1023 - kMost} << 52;
  constexpr std::uint64_t kHigh = std::uint64_t{1023 + kMost} << 52;
  const std::uint64_t magnitude = std::bit_cast<std::uint64_t>(static_cast<double>(x)) & ~(std::uint64_t{1} << 63);
  return magnitude == 0 || magnitude - kLow <= kHigh - kLow;
}

template <class AnyBall>
bool ball_in_range(const AnyBall& ball) {
  return in_range(ball.center[0]) && in_range(ball.center[1]) && in_range(ball.center[2]) && in_range(ball.radius);
}

/// A real number within `error` of high + low.
template <class Real>
struct ApproximationOf {
  Real high;
  Real low;
  Real error;

  /// The real number rounded once, to nearest, ties to even, or nothing where both ends of the interval do not round to
  /// the same double. The sums below round `low -+ error` once more; every `error` has room for that.
  [[nodiscard]] std::optional<Real> rounded() const {
    const Real below = high + (low - error);
    const Real above = high + (low + error);
    if (below == above) return below + 0.0;  // + 0.0: every zero is +0
    return std::nullopt;
  }
};
using Approximation = ApproximationOf<double>;

/// Two balls, their delta and its length in double-double. On single numbers the shared root of
/// sphere_sphere_formula-inl.h takes 2.2 to 2.6 times as long, and 3 times where std::fma is no instruction: its bounds
/// are wider, and it rounds each number by two more fused multiply-adds.
///   delta = c2 - c1 = dh + dl exactly     D = |delta|^2     s = sqrt(D)     n = delta / s     t = r1 + r2 + contact
/// Errors are in units of u^2, 2^-106 for double. A sum of terms that are together at most k u x is rounded by at most
/// k u^2 x; |low| <= u |high| after two_sum; residuals of products, quotients and roots are exact with a fused
/// multiply-add.
///   D      On each axis 2 dh dl + residual, at most 3 u dh^2, is rounded (3) and dl^2 left out (1). These are added
///          (3 + 3), the two low parts of the squares' sum are added (2), and both (5).                17 D
///   s      Half of D's error (8.5); the next term of the root's series (1.2); residual + D.low, at most 3 u D, is
///          rounded (1.5), and its quotient by 2 root (1.5).                                           13 s
///   n_i    The error of s (13); remainder - q s.low, at most 3.5 u |q| s, is built in two roundings (2 + 3.5) and
///          divided by root instead of s (5.3), and the quotient is rounded (3.5).                     28 |n_i|
///   point  The error of n (28); the product's low part, at most 2 u |w|, is rounded (2) and added to the sum's
///          (2, and 1 |h|).                                                                            32 |w| + 1 |h|
///   value  The errors of s (13) and t (2); s.low - t.low, at most 1.5 u s + 2 u t, is rounded (1.5 and 2) and added to
///          the sum's low part (the same again, and 1 |h|).                                   16 s + 6 t + 1 |h|
/// rounded() rounds `low` once more: 1 |n_i|; 2 |w| + 1 |h|; 1.5 s + 2 t + 1 |h|.
template <class Real>
class DoubleDoublePairOf {
 public:
  // The totals, rounded() included, and rounded up for the factors (1 + u)^k left out above.
  static constexpr double kUnit = static_cast<double>(std::numeric_limits<Real>::epsilon()) / 2;  // u
  static constexpr double kUnitSquared = kUnit * kUnit;
  static constexpr double kNormalError = 30 * kUnitSquared;     // of |n_i|
  static constexpr double kPointError = 35 * kUnitSquared;      // of |w| = r |n_i|
  static constexpr double kValueRootError = 19 * kUnitSquared;  // of s
  static constexpr double kValueLessError = 9 * kUnitSquared;   // of t
  static constexpr double kLastSumError = 3 * kUnitSquared;     // of |h|, the sum of the high parts

  /// Nothing where the bounds do not hold: coincident centres, a number other than 0 outside [2^-220, 2^220], or a
  /// rounding mode that is not to nearest. Within them nothing overflows, D's terms are multiples of 2^-544, |n_i| and
  /// |w| are 0 or at least 2^-494 and 2^-715, and an underflow, gradual or flushed, loses at most 2^-1022: less than
  /// 2^-200 of every bound.
  template <class AnyBall = Ball, class AnyDistances = Distances>
  [[nodiscard]] static std::optional<DoubleDoublePairOf> of(const AnyBall& a, const AnyBall& b,
                                                            const AnyDistances& distances);
  /// The same of a delta and a t that are given. Nothing where D is 0. Domain: as above, |low| <= u |high|.
  [[nodiscard]] static std::optional<DoubleDoublePairOf> of(const std::array<DoubleDouble<Real>, 3>& delta,
                                                            const DoubleDouble<Real>& less);

  [[nodiscard]] const DoubleDouble<Real>& root() const { return root_; }
  [[nodiscard]] const DoubleDouble<Real>& normal_parts(std::size_t axis) const { return normal_[axis]; }

  [[nodiscard]] ApproximationOf<Real> normal(std::size_t axis) const {
    using std::abs;
    const auto& n = normal_[axis];
    return {n.high, n.low, kNormalError * abs(n.high)};
  }

  /// center + sign radius n on one axis.
  [[nodiscard]] ApproximationOf<Real> point(Real center, Real signed_radius, std::size_t axis) const {
    return point(center, signed_radius, normal_[axis]);
  }
  /// The same of an n_i that is given. Domain: as near as those here.
  [[nodiscard]] static ApproximationOf<Real> point(Real center, Real signed_radius, const DoubleDouble<Real>& n) {
    using std::abs;
    using std::fma;
    const Real w = signed_radius * n.high;
    const Real w_low = fma(signed_radius, n.low, fma(signed_radius, n.high, -w));
    const DoubleDouble<Real> h = two_sum(center, w);
    return {h.high, h.low + w_low, kPointError * abs(w) + kLastSumError * abs(h.high)};
  }

  /// s - (r1 + r2 + contact).
  [[nodiscard]] ApproximationOf<Real> value() const { return root_less(root_, less_); }

  /// One component of delta divided by s.
  [[nodiscard]] static DoubleDouble<Real> over_root(const DoubleDouble<Real>& component,
                                                    const DoubleDouble<Real>& root) {
    using std::fma;
    const Real q = component.high / root.high;
    const Real remainder = fma(-q, root.high, component.high) + component.low;
    return two_sum(q, fma(-q, root.low, remainder) / root.high);
  }

  /// s - t. Domain: both as near as those here.
  [[nodiscard]] static ApproximationOf<Real> root_less(const DoubleDouble<Real>& root, const DoubleDouble<Real>& less) {
    using std::abs;
    const DoubleDouble<Real> h = two_sum(root.high, -less.high);
    return {h.high, h.low + (root.low - less.low),
            (kValueRootError * root.high + kValueLessError * less.high) + kLastSumError * abs(h.high)};
  }

 private:
  DoubleDoublePairOf() = default;

  DoubleDouble<Real> root_;                   ///< s
  DoubleDouble<Real> less_;                   ///< t = r1 + r2 + contact
  std::array<DoubleDouble<Real>, 3> normal_;  ///< n
};

template <class Real>
template <class AnyBall, class AnyDistances>
[[gnu::always_inline]] inline std::optional<DoubleDoublePairOf<Real>> DoubleDoublePairOf<Real>::of(
    const AnyBall& a, const AnyBall& b, const AnyDistances& distances) {
  if (!ball_in_range(a) || !ball_in_range(b) || !in_range(distances.contact) || !rounds_to_nearest<Real>())
    return std::nullopt;
  std::array<DoubleDouble<Real>, 3> delta;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<std::ptrdiff_t>(i);
    delta[i] = two_sum<Real>(b.center[axis], -a.center[axis]);
  }
  const DoubleDouble<Real> radii = two_sum(a.radius, b.radius);
  const DoubleDouble<Real> less = two_sum(radii.high, distances.contact);
  return of(delta, {less.high, radii.low + less.low});
}

template <class Real>
[[gnu::always_inline]] inline std::optional<DoubleDoublePairOf<Real>> DoubleDoublePairOf<Real>::of(
    const std::array<DoubleDouble<Real>, 3>& delta, const DoubleDouble<Real>& less) {
  using std::fma;
  using std::sqrt;
  std::array<Real, 3> square;
  Real residual = 0;
#pragma GCC unroll 3
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [high, low] = delta[i];
    square[i] = high * high;
    residual += fma(2 * high, low, fma(high, high, -square[i]));
  }
  const DoubleDouble<Real> xy = two_sum(square[0], square[1]);
  const DoubleDouble<Real> xyz = two_sum(xy.high, square[2]);
  if (xyz.high == 0) return std::nullopt;
  const DoubleDouble<Real> D = two_sum(xyz.high, (xy.low + xyz.low) + residual);

  DoubleDoublePairOf pair;
  const Real root = sqrt(D.high);
  pair.root_ = {root, (fma(-root, root, D.high) + D.low) / (2 * root)};
  pair.less_ = less;
#pragma GCC unroll 3
  for (std::size_t i = 0; i < 3; ++i) pair.normal_[i] = over_root(delta[i], pair.root_);
  return pair;
}

using DoubleDoublePair = DoubleDoublePairOf<double>;
// proofs, pair_*.g
static_assert(DoubleDoublePair::kNormalError >= proved::kPairNormalNeeded);
static_assert(DoubleDoublePair::kPointError >= proved::kPairPointNeeded);
static_assert(DoubleDoublePair::kValueRootError >= proved::kPairValueRootNeeded);
static_assert(DoubleDoublePair::kValueLessError >= proved::kPairValueLessNeeded);
static_assert(DoubleDoublePair::kLastSumError >= proved::kPairLastSumNeeded);

}  // namespace contact::kernel
