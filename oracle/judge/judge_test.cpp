// The judge, convention by convention and level by level. Every expectation follows from docs/specification.md#judging.
#include "oracle/diagnosis/diagnosis.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "extreme_numbers.hpp"
#include "oracle/judge/right_claim.hpp"

namespace contact::oracle::judge_test {
namespace {

Query spheres(const Ball& a, const Ball& b, double alarm = 0, double contact = 0, Pair pair = Pair::sphere_sphere) {
  return {pair, Balls{a, b}, {alarm, contact}};
}

// distance 5 along (0.6, 0.8, 0); radii 2 and 3: touching
Query touching(double alarm = 0, double contact = 0) { return spheres({{0, 0, 0}, 2}, {{3, 4, 0}, 3}, alarm, contact); }
// distance 4 along x; radii 2 and 3: depth 1; n (1,0,0), points (2,0,0) and (1,0,0), all exact
Query overlapping(double contact = 0, Pair pair = Pair::sphere_sphere) {
  return spheres({{0, 0, 0}, 2}, {{4, 0, 0}, 3}, 0, contact, pair);
}
// distance 8 along x; radii 2 and 3: 3 apart
Query apart(double alarm) { return spheres({{0, 0, 0}, 2}, {{8, 0, 0}, 3}, alarm); }
Query coincident() { return spheres({{7, 0, 0}, 2}, {{7, 0, 0}, 3}); }

Claim overlap(bool claimed) {
  Claim claim;
  claim.overlap = claimed;
  return claim;
}
Claim no_contact() {
  Claim claim;
  claim.speaks_of_contact = true;
  return claim;
}
Claim contact_of(ContactClaim contact) {
  Claim claim = no_contact();
  claim.contact = std::move(contact);
  return claim;
}
Claim normal_of(const Vector3& n) {
  return contact_of({.normal = n, .point1 = {}, .point2 = {}, .point = {}, .value = {}});
}
Claim points_of(const Vector3& p1, const Vector3& p2) {
  return contact_of({.normal = {}, .point1 = p1, .point2 = p2, .point = {}, .value = {}});
}
Claim contact_with(const Vector3& n, const Vector3& p1) {
  return contact_of({.normal = n, .point1 = p1, .point2 = {}, .point = {}, .value = {}});
}
Claim contact_with(const Vector3& n, const Vector3& p1, const Vector3& p2, std::optional<double> value = {}) {
  return contact_of({.normal = n, .point1 = p1, .point2 = p2, .point = {}, .value = value});
}
Claim normal_and_midpoint(const Vector3& n, const Vector3& p) {
  return contact_of({.normal = n, .point1 = {}, .point2 = {}, .point = p, .value = {}});
}
Claim midpoint_of(const Vector3& p) {
  return contact_of({.normal = {}, .point1 = {}, .point2 = {}, .point = p, .value = {}});
}
Claim value_of(double value) {
  return contact_of({.normal = {}, .point1 = {}, .point2 = {}, .point = {}, .value = value});
}

/// The engine declares what it claims and no more: a field that is left out is what the tests of JudgeClaims are about.
Declaration of_these(const Claim& claim, Declaration declared) {
  declared.claims = claim.says();
  return declared;
}
Verdict judged(const Query& query, const Claim& claim, const Declaration& declared = {}) {
  const Truth truth = truth_of(query);
  const Declaration asked = of_these(claim, declared);
  const Verdict verdict = judge(query, truth, claim, asked);
  // The same where the rounded answer is known already, but for points of a normal that is then known to be the
  // reference's.
  const Expectation rounded = expectation(truth, asked.scalar);
  const Verdict sooner = judge(query, truth, claim, asked, &rounded);
  EXPECT_EQ(sooner.contact, verdict.contact);
  for (const Field field : {Field::normal, Field::value}) EXPECT_TRUE(sooner.at(field) == verdict.at(field));
  return verdict;
}
Level level_of(const Query& query, const Claim& claim, const Declaration& declared = {}) {
  return judged(query, claim, declared).level();
}
template <class Change>
Declaration with(Change change) {
  Declaration declared;
  change(declared.conventions);
  return declared;
}
Declaration with_points(Points points) {
  return with([&](Conventions& c) { c.points = points; });
}

std::vector<Explanation> explained(const Query& query, const Claim& claim, const Declaration& declared = {}) {
  const Truth truth = truth_of(query);
  return explain_wrong(query, truth, claim, of_these(claim, declared), judged(query, claim, declared));
}
bool says(const std::vector<Explanation>& found, const std::string& field, const std::string& convention,
          const std::string& value) {
  return std::find(found.begin(), found.end(), Explanation{field, convention, value}) != found.end();
}

// Claims.

Claim whole_answer(const Query& query) { return right_claim(query, truth_of(query), Declaration{}); }
Verdict as_declared(const Query& query, const Claim& claim, const Declaration& declared = {}) {
  return judge(query, truth_of(query), claim, declared);
}
Declaration claiming(std::initializer_list<Aspect> aspects) {
  Declaration declared;
  declared.claims = aspects;
  return declared;
}

TEST(JudgeClaims, without_a_declaration_an_answer_to_a_hit_has_all_that_the_conventions_speak_of) {
  const Claim whole = whole_answer(overlapping());
  EXPECT_TRUE(as_declared(overlapping(), whole).missing.empty());
  EXPECT_EQ(as_declared(overlapping(), whole).level(), Level::correctly_rounded);
  for (const Aspect left_out : {Aspect::overlap, Aspect::normal, Aspect::point1, Aspect::point2, Aspect::value}) {
    Claim claim = whole;
    claim.keep(whole.says().without({left_out}));
    const Verdict verdict = as_declared(overlapping(), claim);
    EXPECT_EQ(verdict.missing, Aspects{left_out});
    EXPECT_EQ(verdict.level(), Level::none);
  }
}

TEST(JudgeClaims, an_empty_contact_lacks_every_number_and_no_contact_key_lacks_the_contact) {
  Claim silent = contact_of({});
  silent.overlap = true;
  EXPECT_EQ(as_declared(overlapping(), silent).missing,
            (Aspects{Aspect::normal, Aspect::point1, Aspect::point2, Aspect::value}));
  EXPECT_EQ(as_declared(overlapping(), overlap(true)).missing, Aspects{Aspect::contact});
}

TEST(JudgeClaims, a_miss_a_missed_hit_and_a_contact_that_should_not_be_lack_no_number) {
  EXPECT_TRUE(as_declared(apart(1), overlap(false)).missing.empty());
  EXPECT_TRUE(as_declared(apart(1), no_contact()).missing.empty());
  EXPECT_EQ(as_declared(overlapping(), no_contact()).missing, Aspects{Aspect::overlap});
  Claim phantom = contact_of({});
  phantom.overlap = false;
  EXPECT_TRUE(as_declared(apart(1), phantom).missing.empty());
}

TEST(JudgeClaims, what_is_not_declared_is_neither_missing_nor_judged) {
  Claim claim = whole_answer(overlapping());
  claim.contact->normal = Vector3(0, 1, 0);
  claim.contact->point1.reset();
  const Declaration declared = claiming({Aspect::overlap, Aspect::contact, Aspect::value});
  const Verdict verdict = as_declared(overlapping(), claim, declared);
  EXPECT_TRUE(verdict.missing.empty());
  EXPECT_FALSE(verdict.at(Field::normal));
  EXPECT_FALSE(verdict.at(Field::point2));
  EXPECT_TRUE(verdict.at(Field::value));
  EXPECT_EQ(verdict.level(), Level::correctly_rounded);
  claim.overlap = false;
  EXPECT_EQ(as_declared(overlapping(), claim, claiming({Aspect::contact})).overlap, Decision::unclaimed);
  EXPECT_EQ(as_declared(overlapping(), claim, declared).overlap, Decision::missed_hit);
}

TEST(JudgeClaims, an_answer_of_nothing_that_is_declared_is_an_error) {
  EXPECT_EQ(as_declared(overlapping(), overlap(true), claiming({Aspect::contact})).status, Claim::Status::error);
  EXPECT_EQ(as_declared(overlapping(), Claim{}).status, Claim::Status::error);
}

TEST(JudgeClaims, of_the_points_those_that_the_convention_names_are_asked) {
  const auto missing = [](Points points) {
    Claim claim = contact_of({.normal = Vector3(1, 0, 0), .point1 = {}, .point2 = {}, .point = {}, .value = -1});
    claim.overlap = true;
    return as_declared(overlapping(), claim, with_points(points)).missing;
  };
  EXPECT_EQ(missing(Points::nearest_surface), (Aspects{Aspect::point1, Aspect::point2}));
  EXPECT_EQ(missing(Points::center), (Aspects{Aspect::point1, Aspect::point2}));
  EXPECT_EQ(missing(Points::published), (Aspects{Aspect::point1, Aspect::point2}));
  EXPECT_EQ(missing(Points::midpoint), Aspects{Aspect::point});
  EXPECT_EQ(missing(Points::first_only), Aspects{Aspect::point1});
  EXPECT_EQ(missing(Points::second_only), Aspects{Aspect::point2});
  EXPECT_TRUE(missing(Points::none).empty());
}

TEST(JudgeClaims, an_answer_about_boxes_is_one_decision_unless_overlap_is_listed) {
  const Query boxes{Pair::cube_cube, Boxes{{{0, 0, 0}, {1, 1, 1}}, {{1, 0, 0}, {2, 1, 1}}}, {0, 0}};
  EXPECT_TRUE(as_declared(boxes, overlap(true)).missing.empty());
  EXPECT_TRUE(as_declared(boxes, contact_of({})).missing.empty());
  EXPECT_EQ(as_declared(boxes, contact_of({}), claiming({Aspect::overlap, Aspect::contact})).missing,
            Aspects{Aspect::overlap});
  EXPECT_FALSE(as_declared(boxes, overlap(true)).has_numbers);
}

TEST(JudgeClaims, the_verdict_keeps_what_a_right_answer_says) {
  const Verdict hit = as_declared(touching(), whole_answer(touching()));
  EXPECT_EQ(hit.overlap_expected, true);
  EXPECT_EQ(hit.contact_expected, true);
  EXPECT_TRUE(hit.has_numbers);
  const Verdict miss = as_declared(apart(1), overlap(true));
  EXPECT_EQ(miss.overlap_expected, false);
  EXPECT_FALSE(miss.contact_expected);
  EXPECT_FALSE(miss.has_numbers);
  const Declaration open = with([](Conventions& c) { c.touching_contact = Touching::open; });
  EXPECT_EQ(as_declared(touching(), whole_answer(touching()), open).contact_expected, false);
}

TEST(JudgeClaims, a_convention_that_explains_what_is_missing_is_named) {
  const auto why = [](const Claim& claim) {
    const Truth truth = truth_of(overlapping());
    return explain_wrong(overlapping(), truth, claim, {}, as_declared(overlapping(), claim));
  };
  Claim claim = whole_answer(overlapping());
  claim.contact->point = Vector3(1.5, 0, 0);
  claim.contact->point1.reset();
  claim.contact->point2.reset();
  EXPECT_TRUE(says(why(claim), "point1", "points", "midpoint"));
  claim.contact->point = Vector3(3, 0, 0);
  EXPECT_FALSE(says(why(claim), "point1", "points", "midpoint"));
  claim.contact->point.reset();
  EXPECT_TRUE(says(why(claim), "point2", "points", "none"));
  claim.contact->point1 = Vector3(2, 0, 0);
  const auto first = why(claim);
  EXPECT_TRUE(says(first, "point2", "points", "first_only"));
  EXPECT_FALSE(says(first, "point2", "points", "none"));
  claim.contact->value.reset();
  EXPECT_TRUE(says(why(claim), "value", "value", "none"));
  // Where no contact was due, none of its fields were: but then the contact itself would be wrong.
  const Truth truth = truth_of(coincident());
  Claim silent = contact_of({});
  silent.overlap = true;
  for (const auto& e : explain_wrong(coincident(), truth, silent, {}, as_declared(coincident(), silent)))
    EXPECT_NE(e.convention, "coincident") << e.field;
}

// Decisions.

TEST(JudgeDecisions, a_right_overlap_is_right_and_a_wrong_one_is_a_missed_or_a_false_hit) {
  EXPECT_EQ(judged(overlapping(), overlap(true)).overlap, Decision::right);
  EXPECT_EQ(judged(overlapping(), overlap(false)).overlap, Decision::missed_hit);
  EXPECT_EQ(judged(apart(1), overlap(false)).overlap, Decision::right);
  EXPECT_EQ(judged(apart(1), overlap(true)).overlap, Decision::false_hit);
}

TEST(JudgeDecisions, overlap_and_contact_are_two_claims) {
  Claim claim = no_contact();
  claim.overlap = true;
  const Verdict verdict = judged(overlapping(), claim);
  EXPECT_EQ(verdict.overlap, Decision::right);
  EXPECT_EQ(verdict.contact, Decision::missed_hit);
  EXPECT_TRUE(verdict.missed_hit());
  EXPECT_FALSE(verdict.false_hit());
  EXPECT_EQ(judged(overlapping(), overlap(true)).contact, Decision::unclaimed);
  EXPECT_EQ(judged(overlapping(), no_contact()).overlap, Decision::unclaimed);
  EXPECT_EQ(judged(apart(1), value_of(3)).contact, Decision::false_hit);
  EXPECT_EQ(judged(apart(1), no_contact()).contact, Decision::right);
}

TEST(JudgeDecisions, the_fields_of_a_false_hit_are_not_judged) {
  EXPECT_FALSE(judged(apart(1), value_of(kNaN)).at(Field::value));
}

TEST(JudgeDecisions, touching_is_a_hit_unless_it_is_declared_open_for_that_claim) {
  EXPECT_EQ(judged(touching(), overlap(true)).overlap, Decision::right);
  EXPECT_EQ(judged(touching(), overlap(false)).overlap, Decision::missed_hit);
  const Declaration open_overlap = with([](Conventions& c) { c.touching_overlap = Touching::open; });
  EXPECT_EQ(judged(touching(), overlap(false), open_overlap).overlap, Decision::right);
  EXPECT_EQ(judged(touching(), overlap(true), open_overlap).overlap, Decision::false_hit);
  EXPECT_EQ(judged(touching(), no_contact(), open_overlap).contact, Decision::missed_hit);  // the other claim
  const Declaration open_contact = with([](Conventions& c) { c.touching_contact = Touching::open; });
  EXPECT_EQ(judged(touching(), no_contact(), open_contact).contact, Decision::right);
  EXPECT_EQ(judged(touching(), value_of(0), open_contact).contact, Decision::false_hit);
  EXPECT_EQ(judged(touching(), overlap(false), open_contact).overlap, Decision::missed_hit);
  // open or closed is about equality alone
  EXPECT_EQ(judged(overlapping(), overlap(true), open_overlap).overlap, Decision::right);
}

TEST(JudgeDecisions, equality_at_an_alarm_distance_follows_the_margin_and_not_touching) {
  EXPECT_EQ(judged(apart(3), overlap(true)).overlap, Decision::right);
  EXPECT_EQ(judged(apart(below(3)), overlap(false)).overlap, Decision::right);
  const Declaration exclusive = with([](Conventions& c) { c.margin = Margin::exclusive; });
  EXPECT_EQ(judged(apart(3), overlap(false), exclusive).overlap, Decision::right);
  EXPECT_EQ(judged(apart(3), overlap(true), exclusive).overlap, Decision::false_hit);
  EXPECT_EQ(judged(apart(3), no_contact(), exclusive).contact, Decision::right);
  EXPECT_EQ(judged(apart(above(3)), overlap(true), exclusive).overlap, Decision::right);
  EXPECT_EQ(judged(touching(), overlap(true), exclusive).overlap, Decision::right);  // alarm 0: touching decides
  const Declaration open = with([](Conventions& c) { c.touching_overlap = c.touching_contact = Touching::open; });
  EXPECT_EQ(judged(apart(3), overlap(true), open).overlap, Decision::right);
}

TEST(JudgeDecisions, without_a_margin_both_claims_are_judged_at_alarm_0) {
  const Declaration none = with([](Conventions& c) { c.margin = Margin::none; });
  EXPECT_EQ(judged(apart(3), overlap(false), none).overlap, Decision::right);
  EXPECT_EQ(judged(apart(100), no_contact(), none).contact, Decision::right);
  EXPECT_EQ(judged(apart(100), overlap(true), none).overlap, Decision::false_hit);
  EXPECT_EQ(judged(touching(9), overlap(true), none).overlap, Decision::right);
  EXPECT_EQ(judged(touching(9), overlap(false), none).overlap, Decision::missed_hit);
  const Declaration open = with([](Conventions& c) {
    c.margin = Margin::none;
    c.touching_overlap = Touching::open;
  });
  EXPECT_EQ(judged(touching(9), overlap(false), open).overlap, Decision::right);
}

TEST(JudgeDecisions, cubes_are_judged_by_the_same_rules) {
  const auto boxes = [](double gap, double alarm) {
    return Query{Pair::cube_cube, Boxes{{{0, 0, 0}, {1, 1, 1}}, {{1 + gap, 0, 0}, {4, 1, 1}}}, {alarm, 0}};
  };
  EXPECT_EQ(judged(boxes(0, 0), overlap(true)).overlap, Decision::right);
  EXPECT_EQ(judged(boxes(0, 0), overlap(false)).overlap, Decision::missed_hit);
  EXPECT_EQ(judged(boxes(1, 1), overlap(true)).overlap, Decision::right);
  EXPECT_EQ(judged(boxes(1, 0.5), overlap(true)).overlap, Decision::false_hit);
  const Declaration open = with([](Conventions& c) { c.touching_overlap = Touching::open; });
  EXPECT_EQ(judged(boxes(0, 0), overlap(false), open).overlap, Decision::right);
  const Declaration exclusive = with([](Conventions& c) { c.margin = Margin::exclusive; });
  EXPECT_EQ(judged(boxes(1, 1), overlap(false), exclusive).overlap, Decision::right);
}

// Levels.

TEST(Served, a_box_by_center_and_size_is_one_whose_center_size_and_half_size_are_numbers) {
  const auto served = [](double low, double high, Scalar scalar, ShapesAs shapes = ShapesAs::centered) {
    Declaration declared = with([&](Conventions& c) { c.shapes = shapes; });
    declared.scalar = scalar;
    const Query query{Pair::sphere_cube, BallAndBox{{{0, 0, 0}, 1}, {{0, low, 0}, {2, high, 2}}}, {0, 0}};
    return !not_served(query, declared);
  };
  const double tiny = std::numeric_limits<double>::denorm_min();
  const double huge = std::numeric_limits<double>::max();
  using enum Scalar;
  EXPECT_TRUE(served(-0.1, 0.1, binary64));
  EXPECT_FALSE(served(-0.1, 0.3, binary64));
  EXPECT_TRUE(served(-0.1, 0.3, binary64, ShapesAs::given));
  EXPECT_TRUE(served(1, 0x1.000001p0, binary64));
  EXPECT_FALSE(served(1, 0x1.000002p0, binary32)) << "the middle of two neighbours";
  EXPECT_TRUE(served(1, 0x1.000004p0, binary32));
  EXPECT_FALSE(served(0, tiny, binary64)) << "half the smallest number";
  EXPECT_TRUE(served(0, 2 * tiny, binary64));
  EXPECT_TRUE(served(tiny, tiny, binary64)) << "a size of 0";
  EXPECT_FALSE(served(-huge, huge, binary64)) << "a size beyond the largest number, though its half is one";
  EXPECT_TRUE(served(-huge / 2, huge / 2, binary64));
  EXPECT_TRUE(served(huge, huge, binary64));
  EXPECT_TRUE(served(-std::numeric_limits<double>::infinity(), 0.3, binary64)) << "outside the domain it is asked";
}

TEST(Served, a_capsule_by_center_and_size_lies_along_an_axis) {
  Declaration declared = with([](Conventions& c) { c.shapes = ShapesAs::centered; });
  const auto served = [&](const Vector3& start, const Vector3& end) {
    return !not_served({Pair::sphere_capsule, BallAndCapsule{{{0, 0, 0}, 1}, {start, end, 1}}, {0, 0}}, declared);
  };
  EXPECT_TRUE(served({1, 2, 3}, {1, 2, 8}));
  EXPECT_TRUE(served({1, 2, 8}, {1, 2, 3})) << "whichever end comes first";
  EXPECT_TRUE(served({0.1, 0.2, 0.3}, {0.1, 0.2, 0.3})) << "a point";
  EXPECT_FALSE(served({1, 2, 3}, {1, 3, 4}));
  EXPECT_FALSE(served({1, -0.1, 3}, {1, 0.3, 3}));
  declared.conventions.shapes = ShapesAs::given;
  EXPECT_TRUE(served({1, 2, 3}, {1, 3, 4}));
}

TEST(Served, a_plane_by_a_unit_normal_lies_across_an_axis_and_a_ray_by_its_ends_has_them) {
  Declaration declared = with([](Conventions& c) { c.shapes = ShapesAs::centered; });
  const auto plane = [&](const Vector3& normal, double offset) {
    return !not_served({Pair::sphere_plane, BallAndPlane{{{0, 0, 0}, 1}, {normal, offset}}, {0, 0}}, declared);
  };
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(plane({0, -1, 0}, 0.1));
  EXPECT_TRUE(plane({0, 0, 3}, 6));
  EXPECT_FALSE(plane({0, 0, 3}, 1)) << "a third from the origin";
  EXPECT_FALSE(plane({0.6, 0.8, 0}, 1));
  EXPECT_FALSE(plane({0, 0, 0}, 1));
  EXPECT_TRUE(plane({infinity, 1, 0}, 1)) << "outside the domain it is asked";
  const auto ray = [&](const Vector3& origin, const Vector3& direction, double length) {
    return !not_served({Pair::ray_sphere, RayAndBall{{origin, direction, length}, {{0, 0, 0}, 1}}, {0, 0}}, declared);
  };
  EXPECT_TRUE(ray({1, 2, 3}, {0.25, 3, 5}, 1.5));
  EXPECT_TRUE(ray({0.1, 0.2, 0.3}, {0.1, 0.2, 0.3}, 0)) << "a point";
  EXPECT_FALSE(ray({0, 0, 0}, {0.1, 0, 0}, 3)) << "a way that is no number";
  EXPECT_FALSE(ray({0x1p53, 0, 0}, {1, 0, 0}, 1)) << "an end that is none";
  EXPECT_TRUE(ray({0, 0, 0}, {1, 0, 0}, infinity)) << "outside the domain it is asked";
  declared.scalar = Scalar::binary32;
  EXPECT_FALSE(ray({0x1p24, 0, 0}, {1, 0, 0}, 1));
  declared.conventions.shapes = ShapesAs::given;
  EXPECT_TRUE(plane({0.6, 0.8, 0}, 1) && ray({0, 0, 0}, {0.1, 0, 0}, 3));
}

TEST(Served, a_rotated_box_by_its_matrix_has_one_of_numbers_unless_orientations_are_rounded) {
  Declaration declared = with([](Conventions& c) { c.shapes = ShapesAs::centered; });
  const auto served = [&](const Quaternion& orientation, const Vector3& extents) {
    const Obb box{{0, 0, 0}, orientation, extents};
    return !not_served({Pair::obb_obb, Convexes{{box}, {box}}, {0, 0}}, declared);
  };
  const double huge = std::numeric_limits<double>::max();
  EXPECT_TRUE(served({0, 0, 3, 3}, {1, 2, 3})) << "a quarter turn";
  EXPECT_FALSE(served({0, 0, 1, 2}, {1, 2, 3})) << "0.6 and 0.8";
  EXPECT_FALSE(served({0, 0, 3, 3}, {huge, 1, 1})) << "a size beyond the largest number";
  declared.rounds_orientation = true;
  EXPECT_TRUE(served({0, 0, 1, 2}, {1, 2, 3}));
  EXPECT_FALSE(served({0, 0, 1, 2}, {huge, 1, 1}));
}

TEST(Served, a_number_beyond_the_scale_is_not_and_the_reasons_differ) {
  const Declaration scaled = with([](Conventions& c) { c.scale_min = 0.5, c.scale_max = 2; });
  const auto why = [&](double radius) {
    return not_served({Pair::sphere_sphere, Balls{{{0, 0, 0}, radius}, {{1, 2, 2}, 1}}, {0, 0}}, scaled);
  };
  EXPECT_FALSE(why(0.5) || why(2) || why(0)) << "0 has no scale";
  EXPECT_TRUE(why(0.25) && why(4));
  const Declaration centered = with([](Conventions& c) { c.shapes = ShapesAs::centered; });
  const Query box{Pair::sphere_cube, BallAndBox{{{0, 0, 0}, 1}, {{-0.1, 0, 0}, {0.3, 2, 2}}}, {0, 0}};
  EXPECT_NE(not_served(box, centered), why(4));
}

TEST(JudgeLevels, a_missed_hit_reaches_none_and_a_false_hit_is_conservative) {
  EXPECT_EQ(level_of(overlapping(), overlap(false)), Level::none);
  EXPECT_EQ(level_of(overlapping(), no_contact()), Level::none);
  EXPECT_EQ(level_of(apart(1), overlap(true)), Level::conservative);
  EXPECT_EQ(level_of(apart(1), value_of(3)), Level::conservative);
  EXPECT_EQ(level_of(apart(1), overlap(false)), Level::correctly_rounded);
  Claim both = value_of(-1);  // a missed overlap beside a perfect contact
  both.overlap = false;
  EXPECT_EQ(level_of(overlapping(), both), Level::none);
}

TEST(JudgeLevels, the_worst_field_decides) {
  ContactClaim claim{
      .normal = Vector3(1, 0, 0), .point1 = Vector3(2, 0, 0), .point2 = Vector3(1, 0, 0), .point = {}, .value = -1.0};
  EXPECT_EQ(level_of(overlapping(), contact_of(claim)), Level::correctly_rounded);
  claim.point2 = Vector3(above(1), 0, 0);
  EXPECT_EQ(level_of(overlapping(), contact_of(claim)),
            Level::bounded);  // 1 is representable: its neighbour is no rounding
  claim.value = 12;
  EXPECT_EQ(level_of(overlapping(), contact_of(claim)), Level::decisions);
}

TEST(JudgeLevels, a_better_field_after_a_worse_one_raises_nothing) {
  // point1 = 2 n = (1.2, 1.6, 0); the double 1.2 lies below 6/5, so the next one is the other number beside it
  ContactClaim claim{.normal = Vector3(below(0.6), 0.8, 0),
                     .point1 = Vector3(above(1.2), 1.6, 0),
                     .point2 = {},
                     .point = {},
                     .value = {}};
  const Verdict verdict = judged(touching(), contact_of(claim));
  EXPECT_EQ(verdict.at(Field::normal)->grade, Grade::bounded);
  EXPECT_EQ(verdict.at(Field::point1)->grade, Grade::faithful);
  EXPECT_EQ(verdict.level(), Level::bounded);
  claim.normal = Vector3(1, 0, 0);
  EXPECT_EQ(level_of(touching(), contact_of(claim)), Level::decisions);
}

TEST(JudgeLevels, each_level_includes_those_after_it) {
  EXPECT_LT(Level::correctly_rounded, Level::faithful);
  EXPECT_LT(Level::faithful, Level::bounded);
  EXPECT_LT(Level::bounded, Level::decisions);
  EXPECT_LT(Level::decisions, Level::conservative);
  EXPECT_LT(Level::conservative, Level::none);
  EXPECT_EQ(name(Level::correctly_rounded), "correctly-rounded");
  EXPECT_EQ(name(Level::faithful), "faithful");
  EXPECT_EQ(name(Level::bounded), "bounded");
  EXPECT_EQ(name(Level::decisions), "decisions");
  EXPECT_EQ(name(Level::conservative), "conservative");
}

TEST(JudgeLevels, the_other_number_beside_the_real_is_faithful_and_one_further_is_bounded) {
  // n_x = 0.6, whose double 0.59999999999999997780 is below it
  EXPECT_EQ(level_of(touching(), normal_of({0.6, 0.8, 0})), Level::correctly_rounded);
  EXPECT_EQ(level_of(touching(), normal_of({above(0.6), 0.8, 0})), Level::faithful);
  EXPECT_EQ(level_of(touching(), normal_of({below(0.6), 0.8, 0})), Level::bounded);
  EXPECT_EQ(level_of(touching(), normal_of({above(above(0.6)), 0.8, 0})), Level::bounded);
  const Verdict faithful = judged(touching(), normal_of({above(0.6), 0.8, 0}));
  EXPECT_EQ(faithful.at(Field::normal)->grade, Grade::faithful);
  // 0.6 is 0.2 of its ulp 2^-53 above its double, so 0.8 below the next; half that in ulps of 1
  EXPECT_NEAR(faithful.at(Field::normal)->error, 0.4, 0.01);
}

TEST(JudgeLevels, a_status_other_than_answered_reaches_no_level) {
  for (const Claim::Status status : {Claim::Status::unsupported, Claim::Status::rejected, Claim::Status::error,
                                     Claim::Status::timeout, Claim::Status::crash, Claim::Status::missing}) {
    Claim claim = overlap(true);
    claim.status = status;
    claim.text = "why";
    const Verdict verdict = judged(overlapping(), claim);
    EXPECT_EQ(verdict.level(), Level::none);
    EXPECT_EQ(verdict.status, status);
    EXPECT_EQ(verdict.text, "why");
    EXPECT_EQ(verdict.overlap, Decision::unclaimed);
    EXPECT_TRUE(explained(overlapping(), claim).empty());
  }
}

TEST(JudgeLevels, an_answer_without_a_claim_is_an_error) {
  const Verdict verdict = judged(overlapping(), Claim{});
  EXPECT_EQ(verdict.status, Claim::Status::error);
  EXPECT_FALSE(verdict.text.empty());
  EXPECT_EQ(verdict.level(), Level::none);
}

TEST(JudgeLevels, a_field_that_is_not_claimed_is_not_judged) {
  const Verdict verdict = judged(overlapping(), value_of(-1));
  EXPECT_TRUE(verdict.at(Field::value));
  for (const Field field : {Field::normal, Field::point1, Field::point2, Field::point}) EXPECT_FALSE(verdict.at(field));
  EXPECT_EQ(level_of(overlapping(), contact_of({})), Level::correctly_rounded);
}

TEST(JudgeLevels, outside_the_domain_refusing_or_failing_is_right_and_an_answer_is_wrong) {
  const auto level = [](Claim::Status status) {
    Claim claim = overlap(true);
    claim.status = status;
    return judge_outside_domain(claim).level();
  };
  EXPECT_EQ(level(Claim::Status::rejected), Level::correctly_rounded);
  EXPECT_EQ(level(Claim::Status::error), Level::correctly_rounded);
  for (const Claim::Status status : {Claim::Status::answered, Claim::Status::unsupported, Claim::Status::timeout,
                                     Claim::Status::crash, Claim::Status::missing})
    EXPECT_EQ(level(status), Level::none);
  Claim claim;
  claim.status = Claim::Status::crash;
  claim.text = "signal 11";
  EXPECT_EQ(judge_outside_domain(claim).text, "signal 11");
}

// Bounds.

TEST(JudgeBounds, a_bound_that_is_exactly_met_holds_and_the_next_number_breaks_it) {
  // value -1 beside max(4, 5, 0) = 5: ulp(5) = 2^-50, 8 of them 2^-47
  EXPECT_EQ(level_of(overlapping(), value_of(-1 + 0x1p-47)), Level::bounded);
  EXPECT_EQ(level_of(overlapping(), value_of(-1 - 0x1p-47)), Level::bounded);
  EXPECT_EQ(level_of(overlapping(), value_of(above(-1 + 0x1p-47))), Level::decisions);
  EXPECT_EQ(level_of(overlapping(), value_of(below(-1 - 0x1p-47))), Level::decisions);
  EXPECT_EQ(judged(overlapping(), value_of(-1 + 0x1p-47)).at(Field::value)->error, 8);
}

TEST(JudgeBounds, a_declared_bound_replaces_the_default) {
  Declaration declared;
  declared.bounds.value = 1;
  EXPECT_EQ(level_of(overlapping(), value_of(-1 + 0x1p-50), declared), Level::bounded);
  EXPECT_EQ(level_of(overlapping(), value_of(above(-1 + 0x1p-50)), declared), Level::decisions);
  declared.bounds.normal = 64;  // 64 ulp(1) = 2^-46
  EXPECT_EQ(level_of(overlapping(), normal_of({1 + 0x1p-46, 0, 0}), declared), Level::bounded);
  EXPECT_EQ(level_of(overlapping(), normal_of({above(1 + 0x1p-46), 0, 0}), declared), Level::decisions);
  EXPECT_EQ(level_of(overlapping(), normal_of({1, 0x1p-46, 0}), declared), Level::bounded);
}

TEST(JudgeBounds, each_point_is_measured_by_the_larger_of_its_coordinates_and_radius) {
  // point1: max(0, 2) = 2, ulp 2^-51, 8 of them 2^-48; point2: max(4, 3) = 4, 2^-47
  const Vector3 p1(2, 0, 0);
  const Vector3 p2(1, 0, 0);
  EXPECT_EQ(level_of(overlapping(), points_of(p1 + Vector3(0, 0x1p-48, 0), p2)), Level::bounded);
  EXPECT_EQ(level_of(overlapping(), points_of(p1 + Vector3(0, above(0x1p-48), 0), p2)), Level::decisions);
  EXPECT_EQ(level_of(overlapping(), points_of(p1, p2 - Vector3(0, 0, 0x1p-47))), Level::bounded);
  EXPECT_EQ(level_of(overlapping(), points_of(p1, p2 - Vector3(0, 0, above(0x1p-47)))), Level::decisions);
}

TEST(JudgeBounds, a_binary32_engine_is_judged_by_the_rounding_and_the_ulps_of_binary32) {
  Declaration declared;
  declared.scalar = Scalar::binary32;
  const auto f = [](float x) { return static_cast<double>(x); };
  EXPECT_EQ(level_of(touching(), normal_of({f(0.6F), f(0.8F), 0}), declared), Level::correctly_rounded);
  EXPECT_EQ(level_of(touching(), normal_of({0.6, 0.8, 0}), declared), Level::bounded);   // no binary32 numbers
  EXPECT_EQ(level_of(touching(), normal_of({f(0.6F), f(0.8F), 0})), Level::decisions);   // and the other way round
  EXPECT_EQ(level_of(overlapping(), value_of(-1 + 0x1p-18), declared), Level::bounded);  // 8 ulp(5) = 2^-18
  EXPECT_EQ(level_of(overlapping(), value_of(above(-1 + 0x1p-18)), declared), Level::decisions);
}

TEST(JudgeBounds, a_cancelled_value_is_measured_by_what_cancelled) {
  // touching: value 0, scale 5; 0.9 e-15 is one ulp(5), whatever it is in ulps of 0
  EXPECT_EQ(level_of(touching(), value_of(0x1p-50)), Level::bounded);
  EXPECT_EQ(judged(touching(), value_of(0x1p-50)).at(Field::value)->error, 1);
  // a large contact distance is a scale, too: 8 ulp(1024) = 2^-39
  EXPECT_EQ(level_of(touching(0, 1024), value_of(-1024 + 0x1p-39)), Level::bounded);
  EXPECT_EQ(level_of(touching(0, 1024), value_of(-1024 + 0x1.1p-39)), Level::decisions);
}

// Numbers that are not finite, and zeros.

TEST(JudgeInfinity, a_number_that_is_not_finite_is_wrong_where_the_truth_is_finite) {
  for (const double bad : {kInfinity, -kInfinity, kNaN}) {
    for (const Claim& claim : {value_of(bad), normal_of({1, bad, 0}), points_of({2, 0, 0}, {1, bad, 0})}) {
      const Verdict verdict = judged(overlapping(), claim);
      EXPECT_TRUE(verdict.not_finite());
      EXPECT_EQ(verdict.level(), Level::decisions);
    }
  }
  EXPECT_EQ(judged(overlapping(), value_of(kNaN)).at(Field::value)->grade, Grade::not_finite);
  EXPECT_FALSE(judged(overlapping(), value_of(12)).not_finite());
}

// coincident spheres of the largest radius M: value -2 M, which rounds to -infinity
Query huge() { return spheres({{0, 0, 0}, kLargest}, {{0, 0, 0}, kLargest}); }

TEST(JudgeInfinity, an_equal_infinity_is_right_and_the_other_one_is_not) {
  EXPECT_EQ(level_of(huge(), value_of(-kInfinity)), Level::correctly_rounded);
  EXPECT_EQ(judged(huge(), value_of(-kInfinity)).at(Field::value)->error, 0);
  EXPECT_EQ(judged(huge(), value_of(kInfinity)).at(Field::value)->grade, Grade::not_finite);
  EXPECT_EQ(judged(huge(), value_of(kNaN)).at(Field::value)->grade, Grade::not_finite);
}

TEST(JudgeInfinity, a_finite_claim_is_measured_against_the_exact_real) {
  // -1 against -2 M = -(2^1025 - 2^972), whose ulp is 2^972: 2^53 - 1 ulps, but for a hair
  const FieldVerdict far = *judged(huge(), value_of(-1)).at(Field::value);
  EXPECT_EQ(far.grade, Grade::beyond_bound);
  EXPECT_EQ(far.error, 0x1.fffffffffffffp52);
  // M + 2^970 ties to infinity; M is half its own ulp away, and the number beside the real
  const Query edge = spheres({{0, 0, 0}, kLargest}, {{0, 0, 0}, 0}, 0, 0x1p970);
  const FieldVerdict near = *judged(edge, value_of(-kLargest)).at(Field::value);
  EXPECT_EQ(near.grade, Grade::faithful);
  EXPECT_EQ(near.error, 0.5);
  EXPECT_EQ(judged(edge, value_of(below(kLargest) * -1)).at(Field::value)->grade, Grade::bounded);
  EXPECT_EQ(judged(edge, value_of(-kInfinity)).at(Field::value)->grade, Grade::correctly_rounded);
}

TEST(JudgeZero, minus_zero_is_as_good_as_plus_zero) {
  EXPECT_EQ(level_of(touching(), value_of(-0.0)), Level::correctly_rounded);
  EXPECT_EQ(level_of(overlapping(), normal_of({1, -0.0, -0.0})), Level::correctly_rounded);
  EXPECT_EQ(level_of(overlapping(), points_of({2, -0.0, 0}, {1, 0, -0.0})), Level::correctly_rounded);
}

// Conventions of the normal.

TEST(JudgeNormal, may_point_from_the_second_to_the_first_where_declared) {
  const Declaration reversed = with([](Conventions& c) { c.normal = NormalDirection::second_to_first; });
  EXPECT_EQ(level_of(touching(), normal_of({-0.6, -0.8, 0}), reversed), Level::correctly_rounded);
  EXPECT_EQ(level_of(touching(), normal_of({0.6, 0.8, 0}), reversed), Level::decisions);
  EXPECT_EQ(level_of(touching(), normal_of({-0.6, -0.8, 0})), Level::decisions);
}

TEST(JudgeNormal, of_any_length_is_normalised_exactly_where_declared_and_bounded_at_best) {
  const Declaration any_length = with([](Conventions& c) { c.normal_unit = false; });
  EXPECT_EQ(level_of(touching(), normal_of({3, 4, 0}), any_length), Level::bounded);
  EXPECT_EQ(level_of(touching(), normal_of({0.6, 0.8, 0}), any_length), Level::bounded);
  EXPECT_EQ(level_of(touching(), normal_of({0x3p-1000, 0x4p-1000, 0}), any_length), Level::bounded);
  EXPECT_EQ(level_of(touching(), normal_of({0x3p900, 0x4p900, 0}), any_length), Level::bounded);
  EXPECT_EQ(level_of(touching(), normal_of({4, 3, 0}), any_length), Level::decisions);
  EXPECT_EQ(level_of(touching(), normal_of({-3, -4, 0}), any_length), Level::decisions);
  EXPECT_EQ(level_of(touching(), normal_of({0, 0, 0}), any_length), Level::decisions);
  EXPECT_EQ(level_of(touching(), normal_of({3, 4, kInfinity}), any_length), Level::decisions);
  EXPECT_EQ(level_of(touching(), normal_of({3, 4, 0})), Level::decisions);  // undeclared
  // against (1,0,0): (1, t, 0) is t off in y, but for t^3; 8 ulp(1) = 2^-49
  EXPECT_EQ(level_of(overlapping(), normal_of({1, 0x1p-49, 0}), any_length), Level::bounded);
  EXPECT_EQ(level_of(overlapping(), normal_of({1, above(0x1p-49), 0}), any_length), Level::decisions);
  EXPECT_EQ(level_of(overlapping(), normal_of({2, 0x1p-48, 0}), any_length), Level::bounded);
}

TEST(JudgeNormal, of_any_length_may_err_to_neither_side_whatever_its_sign) {
  const Declaration any_length = with([](Conventions& c) { c.normal_unit = false; });
  // n is about (1, +-2^-20, 0): what turns y by 2^-40 turns x by 2^-60, which is within its bound
  for (const double y : {1.0, -1.0}) {
    const Query query = spheres({{0, 0, 0}, 0x1p20}, {{0x1p20, y, 0}, 3});
    EXPECT_EQ(level_of(query, normal_of({0x1p20, y, 0}), any_length), Level::bounded);
    for (const double off : {0x1p-20, -0x1p-20})
      EXPECT_EQ(level_of(query, normal_of({0x1p20, y + off, 0}), any_length), Level::decisions) << y << " " << off;
  }
}

TEST(JudgeFields, each_axis_counts_alone) {
  const Query query = spheres({{1, 2, 3}, 2}, {{4, 6, 3}, 3});  // n (0.6, 0.8, 0); both points (2.2, 3.6, 3)
  const Vector3 n(0.6, 0.8, 0);
  const Vector3 p(2.2, 3.6, 3);
  const Declaration midpoint = with_points(Points::midpoint);
  EXPECT_EQ(level_of(query, points_of(p, p)), Level::correctly_rounded);
  EXPECT_EQ(level_of(query, midpoint_of(p), midpoint), Level::correctly_rounded);
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 off = Vector3::Unit(axis);
    EXPECT_EQ(level_of(query, normal_of(n + off)), Level::decisions) << axis;
    EXPECT_EQ(level_of(query, points_of(p + off, p)), Level::decisions) << axis;
    EXPECT_EQ(level_of(query, points_of(p, p + off)), Level::decisions) << axis;
    EXPECT_EQ(level_of(query, midpoint_of(p + off), midpoint), Level::decisions) << axis;
  }
}

TEST(JudgeFields, errors_are_measured_from_the_right_number_in_ulps_of_its_scale) {
  const auto error = [](const Query& query, const Vector3& n, const Declaration& declared) {
    return judged(query, normal_of(n), declared).at(Field::normal)->error;
  };
  const Declaration any_length = with([](Conventions& c) { c.normal_unit = false; });
  // 0 instead of (0.6, 0.8, 0) is 0.8 off; ulp(1) = 2^-52
  EXPECT_DOUBLE_EQ(error(touching(), {0, 0, 0}, any_length), 0.8 * 0x1p52);
  // where any unit normal is right, what is off is its squared length
  EXPECT_DOUBLE_EQ(error(coincident(), {0, 2, 0}, {}), 3 * 0x1p52);
  EXPECT_EQ(error(coincident(), {0, 1, 0}, {}), 0);
  EXPECT_EQ(error(coincident(), {0, 2, 0}, any_length), 0);
  EXPECT_LT(error(touching(), {3, 4, 0}, any_length), 1);
  EXPECT_EQ(error(overlapping(), {1, 0x1p-49, 0}, any_length), 8);
  // what is not finite has no error
  EXPECT_EQ(error(touching(), {kNaN, 0, 0}, {}), 0);
  EXPECT_EQ(judged(overlapping(), value_of(kNaN)).at(Field::value)->error, 0);
}

TEST(JudgeFields, the_middle_is_measured_by_the_larger_sphere) {
  // 8 ulp(8) = 2^-46; the other sphere's coordinates and radius are 4 at most
  const Declaration midpoint = with_points(Points::midpoint);
  const Query first = spheres({{0, 0, 0}, 8}, {{4, 0, 0}, 1});
  EXPECT_EQ(level_of(first, midpoint_of({5.5 + 0x1p-46, 0, 0}), midpoint), Level::bounded);
  const Query second = spheres({{0, 0, 0}, 1}, {{4, 0, 0}, 8});
  EXPECT_EQ(level_of(second, midpoint_of({-1.5 + 0x1p-46, 0, 0}), midpoint), Level::bounded);
}

TEST(JudgeFields, a_rounding_that_is_known_already_changes_no_verdict) {
  const Query generic = spheres({{0.1, 0.2, 0.3}, 0.7}, {{0.4, -0.5, 0.6}, 0.35}, 0.01, 0.003);
  std::vector<Declaration> declarations{{}};
  for (std::size_t points = 0; points < kPointsNames.size(); ++points)
    declarations.push_back(with_points(static_cast<Points>(points)));
  declarations.push_back(with([](Conventions& c) { c.normal = NormalDirection::second_to_first; }));
  declarations.push_back(with([](Conventions& c) { c.normal = NormalDirection::none; }));
  declarations.push_back(with([](Conventions& c) { c.normal_unit = false; }));
  declarations.push_back(with([](Conventions& c) { c.value = ValueKind::depth; }));
  declarations.push_back(with([](Conventions& c) { c.value_less_contact = false; }));
  std::size_t wrong = 0;
  for (const Query& query : {generic, touching(0.5, 0.25), overlapping(0.25), coincident()}) {
    const Truth truth = truth_of(query);
    const Expectation known = expectation(truth, Scalar::binary64);
    const Contact& right = *known.contact;
    std::vector<Claim> claims{normal_of(right.normal),
                              normal_of(-right.normal),
                              points_of(right.point1, right.point2),
                              points_of(right.point2, right.point1),
                              value_of(right.value),
                              value_of(-right.value),
                              value_of(above(right.value))};
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3 off = Vector3::Unit(axis);
      claims.push_back(
          contact_of({.normal = off, .point1 = right.point1, .point2 = right.point2, .point = {}, .value = {}}));
      claims.push_back(normal_of(right.normal + off));
      claims.push_back(points_of(right.point1 + off, right.point2));
      claims.push_back(points_of(right.point1, right.point2 + off));
    }
    for (const Declaration& declared : declarations)
      for (const Claim& claim : claims) {
        const Verdict plain = judge(query, truth, claim, of_these(claim, declared));
        const Verdict quick = judge(query, truth, claim, of_these(claim, declared), &known);
        wrong += plain.level() == Level::decisions ? 1 : 0;
        for (const Field field : kFields) {
          ASSERT_EQ(plain.at(field).has_value(), quick.at(field).has_value());
          if (!plain.at(field)) continue;
          EXPECT_EQ(plain.at(field)->grade, quick.at(field)->grade) << name(field);
          EXPECT_EQ(plain.at(field)->error, quick.at(field)->error) << name(field);
        }
      }
  }
  EXPECT_GT(wrong, 100U);  // there was something to be found
}

