// Any two convex shapes: answers that are known without arithmetic of ours.
#include "contact/convexes.hpp"
#include "kernel/convexes_enclosed.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <random>

namespace contact {
namespace {

constexpr Distances kTouching{0, 0};
const Quaternion kNotTurned{0, 0, 0, 1};
const Quaternion kHalfTurn{0, 0, 0.5, 0};  // about z: any length will do

Obb cube_at(double x, double y, double z, const Quaternion& orientation = kNotTurned) {
  return {{x, y, z}, orientation, {1, 1, 1}};
}
Triangle flat_triangle(double z) { return {{Vector3{0, 0, z}, Vector3{4, 0, z}, Vector3{0, 4, z}}}; }

void expect_contact(const std::optional<Contact>& found, const Vector3& normal, const Vector3& point1,
                    const Vector3& point2, double value, bool degenerate, bool unique) {
  ASSERT_TRUE(found);
  EXPECT_EQ(found->normal, normal);
  EXPECT_EQ(found->point1, point1);
  EXPECT_EQ(found->point2, point2);
  EXPECT_EQ(found->value, value);
  EXPECT_EQ(found->degenerate, degenerate);
  EXPECT_EQ(found->unique, unique);
}

TEST(Convexes, corners_edges_and_faces_face_each_other) {
  const Obb a = cube_at(0, 0, 0);
  // Faces: the middle of the common rectangle's least and greatest corner.
  expect_contact(compute_obb_obb(a, cube_at(3, 0.5, 0), {1, 0.25}), {1, 0, 0}, {1, 0.25, 0}, {2, 0.25, 0}, 0.75, false,
                 false);
  // Corners, 3 apart.
  expect_contact(compute_obb_obb(a, cube_at(3, 4, 4), {3, 0}), {1.0 / 3, 2.0 / 3, 2.0 / 3}, {1, 1, 1}, {2, 3, 3}, 3,
                 false, true);
  EXPECT_FALSE(compute_obb_obb(a, cube_at(3, 4, 4), {std::nextafter(3.0, 0.0), 0}));
  EXPECT_TRUE(test_obb_obb(a, cube_at(3, 4, 4), 3));
  EXPECT_FALSE(test_obb_obb(a, cube_at(3, 4, 4), std::nextafter(3.0, 0.0)));
}

TEST(Convexes, an_overlap_is_left_by_the_shortest_way) {
  const Obb a = cube_at(0, 0, 0);
  expect_contact(compute_obb_obb(a, cube_at(1, 1.5, 0), kTouching), {0, 1, 0}, {0.5, 1, 0}, {0.5, 0.5, 0}, -0.5, false,
                 false);
  // Six ways are as short: the preferred one.
  expect_contact(compute_obb_obb(a, cube_at(0, 0, 0), kTouching), {1, 0, 0}, {1, 0, 0}, {-1, 0, 0}, -2, false, false);
  // An edge of each, crosswise: the box is turned by an eighth about z, and the other by an eighth about y.
  const double c = std::sqrt(0.5);
  const auto found = compute_obb_obb({{0, 0, 0}, {0, 0, 1, 1 + std::sqrt(2.0)}, {1, 1, 1}},
                                     {{2.7, 0, 0}, {0, 1, 0, 1 + std::sqrt(2.0)}, {1, 1, 1}}, kTouching);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->value, 2.7 - 4 * c, 1e-15);
  EXPECT_NEAR(found->normal[0], 1, 1e-15);
}

TEST(Convexes, what_touches_is_degenerate_and_takes_a_facet_through_the_point) {
  const Obb a = cube_at(0, 0, 0);
  expect_contact(compute_obb_obb(a, cube_at(2, 0, 0), kTouching), {1, 0, 0}, {1, 0, 0}, {1, 0, 0}, 0, true, false);
  expect_contact(compute_obb_obb(a, cube_at(2, 2, 2), kTouching), {1, 0, 0}, {1, 1, 1}, {1, 1, 1}, 0, true, true);
  // Coplanar triangles: across their plane.
  const Triangle low = flat_triangle(0);
  expect_contact(compute_triangle_triangle(low, low, kTouching), {0, 0, 1}, {2, 0, 0}, {2, 0, 0}, 0, true, false);
}

TEST(Convexes, a_quaternion_may_have_any_length) {
  for (const double size : {1.0, 0x1p-1074, 0x1p1022})
    expect_contact(compute_obb_obb(cube_at(0, 0, 0), cube_at(3, 0, 0, {0, 0, size, size}), {1, 0}), {1, 0, 0},
                   {1, 0, 0}, {2, 0, 0}, 1, false, false);
  expect_contact(compute_sphere_obb({{0, 5, 0}, 1}, {{0, 0, 0}, {1, 1, 1, 1}, {1, 2, 3}}, {3, 0}), {0, -1, 0},
                 {0, 4, 0}, {0, 1, 0}, 3, false, true);  // x goes to y
}

TEST(Convexes, flat_shapes_are_shapes) {
  const Box sheet{{-1, -1, 0}, {1, 1, 0}};
  expect_contact(compute_capsule_cube({{0, 0, 1}, {0, 0, 3}, 0.5}, sheet, {1, 0}), {0, 0, -1}, {0, 0, 0.5}, {0, 0, 0},
                 0.5, false, true);
  // An axis through the middle of the sheet, 1 below it: five ways are as short.
  expect_contact(compute_capsule_cube({{0, 0, -1}, {0, 0, 2}, 0.5}, sheet, kTouching), {1, 0, 0}, {0.5, 0, 0},
                 {-1, 0, 0}, -1.5, false, true);
  const Triangle point{{Vector3{0, 0, 5}, Vector3{0, 0, 5}, Vector3{0, 0, 5}}};
  expect_contact(compute_cube_triangle(sheet, point, {5, 0}), {0, 0, 1}, {0, 0, 0}, {0, 0, 5}, 5, false, true);
}

TEST(Convexes, planes_have_the_lowest_vertices) {
  const Plane floor{{0, 0, 2}, 0};
  expect_contact(compute_obb_plane(cube_at(5, 0, 2), floor, {1, 0}), {0, 0, -1}, {5, 0, 1}, {5, 0, 0}, 1, false, false);
  expect_contact(compute_triangle_plane(flat_triangle(-1), floor, kTouching), {0, 0, -1}, {2, 0, -1}, {2, 0, 0}, -1,
                 false, false);
  EXPECT_FALSE(test_cube_plane({{0, 0, 1}, {1, 1, 2}}, floor, 0.5));
}

TEST(Convexes, the_range_has_no_end) {
  const double large = 0x1p1023;
  const auto far =
      compute_obb_obb({{-large, 0, 0}, kHalfTurn, {1, 1, 1}}, {{large, 0, 0}, kHalfTurn, {1, 1, 1}}, {1.7e308, 0});
  EXPECT_FALSE(far);
  const double small = std::numeric_limits<double>::denorm_min();
  expect_contact(compute_obb_obb({{0, 0, 0}, kNotTurned, {small, small, small}},
                                 {{4 * small, 0, 0}, kNotTurned, {small, small, small}}, {1, 0}),
                 {1, 0, 0}, {small, 0, 0}, {3 * small, 0, 0}, 2 * small, false, false);
}

TEST(ConvexesFilter, proves_what_is_clear_and_leaves_what_is_near_to_integers) {
  using kernel::NearSide;
  const Box first{{0, 0, 0}, {1, 1, 1}};
  const auto beside = [](double gap) { return Obb{{2 + gap, 0.5, 0.5}, {0, 0, 3, 3}, {2, 1, 3}}; };
  const auto side = [&](double gap, double alarm) {
    return near_side(kernel::near_core(first), kernel::near_core(beside(gap)), alarm);
  };
  EXPECT_EQ(side(1, 1), NearSide::unknown);
  EXPECT_EQ(side(0, 0), NearSide::unknown);
  for (int k = 2; k < 53; ++k) {
    const double step = std::ldexp(1.0, -k);
    const auto expect = [&](NearSide right, NearSide found, int most) {
      EXPECT_TRUE(found == right || (k > most && found == NearSide::unknown)) << k;
    };
    expect(NearSide::miss, side(1, 1 - step), 34);
    expect(NearSide::hit, side(1, 1 + step), 34);
    expect(NearSide::miss, side(step, 0), 24);  // a way of such a length has few digits that are right
    EXPECT_NE(side(-step, 0), NearSide::miss) << k;
  }
  EXPECT_EQ(side(-0.25, 0), NearSide::hit);
  // Where products leave the range, and of a quaternion whose square does, nothing is said.
  const auto said_of = [&](const auto& other) {
    return near_side(kernel::near_core(first), kernel::near_core(other), 0);
  };
  EXPECT_EQ(said_of(Box{{0, 0, 0}, {1e300, 1, 1}}), NearSide::unknown);
  Obb tiny = beside(9);
  for (double& x : tiny.orientation) x *= 0x1p-600;
  EXPECT_EQ(said_of(tiny), NearSide::unknown);
  EXPECT_FALSE(test_cube_obb(first, tiny, 0));
}

TEST(ConvexesFilter, leaves_to_integers_what_touches_or_ties_but_for_rounding) {
  using namespace kernel;
  std::mt19937_64 random(5);
  const auto number = [&] { return std::ldexp(static_cast<double>(random() >> 11), -52) - 1; };
  for (int i = 0; i < 200; ++i) {
    Obb cube = cube_at(0.5, 0.25, 3);
    for (double& x : cube.orientation) x = number();
    const NearCore core = near_core(cube);
    // In the middle of a face.
    Ball ball{cube.center, 0};
    for (Eigen::Index axis = 0; axis < 3; ++axis) ball.center[axis] += core.ways[0][static_cast<std::size_t>(axis)];
    EXPECT_EQ(near_side(near_core(ball), core, 0), NearSide::unknown) << i;
    // As near to one face as to another.
    ball.center = cube.center;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      ball.center[axis] += 0.25 * (core.ways[0][k] + core.ways[1][k]);
    }
    Contact contact;
    EXPECT_EQ(
        plain::certain(near_core(ball), GivenCorners(ball), core, GivenCorners(cube), true, {0, 0, 0, 0}, {}, contact)
            .open,
        kAllNumbers)
        << i;
  }
}

