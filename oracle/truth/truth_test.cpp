// The truth of worked examples, and the two oracles against each other on hostile questions.
#include "oracle/truth/truth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "extreme_numbers.hpp"
#include "oracle/truth/cores.hpp"
#include "oracle/truth/interval_oracle.hpp"

namespace contact::oracle::truth_test {
namespace {

Query spheres(const Ball& a, const Ball& b, double alarm = 0, double contact = 0) {
  return {Pair::sphere_sphere, Balls{a, b}, {alarm, contact}};
}
Query cubes(const Box& a, const Box& b, double alarm = 0) { return {Pair::cube_cube, Boxes{a, b}, {alarm, 0}}; }

/// The worked example of the contract: distance 3 = 1.5 + 1.5.
Query worked_example() { return spheres({{0, 0, 0}, 1.5}, {{1, 2, 2}, 1.5}, 0, 0.25); }

void expect_contact(const Query& query, Scalar scalar, const Contact& expected) {
  const Expectation actual = expectation(truth_of(query), scalar);
  EXPECT_TRUE(actual.hit);
  EXPECT_EQ(first_difference(actual, {true, expected}), std::nullopt);
  EXPECT_EQ(first_difference(interval_answer(query, scalar).expected, {true, expected}), std::nullopt);
}

/// The exact and the interval oracle read one description of a shape, so that a mistake in it would be one of both.
template <class Shape>
void expect_sound_description(const Shape& shape, std::size_t vertices, std::size_t edges, std::size_t faces) {
  const ExactCore core = exact_core(shape);
  std::array<std::vector<Feature>, 3> of;
  for (const Feature& feature : core.features) of[feature.dimension()].push_back(feature);
  EXPECT_EQ(core.vertices.size(), vertices);
  EXPECT_EQ(of[0].size(), vertices);
  EXPECT_EQ(of[1].size(), edges);
  EXPECT_EQ(of[2].size(), faces);
  for (std::size_t v = 0; v < vertices; ++v) EXPECT_EQ(of[0][v].places[0], v);
  for (const Feature& face : of[2]) {
    const auto corner = [&](std::size_t k) { return core.vertices[face.places[k]]; };
    if (face.is_parallelogram()) {
      EXPECT_EQ(corner(3) - corner(1), corner(2) - corner(0));
    }
    // As many edges as corners, and every corner on two of them.
    std::size_t inside = 0;
    std::array<std::size_t, kMostVertices> met{};
    for (const Feature& edge : of[1])
      if (face.has(edge.places[0]) && face.has(edge.places[1])) ++inside, ++met[edge.places[0]], ++met[edge.places[1]];
    EXPECT_EQ(inside, face.size);
    for (const std::size_t v : face.corners()) EXPECT_EQ(met[v], 2U);
  }
  for (std::size_t k = 0; k < core.outward.size(); ++k)
    for (std::size_t v = 0; v < vertices; ++v) {
      const Point from_face = core.vertices[v] - core.vertices[core.faces()[k].places[0]];
      EXPECT_EQ(CGAL::sign(dot(core.outward[k], from_face)), core.faces()[k].has(v) ? CGAL::ZERO : CGAL::NEGATIVE);
    }
}
TEST(Cores, are_described_as_what_they_are) {
  expect_sound_description(Ball{{1, 2, 3}, 4}, 1, 0, 0);
  expect_sound_description(Capsule{{1, 2, 3}, {4, 6, 8}, 1}, 2, 1, 0);
  expect_sound_description(Triangle{{Vector3{1, 2, 3}, Vector3{4, 6, 8}, Vector3{0, 1, 7}}}, 3, 3, 1);
  const Box box{{1, 2, 3}, {4, 6, 8}};
  expect_sound_description(box, 8, 12, 6);
  EXPECT_EQ(exact_core(box).outward.size(), 6U);
  for (const Point& corner : exact_core(box).vertices)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<Eigen::Index>(axis);
      EXPECT_TRUE(corner[axis] == Rational(box.min[i]) || corner[axis] == Rational(box.max[i]));
    }
  EXPECT_EQ(exact_core(Ray{{1, 2, 3}, {1, 0, -1}, 2}).vertices[1], point_of({3, 2, 1}));
}

/// The corners of a box as points, some of them twice, and points between them.
Hull hull_of(const Box& box) {
  Hull hull{{}, 0};
  for (int k = 0; k < 8; ++k)
    hull.vertices.emplace_back((k & 1 ? box.max : box.min)[0], (k & 2 ? box.max : box.min)[1],
                               (k & 4 ? box.max : box.min)[2]);
  for (const std::size_t k : {std::size_t{0}, std::size_t{5}}) hull.vertices.push_back(hull.vertices[k]);
  hull.vertices.push_back((box.min + box.max) / 2);
  hull.vertices.push_back((hull.vertices[0] + hull.vertices[3]) / 2);  // in a face
  hull.vertices.push_back((hull.vertices[0] + hull.vertices[4]) / 2);  // on an edge
  return hull;
}

TEST(Cores, of_hulls_are_what_their_points_span) {
  expect_sound_description(Hull{{{1, 2, 3}, {1, 2, 3}}, 4}, 1, 0, 0);
  expect_sound_description(Hull{{{2, 4, 6}, {1, 2, 3}, {4, 8, 12}, {3, 6, 9}}, 1}, 2, 1, 0);
  expect_sound_description(Hull{{{1, 2, 3}, {4, 6, 8}, {0, 1, 7}, {2.5, 4, 5.5}}, 0}, 3, 3, 1);
  expect_sound_description(Hull{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.125, 0.125, 0.125}}, 0}, 4, 6, 4);
  expect_sound_description(
      Hull{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {0.25, 0.25, 0.25}}, 0}, 6, 12, 8);
  // A square in a plane is two triangles; its middle and the middle of a side are no corners.
  const ExactCore square = exact_core(Hull{{{0, 0, 1}, {1, 1, 1}, {2, 0, 1}, {0, 2, 1}, {2, 2, 1}, {1, 0, 1}}, 0});
  EXPECT_EQ(square.vertices.size(), 4U);
  EXPECT_TRUE(square.outward.empty());
  EXPECT_EQ(square.features.size(), 4U + 4U + 2U);
}

