// Tolerances, and what the inputs' last bit does: every expectation follows from docs/specification.md#tolerances and
// from numbers worked out by hand.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "extreme_numbers.hpp"
#include "oracle/judge/certain.hpp"
#include "oracle/judge/conditioning.hpp"
#include "oracle/judge/judge.hpp"

namespace contact::oracle::tolerance_test {
namespace {

Query spheres(const Ball& a, const Ball& b, double alarm = 0, double contact = 0) {
  return {Pair::sphere_sphere, Balls{a, b}, {alarm, contact}};
}
// 5 apart along (0.6, 0.8, 0), radii 1 and 1: value 3, and a contact by an alarm distance of 4
Query apart() { return spheres({{0, 0, 0}, 1}, {{3, 4, 0}, 1}, 4); }

Claim says(bool hit) {
  Claim claim;
  claim.overlap = hit;
  return claim;
}
Claim says(const ContactClaim& contact) {
  Claim claim;
  claim.speaks_of_contact = true;
  claim.contact = contact;
  return claim;
}
Claim value_of(double value) {
  ContactClaim contact;
  contact.value = value;
  return says(contact);
}
Claim normal_of(const Vector3& n) {
  ContactClaim contact;
  contact.normal = n;
  return says(contact);
}

/// Judged by a tolerance, of the fields that the claim has.
Verdict judged(const Query& query, const Claim& claim, const Tolerance& tolerance, Conventions conventions = {}) {
  const Declaration declared{Scalar::binary64, conventions, {}, claim.says(), tolerance};
  return judge(query, truth_of(query), claim, declared);
}
bool within(const Query& query, const Claim& claim, const Tolerance& tolerance, const Conventions& conventions = {}) {
  return judged(query, claim, tolerance, conventions).within();
}

TEST(Tolerance, a_length_may_be_off_by_so_much_and_no_more) {
  const double off = 0x1p-10;
  for (const double value : {3 + off, 3 - off}) {
    EXPECT_TRUE(within(apart(), value_of(value), {.length = off}));
    EXPECT_FALSE(within(apart(), value_of(value), {.length = below(off)}));
  }
  EXPECT_EQ(judged(apart(), value_of(3 + off), {}).at(Measure::length).most, off);
}

TEST(Tolerance, a_share_is_one_of_the_fields_scale) {
  // value: max(5, 1 + 1, 0) = 5
  EXPECT_TRUE(within(apart(), value_of(3 + 5 * 0x1p-10), {.relative = 0x1p-10}));
  EXPECT_FALSE(within(apart(), value_of(3 + 5 * 0x1p-10), {.relative = below(0x1p-10)}));
  EXPECT_EQ(judged(apart(), value_of(3 + 5 * 0x1p-10), {}).at(Measure::length).relative, 0x1p-10);
  // Both together: 0.5 + 0.1 * 5 is a little more than 1, 0.1 being more than a tenth.
  EXPECT_TRUE(within(apart(), value_of(4), {.length = 0.5, .relative = 0.1}));
  EXPECT_FALSE(within(apart(), value_of(4), {.length = 0.5, .relative = below(0.1)}));
}

TEST(Tolerance, a_correctly_rounded_number_is_within_any) {
  const Query root = spheres({{0, 0, 0}, 0}, {{1, 1, 0}, 0}, 2);
  EXPECT_TRUE(within(root, value_of(std::numbers::sqrt2), {}));
  EXPECT_FALSE(within(root, value_of(below(std::numbers::sqrt2)), {}));
  EXPECT_TRUE(within(root, value_of(below(std::numbers::sqrt2)), {.length = 0x1p-52}));
}

TEST(Tolerance, points_are_lengths_coordinate_by_coordinate) {
  ContactClaim contact;
  contact.point1 = Vector3(2, 0.25, 0);  // of (2,0,0): scale 2
  const Query query = spheres({{0, 0, 0}, 2}, {{4, 0, 0}, 3});
  EXPECT_TRUE(within(query, says(contact), {.length = 0.25}));
  EXPECT_FALSE(within(query, says(contact), {.length = below(0.25)}));
  EXPECT_TRUE(within(query, says(contact), {.relative = 0.125}));
  EXPECT_FALSE(within(query, says(contact), {.relative = below(0.125)}));
}

// Neither pi / 4 nor 3 pi / 4 is a double, and the doubles nearest to them are below.
TEST(Tolerance, an_angle_is_compared_exactly) {
  const Query along_x = spheres({{0, 0, 0}, 1}, {{2, 0, 0}, 1});
  const Conventions any_length{.normal_unit = false};
  for (const auto& [normal, nearest] :
       {std::pair{Vector3(1, 1, 0), std::numbers::pi / 4}, {Vector3(-7, 0, 7), 3 * (std::numbers::pi / 4)}}) {
    EXPECT_FALSE(within(along_x, normal_of(normal), {.angle = nearest}, any_length));
    EXPECT_TRUE(within(along_x, normal_of(normal), {.angle = above(nearest)}, any_length));
    EXPECT_EQ(judged(along_x, normal_of(normal), {}, any_length).at(Measure::angle).most, above(nearest));
  }
  EXPECT_FALSE(within(along_x, normal_of({0, 3, 0}), {.angle = std::numbers::pi / 2}, any_length));
  EXPECT_TRUE(within(along_x, normal_of({0, 3, 0}), {.angle = above(std::numbers::pi / 2)}, any_length));
  EXPECT_FALSE(within(along_x, normal_of({-1, 0, 0}), {.angle = std::numbers::pi}));
  EXPECT_TRUE(within(along_x, normal_of({-1, 0, 0}), {.angle = above(std::numbers::pi)}));
  EXPECT_TRUE(within(along_x, normal_of({5, 0, 0}), {}, any_length));
  EXPECT_FALSE(within(along_x, normal_of({0, 0, 0}), {.angle = 3.14}, any_length));
}

TEST(Tolerance, a_unit_normal_may_be_longer_or_shorter_by_the_angle) {
  const Query along_x = spheres({{0, 0, 0}, 1}, {{2, 0, 0}, 1});
  for (const double length : {1.25, 0.75}) {
    EXPECT_TRUE(within(along_x, normal_of({length, 0, 0}), {.angle = 0.25}));
    EXPECT_FALSE(within(along_x, normal_of({length, 0, 0}), {.angle = below(0.25)}));
  }
}

TEST(Tolerance, a_decision_may_be_wrong_so_near_to_where_it_changes) {
  // 5 apart, reach 1 + 1 + 2.5: a miss by 0.5, which is a ninth of the reach
  const Query miss = spheres({{0, 0, 0}, 1}, {{3, 4, 0}, 1}, 2.5);
  EXPECT_TRUE(within(miss, says(true), {.length = 0.5}));
  EXPECT_FALSE(within(miss, says(true), {.length = below(0.5)}));
  EXPECT_TRUE(within(miss, says(true), {.relative = above(1.0 / 9)}));
  EXPECT_FALSE(within(miss, says(true), {.relative = below(1.0 / 9)}));
  EXPECT_TRUE(within(miss, says(false), {}));
  const Query hit = spheres({{0, 0, 0}, 1}, {{3, 4, 0}, 1}, 3.5);
  EXPECT_TRUE(within(hit, says(false), {.length = 0.5}));
  EXPECT_FALSE(within(hit, says(false), {.length = below(0.5)}));
}

// sqrt 2 - 1 = 0.41421356237309504880..., and the double nearest to it is below
TEST(Tolerance, an_irrational_distance_is_compared_exactly) {
  const Query miss = spheres({{0, 0, 0}, 1}, {{1, 1, 0}, 0});
  const double nearest = 0.41421356237309503;
  EXPECT_FALSE(within(miss, says(true), {.length = nearest}));
  EXPECT_TRUE(within(miss, says(true), {.length = above(nearest)}));
  EXPECT_EQ(judged(miss, says(true), {}).at(Measure::decision).most, above(nearest));
}

TEST(Tolerance, a_decision_at_the_limit_may_go_either_way) {
  const Query touching = spheres({{0, 0, 0}, 1}, {{2, 0, 0}, 1});
  EXPECT_TRUE(within(touching, says(false), {}));
  EXPECT_TRUE(within(touching, says(true), {}));
}

TEST(Tolerance, without_a_margin_the_limit_is_touching) {
  const Conventions no_margin{.margin = Margin::none};
  const Query query = spheres({{0, 0, 0}, 1}, {{3, 4, 0}, 1}, 2.5);  // 3 apart
  EXPECT_TRUE(within(query, says(true), {.length = 3}, no_margin));
  EXPECT_FALSE(within(query, says(true), {.length = below(3)}, no_margin));
}

TEST(Tolerance, the_numbers_of_a_false_hit_that_is_allowed_are_judged) {
  const Query miss = spheres({{0, 0, 0}, 1}, {{2.5, 0, 0}, 1}, 0.25);  // value 0.5, and 0.25 beyond
  EXPECT_TRUE(within(miss, value_of(0.5), {.length = 0.25}));
  EXPECT_TRUE(within(miss, value_of(0.75), {.length = 0.25}));
  EXPECT_FALSE(within(miss, value_of(above(0.75)), {.length = 0.25}));
  EXPECT_FALSE(within(miss, value_of(std::nan("")), {.length = 1e6}));
}

TEST(Tolerance, no_tolerance_allows_what_is_no_answer) {
  const Tolerance wide{1e300, 1e300, 3.15};
  EXPECT_FALSE(within(apart(), value_of(kInfinity), wide));
  EXPECT_FALSE(within(apart(), normal_of({std::nan(""), 0, 0}), wide));
  Claim refused;
  refused.status = Claim::Status::unsupported;
  EXPECT_FALSE(within(apart(), refused, wide));
  const Declaration both{Scalar::binary64, {}, {}, Aspects{Aspect::contact, Aspect::value, Aspect::normal}, wide};
  EXPECT_FALSE(judge(apart(), truth_of(apart()), value_of(3), both).within());  // no normal
}

TEST(Tolerance, boxes_are_decided_by_the_widest_gap) {
  const Query boxes{Pair::cube_cube, Boxes{{{0, 0, 0}, {1, 1, 1}}, {{1.5, 9, 0}, {2, 10, 1}}}, {7.75, 0}};
  EXPECT_TRUE(within(boxes, says(true), {.length = 0.25}));  // 8 - 7.75
  EXPECT_FALSE(within(boxes, says(true), {.length = below(0.25)}));
}

TEST(Tolerance, inside_a_box_the_nearest_way_out_counts) {
  // 1 from the faces at x = 4 and y = 4: both are right
  const Query inside{Pair::sphere_cube, BallAndBox{{{3, 3, 0}, 0}, {{-4, -4, -4}, {4, 4, 4}}}, {0, 0}};
  const Conventions any_length{.normal_unit = false};
  for (const Vector3& n : {Vector3(-1, 0, 0), Vector3(0, -1, 0)}) EXPECT_TRUE(within(inside, normal_of(n), {}));
  EXPECT_FALSE(within(inside, normal_of({-1, -1, 0}), {.angle = std::numbers::pi / 4}, any_length));
  EXPECT_TRUE(within(inside, normal_of({-1, -1, 0}), {.angle = above(std::numbers::pi / 4)}, any_length));
  EXPECT_EQ(judged(inside, normal_of({0, 0, 1}), {}).at(Measure::angle).most, above(std::numbers::pi / 2));
}

TEST(Tolerance, where_cores_touch_a_normal_may_point_against_them_by_the_angle) {
  // The sphere's centre lies on the triangle, so that a normal is right which is across it.
  const Triangle triangle{{Vector3(0, 0, 0), Vector3(4, 0, 0), Vector3(0, 4, 0)}};
  const Query on{Pair::sphere_triangle, BallAndTriangle{{{1, 1, 0}, 1}, triangle}, {0, 0}};
  const Conventions any_length{.normal_unit = false};
  EXPECT_TRUE(within(on, normal_of({0, 0, 1}), {}));
  EXPECT_TRUE(within(on, normal_of({0, 0, -1}), {}));
  // (0,1,1) makes the angle 3 pi / 4 with (0,-1,0): pi / 4 too much, and no corner is further against it
  const Query below_corner{Pair::sphere_triangle, BallAndTriangle{{{0, 1, 0}, 1}, triangle}, {0, 0}};
  EXPECT_FALSE(within(below_corner, normal_of({0, 1, 1}), {.angle = std::numbers::pi / 4}, any_length));
  EXPECT_TRUE(within(below_corner, normal_of({0, 1, 1}), {.angle = above(std::numbers::pi / 4)}, any_length));
}

TEST(Tolerance, a_crossing_changes_at_the_boundary_or_the_plane) {
  const Triangle triangle{{Vector3(0, 0, 0), Vector3(4, 0, 0), Vector3(0, 4, 0)}};
  const auto line = [&](const Vector3& start, const Vector3& end) {
    return Query{Pair::triangle_line, TriangleAndLine{triangle, {start, end}}, {0, 0}};
  };
  const Query beside = line({-0.5, 1, -8}, {-0.5, 1, 8});  // 0.5 from the edge x = 0
  EXPECT_TRUE(within(beside, says(true), {.length = 0.5}));
  EXPECT_FALSE(within(beside, says(true), {.length = below(0.5)}));
  EXPECT_FALSE(within(beside, says(true), {.relative = 1}));  // there is no reach
  const Query over = line({1, 1, 0.25}, {1, 1, 8});           // 0.25 over the plane
  EXPECT_TRUE(within(over, says(true), {.length = 0.25}));
  EXPECT_FALSE(within(over, says(true), {.length = below(0.25)}));
  const Query through = line({1, 1, -8}, {1, 1, 0.125});  // a hit until its end comes to the plane
  EXPECT_TRUE(within(through, says(false), {.length = 0.125}));
  EXPECT_FALSE(within(through, says(false), {.length = below(0.125)}));
  const Query ray{Pair::ray_triangle, RayAndTriangle{{{1, 1, 3}, {0, 0, -1}, 2.75}, triangle}, {0, 0}};
  EXPECT_TRUE(within(ray, says(true), {.length = 0.25}));
  EXPECT_FALSE(within(ray, says(true), {.length = below(0.25)}));
}

// What all right answers have in common is asked with a larger alarm distance, and twice this distance is infinite.
TEST(Certain, shapes_so_far_apart_that_twice_their_distance_is_infinite_are_a_question_too) {
  const Query query{Pair::sphere_obb,
                    Convexes{{Ball{{-1e308, 0, 0}, 0}}, {Obb{{5e307, 0, 0}, {0, 0, 0, 1}, {1, 1, 1}}}},
                    {1.6e308, 0}};
  Declaration declared;
  declared.tolerance = Tolerance{.length = 1};
  const Certain all = certain(query, declared);
  EXPECT_EQ(all.left_out, "");
  EXPECT_TRUE(all.hit);
  ASSERT_FALSE(all.numbers.empty());
  EXPECT_DOUBLE_EQ(all.numbers.front().expected, -1e308);
  EXPECT_DOUBLE_EQ(all.numbers.back().expected, 1.5e308);
}

// ---- where the answer jumps: another answer is as good that is possible and nearly the best ----

constexpr double kEps = 0x1p-10;
const Conventions kAnyLength{.normal_unit = false};

/// Passes from a length on: just enough allows it, and what is just below does not.
void expect_from(double length, const Query& query, const Claim& claim, const Conventions& conventions = {}) {
  EXPECT_TRUE(within(query, claim, {.length = length}, conventions));
  EXPECT_FALSE(within(query, claim, {.length = below(length)}, conventions));
  const Verdict verdict = judged(query, claim, {}, conventions);
  const double need = std::max(verdict.at(Measure::length).most, verdict.at(Measure::decision).most);
  EXPECT_GE(need, length);
  EXPECT_LE(need, above(length));  // of a root, rounded up
}
/// The same where the length is a root: it lies between two numbers.
void expect_between(double low, double high, const Query& query, const Claim& claim,
                    const Conventions& conventions = {}) {
  EXPECT_TRUE(within(query, claim, {.length = high}, conventions));
  EXPECT_FALSE(within(query, claim, {.length = low}, conventions));
}

// The first axis along x, the second 2 above it and at its far end 2^-10 more: the nearest points are at x = 0.
Query nearly_parallel() {
  return {Pair::capsule_capsule, Capsules{{{0, 0, 0}, {8, 0, 0}, 0.5}, {{0, 0, 2}, {8, 0, 2 + kEps}, 0.5}}, {2, 0}};
}
ContactClaim at_the_far_end() {
  return {Vector3(0, 0, 1), Vector3(8, 0, 0.5), Vector3(8, 0, 1.5 + kEps), std::nullopt, 1.0};
}

TEST(Jump, of_nearly_parallel_axes_any_points_will_do_whose_distance_is_nearly_the_least) {
  expect_from(kEps, nearly_parallel(), says(at_the_far_end()));
  EXPECT_EQ(judged(nearly_parallel(), says(at_the_far_end()), {}).at(Measure::angle).most, 0);
  // A share of the scale, which is 8.
  EXPECT_TRUE(within(nearly_parallel(), says(at_the_far_end()), {.relative = kEps / 8}));
  EXPECT_FALSE(within(nearly_parallel(), says(at_the_far_end()), {.relative = below(kEps / 8)}));
}
TEST(Jump, both_points_must_be_of_one_answer) {
  // The first point at the far end, the second at the near one: each is right, and they are 8 apart.
  ContactClaim torn = at_the_far_end();
  torn.point2 = Vector3(0, 0, 1.5);
  EXPECT_FALSE(within(nearly_parallel(), says(torn), {.length = 1}));
  torn.point1 = Vector3(0, 0, 0.5);
  EXPECT_TRUE(within(nearly_parallel(), says(torn), {}));
}
TEST(Jump, points_must_lie_on_their_shapes) {
  for (const Vector3& off : {Vector3(0.25, 0, 0), Vector3(0, 0.25, 0), Vector3(0, 0, 0.25), Vector3(0, 0, -0.25)}) {
    // Both points move, so that they stay as far apart: past the end of the axis, beside it, above and below it.
    ContactClaim moved = at_the_far_end();
    *moved.point1 += off;
    *moved.point2 += off;
    EXPECT_FALSE(within(nearly_parallel(), says(moved), {.length = 0.125}));
    EXPECT_TRUE(within(nearly_parallel(), says(moved), {.length = 0.5}));
  }
}
TEST(Jump, one_point_alone_must_have_a_partner) {
  ContactClaim first;
  first.point1 = at_the_far_end().point1;
  // 2^-10 over the second axis, whose slope makes the distance a little less.
  const Conventions first_only{.points = Points::first_only};
  expect_between(kEps * 0.999, kEps, nearly_parallel(), says(first), first_only);
  ContactClaim second;
  second.point2 = at_the_far_end().point2;
  expect_from(kEps, nearly_parallel(), says(second), {.points = Points::second_only});
  ContactClaim middle;
  middle.point = Vector3(8, 0, 1 + kEps / 2);
  expect_from(kEps / 2, nearly_parallel(), says(middle), {.points = Points::midpoint});
  ContactClaim cores;
  cores.point1 = Vector3(8, 0, 0);
  cores.point2 = Vector3(8, 0, 2 + kEps);
  expect_from(kEps, nearly_parallel(), says(cores), {.points = Points::center});
  ContactClaim far = cores;
  far.point1 = Vector3(8, 0, -0.5);
  far.point2 = Vector3(8, 0, 2.5 + kEps);
  expect_from(kEps, nearly_parallel(), says(far), {.points = Points::published});
}

TEST(Jump, a_nearly_level_axis_touches_a_plane_anywhere) {
  // 1 above z = 0, and 2^-10 more at the far end, which is claimed
  const Query level{Pair::capsule_plane, CapsuleAndPlane{{{0, 0, 1}, {8, 0, 1 + kEps}, 0.5}, {{0, 0, 3}, 0}}, {1, 0}};
  ContactClaim end{Vector3(0, 0, -1), Vector3(8, 0, 0.5 + kEps), Vector3(8, 0, 0), std::nullopt, 0.5};
  expect_from(kEps, level, says(end));
  ContactClaim torn = end;
  torn.point2 = Vector3(7.5, 0, 0);
  EXPECT_FALSE(within(level, says(torn), {.length = 0.25}));
  // The normal is the plane's, and nothing that moves turns it.
  end.normal = Vector3(0, 0.5, -1);
  EXPECT_FALSE(within(level, says(end), {.length = 100}, kAnyLength));
}

TEST(Jump, of_two_faces_that_are_nearly_as_near_either_will_do) {
  // 1 below the face x = 4, 1 + 2^-10 below y = 4, which is claimed
  const Query inside{Pair::sphere_cube, BallAndBox{{{3, 3 - kEps, 0}, 0.5}, {{-4, -4, -4}, {4, 4, 4}}}, {0, 0}};
  const ContactClaim way{Vector3(0, -1, 0), Vector3(3, 2.5 - kEps, 0), Vector3(3, 4, 0), std::nullopt, -1.5};
  expect_from(kEps, inside, says(way));
  // The points of the one face and the normal of the other: 1 off.
  ContactClaim torn = way;
  torn.normal = Vector3(-1, 0, 0);
  EXPECT_FALSE(within(inside, says(torn), {.length = 0.5}));
  torn = {Vector3(0, -1, 0), Vector3(2.5, 3 - kEps, 0), Vector3(4, 3 - kEps, 0), std::nullopt, -1.5};
  EXPECT_FALSE(within(inside, says(torn), {.length = 0.5}));
  // Between two faces is none, and a third one is 3 farther.
  EXPECT_FALSE(within(inside, normal_of({-1, -1, 0}), {.length = 0.5}, kAnyLength));
  EXPECT_FALSE(within(inside, normal_of({0, 0, 1}), {.length = below(3)}));
  EXPECT_TRUE(within(inside, normal_of({0, 0, 1}), {.length = 3}));
}

const Triangle kCorner{{Vector3(0, 0, 0), Vector3(4, 0, 0), Vector3(0, 4, 0)}};

TEST(Jump, of_a_centre_that_nearly_lies_on_a_triangle_either_side_will_do) {
  // 2^-10 above the face. The other side is right for a centre on it or below, so that -n.a + n.b is twice that more.
  const Query over{Pair::sphere_triangle, BallAndTriangle{{{1, 1, kEps}, 0.5}, kCorner}, {0, 0}};
  const ContactClaim other{Vector3(0, 0, 1), Vector3(1, 1, 0.5 + kEps), Vector3(1, 1, 0), std::nullopt, kEps - 0.5};
  expect_from(2 * kEps, over, says(other));
  // The point must be on the side that the normal says.
  ContactClaim torn = other;
  torn.point1 = Vector3(1, 1, kEps - 0.5);
  EXPECT_FALSE(within(over, says(torn), {.length = 0.25}));
  // Where no normal is said, either may be meant: the centre is 2^-10 from the triangle. So far off is no point.
  const Conventions no_normal{.normal = NormalDirection::none};
  ContactClaim points{std::nullopt, other.point1, other.point2, std::nullopt, std::nullopt};
  expect_from(kEps, over, says(points), no_normal);
  points.point1 = Vector3(1, 1, 0.75);
  EXPECT_FALSE(within(over, says(points), {.length = 0.125}, no_normal));
  // Across the face, as where the centre is a corner: the triangle reaches 3 beyond the centre.
  EXPECT_FALSE(within(over, normal_of({-1, 0, 0}), {.length = below(3)}, kAnyLength));
  EXPECT_TRUE(within(over, normal_of({-1, 0, 0}), {.length = 3 + kEps}, kAnyLength));
}

TEST(Jump, a_normal_turns_as_far_as_a_length_turns_the_way_between_the_cores) {
  // Centres 5 * 2^-30 apart along x, and the normal (4,3,0): 3 * 2^-30 to the side.
  constexpr double kUnit = 0x1p-30;
  expect_from(3 * kUnit, spheres({{0, 0, 0}, 1}, {{5 * kUnit, 0, 0}, 1}), normal_of({4, 3, 0}), kAnyLength);
  // Past a right angle, as far as they are apart, and what they overlap along it more: 4 + 5.
  expect_from(9 * kUnit, spheres({{0, 0, 0}, 1}, {{5 * kUnit, 0, 0}, 1}), normal_of({-4, 3, 0}), kAnyLength);
  // The report says a length where that is much less than the angle, else the angle.
  const auto needs = [](double apart) {
    return judged(spheres({{0, 0, 0}, 1}, {{5 * apart, 0, 0}, 1}), normal_of({4, 3, 0}), {}, kAnyLength);
  };
  EXPECT_NEAR(needs(kUnit).at(Measure::length).most, 3 * kUnit, 1e-20);
  EXPECT_EQ(needs(kUnit).at(Measure::angle).most, 0);
  EXPECT_EQ(needs(1).at(Measure::length).most, 0);
  EXPECT_NEAR(needs(1).at(Measure::angle).most, std::atan2(3, 4), 1e-15);
}

TEST(Jump, a_normal_that_is_turned_must_still_separate) {
  // 2^-10 above a face that reaches 1 to either side: turned by 3 in 5 a normal points 0.6 against a corner.
  const Query over{Pair::sphere_triangle, BallAndTriangle{{{1, 1, kEps}, 0.5}, kCorner}, {0, 0}};
  EXPECT_FALSE(within(over, normal_of({0, 3, -4}), {.length = 0.5}, kAnyLength));
}

TEST(Jump, a_normal_that_rounding_alone_makes_may_be_any) {
  // On the face: plain doubles find a way of a few roundings there, and divide it by its length. The corners are up to
  // 4 from 0, so that 8 roundings are 2^-48; what is farther apart has a direction.
  for (const double height : {0.0, 0x1p-48}) {
    const Query on{Pair::sphere_triangle, BallAndTriangle{{{1, 1, height}, 0.5}, kCorner}, {0, 0}};
    expect_from(0x1p-48, on, normal_of({3, -4, 0}), kAnyLength);
  }
  const Query over{Pair::sphere_triangle, BallAndTriangle{{{1, 1, above(0x1p-48)}, 0.5}, kCorner}, {0, 0}};
  EXPECT_FALSE(within(over, normal_of({3, -4, 0}), {.length = 0.5}, kAnyLength));
  // The points go with it all the same.
  const Query on{Pair::sphere_triangle, BallAndTriangle{{{1, 1, 0}, 0.5}, kCorner}, {0, 0}};
  ContactClaim torn{Vector3(1, 0, 0), Vector3(0.5, 1, 0), Vector3(1, 1, 0), std::nullopt, -0.5};
  EXPECT_FALSE(within(on, says(torn), {.length = 0.5}));
  torn.point1 = Vector3(1.5, 1, 0);
  EXPECT_TRUE(within(on, says(torn), {.length = 0x1p-48}));
}

TEST(Jump, what_is_wrong_in_a_question_that_does_not_jump_stays_wrong) {
  const Tolerance game{1e-3, 1e-5, 1e-2};
  const double turn = 2 * std::numbers::pi / 180;
  const auto turned = [&](double x, double z) {  // about the y axis
    return Vector3(std::cos(turn) * x + std::sin(turn) * z, 0, std::cos(turn) * z - std::sin(turn) * x);
  };
  EXPECT_FALSE(within(spheres({{0, 0, 0}, 1}, {{1, 0, 0}, 1}), normal_of(turned(1, 0)), game));
  const Query face{Pair::sphere_triangle, BallAndTriangle{{{1, 1, 1}, 2}, kCorner}, {0, 0}};
  EXPECT_FALSE(within(face, normal_of(turned(0, -1)), game));
  const Query inside{Pair::sphere_cube, BallAndBox{{{3, 0, 0}, 0.5}, {{-4, -4, -4}, {4, 4, 4}}}, {0, 0}};
  EXPECT_FALSE(within(inside, normal_of(turned(-1, 0)), game));
  // 2 mm along the axis or across it, of crossing and of sloping axes.
  const Query crossing{
      Pair::capsule_capsule, Capsules{{{-1, 0, 0}, {1, 0, 0}, 0.25}, {{0, -1, 1}, {0, 1, 1}, 0.25}}, {1, 0}};
  const Query slope{Pair::capsule_plane, CapsuleAndPlane{{{0, 0, 1}, {1, 0, 2}, 0.5}, {{0, 0, 1}, 0}}, {1, 0}};
  for (const Vector3& off : {Vector3(2e-3, 0, 0), Vector3(0, 2e-3, 0), Vector3(0, 0, 2e-3)}) {
    ContactClaim said{Vector3(0, 0, 1), Vector3(0, 0, 0.25) + off, Vector3(0, 0, 0.75), std::nullopt, std::nullopt};
    EXPECT_FALSE(within(crossing, says(said), game));
    *said.point2 += off;
    EXPECT_FALSE(within(crossing, says(said), game));
    said = {Vector3(0, 0, -1), Vector3(0, 0, 0.5) + off, Vector3(0, 0, 0) + off, std::nullopt, std::nullopt};
    EXPECT_FALSE(within(slope, says(said), game));
  }
  // 2 mm beyond the limit, and half a one.
  for (const auto& [gap, allowed] : {std::pair{2e-3, false}, {5e-4, true}})
    EXPECT_EQ(within(spheres({{0, 0, 0}, 1}, {{2 + gap, 0, 0}, 1}), says(true), game), allowed);
}

TEST(Jump, of_a_segment_nearly_along_a_triangle_any_crossing_will_do) {
  // From 2^-10 below the triangle at x = 0 to 2^-10 above it at x = 2: they cross at x = 1.
  const Query flat{Pair::triangle_line, TriangleAndLine{kCorner, {{0, 1, -kEps}, {2, 1, kEps}}}, {0, 0}};
  ContactClaim start;
  start.point1 = start.point2 = Vector3(0, 1, -kEps);
  expect_from(kEps, flat, says(start));
  ContactClaim past = start;
  past.point1 = past.point2 = Vector3(-0.25, 1, -kEps);  // of the line, and not of the segment
  EXPECT_FALSE(within(flat, says(past), {.length = 0.125}));
  ContactClaim torn = start;
  torn.point2 = Vector3(2, 1, kEps);
  EXPECT_FALSE(within(flat, says(torn), {.length = 0.5}));
}
TEST(Jump, a_segment_that_rounding_alone_lifts_off_a_plane_crosses_it_anywhere) {
  // 8 roundings are 2^-48. From x = 0 to 4, through the triangle up to x = 3.
  const auto crossing_at = [](const Vector3& x, double height) {
    ContactClaim said;
    said.point1 = said.point2 = x;
    const Query flat{Pair::triangle_line, TriangleAndLine{kCorner, {{0, 1, -height}, {4, 1, height}}}, {0, 0}};
    return [flat, said](double length) { return within(flat, says(said), {.length = length}); };
  };
  EXPECT_TRUE(crossing_at({4, 1, 0}, 0x1p-48)(0x1p-48));
  EXPECT_FALSE(crossing_at({4, 1, 0}, 0x1p-48)(0x1p-49));
  EXPECT_FALSE(crossing_at({4, 1, 0}, above(0x1p-48))(0.5));
  EXPECT_FALSE(crossing_at({5, 1, 0}, 0x1p-48)(0.5));  // past its end
  EXPECT_FALSE(crossing_at({4, 2, 0}, 0x1p-48)(0.5));  // beside it
}
TEST(Jump, a_sliver_has_a_normal_as_far_as_its_height_tells) {
  // 8 long and 5 * 2^-10 high
  const Triangle sliver{{Vector3(0, 0, 0), Vector3(8, 0, 0), Vector3(4, 5 * kEps, 0)}};
  const Query through{Pair::triangle_line, TriangleAndLine{sliver, {{4, kEps, -1}, {4, kEps, 1}}}, {0, 0}};
  expect_from(3 * kEps, through, normal_of({0, 3, 4}), kAnyLength);
  expect_from(5 * kEps, through, normal_of({0, 0, -1}), kAnyLength);
  EXPECT_FALSE(within(through, normal_of({3, 0, 4}), {.length = 1}, kAnyLength));  // along it
  const Query wide{Pair::triangle_line, TriangleAndLine{kCorner, {{1, 1, -1}, {1, 1, 1}}}, {0, 0}};
  EXPECT_FALSE(within(wide, normal_of({0, 0, -1}), {.length = 1}));
}

TEST(Jump, centres_that_nearly_coincide_may_be_said_to) {
  const Query near = spheres({{0, 0, 0}, 1}, {{kEps, 0, 0}, 1});
  const Conventions zero{.coincident = Coincident::zero_normal};
  ContactClaim none{Vector3(0, 0, 0), Vector3(0, 0, 0), Vector3(kEps, 0, 0), std::nullopt, std::nullopt};
  expect_from(kEps, near, says(none), zero);
  EXPECT_FALSE(within(near, says(none), {.length = 0.5}));  // under another convention
  // The other way: they coincide, and a direction is said.
  ContactClaim some{Vector3(0, 1, 0), Vector3(0, 1, 0), Vector3(0, -1, 0), std::nullopt, std::nullopt};
  EXPECT_TRUE(within(spheres({{0, 0, 0}, 1}, {{0, 0, 0}, 1}), says(some), {}, zero));
  const Conventions no_contact{.coincident = Coincident::no_contact};
  Claim nothing;
  nothing.speaks_of_contact = true;
  expect_from(kEps, near, nothing, no_contact);
  EXPECT_FALSE(within(near, nothing, {.length = 0.5}));
}

TEST(Tolerance, a_cast_changes_where_the_shape_has_grown_or_shrunk_to_the_ray) {
  const auto at_edge = [](const Query& query, bool wrong, double off) {
    EXPECT_TRUE(within(query, says(wrong), {.length = off})) << off;
    EXPECT_FALSE(within(query, says(wrong), {.length = below(off)})) << off;
  };
  const Cast ray{{{0, 0, 0}, {2, 0, 0}, 4}};
  at_edge({Pair::cast_sphere, CastAt<Ball>{ray, {{4, 0, 1.5}, 1}}, {0, 0}}, true, 0.5);
  at_edge({Pair::cast_sphere, CastAt<Ball>{ray, {{4, 0, 0.75}, 1}}, {0, 0}}, false, 0.25);
  at_edge({Pair::cast_capsule, CastAt<Capsule>{ray, {{9, -4, 0}, {9, 4, 0}, 0.5}}, {0, 0}}, true, 0.5);
  at_edge({Pair::cast_cube, CastAt<Box>{ray, {{8.75, -1, -1}, {9, 1, 1}}}, {0, 0}}, true, 0.75);
  at_edge({Pair::cast_cube, CastAt<Box>{ray, {{4, -0.25, -1}, {6, 9, 1}}}, {0, 0}}, false, 0.25);
  at_edge({Pair::cast_cube, CastAt<Box>{ray, {{4, -2, -1}, {4, 2, 1}}}, {0, 0}}, false, 1);
  at_edge({Pair::cast_plane, CastAt<Plane>{ray, {{-2, 0, 0}, -17}}, {0, 0}}, true, 0.5);
  const Triangle triangle{{Vector3(2, 0.25, -4), Vector3(2, 0.25, 4), Vector3(2, 9, 0)}};
  at_edge({Pair::cast_triangle, CastAt<Triangle>{ray, triangle}, {0, 0}}, true, 0.25);
}

TEST(Tolerance, a_cast_near_an_edge_of_a_box_may_enter_by_either_face) {
  // It enters by x = 4, 0.25 above y = -2, which it passes upward.
  const Query query{Pair::cast_cube, CastAt<Box>{{{{0, -5.75, 0}, {1, 1, 0}, 9}}, {{4, -2, -1}, {6, 2, 1}}}, {0, 0}};
  EXPECT_TRUE(within(query, normal_of({-1, 0, 0}), {}));
  EXPECT_TRUE(within(query, normal_of({0, -1, 0}), {.length = 0.25}));
  EXPECT_FALSE(within(query, normal_of({0, -1, 0}), {.length = below(0.25)}));
  EXPECT_FALSE(within(query, normal_of({0, -0.9375, 0}), {.length = 0.25}));  // its length is an angle's matter
  for (const Vector3& n : {Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, -1), Vector3(0, -0.8, 0.6)})
    EXPECT_FALSE(within(query, normal_of(n), {.length = 1}));
}

TEST(Tolerance, its_scale_leaves_questions_out) {
  Declaration declared;
  declared.tolerance = Tolerance{.scale_min = 1, .scale_max = 4};
  EXPECT_FALSE(not_served(apart(), declared));
  declared.tolerance->scale_max = below(4);
  EXPECT_TRUE(not_served(apart(), declared));
  declared.tolerance = Tolerance{.scale_min = above(1), .scale_max = 4};
  EXPECT_TRUE(not_served(apart(), declared));
}

// ---- the inputs' last bit ----

constexpr Declaration kDouble{};

TEST(LastBit, of_a_value_is_the_sum_of_what_each_number_does) {
  // value x2 - x1 - r1 - r2 - contact: each of these numbers may move by its own ulp, and zeros do not move
  const Query query = spheres({{8, 0, 0}, 1}, {{16, 0, 0}, 2}, 8, 0.5);
  // Down is half of up at a power of two: the larger counts.
  const double sum = 0x1p-49 + 0x1p-48 + 0x1p-52 + 0x1p-51 + 0x1p-53;
  const double effect = last_bit(query, kDouble).at(Field::value);
  EXPECT_LE(effect, sum);
  EXPECT_GE(effect, sum - 5 * 0x1p-50);  // each less an ulp of the value, 4.5
}

TEST(LastBit, of_a_normal_grows_as_the_centres_approach) {
  const auto effect = [](double apart) {
    return last_bit(spheres({{1, 1, 1}, 1}, {{1 + apart, 1, 1}, 1}), kDouble).at(Field::normal);
  };
  // Four coordinates across may move by an ulp of 1, each turning by 2^-52 / apart.
  EXPECT_NEAR(effect(0x1p-20), 4 * 0x1p-32, 0x1p-32);
  EXPECT_NEAR(effect(0x1p-40), 4 * 0x1p-12, 0x1p-12);
  EXPECT_GE(effect(0x1p-52), std::numbers::pi);  // the centres of a neighbour coincide
}

TEST(LastBit, is_in_the_engines_scalar) {
  const Query query = spheres({{8, 0, 0}, 1}, {{16, 0, 0}, 2}, 8, 0.5);
  EXPECT_GT(last_bit(query, {Scalar::binary32, {}, {}}).at(Field::value), 0x1p-20);
  EXPECT_LT(last_bit(query, kDouble).at(Field::value), 0x1p-46);
}

Verdict marked(const Query& query, const Claim& claim, Declaration declared, LastBits& known) {
  const Truth truth = truth_of(query);
  declared.claims = claim.says();
  Verdict verdict = judge(query, truth, claim, declared);
  mark_last_bit(query, truth, declared, verdict, known);
  return verdict;
}
Verdict marked(const Query& query, const Claim& claim, Declaration declared = {}) {
  LastBits known;
  return marked(query, claim, std::move(declared), known);
}

TEST(LastBit, is_the_same_for_an_engine_that_is_judged_after_others) {
  const Query near = spheres({{1, 1, 1}, 1}, {{1 + 0x1p-40, 1, 1}, 1});
  LastBits known;
  // Each looks at more numbers of the question than the one before, and at those of its own scalar.
  for (const double aside : {0x1p-20, 0x1p-14, 0x1p-13, 0x1p-12, 0x1p-6, 0x1p-14})
    for (const Scalar scalar : kScalars) {
      const Declaration declared{scalar, {}, {}};
      const Claim claim = normal_of({1, aside, 0});
      const Verdict fresh = marked(near, claim, declared);
      const Verdict after = marked(near, claim, declared, known);
      EXPECT_EQ(after.at(Field::normal)->last_bit, fresh.at(Field::normal)->last_bit) << aside;
      EXPECT_EQ(after.beyond_last_bit(Measure::length).most, fresh.beyond_last_bit(Measure::length).most) << aside;
    }
  EXPECT_EQ(known.size(), kScalars.size());
  // What the first engine found is not added again. It is judged by two coordinates of the first centre; the next number, a radius, changes nothing.
  for (double aside = 0x1p-13; aside < 0x1p-8; aside *= 1.02) {
    LastBits begun;
    EXPECT_TRUE(marked(near, normal_of({1, 0x1.8p-12, 0}), {}, begun).at(Field::normal)->last_bit);
    const Verdict after = marked(near, normal_of({1, aside, 0}), {}, begun);
    EXPECT_EQ(after.at(Field::normal)->last_bit, marked(near, normal_of({1, aside, 0})).at(Field::normal)->last_bit)
        << aside;
  }
}

TEST(LastBit, tells_a_hard_question_from_a_wrong_answer) {
  const Query near = spheres({{1, 1, 1}, 1}, {{1 + 0x1p-40, 1, 1}, 1});
  const Verdict hard = marked(near, normal_of({1, 0x1p-14, 0}));
  EXPECT_EQ(hard.at(Field::normal)->grade, Grade::beyond_bound);
  EXPECT_TRUE(hard.at(Field::normal)->last_bit);
  EXPECT_EQ(hard.beyond_last_bit(Measure::angle).most, 0);
  EXPECT_EQ(hard.beyond_last_bit(Measure::length).most, 0);
  const Verdict wrong = marked(near, normal_of({1, 0x1p-6, 0}));
  EXPECT_FALSE(wrong.at(Field::normal)->last_bit);
  EXPECT_GT(wrong.beyond_last_bit(Measure::length).most, 0x1p-47);  // a centre moves aside by 2^-6 of 2^-40
  const Verdict easy = marked(apart(), normal_of({0.6, 0.8, 0x1p-14}));
  EXPECT_FALSE(easy.at(Field::normal)->last_bit);
}

TEST(LastBit, is_never_thought_of_where_the_centres_coincide) {
  const Verdict verdict = marked(spheres({{1, 1, 1}, 1}, {{1, 1, 1}, 1}), normal_of({0, 0, 0}));
  EXPECT_EQ(verdict.at(Field::normal)->grade, Grade::beyond_bound);
  EXPECT_FALSE(verdict.at(Field::normal)->last_bit);
}

TEST(LastBit, decides_at_the_limit_alone) {
  // A wrong decision: a ulp of a centre makes touching spheres miss, three ulps are too many for one number and none
  // too many for all four that may move.
  const auto excused = [](double x, bool says_hit) {
    return marked(spheres({{0, 0, 0}, 1}, {{x, 0, 0}, 1}), says(says_hit)).decision_last_bit;
  };
  EXPECT_TRUE(excused(2, false));
  EXPECT_TRUE(excused(above(2), true));
  EXPECT_FALSE(excused(2 - 0x1p-40, false));
  EXPECT_FALSE(excused(2 + 0x1p-40, true));
  // Three ulps of 1 below: the radii down and the centre up, by an ulp below 1 each and one below 2, are as much.
  EXPECT_TRUE(excused(2 - 0x1p-52, false));
  EXPECT_FALSE(excused(2 - 0x1p-49, false));
}

TEST(LastBit, decides_crossings_one_number_at_a_time) {
  const Triangle triangle{{Vector3(0, 0, 0), Vector3(4, 0, 0), Vector3(0, 4, 0)}};
  const auto excused = [&](double x, bool says_hit) {
    return marked({Pair::triangle_line, TriangleAndLine{triangle, {{x, 2, -1}, {x, 2, 1}}}, {0, 0}}, says(says_hit))
        .decision_last_bit;
  };
  EXPECT_TRUE(excused(2, false));  // on the edge x + y = 4
  EXPECT_FALSE(excused(2 - 0x1p-40, false));
  EXPECT_FALSE(excused(2 + 0x1p-40, true));
}

// ---- orientations that are rounded ----

TEST(OrientationRounding, moves_a_corner_no_farther_than_the_bound_and_the_bound_is_not_twelve_times_too_loose) {
  using Float3x3 = Eigen::Matrix3f;
  std::uint64_t state = 1;
  const auto random = [&] {
    state = state * 6364136223846793005U + 1442695040888963407U;
    return static_cast<float>(static_cast<std::int32_t>(state >> 32)) * 0x1p-31F;
  };
  double most = 0;
  for (int k = 0; k < 200000; ++k) {
    const float x = random();
    const float y = random();
    const float z = random();
    const float w = random();
    const float square = x * x + y * y + z * z + w * w;
    const float length = std::sqrt(square);
    Float3x3 matrix;
    matrix << w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y),  //
        2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x),        //
        2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z;
    matrix /= square;
    const Float3x3 of_unit = Eigen::Quaternionf(w / length, x / length, y / length, z / length).toRotationMatrix();
    const Eigen::Matrix3d exact = Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
    const Obb box{{0, 0, 0}, {x, y, z, w}, {1 + random(), 1 + random(), 1 + random()}};
    for (const Float3x3& rounded : {matrix, of_unit})
      most = std::max(
          most, ((rounded.cast<double>() - exact) * box.extents).norm() / orientation_rounding(box, Scalar::binary32));
  }
  EXPECT_LE(most, 1);
  EXPECT_GE(most, 1.0 / 12);
}

