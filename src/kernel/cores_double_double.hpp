// The fast stage of every pair with a distance: the numbers of a contact from approximate nearest points p and q of its
// two cores, each with a bound on its error.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "contact/contact.hpp"
#include "kernel/cores.hpp"
#include "kernel/sphere_sphere_double_double.hpp"
#include "kernel/sphere_sphere_filter.hpp"
#include "kernel/sphere_sphere_numbers.hpp"

namespace contact::kernel {

using DoubleDoubles = std::array<DoubleDouble<double>, 3>;
inline constexpr double kUnitSquared = DoubleDoublePair::kUnitSquared;

/// p, q and delta = q - p, each with |low| <= u |high|.
struct ApproximateNearest {
  DoubleDoubles p;
  DoubleDoubles q;
  DoubleDoubles delta;
  /// The coordinates of p and q are within these and kOwnError of their own magnitude, those of delta within the last.
  double p_error;
  double q_error;
  double delta_error;
  static constexpr double kOwnError = 8 * kUnitSquared;
};

/// Whether a number is 0 or 2^-100 <= |x| <= 2^100: then nothing of a degree up to 4 leaves the range in a way that
/// matters.
[[gnu::always_inline]] inline bool in_short_range(double x) { return in_range<double, 100>(x); }
[[gnu::always_inline]] inline bool in_short_range(const Vector3& v) {
  return in_short_range(v[0]) && in_short_range(v[1]) && in_short_range(v[2]);
}
[[gnu::always_inline]] inline bool in_short_range(const Lengths& x) {
  return in_short_range(x.radius1) && in_short_range(x.radius2) && in_short_range(x.alarm) && in_short_range(x.contact);
}

/// core + signed_radius n, n being a component of a DoubleDoublePair's normal. The core is within `error` and kOwnError
/// of its magnitude, n within `turn` beside its own error.
///   r n + p in place of r n + c: p.low, at most u |p|, is added in (2 |w| + |p|), the sum rounded (|h| + 2 |w| + |p|),
///   rounded() (the same again), and n and its product are as there (30)              36 |w| + 2 |h| + 3 |p|
[[gnu::always_inline]] inline Approximation point_beside(const DoubleDouble<double>& core, double error,
                                                         const DoubleDouble<double>& n, double signed_radius,
                                                         double turn) {
  // Beside kPointError and kLastSumError of the pair, which are of an exact centre; 1 is room for the sums of errors.
  constexpr double kPointError = 40 * kUnitSquared;                                // of |w|
  constexpr double kCoreError = ApproximateNearest::kOwnError + 4 * kUnitSquared;  // of |p|
  const double w = signed_radius * n.high;
  const double w_low = std::fma(signed_radius, n.low, std::fma(signed_radius, n.high, -w));
  const DoubleDouble<double> h = two_sum(core.high, w);
  return {h.high, h.low + (w_low + core.low),
          (kPointError * std::abs(w) + kCoreError * std::abs(core.high)) +
              (DoubleDoublePair::kLastSumError * std::abs(h.high) + (error + std::abs(signed_radius) * turn))};
}

/// The contact of approximate cores. It is DoubleDoublePair of the approximate delta, d, whose errors are known, beside
/// what the error e of its coordinates does. The length of d is off by 2 e at most (the root of 3 is below 2), and
/// each component of n by 2 e / s, since the direction turns by no more where e is below 2^-40 s.
class ApproximateContact {
 public:
  /// Domain: in_short_range of all numbers of the question, to nearest.
  [[gnu::always_inline]] ApproximateContact(const ApproximateNearest& nearest, const Lengths& lengths)
      : nearest_(nearest), radii_(two_sum(lengths.radius1, lengths.radius2)) {
    const DoubleDouble<double> less = two_sum(radii_.high, lengths.contact);
    pair_ = DoubleDoublePair::of(nearest.delta, {less.high, radii_.low + less.low});
    if (!pair_) return;
    length_error_ = 2 * nearest.delta_error;
    turn_ = 2.25 * nearest.delta_error / pair_->root().high;
    if (!(nearest.delta_error * 0x1p40 <= pair_->root().high)) pair_.reset();
  }
  /// Whether the bounds hold. They do not where the cores meet, or are far nearer to each other than the errors allow.
  [[gnu::always_inline]] [[nodiscard]] bool holds() const { return pair_.has_value(); }

