// Sphere against sphere: worked examples, the edges of the domain, and the filter's constant from both sides.
#include "contact/sphere_sphere.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "environment/floating_point_environments.hpp"
#include "extreme_numbers.hpp"
#include "kernel/contacts_for_tests.hpp"
#include "kernel/sphere_sphere_filter.hpp"
#include "kernel/sphere_sphere_numbers.hpp"
#include "kernel/sphere_sphere_one_vector.hpp"

namespace contact::sphere_sphere_test {
namespace {

Ball ball(double x, double y, double z, double radius) { return {{x, y, z}, radius}; }

void expect_contact(const std::optional<Contact>& actual, const Vector3& normal, const Vector3& point1,
                    const Vector3& point2, double value, bool degenerate = false) {
  expect_same(actual, Contact{normal, point1, point2, value, degenerate});
}

/// Both functions agree that the pair is a hit, or that it is not.
void expect_hit(bool expected, const Ball& a, const Ball& b, double alarm) {
  EXPECT_EQ(test_sphere_sphere(a, b, alarm), expected);
  EXPECT_EQ(compute_sphere_sphere(a, b, {alarm, 0}).has_value(), expected);
}

TEST(SphereSphere, gives_the_worked_example) {
  // delta (1,2,2) of length 3 = 1.5 + 1.5: touching; n = delta / 3; points 1.5 n; value 3 - 3 - 0.25
  const double third = 1.0 / 3.0;
  const double two_thirds = 2.0 / 3.0;
  expect_contact(compute_sphere_sphere(ball(0, 0, 0, 1.5), ball(1, 2, 2, 1.5), {0, 0.25}),
                 {third, two_thirds, two_thirds}, {0.5, 1, 1}, {0.5, 1, 1}, -0.25);
}

TEST(SphereSphere, touching_counts_and_one_ulp_apart_does_not) {
  const Ball a = ball(0, 0, 0, 1.5);
  expect_hit(true, a, ball(1, 2, 2, 1.5), 0);
  expect_hit(false, a, ball(1, 2, 2, below(1.5)), 0);
  expect_hit(false, a, ball(1, 2, above(2), 1.5), 0);
  expect_hit(false, a, ball(1, above(2), 2, 1.5), 0);
  expect_hit(false, a, ball(above(1), 2, 2, 1.5), 0);
  expect_hit(true, a, ball(1, 2, below(2), 1.5), 0);
  expect_hit(true, a, ball(1, 2, 2, above(1.5)), 0);
}

TEST(SphereSphere, exactly_at_the_alarm_distance_counts) {
  // distance 5 (3-4-5), radii 1 and 2: the gap is 2
  const Ball a = ball(0, 0, 0, 1);
  const Ball b = ball(3, 0, 4, 2);
  expect_hit(true, a, b, 2);
  expect_hit(false, a, b, below(2));
  // n = (0.6, 0, 0.8); point1 = n; point2 = (3,0,4) - 2 n; value 5 - 3 - 0.5
  expect_contact(compute_sphere_sphere(a, b, {2, 0.5}), {0.6, 0, 0.8}, {0.6, 0, 0.8}, {1.8, 0, 2.4}, 1.5);
}

TEST(SphereSphere, no_rounding_of_the_sum_of_lengths_makes_or_loses_a_hit) {
  // distance 1 + 2^-52; reach 1 + 1.5 * 2^-53, which a double rounds up to 1 + 2^-52
  expect_hit(false, ball(0, 0, 0, 1), ball(above(1), 0, 0, 0x1.8p-53), 0);
  expect_hit(true, ball(0, 0, 0, 1), ball(above(1), 0, 0, 0x1p-52), 0);
  // distance 1 + 2^-60, which a double rounds to 1
  expect_hit(false, ball(-0x1p-60, 0, 0, 1), ball(1, 0, 0, 0), 0);
  expect_hit(true, ball(-0x1p-60, 0, 0, 1), ball(1, 0, 0, 0x1p-60), 0);
  expect_hit(true, ball(-0x1p-60, 0, 0, 1), ball(1, 0, 0, 0), 0x1p-60);
}

TEST(SphereSphere, coincident_centres_have_the_normal_1_0_0_and_are_marked) {
  // points (3 + 1, 4, 5) and (3 - 2, 4, 5); value -(1 + 2) - 0.25
  expect_contact(compute_sphere_sphere(ball(3, 4, 5, 1), ball(3, 4, 5, 2), {0, 0.25}), {1, 0, 0}, {4, 4, 5}, {1, 4, 5},
                 -3.25, true);
  expect_contact(compute_sphere_sphere(ball(0, -0.0, 0, 0), ball(-0.0, 0, 0, 0), {0, 0}), {1, 0, 0}, {0, 0, 0},
                 {0, 0, 0}, 0, true);
}

TEST(SphereSphere, centres_that_differ_by_the_smallest_subnormal_do_not_coincide) {
  // D = 2^-2148, beyond any double; n = (0, -1, 0); value 2^-1074 - 2, nearest -2
  expect_contact(compute_sphere_sphere(ball(0, kLeast, 0, 1), ball(0, 0, 0, 1), {0, 0}), {0, -1, 0}, {0, -1, 0},
                 {0, 1, 0}, -2);
}

TEST(SphereSphere, zero_radii_are_points) {
  expect_hit(false, ball(0, 0, 0, 0), ball(kLeast, 0, 0, 0), 0);
  expect_hit(true, ball(0, 0, 0, 0), ball(kLeast, 0, 0, 0), kLeast);
  expect_contact(compute_sphere_sphere(ball(1, 2, 3, 0), ball(1, 2, 4, 0), {1, 0}), {0, 0, 1}, {1, 2, 3}, {1, 2, 4}, 1);
}

TEST(SphereSphere, a_reach_that_overflows_a_double_is_right) {
  // the largest finite number M: distance 2 M = M + M, touching in the origin
  const Ball a = ball(kLargest, 0, 0, kLargest);
  const Ball b = ball(-kLargest, 0, 0, kLargest);
  expect_contact(compute_sphere_sphere(a, b, {0, 0}), {-1, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0);
  const Ball smaller = ball(-kLargest, 0, 0, below(kLargest));  // by 2^971
  expect_hit(false, a, smaller, 0);
  expect_hit(false, a, smaller, below(0x1p971));
  expect_contact(compute_sphere_sphere(a, smaller, {0x1p971, 0}), {-1, 0, 0}, {0, 0, 0}, {-0x1p971, 0, 0}, 0x1p971);
  // reach 3 M: the diagonal of a square of side 2 M, 2.83 M, is within it and that of a cube, 3.46 M, is not
  const double half_root = 0.707106781186547524400844362104849039;  // 1 / sqrt(2)
  const auto diagonal = compute_sphere_sphere(ball(-kLargest, -kLargest, 0, kLargest),
                                              ball(kLargest, kLargest, 0, kLargest), {kLargest, 0});
  ASSERT_TRUE(diagonal);
  EXPECT_EQ(diagonal->normal, Vector3(half_root, half_root, 0));
  expect_hit(false, ball(-kLargest, -kLargest, -kLargest, kLargest), ball(kLargest, kLargest, kLargest, kLargest),
             kLargest);
}

TEST(SphereSphere, an_infinite_alarm_distance_is_no_limit) {
  // the diagonal of a cube of side 2 M, 3.46 M, is beyond every finite alarm; n = (1,1,1) / sqrt(3), value infinite
  const double third_root = 0.577350269189625764509148780501957456;
  const Vector3 corner(kLargest, kLargest, kLargest);
  expect_hit(true, {-corner, 0}, {corner, 0}, kInfinity);
  expect_contact(compute_sphere_sphere({-corner, 0}, {corner, 0}, {kInfinity, 0}), {third_root, third_root, third_root},
                 -corner, corner, kInfinity);
  // and so is 2 M along one axis
  const Ball down = ball(0, -kLargest, 0, 0);
  const Ball up = ball(0, kLargest, 0, 0);
  expect_hit(true, down, up, kInfinity);
  expect_contact(compute_sphere_sphere(down, up, {kInfinity, 0}), {0, 1, 0}, down.center, up.center, kInfinity);
  // distance 5; in units of 2^-1074, too, and less 7 of them
  expect_contact(compute_sphere_sphere(ball(0, 0, 0, 0), ball(3, 0, 4, 0), {kInfinity, 1}), {0.6, 0, 0.8}, {0, 0, 0},
                 {3, 0, 4}, 4);
  expect_contact(compute_sphere_sphere(ball(0, 0, 0, 0), ball(3 * kLeast, 0, 4 * kLeast, 0), {kInfinity, 7 * kLeast}),
                 {0.6, 0, 0.8}, {0, 0, 0}, {3 * kLeast, 0, 4 * kLeast}, -2 * kLeast);
  // Where squares underflow in part: a power of two changes no direction.
  const Vector3 far(0.7123456789012345, -0.1234567890123456, 0.5432109876543211);
  const Vector3 n = compute_sphere_sphere({Vector3::Zero(), 0}, {far, 0}, {kInfinity, 0})->normal;
  for (const double scale :
       {0x1p-440, 0x1p-455, 0x1p-485, 0x1p-505, 0x1p-512, 0x1p-520, 0x1p-525, 0x1p-528, 0x1p-531, 0x1p-535, 0x1p-560})
    for (const double r : {0.0, 1.0})  // points and value of the size of the distance, and of an ordinary one
      EXPECT_EQ(compute_sphere_sphere({Vector3::Zero(), r}, {far * scale, r}, {kInfinity, 0})->normal, n) << scale;
}

TEST(SphereSphere, a_result_beyond_the_largest_finite_number_is_infinite) {
  // point1 = 2^1023 + M; distance M - 2^1023, so value = M - 2^1023 - M = -2^1023
  expect_contact(compute_sphere_sphere(ball(0x1p1023, 0, 0, kLargest), ball(kLargest, 0, 0, 0), {0, 0}), {1, 0, 0},
                 {kInfinity, 0, 0}, {kLargest, 0, 0}, -0x1p1023);
  expect_contact(compute_sphere_sphere(ball(0, 0, 0, kLargest), ball(0, 0, 0, kLargest), {0, kLargest}), {1, 0, 0},
                 {kLargest, 0, 0}, {-kLargest, 0, 0}, -kInfinity, true);
  // -(M + 2^970) is the tie between -M and -2^1024 and goes to infinity; anything less does not
  EXPECT_EQ(compute_sphere_sphere(ball(0, 0, 0, kLargest), ball(0, 0, 0, 0), {0, 0x1p970})->value, -kInfinity);
  EXPECT_EQ(compute_sphere_sphere(ball(0, 0, 0, kLargest), ball(0, 0, 0, 0), {0, below(0x1p970)})->value, -kLargest);
}

TEST(SphereSphere, subnormal_pairs_are_right) {
  // in units of 2^-1074: delta (3,4,0) of length 5 = 2 + 3; point1 = 2 n = (1.2, 1.6), point2 = (3 - 1.8, 4 - 2.4)
  const Ball a = ball(0, 0, 0, 2 * kLeast);
  const Ball b = ball(3 * kLeast, 4 * kLeast, 0, 3 * kLeast);
  expect_contact(compute_sphere_sphere(a, b, {0, 0}), {0.6, 0.8, 0}, {kLeast, 2 * kLeast, 0}, {kLeast, 2 * kLeast, 0},
                 0);
  expect_hit(false, ball(0, 0, 0, kLeast), b, 0);
  expect_hit(true, ball(0, 0, 0, kLeast), b, kLeast);
  // point2 = (3 - 5 * 0.6, 4 - 5 * 0.8) = 0; value 5 - 7 - 1 = -3
  expect_contact(compute_sphere_sphere(a, ball(3 * kLeast, 4 * kLeast, 0, 5 * kLeast), {0, kLeast}), {0.6, 0.8, 0},
                 {kLeast, 2 * kLeast, 0}, {0, 0, 0}, -3 * kLeast);
}

TEST(SphereSphere, a_component_whose_square_underflows_still_decides) {
  // D = 1 + 2^-1200 > 1 = reach^2
  expect_hit(false, ball(0, 0, 0, 0.5), ball(1, 0x1p-600, 0, 0.5), 0);
  // n = (1 - 2^-1201, 2^-600 - 2^-1801, 0) about; value about 2^-1201, below half the smallest subnormal
  expect_contact(compute_sphere_sphere(ball(0, 0, 0, 0.5), ball(1, 0x1p-600, 0, 0.5), {kLeast, 0}), {1, 0x1p-600, 0},
                 {0.5, 0x1p-601, 0}, {0.5, 0x1p-601, 0}, 0);
  // D = 1 + 2^-1000, sqrt(D) = 1 + 2^-1001 - 2^-2003: value nearest 2^-1001, and within that much but for the last term
  const Ball b = ball(1, 0x1p-500, 0, 0.5);
  expect_hit(false, ball(0, 0, 0, 0.5), b, below(0x1p-1001));
  expect_contact(compute_sphere_sphere(ball(0, 0, 0, 0.5), b, {0x1p-1001, 0}), {1, 0x1p-500, 0}, {0.5, 0x1p-501, 0},
                 {0.5, 0x1p-501, 0}, 0x1p-1001);
}

TEST(SphereSphere, every_zero_of_an_answer_is_plus_zero) {
  // expect_contact compares bits, and every expected zero is +0
  expect_contact(compute_sphere_sphere(ball(-0.0, -0.0, -0.0, -0.0), ball(1, -0.0, -0.0, 1), {-0.0, -0.0}), {1, 0, 0},
                 {0, 0, 0}, {0, 0, 0}, 0);
  expect_contact(compute_sphere_sphere(ball(-0.0, -0.0, -0.0, -0.0), ball(-0.0, -0.0, -0.0, -0.0), {-0.0, -0.0}),
                 {1, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0, true);
  // underflow from below: delta_y = -2^-1074 against 2 gives n_y of a hair less than half of it, and point1_y less
  // still
  expect_contact(compute_sphere_sphere(ball(0, 0, 0, 0.5), ball(2, -kLeast, 0, 1.5), {kLeast, 0},
                                       {PointOn::nearest_surface, PointOn::center}),
                 {1, 0, 0}, {0.5, 0, 0}, {2, -kLeast, 0}, 0);
  expect_contact(
      compute_sphere_sphere(ball(-0.0, 0, 0, 1), ball(2, -0.0, 0, 1), {0, 0}, {PointOn::center, PointOn::far_surface}),
      {1, 0, 0}, {0, 0, 0}, {3, 0, 0}, 0);
}

TEST(SphereSphere, points_follow_their_convention_sphere_by_sphere) {
  const Ball a = ball(0, 0, 0, 1);
  const Ball b = ball(3, 4, 0, 2);  // n = (0.6, 0.8, 0)
  const Vector3 n(0.6, 0.8, 0);
  const std::array<PointOn, 3> conventions{PointOn::nearest_surface, PointOn::center, PointOn::far_surface};
  const std::array<Vector3, 3> first{Vector3(0.6, 0.8, 0), Vector3(0, 0, 0), Vector3(-0.6, -0.8, 0)};
  const std::array<Vector3, 3> second{Vector3(1.8, 2.4, 0), Vector3(3, 4, 0), Vector3(4.2, 5.6, 0)};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      expect_contact(compute_sphere_sphere(a, b, {2, 0}, {conventions[i], conventions[j]}), n, first[i], second[j], 2);
}

TEST(SphereSphere, points_of_coincident_centres_follow_their_convention) {
  const auto with = [](PointOn on) {
    return compute_sphere_sphere(ball(7, 0, 0, 1), ball(7, 0, 0, 2), {0, 0}, {on, on});
  };
  expect_contact(with(PointOn::nearest_surface), {1, 0, 0}, {8, 0, 0}, {5, 0, 0}, -3, true);
  expect_contact(with(PointOn::center), {1, 0, 0}, {7, 0, 0}, {7, 0, 0}, -3, true);
  expect_contact(with(PointOn::far_surface), {1, 0, 0}, {6, 0, 0}, {9, 0, 0}, -3, true);
}

TEST(SphereSphere, the_contact_distance_is_taken_from_the_value_before_it_is_rounded) {
  // distance 1, radii 2^-60 and 0, contact 2^-60: 1 - 2^-59, nearest 1; contact 1: -2^-60, exactly
  EXPECT_EQ(compute_sphere_sphere(ball(0, 0, 0, 0x1p-60), ball(1, 0, 0, 0), {1, 0x1p-60})->value, 1.0);
  EXPECT_EQ(compute_sphere_sphere(ball(0, 0, 0, 0x1p-60), ball(1, 0, 0, 0), {1, 1})->value, -0x1p-60);
}

#if CONTACT_HAS_ONE_VECTOR

[[gnu::target("avx2,fma")]] bool settled_by_one_vector(const Ball& a, const Ball& b, double contact_distance,
                                                       Contact& contact) {
  const double dx = b.center[0] - a.center[0];
  const double dy = b.center[1] - a.center[1];
  const double dz = b.center[2] - a.center[2];
  return kernel::one_vector::contact_of_hit(a, b, dx * dx + dy * dy + dz * dz, contact_distance, a.radius, -b.radius,
                                            contact);
}

TEST(OneVector, settles_ordinary_pairs_as_the_other_stages_do_and_leaves_what_cancels) {
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) GTEST_SKIP() << "no such vectors here";
  std::mt19937_64 random(11);
  const auto number = [&random](int low, int high) {
    const double significand = 1 + static_cast<double>(random() >> 12) * 0x1p-52;
    const int exponent = low + static_cast<int>(random() % static_cast<std::uint64_t>(high - low + 1));
    return std::ldexp(random() % 2 == 0 ? significand : -significand, exponent);
  };
  constexpr int kCount = 20000;
  const auto settled = [&](int low, int high, int zeros, bool touching) {
    int count = 0;
    for (int i = 0; i < kCount; ++i) {
      Ball a{{}, std::abs(number(low, high))};
      Ball b{{}, std::abs(number(low, high))};
      for (int axis = zeros; axis < 3; ++axis) {
        a.center[axis] = number(low, high);
        b.center[axis] = number(low, high);
      }
      const double distance = std::abs(number(low, high));
      if (touching) a.radius = std::abs((b.center - a.center).norm() - b.radius - distance);
      Contact contact{};
      if (!settled_by_one_vector(a, b, distance, contact)) continue;
      ++count;
      Contact otherwise{};
      kernel::round_numbers(a, b, distance, {}, kernel::kAllNumbers, otherwise);
      SCOPED_TRACE(i);
      expect_same(contact, otherwise);
    }
    return count;
  };
  EXPECT_GE(settled(0, 3, 0, false), kCount * 0.999);
  EXPECT_GE(settled(0, 30, 0, false), kCount * 0.4);  // some coordinates are small beside the radii
  EXPECT_GE(settled(200, 203, 0, false), kCount * 0.999);
  EXPECT_GE(settled(-400, -398, 0, false), kCount * 0.999);
  EXPECT_LE(settled(0, 3, 0, true), kCount * 0.6);  // the others' values have lost nothing
  settled(-300, 300, 0, false);
  settled(-20, 0, 1, false);  // points on the plane lose everything
}

#endif

// Found by a search over 2^32 radii: r n is so near a double, and the centre so near its negative, that what n is off
// by is an ulp of the point, while the low part that a rounding is tested with is 2^-30 of its usual size. Rounded
// without a look at what was left, the point is one ulp less.
TEST(SphereSphere, a_point_that_cancels_beside_a_low_part_of_hardly_anything_is_right) {
  constexpr double kPoint = 0x1.800000009ad13p-45;  // in arithmetic of 113 bits, and by the exact oracle
  const Vector3 center(-0x1.f4a632bb98e1dp+6, 0, 0);
  const Ball a{center, 0x1.f488c59a59799p+7};
  const Ball b{center + Vector3(33, 57, 4), 1};
  ASSERT_EQ(b.center[0] - a.center[0], 33);
  EXPECT_EQ(compute_sphere_sphere(a, b, {})->point1[0], kPoint);
  EXPECT_EQ(compute_sphere_sphere(b, a, {})->point2[0], kPoint);
}

// Hostile questions: raw bits, subnormals, small grids full of ties, and pairs a few ulps from touching.

struct Question {
  Ball a;
  Ball b;
  Distances distances;
};

class Hostile {
 public:
  explicit Hostile(std::uint64_t seed) : random_(seed) {}

  Question operator()() {
    switch (random_() % 5) {
      case 0:
        return fill([this] { return finite_of(random_()); });
      case 3:
        return fill([this] { return std::ldexp(integer(1 << 30) * 0x1p20 + integer(1 << 20), -50); });
      case 1:
        return fill([this] { return finite_of(random_() & 0x800fffffffffffffU); });
      case 2: {
        const int exponent = static_cast<int>(random_() % 2040) - 1060;
        return fill([this, exponent] { return std::ldexp(integer(9), exponent); });
      }
      default:
        return near_touching();
    }
  }

  /// A pair of ordinary size whose reach is the distance, but for the rounding of it and up to 4 ulps.
  Question near_touching() {
    Question q = fill([this] { return std::ldexp(integer(1 << 30) * 0x1p23 + integer(1 << 23), -50); });
    q.a.radius = std::ldexp(q.a.radius, -4);
    q.b.radius = std::ldexp(q.b.radius, -4);
    q.distances.alarm = (q.b.center - q.a.center).norm() - (q.a.radius + q.b.radius);
    const auto steps = random_() % 9;
    for (std::uint64_t i = 0; i < steps; ++i) q.distances.alarm = above(q.distances.alarm);
    for (int i = 0; i < 4; ++i) q.distances.alarm = below(q.distances.alarm);
    q.distances.alarm = std::max(q.distances.alarm, 0.0);
    return q;
  }

 private:
  double integer(std::int64_t limit) {
    return static_cast<double>(static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(2 * limit + 1)) -
                               limit);
  }
  template <class Number>
  Question fill(Number number) {
    Question q{};
    for (int axis = 0; axis < 3; ++axis) {
      q.a.center[axis] = number();
      q.b.center[axis] = number();
    }
    q.a.radius = std::abs(number());
    q.b.radius = std::abs(number());
    q.distances = {std::abs(number()), std::abs(number())};
    return q;
  }

  std::mt19937_64 random_;
};

std::vector<Question> hostile_questions(std::uint64_t seed, int count) {
  Hostile hostile(seed);
  std::vector<Question> questions;
  for (int i = 0; i < count; ++i) questions.push_back(hostile());
  return questions;
}

TEST(SphereSphere, answers_the_same_in_every_floating_point_environment) {
  const std::vector<Question> questions = hostile_questions(11, 4000);
  const auto hits = std::count_if(questions.begin(), questions.end(),
                                  [](const Question& q) { return test_sphere_sphere(q.a, q.b, q.distances.alarm); });
  EXPECT_GT(hits, 1200);  // the questions are worth asking: 30 to 70 % of them are hits
  EXPECT_LT(hits, 2800);
  for (const ContactPoints points : {ContactPoints{PointOn::nearest_surface, PointOn::far_surface},
                                     ContactPoints{PointOn::center, PointOn::nearest_surface}})
    expect_same_in_every_environment(
        questions, [points](const Question& q, bool traps) { return said(q.a, q.b, q.distances, points, traps); });
}

TEST(SphereSphere, leaves_the_rounding_mode_as_it_found_it) {
  for (const auto& environment : floating_point_environments()) {
    int after = -1;
    in_environment(environment, [&] {
      (void)out_of_line::compute_sphere_sphere(ball(0, 0, 0, 1.5), ball(1, 2, 2, 1.5), {0, 0.25});
      after = std::fegetround();
    });
    EXPECT_EQ(after, environment.rounding) << environment.name;
  }
}

TEST(SphereSphere, swapped_spheres_negate_the_normal_exchange_the_points_and_keep_the_value) {
  int compared = 0;
  for (const Question& q : hostile_questions(12, 3000)) {
    const auto forward = compute_sphere_sphere(q.a, q.b, q.distances);
    const auto backward = compute_sphere_sphere(q.b, q.a, q.distances);
    ASSERT_EQ(forward.has_value(), backward.has_value());
    if (!forward) continue;
    ASSERT_EQ(forward->value, backward->value);
    ASSERT_EQ(forward->degenerate, backward->degenerate);
    if (forward->degenerate) continue;
    ++compared;
    ASSERT_EQ(forward->normal, -backward->normal);
    ASSERT_EQ(forward->point1, backward->point2);
    ASSERT_EQ(forward->point2, backward->point1);
  }
  EXPECT_GT(compared, 900);
}

// The filter. 100 decimal digits hold D and reach^2 of near_touching() exactly.
using Real = boost::multiprecision::cpp_bin_float_100;

struct Sides {
  Real D;
  Real reach2;
};
Sides exact_sides(const Question& q) {
  Sides sides{0, Real(q.distances.alarm) + Real(q.a.radius) + Real(q.b.radius)};
  for (int axis = 0; axis < 3; ++axis) {
    const Real d = Real(q.b.center[axis]) - Real(q.a.center[axis]);
    sides.D += d * d;
  }
  sides.reach2 *= sides.reach2;
  return sides;
}

TEST(SphereSphereFilter, never_decides_wrongly_beside_touching_in_any_rounding_mode) {
  Hostile hostile(13);
  std::vector<Question> questions;
  std::vector<bool> expected;
  for (int i = 0; i < 60000; ++i) {
    questions.push_back(hostile.near_touching());
    const Sides sides = exact_sides(questions.back());
    expected.push_back(sides.D <= sides.reach2);
  }
  const auto hits = std::count(expected.begin(), expected.end(), true);
  EXPECT_GT(hits, 18000);
  EXPECT_LT(hits, 42000);
  for (const auto& environment : floating_point_environments()) {
    std::vector<bool> actual;
    in_environment(environment, [&] {
      for (const Question& q : questions)
        actual.push_back(environment.traps ? out_of_line::test_sphere_sphere(q.a, q.b, q.distances.alarm)
                                           : test_sphere_sphere(q.a, q.b, q.distances.alarm));
    });
    EXPECT_EQ(actual, expected) << environment.name;
  }
}

// The filter's two sides in plain double, in its order of operations. Not inlined: the environment must hold.
#if defined(__GNUC__)
#define CONTACT_NOINLINE __attribute__((noinline))
#else
#define CONTACT_NOINLINE
#endif
CONTACT_NOINLINE std::array<double, 2> plain_sides(const Question& q) {
  const double dx = q.b.center[0] - q.a.center[0];
  const double dy = q.b.center[1] - q.a.center[1];
  const double dz = q.b.center[2] - q.a.center[2];
  const double reach = (q.a.radius + q.b.radius) + q.distances.alarm;
  return {dx * dx + dy * dy + dz * dz, reach * reach};
}

TEST(SphereSphereFilter, its_gap_is_neither_broken_nor_more_than_12_times_too_loose) {
  constexpr double kGap = plain_decision::Bounds<double>::kGap;
  constexpr double u = 0x1p-53;
  Hostile hostile(14);
  std::vector<Question> questions;
  std::vector<Sides> exact;
  for (int i = 0; i < 30000; ++i) {
    questions.push_back(hostile.near_touching());
    exact.push_back(exact_sides(questions.back()));
  }
  double worst = 0;
  for (const auto& environment : floating_point_environments(false)) {
    std::vector<std::array<double, 2>> plain;
    plain.reserve(questions.size());
    in_environment(environment, [&] {
      for (const Question& q : questions) plain.push_back(plain_sides(q));
    });
    double worst_D = 0;
    double worst_reach2 = 0;
    for (std::size_t i = 0; i < plain.size(); ++i) {
      worst_D = std::max(worst_D, std::abs(static_cast<double>(Real(plain[i][0]) / exact[i].D - 1)));
      worst_reach2 = std::max(worst_reach2, std::abs(static_cast<double>(Real(plain[i][1]) / exact[i].reach2 - 1)));
    }
    RecordProperty(environment.name, std::to_string(worst_D / u) + " u and " + std::to_string(worst_reach2 / u) + " u");
    // Five roundings lie on either path: 5.0001 u each to nearest, twice that in a directed mode.
    const double bound = (environment.rounding == FE_TONEAREST ? 5.0001 : 10.0002) * u;
    EXPECT_LE(worst_D, bound) << environment.name;
    EXPECT_LE(worst_reach2, bound) << environment.name;
    worst = std::max({worst, worst_D, worst_reach2});
  }
  // Broken: the gap would not cover what both sides err by, and the last sum.
  EXPECT_GT(kGap, 2 * worst + 2 * u);
  EXPECT_GT(kGap, 22.002 * u);
  // Too loose: more than 12 times what was really seen.
  EXPECT_LT(kGap, 12 * worst) << "worst seen " << worst / u << " u";
}

}  // namespace
}  // namespace contact::sphere_sphere_test