// Conventions of the points.

TEST(JudgePoints, lie_on_the_nearest_surface_by_default) {
  EXPECT_EQ(level_of(overlapping(), points_of({2, 0, 0}, {1, 0, 0})), Level::correctly_rounded);
  EXPECT_EQ(level_of(overlapping(), points_of({-2, 0, 0}, {7, 0, 0})), Level::decisions);
  EXPECT_EQ(level_of(overlapping(), points_of({0, 0, 0}, {4, 0, 0})), Level::decisions);
  EXPECT_EQ(level_of(overlapping(), points_of({1, 0, 0}, {2, 0, 0})), Level::decisions);  // exchanged
}

TEST(JudgePoints, are_centres_of_deformable_spheres_and_surface_points_of_rigid_ones_where_declared) {
  const Declaration center = with_points(Points::center);
  const Vector3 surface1(2, 0, 0);
  const Vector3 surface2(1, 0, 0);
  const Vector3 center1(0, 0, 0);
  const Vector3 center2(4, 0, 0);
  for (const auto& [pair, p1, p2] :
       {std::tuple(Pair::sphere_sphere, center1, center2), std::tuple(Pair::sphere_rigid_sphere, center1, surface2),
        std::tuple(Pair::rigid_sphere_rigid_sphere, surface1, surface2)}) {
    EXPECT_EQ(level_of(overlapping(0, pair), points_of(p1, p2), center), Level::correctly_rounded) << name(pair);
    EXPECT_EQ(level_of(overlapping(0, pair), points_of(surface1, surface2)), Level::correctly_rounded) << name(pair);
  }
  EXPECT_EQ(level_of(overlapping(0, Pair::sphere_rigid_sphere), points_of(center1, center2), center), Level::decisions);
  EXPECT_EQ(level_of(overlapping(), points_of(surface1, surface2), center), Level::decisions);
}

