// Exact numbers of Q(sqrt D) on CGAL, their correct rounding, and comparison of claimed numbers with them.
#pragma once

#include <CGAL/Gmpq.h>
#include <CGAL/Gmpz.h>
#include <CGAL/Sqrt_extension.h>

#include <string>
#include <string_view>

#include "oracle/truth/query.hpp"

namespace contact::oracle {

/// Named outright: CGAL::Exact_rational may be Boost's, and the oracle shares nothing with src/.
using Rational = CGAL::Gmpq;
using Whole = CGAL::Gmpz;

/// A real number a + b sqrt(D), exactly.
class Exact {
 public:
  Exact(const Rational& a) : number_(a) {}  // NOLINT(google-explicit-constructor): a rational is such a number
  /// a + b sqrt(D), D >= 0. A zero b or D is taken out here: CGAL's sign of 0 + 1 * sqrt(0) is +1.
  Exact(const Rational& a, const Rational& b, const Rational& D);

  [[nodiscard]] CGAL::Sign sign() const { return number_.sign(); }
  /// The number where no root is part of it, else nullptr.
  [[nodiscard]] const Rational* rational() const { return number_.is_extended() ? nullptr : &number_.a0(); }
  [[nodiscard]] CGAL::Sign compare(const Rational& other) const;
  [[nodiscard]] Exact scaled(const Rational& factor) const;
  [[nodiscard]] Exact plus(const Rational& other) const;
  /// Domain: both of one D, or one of them rational.
  [[nodiscard]] Exact plus(const Exact& other) const { return Exact(Extension(number_ + other.number_)); }

  /// An upper bound and a lower bound, closer than 2^-bits of the larger of |a| and |b sqrt(D)|.
  struct Enclosure {
    Rational low;
    Rational high;
  };
  [[nodiscard]] Enclosure enclosure(int bits) const;
  /// Whole numbers with least <= 2^exponent x <= most, which differ by 2, or are one where 2^exponent x is seen to be that: `least` has more than
  /// `bits` bits where a and b sqrt(D) do not cancel.
  struct Scaled {
    Whole least;
    Whole most;
    long exponent;
  };
  [[nodiscard]] Scaled in_whole_numbers(long bits) const;

 private:
  using Extension = CGAL::Sqrt_extension<Rational, Rational>;
  explicit Exact(Extension number) : number_(std::move(number)) {}

  Extension number_;
};

/// |x|
[[nodiscard]] Exact magnitude(const Exact& x);

/// Domain: both of one D, or one of them rational.
[[nodiscard]] Exact larger_of(const Exact& x, const Exact& y);

/// x rounded once to the scalar, to nearest, ties to even; +0 for zero, infinite beyond the range.
[[nodiscard]] double round_to_nearest(const Exact& x, Scalar scalar);

/// Whether `claim` is x rounded once to the scalar, to nearest, ties to even. The sign of a zero does not count.
[[nodiscard]] bool is_correctly_rounded(double claim, const Exact& x, Scalar scalar);

/// Whether `claim` is one of the two numbers of the scalar next to x (x itself where it is one of them); beyond the
/// largest finite number that one is next to x only within an ulp.
[[nodiscard]] bool is_faithful(double claim, const Exact& x, Scalar scalar);

/// What rounds to a number of the scalar, to nearest, ties to even: the reals between two, which do so themselves or
/// not.
struct Rounding {
  Rational low;
  Rational high;
  bool is_closed;
};
/// Domain: x is finite and a number of the scalar.
[[nodiscard]] Rounding rounding_range(double x, Scalar scalar);
/// Whether a finite double is a number of the scalar.
[[nodiscard]] bool is_representable(double x, Scalar scalar);

/// ulp of a real number: 2^max(floor(log2 |x|) - p + 1, emin - p + 1), the exponent unbounded above.
[[nodiscard]] Rational ulp(const Exact& x, Scalar scalar);

/// A boundary of rounding to nearest: half way between two neighbours of the scalar, or where infinity begins.
struct Boundary {
  Rational at;
  Rational ulp;  ///< of the number that x rounds to; of the largest finite one for infinity
};
/// The boundary nearest to x; half a subnormal number for 0.
[[nodiscard]] Boundary nearest_boundary(const Exact& x, Scalar scalar);
/// Whether x may lie within 2^exponent of those ulps of a boundary, exponent < -2: where not, its first digits tell, and nothing is compared.
[[nodiscard]] bool may_be_near_boundary(const Exact& x, Scalar scalar, int exponent);
/// How far x lies from there in those ulps: 0 only on it, else rounded up by less than a 2^-60th.
[[nodiscard]] Rational distance_in_ulps(const Exact& x, const Boundary& boundary);

/// |claim - x| / unit rounded up to a double, never less than the real quotient. Domain: claim finite, unit > 0.
[[nodiscard]] double error_in_units(const Rational& claim, const Exact& x, const Rational& unit);

/// Whether |claim - x| <= bound, exactly.
[[nodiscard]] bool is_within(const Rational& claim, const Exact& x, const Rational& bound);

/// The next number of the scalar above or below; infinite past the largest finite one.
[[nodiscard]] double next_up(double x, Scalar scalar);
[[nodiscard]] double next_down(double x, Scalar scalar);

/// floor(log2 |x|) for x other than 0.
[[nodiscard]] int floor_log2(const Rational& x);
[[nodiscard]] int floor_log2(const Exact& x);

/// 2^exponent.
[[nodiscard]] Rational power_of_two(int exponent);

/// A rational as -0x1abdp-12: sign, odd hexadecimal integer, power of two; 0x0p0 for zero. One that is no dyadic has
/// its odd denominator after it, in lowest terms: 0x1p0/0x3.
[[nodiscard]] std::string exact_string(const Rational& x);

}  // namespace contact::oracle