TEST(Cores, of_round_hulls_are_closed) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> within(-1, 1);
  for (int count = 4; count <= static_cast<int>(kMostVertices); count += 12) {
    Hull hull{{}, 0};
    while (static_cast<int>(hull.vertices.size()) < count) {
      const double x = within(random);
      const double y = within(random);
      const double z = within(random);
      const Vector3 v(x, y, z);
      if (v.norm() > 0.5) hull.vertices.push_back(v.normalized());
    }
    const auto n = static_cast<std::size_t>(count);
    expect_sound_description(hull, n, 3 * n - 6, 2 * n - 4);
  }
}

TEST(Truth, of_a_hull_is_that_of_the_box_that_it_is) {
  const Box box{{1, 2, 3}, {4, 6, 8}};
  const std::array balls{Ball{{0, 0, 0}, 1},     Ball{{2, 3, 9}, 2}, Ball{{2, 3, 4}, 0.5},    Ball{{1, 2, 3}, 0},
                         Ball{{2.5, 4, 5.5}, 1}, Ball{{5, 3, 3}, 3}, Ball{{1.0 / 3, 7, 8}, 9}};
  for (const Ball& ball : balls) {
    const Obb same{(box.min + box.max) / 2, {0, 0, 0, 1}, (box.max - box.min) / 2};
    const Query of_box{Pair::sphere_obb, Convexes{{ball}, {same}}, {1, 0.25}};
    const Query of_hull{Pair::sphere_hull, Convexes{{ball}, {hull_of(box)}}, {1, 0.25}};
    const Expectation expected = expectation(truth_of(of_box), Scalar::binary64);
    EXPECT_EQ(first_difference(expectation(truth_of(of_hull), Scalar::binary64), expected), std::nullopt);
    EXPECT_EQ(first_difference(interval_answer(of_hull, Scalar::binary64).expected, expected), std::nullopt);
    EXPECT_EQ(witness(truth_of(of_hull), Scalar::binary64), witness(truth_of(of_box), Scalar::binary64));
  }
}

