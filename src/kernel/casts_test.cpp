// Rays that are cast, by hand.
#include "contact/casts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <stdexcept>

namespace contact::casts_test {
namespace {

Contact hit_of(const std::optional<Contact>& contact) {
  if (!contact) throw std::logic_error("a miss");
  return *contact;
}

TEST(Casts, touching_counts_and_a_step_outside_does_not) {
  const Ray ray{{0, 0, 0}, {2, 0, 0}, 5};
  EXPECT_TRUE(test_cast_sphere(ray, {{4, 0, 1}, 1}));
  EXPECT_FALSE(test_cast_sphere(ray, {{4, 0, 1}, std::nextafter(1.0, 0.0)}));
  EXPECT_TRUE(test_cast_sphere(ray, {{11, 0, 0}, 1}));
  EXPECT_FALSE(test_cast_sphere(ray, {{std::nextafter(11.0, 12.0), 0, 0}, 1}));
  EXPECT_TRUE(test_cast_cube(ray, {{3, 0, -1}, {4, 1, 1}}));
  EXPECT_FALSE(test_cast_cube(ray, {{3, 0x1p-1074, -1}, {4, 1, 1}}));
  EXPECT_TRUE(test_cast_capsule(ray, {{3, 1, -4}, {3, 1, 9}, 1}));
  EXPECT_FALSE(test_cast_capsule(ray, {{3, 1, -4}, {3, 1, 9}, std::nextafter(1.0, 0.0)}));
  // From both sides, in the plane, through an edge; not beside it.
  for (const double side : {-1.0, 1.0})
    EXPECT_TRUE(test_cast_triangle(ray, {{Vector3(3, 0, side), Vector3(3, 2, -side), Vector3(3, -2, -side)}}));
  EXPECT_TRUE(test_cast_triangle(ray, {{Vector3(3, 1, 0), Vector3(5, -1, 0), Vector3(5, 1, 0)}}));
  EXPECT_FALSE(test_cast_triangle(ray, {{Vector3(3, 1, 0), Vector3(5, 0x1p-1074, 0), Vector3(5, 1, 0)}}));
  EXPECT_TRUE(test_cast_plane(ray, {{-3, 0, 0}, -30}));
  EXPECT_FALSE(test_cast_plane(ray, {{-3, 0, 0}, std::nextafter(-30.0, -31.0)}));
  EXPECT_FALSE(test_cast_plane({{0, 0, 1}, {1, 0, 0}, 1e300}, {{0, 0, 1}, 0}));
}

TEST(Casts, from_inside_t_is_0) {
  const Contact contact = hit_of(compute_cast_sphere({{1, 2, 2}, {0, 3, 4}, 7}, {{0, 0, 0}, 3}));
  EXPECT_TRUE(contact.degenerate);
  EXPECT_EQ(contact.value, 0);
  EXPECT_EQ(contact.point1, Vector3(1, 2, 2));
  EXPECT_EQ(contact.normal, Vector3(0, -0.6, -0.8));
  EXPECT_TRUE(hit_of(compute_cast_plane({{0, 0, 0}, {0, 0, 1}, 0}, {{0, 0, 1}, 0})).degenerate);
  EXPECT_FALSE(compute_cast_plane({{0, 0, 1}, {0, 0, 1}, 9}, {{0, 0, 1}, 0}).has_value());
}

TEST(Casts, of_several_normals_the_greatest_is_taken) {
  const Ray up{{0, 0, -5}, {0, 0, 1}, 9};
  const auto of_box = [&](const Vector3& min, const Vector3& max) {
    return hit_of(compute_cast_cube(up, {min, max})).normal;
  };
  EXPECT_EQ(of_box({-1, -1, -1}, {1, 1, 1}), Vector3(0, 0, -1));
  EXPECT_EQ(of_box({-1, -1, -1}, {0, 1, 1}), Vector3(1, 0, 0));
  EXPECT_EQ(of_box({0, -1, -1}, {1, 1, 1}), Vector3(0, 0, -1));
  EXPECT_EQ(of_box({0, -1, -1}, {1, 0, 1}), Vector3(0, 1, 0));
  EXPECT_EQ(of_box({-1, -1, 1}, {1, 1, 1}), Vector3(0, 0, 1));  // without thickness
  // A triangle's inside has two sides, a point every normal, and a segment those across it.
  EXPECT_EQ(hit_of(compute_cast_triangle(up, {{Vector3(-1, -1, 0), Vector3(0, 2, 0), Vector3(2, -1, 0)}})).normal,
            Vector3(0, 0, 1));
  EXPECT_EQ(hit_of(compute_cast_sphere(up, {{0, 0, 0}, 0})).normal, Vector3(1, 0, 0));
  const Vector3 across = hit_of(compute_cast_capsule(up, {{-4, -3, -1}, {4, 3, 1}, 0})).normal;
  EXPECT_EQ(across, Vector3(0.6, -0.8, 0));
}

}  // namespace
}  // namespace contact::casts_test
