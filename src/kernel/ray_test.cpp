// Ray against sphere: worked examples of every feature, and an end that is no number.
#include "contact/ray_sphere.hpp"

#include <gtest/gtest.h>

#include "extreme_numbers.hpp"
#include "kernel/contacts_for_tests.hpp"

namespace contact::ray_test {
namespace {

const Ray kAlongX{{0, 0, 0}, {2, 0, 0}, 2};

TEST(RaySphere, beside_the_side_before_the_origin_and_beyond_the_end) {
  expect_contact(compute_ray_sphere(kAlongX, {{1, 0, 3}, 1}, {2, 0.5}), {0, 0, 1, 1, 0, 0, 1, 0, 2, 1.5},
                 Kind::ordinary);
  expect_contact(compute_ray_sphere(kAlongX, {{-3, 4, 0}, 6}, {0, 0}), {-0.6, 0.8, 0, 0, 0, 0, 3.0 / 5, -0.8, 0, -1},
                 Kind::ordinary);
  expect_contact(compute_ray_sphere(kAlongX, {{7, 0, -4}, 5}, {0, 0}), {0.6, 0, -0.8, 4, 0, 0, 4, 0, 0, 0},
                 Kind::ordinary);
}

// The question that SOFA's ray misses: the centre lies past the end, and the sphere reaches back to it.
TEST(RaySphere, a_sphere_past_the_end_that_reaches_it_is_a_hit) {
  expect_contact(compute_ray_sphere({{0, 0, 0}, {1, 0, 0}, 1}, {{1.5, 0, 0}, 0.75}, {0, 0}),
                 {1, 0, 0, 1, 0, 0, 0.75, 0, 0, -0.25}, Kind::ordinary);
}

TEST(RaySphere, the_direction_need_not_be_a_unit_vector_and_says_nothing_of_length_0) {
  for (const Ray& ray : {Ray{{0, 0, 0}, {4, 0, 0}, 1}, Ray{{0, 0, 0}, {0.5, 0, 0}, 8}, kAlongX})
    expect_contact(compute_ray_sphere(ray, {{7, 0, -4}, 5}, {0, 0}), {0.6, 0, -0.8, 4, 0, 0, 4, 0, 0, 0},
                   Kind::ordinary);
  expect_contact(compute_ray_sphere({{1, 2, 3}, {0, 1, 0}, 0}, {{1, 4, 3}, 1}, {1, 0}), {0, 1, 0, 1, 2, 3, 1, 3, 3, 1},
                 Kind::ordinary);
  // A point on a centre: there is no direction left, whatever the ray's says.
  expect_contact(compute_ray_sphere({{1, 2, 3}, {1, 0, 0}, 0}, {{1, 2, 3}, 1}, {0, 0}), {1, 0, 0, 1, 2, 3, 0, 2, 3, -1},
                 Kind::degenerate);
  expect_contact(compute_ray_sphere(kAlongX, {{1, 0, 0}, 1}, {0, 0}), {0, 1, 0, 1, 0, 0, 1, -1, 0, -1},
                 Kind::degenerate);
}

// 3 times 1/3 as a double is less than 1 by 2^-54: a sphere past the end, without its last bit, is missed.
TEST(RaySphere, the_end_is_not_rounded) {
  const Ray ray{{0, 0, 0}, {1.0 / 3, 0, 0}, 3};
  EXPECT_EQ(3 * ray.direction[0], 1);  // as double computes it
  EXPECT_FALSE(test_ray_sphere(ray, {{2, 0, 0}, 1}, 0));
  EXPECT_TRUE(test_ray_sphere(ray, {{2, 0, 0}, above(1)}, 0));
  // An end beyond the largest number, and one that needs all of the range.
  const Ray beyond{{0, 0, 0}, {kLargest, 0, 0}, kLargest};
  expect_contact(compute_ray_sphere(beyond, {{kLargest, 0, 1}, 1}, {0, 0}),
                 {0, 0, 1, kLargest, 0, 0, kLargest, 0, 0, 0}, Kind::ordinary);
  const Ray least{{0, 0, 0}, {kLeast, 0, 0}, kLeast};
  EXPECT_TRUE(test_ray_sphere(least, {{1, 0, 0}, 1}, 0));
  EXPECT_FALSE(test_ray_sphere(least, {{1, 0, 0}, below(1)}, 0));
  EXPECT_TRUE(test_ray_sphere({{0, 0, 0}, {kLeast, 0, 0}, kLargest}, {{1, 0, 0}, 1}, 0));
}

TEST(RaySphere, touching_counts_and_one_ulp_less_does_not) {
  EXPECT_TRUE(test_ray_sphere(kAlongX, {{1, 0, 3}, 3}, 0));
  EXPECT_FALSE(test_ray_sphere(kAlongX, {{1, 0, 3}, below(3)}, 0));
  EXPECT_TRUE(compute_ray_sphere(kAlongX, {{7, 0, -4}, 4.5}, {0.5, 0}));
  EXPECT_FALSE(compute_ray_sphere(kAlongX, {{7, 0, -4}, 4.5}, {below(0.5), 0}));
}

}  // namespace
}  // namespace contact::ray_test