using kernel::plain::Enclosure;
using Rational = boost::multiprecision::cpp_rational;

/// |high + low - exact|, over the radius.
double share_of_radius(const Enclosure& found, const Rational& exact) {
  const Rational off = abs(Rational(found.high) + Rational(found.low) - exact);
  return off == 0 ? 0 : Rational(off / Rational(found.radius)).convert_to<double>();
}

TEST(Enclosure, holds_every_number_that_the_exact_result_may_be) {
  std::mt19937_64 random(7);
  const auto unit = [&] { return std::ldexp(static_cast<double>(random() >> 11), -53); };
  const auto any = [&](bool is_positive) {
    const double high = std::ldexp(1 + unit(), static_cast<int>(random() % 40) - 20);
    const double sign = is_positive || random() % 2 == 0 ? 1 : -1;
    const auto sum = kernel::two_sum(sign * high, std::ldexp(high * (unit() - 0.5), -53));
    return Enclosure(sum, random() % 2 == 0 ? 0 : std::ldexp(high, -90));
  };
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const Enclosure x = any(true);
    const Enclosure y = any(i % 2 == 0);
    // Both ends of one, and the middle of the other.
    for (const double end : {-1.0, 0.0, 1.0}) {
      const Rational of_x = Rational(x.high) + Rational(x.low) + Rational(end * x.radius);
      const Rational of_y = Rational(y.high) + Rational(y.low) + Rational(end * y.radius);
      const Enclosure root = kernel::plain::root(x);
      const Rational low = Rational(root.high) + Rational(root.low) - Rational(root.radius);
      const Rational high = low + 2 * Rational(root.radius);
      ASSERT_TRUE(low * low <= of_x && of_x <= high * high) << i;
      for (const double share :
           {share_of_radius(x + y, of_x + of_y), share_of_radius(x - y, of_x - of_y),
            share_of_radius(x * y, of_x * of_y), share_of_radius(y.high * x, of_x * Rational(y.high)),
            share_of_radius(kernel::plain::sum_of<4>({x, y, x, -y}), 2 * of_x),
            share_of_radius(kernel::plain::sum_of_products<3>({x, y, x}, {y, x, x}), (2 * of_y + of_x) * of_x),
            share_of_radius(kernel::plain::product(x.high, y.high), Rational(x.high) * Rational(y.high)),
            share_of_radius(kernel::plain::reciprocal(x), 1 / of_x)}) {
        ASSERT_LE(share, 1) << i;
        if (x.radius == 0 && y.radius == 0) worst = std::max(worst, share);
      }
    }
  }
  EXPECT_GT(worst, 1.0 / 12);  // no bound is needlessly wide
  // What is lost below the range is inside, and a factor of 0 loses nothing.
  const Enclosure lost = Enclosure(0x1p-540) * Enclosure(0x1p-540);
  EXPECT_GE(lost.radius, 0x1p-1074);
  EXPECT_EQ((Enclosure(0) * Enclosure(3)).radius, 0);
}

