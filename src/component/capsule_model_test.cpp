// The capsule model: data in and out, bounding boxes, and every refusal word for word.
#include "contact/capsule_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "component/models_for_tests.hpp"
#include "environment/floating_point_environments.hpp"
#include "extreme_numbers.hpp"
#include "oracle/truth/exact.hpp"

namespace contact {
namespace {

using component::capsules;
using component::refusal;

const std::vector<Capsule> kTwoCapsules{{{0, 1, 2}, {3, 4, 5}, 0.5}, {{-1, -2, -3}, {-1, -2, -3}, 0}};

TEST(CapsuleModel, gives_back_what_it_was_given) {
  const auto model = capsules("c", kTwoCapsules);
  EXPECT_EQ(model.getSize(), 2);
  const CapsuleElement capsule(model, 0);
  EXPECT_EQ(capsule.point1(), Vector3(0, 1, 2));
  EXPECT_EQ(capsule.point2(), Vector3(3, 4, 5));
  EXPECT_EQ(capsule.radius(), 0.5);
  EXPECT_EQ(model.capsule(1).start, Vector3(-1, -2, -3));
  EXPECT_EQ(model.capsule(1).end, Vector3(-1, -2, -3));
  EXPECT_EQ(model.capsule(1).radius, 0);
}

TEST(CapsuleModel, moves_both_ends_and_keeps_the_radii) {
  auto model = capsules("c", kTwoCapsules);
  Eigen::MatrixX3d starts(2, 3);
  starts << 1, 2, 3, 4, 5, 6;
  model.setEnds(starts, -starts);
  EXPECT_EQ(model.capsule(1).start, Vector3(4, 5, 6));
  EXPECT_EQ(model.capsule(0).end, Vector3(-1, -2, -3));
  EXPECT_EQ(model.capsule(0).radius, 0.5);
}

TEST(CapsuleModel, takes_points_and_the_largest_and_smallest_numbers) {
  EXPECT_EQ(refusal([] {
              (void)capsules("c", {{{kLargest, -kLargest, kLeast}, {-kLargest, kLargest, -kLeast}, kLargest}});
              (void)capsules("c", {{{0, 0, 0}, {0, 0, 0}, 0}, {{0, 0, 0}, {-0.0, 0, 0}, -0.0}});
              (void)capsules("c", {});
            }),
            "");
}

TEST(CapsuleModel, refuses_numbers_outside_the_domain_and_names_them) {
  const auto refused = [](Capsule second) {
    return refusal([&] { (void)capsules("arm", {kTwoCapsules[0], second}); });
  };
  EXPECT_EQ(refused({{0, kNaN, 0}, {1, 1, 1}, 1}), "CapsuleCollisionModel \"arm\": starts[1][1] = nan: must be finite");
  EXPECT_EQ(refused({{0, 0, 0}, {1, 1, -kInfinity}, 1}),
            "CapsuleCollisionModel \"arm\": ends[1][2] = -inf: must be finite");
  EXPECT_EQ(refused({{0, 0, 0}, {1, 1, 1}, -kLeast}),
            "CapsuleCollisionModel \"arm\": radii[1] = -5e-324: must not be negative");
  EXPECT_EQ(refused({{0, 0, 0}, {1, 1, 1}, kInfinity}),
            "CapsuleCollisionModel \"arm\": radii[1] = inf: must be finite");
}

TEST(CapsuleModel, refuses_columns_of_different_lengths) {
  const Eigen::MatrixX3d two = Eigen::MatrixX3d::Zero(2, 3);
  const Eigen::MatrixX3d three = Eigen::MatrixX3d::Zero(3, 3);
  EXPECT_EQ(refusal([&] { (void)CapsuleCollisionModel("arm", two, three, Eigen::VectorXd::Ones(2)); }),
            "CapsuleCollisionModel \"arm\": number of ends = 3: must be that of starts, 2");
  EXPECT_EQ(refusal([&] { (void)CapsuleCollisionModel("arm", two, two, Eigen::VectorXd::Ones(3)); }),
            "CapsuleCollisionModel \"arm\": number of radii = 3: must be that of starts, 2");
}

TEST(CapsuleModel, refuses_ends_that_it_cannot_take_and_stays_as_it_was) {
  auto model = capsules("arm", kTwoCapsules);
  const Eigen::MatrixX3d two = Eigen::MatrixX3d::Ones(2, 3);
  Eigen::MatrixX3d bad = two;
  bad(1, 0) = kNaN;
  EXPECT_EQ(refusal([&] { model.setEnds(bad, two); }),
            "CapsuleCollisionModel \"arm\": starts[1][0] = nan: must be finite");
  EXPECT_EQ(refusal([&] { model.setEnds(two, bad); }),
            "CapsuleCollisionModel \"arm\": ends[1][0] = nan: must be finite");
  EXPECT_EQ(refusal([&] { model.setEnds(two.topRows(1), two); }),
            "CapsuleCollisionModel \"arm\": number of starts = 1: must be that of radii, 2");
  EXPECT_EQ(refusal([&] { model.setEnds(two, two.topRows(1)); }),
            "CapsuleCollisionModel \"arm\": number of ends = 1: must be that of radii, 2");
  EXPECT_EQ(model.capsule(0).start, kTwoCapsules[0].start);
  EXPECT_EQ(model.capsule(0).end, kTwoCapsules[0].end);
}

TEST(CapsuleModel, its_bounding_boxes_contain_the_capsules_and_not_much_more_in_every_rounding_mode) {
  std::mt19937_64 random(5);
  const auto number = [&](int exponent) {
    return std::ldexp(static_cast<double>(static_cast<std::int64_t>(random())), exponent - 63);
  };
  std::vector<Capsule> all{{{kLargest, 0, 0}, {-kLargest, 0, kLeast}, 1},
                           {{0, 0, 0}, {kLeast, -kLeast, 0}, 0},
                           {{0x1p-1000, 0, 0}, {0, 0x1p-1000, 0}, 0}};  // with a subnormal bound
  for (const int exponent : {-1060, -20, 0, 1000}) {
    for (int i = 0; i < 20; ++i)
      all.push_back({{number(exponent), number(exponent), number(exponent)},
                     {number(exponent), number(exponent - 40), number(exponent)},
                     std::abs(number(exponent - i))});
  }
  const auto model = capsules("c", all);
  for (const auto& environment : floating_point_environments())
    for (Index i = 0; i < model.getSize(); ++i) {
      Box box;
      in_environment(environment, [&] { box = model.bounding_box(i); });
      const Capsule& c = all[static_cast<std::size_t>(i)];
      for (int axis = 0; axis < 3; ++axis) {
        using oracle::Rational;
        const Rational low = Rational(std::min(c.start[axis], c.end[axis])) - Rational(c.radius);
        const Rational high = Rational(std::max(c.start[axis], c.end[axis])) + Rational(c.radius);
        const Rational room = Rational(std::abs(c.start[axis])) + Rational(std::abs(c.end[axis])) + Rational(c.radius);
        const Rational margin = room * oracle::power_of_two(-48) + oracle::power_of_two(-999);
        EXPECT_TRUE(box.min[axis] == -kInfinity || Rational(box.min[axis]) <= low) << i << ", " << environment.name;
        EXPECT_TRUE(box.max[axis] == kInfinity || Rational(box.max[axis]) >= high) << i << ", " << environment.name;
        EXPECT_TRUE(box.min[axis] == -kInfinity ? low <= Rational(-kLargest) * (1 - oracle::power_of_two(-40))
                                                : low - Rational(box.min[axis]) <= margin);
        EXPECT_TRUE(box.max[axis] == kInfinity ? high >= Rational(kLargest) * (1 - oracle::power_of_two(-40))
                                               : Rational(box.max[axis]) - high <= margin);
      }
    }
}

}  // namespace
}  // namespace contact
