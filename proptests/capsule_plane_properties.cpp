// Production's functions for a capsule and a plane against both oracles, and what ties them to a sphere and a plane.
#include "contact/capsule_plane.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "contact/sphere_plane.hpp"
#include "oracle/truth/exact_truth.hpp"
#include "oracle/truth/interval_oracle.hpp"
#include "oracle/truth/truth.hpp"
#include "proptests/generators.hpp"

namespace contact {
namespace {

using namespace proptests;

rc::Gen<Query> drawn() { return queries(static_cast<const CapsuleAndPlane*>(nullptr), Range()); }

const CapsuleAndPlane& shapes_in(const Query& query) { return std::get<CapsuleAndPlane>(query.shapes); }

Expectation computed(const Capsule& a, const Plane& b, Distances distances) {
  const auto contact = compute_capsule_plane(a, b, distances);
  return {contact.has_value(), contact};
}
Expectation of_sphere(const Vector3& center, const Capsule& a, const Plane& b, Distances distances) {
  const auto contact = compute_sphere_plane({center, a.radius}, b, distances);
  return {contact.has_value(), contact};
}

/// Which end is lower: -1 the end, 1 the start, 0 neither.
int rise(const Capsule& a, const Plane& b) {
  using oracle::operator-;
  return static_cast<int>(
      CGAL::sign(oracle::dot(oracle::point_of(b.normal), oracle::point_of(a.end) - oracle::point_of(a.start))));
}

RC_GTEST_PROP(CapsulePlane, production_equals_both_oracles, ()) {
  const Query query = *drawn();
  RC_ASSERT(!outside_domain(query));
  const auto& [a, b] = shapes_in(query);
  const Expectation contact = computed(a, b, query.distances);
  RC_ASSERT(test_capsule_plane(a, b, query.distances.alarm) == contact.hit);
  RC_ASSERT(first_difference(contact, oracle::expectation(oracle::truth_of(query), Scalar::binary64)) == std::nullopt);
  RC_ASSERT(first_difference(contact, oracle::interval_answer(query, Scalar::binary64).expected) == std::nullopt);
}

RC_GTEST_PROP(CapsulePlane, the_lower_end_answers_as_a_sphere, ()) {
  const Query query = *drawn();
  const auto& [a, b] = shapes_in(query);
  RC_PRE(rise(a, b) != 0 || a.start == a.end);
  const Vector3& lower = rise(a, b) < 0 ? a.end : a.start;
  RC_ASSERT(first_difference(computed(a, b, query.distances), of_sphere(lower, a, b, query.distances)) == std::nullopt);
}

RC_GTEST_PROP(CapsulePlane, along_the_plane_the_middle_answers_and_is_not_unique, ()) {
  Query query = *drawn();
  auto& [a, b] = std::get<CapsuleAndPlane>(query.shapes);
  const int axis = *integer(0, 2);
  const double size = b.normal[axis] == 0 ? 1 : b.normal[axis];
  b.normal.setZero();
  b.normal[axis] = size;
  a.end[axis] = a.start[axis];
  RC_PRE(a.start != a.end);
  const auto middle = exact_middle(a.start, a.end);
  RC_PRE(middle.has_value());
  Expectation sphere = of_sphere(*middle, a, b, query.distances);
  if (sphere.contact) sphere.contact->unique = false;
  RC_ASSERT(first_difference(computed(a, b, query.distances), sphere) == std::nullopt);
}

RC_GTEST_PROP(CapsulePlane, turned_round_it_is_the_same, ()) {
  const Query query = *drawn();
  const auto& [a, b] = shapes_in(query);
  RC_ASSERT(first_difference(computed(a, b, query.distances),
                             computed({a.end, a.start, a.radius}, b, query.distances)) == std::nullopt);
}

RC_GTEST_PROP(CapsulePlane, a_longer_capsule_and_a_larger_radius_hit_as_well, ()) {
  const Query query = *drawn();
  const auto& [a, b] = shapes_in(query);
  const double alarm = query.distances.alarm;
  const double more = std::abs(*any_number(Range()));
  RC_ASSERT(test_capsule_plane({a.start, a.end, alarm}, b, a.radius) == test_capsule_plane(a, b, alarm));
  RC_ASSERT(test_capsule_plane(a, b, alarm) ==
            (test_sphere_plane({a.start, a.radius}, b, alarm) || test_sphere_plane({a.end, a.radius}, b, alarm)));
  if (!test_capsule_plane(a, b, alarm)) return;
  RC_ASSERT(test_capsule_plane({a.start, a.end, std::max(a.radius, more)}, b, alarm));
  RC_ASSERT(test_capsule_plane(a, b, std::max(alarm, more)));
}

// What the properties were asked: shares of a sample with a fixed seed.
TEST(CapsulePlaneQuestions, hold_enough_of_every_kind) {
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
    counts["below the plane"] += truth.distance()->below() ? 1 : 0;
    counts["without length"] += a.start == a.end ? 1 : 0;
    if (a.start != a.end) ++counts[rise(a, b) < 0 ? "the end lower" : rise(a, b) > 0 ? "the start lower" : "along it"];
  }
  const auto share = [&](const std::string& kind) {
    RecordProperty(kind, std::to_string(100.0 * counts[kind] / asked) + " %");
    return 100.0 * counts[kind] / asked;
  };
  EXPECT_GT(asked, kCount * 9 / 10);
  EXPECT_GT(share("hits"), 30);
  EXPECT_LT(share("hits"), 85);
  EXPECT_GT(share("exactly at the alarm distance"), 5);
  EXPECT_GT(share("below the plane"), 15);
  EXPECT_GT(share("without length"), 3);
  EXPECT_GT(share("along it"), 10);
  EXPECT_GT(share("the start lower"), 15);
  EXPECT_GT(share("the end lower"), 15);
}

}  // namespace
}  // namespace contact
