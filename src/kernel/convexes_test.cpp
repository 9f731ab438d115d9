// Any two convex shapes: answers that are known without arithmetic of ours.
#include "contact/convexes.hpp"
#include "kernel/convexes_enclosed.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace contact::convexes_test {
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

TEST(Convexes, an_infinite_alarm_distance_is_no_limit) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Vector3 far = Vector3::Unit(0) * std::numeric_limits<double>::max();
  const Obb box{far, kNotTurned, {0, 0, 0}};
  EXPECT_TRUE(test_capsule_obb({-far, -far, 0}, box, kInfinity));
  EXPECT_TRUE(compute_capsule_obb({-far, -far, 0}, box, {kInfinity, 0}));
  const Plane plane{{1, 0, 0}, -far[0]};
  EXPECT_TRUE(test_obb_plane(box, plane, kInfinity));
  EXPECT_TRUE(compute_obb_plane(box, plane, {kInfinity, 0}));
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

// ---- hulls ----

/// Small integers: the shapes often touch, lie in each other, or along each other.
class SmallShapes {
 public:
  explicit SmallShapes(std::uint64_t seed) : random_(seed) {}

  int below(int end) { return static_cast<int>(random_() % static_cast<std::uint64_t>(end)); }
  double number() { return below(5) - 2; }
  Vector3 point() {
    Vector3 x;
    for (Eigen::Index i = 0; i < 3; ++i) x[i] = number();
    return x;
  }
  Hull hull(int most) {
    Hull made{{}, 0};
    for (int left = 1 + below(most); left > 0; --left) made.vertices.push_back(point());
    return made;
  }

  void make(Ball& x) { x = {point(), 0.5 * below(3)}; }
  void make(Capsule& x) {
    x.start = point();
    x.end = point();
    x.radius = 0.5 * below(3);
  }
  void make(Triangle& x) {
    for (Vector3& v : x.vertices) v = point();
  }
  void make(Box& x) {
    x.min = point();
    x.max = x.min + point().cwiseAbs();
  }
  void make(Obb& x) {
    // Turns that lead axes to axes.
    const std::array<Quaternion, 3> turns{{{0, 0, 0, 1}, {1, 1, 1, 1}, {0, 0, 3, 3}}};
    x.center = point();
    x.orientation = turns[static_cast<std::size_t>(below(3))];
    x.extents = point().cwiseAbs();
  }
  /// The same hull: its vertices in another order, some twice, and points between two of them.
  Hull said_otherwise(Hull hull) {
    const std::size_t count = hull.vertices.size();
    for (int more = below(4); more > 0; --more) {
      const Vector3 x = hull.vertices[random_() % count];
      const Vector3 y = hull.vertices[random_() % count];
      hull.vertices.push_back(0.5 * (x + y));
    }
    for (std::size_t k = hull.vertices.size(); k > 1; --k)
      std::swap(hull.vertices[k - 1], hull.vertices[random_() % k]);
    return hull;
  }

 private:
  std::mt19937_64 random_;
};

Hull hull_of(const Ball& x) { return {{x.center}, x.radius}; }
Hull hull_of(const Capsule& x) { return {{x.start, x.end}, x.radius}; }
Hull hull_of(const Triangle& x) { return {{x.vertices.begin(), x.vertices.end()}, 0}; }
Hull hull_of(const Box& x) {
  Hull hull{{}, 0};
  for (int k = 0; k < 8; ++k)
    hull.vertices.emplace_back((k & 1 ? x.max : x.min)[0], (k & 2 ? x.max : x.min)[1], (k & 4 ? x.max : x.min)[2]);
  return hull;
}
Hull hull_of(const Obb& x) {
  Hull hull = hull_of(Box{-x.extents, x.extents});
  const auto& [i, j, k, w] = x.orientation;
  for (Vector3& v : hull.vertices) v = x.center + Eigen::Quaterniond(w, i, j, k).normalized().toRotationMatrix() * v;
  for (Vector3& v : hull.vertices) v = v.array().round();  // the turns are those of SmallShapes
  return hull;
}

std::string in_words(const std::optional<Contact>& found) {
  std::ostringstream words;
  words << std::hexfloat;
  if (found)
    words << found->normal.transpose() << " | " << found->point1.transpose() << " | " << found->point2.transpose()
          << " | " << found->value << " " << found->degenerate << found->unique;
  return words.str();
}