TEST(OrientationRounding, tells_a_wrong_decision_within_it_apart_where_it_is_declared) {
  // Corners are sqrt(3) from the centres: 40 * 2^-53 * 2 sqrt(3) is 1.54e-14. The inputs' last bits are 1.3e-15.
  const auto boxes = [](double gap) {
    const Obb a{{0, 0, 0}, {0, 0, 0, 1}, {1, 1, 1}};
    return Query{Pair::obb_obb, Convexes{{a}, {Obb{{2 + gap, 0, 0}, a.orientation, a.extents}}}, {0, 0}};
  };
  Declaration rounds;
  rounds.rounds_orientation = true;
  const auto both = [](const Verdict& v) { return std::pair(v.decision_last_bit, v.decision_rounded); };
  const std::pair neither(false, false);
  EXPECT_EQ(both(marked(boxes(1.5e-14), says(true), rounds)), std::pair(false, true));
  EXPECT_EQ(both(marked(boxes(1.6e-14), says(true), rounds)), neither);
  EXPECT_EQ(both(marked(boxes(-1.5e-14), says(false), rounds)), std::pair(false, true));
  EXPECT_EQ(both(marked(boxes(-1.6e-14), says(false), rounds)), neither);
  EXPECT_EQ(both(marked(boxes(1.5e-14), says(true))), neither) << "not declared";
  EXPECT_EQ(both(marked(boxes(1.5e-14), says(false), rounds)), neither) << "right";
  EXPECT_EQ(both(marked(boxes(0), says(false), rounds)), std::pair(true, false));
  rounds.scalar = Scalar::binary32;
  EXPECT_EQ(both(marked(boxes(0x1p-18), says(true), rounds)), std::pair(false, true));
  // It changes no level, and one box has half of it. A sphere has none.
  EXPECT_EQ(marked(boxes(0x1p-18), says(true), rounds).level(), Level::conservative);
  rounds.scalar = Scalar::binary64;
  const auto sphere = [](double gap) {
    return Query{
        Pair::sphere_obb, Convexes{{Ball{{2 + gap, 0, 0}, 1}}, {Obb{{0, 0, 0}, {0, 0, 0, 1}, {1, 1, 1}}}}, {0, 0}};
  };
  EXPECT_EQ(both(marked(sphere(7.5e-15), says(true), rounds)), std::pair(false, true));
  EXPECT_EQ(both(marked(sphere(8.5e-15), says(true), rounds)), neither);
  EXPECT_EQ(both(marked(spheres({{0, 0, 0}, 1}, {{2 + 7.5e-15, 0, 0}, 1}), says(true), rounds)), neither);
}

}  // namespace
}  // namespace contact::oracle::tolerance_test
