// Detection at full size: a sample of 10^5 elements has the contacts that the oracle finds over all pairs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "component/expected_for_tests.hpp"
#include "component/models_for_tests.hpp"
#include "contact/detect.hpp"
#include "contact/discrete_intersection.hpp"

namespace contact {
namespace {

using component::text;

constexpr std::size_t kCount = 100000;
constexpr double kMeetings = 10;  // expected, an element

std::vector<Ball> spread(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto unit = [&] { return std::ldexp(static_cast<double>(random() >> 11), -53); };
  std::vector<Ball> balls;
  for (std::size_t i = 0; i < kCount; ++i) {
    const double x = unit();
    const double y = unit();
    const double z = unit();
    balls.push_back({{x, y, z}, unit()});
  }
  // Mean of (r1 + r2)^3 over radii uniform in 0 .. R: 3/2 R^3. Each element meets 4/3 pi 3/2 R^3 kCount others.
  const double radius = std::cbrt(kMeetings / (2 * 3.14159 * static_cast<double>(kCount)));
  for (Ball& ball : balls) ball.radius *= radius;
  return balls;
}

/// Farther apart on one axis than any rounding of this line could hide: the oracle need not be asked.
bool far_apart(const Ball& a, const Ball& b) {
  return ((a.center - b.center).cwiseAbs().array() > 1.001 * (a.radius + b.radius) + 0x1p-40).any();
}

TEST(DetectScale, a_sample_of_100000_spheres_has_the_contacts_that_the_oracle_finds_over_all_pairs) {
  const std::vector<Ball> first = spread(1);
  const std::vector<Ball> second = spread(2);
  const auto model1 = component::spheres("first", first);
  const auto model2 = component::spheres("second", second);
  const auto contacts = detect(DiscreteIntersection(), model1, model2);
  ASSERT_TRUE(contacts.has_value());
  EXPECT_GT(contacts->size(), 8 * kCount);
  EXPECT_LT(contacts->size(), 12 * kCount);

  const auto before = [](const DetectionOutput& contact, Index i) { return contact.elem.first.getIndex() < i; };
  std::size_t compared = 0;
  for (std::size_t sample = 0; sample < 20; ++sample) {
    const std::size_t i = sample * 5003;
    const auto index = static_cast<Index>(i);
    OutputVector expected;
    for (std::size_t j = 0; j < kCount; ++j) {
      if (far_apart(first[i], second[j])) continue;
      if (const auto contact = component::expected_contact({model1, index}, first[i], {model2, static_cast<Index>(j)},
                                                           second[j], {0, 0}))
        expected.push_back(*contact);
    }
    const auto begin = std::lower_bound(contacts->begin(), contacts->end(), index, before);
    const auto end = std::lower_bound(begin, contacts->end(), index + 1, before);
    EXPECT_EQ(text(OutputVector(begin, end)), text(expected)) << "first[" << i << "]";
    compared += expected.size();
  }
  EXPECT_GT(compared, 100U);
}

}  // namespace
}  // namespace contact
