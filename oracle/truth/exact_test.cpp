// The oracle's exact numbers: their sign, their one rounding, and how claimed numbers compare with them.
#include "oracle/truth/exact.hpp"
#include "extreme_numbers.hpp"
#include "oracle/truth/truth.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace contact::oracle::exact_test {
namespace {

constexpr Scalar kDouble = Scalar::binary64;
constexpr Scalar kFloat = Scalar::binary32;

struct FormatFacts {
  Scalar scalar;
  double least;    ///< smallest subnormal
  double normal;   ///< smallest normal number
  double largest;  ///< largest finite number
  double epsilon;  ///< ulp(1)
  int overflow;    ///< 2^overflow is the first power of two out of range
};
const FormatFacts kFacts[] = {{kDouble, 0x1p-1074, 0x1p-1022, 0x1.fffffffffffffp1023, 0x1p-52, 1024},
                              {kFloat, 0x1p-149, 0x1p-126, 0x1.fffffep127, 0x1p-23, 128}};

Exact root_of(int n) { return {Rational(0), Rational(1), Rational(n)}; }
Rational half(const Rational& x) { return x / Rational(2); }
/// A number too small to be seen but for exactness.
Rational hair() { return power_of_two(-5000); }

void expect_rounds(const Exact& x, Scalar scalar, double expected) {
  EXPECT_EQ(std::bit_cast<std::uint64_t>(round_to_nearest(x, scalar)), std::bit_cast<std::uint64_t>(expected))
      << round_to_nearest(x, scalar) << " instead of " << expected;
  EXPECT_TRUE(is_correctly_rounded(expected, x, scalar));
}

TEST(Exact, has_a_sign_also_where_D_or_b_is_zero) {
  EXPECT_EQ(Exact(Rational(0), Rational(1), Rational(0)).sign(), CGAL::ZERO);
  EXPECT_EQ(Exact(Rational(0), Rational(0), Rational(7)).sign(), CGAL::ZERO);
  EXPECT_EQ(Exact(Rational(-2), Rational(5), Rational(0)).sign(), CGAL::NEGATIVE);
  EXPECT_EQ(Exact(Rational(0), Rational(-1), Rational(2)).sign(), CGAL::NEGATIVE);
  EXPECT_EQ(Exact(Rational(2), Rational(-1), Rational(3)).sign(), CGAL::POSITIVE);  // sqrt(3) < 2
  EXPECT_EQ(Exact(Rational(2), Rational(-1), Rational(5)).sign(), CGAL::NEGATIVE);  // sqrt(5) > 2
}

TEST(Exact, sees_a_perfect_square_as_rational) {
  const Exact three = root_of(9);
  EXPECT_EQ(three.compare(Rational(3)), CGAL::EQUAL);
  EXPECT_EQ(three.plus(Rational(-3)).sign(), CGAL::ZERO);
  EXPECT_EQ(Exact(Rational(-6), Rational(2), Rational(9)).sign(), CGAL::ZERO);
  EXPECT_EQ(three.compare(Rational(3) + hair()), CGAL::SMALLER);
  EXPECT_EQ(three.compare(Rational(3) - hair()), CGAL::LARGER);
}

TEST(Exact, is_scaled_and_moved_exactly) {
  const Exact x = Exact(Rational(1), Rational(1), Rational(2)).scaled(Rational(-3));  // -3 - 3 sqrt(2)
  EXPECT_EQ(x.sign(), CGAL::NEGATIVE);
  EXPECT_EQ(Exact(Rational(0), Rational(-3), Rational(4)).plus(Rational(6)).sign(), CGAL::ZERO);
  EXPECT_EQ(x.scaled(Rational(0)).sign(), CGAL::ZERO);
  EXPECT_EQ(Exact(Rational(7)).scaled(Rational(2)).compare(Rational(14)), CGAL::EQUAL);
}

TEST(Exact, lies_in_its_enclosure_which_is_as_narrow_as_asked) {
  for (const int n : {2, 3, 9, 1000003})
    for (const int sign : {1, -1})
      for (const int bits : {10, 100, 1000}) {
        const Exact x(Rational(5), Rational(sign), Rational(n));
        const Exact::Enclosure e = x.enclosure(bits);
        EXPECT_NE(x.compare(e.low), CGAL::SMALLER);
        EXPECT_NE(x.compare(e.high), CGAL::LARGER);
        EXPECT_LE(e.high - e.low, power_of_two(-bits) * Rational(1100));  // sqrt(n) < 1100
      }
}

TEST(DyadicString, writes_an_odd_hexadecimal_integer_and_a_power_of_two) {
  EXPECT_EQ(exact_string(Rational(9)), "0x9p0");
  EXPECT_EQ(exact_string(Rational(3)), "0x3p0");
  EXPECT_EQ(exact_string(Rational(0)), "0x0p0");
  EXPECT_EQ(exact_string(Rational(-0x1abd) / Rational(4096)), "-0x1abdp-12");
  EXPECT_EQ(exact_string(power_of_two(600)), "0x1p600");
  EXPECT_EQ(exact_string(power_of_two(-2148)), "0x1p-2148");
  EXPECT_EQ(exact_string(Rational(12)), "0x3p2");
  EXPECT_EQ(exact_string(Rational(-1) / Rational(2)), "-0x1p-1");
  EXPECT_EQ(exact_string(Rational(0x1.fffffffffffffp1023)), "0x1fffffffffffffp971");
}

TEST(DyadicString, is_told_from_any_other_text) {
  for (const int numerator : {0, 1, -1, 12, 0xabc, -0x1abd})
    for (const int exponent : {-2148, -10, -1, 0, 1, 10, 971})
      EXPECT_TRUE(is_exact_string(exact_string(Rational(numerator) * power_of_two(exponent))));
  for (const char* text : {"",       "-",       "0x",     "0xp0",    "0x1",     "0x1p",    "0x1p-",  "1p0",
                           "0X1p0",  "0x1P0",   "+0x1p0", "--0x1p0", "0x-1p0",  "0x01p0",  "-0x0p0", "0x0p1",
                           "0x2p0",  "0x1ap3",  "0x1Bp0", "0x1gp0",  "0x1p+1",  "0x1p01",  "0x1p-0", "0x1p00",
                           "0x1p1a", "0x1.8p0", "0x1p0 ", " 0x1p0",  "0x1\bp0", "0x1\"p0", "0x1p0p0"})
    EXPECT_FALSE(is_exact_string(text)) << text;
}

TEST(RoundToNearest, keeps_every_number_of_the_scalar) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 3000; ++i) {
    const std::uint64_t bits = random();
    const auto d = std::bit_cast<double>(i % 3 == 0 ? bits & 0x800fffffffffffffU : bits);
    if (std::isfinite(d) && d != 0) expect_rounds(Rational(d), kDouble, d);
    const auto f = std::bit_cast<float>(static_cast<std::uint32_t>(i % 3 == 0 ? bits & 0x807fffffU : bits >> 32));
    if (std::isfinite(f) && f != 0) expect_rounds(Rational(static_cast<double>(f)), kFloat, static_cast<double>(f));
  }
}

