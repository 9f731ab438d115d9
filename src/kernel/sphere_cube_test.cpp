// Sphere against cube: worked examples of every region, the choice of a face, the ends of the range and every
// floating-point environment.
#include "contact/sphere_cube.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "extreme_numbers.hpp"
#include "kernel/contacts_for_tests.hpp"

namespace contact::sphere_cube_test {
namespace {

const Box kUnit{{0, 0, 0}, {1, 1, 1}};

/// Ten numbers, and that no zero is negative.
void expect_contact(const Ball& a, const Box& b, Distances distances, const TenNumbers& expected, bool degenerate) {
  EXPECT_TRUE(test_sphere_cube(a, b, distances.alarm));
  const auto contact = compute_sphere_cube(a, b, distances);
  ASSERT_TRUE(contact);
  expect_same(numbers_of(*contact), expected);
  EXPECT_EQ(contact->degenerate, degenerate);
}

TEST(SphereCube, beside_a_face_an_edge_and_a_corner) {
  // 2 above a face.
  expect_contact({{0.5, 0.25, 3}, 1.5}, kUnit, {1, 0.25}, {0, 0, -1, 0.5, 0.25, 1.5, 0.5, 0.25, 1, 0.25}, false);
  // 3 and 4 beyond an edge: the distance is 5, the normal (-0.6, 0, 0.8) rounded.
  expect_contact({{4, 0.5, -4}, 5}, kUnit, {0, 0}, {-0.6, 0, 0.8, 1, 0.5, 0, 1, 0.5, 0, 0}, false);
  // 1, 2 and 2 beyond a corner: the distance is 3.
  expect_contact({{-1, -2, 3}, 6}, kUnit, {0, 0}, {1.0 / 3, 2.0 / 3, -2.0 / 3, 1, 2, -1, 0, 0, 1, -3}, false);
}

TEST(SphereCube, touching_counts_and_one_ulp_less_does_not) {
  EXPECT_TRUE(test_sphere_cube({{0.5, 0.5, 3}, 2}, kUnit, 0));
  EXPECT_FALSE(test_sphere_cube({{0.5, 0.5, 3}, below(2)}, kUnit, 0));
  EXPECT_TRUE(test_sphere_cube({{0.5, 0.5, 3}, 1.5}, kUnit, 0.5));
  EXPECT_FALSE(compute_sphere_cube({{0.5, 0.5, 3}, 1.5}, kUnit, {below(0.5), 0}));
  EXPECT_TRUE(test_sphere_cube({{-1, -2, 3}, 3}, kUnit, 0));
  EXPECT_FALSE(test_sphere_cube({{-1, -2, above(3)}, 3}, kUnit, 0));
}

TEST(SphereCube, a_centre_inside_leaves_through_the_nearest_face) {
  expect_contact({{0.25, 0.5, 0.5}, 1.5}, kUnit, {1, 0.25}, {1, 0, 0, 1.75, 0.5, 0.5, 0, 0.5, 0.5, -2}, true);
  expect_contact({{0.5, 0.5, 0.875}, 2}, kUnit, {0, 0}, {0, 0, -1, 0.5, 0.5, -1.125, 0.5, 0.5, 1, -2.125}, true);
  expect_contact({{0.5, 0.9375, 0.125}, 0}, kUnit, {0, 0}, {0, -1, 0, 0.5, 0.9375, 0.125, 0.5, 1, 0.125, -0.0625},
                 true);
}

TEST(SphereCube, of_faces_as_near_the_first_axis_and_its_lower_bound_are_taken) {
  expect_contact({{0.5, 0.5, 0.5}, 1}, kUnit, {0, 0}, {1, 0, 0, 1.5, 0.5, 0.5, 0, 0.5, 0.5, -1.5}, true);
  expect_contact({{0.75, 0.25, 0.25}, 1}, kUnit, {0, 0}, {-1, 0, 0, -0.25, 0.25, 0.25, 1, 0.25, 0.25, -1.25}, true);
  expect_contact({{0.5, 0.75, 0.25}, 1}, kUnit, {0, 0}, {0, -1, 0, 0.5, -0.25, 0.25, 0.5, 1, 0.25, -1.25}, true);
  // As near but for one ulp, which no rounded difference sees: 1 - x and y, y the next number above it.
  const double x = 1 - 0x1p-53;
  expect_contact({{x, 0x1p-53, 0.5}, 0}, kUnit, {0, 0}, {-1, 0, 0, x, 0x1p-53, 0.5, 1, 0x1p-53, 0.5, -0x1p-53}, true);
  expect_contact({{x, below(0x1p-53), 0.5}, 0}, kUnit, {0, 0},
                 {0, 1, 0, x, below(0x1p-53), 0.5, x, 0, 0.5, -below(0x1p-53)}, true);
}

TEST(SphereCube, a_centre_on_a_corner_of_a_flat_box_has_a_depth_of_zero) {
  expect_contact({{1, 1, 1}, 2}, kUnit, {0, 0.5}, {-1, 0, 0, -1, 1, 1, 1, 1, 1, -2.5}, true);
  expect_contact({{3, 3, 3}, 2}, {{3, 3, 3}, {3, 3, 3}}, {0, 0}, {1, 0, 0, 5, 3, 3, 3, 3, 3, -2}, true);
  expect_contact({{-0.0, -0.0, -0.0}, 0}, {{-0.0, -0.0, -0.0}, {-0.0, -0.0, -0.0}}, {0, 0},
                 {1, 0, 0, 0, 0, 0, 0, 0, 0, 0}, true);
}

TEST(SphereCube, point_conventions_move_the_sphere_s_point_alone) {
  const Ball a{{0.5, 0.5, 3}, 1.5};
  EXPECT_EQ(compute_sphere_cube(a, kUnit, {1, 0}, {PointOn::center, PointOn::center})->point1, a.center);
  EXPECT_EQ(compute_sphere_cube(a, kUnit, {1, 0}, {PointOn::far_surface, PointOn::far_surface})->point1,
            Vector3(0.5, 0.5, 4.5));
  EXPECT_EQ(compute_sphere_cube(a, kUnit, {1, 0}, {PointOn::far_surface, PointOn::far_surface})->point2,
            Vector3(0.5, 0.5, 1));
  const Ball inside{{0.25, 0.5, 0.5}, 1};
  EXPECT_EQ(compute_sphere_cube(inside, kUnit, {0, 0}, {PointOn::center, PointOn::center})->point1, inside.center);
  EXPECT_EQ(compute_sphere_cube(inside, kUnit, {0, 0}, {PointOn::far_surface, PointOn::center})->point1,
            Vector3(-0.75, 0.5, 0.5));
}

// Half a last place below 1, and less by what two numbers cannot hold beside these.
TEST(SphereCube, a_value_that_the_smallest_of_four_numbers_decides_is_rounded_once) {
  const Ball ball{{0, 0.5, 0.5}, 0x1p-54};
  const Box box{{1, 0, 0}, {2, 1, 1}};
  expect_contact(ball, box, {2, 0}, {1, 0, 0, 0x1p-54, 0.5, 0.5, 1, 0.5, 0.5, 1}, false);
  expect_contact(ball, box, {2, 0x1p-120}, {1, 0, 0, 0x1p-54, 0.5, 0.5, 1, 0.5, 0.5, 1 - 0x1p-53}, false);
}

TEST(SphereCube, is_right_at_both_ends_of_the_range) {
  const Box everything{{-kLargest, -kLargest, -kLargest}, {kLargest, kLargest, kLargest}};
  // As far from all faces: the depth is the largest number, and with the radius it is beyond the range.
  expect_contact({{0, 0, 0}, 0}, everything, {0, 0}, {1, 0, 0, 0, 0, 0, -kLargest, 0, 0, -kLargest}, true);
  expect_contact({{0, 0, 0}, kLargest}, everything, {0, 0}, {1, 0, 0, kLargest, 0, 0, -kLargest, 0, 0, -kInfinity},
                 true);
  const Box tiny{{0, 0, 0}, {kLeast, kLeast, kLeast}};
  expect_contact({{0, 2 * kLeast, 0}, kLeast}, tiny, {0, 0}, {0, -1, 0, 0, kLeast, 0, 0, kLeast, 0, 0}, false);
  EXPECT_FALSE(test_sphere_cube({{0, 3 * kLeast, 0}, kLeast}, tiny, 0));
  EXPECT_FALSE(test_sphere_cube({{kLargest, kLargest, kLargest}, kLargest}, {{-1, -1, -1}, {1, 1, 1}}, kLeast));
}

/// Questions of every region, by sums of which rounding modes differ.
struct Question {
  Ball a;
  Box b;
  Distances distances;
};
std::vector<Question> questions() {
  std::vector<Question> all;
  for (const double scale : {1.0, 0x1p-1060, 0x1p900})
    for (int place = 0; place < 125; ++place) {
      Question q{{{}, 0.7 * scale}, {{}, {}}, {0.3 * scale, 0.1 * scale}};
      for (int axis = 0, rest = place; axis < 3; ++axis, rest /= 5) {
        q.b.min[axis] = (0.1 + axis) * scale;
        q.b.max[axis] = (1.3 + axis) * scale;
        const std::array<double, 5> at{-0.2 * scale, q.b.min[axis], (0.4 + axis) * scale, q.b.max[axis],
                                       (1.6 + axis) * scale};
        q.a.center[axis] = at[static_cast<std::size_t>(rest % 5)];
      }
      all.push_back(q);
    }
  return all;
}

TEST(SphereCube, is_the_same_in_every_floating_point_environment) {
  expect_same_in_every_environment(
      questions(), [](const Question& q, bool traps) { return said(q.a, q.b, q.distances, {}, traps); });
}

}  // namespace
}  // namespace contact::sphere_cube_test
