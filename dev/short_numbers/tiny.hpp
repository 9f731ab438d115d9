// Binary floating-point numbers with a short significand: the kernels' arithmetic where all of it can be tried.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace contact::kernel::tiny {

enum class Rounding { to_nearest, up, down, to_zero };

/// A double whose significand has `kBits` bits, and the exponents of double. Each operation rounds the exact result
/// once, to nearest with ties to even or as kRounding says.
/// Domain      2 <= kBits <= 25; results are 0 or at least 2^-900 in magnitude, or what they lose is not looked at.
/// Source      2 kBits + 2 <= 53: rounding + - * / sqrt to 53 bits first changes nothing (Figueroa, 1995). Elsewhere
///             the exact result, high + low, is first rounded to odd (Boldo and Melquiond, 2008).
/// Evidence    tiny_test.cpp, all operations on all operands of 3 and 4 bits against rationals.
template <int kBits, Rounding kRounding = Rounding::to_nearest>
class Tiny {
 public:
  static_assert(2 <= kBits && kBits <= 25);

  constexpr Tiny() = default;
  /// A number that needs no rounding. An integer or a double, so that formulas may have constants.
  constexpr Tiny(double x) : value_(x) {}  // NOLINT(google-explicit-constructor)

  explicit constexpr operator double() const { return value_; }

  [[nodiscard]] static constexpr bool holds(double x) { return (std::bit_cast<std::uint64_t>(x) & kBelow) == 0; }

  /// high + low rounded, where |low| is at most half a unit in the last place of the double `high`.
  [[nodiscard]] static Tiny rounded(double high, double low = 0) {
    auto bits = std::bit_cast<std::uint64_t>(high);
    if (!std::isfinite(high)) return Tiny(high);
    if (low != 0 && (bits & 1) == 0) bits += (low < 0) == (high < 0) ? 1U : ~std::uint64_t{0};
    const std::uint64_t last = bits >> kShift & 1;
    bool away = false;
    switch (kRounding) {
      case Rounding::to_nearest:
        bits += kBelow / 2 + last;
        break;
      case Rounding::up:
        away = !std::signbit(high);
        break;
      case Rounding::down:
        away = std::signbit(high);
        break;
      case Rounding::to_zero:
        break;
    }
    if (away) bits += kBelow;
    return Tiny(std::bit_cast<double>(bits & ~kBelow));
  }

  friend Tiny operator+(Tiny a, Tiny b) { return sum(a.value_, b.value_); }
  friend Tiny operator-(Tiny a, Tiny b) { return sum(a.value_, -b.value_); }
  friend Tiny operator*(Tiny a, Tiny b) { return rounded(a.value_ * b.value_); }
  friend Tiny operator/(Tiny a, Tiny b) requires(kRounding == Rounding::to_nearest) {
    return rounded(a.value_ / b.value_);
  }
  friend Tiny sqrt(Tiny a) requires(kRounding == Rounding::to_nearest) { return rounded(std::sqrt(a.value_)); }
  friend Tiny fma(Tiny a, Tiny b, Tiny c) { return sum(a.value_ * b.value_, c.value_); }

  friend constexpr Tiny operator-(Tiny a) { return Tiny(-a.value_); }
  friend Tiny abs(Tiny a) { return Tiny(std::abs(a.value_)); }
  Tiny& operator+=(Tiny b) { return *this = *this + b; }

  friend constexpr bool operator==(Tiny a, Tiny b) { return a.value_ == b.value_; }
  friend constexpr auto operator<=>(Tiny a, Tiny b) { return a.value_ <=> b.value_; }

 private:
  static constexpr int kShift = std::numeric_limits<double>::digits - kBits;
  static constexpr std::uint64_t kBelow = (std::uint64_t{1} << kShift) - 1;

  /// a + b rounded, for doubles.
  static Tiny sum(double a, double b) {
    const double high = a + b;
    const double b_part = high - a;
    return rounded(high, (a - (high - b_part)) + (b - b_part));
  }

  double value_ = 0;
};

}  // namespace contact::kernel::tiny

template <int kBits, contact::kernel::tiny::Rounding kRounding>
class std::numeric_limits<contact::kernel::tiny::Tiny<kBits, kRounding>> {
 public:
  static constexpr bool is_specialized = true;
  static constexpr int digits = kBits;
  static constexpr contact::kernel::tiny::Tiny<kBits, kRounding> epsilon() {
    return std::bit_cast<double>(std::uint64_t{1024 - kBits} << 52);
  }
};