TEST(Hulls, of_the_corners_of_a_shape_have_its_bits_however_they_are_said) {
  SmallShapes shapes(3);
  int hits = 0;
  int degenerate = 0;
  const auto compare = [&](auto ask, auto ask_second, auto ask_both, auto a, auto b) {
    for (int i = 0; i < 300; ++i) {
      shapes.make(a);
      shapes.make(b);
      const Distances distances{0.5, 0.25};
      const auto found = ask(a, b, distances, ContactPoints{});
      const Hull first = shapes.said_otherwise(hull_of(a));
      const Hull second = shapes.said_otherwise(hull_of(b));
      ASSERT_EQ(in_words(ask_second(a, second, distances, ContactPoints{})), in_words(found)) << i;
      ASSERT_EQ(in_words(ask_both(first, second, distances, ContactPoints{})), in_words(found)) << i;
      ASSERT_EQ(test_hull_hull(first, second, 0.5), found.has_value()) << i;
      hits += found ? 1 : 0;
      degenerate += found && found->degenerate ? 1 : 0;
    }
  };
  compare(compute_sphere_obb, compute_sphere_hull, compute_hull_hull, Ball(), Obb());
  compare(compute_capsule_cube, compute_capsule_hull, compute_hull_hull, Capsule(), Box());
  compare(compute_capsule_obb, compute_capsule_hull, compute_hull_hull, Capsule(), Obb());
  compare(compute_capsule_triangle, compute_capsule_hull, compute_hull_hull, Capsule(), Triangle());
  compare(compute_cube_obb, compute_cube_hull, compute_hull_hull, Box(), Obb());
  compare(compute_cube_triangle, compute_cube_hull, compute_hull_hull, Box(), Triangle());
  compare(compute_obb_obb, compute_obb_hull, compute_hull_hull, Obb(), Obb());
  compare(compute_obb_triangle, compute_obb_hull, compute_hull_hull, Obb(), Triangle());
  compare(compute_triangle_triangle, compute_triangle_hull, compute_hull_hull, Triangle(), Triangle());
  EXPECT_GT(hits, 1000);
  EXPECT_GT(degenerate, 200);
  const Plane plane{{1, 2, 2}, 1};
  for (int i = 0; i < 100; ++i) {
    Obb box;
    shapes.make(box);
    const Hull hull = shapes.said_otherwise(hull_of(box));
    ASSERT_EQ(in_words(compute_hull_plane(hull, plane, {1, 0})), in_words(compute_obb_plane(box, plane, {1, 0}))) << i;
    ASSERT_EQ(test_hull_plane(hull, plane, 1), test_obb_plane(box, plane, 1)) << i;
  }
}

/// What is known of two hulls by trying every direction across two differences of vertices. Domain: small integers.
class AllDirections {
 public:
  using Way = std::array<std::int64_t, 3>;

  AllDirections(const Hull& a, const Hull& b) {
    std::vector<Way> ways;
    for (const Hull* hull : {&a, &b})
      for (const Vector3& x : hull->vertices)
        for (const Vector3& y : hull->vertices) ways.push_back(integers(x - y));
    for (const Vector3& x : a.vertices)
      for (const Vector3& y : b.vertices) corners_.push_back(integers(x - y));
    for (const Way& u : ways)
      for (const Way& w : ways) take(cross(u, w));
  }

  [[nodiscard]] bool is_solid() const { return is_solid_; }
  /// The least depth, below 0 where they are apart, is height / |normal|.
  [[nodiscard]] const Way& normal() const { return normal_; }
  [[nodiscard]] std::int64_t height() const { return height_; }
  static std::int64_t dot(const Way& x, const Way& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }

 private:
  static Way integers(const Vector3& x) { return {std::llround(x[0]), std::llround(x[1]), std::llround(x[2])}; }
  static Way cross(const Way& x, const Way& y) {
    return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
  }
  static bool is_zero(const Way& x) { return x == Way{0, 0, 0}; }