TEST(Truth, of_a_point_an_ulp_beside_the_face_of_a_box) {
  // Turned by the angle of a triangle with sides 3, 4 and 5: a face lies in 3 x + 4 y = 25. Its corners are no doubles, and so far away that their
  // intervals do not tell.
  const Obb box{{0, 0, 0}, {0, 0, 1, 2}, {5, 1023, 1}};
  constexpr double kUlp = 0x1p-50;
  for (const double off : {-kUlp, 0.0, kUlp}) {
    const Truth truth = truth_of({Pair::sphere_obb, Convexes{{Ball{{3, 4 + off, 0}, 0}}, {box}}, {1, 0}});
    const Rational off2 = Rational(off) * Rational(off) * Rational(16) / Rational(25);
    EXPECT_EQ(truth.distance()->overlaps(), off < 0) << off;
    EXPECT_EQ(truth.distance()->distance2(), off > 0 ? off2 : Rational(0)) << off;
    if (off < 0) {
      EXPECT_EQ(truth.distance()->meeting().depth2, off2);
    }
  }
}

TEST(Truth, of_two_tetrahedra_that_overlap) {
  // Corners of a cube cut off by planes, the second one turned about the centre of the first one's slanted face x + y + z = 3, and moved in by 1 of sqrt(3).
  const Hull a{{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}}, 0.5};
  Hull b{{}, 0.25};
  for (const Vector3& v : a.vertices) b.vertices.push_back(Vector3::Constant(2 - 1.0 / 4) - v);
  // b reaches down to x + y + z = 5.25 - 3 along the same face: 0.75 below it, whose depth is 0.75 / sqrt(3).
  const double depth = 0.75 / std::sqrt(3.0);
  const Expectation found = expectation(truth_of({Pair::hull_hull, Convexes{{a}, {b}}, {0, 0}}), Scalar::binary64);
  ASSERT_TRUE(found.hit);
  EXPECT_NEAR(found.contact->value, -depth - 0.75, 1e-15);
  EXPECT_NEAR(found.contact->normal[0], 1 / std::sqrt(3.0), 1e-15);
  EXPECT_EQ(found.contact->normal[0], found.contact->normal[2]);
  EXPECT_FALSE(found.contact->unique);
}

TEST(Truth, of_the_worked_example) {
  expect_contact(worked_example(), Scalar::binary64,
                 {{1.0 / 3, 2.0 / 3, 2.0 / 3}, {0.5, 1, 1}, {0.5, 1, 1}, -0.25, false});
  const auto third = static_cast<double>(1.0F / 3.0F);
  const auto two_thirds = static_cast<double>(2.0F / 3.0F);
  expect_contact(worked_example(), Scalar::binary32,
                 {{third, two_thirds, two_thirds}, {0.5, 1, 1}, {0.5, 1, 1}, -0.25, false});
}

TEST(Truth, gives_the_witness_of_the_worked_example) {
  const Truth truth = truth_of(worked_example());
  EXPECT_EQ(truth.at_alarm, Side::at);
  EXPECT_EQ(truth.at_zero, Side::at);
  for (const Scalar scalar : kScalars) EXPECT_EQ(witness(truth, scalar), (Witness{"0x9p0", "0x3p0", 0, {}}));
}

TEST(Truth, measures_the_margin_in_ulps_of_the_reach) {
  // distance 3, reach 2: 1 over ulp(2) = 2^-51, or 2^-22
  const Truth apart = truth_of(spheres({{0, 0, 0}, 1}, {{1, 2, 2}, 1}));
  EXPECT_EQ(witness(apart, Scalar::binary64).margin_ulps, 0x1p51);
  EXPECT_EQ(witness(apart, Scalar::binary32).margin_ulps, 0x1p22);
  // reach 3 + 1 = 4: -1 over ulp(4) = 2^-50
  EXPECT_EQ(witness(truth_of(spheres({{0, 0, 0}, 1.5}, {{1, 2, 2}, 1.5}, 1)), Scalar::binary64).margin_ulps, -0x1p50);
  // reach 3 - 2^-52: one half of ulp(2) = 2^-51 beyond it
  const double below = std::nextafter(1.5, 0.0);
  EXPECT_EQ(witness(truth_of(spheres({{0, 0, 0}, 1.5}, {{1, 2, 2}, below})), Scalar::binary64).margin_ulps, 0.5);
  // reach 0: 1 over 2^-1074 overflows
  EXPECT_EQ(witness(truth_of(spheres({{0, 0, 0}, 0}, {{1, 0, 0}, 0})), Scalar::binary64).margin_ulps, kInfinity);
  EXPECT_EQ(witness(truth_of(spheres({{0, 0, 0}, 0}, {{1, 0, 0}, 0})), Scalar::binary32).margin_ulps, 0x1p149);
}

