// Production's functions for a ray and a sphere against both oracles, and what ties them to the other pairs.
#include "contact/ray_sphere.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "contact/capsule_capsule.hpp"
#include "oracle/truth/interval_oracle.hpp"
#include "oracle/truth/truth.hpp"
#include "proptests/generators.hpp"

namespace contact {
namespace {

using namespace proptests;

rc::Gen<Query> drawn() { return queries(static_cast<const RayAndBall*>(nullptr), Range()); }

const RayAndBall& shapes_in(const Query& query) { return std::get<RayAndBall>(query.shapes); }

Expectation computed(const Ray& a, const Ball& b, Distances distances) {
  const auto contact = compute_ray_sphere(a, b, distances);
  return {contact.has_value(), contact};
}

RC_GTEST_PROP(RaySphere, production_equals_both_oracles, ()) {
  const Query query = *drawn();
  RC_ASSERT(!outside_domain(query));
  const auto& [a, b] = shapes_in(query);
  const Expectation contact = computed(a, b, query.distances);
  RC_ASSERT(test_ray_sphere(a, b, query.distances.alarm) == contact.hit);
  RC_ASSERT(first_difference(contact, oracle::expectation(oracle::truth_of(query), Scalar::binary64)) == std::nullopt);
  RC_ASSERT(first_difference(contact, oracle::interval_answer(query, Scalar::binary64).expected) == std::nullopt);
}

RC_GTEST_PROP(RaySphere, a_ray_that_ends_at_a_number_is_a_capsule_of_radius_0, ()) {
  Query query = *drawn();
  auto& [a, b] = std::get<RayAndBall>(query.shapes);
  Vector3 end;
  for (int axis = 0; axis < 3; ++axis) {
    const double way = a.length * a.direction[axis];
    RC_PRE(std::isfinite(way) && std::fma(a.length, a.direction[axis], -way) == 0 &&
           (way == 0 || std::abs(way) > 0x1p-900));
    end[axis] = a.origin[axis] + way;
    RC_PRE(std::isfinite(end[axis]) && end[axis] - a.origin[axis] == way && end[axis] - way == a.origin[axis]);
  }
  const auto capsules = compute_capsule_capsule({a.origin, end, 0}, {b.center, b.center, b.radius}, query.distances);
  RC_ASSERT(first_difference(computed(a, b, query.distances), {capsules.has_value(), capsules}) == std::nullopt);
}

RC_GTEST_PROP(RaySphere, powers_of_two_may_move_from_the_direction_to_the_length, ()) {
  const Query query = *drawn();
  const auto& [a, b] = shapes_in(query);
  const int exponent = *integer(-20, 20);
  const auto fits = [](double x) { return x == 0 || (std::abs(x) > 0x1p-1000 && std::abs(x) < 0x1p1000); };
  RC_PRE(fits(a.length) && fits(a.direction[0]) && fits(a.direction[1]) && fits(a.direction[2]));
  const double by = std::ldexp(1.0, exponent);
  const Ray same{a.origin, a.direction * by, a.length / by};
  RC_ASSERT(first_difference(computed(a, b, query.distances), computed(same, b, query.distances)) == std::nullopt);
}

RC_GTEST_PROP(RaySphere, a_longer_ray_and_a_larger_radius_hit_as_well, ()) {
  const Query query = *drawn();
  const auto& [a, b] = shapes_in(query);
  const double alarm = query.distances.alarm;
  const double more = std::abs(*any_number(Range()));
  RC_ASSERT(test_ray_sphere(a, {b.center, alarm}, b.radius) == test_ray_sphere(a, b, alarm));
  if (!test_ray_sphere(a, b, alarm)) return;
  RC_ASSERT(test_ray_sphere({a.origin, a.direction, std::max(a.length, more)}, b, alarm));
  RC_ASSERT(test_ray_sphere(a, {b.center, std::max(b.radius, more)}, alarm));
  RC_ASSERT(test_ray_sphere(a, b, std::max(alarm, more)));
}

// What the properties were asked: shares of a sample with a fixed seed.
TEST(RaySphereQuestions, hold_enough_of_every_kind) {
  constexpr int kCount = 4000;
  int asked = 0;
  std::map<std::string, int> counts;
  for (const Query& query : sample(drawn(), kCount)) {
    if (!Range().contains(query)) continue;
    ++asked;
    const oracle::Truth truth = oracle::truth_of(query);
    const auto& [a, b] = shapes_in(query);
    counts["hits"] += truth.hit() ? 1 : 0;
    counts["exactly at the alarm distance"] += truth.at_alarm == oracle::Side::at ? 1 : 0;
    counts["on the ray"] += truth.degenerate() ? 1 : 0;
    if (a.length == 0) {
      ++counts["without length"];
    } else {
      const double along = a.direction.dot(b.center - a.origin) / a.direction.squaredNorm();
      ++counts[along <= 0 ? "beside the origin" : along >= a.length ? "beside the end" : "beside the side"];
    }
  }
  const auto share = [&](const std::string& kind) {
    RecordProperty(kind, std::to_string(100.0 * counts[kind] / asked) + " %");
    return 100.0 * counts[kind] / asked;
  };
  EXPECT_GT(asked, kCount * 9 / 10);
  EXPECT_GT(share("hits"), 30);
  EXPECT_LT(share("hits"), 85);
  EXPECT_GT(share("exactly at the alarm distance"), 2);
  EXPECT_GT(share("on the ray"), 2);
  EXPECT_GT(share("without length"), 2);
  EXPECT_GT(share("beside the origin"), 10);
  EXPECT_GT(share("beside the end"), 10);
  EXPECT_GT(share("beside the side"), 10);
}

}  // namespace
}  // namespace contact
