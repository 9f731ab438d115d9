// What doubles tell the interval oracle of a number, against exact numbers.
#include "oracle/truth/interval_rough.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "oracle/truth/exact.hpp"

namespace contact::oracle::rough_test {
namespace {

constexpr mpfr_prec_t kPrecision = 384;

/// A number in both forms, and how large the terms are that it was made of.
struct Both {
  Rough rough;
  Rational exact;
  Rational terms;
};
Both both(double x) { return {Rough::of(Interval(kPrecision, x)), Rational(x), CGAL::abs(Rational(x))}; }
Both operator+(const Both& x, const Both& y) { return {x.rough + y.rough, x.exact + y.exact, x.terms + y.terms}; }
Both operator-(const Both& x, const Both& y) { return {x.rough - y.rough, x.exact - y.exact, x.terms + y.terms}; }
Both operator*(const Both& x, const Both& y) { return {x.rough * y.rough, x.exact * y.exact, x.terms * y.terms}; }

void expect_holds(const Both& x, const char* what) {
  if (!std::isfinite(x.rough.value) || !std::isfinite(x.rough.off)) {
    EXPECT_EQ(x.rough.sign(), std::nullopt) << what;
    return;
  }
  EXPECT_LE(CGAL::abs(Rational(x.rough.value) - x.exact), Rational(x.rough.off)) << what;
  if (const auto sign = x.rough.sign()) {
    EXPECT_EQ(*sign, static_cast<int>(CGAL::sign(x.exact))) << what;
  }
}

TEST(Rough, holds_what_sums_and_products_are) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  int told = 0;
  constexpr int kMany = 20000;
  for (int i = 0; i < kMany; ++i) {
    // Every fourth time of all sizes; every other time with terms that all but cancel.
    const auto of_any_size = [&] {
      for (;;)
        if (const double x = std::bit_cast<double>(random()); std::isfinite(x)) return x;
    };
    const auto any = [&] { return both(i % 4 == 3 ? of_any_size() : unit(random)); };
    const Both a = any(), b = any(), c = any();
    const double fourth = a.rough.value * b.rough.value / c.rough.value;
    const Both d = i % 2 == 0 || !std::isfinite(fourth) ? any() : both(fourth);
    expect_holds(a + b, "sum");
    expect_holds(a * b, "product");
    const Both volume = (a * b - c * d) * (a - b) + c * (a * b - d * c);
    expect_holds(volume, "volume");
    if (i % 4 == 3) continue;
    told += volume.rough.sign() ? 1 : 0;
    if (i % 2 == 0) {
      EXPECT_LE(Rational(volume.rough.off), power_of_two(-48) * volume.terms);  // of little use otherwise
    }
  }
  EXPECT_GT(told, kMany / 3);
}

TEST(Rough, tells_no_sign_of_zero_nor_beside_it) {
  const Both third = both(1.0 / 3.0);
  EXPECT_EQ((third * both(3) - both(1)).rough.sign(), std::nullopt);
  EXPECT_EQ((both(1) - both(1)).rough.sign(), std::nullopt);
  EXPECT_EQ((both(1 + 0x1p-52) - both(1)).rough.sign(), std::nullopt);  // both may lie half an ulp beside
  EXPECT_EQ((both(1 + 0x1p-50) - both(1)).rough.sign(), 1);
  EXPECT_EQ((both(-1 - 0x1p-50) + both(1)).rough.sign(), -1);
  EXPECT_EQ((both(0x1p-600) * both(0x1p-600)).rough.sign(), std::nullopt);
  EXPECT_EQ((both(0x1p600) * both(0x1p600)).rough.sign(), std::nullopt);
  const double largest = std::numeric_limits<double>::max();
  EXPECT_EQ((both(largest) + both(largest)).rough.sign(), std::nullopt);
}

TEST(Rough, is_as_wide_as_the_interval_that_it_is_of) {
  const Interval third = Interval(kPrecision, 1) / Interval(kPrecision, 3);
  const Rough of_third = Rough::of(third);
  EXPECT_LE(CGAL::abs(Rational(of_third.value) - Rational(1) / Rational(3)), Rational(of_third.off));
  const Interval beside = Interval(kPrecision, 1) + (third - third);
  EXPECT_EQ((Rough::of(beside) - Rough::of(Interval(kPrecision, 1))).sign(), std::nullopt);
  // Beyond the range of doubles, and below it.
  const Interval large = Interval(kPrecision, 1).scaled(3000);
  EXPECT_EQ(Rough::of(large).sign(), std::nullopt);
  EXPECT_EQ(Rough::of(large.scaled(-6000)).sign(), std::nullopt);
  EXPECT_EQ(Rough::of(large - large).sign(), std::nullopt);
}

TEST(Rough, points_keep_the_signs_of_what_is_between_them_at_every_scale) {
  for (const int power : {-5000, -1060, 0, 990, 5000}) {
    const auto number = [&](double x) { return Interval(kPrecision, x).scaled(power); };
    const std::vector<Triple> points{{number(0), number(0), number(0)},
                                     {number(3), number(0), number(0)},
                                     {number(0), number(5), number(0)},
                                     {number(0), number(0), number(-7)}};
    const auto roughly = rough(points, power_of(points));
    const RoughTriple n = cross(difference(roughly[1], roughly[0]), difference(roughly[2], roughly[0]));
    EXPECT_EQ(dot(n, difference(roughly[3], roughly[0])).sign(), -1) << power;
    EXPECT_EQ(rough_direction(points[3])[2].sign(), -1) << power;
  }
  EXPECT_EQ(power_of({}), 0);
}

}  // namespace
}  // namespace contact::oracle::rough_test