TEST(RoundToNearest, rounds_a_double_to_binary32_as_a_conversion_does) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 3000; ++i) {
    // exponents -160 to 139: all of binary32 and beyond both ends; one in two has few bits, so that there are ties
    const double significand = static_cast<double>(random() >> 11) * 0x1p-53 + 0.5;
    double d = std::ldexp(significand, static_cast<int>(random() % 300) - 160);
    if (i % 2 == 0) d = std::bit_cast<double>(std::bit_cast<std::uint64_t>(d) & ~((std::uint64_t{1} << 28) - 1));
    if (i % 3 == 0) d = -d;
    const auto converted = static_cast<double>(static_cast<float>(d));  // IEEE 754 conversion, to nearest
    expect_rounds(Rational(d), kFloat, converted == 0 ? 0.0 : converted);
  }
}

TEST(RoundToNearest, rounds_roots_and_quotients_to_the_nearest) {
  expect_rounds(root_of(2), kDouble, 1.414213562373095048801688724209698079);
  expect_rounds(root_of(2), kFloat, static_cast<double>(1.414213562373095048801688724209698079F));
  expect_rounds(Exact(Rational(0), Rational(-1) / Rational(3), Rational(3)), kDouble,
                -0.577350269189625764509148780501957456);  // -sqrt(3) / 3
  expect_rounds(Exact(Rational(-1), Rational(1), Rational(2)), kDouble, 0.414213562373095048801688724209698079);
  expect_rounds(Rational(3) / Rational(5), kDouble, 0.6);
  expect_rounds(Rational(3) / Rational(5), kFloat, static_cast<double>(0.6F));
}

