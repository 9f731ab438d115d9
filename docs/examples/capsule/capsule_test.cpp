// Capsules against spheres: worked examples, the degenerate cases, and the oracle's numbers to the last bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "contact/detect.hpp"
#include "contact/discrete_intersection.hpp"
#include "contact/plugin.hpp"
#include "oracle/truth/truth.hpp"

namespace contact::capsule_example {
namespace {

constexpr double kLargest = std::numeric_limits<double>::max();

struct Question {
  Vector3 p;
  Vector3 q;
  Ball sphere;
  double radius = 0;
};

/// The contact of one capsule with one sphere.
std::optional<DetectionOutput> contact_of(const Question& question, Distances distances,
                                          PointConvention points = PointConvention::nearest_surface) {
  load_plugin(CAPSULE);
  const auto capsules = ModelFactory::getInstance().make("CapsuleModel", "capsule",
                                                         {{"p", question.p.transpose()},
                                                          {"q", question.q.transpose()},
                                                          {"radii", Eigen::MatrixXd::Constant(1, 1, question.radius)}});
  const SphereCollisionModel spheres("sphere", question.sphere.center.transpose(),
                                     Eigen::VectorXd::Constant(1, question.sphere.radius));
  const OutputVector contacts = *detect(ProximityIntersection(distances, points), *capsules, spheres);
  return contacts.empty() ? std::nullopt : std::optional(contacts.front());
}

void expect_contact(const std::optional<DetectionOutput>& contact, const Vector3& normal, const Vector3& point1,
                    const Vector3& point2, double value) {
  ASSERT_TRUE(contact.has_value());
  EXPECT_EQ(contact->normal, normal) << contact->normal.transpose();
  EXPECT_EQ(contact->point[0], point1) << contact->point[0].transpose();
  EXPECT_EQ(contact->point[1], point2) << contact->point[1].transpose();
  EXPECT_EQ(contact->value, value);
}

TEST(Capsule, gives_the_worked_examples_beside_the_segment_and_beyond_both_ends) {
  const Vector3 p(0, 0, 0);
  const Vector3 q(4, 0, 0);
  // (1,3,0) projects to (1,0,0), t = 1/4; distance 3 = 1 + 1.5 + 0.5
  expect_contact(contact_of({p, q, {{1, 3, 0}, 1.5}, 1}, {0.5, 0.25}), {0, 1, 0}, {1, 1, 0}, {1, 1.5, 0}, 0.25);
  EXPECT_FALSE(contact_of({p, q, {{1, 3, 0}, 1.5}, 1}, {0.25, 0}));
  // (7,4,0): nearest is q, delta (3,4,0) of length 5 = 1 + 4; n = (0.6,0.8,0), points q + n and (7,4,0) - 4 n
  expect_contact(contact_of({p, q, {{7, 4, 0}, 4}, 1}, {0, 0}), {0.6, 0.8, 0}, {4.6, 0.8, 0}, {4.6, 0.8, 0}, 0);
  // (-3,0,4): nearest is p
  expect_contact(contact_of({p, q, {{-3, 0, 4}, 4}, 1}, {0, 0}), {-0.6, 0, 0.8}, {-0.6, 0, 0.8}, {-0.6, 0, 0.8}, 0);
}

TEST(Capsule, follows_the_point_convention_of_the_discrete_intersection) {
  const Question question{{0, 0, 0}, {4, 0, 0}, {{1, 3, 0}, 1.5}, 1};
  expect_contact(contact_of(question, {1, 0}, PointConvention::center), {0, 1, 0}, {1, 0, 0}, {1, 3, 0}, 0.5);
  expect_contact(contact_of(question, {1, 0}, PointConvention::published), {0, 1, 0}, {1, -1, 0}, {1, 4.5, 0}, 0.5);
  const Question inside{{0, 0, -1}, {0, 0, 1}, {{0, 0, 0}, 2}, 1};
  expect_contact(contact_of(inside, {0, 0}, PointConvention::center), {-1, 0, 0}, {0, 0, 0}, {0, 0, 0}, -3);
  expect_contact(contact_of(inside, {0, 0}, PointConvention::published), {-1, 0, 0}, {1, 0, 0}, {-2, 0, 0}, -3);
}

/// Capsules and centres of every shape: ordinary, long and thin, far away, and at both ends of the range.
class Questions {
 public:
  Question operator()() {
    const int kind = static_cast<int>(random_() % 4);
    const int exponent = kind == 3 ? static_cast<int>(random_() % 2096) - 1074 : 0;
    const int length = kind == 1 ? -static_cast<int>(random_() % 60) : 0;
    Question question;
    question.p = vector();
    question.q = kind == 0 ? vector() : question.p + std::ldexp(1.0, length) * vector();
    if (kind == 3 && (random_() & 1) != 0) question.q = -question.p + 0x1p-20 * vector();
    question.sphere.center = vector();
    if (kind == 2) question.sphere.center = (question.p + question.q) / 2 + 0x1p-30 * vector();
    for (Vector3* v : {&question.p, &question.q, &question.sphere.center})
      for (double& x : *v) x = std::clamp(std::ldexp(x, exponent), -kLargest, kLargest);
    question.radius = std::abs(std::ldexp(number(), exponent)) / 8;
    question.sphere.radius = std::abs(std::ldexp(number(), exponent)) / 8;
    return question;
  }

 private:
  double number() { return std::ldexp(static_cast<double>(static_cast<std::int64_t>(random_())), -63); }
  Vector3 vector() {
    return Vector3::NullaryExpr([&] { return number(); });
  }
  std::mt19937_64 random_{17};
};

TEST(Capsule, has_the_numbers_of_the_oracle_to_the_last_bit) {
  Questions next;
  int hits = 0;
  for (int i = 0; i < 4000; ++i) {
    const Question question = next();
    const Distances distances{question.radius, question.sphere.radius};
    const BallAndCapsule shapes{question.sphere, {question.p, question.q, question.radius}};
    const Expectation expected =
        oracle::expectation(oracle::truth_of({Pair::sphere_capsule, shapes, distances}), Scalar::binary64);
    const auto contact = contact_of(question, distances);
    ASSERT_EQ(contact.has_value(), expected.hit) << i;
    if (!contact) continue;
    ++hits;
    const Contact& c = *expected.contact;  // of the sphere first
    expect_contact(contact, Vector3::Zero() - c.normal, c.point2, c.point1, c.value);
  }
  EXPECT_GT(hits, 800);
  EXPECT_LT(hits, 3200);
}

}  // namespace
}  // namespace contact::capsule_example