TEST(JudgePoints, lie_on_the_far_surface_by_the_published_formula) {
  const Declaration published = with_points(Points::published);
  EXPECT_EQ(level_of(overlapping(), points_of({-2, 0, 0}, {7, 0, 0}), published), Level::correctly_rounded);
  EXPECT_EQ(level_of(overlapping(), points_of({2, 0, 0}, {1, 0, 0}), published), Level::decisions);
}

TEST(JudgePoints, may_be_one_midpoint) {
  const Declaration midpoint = with_points(Points::midpoint);
  EXPECT_EQ(level_of(overlapping(), midpoint_of({1.5, 0, 0}), midpoint), Level::correctly_rounded);  // (2 + 1) / 2
  // 8 ulps of the larger scale, 4: 2^-47
  EXPECT_EQ(level_of(overlapping(), midpoint_of({1.5, 0x1p-47, 0}), midpoint), Level::bounded);
  EXPECT_EQ(level_of(overlapping(), midpoint_of({1.5, above(0x1p-47), 0}), midpoint), Level::decisions);
  EXPECT_FALSE(judged(overlapping(), points_of({9, 9, 9}, {9, 9, 9}), midpoint).at(Field::point1));
  EXPECT_FALSE(judged(overlapping(), midpoint_of({9, 9, 9})).at(Field::point));
}

