// Sphere against capsule and capsule against capsule: worked examples of every feature, the choices by agreement, and
// the ends of the range.
#include "contact/capsule_capsule.hpp"
#include "contact/sphere_capsule.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>

#include "contact/sphere_sphere.hpp"
#include "extreme_numbers.hpp"
#include "kernel/contacts_for_tests.hpp"

namespace contact::capsule_test {
namespace {

const Capsule kAxis{{0, 0, 0}, {4, 0, 0}, 1};

TEST(SphereCapsule, beside_the_side_and_beyond_either_end) {
  expect_contact(compute_sphere_capsule({{1, 0, 3}, 1}, kAxis, {2, 0.5}), {0, 0, -1, 1, 0, 2, 1, 0, 1, 0.5},
                 Kind::ordinary);
  expect_contact(compute_sphere_capsule({{-3, 4, 0}, 5}, kAxis, {0, 0}), {0.6, -0.8, 0, 0, 0, 0, -0.6, 0.8, 0, -1},
                 Kind::ordinary);
  expect_contact(compute_sphere_capsule({{7, 0, -4}, 5}, kAxis, {0, 0}), {-0.6, 0, 0.8, 4, 0, 0, 4.6, 0, -0.8, -1},
                 Kind::ordinary);
}

TEST(SphereCapsule, a_foot_that_is_no_dyadic_is_rounded_once) {
  // Axis (1, 1, 1), centre (1, 0, 0): the foot is (1, 1, 1) / 3, the distance sqrt(6) / 3.
  const auto contact = compute_sphere_capsule({{1, 0, 0}, 1}, {{0, 0, 0}, {1, 1, 1}, 0}, {0, 0});
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->point2, Vector3(1.0 / 3, 1.0 / 3, 1.0 / 3));
  // -2 / sqrt(6), 1 / sqrt(6) and sqrt(6) / 3 - 1 to 30 digits.
  EXPECT_EQ(contact->normal, Vector3(-0.816496580927726032732428024902, 0.408248290463863016366214012451,
                                     0.408248290463863016366214012451));
  EXPECT_EQ(contact->value, -0.183503419072273967267571975098);
}

TEST(SphereCapsule, touching_counts_and_one_ulp_less_does_not) {
  EXPECT_TRUE(test_sphere_capsule({{1, 0, 3}, 2}, kAxis, 0));
  EXPECT_FALSE(test_sphere_capsule({{1, 0, 3}, below(2)}, kAxis, 0));
  EXPECT_TRUE(compute_sphere_capsule({{1, 0, 3}, 1.5}, kAxis, {0.5, 0}));
  EXPECT_FALSE(compute_sphere_capsule({{1, 0, 3}, 1.5}, kAxis, {below(0.5), 0}));
  // The distance from (1, 0, 0) to the diagonal is sqrt(2/3) = 0.816496580927726032732..., between two doubles.
  const Capsule diagonal{{0, 0, 0}, {1, 1, 1}, 0};
  const double nearest = 0.816496580927726032732428024902;
  const boost::multiprecision::cpp_rational r(nearest);
  const bool nearest_is_above = 3 * r * r > 2;
  EXPECT_EQ(test_sphere_capsule({{1, 0, 0}, nearest}, diagonal, 0), nearest_is_above);
  EXPECT_TRUE(test_sphere_capsule({{1, 0, 0}, above(nearest)}, diagonal, 0));
  EXPECT_FALSE(test_sphere_capsule({{1, 0, 0}, below(nearest)}, diagonal, 0));
}

TEST(SphereCapsule, a_centre_on_the_axis_leaves_at_right_angles) {
  expect_contact(compute_sphere_capsule({{1, 0, 0}, 1}, kAxis, {0, 0}), {0, 1, 0, 1, 1, 0, 1, -1, 0, -2},
                 Kind::degenerate);
  // Along (0, 3, 4) the x axis is at right angles already; along (1, 1, 0) it is (1, -1, 0) / sqrt(2).
  expect_contact(compute_sphere_capsule({{0, 3, 4}, 2}, {{0, 0, 0}, {0, 3, 4}, 1}, {0, 0.5}),
                 {1, 0, 0, 2, 3, 4, -1, 3, 4, -3.5}, Kind::degenerate);
  const double half = 0.707106781186547524400844362105;
  expect_contact(compute_sphere_capsule({{1, 1, 0}, 0}, {{0, 0, 0}, {2, 2, 0}, 0}, {0, 0}),
                 {half, -half, 0, 1, 1, 0, 1, 1, 0, 0}, Kind::degenerate);
}

TEST(SphereCapsule, a_capsule_without_length_is_a_sphere) {
  const Ball a{{1, 2, 3}, 1};
  const Capsule point{{2, 4, 5}, {2, 4, 5}, 3};
  const auto contact = compute_sphere_capsule(a, point, {0, 0.25});
  const auto spheres = compute_sphere_sphere(a, {{2, 4, 5}, 3}, {0, 0.25});
  ASSERT_TRUE(contact && spheres);
  expect_same(numbers_of(*contact), numbers_of(*spheres));
  expect_contact(compute_sphere_capsule({{2, 4, 5}, 1}, point, {0, 0}), {1, 0, 0, 3, 4, 5, -1, 4, 5, -4},
                 Kind::degenerate);
}

TEST(CapsuleCapsule, sides_ends_and_an_end_beside_a_side_face_each_other) {
  // Crossing at a distance of 3, within both.
  expect_contact(compute_capsule_capsule(kAxis, {{1, -2, 3}, {1, 2, 3}, 1}, {1, 0}), {0, 0, 1, 1, 0, 1, 1, 0, 2, 1},
                 Kind::ordinary);
  // The end (7, 4, 0) of the second and the end (4, 0, 0) of the first.
  expect_contact(compute_capsule_capsule(kAxis, {{7, 4, 0}, {9, 9, 0}, 4}, {0, 0}),
                 {0.6, 0.8, 0, 4.6, 0.8, 0, 4.6, 0.8, 0, 0}, Kind::ordinary);
  expect_contact(compute_capsule_capsule(kAxis, {{2, 2, 0}, {2, 9, 0}, 1}, {0, 0}), {0, 1, 0, 2, 1, 0, 2, 1, 0, 0},
                 Kind::ordinary);
}

TEST(CapsuleCapsule, both_parameters_are_clamped_together) {
  // Each clamped alone gives D = 5: the end (0, 2, 0) and the end (0, 0, 0) or (1, 0, 0). D is 2.5: the foot of (1, 0,
  // 0).
  const Capsule a{{0, 0, 0}, {1, 0, 0}, 1};
  const auto contact = compute_capsule_capsule(a, {{3, 1, 0}, {0, 2, 0}, 1}, {0, 0});
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->normal, Vector3(0.316227766016837933199889354443, 0.948683298050513799599668063330, 0));
  EXPECT_EQ(contact->value, -0.418861169915810334000553227784);  // sqrt(2.5) - 2
}