TEST(Truth, of_coincident_centres_has_the_normal_1_0_0) {
  expect_contact(spheres({{3, 4, 5}, 1}, {{3, 4, 5}, 2}, 0, 0.25), Scalar::binary64,
                 {{1, 0, 0}, {4, 4, 5}, {1, 4, 5}, -3.25, true});
  EXPECT_TRUE(truth_of(spheres({{0, 0, 0}, 0}, {{-0.0, 0, 0}, 0})).degenerate());
  EXPECT_FALSE(truth_of(spheres({{0, 0, 0}, 0}, {{kLeast, 0, 0}, 0})).degenerate());
}

TEST(Truth, knows_the_alarm_from_touching) {
  const Truth truth = truth_of(spheres({{0, 0, 0}, 1}, {{3, 0, 4}, 2}, 2));  // distance 5, gap 2
  EXPECT_EQ(truth.at_alarm, Side::at);
  EXPECT_EQ(truth.at_zero, Side::beyond);
  EXPECT_TRUE(truth.hit());
  EXPECT_FALSE(truth_of(spheres({{0, 0, 0}, 1}, {{3, 0, 4}, 2}, std::nextafter(2.0, 0.0))).hit());
}

TEST(Truth, has_points_for_every_convention) {
  // n = (0.6, 0, 0.8); radii 1 and 2
  const Truth truth = truth_of(spheres({{0, 0, 0}, 1}, {{3, 0, 4}, 2}, 2));
  const DistanceTruth& s = *truth.distance();
  EXPECT_EQ(round_to_nearest(s.point(0, 0, PointOn::nearest_surface), Scalar::binary64), 0.6);
  EXPECT_EQ(round_to_nearest(s.point(0, 0, PointOn::center), Scalar::binary64), 0);
  EXPECT_EQ(round_to_nearest(s.point(0, 0, PointOn::far_surface), Scalar::binary64), -0.6);
  EXPECT_EQ(round_to_nearest(s.point(1, 2, PointOn::nearest_surface), Scalar::binary64), 2.4);
  EXPECT_EQ(round_to_nearest(s.point(1, 2, PointOn::center), Scalar::binary64), 4);
  EXPECT_EQ(round_to_nearest(s.point(1, 2, PointOn::far_surface), Scalar::binary64), 5.6);
  EXPECT_EQ(round_to_nearest(s.midpoint(0), Scalar::binary64), 1.2);  // (0.6 + 1.8) / 2
  EXPECT_EQ(round_to_nearest(s.midpoint(2), Scalar::binary64), 1.6);  // (0.8 + 2.4) / 2
}

TEST(Truth, measures_each_field_by_its_scale) {
  const Truth truth = truth_of(spheres({{0, -9, 0}, 1}, {{3, -9, 4}, 20}, 2, 0.5));
  EXPECT_EQ(truth.distance()->value_scale().compare(Rational(21)), CGAL::EQUAL);  // max(5, 1 + 20, 0.5)
  EXPECT_EQ(truth.distance()->point_scale(0).compare(Rational(9)), CGAL::EQUAL);  // max(|0|, |-9|, |0|, 1)
  EXPECT_EQ(truth.distance()->point_scale(1).compare(Rational(20)), CGAL::EQUAL);
  EXPECT_EQ(truth_of(spheres({{0, 0, 0}, 1}, {{3, 0, 4}, 2}, 9, 8)).distance()->value_scale().compare(Rational(8)),
            CGAL::EQUAL);
  EXPECT_EQ(truth_of(spheres({{0, 0, 0}, 1}, {{3, 0, 4}, 2}, 9, 1)).distance()->value_scale().compare(Rational(5)),
            CGAL::EQUAL);
}

