// Sums of doubles, exactly.
#include "contact/exact_sum.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "environment/floating_point_environments.hpp"
#include "extreme_numbers.hpp"

namespace contact::exact_sum_test {
namespace {

TEST(ExactSum, the_sign_survives_what_doubles_lose) {
  EXPECT_EQ(sign_of_sum({1, 0x1p-60, -1}), 1);
  EXPECT_EQ(sign_of_sum({1, -0x1p-60, -1}), -1);
  EXPECT_EQ(sign_of_sum({0.1, 0.2, -0.3}), 1);  // the doubles: 0.1 is above a tenth, 0.3 below three tenths
  EXPECT_EQ(sign_of_sum({kLargest, kLargest, -kLargest, -kLargest}), 0);
  EXPECT_EQ(sign_of_sum({kLargest, kLeast, -kLargest}), 1);
  EXPECT_EQ(sign_of_sum({-0.0, 0.0}), 0);
  EXPECT_EQ(sign_of_sum({}), 0);
}

TEST(ExactSum, is_rounded_once_with_ties_to_even) {
  EXPECT_EQ(rounded_sum({1, 0x1p-53}), 1);
  EXPECT_EQ(rounded_sum({1, 0x1p-53, kLeast}), 1 + 0x1p-52);
  EXPECT_EQ(rounded_sum({1 + 0x1p-52, 0x1p-53}), 1 + 0x1p-51);
  EXPECT_EQ(rounded_sum({kLargest, kLargest, -kLargest}), kLargest);
  EXPECT_EQ(rounded_sum({kLargest, kLargest}), std::numeric_limits<double>::infinity());
  EXPECT_FALSE(std::signbit(rounded_sum({-1, 1})));
  EXPECT_FALSE(std::signbit(rounded_sum({-0.0})));
}

TEST(ExactSum, the_exponent_scales_before_the_one_rounding) {
  EXPECT_EQ(rounded_sum({kLargest, kLargest}, -1), kLargest);        // a middle that no double sum reaches
  EXPECT_EQ(rounded_sum({kLeast, kLeast, kLeast}, -1), 2 * kLeast);  // 1.5 of the least: a tie, to the even 2
  EXPECT_EQ(rounded_sum({kLeast}, -1), 0);                           // half the least: a tie, to the even 0
  EXPECT_EQ(rounded_sum({3}, 2), 12);
}

TEST(ExactSum, takes_every_exponent_in_little_memory) {
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr int kMost = std::numeric_limits<int>::max();
  rusage before{};
  getrusage(RUSAGE_SELF, &before);
  for (const int beyond : {2100, 3000, 1 << 13, 1 << 14, 2'000'000'000, kMost}) {
    EXPECT_EQ(rounded_sum({kLeast}, beyond), kInfinity) << beyond;
    EXPECT_EQ(rounded_sum({2}, beyond), kInfinity) << beyond;
    EXPECT_EQ(rounded_sum({-kLargest, -kLargest}, beyond), -kInfinity) << beyond;
    EXPECT_EQ(bits(rounded_sum({1, -1}, beyond)), 0U) << beyond;
    EXPECT_EQ(bits(rounded_sum({kLargest, kLargest}, -beyond)), 0U) << beyond;
    EXPECT_EQ(bits(rounded_sum({-2, kLeast}, -beyond)), 0U) << beyond;
  }
  EXPECT_EQ(bits(rounded_sum({2}, std::numeric_limits<int>::min())), 0U);
  rusage after{};
  getrusage(RUSAGE_SELF, &after);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 32 << 10) << "kilobytes";  // a shift by 2e9 bits takes 240 MB
  // On this side of the limits nothing is cut off: from the least number to the largest's leading bit and back.
  EXPECT_EQ(rounded_sum({kLeast}, 1074 + 1023), 0x1p1023);
  EXPECT_EQ(rounded_sum({kLeast}, 1074 + 1024), kInfinity);
  EXPECT_EQ(rounded_sum({0x1p1023}, -1023 - 1074), kLeast);
  EXPECT_EQ(bits(rounded_sum({0x1p1023}, -1023 - 1075)), 0U);
  EXPECT_EQ(rounded_sum({0x1p1023, 0x1p1023}, -1024 - 1074), kLeast);
}

TEST(ExactSum, is_the_same_in_every_floating_point_environment) {
  for (const auto& environment : floating_point_environments()) {
    std::uint64_t rounded = 0;
    int sign = 0;
    in_environment(environment, [&] {
      rounded = std::bit_cast<std::uint64_t>(rounded_sum({kLeast, 0x1p-1060, 1, -1}));
      sign = sign_of_sum({1, kLeast, -1});
    });
    EXPECT_EQ(rounded, (std::uint64_t{1} << 14) + 1) << environment.name;  // 2^-1060 is 2^14 of the least
    EXPECT_EQ(sign, 1) << environment.name;
  }
}

}  // namespace
}  // namespace contact::exact_sum_test
