// The sphere models: data in and out, every refusal word for word, contact points, and boxes that contain the sphere.
#include "contact/sphere_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "component/models_for_tests.hpp"
#include "environment/floating_point_environments.hpp"
#include "extreme_numbers.hpp"
#include "oracle/truth/exact.hpp"

namespace contact {
namespace {

using component::centers_of;
using component::radii_of;
using component::refusal;
using component::rigid_spheres;
using component::spheres;
using component::text;
using component::upright;
using oracle::Rational;

const std::vector<Ball> kTwoBalls{{{1, 2, 3}, 4}, {{5, 6, 7}, 8}};

TEST(SphereModel, gives_back_what_it_was_given) {
  const auto model = spheres("s", kTwoBalls);
  EXPECT_EQ(model.getSize(), 2);
  EXPECT_EQ(model.getR(), Eigen::VectorXd(Eigen::Vector2d(4, 8)));
  EXPECT_EQ(model.getRadius(1), 8);
  const Sphere sphere(model, 1);
  EXPECT_EQ(sphere.center(), Vector3(5, 6, 7));
  EXPECT_EQ(sphere.r(), 8);
  EXPECT_EQ(sphere.ball().center, Vector3(5, 6, 7));
  EXPECT_EQ(sphere.ball().radius, 8);
}

TEST(SphereModel, stores_columns_one_after_the_other_and_takes_them_without_a_copy) {
  Rows<3> centers = centers_of(kTwoBalls);
  Rows<1> radii = radii_of(kTwoBalls);
  const double* const center_data = centers.data();
  const double* const radius_data = radii.data();
  const SphereCollisionModel model("s", std::move(centers), std::move(radii));
  EXPECT_EQ(model.balls().centers.data(), center_data);
  EXPECT_EQ(model.balls().radii.data(), radius_data);
  const std::vector<double> columns(center_data, center_data + 6);
  EXPECT_EQ(columns, (std::vector<double>{1, 5, 2, 6, 3, 7}));
}

TEST(SphereModel, takes_the_whole_domain) {
  EXPECT_EQ(refusal([] {
              (void)spheres("s", {{{kLargest, -kLargest, kLeast}, kLargest}, {{-0.0, 0, 0}, 0}, {{1, 1, 1}, kLeast}});
              (void)spheres("s", {{{0, 0, 0}, -0.0}});
              (void)spheres("s", {});
            }),
            "");
}

TEST(SphereModel, refuses_a_centre_that_is_not_finite) {
  EXPECT_EQ(refusal([] {
              (void)spheres("marbles", {{{0, 0, 0}, 1}, {{0, kInfinity, 0}, 1}});
            }),
            "SphereCollisionModel \"marbles\": centers[1][1] = inf: must be finite");
  EXPECT_EQ(refusal([] {
              (void)spheres("marbles", {{{0, 0, -kInfinity}, 1}});
            }),
            "SphereCollisionModel \"marbles\": centers[0][2] = -inf: must be finite");
  EXPECT_EQ(refusal([] {
              (void)spheres("marbles", {{{kNaN, 0, 0}, 1}});
            }),
            "SphereCollisionModel \"marbles\": centers[0][0] = nan: must be finite");
}

TEST(SphereModel, refuses_a_radius_that_is_negative_or_not_finite) {
  EXPECT_EQ(refusal([] {
              (void)spheres("marbles", {{{0, 0, 0}, 1}, {{0, 0, 0}, -0.5}});
            }),
            "SphereCollisionModel \"marbles\": radii[1] = -0.5: must not be negative");
  EXPECT_EQ(refusal([] {
              (void)spheres("marbles", {{{0, 0, 0}, -kLeast}});
            }),
            "SphereCollisionModel \"marbles\": radii[0] = -5e-324: must not be negative");
  EXPECT_EQ(refusal([] {
              (void)spheres("marbles", {{{0, 0, 0}, kNaN}});
            }),
            "SphereCollisionModel \"marbles\": radii[0] = nan: must be finite");
  EXPECT_EQ(refusal([] {
              (void)spheres("marbles", {{{0, 0, 0}, kInfinity}});
            }),
            "SphereCollisionModel \"marbles\": radii[0] = inf: must be finite");
}

TEST(SphereModel, refuses_columns_of_different_lengths) {
  EXPECT_EQ(refusal([] { (void)SphereCollisionModel("m", centers_of(kTwoBalls), Eigen::VectorXd::Ones(3)); }),
            "SphereCollisionModel \"m\": number of radii = 3: must be that of centers, 2");
}

TEST(SphereModel, names_the_first_wrong_number_row_by_row) {
  EXPECT_EQ(refusal([] {
              (void)spheres("m", {{{0, 0, kNaN}, 1}, {{kInfinity, 0, 0}, -1}});
            }),
            "SphereCollisionModel \"m\": centers[0][2] = nan: must be finite");
}

TEST(SphereModel, moves_its_centres) {
  auto model = spheres("s", kTwoBalls);
  model.setCenters(centers_of({{{-1, -2, -3}, 0}, {{-5, -6, -7}, 0}}));
  EXPECT_EQ(Sphere(model, 1).center(), Vector3(-5, -6, -7));
  EXPECT_EQ(Sphere(model, 1).r(), 8);
}

TEST(SphereModel, is_left_as_it_was_by_centres_that_it_refuses) {
  auto model = spheres("s", kTwoBalls);
  EXPECT_EQ(refusal([&] {
              model.setCenters(centers_of({{{9, 9, 9}, 0}, {{0, kNaN, 0}, 0}}));
            }),
            "SphereCollisionModel \"s\": centers[1][1] = nan: must be finite");
  EXPECT_EQ(refusal([&] { model.setCenters(Eigen::MatrixX3d::Zero(3, 3)); }),
            "SphereCollisionModel \"s\": number of centers = 3: must be that of radii, 2");
  EXPECT_EQ(refusal([&] { model.setCenters(Eigen::MatrixX3d::Zero(1, 3)); }),
            "SphereCollisionModel \"s\": number of centers = 1: must be that of radii, 2");
  EXPECT_EQ(model.balls().centers, centers_of(kTwoBalls));
  EXPECT_EQ(model.balls().radii, radii_of(kTwoBalls));
}

TEST(RigidSphereModel, gives_back_what_it_was_given_the_quaternion_in_the_order_x_y_z_w) {
  Eigen::MatrixX4d orientations(2, 4);
  orientations << 0, 0, 0, 1, 0.5, -0.5, 0.5, -0.5;
  const RigidSphereModel model("r", centers_of(kTwoBalls), orientations, radii_of(kTwoBalls));
  EXPECT_EQ(model.getSize(), 2);
  EXPECT_EQ(model.getRadius(0), 4);
  EXPECT_EQ(model.getR(), Eigen::VectorXd(Eigen::Vector2d(4, 8)));
  const RigidSphere sphere(model, 1);
  EXPECT_EQ(sphere.center(), Vector3(5, 6, 7));
  EXPECT_EQ(sphere.r(), 8);
  EXPECT_EQ(sphere.ball().center, Vector3(5, 6, 7));
  const Frame frame = sphere.rigidCenter();
  EXPECT_EQ(frame.center, Vector3(5, 6, 7));
  EXPECT_EQ(frame.orientation.x(), 0.5);
  EXPECT_EQ(frame.orientation.y(), -0.5);
  EXPECT_EQ(frame.orientation.z(), 0.5);
  EXPECT_EQ(frame.orientation.w(), -0.5);
}

TEST(RigidSphereModel, stores_columns_and_takes_them_without_a_copy) {
  Rows<3> positions = centers_of(kTwoBalls);
  Rows<1> radii = radii_of(kTwoBalls);
  const double* const position_data = positions.data();
  const double* const radius_data = radii.data();
  const RigidSphereModel model("r", std::move(positions), upright(2), std::move(radii));
  EXPECT_EQ(model.balls().centers.data(), position_data);
  EXPECT_EQ(model.balls().radii.data(), radius_data);
}

RigidSphereModel turned(double x, double y, double z, double w) {
  Eigen::MatrixX4d orientations = upright(2);
  orientations.row(1) << x, y, z, w;
  return {"r", centers_of(kTwoBalls), orientations, radii_of(kTwoBalls)};
}

TEST(RigidSphereModel, takes_unit_quaternions_up_to_the_tolerance_and_no_others) {
  static_assert(RigidSphereModel::kUnitTolerance == 0x1p-20);
  EXPECT_EQ(refusal([] {
              (void)turned(0x1p-10, 0, 0, 1);       // squared length 1 + 2^-20, exactly at the tolerance
              (void)turned(0, 0, 0, 1 - 0x1p-21);   // 1 - 2^-20 + 2^-42
              (void)turned(0, 0, 0, -1);            // the same rotation as 1
              const float half_root = 0.70710678F;  // rounded to binary32
              (void)turned(static_cast<double>(half_root), 0, static_cast<double>(half_root), 0);
            }),
            "");
  EXPECT_EQ(
      refusal([] { (void)turned(0x1p-10, 0x1p-26, 0, 1); }),  // 1 + 2^-20 + 2^-52
      "RigidSphereModel \"r\": orientations[1] squared length = 1.0000009536743166: must be 1, a unit quaternion");
  EXPECT_EQ(
      refusal([] { (void)turned(0, 0, 0, (1 - 0x1p-21) - 0x1p-42); }),  // 1 - 2^-20 - 2^-42 and a little
      "RigidSphereModel \"r\": orientations[1] squared length = 0.9999990463254562: must be 1, a unit quaternion");
  EXPECT_EQ(refusal([] { (void)turned(0, 0, 0, 0); }),
            "RigidSphereModel \"r\": orientations[1] squared length = 0: must be 1, a unit quaternion");
  EXPECT_EQ(refusal([] { (void)turned(kLargest, 0, 0, 0); }),
            "RigidSphereModel \"r\": orientations[1] squared length = inf: must be 1, a unit quaternion");
}

TEST(RigidSphereModel, refuses_what_is_not_finite_negative_or_too_few) {
  EXPECT_EQ(refusal([] {
              (void)rigid_spheres("r", {{{0, kNaN, 0}, 1}});
            }),
            "RigidSphereModel \"r\": positions[0][1] = nan: must be finite");
  EXPECT_EQ(refusal([] {
              (void)rigid_spheres("r", {{{0, 0, 0}, -1}});
            }),
            "RigidSphereModel \"r\": radii[0] = -1: must not be negative");
  EXPECT_EQ(refusal([] {
              (void)rigid_spheres("r", {{{0, 0, 0}, kInfinity}});
            }),
            "RigidSphereModel \"r\": radii[0] = inf: must be finite");
  EXPECT_EQ(refusal([] { (void)turned(0, 0, kNaN, 1); }),
            "RigidSphereModel \"r\": orientations[1][2] = nan: must be finite");
  EXPECT_EQ(refusal([] { (void)RigidSphereModel("r", centers_of(kTwoBalls), upright(2), Eigen::VectorXd::Ones(1)); }),
            "RigidSphereModel \"r\": number of radii = 1: must be that of positions, 2");
  EXPECT_EQ(refusal([] { (void)RigidSphereModel("r", centers_of(kTwoBalls), upright(3), radii_of(kTwoBalls)); }),
            "RigidSphereModel \"r\": number of orientations = 3: must be that of positions, 2");
}

TEST(RigidSphereModel, moves_its_frames) {
  auto model = rigid_spheres("r", kTwoBalls);
  Eigen::MatrixX4d orientations = upright(2);
  orientations.row(1) << 0.6, 0, 0.8, 0;
  model.setFrames(centers_of({{{9, 8, 7}, 0}, {{6, 5, 4}, 0}}), orientations);
  EXPECT_EQ(RigidSphere(model, 1).center(), Vector3(6, 5, 4));
  EXPECT_EQ(RigidSphere(model, 1).rigidCenter().center, Vector3(6, 5, 4));
  EXPECT_EQ(RigidSphere(model, 1).rigidCenter().orientation.z(), 0.8);
  EXPECT_EQ(RigidSphere(model, 1).r(), 8);
}

TEST(RigidSphereModel, is_left_as_it_was_by_frames_that_it_refuses) {
  auto model = rigid_spheres("r", kTwoBalls);
  const Eigen::MatrixX3d other = centers_of({{{9, 8, 7}, 0}, {{6, 5, 4}, 0}});
  Eigen::MatrixX3d not_finite = other;
  not_finite(0, 2) = -kInfinity;
  EXPECT_EQ(refusal([&] { model.setFrames(not_finite, upright(2)); }),
            "RigidSphereModel \"r\": positions[0][2] = -inf: must be finite");
  EXPECT_EQ(refusal([&] { model.setFrames(Eigen::MatrixX3d::Zero(3, 3), upright(3)); }),
            "RigidSphereModel \"r\": number of positions = 3: must be that of radii, 2");
  EXPECT_EQ(refusal([&] { model.setFrames(other, upright(1)); }),
            "RigidSphereModel \"r\": number of orientations = 1: must be that of radii, 2");
  EXPECT_EQ(refusal([&] { model.setFrames(other, 2 * upright(2)); }),
            "RigidSphereModel \"r\": orientations[0] squared length = 4: must be 1, a unit quaternion");
  EXPECT_EQ(refusal([&] { model.setFrames(other, upright(2) * kNaN); }),
            "RigidSphereModel \"r\": orientations[0][0] = nan: must be finite");
  EXPECT_EQ(model.balls().centers, centers_of(kTwoBalls));
  EXPECT_EQ(RigidSphere(model, 0).rigidCenter().orientation.w(), 1);
}

TEST(ContactPointByNormal, is_the_surface_point_that_the_normal_comes_through) {
  const auto s = spheres("s", {{{1, 2, 3}, 4}});
  const auto r = rigid_spheres("r", {{{1, 2, 3}, 4}});
  const Vector3 into(0.5, 0, -0.75);  // of length 0.9, so that all is exact: centre - 4 * into = (-1, 2, 6)
  EXPECT_EQ(Sphere(s, 0).getContactPointByNormal(into), Vector3(-1, 2, 6));
  EXPECT_EQ(RigidSphere(r, 0).getContactPointByNormal(into), Vector3(-1, 2, 6));
  EXPECT_EQ(RigidSphere(r, 0).getContactPointByNormal(-into), Vector3(3, 2, 0));
}

TEST(ContactPointByNormal, follows_its_convention_and_the_kind_of_sphere) {
  const auto s = spheres("s", {{{1, 2, 3}, 4}});
  const auto r = rigid_spheres("r", {{{1, 2, 3}, 4}});
  const Vector3 into(0.5, 0, -0.75);
  EXPECT_EQ(Sphere(s, 0).getContactPointByNormal(into, PointConvention::nearest_surface), Vector3(-1, 2, 6));
  EXPECT_EQ(Sphere(s, 0).getContactPointByNormal(into, PointConvention::center), Vector3(1, 2, 3));
  EXPECT_EQ(Sphere(s, 0).getContactPointByNormal(into, PointConvention::published), Vector3(3, 2, 0));
  EXPECT_EQ(RigidSphere(r, 0).getContactPointByNormal(into, PointConvention::nearest_surface), Vector3(-1, 2, 6));
  EXPECT_EQ(RigidSphere(r, 0).getContactPointByNormal(into, PointConvention::center), Vector3(-1, 2, 6));
  EXPECT_EQ(RigidSphere(r, 0).getContactPointByNormal(into, PointConvention::published), Vector3(3, 2, 0));
}

TEST(ContactPointByNormal, rounds_once) {
  // (1 + 2^-27)^2 = 1 + 2^-26 + 2^-54: the last term is lost when the product is rounded, and then 1 + 2^-26 less
  // itself is 0. One rounding leaves -2^-54.
  const double x = 1 + 0x1p-27;
  const auto model = spheres("s", {{{1 + 0x1p-26, 0, 0}, x}});
  EXPECT_EQ(Sphere(model, 0).getContactPointByNormal({x, 0, 0}), Vector3(-0x1p-54, 0, 0));
  // Random numbers, against the exact oracle: a product of 53-bit numbers less a third, rounded to nearest.
  std::mt19937_64 random(3);
  const auto number = [&] { return std::ldexp(static_cast<double>(random() >> 11), -53); };
  int two_roundings_differ = 0;
  for (int i = 0; i < 200; ++i) {
    const Ball ball{{number(), number(), number()}, number()};
    const Vector3 normal(number(), -number(), number());
    const Vector3 near = contact_point_by_normal(ball, normal, PointOn::nearest_surface);
    const Vector3 far = contact_point_by_normal(ball, normal, PointOn::far_surface);
    for (int axis = 0; axis < 3; ++axis) {
      const Rational c(ball.center[axis]);
      const Rational offset = Rational(normal[axis]) * Rational(ball.radius);
      EXPECT_EQ(near[axis], oracle::round_to_nearest(Rational(c - offset), Scalar::binary64));
      EXPECT_EQ(far[axis], oracle::round_to_nearest(Rational(c + offset), Scalar::binary64));
      const volatile double product = normal[axis] * ball.radius;
      two_roundings_differ += ball.center[axis] - product != near[axis];
    }
  }
  EXPECT_GT(two_roundings_differ, 60);  // of 600: the test can tell
}

std::vector<Ball> balls_of_every_size() {
  const std::vector<double> lengths{0,         kLeast,   3 * kLeast, 0x1p-1022, 0x1.fp-1001,
                                    0x1p-1000, 1e-300,   0.1,        1.0 / 3,   0x1.8p52 + 1,
                                    1e300,     0x1p1022, 0x1p1023,   kLargest,  kLargest / 4};
  std::vector<Ball> balls;
  for (const double c : lengths)
    for (const double r : lengths) balls.push_back({{c, -c, std::nextafter(c, 0)}, r});
  std::mt19937_64 random(5);
  const auto finite = [&] { return finite_of(random()); };
  for (int i = 0; i < 300; ++i) {
    const double c = finite();
    // a radius of the centre's size, where every rounding bites
    balls.push_back({{c, -c, finite()}, std::abs(i % 2 ? finite() : c * std::ldexp(finite() < 0 ? 0.3 : 0.7, i % 5))});
    if (!std::isfinite(balls.back().radius)) balls.back().radius = kLargest;
  }
  return balls;
}

/// -1 below every real number, 1 above, else 0.
int infinite(double x) { return std::isfinite(x) ? 0 : (x < 0 ? -1 : 1); }

template <class Model>
void expect_boxes_contain_their_spheres(const Model& model) {
  for (const auto& environment : floating_point_environments()) {
    std::vector<Box> boxes(static_cast<std::size_t>(model.getSize()));
    in_environment(environment, [&] {
      for (Index i = 0; i < model.getSize(); ++i) boxes[static_cast<std::size_t>(i)] = model.bounding_box(i);
    });
    for (Index i = 0; i < model.getSize(); ++i) {
      const Ball ball = model.balls()[i];
      const Box& box = boxes[static_cast<std::size_t>(i)];
      for (int axis = 0; axis < 3; ++axis) {
        const Rational c(ball.center[axis]);
        const Rational r(ball.radius);
        const std::string where = environment.name + ": " + text(ball.center[axis]) + " -+ " + text(ball.radius) +
                                  " in " + text(box.min[axis]) + " .. " + text(box.max[axis]);
        ASSERT_FALSE(std::isnan(box.min[axis]) || std::isnan(box.max[axis])) << where;
        ASSERT_TRUE(infinite(box.min[axis]) < 0 || Rational(box.min[axis]) <= c - r) << where;
        ASSERT_TRUE(infinite(box.max[axis]) > 0 || Rational(box.max[axis]) >= c + r) << where;
        // Nor much larger than it must be: within 2^-48 of the numbers that it is made from.
        const Rational size = (CGAL::abs(c) + r) * oracle::power_of_two(-48) + oracle::power_of_two(-999);
        if (CGAL::abs(c) + r > Rational(kLargest) * oracle::power_of_two(-1)) continue;
        ASSERT_TRUE(infinite(box.min[axis]) == 0 && Rational(box.min[axis]) >= c - r - size) << where;
        ASSERT_TRUE(infinite(box.max[axis]) == 0 && Rational(box.max[axis]) <= c + r + size) << where;
      }
    }
  }
}

TEST(SphereModel, its_boxes_contain_the_spheres_in_every_floating_point_environment) {
  expect_boxes_contain_their_spheres(spheres("s", balls_of_every_size()));
}

TEST(RigidSphereModel, its_boxes_contain_the_spheres_in_every_floating_point_environment) {
  expect_boxes_contain_their_spheres(rigid_spheres("r", balls_of_every_size()));
}

}  // namespace
}  // namespace contact
