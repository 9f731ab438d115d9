// Sphere against triangle: worked examples of every feature, the choices by agreement, the ends of the range, and
// that the fast stage answers.
#include "contact/sphere_triangle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "extreme_numbers.hpp"
#include "kernel/contacts_for_tests.hpp"
#include "kernel/triangle_cores.hpp"

namespace contact::triangle_test {
namespace {

const Triangle kFlat{{Vector3(0, 0, 0), Vector3(4, 0, 0), Vector3(0, 4, 0)}};

TEST(SphereTriangle, above_and_below_the_face) {
  expect_contact(compute_sphere_triangle({{1, 1, 3}, 1}, kFlat, {2, 0.5}), {0, 0, -1, 1, 1, 2, 1, 1, 0, 1.5},
                 Kind::ordinary);
  expect_contact(compute_sphere_triangle({{1, 1, -3}, 4}, kFlat, {0, 0}), {0, 0, 1, 1, 1, 1, 1, 1, 0, -1},
                 Kind::ordinary);
}

TEST(SphereTriangle, beyond_each_edge_and_each_vertex) {
  expect_contact(compute_sphere_triangle({{2, -3, 4}, 5}, kFlat, {0, 0}), {0, 0.6, -0.8, 2, 0, 0, 2, 0, 0, 0},
                 Kind::ordinary);
  expect_contact(compute_sphere_triangle({{-3, 1, -4}, 10}, kFlat, {0, 0}), {0.6, 0, 0.8, 3, 1, 4, 0, 1, 0, -5},
                 Kind::ordinary);
  // The third edge is nearest at (2, 2, 0), along (1, 1, 0).
  const auto third = compute_sphere_triangle({{5, 5, 0}, 6}, kFlat, {0, 0});
  ASSERT_TRUE(third);
  EXPECT_EQ(third->point2, Vector3(2, 2, 0));
  expect_contact(compute_sphere_triangle({{-2, -1, 2}, 3}, kFlat, {0, 0}),
                 {2.0 / 3, 1.0 / 3, -2.0 / 3, 0, 0, 0, 0, 0, 0, 0}, Kind::ordinary);
  expect_contact(compute_sphere_triangle({{7, 0, 4}, 5}, kFlat, {0, 0}), {-0.6, 0, -0.8, 4, 0, 0, 4, 0, 0, 0},
                 Kind::ordinary);
  expect_contact(compute_sphere_triangle({{0, 7, -4}, 5}, kFlat, {0, 0}), {0, -0.6, 0.8, 0, 4, 0, 0, 4, 0, 0},
                 Kind::ordinary);
}

// The angle at (0, 0, 0) is wider than a right one: beyond two of its edges, the first has the foot.
TEST(SphereTriangle, beyond_two_edges_of_a_wide_angle_one_edge_or_the_vertex_is_nearest) {
  const Triangle wide{{Vector3(0, 0, 0), Vector3(4, 0, 0), Vector3(-4, 1, 0)}};
  const auto nearest = [&](const Vector3& c) { return compute_sphere_triangle({c, 9}, wide, {0, 0})->point2; };
  EXPECT_EQ(nearest({1, -2, 0}), Vector3(1, 0, 0));
  EXPECT_EQ(nearest({-0.25, -2, 0}), Vector3(0, 0, 0));
  // (-1, -1.75) is 2.25 / 17 of the way along (-4, 1).
  EXPECT_EQ(nearest({-1, -1.75, 0}), Vector3(-9.0 / 17, 2.25 / 17, 0));
}

TEST(SphereTriangle, a_foot_that_is_no_dyadic_is_rounded_once) {
  // The plane x + y + z = 1 and the origin: the foot is (1, 1, 1) / 3, the distance sqrt(1/3).
  const Triangle corner{{Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1)}};
  const auto contact = compute_sphere_triangle({{0, 0, 0}, 1}, corner, {0, 0});
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->point2, Vector3(1.0 / 3, 1.0 / 3, 1.0 / 3));
  // sqrt(1/3) to 30 digits, and less 1.
  const double root = 0.577350269189625764509148780502;
  EXPECT_EQ(contact->normal, Vector3(root, root, root));
  EXPECT_EQ(contact->point1, Vector3(root, root, root));
  EXPECT_EQ(contact->value, -0.422649730810374235490851219498);
}

TEST(SphereTriangle, touching_counts_and_one_ulp_less_does_not) {
  EXPECT_TRUE(test_sphere_triangle({{1, 1, 3}, 3}, kFlat, 0));
  EXPECT_FALSE(test_sphere_triangle({{1, 1, 3}, below(3)}, kFlat, 0));
  EXPECT_TRUE(compute_sphere_triangle({{2, -3, 4}, 4.5}, kFlat, {0.5, 0}));
  EXPECT_FALSE(compute_sphere_triangle({{2, -3, 4}, 4.5}, kFlat, {below(0.5), 0}));
  EXPECT_TRUE(test_sphere_triangle({{-2, -1, 2}, 3}, kFlat, 0));
  EXPECT_FALSE(test_sphere_triangle({{-2, -1, 2}, below(3)}, kFlat, 0));
}

