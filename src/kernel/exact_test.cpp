// Exact arithmetic of the kernel: every expectation is worked out by hand or verified by comparing squares of
// rationals.
#include "kernel/exact.hpp"
#include "extreme_numbers.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace contact::kernel::exact_test {
namespace {

using Rational = boost::multiprecision::cpp_rational;

Integer power(int exponent) { return Integer(1) << static_cast<unsigned>(exponent); }

Rational rational(double x) {
  int exponent = 0;
  const auto significand = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
  const int shift = exponent - 53;
  const boost::multiprecision::cpp_int scale = boost::multiprecision::cpp_int(1) << std::abs(shift);
  return shift >= 0 ? Rational(significand) * Rational(scale) : Rational(significand) / Rational(scale);
}

Rational rational(const Integer& n, int exponent) {
  const boost::multiprecision::cpp_int scale = boost::multiprecision::cpp_int(1) << std::abs(exponent);
  const Rational value = Rational(boost::multiprecision::cpp_int(n));
  return exponent >= 0 ? Rational(value * Rational(scale)) : Rational(value / Rational(scale));
}

/// The sign of u + w sqrt(D), D > 0: where the signs differ, the larger square wins.
int sign_of(const Rational& u, const Rational& w, const Rational& D) {
  if (w.sign() == 0) return u.sign();
  if (u.sign() * w.sign() >= 0) return w.sign();
  return Rational(u * u) > Rational(w * w * D) ? u.sign() : (Rational(u * u) < Rational(w * w * D) ? w.sign() : 0);
}

/// Whether the finite number y is u + w sqrt(D) rounded to nearest, ties to even, by its two rounding boundaries.
bool is_nearest(double y, const Rational& u, const Rational& w, const Rational& D) {
  const bool even = (std::bit_cast<std::uint64_t>(y) & 1) == 0;
  const Rational above = (rational(y) + rational(std::nextafter(y, kInfinity))) / 2;
  const Rational below = (rational(y) + rational(std::nextafter(y, -kInfinity))) / 2;
  const int from_above = sign_of(Rational(u - above), w, D);
  const int from_below = sign_of(Rational(u - below), w, D);
  return (from_above < 0 || (from_above == 0 && even)) && (from_below > 0 || (from_below == 0 && even));
}

/// Equal, and a zero is +0.
void expect_same(double actual, double expected) {
  EXPECT_EQ(std::bit_cast<std::uint64_t>(actual), std::bit_cast<std::uint64_t>(expected))
      << actual << " instead of " << expected;
}

Integer random_integer(std::mt19937_64& random, unsigned bits) {
  Integer n = 0;
  for (unsigned have = 0; have < bits; have += 64) {
    n <<= 64;
    n += random();
  }
  n >>= (64 - bits % 64) % 64;
  return n;
}

TEST(FloorSqrt, is_the_largest_integer_whose_square_does_not_exceed_n) {
  for (int n = 0; n <= 20000; ++n) {
    const Integer root = floor_sqrt(n);
    ASSERT_LE(root * root, n);
    ASSERT_GT((root + 1) * (root + 1), n);
  }
}

TEST(FloorSqrt, stands_one_off_a_perfect_square_of_any_size) {
  std::mt19937_64 random(1);
  const auto check = [](const Integer& k) {
    // (k-1)^2 <= k^2-1 and k^2+1 < (k+1)^2 for every k >= 1
    ASSERT_EQ(floor_sqrt(k * k - 1), k - 1) << k;
    ASSERT_EQ(floor_sqrt(k * k), k) << k;
    ASSERT_EQ(floor_sqrt(k * k + 1), k) << k;
    ASSERT_EQ(floor_sqrt(k * k + 2 * k), k) << k;
  };
  for (int bits = 1; bits <= 4200; bits += bits < 300 ? 1 : 37) {
    check(power(bits));
    check(power(bits) - 1);
    check(power(bits) + 1);
    check(random_integer(random, static_cast<unsigned>(bits)) + 1);
  }
}

TEST(Grid, is_the_coarsest_on_which_every_number_is_an_integer) {
  const Grid quarters{0.75, 5.0, -2.0};  // 3/4 needs quarters
  EXPECT_EQ(quarters.exponent(), -2);
  EXPECT_EQ(quarters(0.75), 3);
  EXPECT_EQ(quarters(5.0), 20);
  EXPECT_EQ(quarters(-2.0), -8);
  EXPECT_EQ(quarters(0.0), 0);
  EXPECT_EQ(quarters(-0.0), 0);
  const Grid pairs{6.0, -20.0};  // 6 = 3 * 2, 20 = 10 * 2
  EXPECT_EQ(pairs.exponent(), 1);
  EXPECT_EQ(pairs(-20.0), -10);
  const Grid whole{kLeast, kLargest};
  EXPECT_EQ(whole.exponent(), -1074);
  EXPECT_EQ(whole(kLeast), 1);
  EXPECT_EQ(whole(-kLargest), -((power(53) - 1) << 2045));  // (2^53 - 1) 2^971 over 2^-1074
}

TEST(Grid, is_fixed_while_its_numbers_fit_in_that_many_bits) {
  static_assert(Grid::kFixedLength == 1280);
  EXPECT_TRUE((Grid{0x1p-256, 0x1p1023}.is_fixed()));
  EXPECT_FALSE((Grid{0x1p-257, 0x1p1023}.is_fixed()));
  EXPECT_TRUE((Grid{0x1p1023, 0, 0x1p-256}.is_fixed()));
  EXPECT_FALSE((Grid{kLeast, 1e300}.is_fixed()));
  EXPECT_TRUE((Grid{0, 0}.is_fixed()));
}

TEST(FixedInteger, has_the_leading_part_of_its_magnitude) {
  for (const int shift : {0, 1, 52, 63, 64, 65, 127, 128, 1000})
    for (const bool negative : {false, true}) {
      const FixedInteger n(3, shift, negative);  // 3/4 of 2^(shift + 2)
      int exponent = 0;
      EXPECT_EQ(leading(n.limbs(), exponent), 0.75);
      EXPECT_EQ(exponent, shift + 2);
    }
}

TEST(Grid, of_zeros_alone_has_exponent_0) {
  const Grid zeros{0.0, -0.0};
  EXPECT_EQ(zeros.exponent(), 0);
  EXPECT_EQ(zeros(-0.0), 0);
}

/// The same integer on the stack.
FixedInteger fixed(const Integer& n) {
  FixedInteger sum;
  const Integer magnitude = abs(n);
  const int length = n.is_zero() ? 0 : static_cast<int>(msb(magnitude)) + 1;
  for (int bit = 0; bit < length; bit += 32)
    sum +=
        FixedInteger(static_cast<std::uint32_t>((magnitude >> static_cast<unsigned>(bit)) & 0xffffffffU), bit, false);
  return n.sign() < 0 ? -sum : sum;
}

/// Whether round_sum of integers on the stack takes them.
bool fits(const Integer& c, const Integer& e, const Integer& D, int exponent) {
  const auto below = [](const Integer& n, int bits) { return abs(n) < power(bits); };
  return below(c, Grid::kFixedLength + 2) && below(e, 2 * Grid::kFixedLength + 4) &&
         below(D, 2 * Grid::kFixedLength + 4) && exponent >= -1076 && exponent <= 1024;
}

// The answers of both integers, which are the same.

double rounded_integer(const Integer& n, int exponent) {
  const double y = round_integer(n, exponent);
  if (fits(n, 0, 1, exponent)) expect_same(round_integer(fixed(n), exponent), y);
  return y;
}

double rounded_sum(const Integer& c, const Integer& e, const Integer& D, int exponent) {
  const double y = round_sum(c, e, D, exponent);
  expect_same(round_sum_by_division(c, e, D, exponent), y);
  if (fits(c, e, D, exponent)) expect_same(round_sum(fixed(c), fixed(e), fixed(D), exponent), y);
  return y;
}

double rounded_root_less(const Integer& D, const Integer& t, int exponent) {
  const double y = round_root_less(D, t, exponent);
  expect_same(round_sum_by_division(-t, D, D, exponent), y);
  if (fits(t, 0, D, exponent)) expect_same(round_root_less(fixed(D), fixed(t), exponent), y);
  return y;
}

TEST(RoundInteger, gives_back_every_number_that_a_grid_took) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 20000; ++i) {
    std::uint64_t bits = random();
    if (i % 4 == 0) bits &= 0x800fffffffffffffU;  // subnormal
    const auto x = std::bit_cast<double>(bits);
    if (!std::isfinite(x) || x == 0) continue;
    const Grid grid{x};
    expect_same(rounded_integer(grid(x), grid.exponent()), x);
    expect_same(round_integer(grid.fixed(x), grid.exponent()), x);
    const Grid finer{x, kLeast};
    expect_same(rounded_integer(finer(x), finer.exponent()), x);
  }
}

