// Exact numbers of Q(sqrt D) on CGAL, their correct rounding, and comparison of claimed numbers with them.
#include "oracle/truth/exact.hpp"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "oracle/truth/default_environment.hpp"
#include "oracle/truth/grid.hpp"
#include "oracle/truth/truth.hpp"

namespace contact::oracle {
namespace {

using CGAL::Gmpz;

double as_float_neighbour(double x, float toward) {
  return static_cast<double>(std::nextafter(static_cast<float>(x), toward));
}

double largest_finite(Scalar scalar) {
  return scalar == Scalar::binary32 ? static_cast<double>(std::numeric_limits<float>::max())
                                    : std::numeric_limits<double>::max();
}

/// The real number half way from a finite x to its upper neighbour, beyond the largest finite number as if the exponent
/// range went on: the boundary between rounding to x and rounding above it.
Rational boundary_above(double x, Scalar scalar) {
  const double above = next_up(x, scalar);
  if (std::isfinite(above)) return (Rational(x) + Rational(above)) / Rational(2);
  return Rational(x) + (Rational(x) - Rational(next_down(x, scalar))) / Rational(2);
}

/// Whether the significand of a number of the scalar is even.
bool is_even(double x, Scalar scalar) {
  int exponent = 0;
  std::frexp(x, &exponent);
  const Format format = format_of(scalar);
  const int last = std::max(exponent - format.precision, format.min_exponent - format.precision + 1);
  return std::fmod(std::ldexp(x, -last), 2.0) == 0;
}

/// 0 where x rounds to the finite number d of the scalar, to nearest, ties to even; 1 where it rounds to a number above
/// d, -1 below. Two exact comparisons.
int side_of(double d, const Exact& x, Scalar scalar) {
  const Rounding r = rounding_range(d, scalar);
  const auto above = x.compare(r.high);
  if (above == CGAL::LARGER || (above == CGAL::EQUAL && !r.is_closed)) return 1;
  const auto below = x.compare(r.low);
  if (below == CGAL::SMALLER || (below == CGAL::EQUAL && !r.is_closed)) return -1;
  return 0;
}

long bits_of(mpz_srcptr n) { return static_cast<long>(mpz_sizeinbase(n, 2)); }
long bits_of(const Gmpz& n) { return bits_of(n.mpz()); }
mpz_srcptr numerator_of(const Rational& x) { return mpq_numref(x.mpq()); }
mpz_srcptr denominator_of(const Rational& x) { return mpq_denref(x.mpq()); }

/// What whole numbers are computed in: kept, for to make them takes longer than what is computed.
struct Working {
  Integer n, d, of_a, root, rest, shifted;
};
Working& working() {
  thread_local Working numbers;
  return numbers;
}

/// low <= 2^exponent |x| <= high, above 0 and no farther apart than a 2^-60th.
struct Magnitude {
  Gmpz low;
  Gmpz high;
  long exponent;
};
/// Nothing where x is 0.
std::optional<Magnitude> magnitude_of(const Exact& x) {
  constexpr long kBits = 96;
  for (long bits = kBits;; bits *= 2) {  // more where a and b sqrt(D) cancel
    const auto [least, most, exponent] = x.in_whole_numbers(bits);
    const bool is_negative = CGAL::sign(least) == CGAL::NEGATIVE;
    const Gmpz low = is_negative ? -most : least;
    if (CGAL::sign(low) == CGAL::POSITIVE && bits_of(low) > 61)
      return Magnitude{low, is_negative ? -least : most, exponent};
    if (bits == kBits && x.sign() == CGAL::ZERO) return std::nullopt;
  }
}
/// A number not less than |x|, by less than a 2^-60th; |x| itself where that is rational.
Rational magnitude_above(const Exact& x) {
  if (const Rational* a = x.rational()) return CGAL::abs(*a);
  const auto found = magnitude_of(x);
  if (!found) return Rational(0);
  Rational above(found->high);
  const auto places = static_cast<mp_bitcnt_t>(std::abs(found->exponent));
  found->exponent < 0 ? mpq_mul_2exp(above.mpq(), above.mpq(), places) : mpq_div_2exp(above.mpq(), above.mpq(), places);
  return above;
}

/// How many of the last bits of n / 2^exponent, n of more bits than the scalar, a number of the scalar has no room for.
long bits_beyond(const Gmpz& n, long exponent, Scalar scalar) {
  const Format format = format_of(scalar);
  const long least = format.min_exponent - format.precision + 1;
  return std::max(bits_of(n) - format.precision, least + exponent);
}

/// n / 2^exponent, rounded to nearest, ties to even; infinite beyond the range. Domain: n of more bits than the scalar.
double rounded(const Gmpz& n, long exponent, Scalar scalar) {
  const mpz_ptr kept = working().root;
  const long away = bits_beyond(n, exponent, scalar);
  // Half of the last bit is added; where that was a tie, an odd number has gone up one too far.
  const auto below_half = static_cast<mp_bitcnt_t>(away - 1);
  mpz_fdiv_q_2exp(kept, n.mpz(), below_half);
  const bool is_tie = mpz_odd_p(kept) != 0 && mpz_divisible_2exp_p(n.mpz(), below_half) != 0;
  mpz_add_ui(kept, kept, 1);
  mpz_fdiv_q_2exp(kept, kept, 1);
  if (is_tie && mpz_odd_p(kept) != 0) mpz_sub_ui(kept, kept, 1);
  const double x = std::ldexp(mpz_get_d(kept), static_cast<int>(std::min(away - exponent, 2000L)));
  return std::abs(x) > largest_finite(scalar) ? std::copysign(std::numeric_limits<double>::infinity(), x) : x;
}

}  // namespace

Exact::Exact(const Rational& a, const Rational& b, const Rational& D)
    : number_(CGAL::is_zero(b) || CGAL::is_zero(D) ? Extension(a) : Extension(a, b, D)) {}

CGAL::Sign Exact::compare(const Rational& other) const { return Extension(number_ - Extension(other)).sign(); }

Exact Exact::scaled(const Rational& factor) const {
  return number_.is_extended() ? Exact(number_.a0() * factor, number_.a1() * factor, number_.root())
                               : Exact(number_.a0() * factor);
}

Exact Exact::plus(const Rational& other) const { return Exact(Extension(number_ + Extension(other))); }

Exact::Enclosure Exact::enclosure(int bits) const {
  if (!number_.is_extended()) return {number_.a0(), number_.a0()};
  // b sqrt(D) = sign(b) sqrt(b^2 D), and floor(sqrt(n / d) 2^k) = floor(sqrt(floor(n 4^k / d))).
  const Rational square = number_.a1() * number_.a1() * number_.root();
  const int k = bits + std::max(0, -floor_log2(square) / 2 + 1);
  Gmpz quotient;
  const Gmpz scaled = square.numerator() << (2L * k);
  mpz_fdiv_q(quotient.mpz(), scaled.mpz(), square.denominator().mpz());
  Gmpz root;
  mpz_sqrt(root.mpz(), quotient.mpz());
  const Rational low = Rational(root) * power_of_two(-k);
  const Rational high = Rational(root + 1) * power_of_two(-k);
  if (CGAL::sign(number_.a1()) == CGAL::POSITIVE) return {number_.a0() + low, number_.a0() + high};
  return {number_.a0() - high, number_.a0() - low};
}

Exact::Scaled Exact::in_whole_numbers(long bits) const {
  Working& w = working();
  const mpz_ptr rest = w.rest;
  const auto log2 = [](mpz_srcptr n, mpz_srcptr d) { return bits_of(n) - bits_of(d); };  // or one less
  const Rational& a = number_.a0();
  const bool has_a = !CGAL::is_zero(a);
  const long of_a = has_a ? log2(numerator_of(a), denominator_of(a)) : 0;
  bool is_whole = true;
  const auto floor_of = [&](mpz_ptr whole, mpz_srcptr n, mpz_srcptr d, long exponent) {
    const bool is_up = exponent > 0;
    mpz_mul_2exp(w.shifted, is_up ? n : d, static_cast<mp_bitcnt_t>(std::abs(exponent)));
    mpz_fdiv_qr(whole, rest, is_up ? w.shifted : n, is_up ? d : w.shifted);
    is_whole = is_whole && mpz_sgn(rest) == 0;
  };
  const auto between = [&](mpz_srcptr least, long exponent) {
    const Gmpz low(least);
    return Scaled{low, is_whole ? low : low + 2, exponent};
  };
  if (!number_.is_extended()) {
    const long exponent = bits - of_a;
    floor_of(w.of_a, numerator_of(a), denominator_of(a), exponent);
    return between(w.of_a, exponent);
  }
  // As in `enclosure`, where floor(-y) = -floor(y) - 1 or -y; the one more has room.
  const Rational& b = number_.a1();
  const Rational& D = number_.root();
  const auto times_square = [](mpz_ptr product, mpz_srcptr x, mpz_srcptr y) {
    mpz_mul(product, x, x);
    mpz_mul(product, product, y);
  };
  times_square(w.n, numerator_of(b), numerator_of(D));
  times_square(w.d, denominator_of(b), denominator_of(D));
  const long of_root = log2(w.n, w.d) / 2;
  const long exponent = bits - (has_a ? std::max(of_root, of_a) : of_root);
  floor_of(w.root, w.n, w.d, 2 * exponent);
  mpz_sqrtrem(w.root, rest, w.root);
  is_whole = is_whole && mpz_sgn(rest) == 0;
  floor_of(w.of_a, numerator_of(a), denominator_of(a), exponent);
  if (CGAL::sign(b) == CGAL::POSITIVE) {
    mpz_add(w.of_a, w.of_a, w.root);
  } else {
    mpz_sub(w.of_a, w.of_a, w.root);
    if (!is_whole) mpz_sub_ui(w.of_a, w.of_a, 1);
  }
  return between(w.of_a, exponent);
}

Exact magnitude(const Exact& x) { return x.sign() == CGAL::NEGATIVE ? x.scaled(Rational(-1)) : x; }

Exact larger_of(const Exact& x, const Exact& y) {
  return x.plus(y.scaled(Rational(-1))).sign() == CGAL::NEGATIVE ? y : x;
}

bool is_representable(double x, Scalar scalar) {
  return scalar == Scalar::binary64 ||
         (std::abs(x) <= largest_finite(scalar) && static_cast<double>(static_cast<float>(x)) == x);
}

Rounding rounding_range(double x, Scalar scalar) {
  return {-boundary_above(-x, scalar), boundary_above(x, scalar), is_even(x, scalar)};
}

double round_to_nearest(const Exact& x, Scalar scalar) {
  const DefaultEnvironment environment;
  // What is below x and what is above it round to the same, or tell where to begin to walk.
  constexpr long kBits = 128;
  constexpr long kSure = 64;
  Exact::Scaled scaled = x.in_whole_numbers(kBits);
  for (long bits = 2 * kBits; bits_of(scaled.least) < kSure; bits *= 2) {
    if (x.sign() == CGAL::ZERO) return 0.0;
    scaled = x.in_whole_numbers(bits);
  }
  const double low = rounded(scaled.least, scaled.exponent, scalar);
  const double high = rounded(scaled.most, scaled.exponent, scalar);
  if (low == high) return low == 0 ? 0.0 : low;
  const double limit = largest_finite(scalar);
  // Exact comparisons end the walk.
  for (double d = std::clamp(low, -limit, limit);;) {
    const int direction = side_of(d, x, scalar);
    if (direction == 0) return d == 0 ? 0.0 : d;
    d = direction > 0 ? next_up(d, scalar) : next_down(d, scalar);
    if (!std::isfinite(d)) return d;
  }
}

bool is_correctly_rounded(double claim, const Exact& x, Scalar scalar) {
  const DefaultEnvironment environment;
  if (std::isnan(claim)) return false;
  if (std::isinf(claim)) {
    const double last = std::copysign(largest_finite(scalar), claim);
    return side_of(last, x, scalar) == (claim > 0 ? 1 : -1);
  }
  return is_representable(claim, scalar) && side_of(claim, x, scalar) == 0;
}

bool is_faithful(double claim, const Exact& x, Scalar scalar) {
  const DefaultEnvironment environment;
  if (!std::isfinite(claim)) return false;
  if (!is_representable(claim, scalar)) return false;
  const auto side = x.compare(Rational(claim));
  if (side == CGAL::EQUAL) return true;
  const double other = side == CGAL::LARGER ? next_up(claim, scalar) : next_down(claim, scalar);
  // Past the largest finite number stands no neighbour that could tell near from far: an ulp must.
  if (!std::isfinite(other)) return is_within(Rational(claim), x, ulp(x, scalar));
  return x.compare(Rational(other)) == -side;
}

Rational ulp(const Exact& x, Scalar scalar) {
  const Format format = format_of(scalar);
  const int least = format.min_exponent - format.precision + 1;
  if (x.sign() == CGAL::ZERO) return power_of_two(least);
  return power_of_two(std::max(floor_log2(x) - format.precision + 1, least));
}

Boundary nearest_boundary(const Exact& x, Scalar scalar) {
  const DefaultEnvironment environment;
  const double rounded = round_to_nearest(x, scalar);
  const double limit = largest_finite(scalar);
  const double d = std::clamp(rounded, -limit, limit);
  const Rational above = boundary_above(d, scalar);
  const Rational below = -boundary_above(-d, scalar);
  return {x.compare((above + below) / Rational(2)) == CGAL::SMALLER ? below : above, ulp(Rational(d), scalar)};
}

bool may_be_near_boundary(const Exact& x, Scalar scalar, int exponent) {
  const Exact::Scaled scaled = x.in_whole_numbers(format_of(scalar).precision - exponent + 40L);
  const long beyond = bits_beyond(scaled.least, scaled.exponent, scalar);
  if (beyond < 2)
    return x.sign() != CGAL::ZERO;  // of what cancelled too little is known; 0 lies half an ulp from the next
  // Off the middle of what is cut off: two more for x itself, and twice the ulps where x rounds to a power of two.
  const auto digits = static_cast<mp_bitcnt_t>(beyond);
  const auto [off, half, near] = std::array<mpz_ptr, 3>{working().n, working().d, working().root};
  mpz_set_ui(half, 1);
  mpz_mul_2exp(half, half, digits - 1);
  mpz_fdiv_r_2exp(off, scaled.least.mpz(), digits);
  mpz_sub(off, off, half);
  mpz_set_ui(near, 1);
  mpz_mul_2exp(near, near, static_cast<mp_bitcnt_t>(std::max(0L, beyond + exponent + 1)));
  mpz_add_ui(near, near, 2);
  return mpz_cmpabs(off, near) <= 0;
}

Rational distance_in_ulps(const Exact& x, const Boundary& boundary) {
  return magnitude_above(x.plus(-boundary.at)) / boundary.ulp;
}

double error_in_units(const Rational& claim, const Exact& x, const Rational& unit) {
  const DefaultEnvironment environment;
  return CGAL::to_interval(magnitude_above(x.plus(-claim)) / unit).second;
}

bool is_within(const Rational& claim, const Exact& x, const Rational& bound) {
  return x.compare(claim - bound) != CGAL::SMALLER && x.compare(claim + bound) != CGAL::LARGER;
}

double next_up(double x, Scalar scalar) {
  const DefaultEnvironment environment;
  return scalar == Scalar::binary32 ? as_float_neighbour(x, std::numeric_limits<float>::infinity())
                                    : std::nextafter(x, std::numeric_limits<double>::infinity());
}

double next_down(double x, Scalar scalar) { return -next_up(-x, scalar); }

int floor_log2(const Rational& x) {
  const auto bits = [](const Gmpz& n) { return static_cast<int>(mpz_sizeinbase(n.mpz(), 2)); };
  const int guess = bits(x.numerator()) - bits(x.denominator());
  return power_of_two(guess) <= CGAL::abs(x) ? guess : guess - 1;
}

int floor_log2(const Exact& x) {
  const auto [low, high, exponent] = *magnitude_of(x);
  const auto power = static_cast<int>(bits_of(low) - 1 - exponent);
  if (bits_of(high) == bits_of(low)) return power;
  // One power of two lies between the two; the exact comparison decides.
  const Rational next = power_of_two(power + 1);
  const bool is_below = x.compare(next) == CGAL::SMALLER && x.compare(-next) == CGAL::LARGER;
  return is_below ? power : power + 1;
}

Rational power_of_two(int exponent) {
  const Gmpz power = Gmpz(1) << std::abs(exponent);
  return exponent >= 0 ? Rational(power) : Rational(Gmpz(1), power);
}

std::string exact_string(const Rational& x) {
  if (CGAL::is_zero(x)) return "0x0p0";
  const Gmpz numerator = CGAL::abs(x).numerator();
  const auto trailing = static_cast<int>(mpz_scan1(numerator.mpz(), 0));
  const auto below = static_cast<int>(mpz_scan1(x.denominator().mpz(), 0));
  const auto hexadecimal = [](const Gmpz& n) { return "0x" + mpz_class(n.mpz()).get_str(16); };
  const Gmpz over = x.denominator() >> below;
  return (CGAL::sign(x) == CGAL::NEGATIVE ? "-" : "") + hexadecimal(numerator >> trailing) + "p" +
         std::to_string(trailing - below) + (over == 1 ? "" : "/" + hexadecimal(over));
}

}  // namespace contact::oracle