TEST(Truth, of_numbers_at_the_ends_of_the_range) {
  // reach 2 M = distance; both points the origin
  expect_contact(spheres({{kLargest, 0, 0}, kLargest}, {{-kLargest, 0, 0}, kLargest}), Scalar::binary64,
                 {{-1, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0, false});
  // in units of 2^-1074: length 5 = 2 + 3, points (1.2, 1.6)
  expect_contact(spheres({{0, 0, 0}, 2 * kLeast}, {{3 * kLeast, 4 * kLeast, 0}, 3 * kLeast}), Scalar::binary64,
                 {{0.6, 0.8, 0}, {kLeast, 2 * kLeast, 0}, {kLeast, 2 * kLeast, 0}, 0, false});
  // binary32: the points and the value overflow it, the normal does not
  expect_contact(spheres({{0, 0, 0}, 0x1p200}, {{0x1p100, 0, 0}, 0}), Scalar::binary32,
                 {{1, 0, 0}, {kInfinity, 0, 0}, {0x1p100, 0, 0}, -kInfinity, false});
}

TEST(Truth, of_cubes_is_the_gap_on_every_axis) {
  // the contract's worked pair: x touches, y and z overlap by 1
  const Truth truth = truth_of(cubes({{0, 0, 0}, {1, 1, 1}}, {{1, 0, 0}, {2, 1, 1}}, 0.5));
  EXPECT_EQ(witness(truth, Scalar::binary64), (Witness{"", "", 0, {"0x0p0", "-0x1p0", "-0x1p0"}}));
  EXPECT_EQ(truth.at_zero, Side::at);
  EXPECT_EQ(truth.at_alarm, Side::within);
  // 0.5 apart on z, the second below the first
  const Truth apart = truth_of(cubes({{0, 0, 2}, {1, 1, 3}}, {{0, 0, 0}, {1, 1, 1.5}}, 0.5));
  EXPECT_EQ(apart.gaps()->gap()[2], Rational(1) / Rational(2));
  EXPECT_EQ(apart.at_alarm, Side::at);
  EXPECT_EQ(apart.at_zero, Side::beyond);
  EXPECT_FALSE(truth_of(cubes({{0, 0, 2}, {1, 1, 3}}, {{0, 0, 0}, {1, 1, 1.5}}, std::nextafter(0.5, 0.0))).hit());
}

// The two oracles on hostile questions.

class Hostile {
 public:
  explicit Hostile(std::uint64_t seed) : random_(seed) {}

  Query spheres() {
    Query query = truth_test::spheres({{0, 0, 0}, 0}, {{0, 0, 0}, 0});
    fill(query);
    auto& balls = std::get<Balls>(query.shapes);
    if (random_() % 8 == 0) balls.b.center = balls.a.center;
    if (random_() % 8 == 0) {  // exactly touching: 2^2 + 3^2 + 6^2 = 7^2
      const double unit = std::ldexp(1.0, static_cast<int>(random_() % 2040) - 1060);
      const double first = static_cast<double>(random_() % 8);
      const Vector3 corner(integer(9), integer(9), integer(9));
      balls = {{corner * unit, first * unit}, {(corner + Vector3(2, -3, 6)) * unit, (7 - first) * unit}};
      if (random_() % 2 == 0) query.distances.alarm = 0;
      return query;
    }
    if (random_() % 4 == 0) {  // beside touching
      double r = (balls.b.center - balls.a.center).norm() - balls.a.radius;
      if (random_() % 2 == 0) r = std::nextafter(r, random_() % 2 == 0 ? kInfinity : 0.0);
      if (std::isfinite(r) && r >= 0) {
        balls.b.radius = r;
        query.distances.alarm = 0;
      }
    }
    return query;
  }

  Query cubes() {
    Query query = truth_test::cubes({{0, 0, 0}, {0, 0, 0}}, {{0, 0, 0}, {0, 0, 0}});
    fill(query);
    auto& boxes = std::get<Boxes>(query.shapes);
    for (Box* box : {&boxes.a, &boxes.b})
      for (int axis = 0; axis < 3; ++axis)
        if (box->min[axis] > box->max[axis]) std::swap(box->min[axis], box->max[axis]);
    return query;
  }

 private:
  void fill(Query& query) {
    const auto kind = random_() % 5;
    const int exponent = static_cast<int>(random_() % 2040) - 1060;
    for_each_number(query, [&](const std::string& field, double& x) {
      x = kind == 0   ? finite(random_())                                                 // raw bits
          : kind == 1 ? finite(random_() & 0x800fffffffffffffU)                           // subnormals
          : kind == 2 ? extreme()                                                         // ends of the range
          : kind == 3 ? std::ldexp(integer(9), exponent)                                  // ties, touching
                      : std::ldexp(integer(9), static_cast<int>(random_() % 140) - 140);  // binary32's lower end
      const bool length = field.ends_with("radius") || field == "alarm" || field == "contact";
      if (length) x = std::abs(x);
    });
  }
  static double finite(std::uint64_t bits) {
    const auto x = std::bit_cast<double>(bits);
    return std::isfinite(x) ? x : std::bit_cast<double>(bits & ~(std::uint64_t{1} << 62));
  }
  double integer(int limit) {
    return static_cast<double>(static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(2 * limit + 1)) -
                               limit);
  }
  double extreme() {
    constexpr double kExtremes[] = {0,       kLeast,   0x1p-1022, 0x1p-600,       0x1p-149, 0x1p-126,   1,    0x1p127,
                                    0x1p600, 0x1p1023, kLargest,  0x1.fffffep127, 0.375,    0x1.8p-150, -0.0, 3};
    const double x = kExtremes[random_() % std::size(kExtremes)];
    return random_() % 2 == 0 ? x : -x;
  }

  std::mt19937_64 random_;
};