TEST(ConvexesEnclosed, settles_nearly_all_that_is_in_no_special_position_and_leaves_what_is) {
  using namespace kernel;
  std::mt19937_64 random(11);
  const auto number = [&](double low, double high) {
    return low + (high - low) * std::ldexp(static_cast<double>(random() >> 11), -53);
  };
  const auto box = [&](double size) {
    Obb made;
    for (Eigen::Index i = 0; i < 3; ++i) made.center[i] = number(-size, size), made.extents[i] = number(0.25, 1);
    for (double& x : made.orientation) x = number(-1, 1);
    return made;
  };
  const Lengths lengths{0, 0, 1, 0.25};
  // What is left open, of all ten numbers; or nothing of a miss.
  Contact contact;
  const auto open = [&](const auto& a, const auto& b) {
    const Certain found =
        plain::certain(near_core(a), GivenCorners(a), near_core(b), GivenCorners(b), true, lengths, {}, contact);
#if defined(__x86_64__) && !defined(__FMA__)
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
      Contact same{};
      const Certain again =
          by_fma::certain(near_core(a), GivenCorners(a), near_core(b), GivenCorners(b), true, lengths, {}, same);
      EXPECT_EQ(again.side, found.side);
      EXPECT_EQ(again.open, found.open);
      if (found.side == NearSide::hit && found.open == 0) {
        EXPECT_EQ(same.normal, contact.normal);
        EXPECT_EQ(same.point1, contact.point1);
        EXPECT_EQ(same.point2, contact.point2);
        EXPECT_EQ(same.value, contact.value);
      }
    }
#endif
    return found.side == NearSide::miss ? 0U : found.open;
  };
  int apart = 0;
  int overlapping = 0;
  int left = 0;
  const auto ask = [&](const auto& a, const auto& b) {
    contact.value = 10;
    if (open(a, b) != 0)
      ++left;
    else if (contact.value <= lengths.alarm)
      ++(contact.value > -0.25 ? apart : overlapping);
  };
  const auto capsule = [&] {
    const auto end = [&] { return number(-1.5, 1.5); };
    Capsule made{{0, 0, 0}, {0, 0, 0}, 0};
    for (Vector3* point : {&made.start, &made.end})
      for (Eigen::Index i = 0; i < 3; ++i) (*point)[i] = end();
    return made;
  };
  for (int i = 0; i < 1000; ++i) {
    const Obb a = box(1.5);
    const Obb b = box(1.5);
    ask(a, b);
    const Capsule of_segment = capsule();
    ask(of_segment, b);
    const Capsule side = capsule();
    const Capsule corner = capsule();
    ask(of_segment, Triangle{{side.start, side.end, corner.start}});
  }
  EXPECT_GT(apart, 500);
  EXPECT_GT(overlapping, 500);
  EXPECT_LT(left, 10);
  // Faces along each other, a touch, and a segment without length inside.
  EXPECT_NE(open(cube_at(0, 0, 0), cube_at(3, 0.5, 0)), 0U);
  EXPECT_NE(open(cube_at(0, 0, 0), cube_at(1, 0.5, 0)), 0U);
  EXPECT_NE(open(cube_at(0, 0, 0), cube_at(2, 2, 2)), 0U);
  EXPECT_NE(open(cube_at(0, 0, 0), Capsule{{0.5, 0.5, 0.25}, {0.5, 0.5, 0.25}, 0}), 0U);
}

}  // namespace
}  // namespace contact
