// Ray against sphere: worked examples of every feature, an end that is no number, every floating-point environment, and
// both stages against each other.
#include "contact/ray_sphere.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "environment/floating_point_environments.hpp"
#include "extreme_numbers.hpp"
#include "kernel/contacts_for_tests.hpp"
#include "kernel/segment_cores.hpp"

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

struct Question {
  Ray a;
  Ball b;
  Distances distances;
};

std::vector<Question> questions(int count) {
  std::mt19937_64 random(20261124);
  std::uniform_real_distribution<double> uniform(-4, 4);
  const auto number = [&](bool small) { return small ? std::floor(uniform(random)) : uniform(random); };
  std::vector<Question> all;
  for (int i = 0; i < count; ++i) {
    const bool small = i % 2 == 0;
    const auto point = [&] { return Vector3(number(small), number(small), number(small)); };
    Question q{
        {point(), point(), std::abs(number(small))}, {point(), std::abs(number(small))}, {i % 3 == 0 ? 1.0 : 0.0, 0.5}};
    if (q.a.direction.isZero(0)) q.a.direction[i % 3] = 1;
    const double part = static_cast<double>(i % 5) / 4;
    if (i % 7 == 1) q.b.center = q.a.origin + part * q.a.length * q.a.direction;
    if (i % 7 == 2) q.a.direction.normalize();
    if (i % 11 == 4) q.a.length = 0;
    const double scale = i % 17 == 6 ? 0x1p-1060 : i % 17 == 7 ? 0x1p900 : 1;
    for (Vector3* x : {&q.a.origin, &q.b.center}) *x *= scale;
    for (double* x : {&q.a.length, &q.b.radius, &q.distances.alarm, &q.distances.contact}) *x *= scale;
    all.push_back(q);
  }
  return all;
}

TEST(RaySphere, the_fast_stage_says_what_the_exact_one_does) {
  int hits = 0;
  for (const Question& q : questions(20000)) {
    const auto contact = compute_ray_sphere(q.a, q.b, q.distances);
    expect_same(contact, computed_exactly(q.a, q.b, q.distances));
    EXPECT_EQ(test_ray_sphere(q.a, q.b, q.distances.alarm), contact.has_value());
    hits += contact ? 1 : 0;
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_GT(hits, 5000);
}

TEST(RaySphere, is_the_same_in_every_floating_point_environment) {
  expect_same_in_every_environment(questions(600), [](const Question& q, bool traps) {
    return traps ? std::pair(out_of_line::compute_ray_sphere(q.a, q.b, q.distances),
                             out_of_line::test_ray_sphere(q.a, q.b, q.distances.alarm))
                 : std::pair(compute_ray_sphere(q.a, q.b, q.distances), test_ray_sphere(q.a, q.b, q.distances.alarm));
  });
}

}  // namespace
}  // namespace contact::ray_test
