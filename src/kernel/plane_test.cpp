// Sphere and capsule against plane: worked examples above, on and below, which end is lower, the ends of the range,
// and that the fast stage answers.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "contact/capsule_plane.hpp"
#include "contact/sphere_plane.hpp"
#include "extreme_numbers.hpp"
#include "kernel/contacts_for_tests.hpp"
#include "kernel/plane_cores.hpp"

namespace contact::plane_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const Plane kFloor{{0, 0, 2}, 4};  // z = 2
const Plane kGround{{0, 0, 1}, 0};

TEST(SpherePlane, above_on_and_below_the_normal_is_the_same_and_the_value_signed) {
  expect_contact(compute_sphere_plane({{1, 2, 5}, 1}, kFloor, {2, 0.5}), {0, 0, -1, 1, 2, 4, 1, 2, 2, 1.5},
                 Kind::ordinary);
  expect_contact(compute_sphere_plane({{1, 2, 2}, 0.5}, kFloor, {0, 0}), {0, 0, -1, 1, 2, 1.5, 1, 2, 2, -0.5},
                 Kind::ordinary);
  expect_contact(compute_sphere_plane({{1, 2, -3}, 1}, kFloor, {0, 0.25}), {0, 0, -1, 1, 2, -4, 1, 2, 2, -6.25},
                 Kind::ordinary);
  expect_contact(compute_sphere_plane({{1, 2, -3}, 0}, kFloor, {0, 0}), {0, 0, -1, 1, 2, -3, 1, 2, 2, -5},
                 Kind::ordinary);
}

TEST(SpherePlane, the_normal_is_of_any_length_and_direction) {
  // (18 - 3) / 3 = 5, and the foot is (2, 3, 5) less 5/3 (1, 2, 2).
  for (const double length : {1.0, 0.25, 3.0})
    expect_contact(compute_sphere_plane({{2, 3, 5}, 6}, {length * Vector3(1, 2, 2), length * 3}, {0, 0}),
                   {-1.0 / 3, -2.0 / 3, -2.0 / 3, 0, -1, 1, 1.0 / 3, -1.0 / 3, 5.0 / 3, -1}, Kind::ordinary);
  // Through the origin, and turned over.
  expect_contact(compute_sphere_plane({{3, -4, 7}, 5}, {{3, -4, 0}, 0}, {0, 0}), {-0.6, 0.8, 0, 0, 0, 7, 0, 0, 7, 0},
                 Kind::ordinary);
  expect_contact(compute_sphere_plane({{3, -4, 7}, 5}, {{-3, 4, 0}, 0}, {0, 0}), {0.6, -0.8, 0, 6, -8, 7, 0, 0, 7, -10},
                 Kind::ordinary);
}

TEST(SpherePlane, what_is_no_dyadic_is_rounded_once) {
  // The plane x + y + z = 1 and the origin below it: the foot is (1, 1, 1) / 3, the distance -sqrt(1/3).
  const auto contact = compute_sphere_plane({{0, 0, 0}, 1}, {{1, 1, 1}, 1}, {0, 0});
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->point2, Vector3(1.0 / 3, 1.0 / 3, 1.0 / 3));
  const double root = 0.577350269189625764509148780502;
  EXPECT_EQ(contact->normal, Vector3(-root, -root, -root));
  EXPECT_EQ(contact->value, -1.577350269189625764509148780502);
  // An offset of 1/3 as a double along an axis of length 3, which it is not an exact multiple of.
  const double third = 1.0 / 3;
  EXPECT_EQ(compute_sphere_plane({{0, 0, 0}, 1}, {{0, 3, 0}, third}, {0, 0})->point2, Vector3(0, third / 3, 0));
}

TEST(SpherePlane, touching_counts_and_one_ulp_less_does_not) {
  EXPECT_TRUE(test_sphere_plane({{1, 2, 5}, 3}, kFloor, 0));
  EXPECT_FALSE(test_sphere_plane({{1, 2, 5}, below(3)}, kFloor, 0));
  EXPECT_TRUE(compute_sphere_plane({{2, 3, 5}, 4.5}, {{1, 2, 2}, 3}, {0.5, 0}));
  EXPECT_FALSE(compute_sphere_plane({{2, 3, 5}, 4.5}, {{1, 2, 2}, 3}, {below(0.5), 0}));
  // Without a radius: on it, and the least above it.
  EXPECT_TRUE(test_sphere_plane({{1, 2, 0}, 0}, kGround, 0));
  EXPECT_FALSE(test_sphere_plane({{1, 2, kLeast}, 0}, kGround, 0));
  EXPECT_TRUE(test_sphere_plane({{1, 2, -kLeast}, 0}, kGround, 0));
}

