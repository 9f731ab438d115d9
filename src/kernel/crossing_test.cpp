// Ray and line against triangle: worked examples through the face, the boundary and beside, what does not cross, the
// ends of the range, every floating-point environment, and both stages against each other.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "contact/ray_triangle.hpp"
#include "contact/triangle_line.hpp"
#include "environment/floating_point_environments.hpp"
#include "extreme_numbers.hpp"
#include "kernel/contacts_for_tests.hpp"
#include "kernel/crossing_cores.hpp"

namespace contact::crossing_test {
namespace {

const Triangle kFace{{Vector3(0, 0, 0), Vector3(4, 0, 0), Vector3(0, 4, 0)}};

void expect_crossing(const std::optional<Contact>& contact, const Vector3& at, const Vector3& normal) {
  expect_contact(contact, {normal[0], normal[1], normal[2], at[0], at[1], at[2], at[0], at[1], at[2], 0},
                 Kind::ordinary);
}

TEST(TriangleLine, the_normal_goes_by_the_vertices_from_either_side) {
  expect_crossing(compute_triangle_line(kFace, {{1, 1, 2}, {1, 1, -1}}), {1, 1, 0}, {0, 0, 1});
  expect_crossing(compute_triangle_line(kFace, {{1, 1, -1}, {1, 1, 2}}), {1, 1, 0}, {0, 0, 1});
  const Triangle turned{{kFace.vertices[0], kFace.vertices[2], kFace.vertices[1]}};
  expect_crossing(compute_triangle_line(turned, {{1, 1, 2}, {1, 1, -1}}), {1, 1, 0}, {0, 0, -1});
  // 3-4-5: the plane z = 3/4 x, so N is (-3, 0, 4) / 5; the line z = 6 - y at x = 4 meets it at z = 3.
  const Triangle steep{{Vector3(0, 0, 0), Vector3(8, 0, 6), Vector3(0, 8, 0)}};
  expect_crossing(compute_triangle_line(steep, {{4, 0, 6}, {4, 6, 0}}), {4, 3, 3}, {-0.6, 0, 0.8});
}

TEST(RayTriangle, the_normal_points_from_the_ray_to_the_triangle_by_the_vertices) {
  expect_crossing(compute_ray_triangle({{1, 1, 2}, {0, 0, -1}, 2}, kFace), {1, 1, 0}, {0, 0, -1});
  expect_crossing(compute_ray_triangle({{1, 1, -3}, {0, 0, 3}, 1}, kFace), {1, 1, 0}, {0, 0, -1});
  expect_crossing(compute_ray_triangle({{0, 0, 3}, {1, 1, -3}, 4}, kFace), {1, 1, 0}, {0, 0, -1});
}

TEST(TriangleLine, vertices_edges_and_ends_count_and_one_ulp_outside_does_not) {
  for (const auto& [x, y] : {std::pair(0.0, 0.0), std::pair(4.0, 0.0), std::pair(0.0, 4.0), std::pair(2.0, 0.0),
                             std::pair(0.0, 3.0), std::pair(1.0, 3.0)})
    expect_crossing(compute_triangle_line(kFace, {{x, y, 1}, {x, y, -1}}), {x, y, 0}, {0, 0, 1});
  EXPECT_FALSE(test_triangle_line(kFace, {{2, -kLeast, 1}, {2, -kLeast, -1}}));
  EXPECT_FALSE(test_triangle_line(kFace, {{-kLeast, 3, 1}, {-kLeast, 3, -1}}));
  EXPECT_FALSE(test_triangle_line(kFace, {{1, above(3), 1}, {1, above(3), -1}}));
  expect_crossing(compute_triangle_line(kFace, {{1, 1, 1}, {1, 1, 0}}), {1, 1, 0}, {0, 0, 1});
  expect_crossing(compute_triangle_line(kFace, {{1, 1, 0}, {1, 1, -1}}), {1, 1, 0}, {0, 0, 1});
  EXPECT_FALSE(test_triangle_line(kFace, {{1, 1, 1}, {1, 1, kLeast}}));
  EXPECT_FALSE(test_triangle_line(kFace, {{1, 1, -kLeast}, {1, 1, -1}}));
  // An edge that two triangles share is in both.
  const Triangle other{{Vector3(4, 0, 0), Vector3(4, 4, 0), Vector3(0, 4, 0)}};
  for (const Triangle& face : {kFace, other}) EXPECT_TRUE(test_triangle_line(face, {{1, 3, 1}, {1, 3, -1}}));
}

TEST(RayTriangle, ends_where_its_exact_end_is) {
  // 3 (1/3) is less than 1 by 2^-54, as long as it is not rounded.
  const double third = 1.0 / 3;
  EXPECT_FALSE(test_ray_triangle({{1, 1, 1}, {0, 0, -third}, 3}, kFace));
  EXPECT_TRUE(test_ray_triangle({{1, 1, 1}, {0, 0, -above(third)}, 3}, kFace));
  EXPECT_FALSE(test_ray_triangle({{1, 1, 1}, {0, 0, 1}, 100}, kFace));
  // The crossing is a third, which is rounded once.
  const Triangle plane{{Vector3(-9, -9, -9), Vector3(9, 0, 0), Vector3(0, 9, 9)}};
  const auto contact = compute_ray_triangle({{0, 0, 1}, {1, 1, -2}, 1}, plane);
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->point1, contact->point2);
  EXPECT_EQ(contact->value, 0);
}

TEST(RayTriangle, what_goes_along_the_plane_or_has_no_length_or_no_inside_does_not_cross) {
  EXPECT_FALSE(test_ray_triangle({{-1, 1, 0}, {1, 0, 0}, 9}, kFace));  // coplanar, through the face
  EXPECT_FALSE(test_ray_triangle({{1, 1, 0}, {0, 0, 1}, 0}, kFace));   // a point of the face
  EXPECT_FALSE(test_triangle_line(kFace, {{1, 1, 0}, {1, 1, 0}}));
  EXPECT_FALSE(test_triangle_line({{kFace.vertices[0], kFace.vertices[1], {2, 0, 0}}}, {{1, 0, 1}, {1, 0, -1}}));
  EXPECT_FALSE(
      test_triangle_line({{kFace.vertices[0], kFace.vertices[0], kFace.vertices[0]}}, {{0, 0, 1}, {0, 0, -1}}));
  // One step off the plane at either end is a crossing.
  expect_crossing(compute_triangle_line(kFace, {{-1, 1, -kLeast}, {3, 1, kLeast}}), {1, 1, 0}, {0, 0, 1});
}

TEST(TriangleLine, crosses_at_the_ends_of_the_range) {
  for (const double size : {kLeast, 0x1p-600, 0x1p300, 0x1p1000}) {
    const Triangle face{{Vector3(0, 0, 0), Vector3(4 * size, 0, 0), Vector3(0, 4 * size, 0)}};
    expect_crossing(compute_triangle_line(face, {{size, size, size}, {size, size, -size}}), {size, size, 0}, {0, 0, 1});
    EXPECT_FALSE(test_triangle_line(face, {{size, -size, size}, {size, -size, -size}}));
  }
  const Triangle wide{{Vector3(-kLargest, -kLargest, 0), Vector3(kLargest, -kLargest, 0), Vector3(0, kLargest, 0)}};
  expect_crossing(compute_triangle_line(wide, {{0, 0, kLargest}, {0, 0, -kLargest}}), {0, 0, 0}, {0, 0, 1});
}

struct Asked {
  Triangle triangle;
  Ray ray;
  Line line;
};
/// Segments through and beside triangles of small integers times powers of two, so that many meet boundaries exactly.
std::vector<Asked> drawn(std::size_t count) {
  std::mt19937_64 random(11);
  const auto integer = [&](int most) {
    return static_cast<double>(static_cast<int>(random() % static_cast<unsigned>(2 * most + 1)) - most);
  };
  const auto real = [&] { return std::ldexp(static_cast<double>(static_cast<std::int64_t>(random())), -61); };
  std::vector<Asked> all;
  while (all.size() < count) {
    const bool whole = all.size() % 2 == 0;
    const auto vector = [&] {
      const double x = whole ? integer(3) : real();
      const double y = whole ? integer(3) : real();
      const double z = whole ? integer(3) : real();
      return Vector3(x, y, z);
    };
    Asked asked{{{vector(), vector(), vector()}}, {vector(), vector(), std::abs(integer(3))}, {vector(), vector()}};
    if (asked.ray.direction.isZero(0)) continue;
    all.push_back(asked);
  }
  return all;
}

TEST(Crossings, both_stages_say_the_same) {
  std::size_t crossings = 0;
  std::size_t exactly = 0;
  for (const auto& [triangle, ray, line] : drawn(20000)) {
    const auto of_line = compute_triangle_line(triangle, line);
    expect_same(of_line, computed_exactly(triangle, line, {0, 0}));
    EXPECT_EQ(test_triangle_line(triangle, line), of_line.has_value());
    const auto of_ray = compute_ray_triangle(ray, triangle);
    expect_same(of_ray, computed_exactly(ray, triangle, {0, 0}));
    EXPECT_EQ(test_ray_triangle(ray, triangle), of_ray.has_value());
    crossings += of_line.has_value() + of_ray.has_value();
    exactly += plain_decision::filter_pair(ray, triangle) == kernel::Filtered::undecided;
  }
  EXPECT_GT(crossings, 2000U);
  EXPECT_GT(exactly, 200U);
  EXPECT_LT(exactly, 12000U);
}

TEST(Crossings, are_the_same_in_every_floating_point_environment) {
  std::vector<Asked> all = drawn(200);
  for (std::size_t i = 0; i < 100; ++i) {
    Asked small = all[i];
    const double unit = i % 2 == 0 ? kLeast : 0x1p-540;
    for (Vector3& v : small.triangle.vertices) v = (v.array().round() * unit).matrix();
    small.line = {(small.line.start.array().round() * unit).matrix(), (small.line.end.array().round() * unit).matrix()};
    all.push_back(small);
  }
  expect_same_in_every_environment(all, [](const Asked& asked, bool traps) {
    return traps ? std::pair(out_of_line::compute_triangle_line(asked.triangle, asked.line),
                             out_of_line::test_triangle_line(asked.triangle, asked.line))
                 : std::pair(compute_triangle_line(asked.triangle, asked.line),
                             test_triangle_line(asked.triangle, asked.line));
  });
  expect_same_in_every_environment(all, [](const Asked& asked, bool traps) {
    return traps ? std::pair(out_of_line::compute_ray_triangle(asked.ray, asked.triangle),
                             out_of_line::test_ray_triangle(asked.ray, asked.triangle))
                 : std::pair(compute_ray_triangle(asked.ray, asked.triangle),
                             test_ray_triangle(asked.ray, asked.triangle));
  });
}

}  // namespace
}  // namespace contact::crossing_test
