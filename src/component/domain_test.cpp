// The input domain, asked by bits: no environment and no option of a compiler lets a bad number through.
#include "contact/domain.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "environment/floating_point_environments.hpp"
#include "extreme_numbers.hpp"

namespace contact {
namespace {

TEST(Bits, say_what_is_finite_and_what_is_less) {
  static_assert(is_finite_by_bits(kLargest) && is_finite_by_bits(-kLeast) && is_finite_by_bits(0));
  static_assert(!is_finite_by_bits(kInfinity) && !is_finite_by_bits(-kInfinity) && !is_finite_by_bits(kNaN));
  const std::vector<double> ascending{-kInfinity, -kLargest, -1, -kLeast, 0, kLeast, 1, kLargest, kInfinity};
  for (std::size_t i = 0; i < ascending.size(); ++i)
    for (std::size_t j = 0; j < ascending.size(); ++j)
      EXPECT_EQ(is_less_by_bits(ascending[i], ascending[j]), i < j) << ascending[i] << " " << ascending[j];
  EXPECT_FALSE(is_less_by_bits(-0.0, 0.0));
  EXPECT_FALSE(is_less_by_bits(0.0, -0.0));
}

TEST(Domain, is_the_same_in_every_floating_point_environment) {
  const auto rule = [](const auto&... of) {
    const auto error = outside_domain(of...);
    return error ? error->field + " " + error->rule : "";
  };
  const std::string r = "r";
  const std::vector<std::pair<std::function<std::string()>, std::string>> cases{
      {[&] { return rule(r, -0.0); }, ""},
      {[&] { return rule(r, kLeast); }, ""},
      {[&] { return rule(r, -kLeast); }, "r must not be negative"},
      {[&] { return rule(r, kNaN); }, "r must be finite"},
      {[&] { return rule(r, -kInfinity); }, "r must be finite"},
      {[&] { return rule(r, Vector3(0, 0, kNaN)); }, "r[2] must be finite"},
      {[&] {
         return rule(r, Ball{{0, kInfinity, 0}, 1});
       },
       "r.center[1] must be finite"},
      {[&] {
         return rule(r, Box{{0, kLeast, 0}, {0, kLeast, 0}});
       },
       ""},
      {[&] {
         return rule(r, Box{{0, kLeast, 0}, {0, 0, 0}});
       },
       "r.min[1] must not exceed max"},
      {[&] {
         return rule(Distances{kLargest, -kLeast});
       },
       "contact must not be negative"}};
  for (std::size_t i = 0; i < cases.size(); ++i)
    for (const FloatingPointEnvironment& environment : floating_point_environments()) {
      std::string said;
      in_environment(environment, [&] { said = cases[i].first(); });
      EXPECT_EQ(said, cases[i].second) << i << ", " << environment.name;
    }
}

}  // namespace
}  // namespace contact