TEST(RoundToNearest, breaks_ties_to_even_and_sees_a_hair_beside_them) {
  for (const FormatFacts& f : kFacts)
    for (const int sign : {1, -1}) {
      const Rational s(sign);
      const Rational tie1 = Rational(1) + half(Rational(f.epsilon));                // between 1 (even) and 1 + epsilon
      const Rational tie2 = Rational(1) + Rational(3) * half(Rational(f.epsilon));  // between that and 1 + 2 epsilon
      expect_rounds(s * tie1, f.scalar, sign * 1.0);
      expect_rounds(s * (tie1 + hair()), f.scalar, sign * (1 + f.epsilon));
      expect_rounds(s * (tie1 - hair()), f.scalar, sign * 1.0);
      expect_rounds(s * tie2, f.scalar, sign * (1 + 2 * f.epsilon));
      expect_rounds(s * (tie2 - hair()), f.scalar, sign * (1 + f.epsilon));
      // below 1 numbers are twice as dense: half way between 1 - epsilon / 2 (odd) and 1
      const Rational tie3 = Rational(1) - Rational(f.epsilon) / Rational(4);
      expect_rounds(s * tie3, f.scalar, sign * 1.0);
      expect_rounds(s * (tie3 - hair()), f.scalar, sign * (1 - f.epsilon / 2));
      // the tie as a sum with a root: 1 + sqrt((epsilon / 2)^2)
      const Rational e = half(Rational(f.epsilon));
      expect_rounds(Exact(s, s, e * e), f.scalar, sign * 1.0);
      expect_rounds(Exact(s, s, e * e + hair()), f.scalar, sign * (1 + f.epsilon));
    }
}

TEST(RoundToNearest, rounds_once_among_the_subnormals) {
  for (const FormatFacts& f : kFacts) {
    const Rational least(f.least);
    expect_rounds(half(least), f.scalar, 0.0);
    expect_rounds(half(least) + hair(), f.scalar, f.least);
    expect_rounds(half(least) - hair(), f.scalar, 0.0);
    expect_rounds(Rational(3) * half(least), f.scalar, 2 * f.least);
    expect_rounds(Rational(5) * half(least), f.scalar, 2 * f.least);
    expect_rounds(Rational(-7) * half(least), f.scalar, -4 * f.least);
    expect_rounds(Rational(f.normal) - half(least), f.scalar, f.normal);
    expect_rounds(Rational(f.normal) - half(least) - hair(), f.scalar, f.normal - f.least);
    // Of a tie's two neighbours the odd one is wrong.
    EXPECT_FALSE(is_correctly_rounded(f.least, half(least), f.scalar));
    EXPECT_FALSE(is_correctly_rounded(f.least, Rational(3) * half(least), f.scalar));
    EXPECT_FALSE(is_correctly_rounded(3 * f.least, Rational(5) * half(least), f.scalar));
  }
}

TEST(RoundToNearest, gives_plus_zero_for_every_zero) {
  for (const FormatFacts& f : kFacts) {
    expect_rounds(Rational(0), f.scalar, 0.0);
    expect_rounds(-half(Rational(f.least)), f.scalar, 0.0);
    expect_rounds(-hair(), f.scalar, 0.0);
    expect_rounds(Exact(Rational(3), Rational(-1), Rational(9)), f.scalar, 0.0);
    EXPECT_TRUE(is_correctly_rounded(-0.0, Rational(0), f.scalar));
    EXPECT_TRUE(is_correctly_rounded(-0.0, hair(), f.scalar));
  }
}

TEST(RoundToNearest, overflows_from_half_an_ulp_beyond_the_largest_finite_number) {
  for (const FormatFacts& f : kFacts) {
    // its significand is odd, so the tie between it and the first power of two out of range goes to infinity
    const Rational tie = half(Rational(f.largest) + power_of_two(f.overflow));
    expect_rounds(Rational(f.largest), f.scalar, f.largest);
    expect_rounds(tie, f.scalar, kInfinity);
    expect_rounds(tie - hair(), f.scalar, f.largest);
    expect_rounds(-tie, f.scalar, -kInfinity);
    expect_rounds(-tie + hair(), f.scalar, -f.largest);
    expect_rounds(power_of_two(5000), f.scalar, kInfinity);
    EXPECT_FALSE(is_correctly_rounded(-kInfinity, tie, f.scalar));
    EXPECT_FALSE(is_correctly_rounded(kInfinity, tie - hair(), f.scalar));
    EXPECT_FALSE(is_correctly_rounded(f.largest, tie, f.scalar));
  }
}