TEST(JudgePoints, may_be_claimed_of_one_sphere_or_of_none) {
  const Claim first_right = points_of({2, 0, 0}, {9, 9, 9});
  const Claim second_right = points_of({9, 9, 9}, {1, 0, 0});
  EXPECT_EQ(level_of(overlapping(), first_right, with_points(Points::first_only)), Level::correctly_rounded);
  EXPECT_EQ(level_of(overlapping(), second_right, with_points(Points::first_only)), Level::decisions);
  EXPECT_EQ(level_of(overlapping(), second_right, with_points(Points::second_only)), Level::correctly_rounded);
  EXPECT_EQ(level_of(overlapping(), first_right, with_points(Points::second_only)), Level::decisions);
  const Verdict none = judged(overlapping(), first_right, with_points(Points::none));
  EXPECT_FALSE(none.at(Field::point1));
  EXPECT_FALSE(none.at(Field::point2));
}

// Conventions of the value.

TEST(JudgeValue, is_signed_and_less_the_contact_distance_by_default) {
  // 4 - 5 = -1, less 0.25
  EXPECT_EQ(level_of(overlapping(0.25), value_of(-1.25)), Level::correctly_rounded);
  EXPECT_EQ(level_of(overlapping(0.25), value_of(-1)), Level::decisions);
  EXPECT_EQ(level_of(overlapping(0.25), value_of(1.25)), Level::decisions);
}

TEST(JudgeValue, may_be_a_depth_with_or_without_the_contact_distance) {
  const auto declared = [](ValueKind kind, bool less) {
    return with([&](Conventions& c) {
      c.value = kind;
      c.value_less_contact = less;
    });
  };
  EXPECT_EQ(level_of(overlapping(0.25), value_of(1.25), declared(ValueKind::depth, true)), Level::correctly_rounded);
  EXPECT_EQ(level_of(overlapping(0.25), value_of(-1.25), declared(ValueKind::depth, true)), Level::decisions);
  EXPECT_EQ(level_of(overlapping(0.25), value_of(1), declared(ValueKind::depth, false)), Level::correctly_rounded);
  EXPECT_EQ(level_of(overlapping(0.25), value_of(-1), declared(ValueKind::signed_distance, false)),
            Level::correctly_rounded);
  EXPECT_FALSE(judged(overlapping(), value_of(77), declared(ValueKind::none, true)).at(Field::value));
}

// Coincident centres.

TEST(JudgeCoincident, any_unit_normal_is_right) {
  for (const Vector3& n : {Vector3(1, 0, 0), Vector3(0, 0, -1), Vector3(0.6, 0.8, 0), Vector3(0, -1, 0)})
    EXPECT_EQ(level_of(coincident(), normal_of(n)), Level::correctly_rounded);
  EXPECT_EQ(level_of(coincident(), normal_of({0, 0, 0})), Level::decisions);
  EXPECT_EQ(level_of(coincident(), normal_of({1, 1, 0})), Level::decisions);
  EXPECT_EQ(judged(coincident(), normal_of({kNaN, kNaN, kNaN})).at(Field::normal)->grade, Grade::not_finite);
}

TEST(JudgeCoincident, unit_means_that_its_squared_length_is_within_8_roundings_of_1) {
  // |n.n - 1| <= 8 u = 2^-50: (1, y, 0) is off by y^2, so y = 2^-25 is the last
  EXPECT_EQ(level_of(coincident(), normal_of({1, 0x1p-25, 0})), Level::correctly_rounded);
  EXPECT_EQ(level_of(coincident(), normal_of({1, above(0x1p-25), 0})), Level::decisions);
  // below 1: x = 1 - k 2^-53 is off by k 2^-52 - k^2 2^-106, less than 4 2^-52 for k = 4 and more for k = 5
  EXPECT_EQ(level_of(coincident(), normal_of({1 - 0x4p-53, 0, 0})), Level::correctly_rounded);
  EXPECT_EQ(level_of(coincident(), normal_of({1 - 0x5p-53, 0, 0})), Level::decisions);
  Declaration single;
  single.scalar = Scalar::binary32;  // 2^-21: y = 2^-10.5 lies between 2^-11 and 2^-10
  EXPECT_EQ(level_of(coincident(), normal_of({1, 0x1p-11, 0}), single), Level::correctly_rounded);
  EXPECT_EQ(level_of(coincident(), normal_of({1, 0x1p-10, 0}), single), Level::decisions);
}

TEST(JudgeCoincident, points_go_with_the_claimed_normal) {
  // centres (7,0,0), radii 2 and 3, n = (0, 0, -1): (7, 0, -2) and (7, 0, 3)
  const auto claim = [](const Vector3& n, const Vector3& p1, const Vector3& p2) {
    return contact_with(n, p1, p2, -5.0);
  };
  const Vector3 down(0, 0, -1);
  EXPECT_EQ(level_of(coincident(), claim(down, {7, 0, -2}, {7, 0, 3})), Level::correctly_rounded);
  EXPECT_EQ(level_of(coincident(), claim(down, {9, 0, 0}, {4, 0, 0})), Level::decisions);
  EXPECT_EQ(level_of(coincident(), claim({1, 0, 0}, {9, 0, 0}, {4, 0, 0})), Level::correctly_rounded);
  EXPECT_EQ(level_of(coincident(), claim(down, {7, 0, 2}, {7, 0, -3}), with_points(Points::published)),
            Level::correctly_rounded);
  EXPECT_EQ(level_of(coincident(), claim(down, {7, 0, 0}, {7, 0, 0}), with_points(Points::center)),
            Level::correctly_rounded);
  const Declaration reversed = with([](Conventions& c) { c.normal = NormalDirection::second_to_first; });
  EXPECT_EQ(level_of(coincident(), claim(-down, {7, 0, -2}, {7, 0, 3}), reversed), Level::correctly_rounded);
  EXPECT_EQ(level_of(coincident(), claim(down, {7, 0, -2}, {7, 0, 3}), reversed), Level::decisions);
}

TEST(JudgeCoincident, points_without_a_finite_normal_cannot_be_judged) {
  EXPECT_FALSE(judged(coincident(), points_of({1, 2, 3}, {4, 5, 6})).at(Field::point1));
  const Claim bad = contact_with({kNaN, 0, 0}, {7, 0, 0}, {7, 0, 0});
  EXPECT_FALSE(judged(coincident(), bad).at(Field::point1));
  EXPECT_EQ(level_of(coincident(), bad), Level::decisions);
}

TEST(JudgeCoincident, the_midpoint_goes_with_the_claimed_normal_normalised_where_that_is_declared) {
  // (c + 2 n + c - 3 n) / 2 = (7,0,0) - n / 2
  const auto claim = [](const Vector3& n, const Vector3& p) { return normal_and_midpoint(n, p); };
  EXPECT_EQ(level_of(coincident(), claim({0, 1, 0}, {7, -0.5, 0}), with_points(Points::midpoint)),
            Level::correctly_rounded);
  EXPECT_EQ(level_of(coincident(), claim({0, 1, 0}, {6.5, 0, 0}), with_points(Points::midpoint)), Level::decisions);
  const Declaration any_length = with([](Conventions& c) {
    c.points = Points::midpoint;
    c.normal_unit = false;
  });
  EXPECT_EQ(judged(coincident(), claim({0, 9, 0}, {7, -0.5, 0}), any_length).at(Field::point)->grade,
            Grade::correctly_rounded);
}

TEST(JudgeCoincident, points_go_with_a_unit_normal_as_it_is_claimed) {
  // unit within 8 roundings, and 2 n = 2 - 2^-50 all the same
  const Claim claim = contact_with({1 - 0x4p-53, 0, 0}, {2 - 0x1p-50, 0, 0});
  EXPECT_EQ(level_of(spheres({{0, 0, 0}, 2}, {{0, 0, 0}, 3}), claim), Level::correctly_rounded);
}

TEST(JudgeCoincident, a_zero_normal_of_any_length_is_wrong_and_its_points_are_centres) {
  const Declaration any_length = with([](Conventions& c) { c.normal_unit = false; });
  const Claim claim = contact_with({0, 0, 0}, {7, 0, 0});
  const Verdict verdict = judged(coincident(), claim, any_length);
  EXPECT_EQ(verdict.at(Field::normal)->grade, Grade::beyond_bound);
  EXPECT_EQ(verdict.at(Field::point1)->grade, Grade::correctly_rounded);
}

TEST(JudgeCoincident, a_midpoint_without_a_normal_is_not_judged) {
  const Verdict verdict = judged(coincident(), midpoint_of({1, 2, 3}), with_points(Points::midpoint));
  EXPECT_FALSE(verdict.at(Field::point).has_value());
}

TEST(JudgeDecisions, a_contact_of_cubes_is_a_decision_without_fields) {
  const Query query{Pair::cube_cube, Boxes{{{0, 0, 0}, {1, 1, 1}}, {{1, 0, 0}, {2, 1, 1}}}, {0, 0}};
  for (const Coincident coincident : {Coincident::any_unit_normal, Coincident::no_contact}) {
    const Declaration declared = with([&](Conventions& c) { c.coincident = coincident; });
    const Verdict verdict = judged(query, normal_of({1, 0, 0}), declared);
    EXPECT_EQ(verdict.contact, Decision::right);
    EXPECT_FALSE(verdict.at(Field::normal).has_value());
    EXPECT_EQ(judged(query, no_contact(), declared).contact, Decision::missed_hit);
  }
}

TEST(JudgeLevels, grades_have_the_names_of_the_reports) {
  EXPECT_EQ(name(Grade::correctly_rounded), "correctly-rounded");
  EXPECT_EQ(name(Grade::not_finite), "not finite");
}

TEST(JudgeCoincident, centres_need_no_normal_to_be_judged) {
  const Declaration center = with_points(Points::center);
  EXPECT_EQ(level_of(coincident(), points_of({7, 0, 0}, {7, 0, 0}), center), Level::correctly_rounded);
  EXPECT_EQ(level_of(coincident(), points_of({8, 0, 0}, {7, 0, 0}), center), Level::decisions);
}

TEST(JudgeCoincident, points_go_with_the_normalised_normal_where_it_may_have_any_length) {
  const Declaration any_length = with([](Conventions& c) { c.normal_unit = false; });
  const Claim claim = contact_of({.normal = Vector3(0, 6, 8),
                                  .point1 = Vector3(7, 1.2, 1.6),
                                  .point2 = Vector3(7, below(-1.8), -2.4),
                                  .point = {},
                                  .value = {}});
  const Verdict verdict = judged(coincident(), claim, any_length);
  EXPECT_EQ(verdict.at(Field::normal)->grade, Grade::bounded);            // at best, as everywhere
  EXPECT_EQ(verdict.at(Field::point1)->grade, Grade::correctly_rounded);  // 2 * 0.6, 2 * 0.8
  // -3 * 0.6 = -1.8, whose double -1.8000000000000000444 lies below it: one further down is no neighbour of the real
  EXPECT_EQ(verdict.at(Field::point2)->grade, Grade::bounded);
}

TEST(JudgeCoincident, value_is_judged_as_ever) {
  EXPECT_EQ(level_of(coincident(), value_of(-5)), Level::correctly_rounded);
  EXPECT_EQ(level_of(coincident(), value_of(-4)), Level::decisions);
}

TEST(JudgeCoincident, a_zero_normal_is_right_where_declared_and_only_it) {
  const Declaration zero = with([](Conventions& c) { c.coincident = Coincident::zero_normal; });
  EXPECT_EQ(level_of(coincident(), normal_of({0, -0.0, 0}), zero), Level::correctly_rounded);
  EXPECT_EQ(level_of(coincident(), normal_of({1, 0, 0}), zero), Level::decisions);
  EXPECT_EQ(level_of(coincident(), normal_of({0, 0, 0x1p-1074}), zero), Level::decisions);
  EXPECT_EQ(level_of(touching(), normal_of({0, 0, 0}), zero), Level::decisions);  // these centres do not coincide
}

