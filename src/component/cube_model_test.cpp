// The cube model: data in and out, cones of normals, and every refusal word for word.
#include "contact/cube_model.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "component/models_for_tests.hpp"
#include "extreme_numbers.hpp"

namespace contact {
namespace {

using component::cubes;
using component::refusal;

const std::vector<Box> kTwo{{{0, 0, 0}, {1, 2, 3}}, {{-1, -2, -3}, {4, 5, 6}}};

TEST(CubeModel, gives_back_what_it_was_given) {
  const auto model = cubes("c", kTwo);
  EXPECT_EQ(model.getSize(), 2);
  const Cube cube(model, 1);
  EXPECT_EQ(cube.minVect(), Vector3(-1, -2, -3));
  EXPECT_EQ(cube.maxVect(), Vector3(4, 5, 6));
  EXPECT_EQ(cube.box().min, Vector3(-1, -2, -3));
  EXPECT_EQ(model.box(0).max, Vector3(1, 2, 3));
}

TEST(CubeModel, its_bounding_boxes_are_its_boxes) {
  const auto model = cubes("c", {{{-kLargest, 0, -0.0}, {kLargest, 0, kLeast}}});
  EXPECT_EQ(model.bounding_box(0).min, Vector3(-kLargest, 0, 0));
  EXPECT_EQ(model.bounding_box(0).max, Vector3(kLargest, 0, kLeast));
}

TEST(CubeModel, takes_flat_boxes_points_and_the_largest_and_smallest_numbers) {
  EXPECT_EQ(refusal([] {
              (void)cubes("c", {{{1, 1, 1}, {1, 1, 1}}, {{0, 0, 0}, {1, 0, 1}}, {{-0.0, 0, 0}, {0, -0.0, kLeast}}});
              (void)cubes("c", {{{-kLargest, -kLargest, -kLargest}, {kLargest, kLargest, kLargest}}});
              (void)cubes("c", {});
            }),
            "");
}

TEST(CubeModel, refuses_corners_that_are_not_finite) {
  EXPECT_EQ(refusal([] {
              (void)cubes("boxes", {kTwo[0], {{0, kNaN, 0}, {1, 1, 1}}});
            }),
            "CubeCollisionModel \"boxes\": min[1][1] = nan: must be finite");
  EXPECT_EQ(refusal([] {
              (void)cubes("boxes", {{{0, 0, 0}, {1, 1, kInfinity}}});
            }),
            "CubeCollisionModel \"boxes\": max[0][2] = inf: must be finite");
  EXPECT_EQ(refusal([] {
              (void)cubes("boxes", {{{-kInfinity, 0, 0}, {1, 1, 1}}});
            }),
            "CubeCollisionModel \"boxes\": min[0][0] = -inf: must be finite");
}

TEST(CubeModel, refuses_a_box_that_is_inside_out) {
  EXPECT_EQ(refusal([] {
              (void)cubes("boxes", {kTwo[0], {{0, 0, kLeast}, {1, 1, 0}}});
            }),
            "CubeCollisionModel \"boxes\": min[1][2] = 5e-324: must not exceed max");
}

TEST(CubeModel, refuses_columns_of_different_lengths) {
  EXPECT_EQ(
      refusal([] { (void)CubeCollisionModel("boxes", Eigen::MatrixX3d::Zero(2, 3), Eigen::MatrixX3d::Zero(3, 3)); }),
      "CubeCollisionModel \"boxes\": number of max = 3: must be that of min, 2");
}

TEST(CubeModel, knows_nothing_of_its_normals_at_first) {
  const auto model = cubes("c", kTwo);
  EXPECT_EQ(Cube(model, 1).getConeAngle(), 2 * std::numbers::pi);
  EXPECT_EQ(Cube(model, 1).getConeAxis(), Vector3(0, 0, 0));
}

TEST(CubeModel, takes_new_bounds_with_a_cone_for_one_box_alone) {
  auto model = cubes("c", kTwo);
  model.setParentOf(1, {7, 8, 9}, {10, 11, 12}, {0, 0, 1}, 0.25);
  EXPECT_EQ(Cube(model, 1).minVect(), Vector3(7, 8, 9));
  EXPECT_EQ(Cube(model, 1).maxVect(), Vector3(10, 11, 12));
  EXPECT_EQ(Cube(model, 1).getConeAxis(), Vector3(0, 0, 1));
  EXPECT_EQ(Cube(model, 1).getConeAngle(), 0.25);
  EXPECT_EQ(Cube(model, 0).maxVect(), Vector3(1, 2, 3));
  EXPECT_EQ(Cube(model, 0).getConeAngle(), 2 * std::numbers::pi);
}

TEST(CubeModel, a_normal_without_an_angle_is_a_cone_of_angle_0) {
  auto model = cubes("c", kTwo);
  model.setParentOf(0, {0, 0, 0}, {1, 1, 1}, {0, 1, 0});
  EXPECT_EQ(Cube(model, 0).getConeAngle(), 0);
  EXPECT_EQ(Cube(model, 0).getConeAxis(), Vector3(0, 1, 0));
}

TEST(CubeModel, new_bounds_without_a_normal_are_a_whole_turn) {
  auto model = cubes("c", kTwo);
  model.setParentOf(0, {0, 0, 0}, {1, 1, 1}, {0, 1, 0}, 0.25);
  model.setParentOf(0, {2, 2, 2}, {3, 3, 3});
  EXPECT_EQ(Cube(model, 0).minVect(), Vector3(2, 2, 2));
  EXPECT_EQ(Cube(model, 0).maxVect(), Vector3(3, 3, 3));
  EXPECT_EQ(Cube(model, 0).getConeAngle(), 2 * std::numbers::pi);
  EXPECT_EQ(Cube(model, 0).getConeAxis(), Vector3(0, 0, 0));
}

TEST(CubeModel, is_left_as_it_was_by_bounds_that_it_refuses) {
  auto model = cubes("c", kTwo);
  model.setParentOf(1, {-1, -2, -3}, {4, 5, 6}, {0, 0, 1}, 0.25);
  const Vector3 o(0, 0, 0);
  const Vector3 one(1, 1, 1);
  EXPECT_EQ(refusal([&] { model.setParentOf(2, o, one); }), "CubeCollisionModel \"c\": box[2]: there are 2");
  EXPECT_EQ(refusal([&] { model.setParentOf(-1, o, one, one, 0); }), "CubeCollisionModel \"c\": box[-1]: there are 2");
  EXPECT_EQ(refusal([&] {
              model.setParentOf(1, {0, kNaN, 0}, one);
            }),
            "CubeCollisionModel \"c\": box[1].min[1] = nan: must be finite");
  EXPECT_EQ(refusal([&] {
              model.setParentOf(1, o, {1, 1, kInfinity});
            }),
            "CubeCollisionModel \"c\": box[1].max[2] = inf: must be finite");
  EXPECT_EQ(refusal([&] {
              model.setParentOf(1, {0, 1.5, 0}, one);
            }),
            "CubeCollisionModel \"c\": box[1].min[1] = 1.5: must not exceed max");
  EXPECT_EQ(refusal([&] {
              model.setParentOf(1, o, one, {0, 0, kNaN}, 0.5);
            }),
            "CubeCollisionModel \"c\": box[1].normal[2] = nan: must be finite");
  EXPECT_EQ(refusal([&] {
              model.setParentOf(1, o, one, {0, 0, 1}, -0.5);
            }),
            "CubeCollisionModel \"c\": box[1].angle = -0.5: must not be negative");
  EXPECT_EQ(refusal([&] {
              model.setParentOf(1, o, one, {0, 0, 1}, kInfinity);
            }),
            "CubeCollisionModel \"c\": box[1].angle = inf: must be finite");
  EXPECT_EQ(refusal([&] {
              model.setParentOf(1, o, one, {0, 0, 1}, kNaN);
            }),
            "CubeCollisionModel \"c\": box[1].angle = nan: must be finite");
  const Cube cube(model, 1);
  EXPECT_EQ(cube.minVect(), Vector3(-1, -2, -3));
  EXPECT_EQ(cube.maxVect(), Vector3(4, 5, 6));
  EXPECT_EQ(cube.getConeAxis(), Vector3(0, 0, 1));
  EXPECT_EQ(cube.getConeAngle(), 0.25);
}

}  // namespace
}  // namespace contact