TEST(IsCorrectlyRounded, refuses_the_neighbours_nan_and_numbers_outside_the_scalar) {
  const double root = round_to_nearest(root_of(2), kDouble);
  EXPECT_FALSE(is_correctly_rounded(next_up(root, kDouble), root_of(2), kDouble));
  EXPECT_FALSE(is_correctly_rounded(next_down(root, kDouble), root_of(2), kDouble));
  EXPECT_FALSE(is_correctly_rounded(kNaN, root_of(2), kDouble));
  EXPECT_FALSE(is_correctly_rounded(kInfinity, root_of(2), kDouble));
  EXPECT_FALSE(is_correctly_rounded(root, root_of(2), kFloat));  // a binary64 number and none of binary32
  EXPECT_FALSE(is_correctly_rounded(1 + 0x1p-40, Rational(1) + power_of_two(-40), kFloat));
}

TEST(IsFaithful, accepts_the_two_numbers_beside_the_real_and_no_other) {
  for (const FormatFacts& f : kFacts) {
    const double root = round_to_nearest(root_of(2), f.scalar);
    const bool root_is_above = root_of(2).compare(Rational(root)) == CGAL::SMALLER;
    const double other = root_is_above ? next_down(root, f.scalar) : next_up(root, f.scalar);
    const double beyond = root_is_above ? next_up(root, f.scalar) : next_down(root, f.scalar);
    const double further = root_is_above ? next_down(other, f.scalar) : next_up(other, f.scalar);
    EXPECT_TRUE(is_faithful(root, root_of(2), f.scalar));
    EXPECT_TRUE(is_faithful(other, root_of(2), f.scalar));
    EXPECT_FALSE(is_faithful(beyond, root_of(2), f.scalar));
    EXPECT_FALSE(is_faithful(further, root_of(2), f.scalar));
    // a number of the scalar has itself alone
    EXPECT_TRUE(is_faithful(1, Rational(1), f.scalar));
    EXPECT_FALSE(is_faithful(1 + f.epsilon, Rational(1), f.scalar));
    EXPECT_FALSE(is_faithful(1 - f.epsilon / 2, Rational(1), f.scalar));
    // 0 and the smallest subnormal are the two beside whatever lies between
    EXPECT_TRUE(is_faithful(0, hair(), f.scalar));
    EXPECT_TRUE(is_faithful(-0.0, hair(), f.scalar));
    EXPECT_TRUE(is_faithful(f.least, hair(), f.scalar));
    EXPECT_FALSE(is_faithful(-f.least, hair(), f.scalar));
    EXPECT_FALSE(is_faithful(kInfinity, Rational(1), f.scalar));
    // Past the largest finite number M an ulp decides: M stands next to M + ulp / 4, and not next to 3 M.
    const Rational quarter = ulp(Rational(f.largest), f.scalar) / Rational(4);
    EXPECT_TRUE(is_faithful(f.largest, Rational(f.largest) + quarter, f.scalar));
    EXPECT_FALSE(is_faithful(f.largest, Rational(f.largest) * Rational(3), f.scalar));
    EXPECT_FALSE(is_faithful(-f.largest, Rational(f.largest) * Rational(-2), f.scalar));
    EXPECT_FALSE(is_faithful(kNaN, Rational(1), f.scalar));
  }
  EXPECT_FALSE(is_faithful(1 + 0x1p-40, Rational(1) + power_of_two(-40), kFloat));
}

TEST(Ulp, is_the_spacing_of_the_numbers_around_a_real) {
  for (const FormatFacts& f : kFacts) {
    const Rational epsilon(f.epsilon);
    EXPECT_EQ(ulp(Rational(1), f.scalar), epsilon);
    EXPECT_EQ(ulp(Rational(-1), f.scalar), epsilon);
    EXPECT_EQ(ulp(Rational(2) - hair(), f.scalar), epsilon);  // exactly at a power of two it changes
    EXPECT_EQ(ulp(Rational(2), f.scalar), Rational(2) * epsilon);
    EXPECT_EQ(ulp(Rational(-2) + hair(), f.scalar), epsilon);
    EXPECT_EQ(ulp(Rational(1) - hair(), f.scalar), half(epsilon));
    EXPECT_EQ(ulp(root_of(4), f.scalar), Rational(2) * epsilon);
    EXPECT_EQ(ulp(root_of(3), f.scalar), epsilon);
    EXPECT_EQ(ulp(Exact(Rational(0), Rational(-1), Rational(4)), f.scalar), Rational(2) * epsilon);
  }
}

