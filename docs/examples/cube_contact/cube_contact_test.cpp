// Box contacts of the plug-in, worked by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "ask.hpp"
#include "contact/detect.hpp"

namespace contact {
namespace {

constexpr double kLargest = std::numeric_limits<double>::max();
constexpr double kLeast = std::numeric_limits<double>::denorm_min();

Query boxes(const Box& a, const Box& b, Distances distances) { return {Pair::cube_cube, Boxes{a, b}, distances}; }

void expect_contact(const Query& query, const Vector3& normal, const Vector3& point1, const Vector3& point2,
                    double value) {
  const example::Answer answer = example::ask(query);
  EXPECT_TRUE(answer.test);
  ASSERT_TRUE(answer.contact.has_value());
  const Contact& c = *answer.contact;
  EXPECT_EQ(example::bits_of(c), example::bits_of(Contact{normal, point1, point2, value, false}))
      << "normal " << c.normal.transpose() << "\npoint1 " << c.point1.transpose() << "\npoint2 " << c.point2.transpose()
      << "\nvalue " << c.value;
}

const Box kUnit{{0, 0, 0}, {1, 1, 1}};

TEST(CubeContact, apart_on_one_axis_has_its_direction_and_the_middle_of_the_common_part) {
  // gap 2 - 1 on x; y: [0,1] and [0.5,3], middle 0.75; z: [0,1] and [-1,0.25], middle 0.125
  expect_contact(boxes(kUnit, {{2, 0.5, -1}, {3, 3, 0.25}}, {1, 0.25}), {1, 0, 0}, {1, 0.75, 0.125}, {2, 0.75, 0.125},
                 0.75);
  // on the other side: faces 0 and -2
  expect_contact(boxes(kUnit, {{-3, 0.5, -1}, {-2, 3, 0.25}}, {2, 0}), {-1, 0, 0}, {0, 0.75, 0.125}, {-2, 0.75, 0.125},
                 2);
}

TEST(CubeContact, apart_on_two_or_three_axes_has_the_gap_vector) {
  // gaps 3 on x and 4 on y, negative side: |g| = 5, n = (0.6,-0.8,0); z: middle of [0.5,1]
  expect_contact(boxes(kUnit, {{4, -6, 0.5}, {5, -4, 2}}, {4, 1}), {0.6, -0.8, 0}, {1, 0, 0.75}, {4, -4, 0.75}, 4);
  // gaps 1, 2, 2: |g| = 3
  expect_contact(boxes(kUnit, {{2, 3, 3}, {9, 9, 9}}, {2, 0}), {1.0 / 3, 2.0 / 3, 2.0 / 3}, {1, 1, 1}, {2, 3, 3}, 3);
}

TEST(CubeContact, is_decided_axis_by_axis_and_not_by_the_length_of_the_gap_vector) {
  // gaps 3 and 4: within 4 on every axis, though |g| = 5; one ulp less is a miss
  const Box far{{4, 5, 0}, {5, 6, 1}};
  EXPECT_TRUE(example::ask(boxes(kUnit, far, {4, 0})).contact.has_value());
  const example::Answer miss = example::ask(boxes(kUnit, far, {std::nextafter(4, 0), 0}));
  EXPECT_FALSE(miss.test);
  EXPECT_FALSE(miss.contact.has_value());
}

TEST(CubeContact, penetrating_goes_out_by_the_shortest_way) {
  // gaps: x max(-1, 0.75 - 1) = -0.25; y max(0.5 - 1, 0 - 2) = -0.5; z: [0,1] in [-1,3]: max(-1-1, 0-3) = -2
  expect_contact(boxes(kUnit, {{0.75, 0.5, -1}, {2, 2, 3}}, {0, 0.5}), {1, 0, 0}, {1, 0.75, 0.5}, {0.75, 0.75, 0.5},
                 -0.75);
  // B below A on z: gap min1 - max2 = 0 - 0.125
  expect_contact(boxes(kUnit, {{0, 0, -4}, {1, 1, 0.125}}, {0, 0}), {0, 0, -1}, {0.5, 0.5, 0}, {0.5, 0.5, 0.125},
                 -0.125);
}

TEST(CubeContact, touching_has_the_value_0_less_the_contact_distance) {
  expect_contact(boxes(kUnit, {{0.5, 1, 0}, {2, 2, 1}}, {0, 0}), {0, 1, 0}, {0.75, 1, 0.5}, {0.75, 1, 0.5}, 0);
  expect_contact(boxes(kUnit, {{0.5, 1, 0}, {2, 2, 1}}, {0, 0.25}), {0, 1, 0}, {0.75, 1, 0.5}, {0.75, 1, 0.5}, -0.25);
  // edge to edge: gap 0 on x and y, and x is lower
  expect_contact(boxes(kUnit, {{1, 1, 0}, {2, 2, 1}}, {0, 0}), {1, 0, 0}, {1, 1, 0.5}, {1, 1, 0.5}, 0);
  // corner to corner, B below A
  expect_contact(boxes(kUnit, {{-1, -1, -1}, {0, 0, 0}}, {0, 0}), {-1, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0);
}

TEST(CubeContact, coincident_boxes_go_out_along_the_thinnest_axis_upwards) {
  // gaps -3, -1, -1: y is the lower of the thinnest two; both sides are equally far, so upwards
  const Box box{{0, 0, 0}, {3, 1, 1}};
  expect_contact(boxes(box, box, {0, 0}), {0, 1, 0}, {1.5, 1, 0.5}, {1.5, 0, 0.5}, -1);
  // a point in the centre of a box, either way round: gaps -0.5
  const Box point{{0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}};
  expect_contact(boxes(kUnit, point, {0, 0}), {1, 0, 0}, {1, 0.5, 0.5}, {0.5, 0.5, 0.5}, -0.5);
  expect_contact(boxes(point, kUnit, {0, 0}), {1, 0, 0}, {0.5, 0.5, 0.5}, {0, 0.5, 0.5}, -0.5);
  // one and the same point
  expect_contact(boxes(point, point, {0, 0}), {1, 0, 0}, {0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}, 0);
}

TEST(CubeContact, rounds_once) {
  // y: common part [1, 1 + 2^-52]: the middle 1 + 2^-53 is a tie and goes to the even 1
  const double next = std::nextafter(1, 2);
  expect_contact(boxes({{0, 0, 0}, {1, next, 1}}, {{2, 1, 0}, {3, 3, 1}}, {1, 0}), {1, 0, 0}, {1, 1, 0.5}, {2, 1, 0.5},
                 1);
  // gap 1 + 2^-60, contact 1: the value is 2^-60, which no rounded gap could tell
  expect_contact(boxes({{0, 0, 0}, {-0.0, 1, 1}}, {{1, 0, 0}, {1, 1, 1}}, {1, 1}), {1, 0, 0}, {0, 0.5, 0.5},
                 {1, 0.5, 0.5}, 0);
  expect_contact(boxes({{-1, 0, 0}, {-0x1p-60, 1, 1}}, {{1, 0, 0}, {1, 1, 1}}, {2, 1}), {1, 0, 0}, {-0x1p-60, 0.5, 0.5},
                 {1, 0.5, 0.5}, 0x1p-60);
}

TEST(CubeContact, is_right_at_both_ends_of_the_range) {
  // gaps M and M: |g| = sqrt(2) M, beyond the largest finite number
  const Box low{{-1, -1, 0}, {0, 0, 0}};
  const Box corner{{kLargest, kLargest, 0}, {kLargest, kLargest, 0}};
  const double half_root = 0.707106781186547524400844362104849039;  // 1 / sqrt(2)
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  expect_contact(boxes(low, corner, {kLargest, 0}), {half_root, half_root, 0}, {0, 0, 0}, {kLargest, kLargest, 0},
                 kInfinity);
  // less M: (sqrt(2) - 1) M, about 0.828 2^1023 (the properties hold its bits against the oracle)
  const example::Answer less = example::ask(boxes(low, corner, {kLargest, kLargest}));
  EXPECT_NEAR(less.contact->value / 0x1p1023, 0.828427124746190, 1e-14);
  // overlap of 2 M on every axis: value -2 M is -infinite, the middle of [-M,M] is 0
  const Box all{-Vector3::Constant(kLargest), Vector3::Constant(kLargest)};
  expect_contact(boxes(all, all, {0, 0}), {1, 0, 0}, {kLargest, 0, 0}, {-kLargest, 0, 0}, -kInfinity);
  // in units of 2^-1074: gaps 3 and 4; the middle of [0,1] is 0.5, a tie that goes to 0, that of [0,3] is 1.5, to 2
  expect_contact(boxes({{0, 0, 0}, {0, 0, kLeast}}, {{3 * kLeast, 4 * kLeast, 0}, {5 * kLeast, 5 * kLeast, kLeast}},
                       {4 * kLeast, kLeast}),
                 {0.6, 0.8, 0}, {0, 0, 0}, {3 * kLeast, 4 * kLeast, 0}, 4 * kLeast);
  expect_contact(boxes({{0, 0, 0}, {0, 0, 3 * kLeast}}, {{kLeast, 0, 0}, {kLeast, 0, 3 * kLeast}}, {kLeast, 0}),
                 {1, 0, 0}, {0, 0, 2 * kLeast}, {kLeast, 0, 2 * kLeast}, kLeast);
}

TEST(CubeContact, every_zero_is_plus_zero) {
  const Vector3 zero(-0.0, -0.0, -0.0);
  expect_contact(boxes({zero, zero}, {zero, zero}, {-0.0, -0.0}), {1, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0);
  expect_contact(boxes({{-1, -0.0, -0.0}, {-0.0, -0.0, -0.0}}, {{1, -0.0, -0.0}, {2, -0.0, -0.0}}, {1, 1}), {1, 0, 0},
                 {0, 0, 0}, {1, 0, 0}, 0);
}

TEST(CubeContact, of_an_element_with_itself_is_none_and_its_cone_answers) {
  load_plugin(CUBE_CONTACT);
  CubeCollisionModel model("boxes", Eigen::MatrixX3d::Zero(2, 3), Eigen::MatrixX3d::Ones(2, 3));
  const DiscreteIntersection intersection;
  bool swap = false;
  const ElementIntersector* intersector = intersection.findIntersector(model, model, swap);
  EXPECT_EQ(intersector->name(), "CubeContactIntersector<CubeCollisionModel,CubeCollisionModel>");
  const CollisionElement cube(model, 0);
  OutputVector contacts;
  EXPECT_TRUE(intersector->canIntersect(cube, cube, intersection));
  EXPECT_EQ(intersector->intersect(cube, cube, contacts, intersection), 0);
  model.setParentOf(0, Vector3::Zero(), Vector3::Ones(), Vector3::UnitX(), std::numbers::pi / 4);
  EXPECT_FALSE(intersector->canIntersect(cube, cube, intersection));
  EXPECT_EQ(intersector->intersect(cube, cube, contacts, intersection), 0);
  EXPECT_TRUE(contacts.empty());
  // the other element is another, though its box is the same
  EXPECT_EQ(intersector->intersect(cube, CollisionElement(model, 1), contacts, intersection), 1);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts[0].id, 1);
  EXPECT_EQ(detect(intersection, model)->size(), 1U);
}

}  // namespace
}  // namespace contact
