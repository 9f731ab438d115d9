// What the oracles and the judge say to callers who round elsewhere or flush subnormal numbers.
#include "oracle/truth/default_environment.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "environment/floating_point_environments.hpp"
#include "extreme_numbers.hpp"
#include "oracle/diagnosis/diagnosis.hpp"
#include "oracle/judge/right_claim.hpp"
#include "oracle/truth/exact_truth.hpp"
#include "oracle/truth/quick_witness.hpp"
#include "oracle/truth/staged_oracle.hpp"

namespace contact::oracle::default_environment_test {
namespace {

/// Everything that was said, as text and bits: numbers are compared outside, since == itself obeys the environment.
class Said {
 public:
  void operator()(const std::string& text) { all_ += text + "\n"; }
  void operator()(double x) { (*this)(std::to_string(std::bit_cast<std::uint64_t>(x))); }
  void operator()(const Vector3& v) {
    for (int axis = 0; axis < 3; ++axis) (*this)(v[axis]);
  }
  void operator()(const Expectation& expected) {
    (*this)(expected.hit ? "hit" : "no hit");
    if (!expected.contact) return;
    (*this)(expected.contact->degenerate ? "degenerate" : "has a normal");
    (*this)(expected.contact->normal);
    (*this)(expected.contact->point1);
    (*this)(expected.contact->point2);
    (*this)(expected.contact->value);
  }
  void operator()(const RoundedAnswer& answer) {
    (*this)(std::to_string(answer.at_alarm) + std::to_string(answer.at_zero));
    (*this)(answer.expected);
  }
  void operator()(const Witness& w) {
    (*this)(w.distance2 + " " + w.reach + " " + w.gap[0] + " " + w.gap[1] + " " + w.gap[2]);
    (*this)(w.margin_ulps);
  }
  void operator()(const Verdict& verdict) {
    (*this)(std::string(name(verdict.level())));
    for (const auto& field : verdict.fields) {
      if (!field) continue;
      (*this)(std::string(name(field->grade)));
      (*this)(field->error);
    }
  }
  [[nodiscard]] const std::string& text() const { return all_; }

 private:
  std::string all_;
};

/// A claim that is near the right one: its normal an ulp or two off, its value a subnormal number or nothing.
Claim near_claim(const Query& query) {
  Claim claim = right_claim(query, truth_of(query), {});
  if (!claim.contact) return claim;
  claim.contact->normal = Vector3(claim.contact->normal->array() * (1 + 0x1p-52));
  claim.contact->value = *claim.contact->value + kLeast;
  return claim;
}

Said everything(const Query& query, const Claim& near) {
  Said said;
  const Truth truth = truth_of(query);
  Diagnosis diagnosis;
  for (const Scalar scalar : kScalars) {
    said(rounded_answer(truth, scalar));
    said(witness(truth, scalar));
    for (const auto& [field, ulps, log2] : rounding_distances(truth, scalar))
      said(std::string(field) + " " + exact_string(Rational(ulps.numerator())) + " " + std::to_string(log2));
    const StagedAnswer staged = staged_answer(query, scalar);
    said(std::string(kStageNames[static_cast<std::size_t>(staged.stage)]));
    said(rounded_answer(staged));
    said(staged.margin.low);
    said(staged.margin.high);
    said(interval_answer(query, scalar));
    if (const auto quick = double_double_answer(query, scalar)) said(*quick);
    Declaration declared;
    declared.scalar = scalar;
    const Verdict verdict = judge(query, truth, near, declared);
    said(verdict);
    diagnosis.add(1, query, truth, near, declared, verdict);
    for (const auto& [field, convention, value] : explain_wrong(query, truth, near, declared, verdict))
      said(field + " " + convention + " " + value);
    for (const Touching touching : {Touching::closed, Touching::open})
      for (const Margin margin : {Margin::inclusive, Margin::none})
        said(expected_hit(query, truth, touching, margin) ? "hit" : "no hit");
    for (const double x : {near.contact && near.contact->value ? *near.contact->value : 0.0, kLeast, -kLeast}) {
      said(next_up(x, scalar));
      said(next_down(x, scalar));
    }
  }
  for (const Finding& finding : diagnosis.findings()) said(finding.sentence);
  if (const auto quick = quick_witness(query)) said(*quick);
  if (const auto claim = right_claim(query, truth, {}); claim.contact) said(*claim.contact->normal);
  return said;
}

TEST(DefaultEnvironment, oracles_and_judge_say_the_same_in_every_environment) {
  const auto spheres = [](const Ball& a, const Ball& b, double alarm, double contact) {
    return Query{Pair::sphere_sphere, Balls{a, b}, {alarm, contact}};
  };
  const std::vector<Query> queries{
      spheres({{0.1, -0.7, 0.3}, 1.1}, {{1.3, 0.2, 0.9}, 0.7}, 0.1, 0.05),
      spheres({{0, 0, 0}, 1.5}, {{1, 2, 2}, 1.5}, 0, 0.25),
      spheres({{kLeast, 0, 0}, kLeast}, {{0, 3 * kLeast, 0}, 5 * kLeast}, 0, kLeast),
      spheres({{kLeast, 0, 0}, 1}, {{0, 0, 0}, 2}, kLeast, 0),
      spheres({{1, 1, 1}, 2}, {{1, 1, 1}, 3}, 0, 0),
      spheres({{0, 0, 0}, kLargest}, {{kLargest, kLargest, 0}, kLargest}, 0, kLargest),
      spheres({{0, 0, 0}, 0x1p1000}, {{0x1p1000, 0x1p-1000, 0}, 0}, 0, 0),
      {Pair::cube_cube, Boxes{{{0, 0, 0}, {0.1, 1, 1}}, {{0.3, 0, 0}, {1, 1, 1}}}, {0.2, 0}},
      {Pair::cube_cube, Boxes{{{0, 0, 0}, {kLeast, 1, 1}}, {{2 * kLeast, 0, 0}, {1, 1, 1}}}, {kLeast, 0}},
      {Pair::cube_cube, Boxes{{{-kLargest, 0, 0}, {-kLargest, 1, 1}}, {{kLargest, 0, 0}, {kLargest, 1, 1}}}, {0, 0}}};
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const Claim near = near_claim(queries[i]);
    const Said expected = everything(queries[i], near);
    for (const FloatingPointEnvironment& environment : floating_point_environments()) {
      Said said;
      bool as_it_was = false;
      in_environment(environment, [&] {
        said = everything(queries[i], near);
        as_it_was = DefaultEnvironment::is_default() ==
                        (environment.rounding == FE_TONEAREST && !environment.flush && !environment.traps) &&
                    std::fegetround() == environment.rounding;
      });
      EXPECT_EQ(said.text(), expected.text()) << "question " << i << ", " << environment.name;
      EXPECT_TRUE(as_it_was) << "question " << i << ", " << environment.name;
    }
  }
}

}  // namespace
}  // namespace contact::oracle::default_environment_test