TEST(RoundInteger, breaks_ties_to_even) {
  for (const int sign : {1, -1}) {
    expect_same(rounded_integer(sign * (power(53) + 1), 0), sign * 0x1p53);        // 2^53 and 2^53 + 2: half way
    expect_same(rounded_integer(sign * (power(53) + 2), 0), sign * (0x1p53 + 2));  // representable
    expect_same(rounded_integer(sign * (power(53) + 3), 0), sign * (0x1p53 + 4));  // half way to the even one
    expect_same(rounded_integer(sign * ((power(53) + 1) * 8 + 1), -3), sign * (0x1p53 + 2));  // an eighth above the tie
    expect_same(rounded_integer(sign * ((power(53) + 3) * 8 - 1), -3), sign * (0x1p53 + 2));  // an eighth below it
  }
}

TEST(RoundInteger, carries_into_the_next_binade) {
  expect_same(rounded_integer(power(54) - 1, 0), 0x1p54);         // half way between 2^54 - 2 and 2^54
  expect_same(rounded_integer(power(200) - 1, -100), 0x1p100);    // just below 2^100
  expect_same(rounded_integer(-(power(200) - 1), -200), -1.0);    // just above -1
  expect_same(rounded_integer(power(53) - 1, -1075), 0x1p-1022);  // from the subnormals: 2^52 - 1/2 smallest ones
  expect_same(rounded_integer(power(54) - 1, -1076), 0x1p-1022);  // a quarter below 2^52 smallest ones
  expect_same(rounded_integer(power(54) - 3, -1076), 0x1p-1022 - kLeast);  // three quarters below
}

