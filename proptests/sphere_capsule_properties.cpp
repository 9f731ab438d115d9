// Production's functions for a sphere and a capsule against both oracles, and what ties them to the other pairs.
#include "contact/sphere_capsule.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "contact/sphere_sphere.hpp"
#include "oracle/truth/interval_oracle.hpp"
#include "oracle/truth/truth.hpp"
#include "proptests/generators.hpp"

namespace contact {
namespace {

using namespace proptests;

rc::Gen<Query> drawn() { return queries(static_cast<const BallAndCapsule*>(nullptr), Range()); }

const BallAndCapsule& shapes_in(const Query& query) { return std::get<BallAndCapsule>(query.shapes); }

Expectation computed(const Ball& a, const Capsule& b, Distances distances) {
  const auto contact = compute_sphere_capsule(a, b, distances);
  return {contact.has_value(), contact};
}

RC_GTEST_PROP(SphereCapsule, production_equals_both_oracles, ()) {
  const Query query = *drawn();
  RC_ASSERT(!outside_domain(query));
  const auto& [a, b] = shapes_in(query);
  const Expectation contact = computed(a, b, query.distances);
  RC_ASSERT(test_sphere_capsule(a, b, query.distances.alarm) == contact.hit);
  RC_ASSERT(first_difference(contact, oracle::expectation(oracle::truth_of(query), Scalar::binary64)) == std::nullopt);
  RC_ASSERT(first_difference(contact, oracle::interval_answer(query, Scalar::binary64).expected) == std::nullopt);
}

RC_GTEST_PROP(SphereCapsule, a_capsule_without_length_is_a_sphere, ()) {
  Query query = *drawn();
  auto& [a, b] = std::get<BallAndCapsule>(query.shapes);
  b.end = b.start;
  const auto spheres = compute_sphere_sphere(a, {b.start, b.radius}, query.distances);
  RC_ASSERT(first_difference(computed(a, b, query.distances), {spheres.has_value(), spheres}) == std::nullopt);
}

RC_GTEST_PROP(SphereCapsule, swapped_ends_change_nothing, ()) {
  const Query query = *drawn();
  const auto& [a, b] = shapes_in(query);
  const Capsule turned{b.end, b.start, b.radius};
  RC_ASSERT(first_difference(computed(a, b, query.distances), computed(a, turned, query.distances)) == std::nullopt);
}

RC_GTEST_PROP(SphereCapsule, the_two_radii_count_alike_and_larger_ones_hit_as_well, ()) {
  const Query query = *drawn();
  const auto& [a, b] = shapes_in(query);
  const double alarm = query.distances.alarm;
  const double more = std::abs(*any_number(Range()));
  const bool hit = test_sphere_capsule(a, b, alarm);
  RC_ASSERT(test_sphere_capsule({a.center, b.radius}, {b.start, b.end, a.radius}, alarm) == hit);
  if (!hit) return;
  RC_ASSERT(test_sphere_capsule({a.center, std::max(a.radius, more)}, b, alarm));
  RC_ASSERT(test_sphere_capsule(a, {b.start, b.end, std::max(b.radius, more)}, alarm));
  RC_ASSERT(test_sphere_capsule(a, b, std::max(alarm, more)));
}

RC_GTEST_PROP(SphereCapsule, of_two_halves_of_a_segment_the_nearer_decides, ()) {
  const Query query = *drawn();
  const auto& [a, b] = shapes_in(query);
  const auto cut = exact_middle(b.start, b.end);
  RC_PRE(cut.has_value());
  const Expectation whole = computed(a, b, query.distances);
  const Expectation halves[] = {computed(a, {b.start, *cut, b.radius}, query.distances),
                                computed(a, {*cut, b.end, b.radius}, query.distances)};
  RC_ASSERT(whole.hit == (halves[0].hit || halves[1].hit));
  if (!whole.hit) return;
  const Expectation& nearer =
      !halves[1].hit || (halves[0].hit && halves[0].contact->value <= halves[1].contact->value) ? halves[0] : halves[1];
  RC_ASSERT(nearer.contact->value == whole.contact->value);
}

// What the properties were asked: shares of a sample with a fixed seed.
TEST(SphereCapsuleQuestions, hold_enough_of_every_kind) {
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
    counts["meeting"] += truth.degenerate() ? 1 : 0;
    if (b.start == b.end) {
      ++counts["without length"];
    } else {
      const Vector3 u = b.end - b.start;
      const double along = u.dot(a.center - b.start) / u.squaredNorm();
      ++counts[along <= 0 ? "beside the start" : along >= 1 ? "beside the end" : "beside the side"];
    }
  }
  const auto share = [&](const std::string& kind) {
    RecordProperty(kind, std::to_string(100.0 * counts[kind] / asked) + " %");
    return 100.0 * counts[kind] / asked;
  };
  EXPECT_GT(asked, kCount * 9 / 10);
  EXPECT_GT(share("hits"), 30);
  EXPECT_LT(share("hits"), 85);
  EXPECT_GT(share("exactly at the alarm distance"), 3);
  EXPECT_GT(share("meeting"), 3);
  EXPECT_GT(share("without length"), 3);
  EXPECT_GT(share("beside the start"), 10);
  EXPECT_GT(share("beside the end"), 10);
  EXPECT_GT(share("beside the side"), 10);
}

}  // namespace
}  // namespace contact
