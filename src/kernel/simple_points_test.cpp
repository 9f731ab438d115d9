// Scenes of things along axes: the functions of one pair against the exact stage alone, and that few pairs get to it.
#include "kernel/simple_points.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <type_traits>

#include "contact/ray_sphere.hpp"
#include "contact/sphere_triangle.hpp"
#include "kernel/contacts_for_tests.hpp"
#include "kernel/core_pairs.hpp"
#include "kernel/cores_stages.hpp"

namespace contact::simple_points_test {
namespace {

/// Numbers of scenes: whole ones, quarters, ones of all bits; zeros of both signs.
class Scene {
 public:
  explicit Scene(std::uint32_t seed) : random_(seed) {}

  double coordinate() {
    switch (below(4)) {
      case 0:
        return static_cast<double>(below(7)) - 3;
      case 1:
        return below(2) == 0 ? 0.0 : -0.0;
      case 2:
        return static_cast<double>(below(33)) / 8 - 2;
      default:
        return any(-3, 3);
    }
  }
  double length() { return below(4) == 0 ? 0 : below(2) == 0 ? static_cast<double>(below(9)) / 4 : any(0, 3); }
  Vector3 point() {
    const double x = coordinate();
    const double y = coordinate();
    return {x, y, coordinate()};
  }
  /// Elsewhere along an axis, or along a diagonal of two, or anywhere.
  Vector3 beside(Vector3 point) {
    const auto axis = static_cast<Eigen::Index>(below(3));
    const std::uint32_t kind = below(6);
    if (kind == 0) return this->point();
    if (kind == 1) {
      const double step = static_cast<double>(below(5)) - 2;
      point[(axis + 1) % 3] += step;
      point[(axis + 2) % 3] += below(2) == 0 ? step : -step;
      return point;
    }
    point[axis] = coordinate();
    return point;
  }
  Vector3 along_axis() {
    Vector3 v(0, 0, 0);
    v[static_cast<Eigen::Index>(below(3))] = below(2) == 0 ? 1 : -any(0.5, 3);
    return v;
  }
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(random_() % n); }
  double any(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }

 private:
  std::mt19937 random_;
};

/// What was asked, and how many hits came without the exact stage: of simple points.
struct Count {
  int hits = 0;
  int simple = 0;
};

template <class A, class B>
void expect_right(const A& a, const B& b, Distances distances, Count& count) {
  const auto& [contact, is_hit] = said(a, b, distances);
  expect_same(contact, computed_exactly(a, b, distances));
  EXPECT_EQ(is_hit, contact.has_value());
  if (!contact) return;
  ++count.hits;
  const auto& first = kernel::core_of(a);
  const auto& second = kernel::core_of(b);
  if constexpr (kernel::MayBeSimple<std::remove_cvref_t<decltype(first)>, std::remove_cvref_t<decltype(second)>>) {
    Contact made;
    const auto said = kernel::contact_at_simple_points(first, second, kernel::lengths_of(a, b, distances), {}, made);
    count.simple += said == kernel::Filtered::hit ? 1 : 0;
  }
}

TEST(SimplePoints, give_the_bits_of_the_exact_stage) {
  Scene scene(7);
  Count spheres, capsules, triangles, rays, others;
  for (int i = 0; i < 20000 && !testing::Test::HasFailure(); ++i) {
    const Vector3 start1 = scene.point();
    const Vector3 end1 = scene.beside(start1);
    const Vector3 start2 = scene.beside(scene.below(2) == 0 ? start1 : scene.point());
    const Vector3 end2 = scene.beside(start2);
    const Vector3 third = scene.beside(scene.below(2) == 0 ? start2 : end2);
    const double radius1 = scene.length();
    const double radius2 = scene.length();
    const Distances distances{scene.below(2) == 0 ? 0 : scene.length(), scene.length()};
    const Ball ball{start1, radius1};
    const Capsule capsule1{start1, end1, radius1};
    const Capsule capsule2{start2, end2, radius2};
    const Line line{start1, end1};
    const Triangle triangle{{start2, end2, third}};
    const Ray ray{start2, scene.along_axis(), scene.length()};
    const Plane plane{scene.along_axis(), scene.coordinate()};

    expect_right(ball, capsule2, distances, spheres);
    expect_right(capsule1, capsule2, distances, capsules);
    expect_right(ball, triangle, distances, triangles);
    expect_right(ray, ball, distances, rays);
    expect_right(ball, plane, distances, others);
    expect_right(capsule1, plane, distances, others);
    expect_right(ray, triangle, distances, others);
    expect_right(triangle, line, distances, others);
    // Two balls are capsules without length.
    const Ball other{start2, radius2};
    const auto exactly =
        computed_exactly(Capsule{start1, start1, radius1}, Capsule{start2, start2, radius2}, distances);
    const auto& [contact, is_hit] = said(ball, other, distances);
    expect_same(contact, exactly);
    EXPECT_EQ(is_hit, exactly.has_value());
    if (testing::Test::HasFailure()) ADD_FAILURE() << "question " << i;
  }
  EXPECT_GE(spheres.simple, spheres.hits / 2) << spheres.hits;
  EXPECT_GE(capsules.simple, capsules.hits / 4) << capsules.hits;
  EXPECT_GE(triangles.simple, triangles.hits / 10) << triangles.hits;
  EXPECT_GE(rays.simple, rays.hits / 2) << rays.hits;
  EXPECT_GE(others.hits, 1000);
}

TEST(SimplePoints, are_not_those_of_a_ray_whose_way_is_nothing_beside_its_origin) {
  kernel::SimplePoints points;
  const Vector3 c(-3, 2, -1);
  EXPECT_FALSE(kernel::simple_points(kernel::DirectedSegment{{-1, 0x1p60, 0}, {-4, 1, 0}, 0.5}, c, points));
  EXPECT_TRUE(kernel::simple_points(kernel::DirectedSegment{{-1, 0x1p60, 0}, {-4, 0, 0}, 0.5}, c, points));
  const Ray ray{{-1, 0x1p60, 0}, {-4, 1, 0}, 0.5};
  const Ball ball{{-3, 0x1p60, 0.25}, 2};
  expect_same(compute_ray_sphere(ray, ball, {0, 0}), computed_exactly(ray, ball, {0, 0}));
}

/// A diagonal's foot is half of a sum: half way between two doubles in half of the questions.
TEST(SimplePoints, a_foot_on_a_diagonal_is_rounded_once) {
  Scene scene(8);
  int settled = 0;
  for (int i = 0; i < 2000 && !testing::Test::HasFailure(); ++i) {
    const Triangle triangle{{Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0)}};
    const kernel::Corners corners{triangle.vertices};
    const Vector3 c(scene.any(0, 1.25), scene.any(0, 1.25), scene.any(-1, 1));
    const Ball ball{c, 1};
    const auto exact = computed_exactly(ball, triangle, {0, 0});
    expect_same(compute_sphere_triangle(ball, triangle, {0, 0}), exact);
    if (!exact) continue;
    Contact contact = *exact;
    contact.point2.setConstant(77);
    const unsigned open = 0b111U << 2 * kernel::kPointNumber;
    if (kernel::settle_foot(c, corners, open, contact) != 0) continue;
    ++settled;
    expect_same(contact, exact);
    EXPECT_EQ(kernel::settle_foot(c, corners, open | 1, contact), open | 1);
  }
  EXPECT_GE(settled, 500);
}

}  // namespace
}  // namespace contact::simple_points_test