TEST(RoundInteger, rounds_once_below_the_normal_range) {
  expect_same(rounded_integer(1, -1074), kLeast);
  expect_same(rounded_integer(1, -1075), 0.0);                  // half the smallest subnormal: ties to 0, which is even
  expect_same(rounded_integer(3, -1076), kLeast);               // three quarters
  expect_same(rounded_integer(3, -1075), 2 * kLeast);           // 1.5: ties to 2
  expect_same(rounded_integer(5, -1075), 2 * kLeast);           // 2.5: ties to 2
  expect_same(rounded_integer(-7, -1075), -4 * kLeast);         // -3.5: ties to -4
  expect_same(rounded_integer(power(100) + 1, -1175), kLeast);  // a hair more than half
  expect_same(rounded_integer(1, -100000), 0.0);
}

TEST(RoundInteger, gives_plus_zero_for_every_zero) {
  expect_same(rounded_integer(0, 0), 0.0);
  expect_same(rounded_integer(0, 5000), 0.0);
  expect_same(rounded_integer(-1, -1075), 0.0);  // underflow from below
  expect_same(rounded_integer(-1, -9000), 0.0);
}

TEST(RoundInteger, overflows_from_half_an_ulp_beyond_the_largest_finite_number) {
  expect_same(rounded_integer(power(53) - 1, 971), kLargest);
  // 2^1024 - 2^970 is half way between the largest finite number and 2^1024, which would be even
  expect_same(rounded_integer(power(54) - 1, 970), kInfinity);
  expect_same(rounded_integer((power(54) - 1) * 1024 - 1, 960), kLargest);
  expect_same(rounded_integer(-(power(54) - 1), 970), -kInfinity);
  expect_same(rounded_integer(-((power(54) - 1) * 1024 - 1), 960), -kLargest);
  expect_same(rounded_integer(1, 1023), 0x1p1023);
  expect_same(rounded_integer(1, 1024), kInfinity);
  expect_same(rounded_integer(-1, 100000), -kInfinity);
}