TEST(CapsuleCapsule, side_by_side_the_middle_is_taken) {
  expect_contact(compute_capsule_capsule(kAxis, {{1, 0, 2}, {9, 0, 2}, 1}, {0, 0}), {0, 0, 1, 2.5, 0, 1, 2.5, 0, 1, 0},
                 Kind::many);
  expect_contact(compute_capsule_capsule(kAxis, {{9, 0, 2}, {1, 0, 2}, 1}, {0, 0}), {0, 0, 1, 2.5, 0, 1, 2.5, 0, 1, 0},
                 Kind::many);
  // In one point only, and not at all.
  expect_contact(compute_capsule_capsule(kAxis, {{4, 0, 2}, {9, 0, 2}, 1}, {0, 0}), {0, 0, 1, 4, 0, 1, 4, 0, 1, 0},
                 Kind::ordinary);
  expect_contact(compute_capsule_capsule(kAxis, {{9, 4, 0}, {7, 4, 0}, 4}, {0, 0}),
                 {0.6, 0.8, 0, 4.6, 0.8, 0, 4.6, 0.8, 0, 0}, Kind::ordinary);
}

TEST(CapsuleCapsule, axes_that_meet_leave_across_both) {
  expect_contact(compute_capsule_capsule(kAxis, {{1, -2, 0}, {1, 2, 0}, 2}, {0, 0}), {0, 0, 1, 1, 0, 1, 1, 0, -2, -3},
                 Kind::degenerate);
  expect_contact(compute_capsule_capsule(kAxis, {{1, 2, 0}, {1, -2, 0}, 2}, {0, 0}), {0, 0, 1, 1, 0, 1, 1, 0, -2, -3},
                 Kind::degenerate);
  // On one line: the middle of what they share.
  expect_contact(compute_capsule_capsule(kAxis, {{2, 0, 0}, {6, 0, 0}, 2}, {0, 0.5}),
                 {0, 1, 0, 3, 1, 0, 3, -2, 0, -3.5}, Kind::degenerate_and_many);
  expect_contact(compute_capsule_capsule(kAxis, {{4, 0, 0}, {6, 0, 0}, 2}, {0, 0.5}),
                 {0, 1, 0, 4, 1, 0, 4, -2, 0, -3.5}, Kind::degenerate);
}

TEST(Capsules, point_conventions_move_the_points_along_the_normal) {
  const Capsule other{{1, -2, 3}, {1, 2, 3}, 1};
  const auto at = [&](PointOn first, PointOn second) {
    return *compute_capsule_capsule(kAxis, other, {1, 0}, {first, second});
  };
  EXPECT_EQ(at(PointOn::center, PointOn::center).point1, Vector3(1, 0, 0));
  EXPECT_EQ(at(PointOn::center, PointOn::center).point2, Vector3(1, 0, 3));
  EXPECT_EQ(at(PointOn::far_surface, PointOn::far_surface).point1, Vector3(1, 0, -1));
  EXPECT_EQ(at(PointOn::far_surface, PointOn::far_surface).point2, Vector3(1, 0, 4));
}

TEST(Capsules, are_right_at_both_ends_of_the_range) {
  const Capsule longest{{-kLargest, -kLargest, -kLargest}, {kLargest, kLargest, kLargest}, 0};
  // The foot of (0, 0, h) on the diagonal is (h, h, h) / 3; h / 3 is a number here.
  const double h = 3 * 0x1p1000;
  const auto contact = compute_sphere_capsule({{0, 0, h}, kLargest}, longest, {0, 0});
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->point2, Vector3(0x1p1000, 0x1p1000, 0x1p1000));
  const Capsule least{{0, 0, 0}, {kLeast, 0, 0}, kLeast};
  EXPECT_TRUE(test_capsule_capsule(least, {{kLeast, 2 * kLeast, 0}, {kLeast, 9 * kLeast, 0}, kLeast}, 0));
  EXPECT_FALSE(test_capsule_capsule(least, {{kLeast, 3 * kLeast, 0}, {kLeast, 9 * kLeast, 0}, kLeast}, 0));
}

}  // namespace
}  // namespace contact::capsule_test
