// Exact arithmetic for what the filters leave: integers on a common grid, and correct rounding in Q(sqrt D).
#pragma once

// The build undoes such options (cmake/ContactTargets.cmake). This is for another build, as far as a compiler tells.
#include "contact/plain_decision.hpp"

#if CONTACT_FAST_MATH
#error "contact-oracle promises exact decisions and correct rounding: build it without -ffast-math, or any part of it"
#endif
#if CONTACT_EXCESS_PRECISION
#error "contact-oracle promises the same bits everywhere: build it without excess precision (-msse2 -mfpmath=sse)"
#endif

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <initializer_list>
#include <span>

#include "kernel/fixed_integer.hpp"

namespace contact::kernel {

// Without expression templates: plain values, so that `auto` and `?:` mean what they say.
using Integer = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>, boost::multiprecision::et_off>;

/// The coarsest grid 2^exponent on which every number given to it is an integer.
class Grid {
 public:
  explicit Grid(std::span<const double> numbers);
  explicit Grid(std::initializer_list<double> numbers) : Grid(std::span(numbers.begin(), numbers.size())) {}
  /// The same where a product of numbers is on it too, of one grid each.
  Grid(std::initializer_list<double> numbers, const Grid& factor, const Grid& other) : Grid(numbers) {
    exponent_ = std::min(exponent_, factor.exponent_ + other.exponent_);
  }
  /// The same, and no coarser than 2^most.
  Grid(std::initializer_list<double> numbers, int most) : Grid(numbers) { exponent_ = std::min(exponent_, most); }

  [[nodiscard]] int exponent() const { return exponent_; }
  /// x / 2^exponent. Domain: x is one of the numbers given, or a sum of their integer multiples.
  [[nodiscard]] Integer operator()(double x) const;
  /// x y / 2^exponent. Domain: x y is on the grid.
  [[nodiscard]] Integer product(double x, double y) const;

  /// Numbers on a grid whose largest is below 2^kFixedLength in its units are answered by FixedInteger.
  static constexpr int kFixedLength = 1280;
  [[nodiscard]] bool is_fixed() const { return end_ - exponent_ <= kFixedLength; }
  /// The same number. Domain: is_fixed().
  [[nodiscard]] FixedInteger fixed(double x) const;

 private:
  int exponent_;
  int end_;  ///< every number is below 2^end_ in magnitude
};

/// floor(sqrt(n)), n >= 0.
[[nodiscard]] Integer floor_sqrt(const Integer& n);

/// The logarithm of |n|, within 2^-36; of 0 minus infinity.
[[nodiscard]] double approximate_log2(const Integer& n);

/// n 2^exponent rounded once to binary64, to nearest, ties to even; +0 for 0, infinite beyond the range.
[[nodiscard]] double round_integer(const Integer& n, int exponent);

/// (c + e / sqrt(D)) / over 2^exponent rounded once to binary64, to nearest, ties to even. Domain: D > 0, over > 0.
[[nodiscard]] double round_sum(const Integer& c, const Integer& e, const Integer& D, int exponent,
                               const Integer& over = 1);
/// The same over 1. Domain: an exponent near the range of double, and for L = Grid::kFixedLength
///             |c| < 2^(L+2), |e| < 2^(2L+4), D < 2^(2L+4).
[[nodiscard]] double round_sum(const FixedInteger& c, const FixedInteger& e, const FixedInteger& D, int exponent);

/// The same by division and an integer root. The others take products alone, and this where their estimate fails.
[[nodiscard]] double round_sum_by_division(const Integer& c, const Integer& e, const Integer& D, int exponent,
                                           const Integer& over = 1);

/// The same, |c + e / sqrt(D)| 2^exponent being about `estimate`. A wrong one costs steps, and after kMostSteps the
/// division answers. Domain: c + e / sqrt(D) has that sign, which is not 0.
[[nodiscard]] double round_sum_near(double estimate, int sign, const FixedInteger& c, const FixedInteger& e,
                                    const FixedInteger& D, int exponent);

/// (sqrt(D) - t) / over 2^exponent rounded once to binary64, to nearest, ties to even. Domain: D > 0, t >= 0, over > 0.
[[nodiscard]] double round_root_less(const Integer& D, const Integer& t, int exponent, const Integer& over = 1);
[[nodiscard]] inline double round_integer(const FixedInteger& n, int exponent) {
  return round_sum(n, {}, FixedInteger(1, 0, false), exponent);
}
[[nodiscard]] inline double round_root_less(const FixedInteger& D, const FixedInteger& t, int exponent) {
  return round_sum(-t, D, D, exponent);
}

}  // namespace contact::kernel