TEST(RoundSum, of_a_perfect_square_is_the_rational_number) {
  expect_same(rounded_sum(0, 3, 25, 0), 0.6);     // 3 / 5
  expect_same(rounded_sum(0, -4, 25, 0), -0.8);   // -4 / 5
  expect_same(rounded_sum(1, -3, 25, 0), 0.4);    // 1 - 3 / 5
  expect_same(rounded_sum(-1, 4, 25, -1), -0.1);  // (-1 + 4 / 5) / 2
  expect_same(rounded_sum(7, 0, 25, 3), 56.0);    // 7 * 8
  expect_same(rounded_sum(0, 0, 2, 0), 0.0);
}

TEST(RoundSum, of_an_irrational_root_is_the_nearest_number) {
  // decimal expansions of 1/sqrt(2), 1/sqrt(3), 1 + 1/sqrt(2), 1 - 1/sqrt(2), 3/sqrt(2) - 2
  expect_same(rounded_sum(0, 1, 2, 0), 0.707106781186547524400844362104849039);
  expect_same(rounded_sum(0, 1, 3, 0), 0.577350269189625764509148780501957456);
  expect_same(rounded_sum(1, 1, 2, 0), 1.707106781186547524400844362104849039);
  expect_same(rounded_sum(1, -1, 2, 0), 0.292893218813452475599155637895150961);
  expect_same(rounded_sum(-2, 3, 2, 0), 0.121320343559642573202533086314547118);
}

TEST(RoundSum, of_the_least_numbers_that_a_length_allows_sees_the_rounding_bit) {
  for (const int sign : {1, -1}) {
    expect_same(rounded_sum(sign, 3 * sign, power(108), 0), sign * (1 + 0x1p-52));   // 1 + 3/4 of the last place
    expect_same(rounded_sum(sign, -3 * sign, power(110), 0), sign * (1 - 0x1p-53));  // as much below 1
    expect_same(rounded_sum(sign, 1 * sign, power(108), 0), sign * 1.0);             // 1 + 1/4
    expect_same(rounded_sum(0, sign * (power(53) + 3), power(106), 0), sign * (1 + 0x1p-51));  // a tie to even
  }
}

TEST(RoundSum, over_a_denominator_is_the_quotient_rounded_once) {
  expect_same(round_sum(1, 0, 1, 0, 3), 1.0 / 3);
  expect_same(round_sum(-2, 0, 1, 5, 3), -64.0 / 3);
  expect_same(round_sum(1, 1, 4, 0, 5), 0.3);                       // (1 + 1 / 2) / 5
  expect_same(round_sum(-1, 2, 4, 0, 7), 0.0);                      // -1 + 2 / 2
  expect_same(round_sum(1, 3, 9, 0, 2), 1.0);                       // (1 + 3 / 3) / 2
  expect_same(round_sum(3 * (power(53) + 1), 0, 1, 0, 3), 0x1p53);  // a tie to even, seen through the quotient
  expect_same(round_sum(3 * (power(53) + 1) + 1, 0, 1, 0, 3), 0x1p53 + 2);
  expect_same(round_sum(3 * (power(53) + 3) - 1, 0, 1, 0, 3), 0x1p53 + 2);
  expect_same(round_sum(-3 * (power(53) + 3) + 1, 0, 1, 0, 3), -(0x1p53 + 2));
  expect_same(round_root_less(2, 1, 0, 3), 0.138071187457698349600562906350288);  // (sqrt(2) - 1) / 3
  expect_same(round_root_less(2, 2, 0, 3), -0.195262145875634983733114609950);    // (sqrt(2) - 2) / 3
  expect_same(round_root_less(49, 7, 0, 3), 0.0);
}

