// Short numbers: every operation on every operand of few bits against rationals rounded by hand.
#include "dev/short_numbers/tiny.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

namespace contact::kernel::tiny {
namespace {

using Rational = boost::multiprecision::cpp_rational;

/// The two numbers of `bits` bits around x, the same where x is one.
struct Around {
  double below;
  double above;
};

Around around(const Rational& x, int bits) {
  double power = std::ldexp(1, std::ilogb(static_cast<double>(x)) - bits);
  while (abs(x) >= Rational(std::ldexp(power, bits))) power *= 2;
  const Rational quotient = x / Rational(power);
  boost::multiprecision::cpp_int whole = numerator(quotient) / denominator(quotient);
  if (Rational(whole) > quotient) --whole;
  const bool exact = Rational(whole) == quotient;
  return {static_cast<double>(whole) * power, static_cast<double>(exact ? whole : whole + 1) * power};
}

template <int kBits, Rounding kRounding>
double rounded(const Rational& x) {
  if (x == 0) return 0;
  const auto [below, above] = around(x, kBits);
  switch (kRounding) {
    case Rounding::up:
      return above;
    case Rounding::down:
      return below;
    case Rounding::to_zero:
      return x > 0 ? below : above;
    case Rounding::to_nearest:
      break;
  }
  const Rational to_below = x - Rational(below);
  const Rational to_above = Rational(above) - x;
  if (to_below != to_above) return to_below < to_above ? below : above;
  int exponent = 0;
  return std::fmod(std::ldexp(std::frexp(below, &exponent), kBits), 2) == 0 ? below : above;
}

template <int kBits>
std::vector<double> numbers(int low, int high) {
  std::vector<double> all{0};
  for (int exponent = low; exponent <= high; ++exponent)
    for (int i = 1 << (kBits - 1); i < 1 << kBits; ++i)
      for (const int sign : {1, -1}) all.push_back(std::ldexp(sign * i, exponent - kBits + 1));
  return all;
}

template <int kBits, Rounding kRounding>
void check(double a, double b) {
  using Number = Tiny<kBits, kRounding>;
  const auto value = [](Number x) { return static_cast<double>(x); };
  const auto expected = [](const Rational& x) { return rounded<kBits, kRounding>(x); };
  const Rational x(a);
  const Rational y(b);
  ASSERT_EQ(value(Number(a) + b), expected(x + y)) << a << " " << b;
  ASSERT_EQ(value(Number(a) - b), expected(x - y)) << a << " " << b;
  ASSERT_EQ(value(Number(a) * b), expected(x * y)) << a << " " << b;
  if constexpr (kRounding == Rounding::to_nearest) {
    if (b != 0) {
      ASSERT_EQ(value(Number(a) / b), expected(x / y)) << a << " " << b;
    }
    if (a > 0) {
      // sqrt a is nearest to r where a is between the squares of the midpoints beside r; none of these is a number.
      const double r = value(sqrt(Number(a)));
      int exponent = 0;
      const bool power = std::frexp(r, &exponent) == 0.5;
      const double half = std::ldexp(0.5, exponent - kBits);
      const Rational upper = Rational(r) + Rational(half);
      const Rational lower = Rational(r) - Rational(power ? half / 2 : half);
      ASSERT_TRUE(Number::holds(r));
      ASSERT_TRUE(lower * lower < x && x < upper * upper) << a;
    }
  }
}

template <int kBits, Rounding kRounding>
void check_fused(double a, double b, double c) {
  using Number = Tiny<kBits, kRounding>;
  const double found = static_cast<double>(fma(Number(a), Number(b), Number(c)));
  ASSERT_EQ(found, (rounded<kBits, kRounding>(Rational(a) * Rational(b) + Rational(c)))) << a << " " << b << " " << c;
}

template <Rounding kRounding>
void check_all() {
  for (const double a : numbers<3>(0, 1))
    for (const double b : numbers<3>(-6, 6)) check<3, kRounding>(a, b);
  for (const double a : numbers<3>(0, 0))
    for (const double b : numbers<3>(0, 0))
      for (const double c : numbers<3>(-8, 8)) check_fused<3, kRounding>(a, b, c);
}

TEST(Tiny, rounds_every_operation_on_every_operand_of_three_bits_once) {
  check_all<Rounding::to_nearest>();
  check_all<Rounding::up>();
  check_all<Rounding::down>();
  check_all<Rounding::to_zero>();
}

template <int kBits>
void check_some() {
  std::mt19937_64 random(5);
  const auto number = [&random] {
    const auto i = (std::uint64_t{1} << (kBits - 1)) | (random() >> (65 - kBits));
    const double x = std::ldexp(static_cast<double>(i), static_cast<int>(random() % 50) - 25 - kBits);
    return random() % 2 == 0 ? x : -x;
  };
  for (int i = 0; i < 1000; ++i) {
    const double a = number();
    const double b = number();
    check<kBits, Rounding::to_nearest>(a, b);
    check_fused<kBits, Rounding::to_nearest>(a, b, number());
    check_fused<kBits, Rounding::up>(a, b, number());
    check_fused<kBits, Rounding::down>(a, b, number());
  }
}

TEST(Tiny, rounds_longer_numbers_once_too) {
  check_some<8>();
  check_some<16>();
  check_some<25>();
}

TEST(Tiny, a_fused_product_and_sum_is_rounded_once_where_two_roundings_would_meet_a_tie) {
  // 1 + 2^-8 and a little: rounded to 53 bits first it would be the tie between 1 and 1 + 2^-7, and go to 1.
  using Number = Tiny<8>;
  const double little = 0x1p-100;
  EXPECT_EQ(static_cast<double>(fma(Number(1 + 0x1p-4), Number(1 + 0x1p-4), Number(little))), 1 + 0x11p-7);
  EXPECT_EQ(static_cast<double>(Number(1 + 0x1p-4) * Number(1 + 0x1p-4)), 1 + 0x10p-7);
  EXPECT_EQ(static_cast<double>(Number::rounded(1 + 0x1p-8, little)), 1 + 0x1p-7);
  EXPECT_EQ(static_cast<double>(Number::rounded(1 + 0x1p-8)), 1);
  EXPECT_EQ(static_cast<double>(Number::rounded(1 + 0x3p-8, -little)), 1 + 0x1p-7);
  EXPECT_EQ(static_cast<double>(Number::rounded(1 + 0x3p-8)), 1 + 0x1p-6);
}

TEST(Tiny, has_the_limits_that_the_kernels_take_their_unit_from) {
  EXPECT_EQ(std::numeric_limits<Tiny<8>>::digits, 8);
  EXPECT_EQ(static_cast<double>(std::numeric_limits<Tiny<8>>::epsilon()), 0x1p-7);
  EXPECT_TRUE(Tiny<8>::holds(255.0 / 128));
  EXPECT_FALSE(Tiny<8>::holds(257.0 / 128));
}

}  // namespace
}  // namespace contact::kernel::tiny