  void take(const Way& n) {
    if (is_zero(n)) return;
    const auto compare = [&](const Way& x, const Way& y) { return dot(n, x) < dot(n, y); };
    const auto [low, high] = std::minmax_element(corners_.begin(), corners_.end(), compare);
    is_solid_ = is_solid_ || dot(n, *low) != dot(n, *high);
    const std::int64_t height = dot(n, *high);
    const auto sign = [](std::int64_t x) { return (x > 0) - (x < 0); };
    const std::int64_t here = sign(height) * height * height * dot(normal_, normal_);
    const std::int64_t before = sign(height_) * height_ * height_ * dot(n, n);
    if (is_known_ && (here > before || (here == before && !is_greater(n)))) return;
    if (!is_facet(n, height)) return;
    is_known_ = true;
    normal_ = n;
    height_ = height;
  }
  [[nodiscard]] bool is_facet(const Way& n, std::int64_t height) const {
    std::vector<Way> face;
    for (const Way& x : corners_)
      if (dot(n, x) == height) face.push_back({x[0] - corners_[0][0], x[1] - corners_[0][1], x[2] - corners_[0][2]});
    const auto between = [&](std::size_t i) {
      return Way{face[i][0] - face[0][0], face[i][1] - face[0][1], face[i][2] - face[0][2]};
    };
    for (std::size_t i = 0; i < face.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (!is_zero(cross(between(i), between(j)))) return true;
    return false;
  }
  /// Each divided by the sum of its components' sizes.
  [[nodiscard]] bool is_greater(const Way& n) const {
    const auto size = [](const Way& x) { return std::abs(x[0]) + std::abs(x[1]) + std::abs(x[2]); };
    for (std::size_t i = 0; i < 3; ++i)
      if (n[i] * size(normal_) != normal_[i] * size(n)) return n[i] * size(normal_) > normal_[i] * size(n);
    return false;
  }

  std::vector<Way> corners_;  ///< of A - B
  bool is_solid_ = false;     ///< A - B lies in no plane
  bool is_known_ = false;
  Way normal_{};
  std::int64_t height_ = 0;
};

TEST(Hulls, have_the_depth_and_the_normal_that_trying_every_direction_finds) {
  SmallShapes shapes(17);
  int deep = 0;
  int touching = 0;
  int apart = 0;
  for (int i = 0; i < 1500; ++i) {
    const Hull a = shapes.hull(7);
    const Hull b = shapes.hull(7);
    const AllDirections right(a, b);
    if (!right.is_solid()) continue;
    const auto found = compute_hull_hull(a, b, kTouching);
    ASSERT_EQ(found.has_value(), right.height() >= 0) << i;
    ASSERT_EQ(test_hull_hull(a, b, 0), right.height() >= 0) << i;
    ++(right.height() < 0 ? apart : right.height() == 0 ? touching : deep);
    if (!found) continue;
    const double length = std::sqrt(static_cast<double>(AllDirections::dot(right.normal(), right.normal())));
    ASSERT_EQ(found->degenerate, right.height() == 0) << i;
    ASSERT_DOUBLE_EQ(found->value, static_cast<double>(-right.height()) / length) << i;
    for (std::size_t axis = 0; axis < 3; ++axis)
      ASSERT_DOUBLE_EQ(found->normal[static_cast<Eigen::Index>(axis)],
                       static_cast<double>(right.normal()[axis]) / length)
          << i;
    ASSERT_LT((found->point1 - found->point2 + found->value * found->normal).norm(), 1e-15) << i;
  }
  EXPECT_GT(deep, 300);
  EXPECT_GT(touching, 100);
  EXPECT_GT(apart, 200);
}

TEST(Hulls, answer_as_is_known_of_tetrahedra_of_flat_ones_and_of_64_points) {
  const auto tetrahedron = [](double x, double y, double z) {
    const Vector3 o(x, y, z);
    return Hull{{o, o + Vector3(6, 0, 0), o + Vector3(0, 6, 0), o + Vector3(0, 0, 6)}, 0};
  };
  // A corner, 1 deep along (1, 1, 1), and with radii.
  const double c = std::sqrt(1.0 / 3);
  Hull first = tetrahedron(0, 0, 0);
  Hull second = tetrahedron(1, 2, 2);
  auto found = compute_hull_hull(first, second, kTouching);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->normal, Vector3(c, c, c));
  EXPECT_EQ(found->point2, Vector3(1, 2, 2));
  EXPECT_EQ(found->value, -c);
  EXPECT_TRUE(found->unique && !found->degenerate);
  second = tetrahedron(1, 2, 6);
  EXPECT_FALSE(test_hull_hull(first, second, 1));  // 3 / sqrt(3) apart
  first.radius = 1;
  second.radius = 0.75;
  found = compute_hull_hull(first, second, {0, 0.25});
  ASSERT_TRUE(found);
  EXPECT_DOUBLE_EQ(found->value, 3 * c - 2);
  // Two squares that cross: 1 to the side is as near as 1 up.
  const Hull standing{{{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}}, 0};
  const Hull lying{{{-2, -1, 0}, {2, -1, 0}, {2, 1, 0}, {-2, 1, 0}}, 0};
  expect_contact(compute_hull_hull(standing, lying, kTouching), {0, 1, 0}, {0, 0, 0}, {0, -1, 0}, -1, false, false);
  // In one plane, and in one line.
  const Hull in_line{{{0, 0, 0}, {3, 0, 0}, {1, 0, 0}}, 0};
  expect_contact(compute_hull_hull(lying, Hull{{{0, 0, 0}, {5, 0, 0}, {5, 1, 0}}, 0}, kTouching), {0, 0, 1},
                 {1, 0.2, 0}, {1, 0.2, 0}, 0, true, false);
  expect_contact(compute_hull_hull(in_line, Hull{{{2, 0, 0}, {9, 0, 0}}, 0.5}, kTouching), {0, 1, 0}, {2.5, 0, 0},
                 {2.5, -0.5, 0}, -0.5, true, false);
  // Edges along each other, each beyond one end of the other.
  expect_contact(compute_hull_hull(in_line, Hull{{{9, 0, 2}, {2, 0, 2}}, 0}, {2, 0}), {0, 0, 1}, {2.5, 0, 0},
                 {2.5, 0, 2}, 2, false, false);
  // A cube by all the points of its grid: 16 in a face, 8 inside.
  Hull grid{{}, 0};
  for (int k = 0; k < 64; ++k) grid.vertices.emplace_back(k % 4, k / 4 % 4, k / 16);
  const Box cube{{0, 0, 0}, {3, 3, 3}};
  EXPECT_EQ(in_words(compute_hull_hull(grid, hull_of(Box{{1, 2, 2.5}, {4, 4, 5}}), kTouching)),
            in_words(compute_cube_hull(cube, hull_of(Box{{1, 2, 2.5}, {4, 4, 5}}), kTouching)));
  expect_contact(compute_cube_hull(cube, grid, kTouching), {1, 0, 0}, {3, 1.5, 1.5}, {0, 1.5, 1.5}, -3, false, false);
  // Polygons of 64 corners face each other: what they have in common is all of them, or all but one end.
  Hull bow{{}, 0};
  for (int k = 0; k < 64; ++k) bow.vertices.emplace_back(k, k * k, 0);
  Hull above = bow;
  for (Vector3& v : above.vertices) v[2] = 2;
  expect_contact(compute_hull_hull(bow, above, {2, 0}), {0, 0, 1}, {31.5, 1984.5, 0}, {31.5, 1984.5, 2}, 2, false,
                 false);
  above.vertices.erase(above.vertices.begin());
  above.radius = 0.5;
  expect_contact(compute_hull_hull(bow, above, {2, 0}), {0, 0, 1}, {32, 1985, 0}, {32, 1985, 1.5}, 1.5, false, false);
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
    // A corner of a smaller box there.
    Obb small{{0, 0, 0}, {}, {0.5, 0.5, 0.5}};
    for (double& x : small.orientation) x = number();
    double far = 1;
    for (const auto& way : near_core(small).ways) far += std::abs(near::dot(core.axes[0], way));
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      small.center[axis] = cube.center[axis] + far * core.axes[0][static_cast<std::size_t>(axis)];
    EXPECT_EQ(near_side(core, near_core(small), 0), NearSide::unknown) << i;
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

/// What is certain of two cores. Where the processor has fma, its build has the same bits.
template <class A, class B>
kernel::Certain certain_for_any_processor(const A& a, const B& b, const kernel::Lengths& lengths, Contact& contact) {
  using namespace kernel;
  const auto ask = [&](auto certain, Contact& to) {
    return certain(near_core(a), GivenCorners(a), near_core(b), GivenCorners(b), true, lengths, ContactPoints{}, to);
  };
  const Certain found = ask([](auto&&... all) { return plain::certain(all...); }, contact);
#if defined(__x86_64__) && !defined(__FMA__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    Contact same{};
    const Certain again = ask([](auto&&... all) { return by_fma::certain(all...); }, same);
    EXPECT_EQ(again.side, found.side);
    EXPECT_EQ(again.open, found.open);
    if (found.side == NearSide::hit && found.open == 0) {
      EXPECT_EQ(in_words(same), in_words(contact));
    }
  }
#endif
  return found;
}

