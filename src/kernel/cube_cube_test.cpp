// Cube against cube: touching, the alarm's exact edge, the ends of the range and every floating-point environment.
#include "contact/cube_cube.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include "environment/floating_point_environments.hpp"
#include "extreme_numbers.hpp"

namespace contact::cube_cube_test {
namespace {

/// The answer, which is the same for swapped boxes.
bool hit(const Box& a, const Box& b, double alarm) {
  const bool forward = test_cube_cube(a, b, alarm);
  EXPECT_EQ(test_cube_cube(b, a, alarm), forward) << "swapped boxes";
  return forward;
}

/// Two boxes that overlap on two axes and are [min1, max1] and [min2, max2] on the third; the answer for every axis.
bool hit_on_axis(std::pair<double, double> first, std::pair<double, double> second, double alarm) {
  bool answer = false;
  for (int axis = 0; axis < 3; ++axis) {
    Box a{{-1, -1, -1}, {1, 1, 1}};
    Box b = a;
    std::tie(a.min[axis], a.max[axis]) = first;
    std::tie(b.min[axis], b.max[axis]) = second;
    const bool on_this_axis = hit(a, b, alarm);
    if (axis > 0) {
      EXPECT_EQ(on_this_axis, answer) << "axis " << axis;
    }
    answer = on_this_axis;
  }
  return answer;
}

TEST(CubeCube, touching_faces_count_and_one_ulp_apart_do_not) {
  EXPECT_TRUE(hit_on_axis({0, 1}, {1, 2}, 0));
  EXPECT_FALSE(hit_on_axis({0, 1}, {above(1), 2}, 0));
  EXPECT_FALSE(hit_on_axis({0, below(1)}, {1, 2}, 0));
  EXPECT_TRUE(hit_on_axis({0, 1}, {-2, 0}, 0));
  EXPECT_FALSE(hit_on_axis({0, 1}, {-2, -kLeast}, 0));
  EXPECT_TRUE(hit_on_axis({0, 1}, {-2, -0.0}, 0));
  EXPECT_TRUE(hit_on_axis({0, 1}, {below(1), 2}, 0));
}

TEST(CubeCube, touching_in_an_edge_or_a_corner_counts) {
  const Box unit{{0, 0, 0}, {1, 1, 1}};
  EXPECT_TRUE(hit(unit, {{1, 1, 0}, {2, 2, 1}}, 0));
  EXPECT_TRUE(hit(unit, {{1, 1, 1}, {2, 2, 2}}, 0));
  EXPECT_TRUE(hit(unit, {{-1, 1, -1}, {0, 2, 0}}, 0));
  EXPECT_FALSE(hit(unit, {{1, 1, above(1)}, {2, 2, 2}}, 0));
}

TEST(CubeCube, one_separated_axis_is_enough_for_a_miss) {
  const Box unit{{0, 0, 0}, {1, 1, 1}};
  EXPECT_FALSE(hit(unit, {{0, 0, 3}, {1, 1, 4}}, 1.5));
  EXPECT_FALSE(hit(unit, {{3, 0, 0}, {4, 1, 1}}, 1.5));
  EXPECT_FALSE(hit(unit, {{0, -4, 0}, {1, -3, 1}}, 1.5));
}

TEST(CubeCube, exactly_the_alarm_distance_apart_counts) {
  EXPECT_TRUE(hit_on_axis({0, 1}, {1.5, 2}, 0.5));
  EXPECT_FALSE(hit_on_axis({0, 1}, {above(1.5), 2}, 0.5));
  EXPECT_FALSE(hit_on_axis({0, 1}, {1.5, 2}, below(0.5)));
  EXPECT_TRUE(hit_on_axis({0, 1}, {-2, -0.5}, 0.5));
  // on every axis by itself, and not by Euclid: corner to corner sqrt(3) / 2 apart
  EXPECT_TRUE(hit({{0, 0, 0}, {1, 1, 1}}, {{1.5, 1.5, 1.5}, {2, 2, 2}}, 0.5));
}

TEST(CubeCube, an_alarm_that_a_sum_rounds_away_or_rounds_up_is_exact) {
  // 1 + 2^-54 rounds to 1: a face at 1 is within, the next number 1 + 2^-52 is not
  EXPECT_TRUE(hit_on_axis({0, 1}, {1, 2}, 0x1p-54));
  EXPECT_FALSE(hit_on_axis({0, 1}, {above(1), 2}, 0x1p-54));
  // 1 + 1.5 * 2^-53 rounds up to 1 + 2^-52 and is less
  EXPECT_FALSE(hit_on_axis({0, 1}, {above(1), 2}, 0x1.8p-53));
  EXPECT_TRUE(hit_on_axis({0, 1}, {above(1), 2}, 0x1p-52));
  // (1 + 2^-52) + 2^-53 is a tie that goes up to 1 + 2^-51 and is less
  EXPECT_FALSE(hit_on_axis({0, above(1)}, {0x1.0000000000002p0, 2}, 0x1p-53));
  // -1 + 2^-60 rounds to -1 and reaches it
  EXPECT_TRUE(hit_on_axis({-2, -1}, {-1, 0}, 0x1p-60));
  EXPECT_FALSE(hit_on_axis({-2, -1}, {above(-1), 0}, 0x1p-60));
  // the sum cancels: -1 + (1 - 2^-53) = -2^-53
  EXPECT_TRUE(hit_on_axis({-2, -1}, {-0x1p-53, 0}, below(1)));
  EXPECT_FALSE(hit_on_axis({-2, -1}, {above(-0x1p-53), 0}, below(1)));
}

TEST(CubeCube, a_sum_that_overflows_is_right) {
  EXPECT_TRUE(hit_on_axis({-kLargest, kLargest}, {kLargest, kLargest}, kLargest));
  EXPECT_TRUE(hit_on_axis({0, below(kLargest)}, {kLargest, kLargest}, 0x1p971));      // exactly one ulp apart
  EXPECT_FALSE(hit_on_axis({0, below(kLargest)}, {kLargest, kLargest}, 0x1.8p970));   // rounds up to it and is less
  EXPECT_FALSE(hit_on_axis({-kLargest, -kLargest}, {kLargest, kLargest}, kLargest));  // the gap is twice the largest
  EXPECT_TRUE(hit_on_axis({-kLargest, -kLargest}, {0, kLargest}, kLargest));          // exactly the largest
  EXPECT_FALSE(hit_on_axis({-kLargest, -kLargest}, {kLeast, kLargest}, kLargest));    // and the least more
}

TEST(CubeCube, flat_and_point_boxes_are_boxes) {
  EXPECT_TRUE(hit_on_axis({1, 1}, {1, 1}, 0));
  EXPECT_FALSE(hit_on_axis({1, 1}, {above(1), above(1)}, 0));
  EXPECT_TRUE(hit({{2, 3, 4}, {2, 3, 4}}, {{2, 3, 4}, {2, 3, 4}}, 0));
  EXPECT_TRUE(hit({{2, 3, 4}, {2, 3, 4}}, {{0, 0, 0}, {5, 5, 5}}, 0));
  EXPECT_TRUE(hit({{0, 0, 0}, {0, 0, 0}}, {{-0.0, -0.0, -0.0}, {-0.0, -0.0, -0.0}}, -0.0));
}

TEST(CubeCube, a_box_inside_another_is_a_hit) {
  EXPECT_TRUE(hit({{-10, -10, -10}, {10, 10, 10}}, {{-1, -2, -3}, {1, 2, 3}}, 0));
  EXPECT_TRUE(hit({{-kLargest, -kLargest, -kLargest}, {kLargest, kLargest, kLargest}}, {{0, 0, 0}, {kLeast, 0, 0}}, 0));
}

TEST(CubeCube, subnormal_gaps_are_exact) {
  EXPECT_TRUE(hit_on_axis({-1, 0}, {kLeast, 1}, kLeast));
  EXPECT_FALSE(hit_on_axis({-1, 0}, {2 * kLeast, 1}, kLeast));
  EXPECT_FALSE(hit_on_axis({-1, 0}, {kLeast, 1}, 0));
  EXPECT_TRUE(hit_on_axis({-1, -kLeast}, {0, 1}, kLeast));
  EXPECT_FALSE(hit_on_axis({-1, -kLeast}, {kLeast, 1}, kLeast));  // 2 * 2^-1074 apart
  EXPECT_FALSE(hit_on_axis({-1, 0x1p-1022}, {0x1p-1022 + 2 * kLeast, 1}, kLeast));
  EXPECT_TRUE(hit_on_axis({-1, 0x1p-1022}, {0x1p-1022 + 2 * kLeast, 1}, 2 * kLeast));
}

// Hostile boxes: raw bits, subnormals, and small grids, many of them exactly or nearly the alarm distance apart.

struct Question {
  Box a;
  Box b;
  double alarm;
};

std::vector<Question> hostile_questions(std::uint64_t seed, int count) {
  std::mt19937_64 random(seed);
  const auto fill = [&](auto number) {
    Question q{};
    for (Box* box : {&q.a, &q.b})
      for (int axis = 0; axis < 3; ++axis) {
        const double x = number();
        const double y = number();
        box->min[axis] = std::min(x, y);
        box->max[axis] = std::max(x, y);
      }
    q.alarm = std::abs(number());
    return q;
  };
  std::vector<Question> questions;
  for (int i = 0; i < count; ++i) {
    Question q;
    if (i % 4 == 0) {
      q = fill([&] { return finite_of(random()); });
    } else if (i % 4 == 1) {
      q = fill([&] { return finite_of(random() & 0x800fffffffffffffU); });
    } else {
      const int exponent = static_cast<int>(random() % 2040) - 1060;
      q = fill([&] { return std::ldexp(static_cast<double>(random() % 13) - 6, exponent); });
      if (i % 4 == 3) {  // one axis a computed alarm distance apart, give or take 2 ulps
        const auto axis = static_cast<int>(random() % 3);
        q.alarm = std::abs(q.alarm) * (1 + static_cast<double>(random() % 7) * 0x1p-52);
        double low = q.a.max[axis] + q.alarm;
        for (auto steps = random() % 3; steps > 0; --steps) low = random() % 2 == 0 ? above(low) : below(low);
        if (std::isfinite(low)) {
          q.b.min[axis] = low;
          q.b.max[axis] = std::max(low, q.b.max[axis]);
        }
      }
    }
    questions.push_back(q);
  }
  return questions;
}

/// The decision in integers of 2^-1074.
bool exact_hit(const Question& q) {
  using boost::multiprecision::cpp_int;
  const auto integer = [](double x) {
    int exponent = 0;
    const cpp_int significand = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
    const int shift = exponent - 53 + 1074;
    return shift >= 0 ? cpp_int(significand << shift) : cpp_int(significand / (cpp_int(1) << -shift));
  };
  for (int axis = 0; axis < 3; ++axis) {
    if (integer(q.a.min[axis]) > integer(q.b.max[axis]) + integer(q.alarm)) return false;
    if (integer(q.b.min[axis]) > integer(q.a.max[axis]) + integer(q.alarm)) return false;
  }
  return true;
}

TEST(CubeCube, decides_as_integers_do_in_every_floating_point_environment) {
  const std::vector<Question> questions = hostile_questions(21, 12000);
  std::vector<bool> expected;
  for (const Question& q : questions) expected.push_back(exact_hit(q));
  const auto hits = std::count(expected.begin(), expected.end(), true);
  EXPECT_GT(hits, 3600);  // 30 to 70 %
  EXPECT_LT(hits, 8400);
  for (const auto& environment : floating_point_environments()) {
    std::vector<bool> actual;
    in_environment(environment, [&] {
      for (const Question& q : questions)
        actual.push_back(environment.traps ? out_of_line::test_cube_cube(q.a, q.b, q.alarm)
                                           : test_cube_cube(q.a, q.b, q.alarm));
    });
    EXPECT_EQ(actual, expected) << environment.name;
  }
}

}  // namespace
}  // namespace contact::cube_cube_test