TEST(SpherePlane, points_lie_where_the_convention_says) {
  const auto at = [](PointOn on) { return compute_sphere_plane({{1, 2, 5}, 4}, kFloor, {0, 0}, {on, on}); };
  EXPECT_EQ(at(PointOn::center)->point1, Vector3(1, 2, 5));
  EXPECT_EQ(at(PointOn::far_surface)->point1, Vector3(1, 2, 9));
  for (const PointOn on : {PointOn::nearest_surface, PointOn::center, PointOn::far_surface})
    EXPECT_EQ(at(on)->point2, Vector3(1, 2, 2));
}

TEST(SpherePlane, normals_and_offsets_reach_the_ends_of_the_range) {
  for (const double n : {kLeast, 0x1p-600, 0x1p600, kLargest})
    expect_contact(compute_sphere_plane({{1, 0, 0}, 1}, {{n, 0, 0}, 0}, {0, 0}), {-1, 0, 0, 0, 0, 0, 0, 0, 0, 0},
                   Kind::ordinary);
  const double root = 0.577350269189625764509148780502;
  const auto steep = compute_sphere_plane({{0, 0, 0}, 1}, {{kLargest, kLargest, kLargest}, 0}, {0, 0});
  ASSERT_TRUE(steep);
  EXPECT_EQ(steep->normal, Vector3(-root, -root, -root));
  // A plane farther away than any number.
  expect_contact(compute_sphere_plane({{0, 0, 0}, 1}, {{kLeast, 0, 0}, kLargest}, {0, 0}),
                 {-1, 0, 0, -1, 0, 0, kInfinity, 0, 0, -kInfinity}, Kind::ordinary);
  EXPECT_FALSE(test_sphere_plane({{0, 0, 0}, kLargest}, {{kLeast, 0, 0}, -kLargest}, kLargest));
  // A component that the others drown, so that no sum of doubles sees it, and a coordinate that it meets.
  EXPECT_FALSE(test_sphere_plane({{0, 0x1p300, 1}, 1}, {{0, 0x1p-300, 1}, 0}, 1 - 0x1p-53));
  EXPECT_TRUE(test_sphere_plane({{0, 0x1p300, 1}, 1}, {{0, 0x1p-300, 1}, 0}, 1));
}

// n = (1.1, 2^-60, 0): the square of the second component is lost beside the first's, its product with 2^60 is not.
TEST(SpherePlane, a_normal_that_is_nearly_along_an_axis_is_not_taken_for_one_that_is) {
  for (const double tiny : {0x1p-40, 0x1p-60, 0x1p-99}) {
    const Plane plane{{1.1, tiny, 0}, 2.2};
    const Ball ball{{5, 1 / tiny, 0}, 100};
    const auto contact = compute_sphere_plane(ball, plane, {0, 0});
    expect_same(contact, computed_exactly(ball, plane, {0, 0}));
    EXPECT_NEAR(contact->point2[0], 2 - 1 / 1.1, 1e-9);
  }
}