TEST(Ulp, changes_exactly_at_a_power_of_two_that_no_enclosure_can_tell) {
  for (const FormatFacts& f : kFacts) {
    const Rational epsilon(f.epsilon);
    for (const int sign : {1, -1}) {
      // 4 - sqrt(4 - t): 2 for t = 0, a hair above for t > 0 and below for t < 0
      const auto near_two = [&](const Rational& t) {
        return Exact(Rational(4 * sign), Rational(-sign), Rational(4) - t);
      };
      EXPECT_EQ(ulp(near_two(Rational(0)), f.scalar), Rational(2) * epsilon);
      EXPECT_EQ(ulp(near_two(hair()), f.scalar), Rational(2) * epsilon);
      EXPECT_EQ(ulp(near_two(-hair()), f.scalar), epsilon);
    }
  }
}

TEST(Ulp, is_the_smallest_subnormal_from_zero_to_the_smallest_normal_numbers) {
  for (const FormatFacts& f : kFacts) {
    const Rational least(f.least);
    EXPECT_EQ(ulp(Rational(0), f.scalar), least);
    EXPECT_EQ(ulp(hair(), f.scalar), least);
    EXPECT_EQ(ulp(least, f.scalar), least);
    EXPECT_EQ(ulp(Rational(f.normal), f.scalar), least);
    EXPECT_EQ(ulp(Rational(2) * Rational(f.normal) - hair(), f.scalar), least);
    EXPECT_EQ(ulp(Rational(2) * Rational(f.normal), f.scalar), Rational(2) * least);
  }
}

TEST(Ulp, goes_on_growing_above_the_largest_finite_number) {
  EXPECT_EQ(ulp(power_of_two(1023), kDouble), power_of_two(971));
  EXPECT_EQ(ulp(power_of_two(1025), kDouble), power_of_two(973));
  EXPECT_EQ(ulp(Rational(3) * power_of_two(1024), kDouble), power_of_two(973));
  EXPECT_EQ(ulp(power_of_two(130), kFloat), power_of_two(107));
}

TEST(FloorLog2, is_the_exponent_of_the_power_of_two_at_or_below_a_magnitude) {
  for (const int k : {-1074, -3, 0, 1, 1023}) {
    const Rational power = power_of_two(k);
    const Rational hair = power * power_of_two(-2000);
    for (const int sign : {1, -1}) {
      EXPECT_EQ(floor_log2(Rational(sign) * power), k);
      EXPECT_EQ(floor_log2(Rational(sign) * (power + hair)), k);
      EXPECT_EQ(floor_log2(Rational(sign) * (power - hair)), k - 1);
    }
  }
  EXPECT_EQ(floor_log2(Rational(1) / Rational(3)), -2);
  EXPECT_EQ(floor_log2(Rational(7) / Rational(2)), 1);
}

TEST(Neighbours, step_through_the_scalar_and_past_its_end) {
  for (const FormatFacts& f : kFacts) {
    EXPECT_EQ(next_up(1, f.scalar), 1 + f.epsilon);
    EXPECT_EQ(next_down(1, f.scalar), 1 - f.epsilon / 2);
    EXPECT_EQ(next_up(0, f.scalar), f.least);
    EXPECT_EQ(next_down(0, f.scalar), -f.least);
    EXPECT_EQ(next_up(f.largest, f.scalar), kInfinity);
    EXPECT_EQ(next_down(-f.largest, f.scalar), -kInfinity);
  }
}

TEST(PowerOfTwo, is_exact_for_either_sign) {
  EXPECT_EQ(power_of_two(0), Rational(1));
  EXPECT_EQ(power_of_two(10), Rational(1024));
  EXPECT_EQ(power_of_two(-3), Rational(1) / Rational(8));
  EXPECT_EQ(power_of_two(3000) * power_of_two(-3000), Rational(1));
}