TEST(RoundSum, over_a_random_denominator_is_nearest) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 4000; ++i) {
    const auto any = [&](unsigned bits) { return random_integer(random, 1 + static_cast<unsigned>(random() % bits)); };
    const Integer D = any(300) + 1;
    const Integer over = any(200) + 1;
    Integer c = any(250);
    Integer e = any(350);
    if (i % 2 == 0) c = -c;
    if (i % 3 == 0) e = -e;
    if (i % 5 == 0) c = -(e * floor_sqrt(D)) / D;  // cancels nearly
    const Rational q = rational(over, 0);
    expect_same(round_sum_by_division(c, e, D, -100, over), round_sum(c, e, D, -100, over));
    EXPECT_TRUE(is_nearest(round_sum(c, e, D, -100, over), Rational(rational(c, -100) / q),
                           Rational(rational(e, -100) / (rational(D, 0) * q)), rational(D, 0)))
        << c << " " << e << " " << D << " " << over;
    const Integer t = i % 5 == 1 ? floor_sqrt(D) : Integer(abs(c));
    EXPECT_TRUE(is_nearest(round_root_less(D, t, -100, over), Rational(-rational(t, -100) / q),
                           Rational(rational(1, -100) / q), rational(D, 0)))
        << D << " " << t << " " << over;
  }
}

TEST(RoundSum, that_cancels_exactly_is_plus_zero) {
  expect_same(rounded_sum(-2, 10, 25, 0), 0.0);
  expect_same(rounded_sum(2, -10, 25, 0), 0.0);
  expect_same(rounded_sum(power(900), -3 * power(1000), 9 * power(200), -2000), 0.0);
}

TEST(RoundSum, breaks_ties_to_even_and_sees_the_least_remainder) {
  const Integer K = power(200);
  for (const int sign : {1, -1}) {
    const Integer c = sign * power(53);
    const Integer e = sign * K;
    expect_same(rounded_sum(c, e, K * K, 0), sign * 0x1p53);                       // 2^53 + 1 exactly
    expect_same(rounded_sum(c, e, K * K - 1, 0), sign * (0x1p53 + 2));             // 2^53 + 1 and about 2^-401 more
    expect_same(rounded_sum(c, e, K * K + 1, 0), sign * 0x1p53);                   // as much less
    expect_same(rounded_sum(c + sign * 2, e, K * K, 0), sign * (0x1p53 + 4));      // 2^53 + 3 exactly
    expect_same(rounded_sum(c + sign * 2, e, K * K + 1, 0), sign * (0x1p53 + 2));  // as much less
    expect_same(rounded_sum(c + sign * 2, -e, K * K, 0), sign * 0x1p53);           // 2^53 + 2 - 1, the signs differing
    expect_same(rounded_sum(c + sign * 2, -e, K * K + 1, 0), sign * (0x1p53 + 2));
    expect_same(rounded_sum(c + sign * 2, -e, K * K - 1, 0), sign * 0x1p53);
  }
}

TEST(RoundSum, rounds_once_at_both_ends_of_the_range) {
  expect_same(rounded_sum(0, 5, 25, -1075), 0.0);     // half the smallest subnormal
  expect_same(rounded_sum(0, -5, 25, -1075), 0.0);    // and no -0
  expect_same(rounded_sum(0, 5, 24, -1075), kLeast);  // 5 / sqrt(24) > 1
  expect_same(rounded_sum(0, 5, 26, -1075), 0.0);     // 5 / sqrt(26) < 1
  expect_same(rounded_sum(0, 15, 25, -1075), 2 * kLeast);
  expect_same(rounded_sum(power(54) - 2, 5, 25, 970), kInfinity);  // 2^1024 - 2^970: the tie goes to infinity
  expect_same(rounded_sum(power(54) - 2, 5, 26, 970), kLargest);   // less than it
  expect_same(rounded_sum(-(power(54) - 2), -5, 25, 970), -kInfinity);
  expect_same(rounded_sum(-(power(54) - 2), -5, 26, 970), -kLargest);
}

