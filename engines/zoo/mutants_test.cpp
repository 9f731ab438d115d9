// Mutants: the list is well formed, and each answers what the mistake that it is listed under says. That each is
// refuted is for tool/run/adequacy_test.cpp, that its diagnosis is found among all others for
// tool/run/mutants_test.cpp.
#include "engines/zoo/mutants.hpp"
#include "engines/zoo/mutating.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "engines/engine.hpp"
#include "golden/families.hpp"
#include "oracle/diagnosis/diagnosis.hpp"
#include "oracle/judge/judge.hpp"
#include "oracle/truth/exact_truth.hpp"

namespace contact::engines {
namespace {

using oracle::Numbers;
using oracle::Real;
using oracle::Said;

TEST(Mutants, ids_are_unique_and_real_ones_have_their_source) {
  std::set<std::string_view> ids;
  for (const Mutant& m : mutants()) {
    EXPECT_TRUE(ids.insert(m.id).second) << m.id;
    EXPECT_NO_THROW(static_cast<void>(oracle::sentence_of(m.cause))) << m.id;
    EXPECT_EQ(m.source.empty(), m.origin != Origin::real) << m.id;
  }
  EXPECT_GE(ids.size(), 150U);
}

struct Question {
  Query query;
  oracle::Truth truth;
  Expectation right;
};

/// The first questions of every generator, but where squares or sums leave the range: mutants and formulas lose other
/// things there.
const std::vector<Question>& questions() {
  static const std::vector<Question> all = [] {
    std::vector<Question> made;
    for (const Pair pair : kPairs) {
      for (const golden::Family& family : golden::families_of(pair))
        for (std::uint64_t i = 0;
             i < (is_convex(pair) ? 4U : 36U) && !family.outside_domain && family.name != "extreme_scale"; ++i) {
          const Query query = golden::generate_query(pair, family, Scalar::binary64, golden::kCommittedSeed, i);
          oracle::Truth truth = oracle::truth_of(query);
          const Expectation right = oracle::expectation(truth, Scalar::binary64);
          made.push_back({query, std::move(truth), right});
        }
    }
    return made;
  }();
  return all;
}

// With CONTACT_EVERY_MUTANT set, as ./run campaign does, every mutant, and of each family as many questions as are committed.
const bool kEvery = std::getenv("CONTACT_EVERY_MUTANT") != nullptr;

TEST(Mutants, that_always_answer_alike_are_right_in_everything_else) {
  const std::uint64_t committed = kEvery ? golden::kCommittedCount : 42;
  const auto declared = make_mutant(kAlwaysHit)->info().declared;
  const auto find = [](std::string_view id) {
    return *std::find_if(mutants().begin(), mutants().end(), [&](const Mutant& m) { return m.id == id; });
  };
  const Mutant hit = find(kAlwaysHit);
  const Mutant miss = find(kAlwaysMiss);
  for (const Pair pair : kPairs)
    for (const golden::Family& family : golden::families_of(pair))
      // A crossing or a cast cannot be presumed: there is no point.
      for (std::uint64_t i = 0;
           i < (is_convex(pair) ? 20 : committed) && !family.outside_domain && !is_crossing(pair) && !is_cast(pair);
           ++i) {
        const Query query = golden::generate_query(pair, family, Scalar::binary64, golden::kCommittedSeed, i);
        for (const auto& [mutant, sign] : {std::pair(hit, oracle::Side::within), {miss, oracle::Side::beyond}}) {
          const Claim claim = answer_of(mutant, query);
          ASSERT_TRUE(claim.overlap && claim.speaks_of_contact == query.has_numbers()) << family.name << i;
          // Were it true that the shapes are near, or far apart, nothing of the answer would be wrong.
          const auto verdict = oracle::judge(query, oracle::truth_with(query, sign, sign), claim, declared);
          ASSERT_EQ(verdict.level(), oracle::Level::correctly_rounded) << mutant.id << " " << family.name << i;
        }
      }
}

Numbers numbers_of(const Vector3& v) { return {v[0], v[1], v[2]}; }

/// Within a millionth of the largest component, or what a vague formula allows.
bool is_near(const Numbers& x, const Numbers& y, Real tolerance = 0) {
  for (const Numbers* v : {&x, &y})
    for (const Real z : *v)
      if (std::isfinite(z)) tolerance = std::max(tolerance, 1e-6L * std::abs(z));
  for (std::size_t i = 0; i < 3; ++i)
    if (std::isnan(x[i]) ? std::isfinite(y[i]) : !(x[i] == y[i] || std::abs(x[i] - y[i]) <= tolerance)) return false;
  return true;
}

struct Count {
  int wrong = 0;
  int explained = 0;
};

/// What a mutant says that is wrong beyond all rounding, and how much of it the formula of its cause gives.
Count explained_by_cause(const Mutant& mutant) {
  const oracle::Cause& cause = oracle::causes()[oracle::cause_index(mutant.cause)];
  const bool is_of_convexes =
      std::any_of(convex_mutants().begin(), convex_mutants().end(), [&](const Mutant& m) { return m.id == mutant.id; });
  Count count;
  for (const Question& q : questions()) {
    // Where cores overlap, a mistake about a direction meets no distance: mutants and causes of such pairs are about that.
    if (!is_of_convexes && is_convex(q.query.pair) && q.truth.distance()->overlaps()) continue;
    const Claim claim = answer_of(mutant, q.query);
    if (claim.status != Claim::Status::answered) continue;
    std::optional<Numbers> normal;
    if (claim.contact && claim.contact->normal) normal = numbers_of(*claim.contact->normal);
    const auto said = oracle::predict(cause, oracle::Facts(q.query, q.truth, Scalar::binary64, normal));
    const auto look = [&](const Said& predicted, const Numbers& claimed, const Numbers& right) {
      if (is_near(right, claimed)) return;
      ++count.wrong;
      count.explained +=
          predicted.kind == Said::Kind::anything ||
          (predicted.kind == Said::Kind::numbers && is_near(predicted.numbers, claimed, predicted.tolerance));
    };
    const auto decision = [](bool yes) { return Numbers{yes ? Real{1} : Real{0}, 0, 0}; };
    if (claim.overlap) look(said.hit, decision(*claim.overlap), decision(q.right.hit));
    if (claim.speaks_of_contact) look(said.hit, decision(claim.contact.has_value()), decision(q.right.hit));
    if (!claim.contact || !q.right.contact) continue;
    if (normal) look(said.normal, *normal, numbers_of(q.right.contact->normal));
    const bool points = cause.point || cause.edit;
    if (points && claim.contact->point1)
      look(said.point[0], numbers_of(*claim.contact->point1), numbers_of(q.right.contact->point1));
    if (points && claim.contact->point2)
      look(said.point[1], numbers_of(*claim.contact->point2), numbers_of(q.right.contact->point2));
    if (claim.contact->value) look(said.value, {*claim.contact->value, 0, 0}, {q.right.contact->value, 0, 0});
  }
  return count;
}

/// Mutants of which the formula explains less than three quarters, and why.
const std::map<std::string_view, std::string_view> kOtherwise{
    {"cute-same-arg-twice", "a sphere has no direction to itself: the mutant takes one, the formula none"},
    {"first-sphere-twice", "the same"},
    {"tornago-inside-box-nan", "shows in the middle of a box, which no question of so few is about"},
    {"coal-box-sphere-inside", "its other mistake, a value without the depth, has a cause of its own"},
    {"delta-x-twice",
     "its points start from the centres that it was given; the formula changes their difference alone"},
    {"float-answer", "wrong by less than a millionth, but for what single precision flushes to zero"},
    {"float-value", "the same"},
    {"float-points", "the same"},
    {"rsqrt-23", "wrong by less than a millionth, but infinite where squares leave single precision"},
    {"brax-normal-plus-1e-6",
     "of planes and crossings the mutant divides a difference that the right normal does not come from"},
    {"normal-square-plus-1e-12", "the same"},
    {"libigl-norm-underflow", "shows where squares underflow"},
    {"mjx-segment-1e-6",
     "of a centre on the axis it makes a direction, of which a formula says nothing where any is right"},
    {"mjx-capsule-capsule", "of parallel axes several points are as near, and its roundings choose among them"},
    {"newton-capsule-capsule", "computes in single precision, which nearly parallel axes make wrong as well"},
    {"crossing-of-parallelogram", "tells other points of its boundary from those inside, to a rounding"},
    {"capsule-start-only", "of rays that are cast and convex shapes, which they change too, the formula says nothing"},
    {"cyclone-capsule-radius", "the same"},
    {"stride-caps-in-length", "the same"},
    {"capsule-middle-only", "the same"},
    {"capsule-half-length", "the same"},
    {"simple-collider-caps-added", "the same"},
    {"fcl-capsule-origin", "the same"},
    {"byro-capsule-midpoint", "the same"},
    {"plane-not-divided", "the same"},
    {"capsule-ends-only", "the same"},
    {"plane-offset-not-divided", "the same"},
    {"plane-offset-sign", "the same"},
    {"plane-through-origin", "the same"},
    {"box-difference", "wrong in the last bit"},
    {"cast-without-length", "where a ray ends or grazes exactly, roundings decide as well"},
    {"cast-length-as-distance", "the same"},
    {"box-sum-overflows", "shows where sums overflow"},
};

// Every forty-eighth by day: of all of them it takes a minute.
TEST(Mutants, the_formula_of_its_cause_gives_what_a_mutant_says) {
  const std::size_t step = kEvery ? 1 : 48;
  for (std::size_t i = 0; i < mutants().size(); i += step) {
    const Mutant& m = mutants()[i];
    if (m.outside_domain || m.cause == "no-answer") continue;
    const Count count = explained_by_cause(m);
    EXPECT_EQ(4 * count.explained >= 3 * count.wrong && count.wrong > 0, !kOtherwise.contains(m.id))
        << m.id << ": " << m.cause << " explains " << count.explained << " of " << count.wrong;
  }
}

}  // namespace
}  // namespace contact::engines