TEST(ErrorInUnits, is_exact_for_small_quotients) {
  EXPECT_EQ(error_in_units(Rational(5), Rational(3), Rational(1)), 2);
  EXPECT_EQ(error_in_units(Rational(1), Rational(3), Rational(4)), 0.5);
  EXPECT_EQ(error_in_units(Rational(3), root_of(9), Rational(1)), 0);
  EXPECT_EQ(error_in_units(Rational(1), Rational(1) + hair(), hair()), 1);
}

TEST(ErrorInUnits, is_never_below_the_real_quotient_and_hardly_above) {
  std::mt19937_64 random(3);
  const auto rational = [&](int spread) {
    const Rational n(static_cast<double>(random() >> 11) - 0x1p52);
    return n * power_of_two(static_cast<int>(random() % static_cast<unsigned>(spread)) - spread / 2);
  };
  for (int i = 0; i < 3000; ++i) {
    const Rational D = CGAL::abs(rational(20));
    const Exact x(rational(100), rational(100), D);
    Rational claim = rational(100);
    if (i % 2 == 0) claim = Rational(round_to_nearest(x, kDouble));  // a claim that all but cancels
    const Rational unit = power_of_two(static_cast<int>(random() % 100) - 80);
    const double error = error_in_units(claim, x, unit);
    EXPECT_TRUE(is_within(claim, x, Rational(error) * unit));
    if (error > 0) {
      EXPECT_FALSE(is_within(claim, x, Rational(error) * unit * (Rational(1) - power_of_two(-45))));
    }
  }
}

TEST(NearestBoundary, is_the_middle_of_two_neighbours_on_the_nearer_side) {
  for (const FormatFacts& f : kFacts) {
    const Rational epsilon(f.epsilon);
    const auto expect = [&](const Exact& x, const Rational& at, const Rational& unit, const Rational& ulps) {
      const Boundary boundary = nearest_boundary(x, f.scalar);
      EXPECT_EQ(boundary.at, at);
      EXPECT_EQ(boundary.ulp, unit);
      EXPECT_EQ(distance_in_ulps(x, boundary), ulps);
    };
    const Rational middle = Rational(1) + half(epsilon);
    expect(middle, middle, epsilon, Rational(0));
    expect(middle + hair(), middle, epsilon, hair() / epsilon);
    expect(middle - hair(), middle, epsilon, hair() / epsilon);
    expect(-middle - hair(), -middle, epsilon, hair() / epsilon);
    expect(Rational(1), Rational(1) - half(half(epsilon)), epsilon,
           half(half(Rational(1))));  // nearer below a power of 2
    expect(Rational(1) + hair(), Rational(1) - half(half(epsilon)), epsilon,
           half(half(Rational(1))) + hair() / epsilon);
    expect(Rational(0), half(Rational(f.least)), Rational(f.least), half(Rational(1)));
    expect(Rational(f.least) * half(Rational(3)), Rational(f.least) * half(Rational(3)), Rational(f.least),
           Rational(0));
    const Rational last = ulp(Rational(f.largest), f.scalar);  // where infinity begins is a boundary too
    expect(Rational(f.largest) + half(last), Rational(f.largest) + half(last), last, Rational(0));
    expect(Rational(-3) * Rational(f.largest), -Rational(f.largest) - half(last), last,
           Rational(2) * Rational(f.largest) / last - half(Rational(1)));
  }
}

TEST(NearestBoundary, is_told_from_a_root_that_misses_it_by_a_hair) {
  // sqrt(m^2 + m t) = m + t / 2 - ..: from an enclosure of 60 bits no one could tell on which side it lies
  const Rational m = Rational(1) + Rational(0x1p-53);
  const Exact beside(Rational(0), Rational(1), m * m + Rational(2) * hair());
  const Boundary boundary = nearest_boundary(beside, kDouble);
  EXPECT_EQ(boundary.at, m);
  EXPECT_EQ(floor_log2(distance_in_ulps(beside, boundary)), -5000 + 52 - 1);
  EXPECT_EQ(beside.compare(m), CGAL::LARGER);
}

/// A number as the root of its square.
Exact root(const Rational& x) { return {Rational(0), Rational(x < Rational(0) ? -1 : 1), x * x}; }
/// It as it is, as a root, and as two sums of which the second term cancels the first.
std::vector<Exact> forms(const Rational& x) {
  return {x, root(x), {x - Rational(1), Rational(1), Rational(1)}, root(x).scaled(Rational(-1)).plus(x + x)};
}