TEST(RoundSum, lies_between_its_rounding_boundaries_for_random_and_nearly_cancelling_sums) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 3000; ++i) {
    const auto bits = static_cast<unsigned>(1 + random() % 200);
    const Integer D = random_integer(random, bits) + 1;
    Integer e = random_integer(random, static_cast<unsigned>(random() % 200));
    Integer c = random_integer(random, static_cast<unsigned>(random() % 120));
    // One in two cancels: c the integer nearest -e / sqrt(D), and e / sqrt(D) large.
    if (i % 2 == 0) {
      e = (e + 1) * D;
      c = -floor_sqrt(e * e / D) - static_cast<int>(random() % 2);
    }
    if (random() % 2 == 0) {
      e = -e;
      c = -c;
    }
    if (random() % 4 == 0) c = -c;
    const int exponent = static_cast<int>(random() % 1200) - 1150;
    const double y = rounded_sum(c, e, D, exponent);
    ASSERT_TRUE(std::isfinite(y));  // no exponent is that large
    const Rational d{boost::multiprecision::cpp_int(D)};
    ASSERT_TRUE(is_nearest(y, rational(c, exponent), Rational(rational(e, exponent) / d), d))
        << c << " + " << e << " / sqrt(" << D << ") 2^" << exponent << " -> " << y;
  }
}

TEST(RoundSum, of_a_solution_of_pells_equation_keeps_its_last_digits) {
  // q^2 - 2 p^2 = 1: q / sqrt(2) - p = 1 / (sqrt(2) (q + sqrt(2) p)), which cancels all digits of q and p.
  Integer q = 3;
  Integer p = 2;
  for (int i = 0; i < 200; ++i) {
    const Integer next = 3 * q + 4 * p;
    p = 2 * q + 3 * p;
    q = next;
    ASSERT_EQ(q * q - 2 * p * p, 1);
    const double y = rounded_sum(-p, q, 2, 0);
    ASSERT_TRUE(is_nearest(y, rational(-p, 0), Rational(rational(q, 0) / 2), 2)) << i;
  }
}

TEST(RoundRootLess, of_a_perfect_square_is_the_integer) {
  expect_same(rounded_root_less(25, 3, 0), 2.0);
  expect_same(rounded_root_less(25, 7, -2), -0.5);
  expect_same(rounded_root_less(25, 0, 1), 10.0);
  expect_same(rounded_root_less(25, 5, 0), 0.0);  // exactly zero is +0
  expect_same(rounded_root_less(power(2000), power(1000), -3000), 0.0);
}

TEST(RoundRootLess, of_an_irrational_root_is_the_nearest_number) {
  // decimal expansions of sqrt(2), sqrt(2) - 1, sqrt(3) - 2
  expect_same(rounded_root_less(2, 0, 0), 1.414213562373095048801688724209698079);
  expect_same(rounded_root_less(2, 1, 0), 0.414213562373095048801688724209698079);
  expect_same(rounded_root_less(3, 2, 0), -0.267949192431122706472553658494127633);
}

TEST(RoundRootLess, breaks_ties_to_even_and_sees_the_least_remainder) {
  const Integer odd = power(53) + 1;  // half way between 2^53 and 2^53 + 2
  expect_same(rounded_root_less(odd * odd, 0, 0), 0x1p53);
  expect_same(rounded_root_less(odd * odd + 1, 0, 0), 0x1p53 + 2);
  expect_same(rounded_root_less(odd * odd - 1, 0, 0), 0x1p53);
  expect_same(rounded_root_less((odd + 2) * (odd + 2), 0, 0), 0x1p53 + 4);
  expect_same(rounded_root_less((odd + 2) * (odd + 2) - 1, 0, 0), 0x1p53 + 2);
  expect_same(rounded_root_less(1, power(53) + 2, 0), -0x1p53);        // -(2^53 + 1)
  expect_same(rounded_root_less(2, power(53) + 2, 0), -0x1p53);        // nearer to zero than the tie
  expect_same(rounded_root_less(3, power(53) + 4, 0), -(0x1p53 + 2));  // -(2^53 + 2.27)
  const Integer K = power(300);
  expect_same(rounded_root_less(K * K - 1, K + power(53) + 1, 0), -(0x1p53 + 2));  // -(2^53 + 1) and 2^-301 less
  expect_same(rounded_root_less(K * K + 1, K + power(53) + 1, 0), -0x1p53);        // as much more
}