  // Domain of what follows: holds().

  /// sqrt(D) against alarm + r1 + r2.
  [[gnu::always_inline]] [[nodiscard]] Filtered filtered(double alarm) const {
    const DoubleDouble<double> reach = two_sum(radii_.high, alarm);
    const DoubleDouble<double> h = two_sum(pair_->root().high, -reach.high);
    const double low = h.low + (pair_->root().low - (radii_.low + reach.low));
    const double error = (kRootError * pair_->root().high + kLessError * reach.high) +
                         (DoubleDoublePair::kLastSumError * std::abs(h.high) + length_error_);
    if (h.high + (low - error) > 0) return Filtered::miss;
    if (h.high + (low + error) < 0) return Filtered::hit;
    return Filtered::undecided;
  }

  [[gnu::always_inline]] [[nodiscard]] Approximation normal(std::size_t axis) const {
    Approximation n = pair_->normal(axis);
    n.error += turn_;
    return n;
  }
  [[gnu::always_inline]] [[nodiscard]] Approximation point1(std::size_t axis, double signed_radius) const {
    return point(nearest_.p[axis], nearest_.p_error, axis, signed_radius);
  }
  [[gnu::always_inline]] [[nodiscard]] Approximation point2(std::size_t axis, double signed_radius) const {
    return point(nearest_.q[axis], nearest_.q_error, axis, signed_radius);
  }
  [[gnu::always_inline]] [[nodiscard]] Approximation value() const {
    Approximation v = pair_->value();
    v.error += length_error_;
    return v;
  }
  /// Cores with more than one pair of nearest points are left to the exact stage.
  [[nodiscard]] static constexpr bool is_unique() { return true; }

 private:
  static constexpr double kRootError = DoubleDoublePair::kValueRootError + 1 * kUnitSquared;  // of s
  static constexpr double kLessError = DoubleDoublePair::kValueLessError + 1 * kUnitSquared;  // of the reach

  [[gnu::always_inline]] [[nodiscard]] Approximation point(const DoubleDouble<double>& core, double error,
                                                           std::size_t axis, double signed_radius) const {
    return point_beside(core, error, pair_->normal_parts(axis), signed_radius, turn_);
  }

  const ApproximateNearest& nearest_;
  DoubleDouble<double> radii_;
  std::optional<DoubleDoublePair> pair_;
  double length_error_ = 0;  ///< of sqrt(D)
  double turn_ = 0;          ///< of a component of n
};

/// What the fast stage computes of two kinds of core.
template <class First, class Second>
struct FastStage {
  using Nearest = ApproximateNearest;
  using OfContact = ApproximateContact;
};

/// The numbers of a contact that are certain; returns the bits of those that are not.
template <class Approximate>
[[gnu::always_inline]] inline unsigned round_certain(const Approximate& approximate, const Lengths& lengths,
                                                     ContactPoints points, Contact& contact) {
  unsigned open = kAllNumbers;
  const auto take = [&open](const Approximation& number, double& to, unsigned bit) {
    if (const auto certain = number.rounded()) {
      to = *certain;
      open &= ~(1U << bit);
    }
  };
  const double r1 = sign_of(points.first, 1) * lengths.radius1;
  const double r2 = sign_of(points.second, -1) * lengths.radius2;
#pragma GCC unroll 3
  for (unsigned axis = 0; axis < 3; ++axis) {
    take(approximate.normal(axis), contact.normal[axis], axis);
    take(approximate.point1(axis, r1), contact.point1[axis], kPointNumber + axis);
    take(approximate.point2(axis, r2), contact.point2[axis], 2 * kPointNumber + axis);
  }
  take(approximate.value(), contact.value, kValueNumber);
  contact.degenerate = false;
  contact.unique = approximate.is_unique();
  return open;
}

}  // namespace contact::kernel