TEST(MayBeNearBoundary, is_true_of_all_that_is_near_and_false_four_times_as_far) {
  constexpr int kNear = -20;
  for (const FormatFacts& f : kFacts) {
    const Rational largest(f.largest);
    const Rational last = ulp(largest, f.scalar);
    struct Place {
      Rational boundary;
      Rational ulp;  ///< of what x rounds to on either side, the larger of two
    };
    const Rational epsilon(f.epsilon);
    const Rational least(f.least);
    std::vector<Place> places{
        {Rational(1) + half(epsilon), epsilon},
        {Rational(3) + epsilon, Rational(2) * epsilon},
        {Rational(1) - half(half(epsilon)), epsilon},  // a power of two above, which has the larger ulp
        {half(least), least},
        {half(Rational(3) * least), least},
        {Rational(f.normal) - half(least), least},
        {largest + half(last), last}};
    for (const Place& place : std::vector(places)) places.push_back({-place.boundary, place.ulp});
    for (const Place& place : places)
      for (const int side : {-1, 1}) {
        const auto beside = [&](const Rational& ulps) { return place.boundary + Rational(side) * ulps * place.ulp; };
        for (const Rational& ulps : {Rational(0), hair(), half(power_of_two(kNear)), power_of_two(kNear)})
          for (const Exact& x : forms(beside(ulps)))
            EXPECT_TRUE(may_be_near_boundary(x, f.scalar, kNear)) << exact_string(place.boundary) << " " << side;
        for (const Rational& ulps : {power_of_two(kNear + 2), power_of_two(-3)})
          for (const Exact& x : {Exact(beside(ulps)), root(beside(ulps))})
            EXPECT_FALSE(may_be_near_boundary(x, f.scalar, kNear)) << exact_string(place.boundary) << " " << side;
      }
    for (const Rational& x : {Rational(0), least, Rational(1), largest, Rational(1) + hair(), hair()})
      EXPECT_FALSE(may_be_near_boundary(x, f.scalar, kNear)) << exact_string(x);
  }
}

TEST(MayBeNearBoundary, is_asked_where_what_is_nearest_is_wanted) {
  std::mt19937_64 random(11);
  int near = 0;
  for (int i = 0; i < 4000; ++i) {
    const Scalar scalar = i % 2 == 0 ? kDouble : kFloat;
    const int digits = scalar == kDouble ? 53 : 24;
    // Some bits behind those that stay, so that one in eight lies within an eighth of the middle.
    const Rational whole(static_cast<double>(random() >> (64 - digits)));
    const Rational n = whole + Rational(static_cast<double>(random() >> 11)) * power_of_two(-53);
    const Exact x(n * power_of_two(static_cast<int>(random() % 200) - 100), Rational(i % 3) * hair(), Rational(2));
    const Boundary boundary = nearest_boundary(x, scalar);
    const bool is_near = is_within(boundary.at, x, power_of_two(-4) * boundary.ulp);
    near += is_near ? 1 : 0;
    if (is_near) {
      EXPECT_TRUE(may_be_near_boundary(x, scalar, -4)) << i;
    }
    if (!is_within(boundary.at, x, power_of_two(-2) * boundary.ulp)) {
      EXPECT_FALSE(may_be_near_boundary(x, scalar, -4)) << i;
    }
  }
  EXPECT_GT(near, 300);
}

TEST(FloorLog2, is_right_beside_powers_of_two) {
  for (const int power : {-1100, -3, 0, 5, 1100})
    for (const Rational& sign : {Rational(1), Rational(-1)}) {
      const Rational at = sign * power_of_two(power);
      for (const Exact& x : forms(at)) EXPECT_EQ(floor_log2(x), power);
      for (const Exact& x : forms(at + sign * hair())) EXPECT_EQ(floor_log2(x), power);
      for (const Exact& x : forms(at - sign * hair())) EXPECT_EQ(floor_log2(x), power - 1);
    }
}

TEST(IsWithin, includes_the_bound_itself) {
  EXPECT_TRUE(is_within(Rational(5), root_of(9), Rational(2)));
  EXPECT_TRUE(is_within(Rational(1), root_of(9), Rational(2)));
  EXPECT_FALSE(is_within(Rational(5) + hair(), root_of(9), Rational(2)));
  EXPECT_FALSE(is_within(Rational(1) - hair(), root_of(9), Rational(2)));
}

}  // namespace
}  // namespace contact::oracle::exact_test