using kernel::plain::Enclosure;
using Rational = boost::multiprecision::cpp_rational;

/// |high + low - exact|, over the radius.
double share_of_radius(const Enclosure& found, const Rational& exact) {
  const Rational off = abs(Rational(found.high) + Rational(found.low) - exact);
  return off == 0 ? 0 : Rational(off / Rational(found.radius)).convert_to<double>();
}

/// x^2 + y^2 - z^2 - x y, and x y + y z.
double share_of_given(double x, double y, double z) {
  const Rational of_x = x;
  const Rational of_y = y;
  const Rational of_z = z;
  return std::max(share_of_radius(kernel::plain::sum_of_given_products<4>({x, y, z, x}, {x, y, -z, -y}),
                                  of_x * of_x + of_y * of_y - of_z * of_z - of_x * of_y),
                  share_of_radius(kernel::plain::sum_of_given_products<2>({x, y}, {y, z}), of_x * of_y + of_y * of_z));
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
            share_of_radius(kernel::plain::sum_of_multiples<3>({x.high, y.low, x.low}, {y, x, y}),
                            (Rational(x.high) + Rational(x.low)) * of_y + Rational(y.low) * of_x),
            share_of_radius(kernel::plain::sum_of_products<3>({x, y, x}, {y, x, x}), (2 * of_y + of_x) * of_x),
            share_of_given(x.high, y.high, x.low), share_of_given(y.high, y.low, x.high),
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
    const Certain found = certain_for_any_processor(a, b, lengths, contact);
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

/// Random hulls, and what plain double leaves open of a question with one.
class RandomHulls {
 public:
  double number(double low, double high) {
    return low + (high - low) * std::ldexp(static_cast<double>(random_() >> 11), -53);
  }
  Vector3 point(double size) {
    Vector3 x;
    for (Eigen::Index i = 0; i < 3; ++i) x[i] = number(-size, size);
    return x;
  }
  /// So many points of a sphere about a place, all of them corners.
  Hull hull(std::size_t count, double far, double radius = 0) {
    Hull made{{}, radius};
    const Vector3 center = point(0.75) + Vector3(far, far, far);
    while (made.vertices.size() < count)
      if (const Vector3 x = point(1); x.norm() > 0.125 && x.norm() < 1)
        made.vertices.emplace_back(center + x.normalized());
    return made;
  }
  /// A corner of an axis each way, turned at random.
  Hull octahedron(const Vector3& center) {
    const auto turn =
        Eigen::Quaterniond(number(-1, 1), number(-1, 1), number(-1, 1), number(-1, 1)).normalized().toRotationMatrix();
    Hull made{{}, 0};
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      for (const double sign : {1.0, -1.0}) made.vertices.emplace_back(center + sign * turn.col(axis));
    return made;
  }

  template <class A, class B>
  static kernel::Certain certain(const A& a, const B& b) {
    Contact contact{};
    return certain_for_any_processor(a, b, {0, 0, 0.25, 0.125}, contact);
  }

 private:
  std::mt19937_64 random_{13};
};

template <class Shape>
Shape times_two_to(int exponent, Shape shape) {
  for_each_number(shape, [&](double& x) { x = std::ldexp(x, exponent); });
  return shape;
}

/// The answer of integers: to the question times 2^exponent, which is beyond the range of the filters, and back. Only what is rounded below the range does not scale.
template <class A, class B, class Ask>
std::optional<Contact> answer_of_integers(const A& a, const B& b, Ask ask, int exponent) {
  auto found = ask(times_two_to(exponent, a), times_two_to(exponent, b),
                   Distances{std::ldexp(0.25, exponent), std::ldexp(0.125, exponent)}, ContactPoints{});
  if (found) {
    found->value = std::ldexp(found->value, -exponent);
    for (Vector3* point : {&found->point1, &found->point2})
      for (Eigen::Index i = 0; i < 3; ++i) (*point)[i] = std::ldexp((*point)[i], -exponent);
  }
  return found;
}

TEST(ConvexesFilter, finds_the_facet_of_two_boxes_that_integers_find_among_all) {
  RandomHulls random;
  int touching = 0;
  // So large that nothing is said of a direction.
  const auto compare = [&](auto ask, const auto& a, const auto& b) {
    const auto found = ask(a, b, Distances{0.25, 0.125}, ContactPoints{});
    ASSERT_EQ(in_words(found), in_words(answer_of_integers(a, b, ask, 300)));
    touching += found ? 1 : 0;
  };
  const auto one_of = [&](std::initializer_list<double> all) {
    return all.begin()[static_cast<std::size_t>(random.number(0, static_cast<double>(all.size())))];
  };
  for (int i = 0; i < 2000; ++i) {
    // Ordinary, thin and flat ones; turned at random, along each other, and nearly so.
    Obb a;
    Obb b;
    for (Obb* box : {&a, &b}) {
      box->center = random.point(1);
      for (Eigen::Index k = 0; k < 3; ++k)
        box->extents[k] = random.number(0.25, 1) * one_of({1, 1, 1, 1, 0x1p-20, 0x1p-52, 0});
      for (double& x : box->orientation) x = random.number(-1, 1);
    }
    if (i % 2 == 0) b.orientation = a.orientation;
    if (i % 4 == 0) b.orientation[0] += random.number(-1, 1) * one_of({1, 0x1p-10, 0x1p-20, 0x1p-30, 0x1p-50});
    if (i % 3 == 0) b.center[0] = a.center[0];
    compare(&compute_obb_obb, a, b);
    const Box along{a.center, a.center + a.extents};
    if (i % 2 == 0) b.orientation = {0, 0, one_of({0, 0x1p-20, 0x1p-40}), 1};
    compare(&compute_cube_obb, along, b);
  }
  EXPECT_GT(touching, 1000);
}

TEST(ConvexesEnclosed, settles_hulls_with_the_bits_that_integers_have) {
  RandomHulls random;
  int overlapping = 0;
  int apart = 0;
  int left = 0;
  const auto compare = [&](auto ask, const auto& a, const auto& b) {
    const auto found = ask(a, b, Distances{0.25, 0.125}, ContactPoints{});
    ASSERT_EQ(in_words(found), in_words(answer_of_integers(a, b, ask, 110)));
    const kernel::Certain certain = RandomHulls::certain(a, b);
    if (certain.side != kernel::NearSide::miss && certain.open != 0)
      ++left;
    else if (found)
      ++(found->value < -0.25 ? overlapping : apart);
  };
  for (int i = 0; i < 60; ++i) {
    const double far = i % 3 == 0 ? 1000 : 0;
    const std::size_t count = i % 10 == 0 ? 64 : 4 + static_cast<std::size_t>(i % 12);
    const Hull hull = random.hull(count, far);
    const Vector3 from(far, far, far);
    const Vector3 x = from + random.point(1.5);
    const Vector3 y = from + random.point(1.5);
    const Vector3 z = from + random.point(1.5);
    compare(compute_sphere_hull, Ball{x, 0}, hull);
    compare(compute_capsule_hull, Capsule{x, y, 0}, hull);
    compare(compute_triangle_hull, Triangle{{x, y, z}}, hull);
    compare(compute_cube_hull, Box{x - Vector3(1, 0.5, 0.75), x}, hull);
    const double w = random.number(1, 2);
    compare(compute_obb_hull, Obb{y, {0.5, w - 1, -0.25, w}, {0.5, 0.25, 1}}, hull);
    compare(compute_hull_hull, random.hull(12, far), hull);
  }
  EXPECT_GT(overlapping, 100);
  EXPECT_GT(apart, 20);
  EXPECT_LT(left, 8);
}

TEST(ConvexesEnclosed, leaves_what_touches_a_hull_or_ties_but_for_rounding) {
  using namespace kernel;
  RandomHulls random;
  for (int i = 0; i < 200; ++i) {
    const Vector3 center = random.point(3);
    const Hull hull = random.octahedron(center);
    const auto& v = hull.vertices;
    // Eight facets are as near, then two.
    EXPECT_EQ(RandomHulls::certain(Ball{center, 0}, hull).open, kAllNumbers) << i;
    EXPECT_EQ(RandomHulls::certain(Ball{0.75 * center + 0.125 * (v[0] + v[2]), 0}, hull).open, kAllNumbers) << i;
    // In the middle of a facet, of an edge, and a corner.
    for (const Vector3& x : {Vector3((v[0] + v[2] + v[4]) / 3), Vector3((v[0] + v[2]) / 2), v[0]}) {
      EXPECT_EQ(near_side(near_core(Ball{x, 0}), near_core(hull), 0), NearSide::unknown) << i;
      EXPECT_EQ(RandomHulls::certain(Ball{x, 0}, hull).open, kAllNumbers) << i;
    }
    EXPECT_EQ(RandomHulls::certain(Ball{(15 * center + v[0] + v[2] + 2 * v[4]) / 19, 0}, hull).open, 0U) << i;
  }
}

}  // namespace
}  // namespace contact::convexes_test