TEST(JudgeCoincident, no_contact_is_right_where_declared_and_for_the_contact_alone) {
  const Declaration none = with([](Conventions& c) { c.coincident = Coincident::no_contact; });
  EXPECT_EQ(level_of(coincident(), no_contact(), none), Level::correctly_rounded);
  EXPECT_EQ(judged(coincident(), value_of(-5), none).contact, Decision::false_hit);
  EXPECT_EQ(judged(coincident(), overlap(true), none).overlap, Decision::right);
  EXPECT_EQ(judged(coincident(), overlap(false), none).overlap, Decision::missed_hit);
  EXPECT_EQ(judged(overlapping(), no_contact(), none).contact, Decision::missed_hit);
  EXPECT_EQ(judged(coincident(), no_contact()).contact, Decision::missed_hit);
}

// What a wrong answer says about the engine's conventions.

TEST(RightClaim, is_correctly_rounded_in_the_judges_eyes_under_every_declaration) {
  const std::vector<Query> queries{
      touching(),
      touching(0.5, 0.25),
      overlapping(0.25),
      overlapping(0, Pair::sphere_rigid_sphere),
      apart(2),
      apart(3),
      apart(4),
      coincident(),
      spheres({{0.1, 0.2, 0.3}, 0.7}, {{0.4, -0.5, 0.6}, 0.35}, 0.01, 0.003, Pair::rigid_sphere_rigid_sphere),
      {Pair::cube_cube, Boxes{{{0, 0, 0}, {1, 1, 1}}, {{1, 0, 0}, {2, 1, 1}}}, {0, 0}}};
  std::size_t contacts = 0;
  const auto check = [&](const Declaration& declared) {
    for (const Query& query : queries) {
      const Truth truth = truth_of(query);
      const Claim claim = right_claim(query, truth, declared);
      const Verdict verdict = judge(query, truth, claim, declared);
      EXPECT_EQ(verdict.level(), verdict.at(Field::points) ? Level::bounded : Level::correctly_rounded);
      EXPECT_EQ(claim.speaks_of_contact, query.balls() != nullptr);
      contacts += claim.contact ? 1 : 0;
    }
  };
  for (const Scalar scalar : kScalars)
    for (std::size_t points = 0; points < kPointsNames.size(); ++points)
      for (const Coincident coincident : {Coincident::any_unit_normal, Coincident::zero_normal, Coincident::no_contact})
        for (const NormalDirection normal :
             {NormalDirection::first_to_second, NormalDirection::second_to_first, NormalDirection::none}) {
          Declaration declared;
          declared.scalar = scalar;
          declared.conventions.points = static_cast<Points>(points);
          declared.conventions.coincident = coincident;
          declared.conventions.normal = normal;
          check(declared);
        }
  for (const ValueKind value : {ValueKind::signed_distance, ValueKind::depth, ValueKind::none})
    for (const Margin margin : {Margin::inclusive, Margin::exclusive, Margin::none})
      for (const Touching touching : {Touching::closed, Touching::open})
        for (const bool less : {true, false}) {
          Declaration declared;
          declared.conventions.value = value;
          declared.conventions.margin = margin;
          declared.conventions.touching_contact = touching;
          declared.conventions.touching_overlap = touching;
          declared.conventions.value_less_contact = less;
          check(declared);
        }
  EXPECT_GT(contacts, 400U);
}

TEST(RightClaim, says_what_the_conventions_ask_for) {
  Declaration declared;
  declared.conventions.points = Points::published;
  declared.conventions.normal = NormalDirection::second_to_first;
  declared.conventions.value = ValueKind::depth;
  const Query query = overlapping();
  const Claim claim = right_claim(query, truth_of(query), declared);
  ASSERT_TRUE(claim.contact);
  EXPECT_EQ(*claim.overlap, true);
  EXPECT_EQ(*claim.contact->normal, Vector3(-1, 0, 0));
  EXPECT_EQ(*claim.contact->point1, Vector3(-2, 0, 0));
  EXPECT_EQ(*claim.contact->point2, Vector3(7, 0, 0));
  EXPECT_EQ(*claim.contact->value, 1);
}

TEST(JudgeExplains, nothing_where_the_answer_is_right) {
  EXPECT_TRUE(explained(overlapping(), value_of(-1)).empty());
  EXPECT_TRUE(explained(overlapping(), value_of(above(-1))).empty());
}

TEST(JudgeExplains, nothing_where_no_convention_makes_it_right) {
  EXPECT_TRUE(explained(overlapping(), value_of(77)).empty());
  EXPECT_TRUE(explained(overlapping(), points_of({77, 0, 0}, {78, 0, 0})).empty());
}

TEST(JudgeExplains, the_direction_and_the_length_of_a_normal) {
  const auto reversed = explained(touching(), normal_of({-0.6, -0.8, 0}));
  ASSERT_EQ(reversed.size(), 1U);
  EXPECT_TRUE(says(reversed, "normal", "normal", "second-to-first"));
  const auto longer = explained(touching(), normal_of({3, 4, 0}));
  ASSERT_EQ(longer.size(), 1U);
  EXPECT_TRUE(says(longer, "normal", "normal_unit", "false"));
}

TEST(JudgeExplains, the_points) {
  const auto published = explained(overlapping(), points_of({-2, 0, 0}, {7, 0, 0}));
  EXPECT_TRUE(says(published, "point1", "points", "published"));
  EXPECT_TRUE(says(published, "point2", "points", "published"));
  EXPECT_EQ(published.size(), 2U);
  const auto center = explained(overlapping(), points_of({0, 0, 0}, {4, 0, 0}));
  EXPECT_TRUE(says(center, "point1", "points", "center"));
  EXPECT_TRUE(says(center, "point2", "points", "center"));
  const auto nearest = explained(overlapping(), points_of({2, 0, 0}, {1, 0, 0}), with_points(Points::published));
  EXPECT_TRUE(says(nearest, "point1", "points", "nearest_surface"));
  // Radii 2 and 3 about (7,0,0): the middle of the surface points lies half behind the centre.
  Claim behind = midpoint_of({7.5, 0, 0});
  behind.contact->normal = Vector3(1, 0, 0);
  EXPECT_TRUE(
      says(explained(coincident(), behind, with_points(Points::midpoint)), "point", "normal", "second-to-first"));
}

TEST(JudgeExplains, the_value) {
  EXPECT_TRUE(says(explained(overlapping(0.25), value_of(1.25)), "value", "value", "depth less contact"));
  EXPECT_TRUE(says(explained(overlapping(0.25), value_of(1)), "value", "value", "depth without contact"));
  EXPECT_TRUE(says(explained(overlapping(0.25), value_of(-1)), "value", "value", "signed without contact"));
}

TEST(JudgeExplains, touching_the_margin_and_coincident_centres) {
  EXPECT_TRUE(says(explained(touching(), overlap(false)), "overlap", "touching_overlap", "open"));
  EXPECT_TRUE(says(explained(touching(), no_contact()), "contact", "touching_contact", "open"));
  EXPECT_FALSE(says(explained(touching(), no_contact()), "contact", "touching_overlap", "open"));
  EXPECT_TRUE(says(explained(apart(3), overlap(false)), "overlap", "margin", "exclusive"));
  EXPECT_TRUE(says(explained(apart(3), overlap(false)), "overlap", "margin", "none"));
  const auto ignored = explained(apart(9), no_contact());
  EXPECT_TRUE(says(ignored, "contact", "margin", "none"));
  EXPECT_FALSE(says(ignored, "contact", "margin", "exclusive"));
  EXPECT_TRUE(says(explained(coincident(), no_contact()), "contact", "coincident", "no_contact"));
  EXPECT_TRUE(says(explained(coincident(), normal_of({0, 0, 0})), "normal", "coincident", "zero_normal"));
}

// A sphere and a box.

Query in_unit_box(const Vector3& center, double radius = 2) {
  return {Pair::sphere_cube, BallAndBox{{center, radius}, {{0, 0, 0}, {1, 1, 1}}}, {0, 0}};
}

TEST(JudgeBox, every_nearest_face_is_right_and_points_are_those_of_the_face) {
  const Query middle = in_unit_box({0.5, 0.5, 0.5});
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0}) {
      const Vector3 n = Vector3::Unit(axis) * sign;
      const Vector3 c(0.5, 0.5, 0.5);
      EXPECT_EQ(level_of(middle, contact_with(n, c + 2 * n, c - 0.5 * n)), Level::correctly_rounded);
      EXPECT_EQ(level_of(middle, contact_with(n, c + 2 * n, c + 0.5 * n)), Level::decisions);
      EXPECT_EQ(level_of(middle, contact_with(n, c - 2 * n, c - 0.5 * n)), Level::decisions);
    }
  EXPECT_EQ(level_of(middle, normal_of({0.6, 0.8, 0})), Level::decisions);
  EXPECT_EQ(level_of(middle, normal_of({1, 0x1p-50, 0})), Level::correctly_rounded);  // 8u = 2^-50
  EXPECT_EQ(level_of(middle, normal_of({1, 0x1.1p-46, 0})), Level::decisions);
  // So much is right of a normal of any length, however narrow its bound is.
  Declaration any_length = with([](Conventions& c) { c.normal_unit = false; });
  any_length.bounds.normal = 1;
  for (const double length : {0x1p-100, 1.0, 0x1p100}) {
    EXPECT_EQ(level_of(middle, normal_of(length * Vector3(1, 0x1p-50, 0)), any_length), Level::bounded);
    EXPECT_EQ(level_of(middle, normal_of(length * Vector3(1, 0x1.1p-50, 0)), any_length), Level::decisions);
    EXPECT_EQ(level_of(middle, normal_of(length * Vector3(0.6, 0.8, 0)), any_length), Level::decisions);
  }
}

TEST(JudgeBox, a_face_that_is_one_ulp_farther_is_wrong) {
  const Query left = in_unit_box({below(0.5), 0.5, 0.5});
  EXPECT_EQ(level_of(left, normal_of({1, 0, 0})), Level::correctly_rounded);
  EXPECT_EQ(level_of(left, normal_of({-1, 0, 0})), Level::decisions);
  EXPECT_EQ(level_of(left, normal_of({0, 1, 0})), Level::decisions);
}

TEST(JudgeBox, the_value_inside_counts_the_depth) {
  EXPECT_EQ(level_of(in_unit_box({0.25, 0.5, 0.5}), value_of(-2.25)), Level::correctly_rounded);
  EXPECT_EQ(level_of(in_unit_box({0.25, 0.5, 0.5}), value_of(-2)), Level::decisions);
  EXPECT_EQ(level_of(in_unit_box({1, 0.5, 0.5}), value_of(-2)), Level::correctly_rounded);
}

TEST(JudgeBox, on_a_corner_every_normal_that_separates_is_right) {
  const Query corner = in_unit_box({1, 1, 1});
  for (const Vector3& n : {Vector3(-1, 0, 0), Vector3(0, 0, -1), Vector3(-0.6, -0.8, 0), Vector3(-0.6, 0, -0.8)})
    EXPECT_EQ(level_of(corner, normal_of(n)), Level::correctly_rounded) << n.transpose();
  for (const Vector3& n : {Vector3(1, 0, 0), Vector3(-0.8, 0.6, 0), Vector3(0, -0.6, 0.8)})
    EXPECT_EQ(level_of(corner, normal_of(n)), Level::decisions) << n.transpose();
  EXPECT_EQ(level_of(corner, contact_with({0, 0, -1}, {1, 1, -1}, {1, 1, 1})), Level::correctly_rounded);
  EXPECT_EQ(level_of(corner, contact_with({0, 0, -1}, {1, 1, 3}, {1, 1, 1})), Level::decisions);
  // On a face there is one way out alone.
  EXPECT_EQ(level_of(in_unit_box({1, 0.5, 0.5}), normal_of({-1, 0, 0})), Level::correctly_rounded);
  EXPECT_EQ(level_of(in_unit_box({1, 0.5, 0.5}), normal_of({-0.6, -0.8, 0})), Level::decisions);
}

TEST(JudgeBox, a_normal_of_any_length_separates_by_its_direction) {
  const Query corner = in_unit_box({1, 1, 1});
  const Declaration any_length = with([](Conventions& c) { c.normal_unit = false; });
  for (const double length : {0x1p-100, 1.0, 0x1p100}) {
    for (const Vector3& n : {Vector3(-1, 0, 0), Vector3(-0.6, -0.8, 0), Vector3(-1, 0x1p-51, 0)})  // 8u = 2^-50
      EXPECT_EQ(level_of(corner, normal_of(length * n), any_length), Level::bounded) << length << ": " << n.transpose();
    for (const Vector3& n : {Vector3(1, 0, 0), Vector3(-0.8, 0.6, 0), Vector3(-1, 0x1p-49, 0)})
      EXPECT_EQ(level_of(corner, normal_of(length * n), any_length), Level::decisions)
          << length << ": " << n.transpose();
  }
}

TEST(JudgeBox, conventions_of_coincidence_speak_of_the_boundary_and_not_of_the_inside) {
  const Declaration silent = with([](Conventions& c) { c.coincident = Coincident::no_contact; });
  EXPECT_EQ(level_of(in_unit_box({1, 1, 1}), no_contact(), silent), Level::correctly_rounded);
  EXPECT_EQ(level_of(in_unit_box({0.5, 0.5, 0.5}), no_contact(), silent), Level::none);
  const Declaration zero = with([](Conventions& c) { c.coincident = Coincident::zero_normal; });
  EXPECT_EQ(level_of(in_unit_box({1, 1, 1}), normal_of({0, 0, 0}), zero), Level::correctly_rounded);
  EXPECT_EQ(level_of(in_unit_box({0.5, 0.5, 0.5}), normal_of({0, 0, 0}), zero), Level::decisions);
}

TEST(JudgeBox, a_point_inside_is_no_matter_of_open_or_closed) {
  const Declaration open = with([](Conventions& c) { c.touching_overlap = Touching::open; });
  EXPECT_EQ(level_of(in_unit_box({0.5, 0.5, 0.5}, 0), overlap(true), open), Level::correctly_rounded);
  EXPECT_EQ(level_of(in_unit_box({1, 0.5, 0.5}, 0), overlap(true), open), Level::conservative);
  EXPECT_EQ(level_of(in_unit_box({1, 0.5, 0.5}, 0), overlap(false), open), Level::correctly_rounded);
}

// Capsules.

const Capsule kAlongX{{0, 0, 0}, {3, 0, 0}, 1};
// Two apart along z, side by side from x = 1 to 3.
Query side_by_side() { return {Pair::capsule_capsule, Capsules{kAlongX, {{1, 0, 2}, {5, 0, 2}, 1}}, {0, 0}}; }
Claim with_points(const Vector3& p1, const Vector3& p2) { return contact_with({0, 0, 1}, p1, p2); }

TEST(JudgeCapsules, side_by_side_every_nearest_point_is_right_and_no_other) {
  for (const double x : {1.0, 1.7, 2.0, 2.9999999999, 3.0})
    EXPECT_EQ(level_of(side_by_side(), with_points({x, 0, 1}, {2.5, 0, 1})), Level::correctly_rounded) << x;
  EXPECT_EQ(level_of(side_by_side(), with_points({2, 0, 1}, {1, 0, 1})), Level::correctly_rounded);
  // Past the end by one ulp, by two, and farther; off the segment.
  EXPECT_EQ(level_of(side_by_side(), with_points({below(1), 0, 1}, {2, 0, 1})), Level::bounded);
  EXPECT_EQ(level_of(side_by_side(), with_points({3 + 0x1p-50, 0, 1}, {2, 0, 1})), Level::bounded);
  EXPECT_EQ(level_of(side_by_side(), with_points({3.25, 0, 1}, {2, 0, 1})), Level::decisions);
  EXPECT_EQ(level_of(side_by_side(), with_points({2, 0, 1}, {2, 0.5, 1})), Level::decisions);
  EXPECT_EQ(level_of(side_by_side(), with_points({2, 0, 1}, {2, 0, above(1)})), Level::bounded);
}