TEST(SphereTriangle, a_centre_on_it_leaves_along_the_normal_whose_first_component_is_positive) {
  expect_contact(compute_sphere_triangle({{1, 1, 0}, 2}, kFlat, {0, 0.5}), {0, 0, 1, 1, 1, 2, 1, 1, 0, -2.5},
                 Kind::degenerate);
  const Triangle turned{{kFlat.vertices[0], kFlat.vertices[2], kFlat.vertices[1]}};
  expect_contact(compute_sphere_triangle({{2, 0, 0}, 2}, turned, {0, 0}), {0, 0, 1, 2, 0, 2, 2, 0, 0, -2},
                 Kind::degenerate);
  // N = (0, -4, 3) or its opposite: the first component that is not 0 is positive.
  const Triangle leaning{{Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 3, 4)}};
  expect_contact(compute_sphere_triangle({{0, 0, 0}, 5}, leaning, {0, 0}), {0, 0.8, -0.6, 0, 4, -3, 0, 0, 0, -5},
                 Kind::degenerate);
}

TEST(SphereTriangle, without_an_inside_it_is_its_longest_edge) {
  // In every order: the middle one of three points on a line says nothing.
  std::array<Vector3, 3> v{Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(4, 0, 0)};
  do {
    expect_contact(compute_sphere_triangle({{7, 0, -4}, 5}, {v}, {0, 0}), {-0.6, 0, 0.8, 4, 0, 0, 4, 0, 0, 0},
                   Kind::ordinary);
    expect_contact(compute_sphere_triangle({{3, 0, 0}, 1}, {v}, {0, 0}), {0, 1, 0, 3, 1, 0, 3, 0, 0, -1},
                   Kind::degenerate);
  } while (std::next_permutation(v.begin(), v.end(), [](const Vector3& x, const Vector3& y) { return x[0] < y[0]; }));
  const Vector3 here(1, 2, 3);
  expect_contact(compute_sphere_triangle({here, 1}, {{here, here, here}}, {0, 0}), {1, 0, 0, 2, 2, 3, 1, 2, 3, -1},
                 Kind::degenerate);
  expect_contact(compute_sphere_triangle({{1, 2, 5}, 1}, {{here, here, here}}, {1, 0}), {0, 0, -1, 1, 2, 4, 1, 2, 3, 1},
                 Kind::ordinary);
  // The direction that counts is v2 - v0 where v1 = v0: across the y axis it is the x axis.
  expect_contact(compute_sphere_triangle({here, 1}, {{here, here, here + Vector3(0, 5, 0)}}, {0, 0}),
                 {1, 0, 0, 2, 2, 3, 1, 2, 3, -1}, Kind::degenerate);
}

TEST(SphereTriangle, the_largest_and_the_smallest_numbers_are_in_the_domain) {
  const Triangle largest{{Vector3(-kLargest, -kLargest, 0), Vector3(kLargest, -kLargest, 0), Vector3(0, kLargest, 0)}};
  expect_contact(compute_sphere_triangle({{0, 0, 1}, 1}, largest, {0, 0}), {0, 0, -1, 0, 0, 0, 0, 0, 0, 0},
                 Kind::ordinary);
  const Triangle least{{Vector3(0, 0, 0), Vector3(kLeast, 0, 0), Vector3(0, kLeast, 0)}};
  expect_contact(compute_sphere_triangle({{0, 0, kLeast}, kLeast}, least, {0, 0}), {0, 0, -1, 0, 0, 0, 0, 0, 0, 0},
                 Kind::ordinary);
  // A needle of the smallest width across the largest length.
  const Triangle needle{{Vector3(-kLargest, 0, 0), Vector3(kLargest, 0, 0), Vector3(0, kLeast, 0)}};
  EXPECT_TRUE(test_sphere_triangle({{0, 1, 0}, 1}, needle, 0));
  EXPECT_FALSE(test_sphere_triangle({{kLargest, 1, 0}, below(1)}, needle, 0));
}

// An exact stage for points of ordinary size would be slow: the fast one answers nearly all of them.
TEST(SphereTriangle, the_fast_stage_answers_ordinary_questions) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-4, 4);
  int answered = 0;
  constexpr int kCount = 2000;
  for (int i = 0; i < kCount; ++i) {
    const auto point = [&] { return Vector3(uniform(random), uniform(random), uniform(random)); };
    const Triangle triangle{{point(), point(), point()}};
    kernel::ApproximateNearest nearest;
    if (!kernel::find_nearest(point(), kernel::Corners{triangle.vertices}, nearest)) continue;
    const kernel::Lengths lengths{10, 0, 0, 0};
    const kernel::ApproximateContact approximate(nearest, lengths);
    Contact contact{};
    answered += approximate.holds() && kernel::round_certain(approximate, lengths, {}, contact) == 0 ? 1 : 0;
  }
  EXPECT_GT(answered, kCount * 99 / 100);
}

}  // namespace
}  // namespace contact::triangle_test
