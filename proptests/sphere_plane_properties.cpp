// Production's functions for a sphere and a plane against both oracles, and what ties their answers to each other.
#include "contact/sphere_plane.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "oracle/truth/exact_truth.hpp"
#include "oracle/truth/interval_oracle.hpp"
#include "oracle/truth/truth.hpp"
#include "proptests/generators.hpp"

namespace contact {
namespace {

using namespace proptests;

rc::Gen<Query> drawn() { return queries(static_cast<const BallAndPlane*>(nullptr), Range()); }

const BallAndPlane& shapes_in(const Query& query) { return std::get<BallAndPlane>(query.shapes); }

Expectation computed(const Ball& a, const Plane& b, Distances distances) {
  const auto contact = compute_sphere_plane(a, b, distances);
  return {contact.has_value(), contact};
}

RC_GTEST_PROP(SpherePlane, production_equals_both_oracles, ()) {
  const Query query = *drawn();
  RC_ASSERT(!outside_domain(query));
  const auto& [a, b] = shapes_in(query);
  const Expectation contact = computed(a, b, query.distances);
  RC_ASSERT(test_sphere_plane(a, b, query.distances.alarm) == contact.hit);
  RC_ASSERT(first_difference(contact, oracle::expectation(oracle::truth_of(query), Scalar::binary64)) == std::nullopt);
  RC_ASSERT(first_difference(contact, oracle::interval_answer(query, Scalar::binary64).expected) == std::nullopt);
}

RC_GTEST_PROP(SpherePlane, the_length_of_the_normal_says_nothing, ()) {
  const Query query = *drawn();
  const auto& [a, b] = shapes_in(query);
  const double by = std::ldexp(1.0, *integer(-20, 20));
  const auto fits = [](double x) { return x == 0 || (std::abs(x) > 0x1p-1000 && std::abs(x) < 0x1p1000); };
  RC_PRE(fits(b.offset) && fits(b.normal[0]) && fits(b.normal[1]) && fits(b.normal[2]));
  const Plane same{b.normal * by, b.offset * by};
  RC_ASSERT(first_difference(computed(a, b, query.distances), computed(a, same, query.distances)) == std::nullopt);
}

RC_GTEST_PROP(SpherePlane, a_mirror_changes_signs_alone, ()) {
  const Query query = *drawn();
  const auto& [a, b] = shapes_in(query);
  const int axis = *integer(0, 2);
  const auto mirrored = [axis](Vector3 v) {
    v[axis] = 0 - v[axis];  // +0 for a zero
    return v;
  };
  Expectation there = computed(a, b, query.distances);
  if (there.contact)
    for (Vector3* v : {&there.contact->normal, &there.contact->point1, &there.contact->point2}) *v = mirrored(*v);
  RC_ASSERT(first_difference(computed({mirrored(a.center), a.radius}, {mirrored(b.normal), b.offset}, query.distances),
                             there) == std::nullopt);
}

RC_GTEST_PROP(SpherePlane, a_larger_radius_and_a_higher_plane_hit_as_well, ()) {
  const Query query = *drawn();
  const auto& [a, b] = shapes_in(query);
  const double alarm = query.distances.alarm;
  const double more = std::abs(*any_number(Range()));
  RC_ASSERT(test_sphere_plane({a.center, alarm}, b, a.radius) == test_sphere_plane(a, b, alarm));
  if (!test_sphere_plane(a, b, alarm)) return;
  RC_ASSERT(test_sphere_plane({a.center, std::max(a.radius, more)}, b, alarm));
  RC_ASSERT(test_sphere_plane(a, {b.normal, std::max(b.offset, more)}, alarm));
  RC_ASSERT(test_sphere_plane(a, b, std::max(alarm, more)));
}

RC_GTEST_PROP(SpherePlane, both_half_spaces_of_a_plane_together_are_everything, ()) {
  const Query query = *drawn();
  const auto& [a, b] = shapes_in(query);
  const Plane other{Vector3::Zero() - b.normal, 0 - b.offset};
  RC_ASSERT(test_sphere_plane(a, b, 0) || test_sphere_plane(a, other, 0));
}

// What the properties were asked: shares of a sample with a fixed seed.
TEST(SpherePlaneQuestions, hold_enough_of_every_kind) {
  constexpr int kCount = 4000;
  int asked = 0;
  std::map<std::string, int> counts;
  for (const Query& query : sample(drawn(), kCount)) {
    if (!Range().contains(query)) continue;
    ++asked;
    const oracle::Truth truth = oracle::truth_of(query);
    counts["hits"] += truth.hit() ? 1 : 0;
    counts["exactly at the alarm distance"] += truth.at_alarm == oracle::Side::at ? 1 : 0;
    counts["below the plane"] += truth.distance()->below() ? 1 : 0;
    counts["on the plane"] += CGAL::is_zero(truth.distance()->distance2()) ? 1 : 0;
    counts["normals along an axis"] += (shapes_in(query).b.normal.array() != 0).count() == 1 ? 1 : 0;
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
  EXPECT_GT(share("on the plane"), 2);
  EXPECT_GT(share("normals along an axis"), 15);
}

}  // namespace
}  // namespace contact