TEST(JudgeCapsules, one_point_must_be_right_in_all_three_coordinates) {
  // Along (1, 1, 0), from 0 to 2, and as long beside it.
  const Query diagonal{Pair::capsule_capsule, Capsules{{{0, 0, 0}, {2, 2, 0}, 1}, {{0, 0, 2}, {2, 2, 2}, 1}}, {0, 0}};
  EXPECT_EQ(level_of(diagonal, with_points({0.3, 0.3, 1}, {1.9, 1.9, 1})), Level::correctly_rounded);
  EXPECT_EQ(level_of(diagonal, with_points({0.3, 0.7, 1}, {1, 1, 1})), Level::decisions);
  // Between two doubles lies no other point of the set that rounds to both.
  EXPECT_EQ(level_of(diagonal, with_points({0.3, above(0.3), 1}, {1, 1, 1})), Level::faithful);
  // What is off counts from the best point of all: (0.5, 0.5, 1) for (0.25, 0.75, 1), a quarter.
  const Verdict off = judge(diagonal, truth_of(diagonal), with_points({0.25, 0.75, 1}, {1, 1, 1}), {});
  EXPECT_EQ(off.at(Field::point1)->error, 0.25 * 0x1p51);  // the scale is 2, whose ulp is 2^-51
}

TEST(JudgeCapsules, on_an_axis_what_separates_is_right) {
  const Query on_axis{Pair::sphere_capsule, BallAndCapsule{{{1, 0, 0}, 2}, kAlongX}, {0, 0}};
  for (const Vector3& n : {Vector3(0, 1, 0), Vector3(0, 0, -1), Vector3(0, 0.6, -0.8)})
    EXPECT_EQ(level_of(on_axis, normal_of(n)), Level::correctly_rounded) << n.transpose();
  for (const Vector3& n : {Vector3(1, 0, 0), Vector3(0.6, 0.8, 0), Vector3(-0.6, 0, 0.8)})
    EXPECT_EQ(level_of(on_axis, normal_of(n)), Level::decisions) << n.transpose();
  // At the start of the axis a normal may lean along it, from the sphere to the capsule, and not back.
  const Query at_end{Pair::sphere_capsule, BallAndCapsule{{{0, 0, 0}, 2}, kAlongX}, {0, 0}};
  EXPECT_EQ(level_of(at_end, normal_of({0.6, 0.8, 0})), Level::correctly_rounded);
  EXPECT_EQ(level_of(at_end, normal_of({1, 0, 0})), Level::correctly_rounded);
  EXPECT_EQ(level_of(at_end, normal_of({-0.6, 0.8, 0})), Level::decisions);
}

TEST(JudgeCapsules, axes_that_cross_have_two_normals_and_their_points) {
  const Query crossing{Pair::capsule_capsule, Capsules{kAlongX, {{1, -1, 0}, {1, 1, 0}, 2}}, {0, 0}};
  EXPECT_EQ(level_of(crossing, with_points({1, 0, 1}, {1, 0, -2})), Level::correctly_rounded);
  EXPECT_EQ(level_of(crossing, normal_of({0, 0, -1})), Level::correctly_rounded);
  EXPECT_EQ(level_of(crossing, normal_of({0, 1, 0})), Level::decisions);
  EXPECT_EQ(level_of(crossing, with_points({1, 0, -1}, {1, 0, -2})), Level::decisions);
  // On one line, from 1 to 3: any point there, and any normal at right angles.
  const Query collinear{Pair::capsule_capsule, Capsules{kAlongX, {{1, 0, 0}, {5, 0, 0}, 2}}, {0, 0}};
  EXPECT_EQ(level_of(collinear, with_points({1.5, 0, 1}, {3, 0, -2})), Level::correctly_rounded);
  EXPECT_EQ(level_of(collinear, with_points({0.5, 0, 1}, {3, 0, -2})), Level::decisions);
}

TEST(JudgeCapsules, far_points_of_the_reference_are_right_where_it_had_to_be_rounded) {
  // Along (1, 1, 0), the normal (1, -1, 0) / sqrt(2); the far points of a radius of 7 are 7 / sqrt(2) off.
  const double half = 0.707106781186547524400844362105;
  const double far = 4.94974746830583267080591053473;
  const Query on_axis{Pair::sphere_capsule, BallAndCapsule{{{0, 0, 0}, 7}, {{-1, -1, 0}, {1, 1, 0}, 7}}, {0, 0}};
  const Claim claim = contact_with({half, -half, 0}, {-far, far, 0}, {far, -far, 0});
  EXPECT_EQ(level_of(on_axis, claim, with_points(Points::published)), Level::correctly_rounded);
}

/// Where the rounded answer is known, and so the reference's normal.
Level level_beside_reference(const Query& query, const Claim& claim, Points points) {
  const Truth truth = truth_of(query);
  const Expectation rounded = expectation(truth, Scalar::binary64);
  return judge(query, truth, claim, of_these(claim, with_points(points)), &rounded).level();
}

TEST(JudgeTriangles, far_points_and_midpoints_of_the_reference_are_right_where_its_normal_has_lost_a_component) {
  // Across (2^600, 0, -2^-500) and (0, 1, 0) the normal is (2^-1100, 0, 1), nearly, of which the first is rounded to 0.
  const Query slightly_tilted{
      Pair::sphere_triangle,
      BallAndTriangle{{{0, 0, 0}, 0x1p700}, {{{{0, 0, 0}, {0x1p600, 0, -0x1p-500}, {0, 1, 0}}}}},
      {0, 0}};
  const Vector3 n(0, 0, 1);
  const auto of_far = [&](double x) {
    return level_beside_reference(slightly_tilted, contact_with(n, {x, 0, -0x1p700}, {0, 0, 0}), Points::published);
  };
  EXPECT_EQ(of_far(-0x1p-400), Level::correctly_rounded);
  EXPECT_EQ(of_far(0x1p-400), Level::bounded);
  EXPECT_EQ(level_beside_reference(slightly_tilted, normal_and_midpoint(n, {0x1p-401, 0, 0x1p699}), Points::midpoint),
            Level::correctly_rounded);
}

TEST(JudgeTriangles, far_points_of_the_reference_are_right_beside_an_overflow) {
  // Across (1, 1, 0); 3 / sqrt(2) is not 3 times 1 / sqrt(2) rounded.
  const double half = 0.707106781186547524400844362105;
  const double far = 2.12132034355964257320253308631 * 0x1p1022;
  const Vector3 center(-0x1p1023, 0, 0);
  const Query at_the_end{Pair::sphere_triangle,
                         BallAndTriangle{{center, 3 * 0x1p1022},
                                         {{{center, {-0x1p1023 + 0x1p1000, -0x1p1000, 0}, {-0x1p1023, 0, 0x1p1000}}}}},
                         {0, 0}};
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(level_beside_reference(at_the_end, contact_with({half, half, 0}, {-infinity, -far, 0}, center),
                                   Points::published),
            Level::correctly_rounded);
}

TEST(JudgeCapsules, points_may_be_those_of_a_normal_before_it_was_rounded) {
  // (0, 1, 2) / sqrt(5) and twice it: 2 / sqrt(5) rounded is not twice 1 / sqrt(5) rounded plus the radius's share.
  const double x = 0.447213595499957939281834733746;
  const double y = 0.894427190999915878563669467493;
  const Query on_axis{Pair::sphere_capsule, BallAndCapsule{{{1, 0, 0}, 1000}, kAlongX}, {0, 0}};
  const auto claimed = [&](double p) { return contact_with({0, x, y}, {1, p, 894.427190999915878563669467493}); };
  EXPECT_EQ(level_of(on_axis, claimed(447.213595499957939281834733746)), Level::correctly_rounded);
  EXPECT_EQ(level_of(on_axis, claimed(447.2135954999)), Level::decisions);
}

TEST(JudgeTriangles, on_a_triangle_what_separates_is_right) {
  const Triangle flat{{Vector3(0, 0, 0), Vector3(4, 0, 0), Vector3(0, 4, 0)}};
  const auto at = [&](const Vector3& c) { return Query{Pair::sphere_triangle, BallAndTriangle{{c, 2}, flat}, {0, 0}}; };
  // On the face its two normals; on an edge half of a circle, from outside in; at a vertex a cone.
  for (const double z : {1, -1})
    EXPECT_EQ(level_of(at({1, 1, 0}), normal_of({0, 0, z})), Level::correctly_rounded) << z;
  for (const Vector3& n : {Vector3(0, 0.6, 0.8), Vector3(1, 0, 0), Vector3(0, -0.6, 0.8)})
    EXPECT_EQ(level_of(at({1, 1, 0}), normal_of(n)), Level::decisions) << n.transpose();
  for (const Vector3& n : {Vector3(0, 0.6, 0.8), Vector3(0, 1, 0), Vector3(0, 0, -1)})
    EXPECT_EQ(level_of(at({2, 0, 0}), normal_of(n)), Level::correctly_rounded) << n.transpose();
  for (const Vector3& n : {Vector3(0, -0.6, 0.8), Vector3(0.6, 0.8, 0)})
    EXPECT_EQ(level_of(at({2, 0, 0}), normal_of(n)), Level::decisions) << n.transpose();
  for (const Vector3& n : {Vector3(0.6, 0.8, 0), Vector3(1, 0, 0), Vector3(0.6, 0, -0.8)})
    EXPECT_EQ(level_of(at({0, 0, 0}), normal_of(n)), Level::correctly_rounded) << n.transpose();
  EXPECT_EQ(level_of(at({0, 0, 0}), normal_of({0.8, -0.6, 0})), Level::decisions);
  // Where all three vertices are the centre nothing can be on the wrong side.
  const Vector3 here(1, 2, 3);
  const Query point{Pair::sphere_triangle, BallAndTriangle{{here, 2}, {{here, here, here}}}, {0, 0}};
  EXPECT_EQ(level_of(point, normal_of({0.6, 0, -0.8})), Level::correctly_rounded);
}

TEST(JudgeTriangles, beside_it_one_normal_is_right_whatever_the_winding) {
  for (const Triangle& triangle : {Triangle{{Vector3(0, 0, 0), Vector3(4, 0, 0), Vector3(0, 4, 0)}},
                                   Triangle{{Vector3(0, 0, 0), Vector3(0, 4, 0), Vector3(4, 0, 0)}}}) {
    const Query above_it{Pair::sphere_triangle, BallAndTriangle{{{1, 1, 1}, 2}, triangle}, {0, 0}};
    EXPECT_EQ(level_of(above_it, normal_of({0, 0, -1})), Level::correctly_rounded);
    EXPECT_EQ(level_of(above_it, normal_of({0, 0, 1})), Level::decisions);
  }
}

TEST(JudgeRays, on_a_ray_what_separates_is_right) {
  const auto at = [](double x) {
    return Query{Pair::ray_sphere, RayAndBall{{{0, 0, 0}, {2, 0, 0}, 2}, {{x, 0, 0}, 1}}, {0, 0}};
  };
  for (const Vector3& n : {Vector3(0, 1, 0), Vector3(0, 0.6, -0.8)})
    EXPECT_EQ(level_of(at(1), normal_of(n)), Level::correctly_rounded) << n.transpose();
  EXPECT_EQ(level_of(at(1), normal_of({0.6, 0.8, 0})), Level::decisions);
  // The end is at 4: the sphere may go on there, and at the origin back.
  EXPECT_EQ(level_of(at(4), normal_of({1, 0, 0})), Level::correctly_rounded);
  EXPECT_EQ(level_of(at(4), normal_of({-1, 0, 0})), Level::decisions);
  EXPECT_EQ(level_of(at(0), normal_of({-0.6, 0.8, 0})), Level::correctly_rounded);
  EXPECT_EQ(level_of(at(0), normal_of({0.6, 0.8, 0})), Level::decisions);
}

TEST(JudgePlanes, below_a_plane_the_distance_is_signed_and_the_normal_stays) {
  const auto at = [](double z) {
    return Query{Pair::sphere_plane, BallAndPlane{{{1, 2, z}, 1}, {{0, 0, 2}, 4}}, {0, 0.5}};  // z = 2
  };
  for (const double z : {3.0, 2.0, -3.0}) {
    EXPECT_EQ(level_of(at(z), normal_of({0, 0, -1})), Level::correctly_rounded) << z;
    EXPECT_EQ(level_of(at(z), normal_of({0, 0, 1})), Level::decisions) << z;
    EXPECT_EQ(level_of(at(z), points_of({1, 2, z - 1}, {1, 2, 2})), Level::correctly_rounded) << z;
    EXPECT_EQ(level_of(at(z), value_of(z - 2 - 1 - 0.5)), Level::correctly_rounded) << z;
  }
  EXPECT_EQ(level_of(at(-3), value_of(5 - 1 - 0.5)), Level::decisions);
  EXPECT_EQ(level_of(at(-3), no_contact()), Level::none);
  EXPECT_EQ(level_of(at(3.5), normal_of({0, 0, -1})), Level::conservative);
}

TEST(JudgePlanes, along_a_plane_every_point_of_the_axis_is_right_and_no_other) {
  const Query level{Pair::capsule_plane, CapsuleAndPlane{{{0, 0, 3}, {4, 0, 3}, 1}, {{0, 0, 1}, 2}}, {0, 0}};
  for (const double x : {0.0, 2.0, 3.5, 4.0})
    EXPECT_EQ(level_of(level, points_of({x, 0, 2}, {x, 0, 2})), Level::correctly_rounded) << x;
  EXPECT_EQ(level_of(level, points_of({4.5, 0, 2}, {4.5, 0, 2})), Level::decisions);
  const Query tilted{Pair::capsule_plane, CapsuleAndPlane{{{0, 0, 3}, {4, 0, 4}, 1}, {{0, 0, 1}, 2}}, {0, 0}};
  EXPECT_EQ(level_of(tilted, points_of({0, 0, 2}, {0, 0, 2})), Level::correctly_rounded);
  EXPECT_EQ(level_of(tilted, points_of({2, 0, 2}, {2, 0, 2})), Level::decisions);
}

TEST(JudgeCrossings, have_one_point_and_the_normal_of_the_vertices_whatever_the_distances_and_conventions) {
  const Triangle face{{Vector3(0, 0, 0), Vector3(4, 0, 0), Vector3(0, 4, 0)}};
  const Query edge{Pair::triangle_line, TriangleAndLine{face, {{2, 0, 1}, {2, 0, -1}}}, {3, 7}};
  EXPECT_EQ(level_of(edge, normal_of({0, 0, 1})), Level::correctly_rounded);
  EXPECT_EQ(level_of(edge, normal_of({0, 0, -1})), Level::decisions);
  EXPECT_EQ(level_of(edge, points_of({2, 0, 0}, {2, 0, 0})), Level::correctly_rounded);
  EXPECT_EQ(level_of(edge, points_of({2, 0, 0}, {2, 0, 0.5})), Level::decisions);
  EXPECT_EQ(level_of(edge, value_of(0)), Level::correctly_rounded);
  EXPECT_EQ(level_of(edge, value_of(-7)), Level::decisions);
  EXPECT_EQ(level_of(edge, no_contact()), Level::none);
  const Query ray{Pair::ray_triangle, RayAndTriangle{{{1, 1, 1}, {0, 0, -1}, 2}, face}, {0, 0}};
  EXPECT_EQ(level_of(ray, normal_of({0, 0, -1})), Level::correctly_rounded);
  EXPECT_EQ(level_of(ray, normal_of({0, 0, 1})), Level::decisions);
  // Within the alarm distance, but beside it.
  const Query beside{Pair::triangle_line, TriangleAndLine{face, {{2, -1, 1}, {2, -1, -1}}}, {3, 0}};
  EXPECT_EQ(level_of(beside, no_contact()), Level::correctly_rounded);
  EXPECT_EQ(level_of(beside, normal_of({0, 0, 1})), Level::conservative);
}