TEST(CapsulePlane, the_lower_end_counts_and_both_where_they_are_level) {
  const Plane wall{{-1, 0, 0}, -8};  // x >= 8 lies in it
  expect_contact(compute_capsule_plane({{0, 0, 3}, {4, 0, 1}, 1}, kGround, {0, 0}), {0, 0, -1, 4, 0, 0, 4, 0, 0, 0},
                 Kind::ordinary);
  expect_contact(compute_capsule_plane({{4, 0, 1}, {0, 0, 3}, 1}, kGround, {0, 0}), {0, 0, -1, 4, 0, 0, 4, 0, 0, 0},
                 Kind::ordinary);
  expect_contact(compute_capsule_plane({{0, 0, 3}, {4, 0, 1}, 4}, wall, {0, 0}), {1, 0, 0, 8, 0, 1, 8, 0, 1, 0},
                 Kind::ordinary);
  expect_contact(compute_capsule_plane({{0, 0, 2}, {3, 0, 2}, 2}, kGround, {0, 0.5}),
                 {0, 0, -1, 1.5, 0, 0, 1.5, 0, 0, -0.5}, Kind::many);
  expect_contact(compute_capsule_plane({{0, 0, -2}, {3, 0, -2}, 2}, kGround, {0, 0}),
                 {0, 0, -1, 1.5, 0, -4, 1.5, 0, 0, -4}, Kind::many);
  expect_contact(compute_capsule_plane({{0, 0, 2}, {3, 0, below(2)}, 2}, kGround, {0, 0}, {PointOn::center, {}}),
                 {0, 0, -1, 3, 0, below(2), 3, 0, 0, below(2) - 2}, Kind::ordinary);
  expect_contact(compute_capsule_plane({{1, 2, 2}, {1, 2, 2}, 2}, kGround, {0, 0}), {0, 0, -1, 1, 2, 0, 1, 2, 0, 0},
                 Kind::ordinary);
  // Level to a plane that leans: n = (3, 0, 4), u = (4, 0, -3).
  expect_contact(compute_capsule_plane({{0, 0, 5}, {8, 0, -1}, 4}, {{3, 0, 4}, 0}, {0, 0}),
                 {-0.6, 0, -0.8, 1.6, 0, -1.2, 1.6, 0, -1.2, 0}, Kind::many);
}

// A third as a double is less than one by 2^-54 / 3, so that the end is lower; in double both are level.
TEST(CapsulePlane, which_end_is_lower_is_not_rounded) {
  const Plane plane{{1.0 / 3, 0, -1}, 10};
  const Capsule capsule{{0, 0, 0}, {3, 0, 1}, 0};
  EXPECT_EQ(plane.normal.dot(capsule.end), 0);  // as double computes it
  const auto contact = compute_capsule_plane(capsule, plane, {0, 0});
  ASSERT_TRUE(contact);
  EXPECT_TRUE(contact->unique);
  EXPECT_EQ(contact->point1, capsule.end);
  const Capsule turned{{3, 0, 1}, {0, 0, 0}, 0};
  EXPECT_EQ(compute_capsule_plane(turned, plane, {0, 0})->point1, turned.start);
}

TEST(CapsulePlane, the_middle_is_not_rounded_but_once) {
  // 2^53 + 1 and 2^53 + 3 are half way between two numbers: to even.
  const auto middle = [](double start, double end) {
    return compute_capsule_plane({{start, 0, 1}, {end, 0, 1}, 1}, kGround, {0, 0})->point1[0];
  };
  EXPECT_EQ(middle(0x1p53, 0x1p53 + 2), 0x1p53);
  EXPECT_EQ(middle(0x1p53 + 2, 0x1p53 + 4), 0x1p53 + 4);
  EXPECT_EQ(middle(kLargest, kLargest), kLargest);
  EXPECT_EQ(middle(kLeast, 2 * kLeast), 2 * kLeast);
  EXPECT_EQ(middle(0, kLeast), 0);
}

// Nine of ten ordinary questions, and those about floors and walls, need no exact stage.
TEST(PlaneStages, the_fast_stage_settles_ordinary_questions) {
  std::mt19937_64 random(20261126);
  std::uniform_real_distribution<double> uniform(-4, 4);
  int settled = 0;
  constexpr int kCount = 2000;
  for (int i = 0; i < kCount; ++i) {
    const auto point = [&] { return Vector3(uniform(random), uniform(random), uniform(random)); };
    kernel::Segment segment{point(), point()};
    kernel::HalfSpace plane{point(), uniform(random)};
    if (i % 2 == 0) {
      plane = {Vector3::Unit(i % 3), i % 4 == 0 ? 0 : plane.offset};
      if (i % 5 == 0) segment.end[i % 3] = segment.start[i % 3];
    }
    kernel::ApproximateLowest lowest;
    ASSERT_TRUE(find_nearest(segment, plane, lowest));
    const kernel::Lengths lengths{std::abs(uniform(random)), 0, 0, 0};
    Contact contact;
    settled += round_certain(kernel::ApproximateOverPlane(lowest, lengths), lengths, {}, contact) == 0 ? 1 : 0;
  }
  EXPECT_GT(settled, kCount * 9 / 10);
}

}  // namespace
}  // namespace contact::plane_test
