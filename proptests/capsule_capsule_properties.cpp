// Production's functions for two capsules against both oracles, and what ties them to the other pairs.
#include "contact/capsule_capsule.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <Eigen/Geometry>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <string>

#include "contact/sphere_capsule.hpp"
#include "oracle/truth/interval_oracle.hpp"
#include "oracle/truth/truth.hpp"
#include "proptests/generators.hpp"

namespace contact {
namespace {

using namespace proptests;

rc::Gen<Query> drawn() { return queries(static_cast<const Capsules*>(nullptr), Range()); }

const Capsules& shapes_in(const Query& query) { return std::get<Capsules>(query.shapes); }

Expectation computed(const Capsule& a, const Capsule& b, Distances distances) {
  const auto contact = compute_capsule_capsule(a, b, distances);
  return {contact.has_value(), contact};
}

/// The answer for the shapes in the other order. Where they meet, the normal is the same for both orders, and the
/// points do not follow from it.
Expectation turned_round(Expectation answer) {
  if (!answer.contact || answer.contact->degenerate) return answer;
  answer.contact->normal *= -1;
  std::swap(answer.contact->point1, answer.contact->point2);
  return answer;
}

Expectation without_points(Expectation answer) {
  if (answer.contact && answer.contact->degenerate) answer.contact->point1 = answer.contact->point2 = Vector3::Zero();
  return answer;
}

RC_GTEST_PROP(CapsuleCapsule, production_equals_both_oracles, ()) {
  const Query query = *drawn();
  RC_ASSERT(!outside_domain(query));
  const auto& [a, b] = shapes_in(query);
  const Expectation contact = computed(a, b, query.distances);
  RC_ASSERT(test_capsule_capsule(a, b, query.distances.alarm) == contact.hit);
  RC_ASSERT(first_difference(contact, oracle::expectation(oracle::truth_of(query), Scalar::binary64)) == std::nullopt);
  RC_ASSERT(first_difference(contact, oracle::interval_answer(query, Scalar::binary64).expected) == std::nullopt);
}

RC_GTEST_PROP(CapsuleCapsule, a_capsule_without_length_is_a_sphere, ()) {
  Query query = *drawn();
  auto& [a, b] = std::get<Capsules>(query.shapes);
  a.end = a.start;
  const auto sphere = compute_sphere_capsule({a.start, a.radius}, b, query.distances);
  const Expectation expected{sphere.has_value(), sphere};
  RC_ASSERT(first_difference(computed(a, b, query.distances), expected) == std::nullopt);
  RC_ASSERT(first_difference(without_points(computed(b, a, query.distances)), without_points(turned_round(expected))) ==
            std::nullopt);
}

RC_GTEST_PROP(CapsuleCapsule, swapped_ends_change_nothing, ()) {
  const Query query = *drawn();
  const auto& [a, b] = shapes_in(query);
  const Expectation answer = computed(a, b, query.distances);
  const Capsule other_a{a.end, a.start, a.radius};
  const Capsule other_b{b.end, b.start, b.radius};
  RC_ASSERT(first_difference(answer, computed(other_a, b, query.distances)) == std::nullopt);
  RC_ASSERT(first_difference(answer, computed(a, other_b, query.distances)) == std::nullopt);
}

RC_GTEST_PROP(CapsuleCapsule, swapped_capsules_turn_the_answer_round, ()) {
  const Query query = *drawn();
  const auto& [a, b] = shapes_in(query);
  const Expectation back = computed(b, a, query.distances);
  RC_ASSERT(first_difference(without_points(turned_round(computed(a, b, query.distances))), without_points(back)) ==
            std::nullopt);
}

RC_GTEST_PROP(CapsuleCapsule, the_two_radii_count_alike_and_larger_ones_hit_as_well, ()) {
  const Query query = *drawn();
  const auto& [a, b] = shapes_in(query);
  const double alarm = query.distances.alarm;
  const double more = std::abs(*any_number(Range()));
  const bool hit = test_capsule_capsule(a, b, alarm);
  RC_ASSERT(test_capsule_capsule({a.start, a.end, b.radius}, {b.start, b.end, a.radius}, alarm) == hit);
  if (!hit) return;
  RC_ASSERT(test_capsule_capsule({a.start, a.end, std::max(a.radius, more)}, b, alarm));
  RC_ASSERT(test_capsule_capsule(a, {b.start, b.end, std::max(b.radius, more)}, alarm));
  RC_ASSERT(test_capsule_capsule(a, b, std::max(alarm, more)));
}

RC_GTEST_PROP(CapsuleCapsule, of_two_halves_of_a_segment_the_nearer_decides, ()) {
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
TEST(CapsuleCapsuleQuestions, hold_enough_of_every_kind) {
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
    const Vector3 u = a.end - a.start;
    const Vector3 v = b.end - b.start;
    const bool point = a.start == a.end || b.start == b.end;
    counts["without length"] += point ? 1 : 0;
    counts["parallel"] += !point && u.cross(v) == Vector3::Zero() ? 1 : 0;
    const auto contact = oracle::expectation(truth, Scalar::binary64).contact;
    counts["not unique"] += contact && !contact->unique ? 1 : 0;
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
  EXPECT_GT(share("parallel"), 5);
  EXPECT_GT(share("not unique"), 2);
}

}  // namespace
}  // namespace contact