TEST(JudgeCasts, have_t_the_point_and_each_normal_that_points_away_whatever_the_distances_and_conventions) {
  const auto cast = [](const auto& shape, Pair pair, const Vector3& origin, const Vector3& direction) {
    return Query{pair, CastAt<std::remove_cvref_t<decltype(shape)>>{{{origin, direction, 9}}, shape}, {3, 7}};
  };
  const Query ball = cast(Ball{{6, 0, 0}, 1}, Pair::cast_sphere, {0, 0, 0}, {2, 0, 0});
  EXPECT_EQ(level_of(ball, value_of(2.5)), Level::correctly_rounded);
  EXPECT_EQ(level_of(ball, value_of(5)), Level::decisions);
  EXPECT_EQ(level_of(ball, value_of(-4.5)), Level::decisions);
  EXPECT_EQ(level_of(ball, points_of({5, 0, 0}, {5, 0, 0})), Level::correctly_rounded);
  EXPECT_EQ(level_of(ball, points_of({5, 0, 0}, {7, 0, 0})), Level::decisions);
  EXPECT_EQ(level_of(ball, normal_of({-1, 0, 0})), Level::correctly_rounded);
  EXPECT_EQ(level_of(ball, normal_of({1, 0, 0})), Level::decisions);
  EXPECT_EQ(level_of(ball, no_contact()), Level::none);
  // On an edge all that points away from both faces, and nothing else.
  const Query edge = cast(Box{{2, 2, -1}, {3, 3, 1}}, Pair::cast_cube, {0, 0, 0}, {1, 1, 0});
  for (const Vector3& n : {Vector3(-1, 0, 0), Vector3(0, -1, 0), Vector3(-0.6, -0.8, 0)})
    EXPECT_EQ(level_of(edge, normal_of(n)), Level::correctly_rounded) << n;
  for (const Vector3& n : {Vector3(0.6, -0.8, 0), Vector3(0, 0, -1), Vector3(0, -0.5, 0)})
    EXPECT_EQ(level_of(edge, normal_of(n)), Level::decisions) << n;
  // Inside a face one, of a triangle both.
  const Query face = cast(Box{{2, -2, -1}, {3, 3, 1}}, Pair::cast_cube, {0, 0, 0}, {1, 1, 0});
  EXPECT_EQ(level_of(face, normal_of({-0.6, -0.8, 0})), Level::decisions);
  const Triangle triangle{{Vector3(0, 0, 0), Vector3(4, 0, 0), Vector3(0, 4, 0)}};
  const Query through = cast(triangle, Pair::cast_triangle, {1, 1, 1}, {0, 0, -1});
  for (const double side : {-1.0, 1.0}) EXPECT_EQ(level_of(through, normal_of({0, 0, side})), Level::correctly_rounded);
  EXPECT_EQ(level_of(through, normal_of({0, 0.6, 0.8})), Level::decisions);
  // From inside any.
  const Query inside = cast(Plane{{0, 0, 1}, 5}, Pair::cast_plane, {1, 1, 1}, {0, 0, -1});
  EXPECT_EQ(level_of(inside, normal_of({0, 0.6, -0.8})), Level::correctly_rounded);
  EXPECT_EQ(level_of(inside, normal_of({0, 0.6, 0})), Level::decisions);
  EXPECT_EQ(level_of(inside, value_of(0)), Level::correctly_rounded);
  EXPECT_EQ(level_of(inside, points_of({1, 1, 1}, {1, 1, 1})), Level::correctly_rounded);
}

// ---- any two convex shapes ----

Query boxes_turned(const Obb& a, const Obb& b) { return {Pair::obb_obb, Convexes{{a}, {b}}, {0, 0}}; }
const Quaternion kNotTurned{0, 0, 0, 1};

TEST(Judge, of_several_ways_out_each_is_right) {
  // About one centre: six ways are as short. Each goes with points of its own.
  const Query same = boxes_turned({{0, 0, 0}, kNotTurned, {1, 1, 1}}, {{0, 0, 0}, kNotTurned, {1, 1, 1}});
  for (const double side : {1.0, -1.0})
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3 n = side * Vector3::Unit(axis);
      EXPECT_EQ(level_of(same, contact_with(n, n, -n)), Level::correctly_rounded) << n.transpose();
      EXPECT_EQ(level_of(same, points_of(n, -n)), Level::correctly_rounded) << n.transpose();
      EXPECT_EQ(level_of(same, contact_with(n, -n, n)), Level::decisions) << n.transpose();
    }
  EXPECT_EQ(level_of(same, value_of(-2)), Level::correctly_rounded);
  EXPECT_EQ(level_of(same, normal_of({0.6, 0.8, 0})), Level::decisions);
}

TEST(Judge, a_point_of_a_polygon_is_right) {
  // Faces that share the square from (1,0,0) to (1,1,1), half a unit apart.
  Query faces = boxes_turned({{0, 0, 0}, kNotTurned, {1, 1, 1}}, {{2.5, 1, 1}, kNotTurned, {1, 1, 1}});
  faces.distances.alarm = 1;
  const auto at = [](double y, double z) { return contact_with({1, 0, 0}, {1, y, z}, {1.5, y, z}); };
  for (const double y : {0.0, 0.3, 1.0})
    for (const double z : {0.0, 0.7, 1.0}) EXPECT_EQ(level_of(faces, at(y, z)), Level::correctly_rounded) << y << z;
  EXPECT_EQ(level_of(faces, at(-0x1p-52, 0.5)), Level::bounded);
  EXPECT_EQ(level_of(faces, at(1.25, 0.5)), Level::decisions);
  EXPECT_EQ(level_of(faces, at(0.5, -0.25)), Level::decisions);
  // A triangle's corner cuts the set: what lies between the bounds of its coordinates is not all of it.
  const Triangle corner{{Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0)}};
  const Triangle above{{Vector3(0, 0, 2), Vector3(1, 0, 2), Vector3(0, 1, 2)}};
  const Query triangles{Pair::triangle_triangle, Convexes{{corner}, {above}}, {2, 0}};
  EXPECT_EQ(level_of(triangles, contact_with({0, 0, 1}, {0.25, 0.75, 0}, {0.5, 0.5, 2})), Level::correctly_rounded);
  EXPECT_EQ(level_of(triangles, contact_with({0, 0, 1}, {0.75, 0.75, 0}, {0.5, 0.5, 2})), Level::decisions);
  EXPECT_EQ(judged(triangles, contact_with({0, 0, 1}, {0.75, 0.75, 0}, {0.5, 0.5, 2})).at(Field::point1)->error,
            0.25 * 0x1p51);
}

// They overlap by 0.5 along x, by 1.5 along y and by 2 along z.
Query overlapping_boxes() {
  return boxes_turned({{0, 0, 0}, kNotTurned, {1, 1, 1}}, {{1.5, 0.5, 0}, kNotTurned, {1, 1, 1}});
}
const Declaration kAnySeparating = with([](Conventions& c) { c.depth = DepthOf::any_separating; });

TEST(JudgeDepth, of_any_normal_that_parts_the_shapes_is_right_where_so_declared_and_bounded_at_best) {
  const Query boxes = overlapping_boxes();
  struct {
    Vector3 n, p1, p2;
    double value;
  } const ways[]{{{1, 0, 0}, {1, 0.25, 0}, {0.5, 0.25, 0}, -0.5},
                 {{0, 1, 0}, {-1, 1, 1}, {2.5, -0.5, 0}, -1.5},  // points that do not face each other
                 {{-1, 0, 0}, {-1, 0, 0}, {2.5, 0, 0}, -3.5},
                 {{0.6, 0.8, 0}, {1, 1, 0.5}, {0.5, -0.5, -0.5}, -1.5}};
  for (const auto& [n, p1, p2, value] : ways) {
    EXPECT_EQ(level_of(boxes, contact_with(n, p1, p2, value), kAnySeparating), Level::bounded) << n.transpose();
    EXPECT_EQ(level_of(boxes, contact_with(n, p1, p2, value)), n[0] == 1 ? Level::correctly_rounded : Level::decisions)
        << n.transpose();
  }
  const auto wrong = [&](Field field, const Claim& claim, const Declaration& declared = kAnySeparating) {
    const Verdict verdict = judged(boxes, claim, declared);
    for (const Field other : kFields)
      EXPECT_EQ(verdict.at(other) && verdict.at(other)->grade > Grade::bounded, other == field) << name(other);
  };
  wrong(Field::value, contact_with({0, 1, 0}, {0, 1, 0}, {1, -0.5, 0}, -0.5));
  wrong(Field::value, contact_with({0, 1, 0}, {0, 1, 0}, {1, -0.5, 0}, -1.6));
  wrong(Field::point1, contact_with({0, 1, 0}, {0, 0.5, 0}, {1, -0.5, 0}, -1.5));
  wrong(Field::point1, contact_with({0, 1, 0}, {1.5, 1, 0}, {1, -0.5, 0}, -1.5));
  wrong(Field::point2, contact_with({0, 1, 0}, {0, 1, 0}, {1, 1.5, 0}, -1.5));
  wrong(Field::normal, contact_with({0, 1.01, 0}, {0, 1, 0}, {1, -0.5, 0}, -1.5));
  wrong(Field::normal, contact_with({0, 0, 0}, {1, 0.25, 0}, {0.5, 0.25, 0}, -0.5));
  // Who claims no normal says nothing of another direction.
  wrong(Field::value, value_of(-1.5));
  EXPECT_EQ(level_of(boxes, value_of(-0.5), kAnySeparating), Level::correctly_rounded);
}

TEST(JudgeDepth, of_any_normal_is_measured_by_the_bound_and_by_what_the_bound_of_the_normal_changes) {
  const Query boxes = overlapping_boxes();
  // Corners are at most 3.5 + 2.5 + 2 = 8 apart: the value may be off by 8 ulp(1.5), and by 8 ulp(1) in each component of
  // the normal times that, 72 * 2^-52.
  const auto with_value = [&](double value) {
    return level_of(boxes, contact_with({0, 1, 0}, {0, 1, 0}, {1, -0.5, 0}, value), kAnySeparating);
  };
  EXPECT_EQ(with_value(-1.5 + 72 * 0x1p-52), Level::bounded);
  EXPECT_EQ(with_value(-1.5 + 73 * 0x1p-52), Level::decisions);
  // 8 ulp(1) for the length of a normal along an axis; of others each component has as much.
  const auto grade_of = [&](const Vector3& n) {
    return judged(boxes, normal_of(n), kAnySeparating).at(Field::normal)->grade;
  };
  EXPECT_EQ(grade_of({0, 1 + 8 * 0x1p-52, 0}), Grade::bounded);
  EXPECT_EQ(grade_of({0, 1 + 9 * 0x1p-52, 0}), Grade::beyond_bound);
  EXPECT_EQ(grade_of({0, 1 - 9 * 0x1p-52, 0}), Grade::beyond_bound);
  EXPECT_EQ(grade_of(Vector3(0.6, 0.8, 0) * (1 + 9 * 0x1p-52)), Grade::bounded);
  EXPECT_EQ(grade_of(Vector3(0.6, 0.8, 0) * (1 + 12 * 0x1p-52)), Grade::beyond_bound);
  // 8 ulp(2.5), the largest coordinate
  const auto with_point = [&](const Vector3& n, const Vector3& p1) {
    return level_of(boxes, contact_with(n, p1, {0.5, -0.5, 0}, -1.5), kAnySeparating);
  };
  EXPECT_EQ(with_point({0, 1, 0}, {0, 1 + 0x1p-48, 0}), Level::bounded);
  EXPECT_EQ(with_point({0, 1, 0}, {0, above(1 + 0x1p-48), 0}), Level::decisions);
  // A normal that may have been that of the face: 2^-49 is its bound. One that is surely another has an edge.
  EXPECT_EQ(with_point({0x1p-49, 1, 0}, {-1, 1, 0}), Level::bounded);
  EXPECT_EQ(with_point({0x1p-47, 1, 0}, {1, 1, 0}), Level::bounded);
  EXPECT_EQ(with_point({0x1p-40, 1, 0}, {1, 1, 0}), Level::decisions) << "its depth is more by 2^-41";
  const auto point1 = [&](double turned, double x) {
    return judged(boxes, contact_with({turned, 1, 0}, {x, 1, 0}, {0.5, -0.5, 0}), kAnySeparating)
        .at(Field::point1)
        ->grade;
  };
  EXPECT_EQ(point1(0x1p-40, 1), Grade::bounded);
  EXPECT_EQ(point1(0x1p-40, -1), Grade::beyond_bound);
  // The corner is 2^-47 short, of which the bound of the normal explains 2^-48, and the bound of the point the rest.
  EXPECT_EQ(point1(0x1p-48, -1), Grade::bounded);
  EXPECT_EQ(point1(0x1p-47, -1), Grade::beyond_bound);
}

TEST(JudgeDepth, of_any_normal_goes_with_the_other_conventions) {
  const Query boxes = overlapping_boxes();
  Declaration declared = kAnySeparating;
  declared.conventions.normal = NormalDirection::second_to_first;
  declared.conventions.value = ValueKind::depth;
  EXPECT_EQ(level_of(boxes, contact_with({0, -1, 0}, {0, 1, 0}, {1, -0.5, 0}, 1.5), declared), Level::bounded);
  EXPECT_EQ(level_of(boxes, contact_with({0, -1, 0}, {0, 1, 0}, {1, -0.5, 0}, -1.5), declared), Level::decisions);
  declared = kAnySeparating;
  declared.conventions.normal_unit = false;
  EXPECT_EQ(level_of(boxes, contact_with({0, 3, 0}, {0, 1, 0}, {1, -0.5, 0}, -1.5), declared), Level::bounded);
  // The middle of any two: x from (-1 + 0.5) / 2 to (1 + 2.5) / 2.
  declared = kAnySeparating;
  declared.conventions.points = Points::midpoint;
  const auto middle = [&](const Vector3& p) { return level_of(boxes, normal_and_midpoint({0, 1, 0}, p), declared); };
  EXPECT_EQ(middle({1.75, 0.25, 1}), Level::bounded);
  EXPECT_EQ(middle({-0.25, 0.25, -1}), Level::bounded);
  EXPECT_EQ(middle({1.8, 0.25, 0}), Level::decisions);
  EXPECT_EQ(middle({0.5, 0.3, 0}), Level::decisions);
  // An axis within a box, blown up by 0.25, and a contact distance.
  const Query capsule{Pair::capsule_obb,
                      Convexes{{Capsule{{-0.5, 0, 0}, {0.5, 0, 0}, 0.25}}, {Obb{{0, 0.5, 0}, kNotTurned, {1, 1, 1}}}},
                      {0, 0.125}};
  EXPECT_EQ(level_of(capsule, contact_with({1, 0, 0}, {0.75, 0, 0}, {-1, 1, 1}, -1.875), kAnySeparating),
            Level::bounded);
  EXPECT_EQ(level_of(capsule, contact_with({1, 0, 0}, {0.5, 0, 0}, {-1, 1, 1}, -1.875), kAnySeparating),
            Level::decisions);
  EXPECT_EQ(level_of(capsule, contact_with({1, 0, 0}, {0.75, 0, 0}, {-1, 1, 1}, -1.75), kAnySeparating),
            Level::decisions);
}

