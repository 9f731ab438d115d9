// Ray and line against triangle: worked examples through the face, the boundary and beside, what does not cross, and
// the ends of the range.
#include <gtest/gtest.h>

#include <utility>

#include "contact/ray_triangle.hpp"
#include "contact/triangle_line.hpp"
#include "extreme_numbers.hpp"
#include "kernel/contacts_for_tests.hpp"

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

}  // namespace
}  // namespace contact::crossing_test