int sign(Side s) { return static_cast<int>(s); }

void expect_oracles_agree(const Query& query, Scalar scalar) {
  ASSERT_FALSE(outside_domain(query));
  const Truth truth = truth_of(query);
  const RoundedAnswer other = interval_answer(query, scalar);
  ASSERT_EQ(sign(truth.at_alarm), other.at_alarm);
  ASSERT_EQ(sign(truth.at_zero), other.at_zero);
  ASSERT_EQ(first_difference(expectation(truth, scalar), other.expected), std::nullopt);
}

TEST(Oracles, agree_on_hostile_spheres_in_both_scalars) {
  Hostile hostile(31);
  int hits = 0;
  int touching = 0;
  int degenerate = 0;
  int infinite = 0;
  constexpr int kCount = 6000;
  for (int i = 0; i < kCount; ++i) {
    const Query query = hostile.spheres();
    for (const Scalar scalar : kScalars) ASSERT_NO_FATAL_FAILURE(expect_oracles_agree(query, scalar)) << i;
    const Truth truth = truth_of(query);
    hits += truth.hit() ? 1 : 0;
    touching += truth.at_alarm == Side::at || truth.at_zero == Side::at ? 1 : 0;
    degenerate += truth.degenerate() ? 1 : 0;
    infinite += truth.hit() && std::isinf(expectation(truth, Scalar::binary32).contact->value) ? 1 : 0;
  }
  EXPECT_GT(hits, kCount * 3 / 10);
  EXPECT_LT(hits, kCount * 7 / 10);
  EXPECT_GT(touching, kCount / 50);
  EXPECT_GT(degenerate, kCount / 20);
  EXPECT_GT(infinite, kCount / 50);
}

// D lies so little above the square of 2^1023 + 2^500 that GMP 6.2.1 takes its leading digits for a perfect square.
TEST(Oracles, agree_where_gmp_takes_a_number_for_a_perfect_square) {
  const Query query{
      Pair::sphere_sphere, Balls{{{0x1p500, -0x1p-400, -1}, 0}, {{-0x1p1023, 0, 0}, 0x1p1023}}, {kLargest, 0}};
  expect_oracles_agree(query, Scalar::binary64);
  // -2^1023 + 2^1023 cos with 1 - cos = 2^-2047, but for a 2^-400th of that
  EXPECT_EQ(interval_answer(query, Scalar::binary64).expected.contact->point2[0], -0x1p-1024);
}

TEST(Oracles, agree_on_hostile_cubes_in_both_scalars) {
  Hostile hostile(32);
  int hits = 0;
  int touching = 0;
  constexpr int kCount = 4000;
  for (int i = 0; i < kCount; ++i) {
    const Query query = hostile.cubes();
    for (const Scalar scalar : kScalars) ASSERT_NO_FATAL_FAILURE(expect_oracles_agree(query, scalar)) << i;
    const Truth truth = truth_of(query);
    hits += truth.hit() ? 1 : 0;
    touching += truth.at_alarm == Side::at || truth.at_zero == Side::at ? 1 : 0;
  }
  EXPECT_GT(hits, kCount * 3 / 10);
  EXPECT_LT(hits, kCount * 7 / 10);
  EXPECT_GT(touching, kCount / 50);
}

}  // namespace
}  // namespace contact::oracle::truth_test