TEST(JudgeDepth, of_any_normal_has_the_middle_of_points_on_a_radius) {
  // As above: from the end of the capsule, (0.75,0,0), to the face x = -1 of the box, y from -0.5 to 1.5.
  const Query capsule{Pair::capsule_obb,
                      Convexes{{Capsule{{-0.5, 0, 0}, {0.5, 0, 0}, 0.25}}, {Obb{{0, 0.5, 0}, kNotTurned, {1, 1, 1}}}},
                      {0, 0}};
  Declaration declared = kAnySeparating;
  declared.conventions.points = Points::midpoint;
  const auto middle = [&](double x, double y) {
    const Vector3 p(x, y, 0);
    return level_of(capsule, normal_and_midpoint({1, 0, 0}, p), declared);
  };
  EXPECT_EQ(middle(-0.125, 0.5), Level::bounded);
  EXPECT_EQ(middle(-0.375, 0.5), Level::decisions);
  EXPECT_EQ(middle(-0.125, 0.8), Level::decisions);
}

TEST(JudgeDepth, of_any_normal_says_nothing_where_the_cores_do_not_overlap) {
  // Faces that touch, and such that are half a unit apart.
  for (const double x : {2.0, 2.5}) {
    Query boxes = boxes_turned({{0, 0, 0}, kNotTurned, {1, 1, 1}}, {{x, 0, 0}, kNotTurned, {1, 1, 1}});
    boxes.distances.alarm = 1;
    const double y = 0.25;
    EXPECT_EQ(level_of(boxes, contact_with({1, 0, 0}, {1, y, 0}, {x - 1, y, 0}, x - 2), kAnySeparating),
              Level::correctly_rounded);
    EXPECT_EQ(level_of(boxes, normal_of({0, 1, 0}), kAnySeparating), Level::decisions);
    EXPECT_EQ(level_of(boxes, normal_of({1, 0, 0}), kAnySeparating), Level::correctly_rounded);
  }
}

TEST(JudgeDepth, of_the_shortest_way_is_that_of_a_normal_too) {
  Query boxes =
      boxes_turned({{0, 0, 0}, kNotTurned, {1, 1, 1}}, {{1.2, 0.1, 0.3}, {0.1, 0.2, 0.3, 0.9}, {1, 0.5, 0.7}});
  for (const Vector3& c : {Vector3(1.2, 0.1, 0.3), Vector3(0.7, 1.1, -0.4), Vector3(1, 1, 1), Vector3(1e3, 0, 0)})
    for (const Scalar scalar : kScalars)
      for (const Points points : {Points::nearest_surface, Points::midpoint}) {
        std::get<Obb>(std::get<Convexes>(boxes.shapes).b.shape).center = c - Vector3(c[0] > 2 ? 998.9 : 0, 0, 0);
        Declaration declared = with_points(points);
        declared.scalar = scalar;
        const Claim right = right_claim(boxes, truth_of(boxes), declared);
        declared.conventions.depth = DepthOf::any_separating;
        EXPECT_EQ(level_of(boxes, right, declared), Level::bounded) << c.transpose() << name(scalar);
      }
}

TEST(JudgeConventions, an_answer_that_parts_the_shapes_along_another_face_is_explained) {
  const Claim other = contact_with({0, 1, 0}, {0, 1, 0}, {1, -0.5, 0}, -1.5);
  for (const char* field : {"normal", "point1", "point2", "value"})
    EXPECT_TRUE(says(explained(overlapping_boxes(), other), field, "depth", "any_separating")) << field;
  EXPECT_TRUE(explained(overlapping_boxes(), other, kAnySeparating).empty());
}

// ---- several points ----

Claim manifold_of(const Vector3& n, std::vector<ManifoldPoint> points) {
  ContactClaim contact;
  contact.normal = n;
  contact.points = std::move(points);
  return contact_of(std::move(contact));
}
const Declaration kManifold = with_points(Points::manifold);

TEST(JudgeManifold, has_points_between_both_surfaces_and_their_depths) {
  // A box on another, shifted: 0.25 deep along z, over x from -0.5 to 1 and y from -1 to 1.
  const Query boxes = boxes_turned({{0, 0, 0}, kNotTurned, {1, 1, 1}}, {{0.5, 0, 1.25}, kNotTurned, {1, 1, 0.5}});
  const auto grade_of = [&](std::vector<ManifoldPoint> points) {
    return judged(boxes, manifold_of({0, 0, 1}, std::move(points)), kManifold).at(Field::points)->grade;
  };
  // On the upper surface of the first, on the lower one of the second, or in the middle.
  for (const double z : {1.0, 0.75, 0.875})
    EXPECT_EQ(grade_of({{{-0.5, -1, z}, 0.25}, {{-0.5, 1, z}, 0.25}, {{1, 1, z}, 0.25}, {{1, -1, z}, 0.25}}),
              Grade::bounded)
        << z;
  EXPECT_EQ(grade_of({{{0.3, 0.2, 1}, 0.25}}), Grade::bounded);
  EXPECT_EQ(grade_of({{{0.3, 0.2, 0.9}, 0.25}}), Grade::beyond_bound) << "nowhere in particular";
  EXPECT_EQ(grade_of({{{0.3, 0.2, 1}, 0.25}, {{-0.6, 0, 1}, 0.25}}), Grade::beyond_bound) << "not over the second";
  EXPECT_EQ(grade_of({{{0.3, 0.2, 1}, 0.25}, {{1.1, 0, 1}, 0.25}}), Grade::beyond_bound) << "not over the first";
  EXPECT_EQ(grade_of({{{0.3, 0.2, 1}, 0.25}, {{1, 0, 1}, 0.125}}), Grade::beyond_bound) << "the wrong depth";
  EXPECT_EQ(grade_of({{{0.3, 0.2, 1}, 0.3}}), Grade::beyond_bound) << "deeper than the truth";
  EXPECT_EQ(grade_of({{{0.3, 0.2, 1}, std::nan("")}}), Grade::not_finite);
  EXPECT_EQ(grade_of({{{0.3, 0.2, std::numeric_limits<double>::infinity()}, 0.25}}), Grade::not_finite);
}

TEST(JudgeManifold, must_have_the_deepest_point) {
  // A box on an edge, over the plane z = -1: 0.4 deep.
  const Query tilted{
      Pair::obb_plane, Convexes{{Obb{{0, 0, 0}, {0.5, 0, 0, 1}, {1, 1, 1}}}, {Plane{{0, 0, 1}, -1}}}, {1, 0}};
  // The quaternion is (0.5, 0, 0, 1): a turn about x whose cosine is 0.6, whose sine 0.8. y and z of corners: 0.6 y - 0.8 z, 0.8 y + 0.6 z.
  const auto grade_of = [&](std::vector<ManifoldPoint> points) {
    return judged(tilted, manifold_of({0, 0, -1}, std::move(points)), kManifold).at(Field::points)->grade;
  };
  const ManifoldPoint low{{1, 0.2, -1.4}, 0.4};
  const ManifoldPoint beside{{1, -1.4, -0.2}, -0.8};  // y = -1, z = 1: above the plane
  EXPECT_EQ(grade_of({low}), Grade::bounded);
  EXPECT_EQ(grade_of({low, beside}), Grade::bounded);
  EXPECT_EQ(grade_of({beside}), Grade::beyond_bound);
  EXPECT_EQ(grade_of({low, {{1, 1.4, 0.2}, -0.8}}), Grade::beyond_bound) << "a corner that is not as deep";
  EXPECT_EQ(grade_of({low, {{0.5, 0.2, -1}, 0.4}}), Grade::bounded) << "on the plane below the edge";
  EXPECT_EQ(grade_of({low, {{1, -1, -0.8}, -0.2}}), Grade::beyond_bound);
}

TEST(JudgeManifold, of_rounded_shapes_is_that_of_their_cores_moved_by_the_radius) {
  // A capsule that lies on a box, 0.125 deep, and beyond its edge.
  const Query lying{Pair::capsule_obb,
                    Convexes{{Capsule{{0, 0, 1.375}, {3, 0, 1.375}, 0.5}}, {Obb{{0, 0, 0}, kNotTurned, {1, 1, 1}}}},
                    {0, 0}};
  const auto grade_of = [&](std::vector<ManifoldPoint> points) {
    return judged(lying, manifold_of({0, 0, -1}, std::move(points)), kManifold).at(Field::points)->grade;
  };
  EXPECT_EQ(grade_of({{{0, 0, 1}, 0.125}, {{1, 0, 1}, 0.125}}), Grade::bounded);
  EXPECT_EQ(grade_of({{{0, 0, 0.875}, 0.125}, {{1, 0, 0.875}, 0.125}}), Grade::bounded);
  EXPECT_EQ(grade_of({{{0, 0, 1}, 0.125}, {{3, 0, 1}, 0.125}}), Grade::beyond_bound) << "beyond the edge";
  EXPECT_EQ(grade_of({{{0, 0, 1}, -0.375}}), Grade::beyond_bound) << "of the axis";
  // Upright, it has its end alone.
  const Query upright{Pair::capsule_obb,
                      Convexes{{Capsule{{0, 0, 1.375}, {0, 0, 3}, 0.5}}, {Obb{{0, 0, 0}, kNotTurned, {1, 1, 1}}}},
                      {0, 0}};
  const auto upright_grade = [&](std::vector<ManifoldPoint> points) {
    return judged(upright, manifold_of({0, 0, -1}, std::move(points)), kManifold).at(Field::points)->grade;
  };
  EXPECT_EQ(upright_grade({{{0, 0, 1}, 0.125}}), Grade::bounded);
  EXPECT_EQ(upright_grade({{{0, 0, 1}, 0.125}, {{0, 0, 1}, -1.5}}), Grade::beyond_bound);
}

TEST(JudgeManifold, of_flat_shapes_seen_from_their_edge_has_that_edge) {
  // A square that stands on a face, of points in a hull, with one in its middle.
  const Hull square{{{0, 0, 0.75}, {1, 0, 0.75}, {1, 0, 2}, {0, 0, 2}, {0.5, 0, 1.5}}, 0};
  const Query standing{Pair::obb_hull, Convexes{{Obb{{0, 0, 0}, kNotTurned, {1, 1, 1}}}, {square}}, {0, 0}};
  const auto grade_of = [&](std::vector<ManifoldPoint> points) {
    return judged(standing, manifold_of({0, 0, 1}, std::move(points)), kManifold).at(Field::points)->grade;
  };
  EXPECT_EQ(grade_of({{{0, 0, 1}, 0.25}, {{1, 0, 1}, 0.25}, {{0.5, 0, 0.75}, 0.25}}), Grade::bounded);
  EXPECT_EQ(grade_of({{{0, 0, 1}, 0.25}, {{0, 0, 2}, -1}}), Grade::beyond_bound) << "its upper edge";
  EXPECT_EQ(grade_of({{{0, 0, 1}, 0.25}, {{1, 0, 1.25}, -0.25}}), Grade::beyond_bound) << "its side";
}

TEST(JudgeManifold, is_bounded_by_the_points_that_are_declared) {
  const Query boxes = boxes_turned({{0, 0, 0}, kNotTurned, {1, 1, 1}}, {{0, 0, 1.5}, kNotTurned, {1, 1, 1}});
  Declaration declared = kManifold;
  const std::vector<ManifoldPoint> five(5, {{0.5, 0.5, 1}, 0.5});
  declared.conventions.most_points = 5;
  EXPECT_EQ(level_of(boxes, manifold_of({0, 0, 1}, five), declared), Level::bounded);
  declared.conventions.most_points = 4;
  EXPECT_EQ(level_of(boxes, manifold_of({0, 0, 1}, five), declared), Level::decisions);
  EXPECT_TRUE(judged(boxes, manifold_of({0, 0, 1}, five), declared).at(Field::points)->too_many);
  declared.conventions.most_points = 5;
  EXPECT_FALSE(judged(boxes, manifold_of({0, 0, 2}, five), declared).at(Field::points)->too_many);
  declared.conventions.most_points = 4;
  declared.tolerance = Tolerance{10, 10, 3, 0, std::numeric_limits<double>::infinity()};
  EXPECT_FALSE(judged(boxes, manifold_of({0, 0, 1}, five), declared).within());
  // 8 ulps of 2.5, the largest coordinate, and 2 * 8 ulps of 1 times the depth, 0.5.
  const auto with_z = [&](double z) { return level_of(boxes, manifold_of({0, 0, 1}, {{{0, 0, z}, 0.5}}), kManifold); };
  EXPECT_EQ(with_z(1 + 0x1p-48 + 0x1p-49), Level::bounded);
  EXPECT_EQ(with_z(1 + 0x1p-48 + 0x1p-49 + 0x1p-52), Level::decisions);
}

TEST(JudgeManifold, goes_with_the_claimed_normal_where_any_is_right) {
  const Query boxes = overlapping_boxes();
  Declaration any = kAnySeparating;
  any.conventions.points = Points::manifold;
  const Claim along_y = manifold_of({0, 1, 0}, {{{0.5, 1, -1}, 1.5}, {{1, -0.5, 1}, 1.5}});
  EXPECT_EQ(level_of(boxes, along_y, any), Level::bounded);
  EXPECT_EQ(level_of(boxes, along_y, kManifold), Level::decisions);
  EXPECT_EQ(judged(boxes, along_y, kManifold).at(Field::points)->grade, Grade::beyond_bound) << "1.5 is not the depth";
  EXPECT_TRUE(says(explained(boxes, along_y, kManifold), "points", "depth", "any_separating"));
  // Touching, and apart: depths of 0 and below.
  for (const double x : {2.0, 2.5}) {
    Query beside = boxes_turned({{0, 0, 0}, kNotTurned, {1, 1, 1}}, {{x, 0, 0}, kNotTurned, {1, 1, 1}});
    beside.distances.alarm = 1;
    EXPECT_EQ(level_of(beside, manifold_of({1, 0, 0}, {{{1, 1, 1}, 2 - x}, {{1, -1, 1}, 2 - x}}), kManifold),
              Level::bounded);
    EXPECT_EQ(level_of(beside, manifold_of({1, 0, 0}, {{{1, 1, 1}, 3 - x}}), kManifold), Level::decisions);
  }
}

TEST(JudgeManifold, that_is_right_is_known_for_every_pair) {
  // What right_claim() says, of spheres in a box too.
  for (const Query& query :
       {overlapping(), touching(), overlapping_boxes(),
        Query{Pair::sphere_cube, BallAndBox{{{0.25, 0, 0}, 0.5}, {{-1, -1, -1}, {1, 1, 1}}}, {0, 0}}}) {
    const Claim right = right_claim(query, truth_of(query), kManifold);
    ASSERT_EQ(right.contact->points.size(), 1U);
    EXPECT_EQ(level_of(query, right, kManifold), Level::bounded) << name(query.pair);
  }
  const Query rays{
      Pair::ray_triangle, RayAndTriangle{{{0, 0, 1}, {0, 0, -1}, 2}, {{{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}}}}, {0, 0}};
  EXPECT_FALSE(as_declared(rays, normal_of({0, 0, 1}), kManifold).missing.has(Aspect::points)) << "it is one point";
  EXPECT_TRUE(as_declared(overlapping(), normal_of({1, 0, 0}), kManifold).missing.has(Aspect::points));
}

}  // namespace
}  // namespace contact::oracle::judge_test