TEST(RoundRootLess, rounds_once_at_both_ends_of_the_range) {
  expect_same(rounded_root_less(1, 0, -1075), 0.0);
  expect_same(rounded_root_less(1, 2, -1075), 0.0);     // -1/2 of the smallest subnormal, and no -0
  expect_same(rounded_root_less(2, 0, -1075), kLeast);  // sqrt(2) / 2 of it
  expect_same(rounded_root_less(9, 0, -1075), 2 * kLeast);
  const Integer edge = power(54) - 1;
  expect_same(rounded_root_less(edge * edge, 0, 970), kInfinity);
  expect_same(rounded_root_less(edge * edge - 1, 0, 970), kLargest);
  expect_same(rounded_root_less(1, edge + 1, 970), -kInfinity);
  expect_same(rounded_root_less(2, edge + 1, 970), -kLargest);  // sqrt(2) - 1 nearer to zero than the tie
}

TEST(RoundRootLess, lies_between_its_rounding_boundaries_for_random_and_nearly_cancelling_differences) {
  std::mt19937_64 random(4);
  for (int i = 0; i < 3000; ++i) {
    const Integer D = random_integer(random, static_cast<unsigned>(1 + random() % 400)) + 1;
    Integer t = random_integer(random, static_cast<unsigned>(random() % 200));
    if (i % 2 == 0) t = floor_sqrt(D) + static_cast<int>(random() % 2);
    const int exponent = static_cast<int>(random() % 1200) - 1150;
    const double y = rounded_root_less(D, t, exponent);
    ASSERT_TRUE(std::isfinite(y));  // no exponent is that large
    // (sqrt(D) - t) 2^exponent = u + w sqrt(D)
    ASSERT_TRUE(
        is_nearest(y, rational(-t, exponent), rational(1, exponent), Rational(boost::multiprecision::cpp_int(D))))
        << "sqrt(" << D << ") - " << t << " 2^" << exponent << " -> " << y;
  }
}

TEST(RoundSumNear, is_right_from_any_estimate) {
  std::mt19937_64 random(5);
  const auto small = [&random](unsigned bits) {
    const Integer n = random_integer(random, bits) + 1;
    return random() % 2 == 0 ? n : -n;
  };
  int estimated = 0;
  for (int i = 0; i < 30; ++i) {
    const Integer c = i % 3 == 0 ? Integer(0) : small(60);
    const Integer e = small(90);
    const Integer D = random_integer(random, 62) + 1;
    const int exponent = i % 5 == 0 ? -1100 : static_cast<int>(random() % 200) - 100;
    const double y = round_sum(c, e, D, exponent);
    if (y == 0) continue;  // less than half of the smallest number, which has no estimate
    ++estimated;
    const auto near = [&](double estimate) {
      return round_sum_near(estimate, y < 0 ? -1 : 1, fixed(c), fixed(e), fixed(D), exponent);
    };
    const double right = std::abs(y);
    double above = right;
    double below = right;
    for (int step = 0; step < 50; ++step) {  // past the step that gives up
      expect_same(near(above), y);
      expect_same(near(below), y);
      above = std::nextafter(above, kInfinity);
      below = std::nextafter(below, 0);
    }
    for (const double wrong : {right * 1.5, right / 3, 0.0, kLeast, 1.0, kLargest, kInfinity})
      expect_same(near(wrong), y);
  }
  EXPECT_GE(estimated, 24);
  // Half way between 2 and 2 + 2^-51, from far away
  expect_same(round_sum_near(1, 1, fixed(power(53) + 1), {}, fixed(1), -52), 2.0);
  expect_same(round_sum_near(kLargest, -1, fixed(-(power(53) + 3)), {}, fixed(1), -52), -(2 + 0x1p-50));
  // Half a unit beyond the largest number, and a quarter, from the number below it
  for (const double estimate : {std::nextafter(kLargest, 0), kLargest}) {
    expect_same(round_sum_near(estimate, 1, fixed(power(54) - 1), {}, fixed(1), 970), kInfinity);
    expect_same(round_sum_near(estimate, 1, fixed(power(55) - 3), {}, fixed(1), 969), kLargest);
  }
}

}  // namespace
}  // namespace contact::kernel::exact_test
