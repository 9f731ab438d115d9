// Why answers are wrong. The spheres of the examples are 7 apart, and everything about them is worked out by hand.
#include "oracle/diagnosis/diagnosis.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "extreme_numbers.hpp"
#include "oracle/diagnosis/formulas.hpp"
#include "oracle/judge/right_claim.hpp"

namespace contact::oracle::diagnosis_test {
namespace {

/// delta (2,3,6), distance 7; surfaces 7 - r1 - r2 apart.
Query seven_apart(double r1, double r2, double alarm, double contact = 0, Pair pair = Pair::sphere_sphere) {
  return {pair, Balls{{{1, 2, 4}, r1}, {{3, 5, 10}, r2}}, {alarm, contact}};
}
Query coincident() { return {Pair::sphere_sphere, Balls{{{1, 2, 4}, 2}, {{1, 2, 4}, 3}}, {0, 0}}; }
/// A box from 0 to (2,3,4), and one of the extents (1,2,3) that begins at `corner`.
Query boxes(const Vector3& corner, double alarm) {
  return {Pair::cube_cube, Boxes{{{0, 0, 0}, {2, 3, 4}}, {corner, corner + Vector3(1, 2, 3)}}, {alarm, 0}};
}

/// A sphere, and a box from 0 to (1,2,4).
Query beside_box(const Vector3& center, double radius, double alarm = 0, double contact = 0) {
  return {Pair::sphere_cube, BallAndBox{{center, radius}, {{0, 0, 0}, {1, 2, 4}}}, {alarm, contact}};
}
const Vector3 kInside(0.25, 0.75, 1.5);

struct Example {
  explicit Example(const Query& asked) : query(asked), truth(truth_of(query)) {}
  [[nodiscard]] Facts facts(std::optional<Numbers> said_normal = std::nullopt) const {
    return {query, truth, Scalar::binary64, said_normal};
  }
  [[nodiscard]] Predictions say(std::string_view cause) const { return predict(causes()[cause_index(cause)], facts()); }

  Query query;
  Truth truth;
};

void expect_numbers(const Said& said, const Numbers& expected, std::string_view what) {
  ASSERT_EQ(said.kind, Said::Kind::numbers) << what;
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(static_cast<double>(said.numbers[i]), static_cast<double>(expected[i]), 1e-15) << what << " " << i;
}
bool is_hit(const Said& said) {
  EXPECT_EQ(said.kind, Said::Kind::numbers);
  EXPECT_TRUE(said.numbers[0] == 0 || said.numbers[0] == 1);
  return said.numbers[0] == 1;
}

Region region(const Query& query) { return Example(query).facts().region; }

TEST(Facts, ARegionIsWhereTheShapesLie) {
  EXPECT_EQ(region(coincident()), Region::coincident);
  EXPECT_EQ(region(seven_apart(9, 2, 0)), Region::inside) << "touching from inside";
  EXPECT_EQ(region(seven_apart(2, 9, 0)), Region::inside);
  EXPECT_EQ(region(seven_apart(9, 2.5, 0)), Region::overlapping);
  EXPECT_EQ(region(seven_apart(4, 4, 1)), Region::overlapping);
  EXPECT_EQ(region(seven_apart(3, 4, 0)), Region::touching);
  EXPECT_EQ(region(seven_apart(3, 4, 1)), Region::near) << "just touching, within the alarm distance";
  EXPECT_EQ(region(seven_apart(2, 3, 2.5)), Region::near);
  EXPECT_EQ(region(seven_apart(2, 3, 2)), Region::at_alarm);
  EXPECT_EQ(region(seven_apart(2, 3, 1.5)), Region::beyond);
  EXPECT_EQ(region(boxes({1, 1, 1}, 0)), Region::inside) << "sharing faces";
  EXPECT_EQ(region(boxes({1.5, 1, 1}, 0)), Region::overlapping);
  EXPECT_EQ(region(boxes({2, 1, 1}, 0)), Region::touching);
  EXPECT_EQ(region(boxes({3, 1, 1}, 1)), Region::at_alarm);
  EXPECT_EQ(region(boxes({3, 1, 1}, 2)), Region::near);
  EXPECT_EQ(region(boxes({3, 1, 1}, 0.5)), Region::beyond);
  const Query larger{Pair::cube_cube, Boxes{{{1, 1, 1}, {2, 2, 2}}, {{0, 0, 0}, {3, 3, 3}}}, {0, 0}};
  EXPECT_EQ(region(larger), Region::inside) << "the first in the second";
}

TEST(Facts, DistancesAndGapsAreThoseOfTheQuestion) {
  const Facts spheres = Example(seven_apart(2, 3, 4, 1)).facts();
  EXPECT_EQ(spheres.D, 49);
  EXPECT_EQ(spheres.distance, 7);
  EXPECT_EQ(spheres.radii(), 5);
  EXPECT_EQ(spheres.delta, (Numbers{2, 3, 6}));
  expect_numbers(spheres.n, {2.L / 7, 3.L / 7, 6.L / 7}, "n");
  const Facts one = Example(boxes({5, 4, -9}, 0)).facts();  // beside, above, and below by 9 - 3
  EXPECT_EQ(one.gap(0), 3);
  EXPECT_EQ(one.gap(1), 1);
  EXPECT_EQ(one.gap(2), 6);
  EXPECT_EQ(one.widest_gap(), 6);
  EXPECT_EQ(Example(boxes({0.5, 0.5, 0.5}, 0)).facts().gap(0), -1.5);
  const Numbers said{0, 0, 1};
  EXPECT_EQ(Example(coincident()).facts(said).n, said) << "no direction but what was said";
}

TEST(Facts, OfASphereAndABoxAreThoseOfItsNearestPoint) {
  EXPECT_EQ(region(beside_box({-2, -3, 5}, 1)), Region::beyond);
  EXPECT_EQ(region(beside_box({-2, 1, 1}, 2)), Region::touching);
  EXPECT_EQ(region(beside_box({-2, 1, 1}, 3)), Region::overlapping);
  EXPECT_EQ(region(beside_box({-2, 1, 1}, 10)), Region::inside) << "the box in the sphere";
  EXPECT_EQ(region(beside_box(kInside, 0.25)), Region::inside) << "touching a face from inside";
  EXPECT_EQ(region(beside_box(kInside, 0.5)), Region::core_inside);
  EXPECT_EQ(region(beside_box({0, 1, 1}, 0.5)), Region::coincident) << "on a face";

  const Facts outside = Example(beside_box({-2, -3, 5}, 1.5)).facts();
  EXPECT_EQ(outside.nearest[1], (Numbers{0, 0, 4}));
  EXPECT_EQ(outside.D, 4 + 9 + 1);
  EXPECT_EQ(outside.radii(), 1.5);
  EXPECT_EQ(outside.scale, (std::array<Real, 2>{5, 5}));
  EXPECT_EQ(outside.widest_gap(), 3);

  const Facts inside = Example(beside_box(kInside, 0.5)).facts();
  EXPECT_EQ(inside.depth, 0.25);
  EXPECT_EQ(inside.distance, -0.25);
  EXPECT_EQ(inside.n, (Numbers{1, 0, 0})) << "into the box";
  EXPECT_EQ(inside.nearest[1], (Numbers{0, 0.75, 1.5}));
  // Two faces are nearest, and an engine may take either.
  const Example tie(beside_box({0.25, 0.25, 1}, 1));
  EXPECT_EQ(tie.facts().n, (Numbers{1, 0, 0})) << "the first, where nothing was said";
  EXPECT_EQ(tie.facts(Numbers{0.25, 0.75, 0}).n, (Numbers{0, 1, 0}));
  EXPECT_EQ(tie.facts(Numbers{0.25, 0.75, 0}).nearest[1], (Numbers{0.25, 0, 1}));
  EXPECT_EQ(tie.facts(Numbers{formulas::kNaN, 0, 0}).n, (Numbers{1, 0, 0}));
}

TEST(Facts, AnotherQuestionIsReadAnewAndTheRegionStays) {
  const Example asked(beside_box({-2, 1, 1}, 2, 3, 4));
  Facts facts = asked.facts();
  facts.ask(beside_box(kInside, std::numeric_limits<double>::infinity(), 5, 6));
  EXPECT_EQ(facts.depth, 0.25);
  EXPECT_EQ(facts.radius[0], std::numeric_limits<double>::max());
  EXPECT_EQ(facts.alarm, 5);
  EXPECT_EQ(facts.contact, 6);
  EXPECT_EQ(facts.region, Region::near);
  EXPECT_EQ(facts.truth, &asked.truth);
}

TEST(Facts, AQuestionThatHasBecomeNaNIsNotAsked) {
  // The hulls are wider than the largest number, so that steps of a grid are infinite, and the box is scaled by an
  // infinite factor. Their causes say what is right: all lie 1 below the surface.
  const Plane above{{0, 0, 1}, 1};
  const auto hull = [&](double from, double to) {
    return Query{Pair::hull_plane, Convexes{{Hull{{{from, 0, 0}, {to, 0, 0}, {1.3e308, 1, 0}}, 0}}, {above}}, {0, 0}};
  };
  const Query flat{Pair::obb_plane, Convexes{{Obb{{0, 0, 0}, {0, 0, 0, 1e200}, {1, 1, 0}}}, {above}}, {0, 0}};
  for (const auto& [cause, query] : {std::pair{"hull-on-a-grid", hull(-1e308, 1e308)},
                                     {"hull-on-a-grid", hull(1e308, 1.7e308)},
                                     {"quaternion-not-normalised", flat}})
    expect_numbers(Example(query).say(cause).value, {-1, 0, 0}, cause);
}

TEST(Facts, AComparisonThatHangsOnTheLastBitsIsNoOpinion) {
  const Real next = std::numeric_limits<Real>::epsilon();
  EXPECT_EQ(Said::at_most(1, 1).kind, Said::Kind::no_opinion);
  EXPECT_EQ(Said::at_most(1, 1 + 15 * next).kind, Said::Kind::no_opinion);
  EXPECT_EQ(Said::at_most(-1, -1 - 15 * next).kind, Said::Kind::no_opinion);
  EXPECT_TRUE(is_hit(Said::at_most(1, 1 + 20 * next)));
  EXPECT_FALSE(is_hit(Said::at_most(1 + 20 * next, 1)));
  EXPECT_FALSE(is_hit(Said::at_most(3, 0)));
  EXPECT_EQ(Said::at_most(std::numeric_limits<Real>::quiet_NaN(), 1).kind, Said::Kind::no_opinion);
}

TEST(Causes, EachHasAnIdASentenceAndAtLeastOneFormula) {
  for (std::size_t i = 0; i < causes().size(); ++i) {
    const Cause& cause = causes()[i];
    EXPECT_EQ(cause_index(cause.id), i) << "two are called " << cause.id;
    EXPECT_EQ(sentence_of(cause.id), cause.sentence);
    EXPECT_GT(cause.sentence.size(), 8U) << cause.id;
    EXPECT_TRUE(cause.edit || cause.hit || cause.normal || cause.point || cause.value) << cause.id;
  }
  EXPECT_EQ(sentence_of("accepts-nan"), "accepts NaN");
  EXPECT_EQ(sentence_of("no-answer"), "gives no answer");
  EXPECT_THROW(static_cast<void>(sentence_of("no-such-cause")), std::out_of_range);
}

TEST(Causes, OfThoseThatSayTheSameTheSimplestStandsFirst) {
  const auto stand_in_this_order = [](const std::vector<std::string_view>& ids) {
    for (std::size_t i = 1; i < ids.size(); ++i) EXPECT_LT(cause_index(ids[i - 1]), cause_index(ids[i])) << ids[i];
  };
  // The first and the last of each table.
  stand_in_this_order(
      {"first-radius-for-both", "inputs-single",        "squared-against-sum", "one-axis-enough", "box-first-side",
       "box-contains",          "normal-not-finite",    "normal-wrong-length", "points-far-side", "points-not-finite",
       "value-is-distance",     "value-containment",    "square-range",        "sum-range",       "tolerance-1e-15",
       "tolerance-minus-1e-2",  "centres-within-1e-19", "centres-within-1e-3", "rounding",        "three-digits"});
  stand_in_this_order({"delta-reversed", "pair-swapped", "normal-to-positive-x", "normal-from-smaller"});
  stand_in_this_order({"alarm-ignored", "alarm-doubled", "alarm-halved"});        // no alarm distance
  stand_in_this_order({"contact-ignored", "contact-doubled", "contact-halved"});  // no contact distance
  stand_in_this_order({"x-ignored", "y-ignored", "z-ignored"});                   // all axes are alike
  stand_in_this_order({"edge-open", "inverted", "never-hit"});
  stand_in_this_order({"box-corners", "box-corners-one"});
  stand_in_this_order({"points-middle", "points-centre-middle", "points-weighted"});  // equal radii
  stand_in_this_order({"value-depth", "value-depth-plus-contact", "value-depth-without-contact", "value-unsigned"});
  stand_in_this_order({"value-less-alarm", "value-alarm-for-contact"});
  std::vector<std::string> tolerances;
  for (const char* size : {"1e-15", "1e-14", "1e-12", "1e-10", "1e-9", "1e-8", "1e-7", "1e-6", "1e-5", "1e-4", "1e-3"})
    for (const char* sign : {"", "minus-"}) tolerances.push_back(std::string("tolerance-") + sign + size);
  stand_in_this_order({tolerances.begin(), tolerances.end()});
  stand_in_this_order({"centres-within-1e-15", "centres-within-1e-12", "centres-within-1e-9", "centres-within-1e-6"});
  stand_in_this_order({"rounding", "single-precision", "five-digits", "four-digits", "three-digits"});
}

// Causes that no mutant of engines/ has. engines/zoo/mutants_test.cpp compares all other formulas with the mutants.
TEST(Causes, FormulasWithoutAMutant) {
  const Example near(seven_apart(2, 3, 4, 1));
  // r1 = 4, r2 = 9: 13 and the alarm distance reach 7.
  const Predictions squared = near.say("radii-squared");
  EXPECT_TRUE(is_hit(squared.hit));
  expect_numbers(squared.point[0], {1 + 8.L / 7, 2 + 12.L / 7, 4 + 24.L / 7}, "point1");
  expect_numbers(squared.point[1], {3 - 18.L / 7, 5 - 27.L / 7, 10 - 54.L / 7}, "point2");
  expect_numbers(squared.value, {7 - 13 - 1, 0, 0}, "value");
  EXPECT_FALSE(is_hit(Example(seven_apart(0.5, 0.25, 6.5)).say("radii-squared").hit)) << "0.25 + 0.0625 + 6.5 < 7";
  // Surfaces are 2 apart.
  expect_numbers(near.say("points-past-half-value").point[0], {1 + 8.L / 7, 2 + 12.L / 7, 4 + 24.L / 7}, "point1");
  expect_numbers(near.say("points-past-half-value").point[1], {3 - 10.L / 7, 5 - 15.L / 7, 10 - 30.L / 7}, "point2");
  for (const Said& said : near.say("points-not-finite").point) EXPECT_TRUE(std::isnan(said.numbers[0]));
  expect_numbers(near.say("value-contact-per-sphere").value, {0, 0, 0}, "7 - 5 - 1 - 1");
}

TEST(Causes, AnArithmeticIsVagueByTheLargestNumberAndItsBits) {
  // The sum of radii, distances and separation is 5 + 4 + 1 + 7, larger than any coordinate; eight roundings to 11
  // bits.
  const Example near(seven_apart(2, 3, 4, 1));
  constexpr Real kLoss = 8 * 17.L / 2048;
  const Predictions said = near.say("three-digits");
  expect_numbers(said.normal, {2.L / 7, 3.L / 7, 6.L / 7}, "normal");
  expect_numbers(said.point[1], {3 - 6.L / 7, 5 - 9.L / 7, 10 - 18.L / 7}, "point2");
  expect_numbers(said.value, {1, 0, 0}, "value");
  EXPECT_DOUBLE_EQ(static_cast<double>(said.normal.tolerance), static_cast<double>(kLoss / 7));
  EXPECT_DOUBLE_EQ(static_cast<double>(said.point[1].tolerance), static_cast<double>(kLoss + 3 * kLoss / 7));
  EXPECT_DOUBLE_EQ(static_cast<double>(said.value.tolerance), static_cast<double>(kLoss));
  EXPECT_EQ(said.hit.kind, Said::Kind::no_opinion) << "2 from the edge";
  EXPECT_EQ(Example(seven_apart(2, 3, 2.05)).say("three-digits").hit.kind, Said::Kind::anything);
  EXPECT_EQ(Example(seven_apart(2, 3, 2.1)).say("three-digits").hit.kind, Said::Kind::no_opinion);
  // Of the engine's own format: 52 bits, and coordinates of 2^40 outweigh all distances.
  const Query far{
      Pair::sphere_sphere, Balls{{{std::ldexp(1.0, 40), 0, 0}, 1}, {{std::ldexp(1.0, 40) - 4, 0, 0}, 1}}, {3, 0}};
  EXPECT_EQ(Example(far).say("rounding").value.tolerance, std::ldexp(Real{1}, 40 + 3 - 52));
  EXPECT_EQ(Example(boxes({-1024, 0, 0}, 0)).say("three-digits").hit.kind, Said::Kind::no_opinion) << "1023 - 4";
  EXPECT_EQ(Example(boxes({-4, 0, 0}, 3.01)).say("three-digits").hit.kind, Said::Kind::anything);
  const Query at_edge{Pair::cube_cube, Boxes{{{-256, 0, 0}, {0, 1, 1}}, {{1, 0, 0}, {2, 1, 1}}}, {0, 0}};
  EXPECT_EQ(Example(at_edge).say("three-digits").hit.kind, Said::Kind::anything) << "1 from the edge: 8 x 256 / 2048";
  const Query small{
      Pair::cube_cube, Boxes{{{0, 0, 0}, {0x1p-8, 0.25, 0.25}}, {{0x1p-7, 0, 0}, {0.5, 0.25, 0.25}}}, {0, 0}};
  EXPECT_EQ(Example(small).say("three-digits").hit.kind, Said::Kind::no_opinion)
      << "2^-8 from the edge: 8 x 0.5 / 2048 = 2^-9";
  EXPECT_EQ(Example(boxes({1, 1, 1}, 3)).say("three-digits").hit.kind, Said::Kind::no_opinion) << "4 from the edge";
  EXPECT_EQ(Example(coincident()).say("three-digits").normal.kind, Said::Kind::no_opinion);
  EXPECT_EQ(Example(coincident()).say("three-digits").point[0].kind, Said::Kind::no_opinion);
  expect_numbers(Example(coincident()).say("three-digits").value, {-5, 0, 0}, "value");
}

TEST(Causes, ThatConcernShapesOfOneKindSayNothingOfOthers) {
  const std::vector<Example> examples{Example(seven_apart(4, 4, 0)), Example(boxes({1, 1, 1}, 0)),
                                      Example(beside_box(kInside, 1))};
  std::size_t of_one_kind = 0;
  for (const Cause& cause : causes())
    for (const Example& example : examples) {
      if (cause.kind == kEveryKind || cause.kind == example.query.shapes.index()) continue;
      ++of_one_kind;
      const Predictions said = example.say(cause.id);
      for (const Said* aspect : {&said.hit, &said.normal, &said.point[0], &said.point[1], &said.value})
        EXPECT_EQ(aspect->kind, Said::Kind::no_opinion) << cause.id;
    }
  EXPECT_GT(of_one_kind, 80U);
}

TEST(Causes, ACentreInTheBoxLeavesItByAWrongFace) {
  // The faces are 0.25 and 0.75, 0.75 and 1.25, 1.5 and 2.5 away; the middle is (0.5, 1, 2).
  const Example in(beside_box(kInside, 0.125, 0, 0.5));
  const auto leaves = [&](std::string_view cause, const Numbers& normal, const Numbers& foot, Real depth) {
    const Predictions said = in.say(cause);
    expect_numbers(said.normal, normal, cause);
    expect_numbers(said.point[0], formulas::along({0.25, 0.75, 1.5}, 0.125L, normal), cause);
    expect_numbers(said.point[1], foot, cause);
    expect_numbers(said.value, {-0.125L - depth - 0.5L, 0, 0}, cause);
  };
  leaves("sphere-box-farthest-face", {0, 0, -1}, {0.25, 0.75, 4}, 2.5);
  leaves("sphere-box-opposite-face", {-1, 0, 0}, {1, 0.75, 1.5}, 0.75);
  leaves("sphere-box-face-by-offset", {0, 0, 1}, {0.25, 0.75, 0}, 1.5);
  leaves("sphere-box-first-face", {1, 0, 0}, {0, 0.75, 1.5}, 0.25);
  expect_numbers(in.say("sphere-box-depth-missing").value, {-0.625, 0, 0}, "depth missing");
  expect_numbers(in.say("sphere-box-depth-added").value, {0.25L - 0.625L, 0, 0}, "depth added");
  expect_numbers(in.say("sphere-box-point-in-box").point[1], {0.25, 0.75, 1.5}, "the centre");
  EXPECT_EQ(in.say("sphere-box-point-in-box").point[0].kind, Said::Kind::no_opinion);
  expect_numbers(in.say("sphere-box-point-local").point[1], {-0.5, -0.25, -0.5}, "the foot less the middle");
  expect_numbers(in.say("sphere-box-normal-outward").normal, {-1, 0, 0}, "outward");
  const Real apart = std::sqrt(0.0625L + 0.0625L + 0.25L);
  expect_numbers(in.say("sphere-box-normal-to-middle").normal, {0.25L / apart, 0.25L / apart, 0.5L / apart}, "middle");
  EXPECT_EQ(in.say("sphere-box-middle-not-finite").normal.kind, Said::Kind::no_opinion);
  EXPECT_TRUE(std::isnan(Example(beside_box({0.5, 1, 2}, 1)).say("sphere-box-middle-not-finite").normal.numbers[0]));
  // What every pair has is right of the way out as well.
  expect_numbers(in.say("first-radius-missing").value, {-0.75, 0, 0}, "no radius");
  expect_numbers(in.say("points-far-side").point[0], {0.125, 0.75, 1.5}, "against the normal");
  expect_numbers(in.say("x-ignored").value, {-0.875, 0, 0}, "there is no delta to ignore it in");
  for (const std::string_view cause :
       {"sphere-box-farthest-face", "sphere-box-depth-missing", "sphere-box-normal-outward"})
    EXPECT_EQ(Example(beside_box({-2, 1, 1}, 3)).say(cause).normal.kind, Said::Kind::no_opinion) << cause;
  const std::vector<Numbers> outward{{-1, 0, 0}, {0, -1, 0}};
  for (const Numbers& said : outward)
    expect_numbers(
        predict(causes()[cause_index("sphere-box-normal-outward")], Example(beside_box({0.25, 0.25, 1}, 1)).facts(said))
            .normal,
        said, "of two faces that are nearest");
}

/// The least alarm distance at which a mistake makes a question a hit.
struct Turn {
  std::string_view cause;
  Query query;
  double alarm;
};
constexpr double kAlways = 0;

void expect_turns(const std::vector<Turn>& turns) {
  for (const Turn& turn : turns) {
    const auto said = [&](double alarm) {
      Query query = turn.query;
      query.distances.alarm = alarm;
      return is_hit(Example(query).say(turn.cause).hit);
    };
    if (turn.alarm == kAlways) {
      EXPECT_TRUE(said(0)) << turn.cause;
    } else if (turn.alarm == kInfinity) {
      EXPECT_FALSE(said(1e6)) << turn.cause;
    } else {
      EXPECT_FALSE(said(turn.alarm * (1 - 1e-9))) << turn.cause;
      EXPECT_TRUE(said(turn.alarm * (1 + 1e-9))) << turn.cause;
    }
  }
}

TEST(Causes, DecisionsAboutSpheresTurnWhereTheFormulaSays) {
  const Query q = seven_apart(2, 3, 0, 1);
  const Query small = seven_apart(0.5, 0.25, 0, 1);
  using std::sqrt;
  expect_turns({
      {"first-radius-for-both", q, 7 - 4},
      {"second-radius-for-both", q, 7 - 6},
      {"first-radius-missing", q, 7 - 3},
      {"second-radius-missing", q, 7 - 2},
      {"radii-missing", q, 7},
      {"radii-doubled", small, 7 - 1.5},
      {"radii-halved", q, 7 - 2.5},
      {"radii-exchanged", q, 7 - 5},
      {"alarm-ignored", q, kInfinity},
      {"alarm-doubled", q, 1},
      {"alarm-halved", q, 4},
      {"distances-exchanged", q, kInfinity},
      {"distances-exchanged", seven_apart(2, 3, 0, 2.5), kAlways},
      {"first-shape-twice", q, kAlways},
      {"x-ignored", small, sqrt(9 + 36) - 0.75},
      {"y-ignored", small, sqrt(4 + 36) - 0.75},
      {"z-ignored", small, sqrt(4 + 9) - 0.75},
      {"x-added", q, sqrt(16 + 9 + 36) - 5},
      {"y-added", q, sqrt(4 + 49 + 36) - 5},
      {"z-added", q, sqrt(4 + 9 + 196) - 5},
      {"centres-added", q, sqrt(16 + 49 + 196) - 5},
      {"first-centre-ignored", q, sqrt(9 + 25 + 100) - 5},
      {"second-centre-ignored", small, sqrt(1 + 4 + 16) - 0.75},
      {"axes-crossed", q, sqrt(16 + 64 + 1) - 5},  // (5, 10, 3) - (1, 2, 4)
      {"x-twice", q, sqrt(4 + 4 + 36) - 5},
      {"squared-against-sum", q, 49 - 5},
      {"distance-against-square", small, sqrt(7) - 0.75},
      {"sum-of-squares", q, 6},  // 49 <= 4 + 9 + 36
      {"alarm-squared-apart", q, sqrt(49 - 25)},
      {"alarm-outside-square", q, 49 - 25},
      {"radii-multiplied", q, 7 - 6},
      {"radii-subtracted", q, 7 - 1},
      {"larger-radius-only", q, 7 - 3},
      {"smaller-radius-only", q, 7 - 2},
      {"larger-radius-only", seven_apart(3, 2, 0), 7 - 3},
      {"smaller-radius-only", seven_apart(3, 2, 0), 7 - 2},
      {"alarm-subtracted", q, kInfinity},
      {"alarm-subtracted", seven_apart(4, 4, 0), kAlways},
      {"contact-for-alarm", q, kInfinity},
      {"contact-for-alarm", seven_apart(2, 3, 0, 2.5), kAlways},
      {"contact-widens", q, 7 - 5 - 1},
      {"contact-narrows", q, 7 - 5 + 1},
      {"larger-distance", q, 2},
      {"larger-distance", seven_apart(2, 3, 0, 2.5), kAlways},
      {"alarm-capped", seven_apart(2.5, 3, 0), 1.5},
      {"alarm-capped", seven_apart(1.5, 3, 0), kInfinity},  // 4.5 and at most 1.5
      {"alarm-capped", seven_apart(3, 1.5, 0), kInfinity},
      {"radii-product", seven_apart(6, 1, 0), kInfinity},  // 49 > 6 x 7
      {"radii-product", seven_apart(1, 6, 0), kInfinity},
      {"radii-product", q, kInfinity},                   // 49 > 2 x 3 x 5
      {"radii-product", seven_apart(3, 3, 0), kAlways},  // 49 < 3 x 3 x 6
      {"tolerance-of-coordinates", q, 2 - 1e-6 * 10},
      {"coordinate-sum", q, 11 - 5},
      {"largest-coordinate", q, 6 - 5},
      {"one-axis-enough", small, 2 - 0.75},
      {"tolerance-1e-2", q, 2 - 0.01},
      {"tolerance-minus-1e-2", q, 2 + 0.01},
      {"single-decision", q, 2 - 0x1p-22},  // half way from 7 to the number of single precision before it
      {"inverted", seven_apart(4, 4, 0), kInfinity},
      {"always-hit", q, kAlways},
      {"never-hit", q, kInfinity},
      {"never-hit", seven_apart(4, 4, 0), kInfinity},
  });
}

TEST(Causes, DecisionsAboutBoxesTurnWhereTheFormulaSays) {
  // The gaps are 3 and 1 up to the second box, and 6 down to it: it ends at z = -6. The centres are (1, 1.5, 2) and
  // (5.5, 5, -7.5).
  const Query q = boxes({5, 4, -9}, 0);
  const Query above = boxes({5, 0, 0}, 0);
  const Query below = boxes({0, 0, -9}, 0);
  const Query turned{Pair::cube_cube, Boxes{{{10, 20, 30}, {12, 23, 34}}, {{1, 2, 3}, {4, 5, 6}}}, {0, 0}};
  expect_turns({
      {"first-shape-twice", q, kAlways},
      {"x-ignored", above, kAlways},
      {"y-ignored", q, 6},
      {"z-ignored", q, 3},
      {"axes-crossed", above, 1},    // the second from (0, 0, 5) to (2, 3, 6)
      {"axes-crossed", turned, 26},  // the second from (2, 3, 1) to (5, 6, 4)
      {"x-twice", q, 6},
      {"contact-widens", {q.pair, q.shapes, {0, 2}}, 4},
      {"one-axis-enough", q, 1},
      {"box-first-side", q, 6},
      {"box-first-side", above, kAlways},
      {"box-second-side", q, 3},
      {"box-second-side", below, kAlways},
      {"box-extents-full", q, 9.5 - 7},
      {"box-extents-quarter", q, 9.5 - 1.75},
      {"box-centres", q, 9.5},
      {"box-euclidean", q, std::sqrt(9 + 1 + 36)},
      {"box-euclidean", above, 3},
      {"box-alarm-first", above, 3},
      {"box-alarm-first", below, kInfinity},
      {"box-alarm-second", below, 6},
      {"box-alarm-second", above, kInfinity},
      {"box-min-min", q, 9},
      {"box-max-max", q, 10},
      {"box-min-zero", q, 6},
      {"box-min-zero", above, kAlways},
      {"box-centre-is-max", q, 10 - 3.5},
      {"box-z-extent-lost", q, 9.5 - 0.002},
      {"box-gap-sum", q, 3 + 1 + 6},
      {"box-contains", boxes({0.5, 0.5, 0.5}, 0), kAlways},
      {"box-contains", boxes({1.5, 0.5, 0.5}, 0), 0.5},
      {"box-contains", boxes({0.5, -0.25, 0.5}, 0), 0.25},
      {"single-decision", above, 3 - 0x1p-22 - 0x1p-23},  // 3 - 2^-22 is single; 2 more is half way to 5, and even
      {"single-decision", below, 6 - 0x1p-22},
      {"never-hit", q, kInfinity},
  });
}

TEST(Causes, DecisionsAboutASphereAndABoxTurnWhereTheFormulaSays) {
  // 2 and 3 below, 1 above; the middle is (0.5, 1, 2).
  const Query q = beside_box({-2, -3, 5}, 0.5, 0, 1);
  const Query face = beside_box({0.25, -3, 1}, 0.5);
  using std::sqrt;
  expect_turns({
      {"radii-missing", q, sqrt(14)},
      {"largest-coordinate", q, 3 - 0.5},
      {"coordinate-sum", q, 6 - 0.5},
      {"x-ignored", q, sqrt(9 + 1) - 0.5},
      {"contact-widens", q, sqrt(14) - 1.5},
      {"tolerance-1e-2", q, sqrt(14) - 0.51},
      {"sphere-box-bounding-sphere", q, sqrt(6.25 + 16 + 9) - sqrt(1 + 4 + 16) / 2 - 0.5},
      {"sphere-box-middle", q, sqrt(6.25 + 16 + 9) - 0.5},
      {"sphere-box-corner", face, sqrt(0.0625 + 9 + 1) - 0.5},
      {"sphere-box-corner", beside_box({0.75, 5, 3}, 0.5), sqrt(0.0625 + 9 + 1) - 0.5},
      {"sphere-box-extents-full", q, 2.5 - 0.5},
      {"sphere-box-extents-halved", q, sqrt(5.0625 + 12.25 + 4) - 0.5},
      {"sphere-box-min-for-middle", q, sqrt(2.25 + 4 + 9) - 0.5},
      {"sphere-box-max-alone", q, 1 - 0.5},
      {"sphere-box-min-alone", q, sqrt(4 + 9) - 0.5},
      {"sphere-box-corner-by-side", face, sqrt(0.0625 + 9 + 1) - 0.5},
      {"sphere-box-corner-by-side", beside_box({0.25, 5, 1}, 0.5), sqrt(0.0625 + 9 + 1) - 0.5},
      {"sphere-box-max-for-both", q, sqrt(9 + 25 + 1) - 0.5},
      {"sphere-box-integer-middle", q, sqrt(2.25 + 9 + 1) - 0.5},
      {"sphere-box-middle-in-sphere", beside_box(kInside, 0.5), sqrt(0.375) - 0.5},
  });
  const auto hit = [](std::string_view cause, const Query& query) { return is_hit(Example(query).say(cause).hit); };
  EXPECT_FALSE(hit("sphere-box-inside-missed", beside_box(kInside, 0.25)));
  EXPECT_TRUE(hit("sphere-box-inside-missed", beside_box(kInside, 0.26)));
  EXPECT_TRUE(hit("sphere-box-inside-missed", beside_box({-2, 1, 1}, 10))) << "the box in the sphere";
  EXPECT_TRUE(hit("sphere-box-middle-in-sphere", beside_box({-2, 1, 1}, 2.25))) << "right outside";
  // From the middle of a cube of 2 its faces are 1 away, and its corners 1.73.
  const auto in_cube = [](double radius) {
    return Query{Pair::sphere_cube, BallAndBox{{{0, 0, 0}, radius}, {{-1, -1, -1}, {1, 1, 1}}}, {0, 0}};
  };
  for (const std::string_view cause : {"sphere-box-near-faces", "sphere-box-outermost"}) {
    EXPECT_TRUE(hit(cause, in_cube(0.9))) << cause;
    EXPECT_FALSE(hit(cause, in_cube(1.5))) << cause;
    EXPECT_TRUE(hit(cause, in_cube(1.8))) << cause;
  }
}

TEST(Causes, OneSideOfABoxIsLeftOut) {
  const std::array<std::string_view, 6> causes_by_side{"box-x-low",  "box-y-low",  "box-z-low",
                                                       "box-x-high", "box-y-high", "box-z-high"};
  for (int low : {0, 1})
    for (int axis = 0; axis < 3; ++axis)
      for (std::size_t i = 0; i < 6; ++i) {
        // The second box beyond the first on one axis: below it, so that a.min - b.max is the gap, or above it.
        Vector3 corner(0.5, 0.5, 0.5);
        corner[axis] = low == 0 ? -9 : 9;
        const std::size_t side = static_cast<std::size_t>(3 * low + axis);
        EXPECT_EQ(is_hit(Example(boxes(corner, 0)).say(causes_by_side[i]).hit), i == side)
            << causes_by_side[i] << ' ' << side;
      }
}

TEST(Causes, BoxesByTheirCorners) {
  const auto hit = [](std::string_view cause, const Query& query) { return is_hit(Example(query).say(cause).hit); };
  const Query by_min = boxes({1.5, 2.5, 3.5}, 0);
  const Query by_max = boxes({-0.5, -1, -1}, 0);
  const Query first_inside{Pair::cube_cube, Boxes{{{1, 1, 1}, {2, 2, 2}}, {{0, 0, 0}, {3, 3, 3}}}, {0, 0}};
  const Query crossing{Pair::cube_cube, Boxes{{{0, 1, 1}, {9, 2, 2}}, {{1, 0, 1}, {2, 9, 2}}}, {0, 0}};
  for (const Query& query : {by_min, by_max, boxes({2, 3, 4}, 0), boxes({-1, -2, -3}, 0)}) {
    EXPECT_TRUE(hit("box-corners", query));
    EXPECT_TRUE(hit("box-corners-one", query)) << "touching included";
  }
  EXPECT_TRUE(hit("box-contains", first_inside));
  EXPECT_TRUE(hit("box-corners", first_inside));
  EXPECT_FALSE(hit("box-corners-one", first_inside));
  EXPECT_FALSE(hit("box-corners", crossing));
  EXPECT_FALSE(hit("box-corners", boxes({2.5, 0, 0}, 0.25)));
  EXPECT_TRUE(hit("box-corners", boxes({2.5, 0, 0}, 0.5)));
  EXPECT_TRUE(hit("box-corners", boxes({-1.5, 0, 0}, 0.5)));
}

TEST(Causes, DecisionsThatAreWrongInSomePlacesOnly) {
  const auto hit = [](std::string_view cause, const Query& query) { return is_hit(Example(query).say(cause).hit); };
  const auto along = [](const Vector3& delta, double radius) {
    return Query{Pair::sphere_sphere, Balls{{{0, 0, 0}, radius}, {delta, radius}}, {0, 0}};
  };
  EXPECT_FALSE(hit("edge-open", seven_apart(3, 4, 0)));
  EXPECT_TRUE(hit("edge-open", seven_apart(4, 4, 0)));
  EXPECT_FALSE(hit("edge-open", seven_apart(1, 4, 0)));
  EXPECT_FALSE(hit("tolerance-minus-1e-15", seven_apart(3, 4, 0))) << "narrower by however little";
  EXPECT_FALSE(hit("inside-missed", seven_apart(9, 1, 0)));
  EXPECT_TRUE(hit("inside-missed", seven_apart(4, 4, 0)));
  EXPECT_FALSE(hit("oblique-missed", along({1, 1, 1}, 5)));
  for (const Vector3& delta : {Vector3(0, 1, 1), Vector3(1, 0, 1), Vector3(1, 1, 0)})
    EXPECT_TRUE(hit("oblique-missed", along(delta, 5)));
  EXPECT_FALSE(hit("large-missed", along({1, 1, 1}, 10000)));
  EXPECT_TRUE(hit("large-missed", along({1, 1, 1}, 9999)));
  EXPECT_TRUE(hit("inverted", seven_apart(1, 2, 0)));
  EXPECT_FALSE(
      hit("box-flat-missed", {Pair::cube_cube, Boxes{{{0, 0, 0}, {1, 1, 0}}, {{0, 0, 0}, {1, 1, 1}}}, {0, 0}}));
  EXPECT_FALSE(
      hit("box-flat-missed", {Pair::cube_cube, Boxes{{{0, 0, 0}, {1, 1, 1}}, {{0, 1, 0}, {1, 1, 1}}}, {0, 0}}));
  EXPECT_TRUE(hit("box-flat-missed", boxes({1, 1, 1}, 0)));
  for (const std::string_view cause : {"squared-against-sum", "sum-of-squares", "larger-radius-only", "alarm-capped"})
    EXPECT_EQ(Example(boxes({1, 1, 1}, 0)).say(cause).hit.kind, Said::Kind::no_opinion) << cause;
  for (const std::string_view cause : {"box-euclidean", "box-corners", "box-x-low", "sum-range"})
    EXPECT_EQ(Example(seven_apart(4, 4, 0)).say(cause).hit.kind, Said::Kind::no_opinion) << cause;
}

TEST(Causes, NormalsAndValuesAtTheirEdges) {
  const auto normal = [](std::string_view cause, const Query& query, const Numbers& said) {
    return predict(causes()[cause_index(cause)], Example(query).facts(said)).normal;
  };
  const Query q = seven_apart(2, 3, 4);
  expect_numbers(normal("normal-wrong-length", q, {2, 3, 6}), {2, 3, 6}, "twice the length");
  EXPECT_EQ(normal("normal-wrong-length", q, {0, 0, 0}).kind, Said::Kind::no_opinion);
  EXPECT_EQ(normal("normal-wrong-length", q, {1.0L / 0.0L, 0, 0}).kind, Said::Kind::no_opinion);
  const Query tie{Pair::sphere_sphere, Balls{{{0, 0, 0}, 4}, {{-3, 3, 1}, 4}}, {0, 0}};
  expect_numbers(normal("normal-snapped", tie, {}), {-1, 0, 0}, "the first of equal ones");
  const Query close{Pair::sphere_sphere, Balls{{{0, 0, 0}, 4}, {{0, 0x1p-30, 0}, 4}}, {0, 0}};  // 9.3e-10
  expect_numbers(normal("centres-within-1e-9", close, {0, 0, -1}), {0, 0, -1}, "whichever axis was said");
  expect_numbers(normal("centres-within-1e-9", close, {1, 1, 0}), {1, 0, 0}, "no axis was said");
  EXPECT_EQ(normal("centres-within-1e-12", close, {0, 0, -1}).kind, Said::Kind::no_opinion);
  const Query half{Pair::sphere_sphere, Balls{{{0, 0, 0}, 4}, {{0, 0.5, 0}, 3}}, {0, 0}};
  expect_numbers(Example(half).say("radii-halved").normal, {0, 1, 0}, "an edit leaves the direction");
  expect_numbers(Example(half).say("radii-halved").value, {0.5L - 3.5L, 0, 0}, "value");
  const Query tiny{Pair::sphere_sphere, Balls{{{0, 0, 0}, 4}, {{0, 3e-6, 0}, 3}}, {0, 0}};
  expect_numbers(Example(tiny).say("normal-plus-1e-6").normal, {0, 0.75, 0}, "3 / 4");
  expect_numbers(Example(tiny).say("normal-square-plus-1e-12").normal, {0, 3 / std::sqrt(10.0L), 0}, "3 / sqrt(9 + 1)");
  expect_numbers(Example(half).say("three-digits").normal, {0, 1, 0}, "within a distance of 1");
  expect_numbers(Example(seven_apart(2, 3, 4, 1)).say("first-shape-twice").value, {0 - 2 - 2 - 1, 0, 0}, "to itself");
  EXPECT_EQ(Example(coincident()).say("radii-halved").normal.kind, Said::Kind::no_opinion);
  EXPECT_EQ(Example(coincident()).say("first-centre-ignored").point[0].kind, Said::Kind::no_opinion);
  const double off = 0x1p-30;
  const Query finer{Pair::sphere_sphere, Balls{{{1 + off, 2, 4}, 2 + off}, {{3, 5 + off, 10}, 3 + off}}, {4, 1 + off}};
  expect_numbers(Example(finer).say("inputs-single").value, {7 - 5 - 1, 0, 0}, "what single precision leaves");
  expect_numbers(Example(seven_apart(3, 3.5, 4)).say("value-bool").value, {1, 0, 0}, "a gap of a half");
  expect_numbers(Example(seven_apart(3, 4, 4)).say("value-bool").value, {0, 0, 0}, "touching");
}

TEST(Causes, SquaresLeaveTheRangeOfTheEnginesFormat) {
  const auto lost = [](double distance, double radius, double alarm, Scalar scalar) {
    const Query query{Pair::sphere_sphere, Balls{{{0, 0, 0}, radius}, {{distance, 0, 0}, radius}}, {alarm, 0}};
    const Truth truth = truth_of(query);
    return predict(causes()[cause_index("square-range")], Facts(query, truth, scalar, std::nullopt)).hit.kind ==
           Said::Kind::anything;
  };
  EXPECT_FALSE(lost(1, 1, 1, Scalar::binary64));
  EXPECT_FALSE(lost(0x1p511, 1, 0, Scalar::binary64));
  EXPECT_TRUE(lost(0x1p512, 1, 0, Scalar::binary64)) << "2^1024";
  EXPECT_FALSE(lost(0x1p-511, 1, 0, Scalar::binary64)) << "2^-1022 is the smallest normal number";
  EXPECT_TRUE(lost(0x1p-512, 1, 0, Scalar::binary64));
  EXPECT_TRUE(lost(1, 0x1p512, 0, Scalar::binary64));
  EXPECT_TRUE(lost(1, 1, 0x1p512, Scalar::binary64));
  EXPECT_TRUE(lost(1, 0x1p510, 0x1p511, Scalar::binary64)) << "radii and alarm distance together";
  EXPECT_FALSE(lost(0, 1, 0, Scalar::binary64)) << "the square of 0 is right";
  for (int axis = 0; axis < 3; ++axis) {
    Vector3 flat(1, 1, 1);
    const auto asked = [&] { return Query{Pair::sphere_sphere, Balls{{{0, 0, 0}, 1}, {flat, 1}}, {0, 0}}; };
    EXPECT_EQ(Example(asked()).say("square-range").hit.kind, Said::Kind::no_opinion);
    flat[axis] = 0x1p-600;
    EXPECT_EQ(Example(asked()).say("square-range").hit.kind, Said::Kind::anything) << "component " << axis;
  }
  EXPECT_FALSE(lost(0x1p63, 1, 0, Scalar::binary32));
  EXPECT_TRUE(lost(0x1p64, 1, 0, Scalar::binary32));
  EXPECT_TRUE(lost(0x1p-64, 1, 0, Scalar::binary32));
}

// Whole runs.

/// A diagnosis of an engine's answers.
class Campaign {
 public:
  /// The right answer, with a change.
  template <class Change>
  Campaign& says(const Query& query, Change change, std::uint64_t weight = 1) {
    const Truth truth = truth_of(query);
    Claim claim = right_claim(query, truth, declared_);
    change(claim);
    Declaration declared = declared_;
    declared.claims = claim.says();  // what is left out is another test's subject
    diagnosis.add(++key_, query, truth, claim, declared, judge(query, truth, claim, declared), nullptr, weight);
    return *this;
  }
  Campaign& right(const Query& query, std::uint64_t weight = 1) {
    return says(
        query, [](Claim&) {}, weight);
  }
  [[nodiscard]] std::vector<std::string> sentences() const {
    std::vector<std::string> all;
    for (const Finding& f : diagnosis.findings()) all.push_back(f.sentence);
    return all;
  }

  Diagnosis diagnosis;

 private:
  Declaration declared_;
  std::uint64_t key_ = 0;
};

using Lines = std::vector<std::string>;

/// An answer that claims nothing but a value, a normal, or a decision.
auto value(double x) {
  return [x](Claim& claim) {
    claim.overlap.reset();
    claim.contact.emplace().value = x;
  };
}
void reversed(Claim& claim) {
  const Vector3 n = *claim.contact->normal;
  claim.overlap.reset();
  claim.contact.emplace().normal = Vector3(-n);
}
void missed(Claim& claim) {
  claim = {};
  claim.overlap = false;
}
void silent(Claim& claim) {
  claim = {};
  claim.status = Claim::Status::error;
}

TEST(Diagnosis, WhatIsRightHasNoFinding) {
  Campaign run;
  EXPECT_TRUE(run.diagnosis.findings().empty());
  EXPECT_TRUE(run.diagnosis.lines().empty());
  for (int i = 0; i < 5; ++i) run.right(seven_apart(2, 3 + 0.25 * i, 4, 1)).right(boxes({3, 1, 1}, 0.25 * i));
  run.right(coincident());
  EXPECT_TRUE(run.diagnosis.findings().empty());
  EXPECT_TRUE(run.diagnosis.lines().empty());
  EXPECT_TRUE(run.diagnosis.wrong().empty());
}

TEST(Diagnosis, AMistakeIsNamedWithHowMuchItExplains) {
  Campaign run;
  for (int i = 0; i < 7; ++i) run.says(seven_apart(2, 1 + 0.125 * i, 8, 1 + i), value(7));
  const auto findings = run.diagnosis.findings();
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].cause, "value-is-distance");
  EXPECT_EQ(
      findings[0].sentence,
      "value is the distance of the centres: radii and contact distance left out: explains 7 of 7 wrong value claims");
  EXPECT_EQ(findings[0].explained, 7U);
  EXPECT_EQ(run.diagnosis.wrong(), (std::map<std::string, std::uint64_t>{{"value", 7}}));
}

TEST(Diagnosis, TheMistakeThatExplainsMoreIsNamedFirst) {
  Campaign run;
  for (int i = 0; i < 4; ++i) run.says(seven_apart(2, 1 + 0.125 * i, 8, 1 + i), value(7));
  for (int i = 0; i < 5; ++i) run.says(seven_apart(2, 1 + 0.125 * i, 8, 1 + i), reversed);
  EXPECT_EQ(run.sentences(), (Lines{"normal points from second to first: explains 5 of 5 wrong normal claims",
                                    "value is the distance of the centres: radii and contact distance left out: "
                                    "explains 4 of 4 wrong value claims"}));
}

TEST(Diagnosis, WhereAMistakeIsMadeIsSaidIfItIsNotMadeElsewhere) {
  Campaign run;
  for (int i = 0; i < 3; ++i) run.says(seven_apart(4, 4 + 0.125 * i, 0, 1), reversed);
  EXPECT_EQ(run.sentences(), (Lines{"normal points from second to first: explains 3 of 3 wrong normal claims"}));
  run.right(coincident());  // where the mistake says nothing
  EXPECT_EQ(run.sentences(), (Lines{"normal points from second to first: explains 3 of 3 wrong normal claims"}));
  run.right(seven_apart(1, 2, 8, 1));  // short of the alarm distance
  EXPECT_EQ(
      run.sentences(),
      (Lines{"normal points from second to first, where the shapes overlap: explains 3 of 3 wrong normal claims"}));
  run.says(seven_apart(9, 1, 0, 1), reversed);
  EXPECT_EQ(run.sentences(),
            (Lines{"normal points from second to first, where one shape lies inside the other and where the "
                   "shapes overlap: explains 4 of 4 wrong normal claims"}));
  run.says(seven_apart(3, 4, 0, 1), reversed);
  EXPECT_EQ(run.sentences(),
            (Lines{"normal points from second to first, where one shape lies inside the other, where the "
                   "shapes overlap and where the shapes just touch: explains 5 of 5 wrong normal claims"}));
}

TEST(Diagnosis, ThePairOfAMistakeIsSaidIfItIsNotMadeInOthers) {
  Campaign run;
  for (int i = 0; i < 3; ++i)
    run.says(seven_apart(4, 4 + 0.125 * i, 0, 1, Pair::sphere_rigid_sphere), reversed)
        .right(seven_apart(4, 4 + 0.125 * i, 0, 1));
  EXPECT_EQ(run.sentences(),
            (Lines{"normal points from second to first, in sphere_rigid_sphere: explains 3 of 3 wrong normal claims"}));
  run.right(seven_apart(1, 2, 8, 1));
  EXPECT_EQ(run.sentences().at(0),
            "normal points from second to first, in sphere_rigid_sphere: explains 3 of 3 wrong normal claims")
      << "right elsewhere in the other pair: that tells nothing of where in this one";
}

TEST(Diagnosis, WhatIsRightSpeaksAgainstAMistakeWhereItIsSaid) {
  Campaign run;
  for (int i = 0; i < 3; ++i) run.says(seven_apart(4, 4 + 0.125 * i, 0, 1), reversed);
  run.right(seven_apart(4, 5, 0, 1), 2);
  EXPECT_EQ(run.sentences(), (Lines{"normal points from second to first: explains 3 of 3 wrong normal claims"}));
  run.right(seven_apart(4, 5.5, 0, 1), 0);
  EXPECT_EQ(run.sentences().size(), 1U) << "weight 0 counts for nothing";
  run.right(seven_apart(4, 5.5, 0, 1));
  EXPECT_EQ(run.sentences(), (Lines{"3 of 3 wrong claims fit no known mistake"}))
      << "three right ones against three wrong";
}

TEST(Diagnosis, WhatIsRightSpeaksAgainstAMistakeWheneverItCame) {
  // Right answers before anything is wrong are kept, those behind it are compared at once; so are all where that was
  // asked for, and those of two parts that are merged.
  const auto rights = [](Campaign& run) { run.right(seven_apart(4, 5, 0, 1)).right(seven_apart(1, 2, 8, 1)); };
  const auto wrongs = [](Campaign& run) {
    for (int i = 0; i < 3; ++i) run.says(seven_apart(4, 4 + 0.125 * i, 0, 1), reversed);
  };
  const Lines expected{
      "normal points from second to first, where the shapes overlap: explains 3 of 3 wrong normal claims"};
  for (const bool at_once : {false, true})
    for (const bool before : {false, true}) {
      Campaign run;
      if (at_once) run.diagnosis.compare_at_once();
      if (before) rights(run);
      EXPECT_EQ(run.diagnosis.compares_at_once(), at_once);
      wrongs(run);
      EXPECT_TRUE(run.diagnosis.compares_at_once());
      if (!before) rights(run);
      EXPECT_EQ(run.sentences(), expected) << at_once << before;
    }
  for (const bool first : {false, true}) {
    Campaign right;
    Campaign wrong;
    rights(right);
    wrongs(wrong);
    (first ? right : wrong).diagnosis.merge((first ? wrong : right).diagnosis);
    EXPECT_EQ((first ? right : wrong).sentences(), expected) << first;
  }
}

TEST(Diagnosis, KeepsABoundedNumberOfRightAnswers) {
  Diagnosis all;
  Campaign one;
  one.right(seven_apart(4, 5, 0, 1));
  Diagnosis many = one.diagnosis;
  while (!many.compares_at_once()) many.merge(Diagnosis(many));
  all.merge(many);
  all.merge(one.diagnosis);  // one more than are kept: it is compared, and those stay
  EXPECT_TRUE(all.compares_at_once());
  Campaign wrong;
  for (int i = 0; i < 3; ++i) wrong.says(seven_apart(4, 4 + 0.125 * i, 0, 1), reversed);
  all.merge(wrong.diagnosis);
  const auto findings = all.findings();
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].sentence, "3 of 3 wrong claims fit no known mistake")
      << "thousands of right ones against three";
}

TEST(Diagnosis, WhatFitsNoMistakeIsCountedFromATenthOn) {
  Campaign run;
  for (int i = 0; i < 18; ++i) run.says(seven_apart(2, 1 + 0.125 * i, 8, 1 + i), value(7));
  run.says(seven_apart(2, 3, 8, 1), value(77)).says(seven_apart(2, 3, 8, 1), value(1234));
  EXPECT_EQ(run.sentences().size(), 1U) << "2 of 20";
  run.says(seven_apart(2, 3, 8, 1), value(123));
  const Lines sentences = run.sentences();
  ASSERT_EQ(sentences.size(), 2U);
  EXPECT_EQ(sentences[1], "3 of 21 wrong claims fit no known mistake");
  EXPECT_EQ(run.diagnosis.findings()[1].cause, "");
  EXPECT_EQ(run.diagnosis.findings()[1].explained, 3U);
}

TEST(Diagnosis, AMistakeThatExplainsLessThanAFiftiethIsChance) {
  Campaign run;
  for (int i = 0; i < 49; ++i) run.says(seven_apart(2, 1 + 0.0625 * i, 8, 1 + i), value(7));
  run.says(seven_apart(2, 3, 8, 1), reversed);
  EXPECT_EQ(run.sentences().size(), 2U) << "1 of 50";
  run.says(seven_apart(2, 3, 8, 1), value(7));
  EXPECT_EQ(run.sentences().size(), 1U) << "1 of 51";
}

TEST(Diagnosis, APointFollowsAWrongNormalAndIsNoMistakeOfItsOwn) {
  Campaign run;
  for (int i = 0; i < 3; ++i)
    run.says(seven_apart(2, 1 + i, 8, 1), [i](Claim& claim) {
      claim.contact->normal = Vector3(1, 0, 0);
      claim.contact->point1 = Vector3(1 + 2, 2, 4);
      claim.contact->point2 = Vector3(3 - (1 + i), 5, 10);
    });
  EXPECT_EQ(
      run.sentences(),
      (Lines{"normal always (1, 0, 0): explains 3 of 3 wrong normal claims, 3 of 3 wrong point1 claims and 3 of 3 "
             "wrong point2 claims"}));
}

TEST(Diagnosis, AnEditExplainsDecisionsValuesAndPoints) {
  // The radius of the first sphere for both: 2 + 2 and the alarm distance do not reach 7, and point2 lies at 2 from its
  // centre.
  Campaign run;
  for (int i = 0; i < 4; ++i) run.says(seven_apart(2, 4 + 0.125 * i, 2.5), missed);
  for (int i = 0; i < 4; ++i)
    run.says(seven_apart(2, 4 + 0.125 * i, 8, 1), [](Claim& claim) {
      claim.contact->point2 = Vector3(3 - 4.0 / 7, 5 - 6.0 / 7, 10 - 12.0 / 7);
      claim.contact->value = 7 - 4 - 1;
    });
  EXPECT_EQ(run.sentences(),
            (Lines{"radius of the first sphere used for both: explains 4 of 4 wrong overlap claims, 4 of 4 wrong "
                   "point2 claims and 4 of 4 wrong value claims"}));
}

TEST(Diagnosis, NumbersThatAreNotFiniteAreNamed) {
  Campaign run;
  for (int i = 0; i < 3; ++i) run.says(coincident(), value(i == 0 ? kInfinity : kNaN));
  EXPECT_EQ(run.sentences(), (Lines{"value is NaN or infinite: explains 3 of 3 wrong value claims"}));
}

TEST(Diagnosis, InTheConventionsOfTheEngineAMistakeIsTheSame) {
  // A depth without the contact distance, whose radii are left out: -7.
  Declaration declared;
  declared.conventions.value = ValueKind::depth;
  declared.conventions.value_less_contact = false;
  declared.conventions.normal = NormalDirection::second_to_first;
  Diagnosis diagnosis;
  for (int i = 0; i < 3; ++i) {
    const Query query = seven_apart(2, 1 + i, 8, 1);
    const Truth truth = truth_of(query);
    Claim claim = right_claim(query, truth, declared);
    claim.contact->value = -7;
    claim.contact->normal = Vector3(-1, 0, 0);
    diagnosis.add(static_cast<std::uint64_t>(i), query, truth, claim, declared, judge(query, truth, claim, declared));
  }
  EXPECT_EQ(diagnosis.lines(), (Lines{"normal always (1, 0, 0): explains 3 of 3 wrong normal claims",
                                      "radii left out: explains 3 of 3 wrong value claims"}));
}

TEST(Diagnosis, WhatAnswersToHitsLackIsCountedAndTheConventionNamedThatWouldNotAskForIt) {
  Diagnosis diagnosis;
  const auto add = [&](auto change) {
    const Query query = seven_apart(2, 1, 8, 1);
    const Truth truth = truth_of(query);
    Claim claim = right_claim(query, truth, {});
    change(*claim.contact);
    diagnosis.add(1, query, truth, claim, {}, judge(query, truth, claim, {}));
  };
  add([](ContactClaim& c) { c.normal.reset(); });
  add([](ContactClaim& c) { c.point2.reset(); });
  add([](ContactClaim& c) { c.point2.reset(); });
  Diagnosis other = diagnosis;
  EXPECT_EQ(diagnosis.missing("point2"), 2U);
  EXPECT_EQ(diagnosis.missing("value"), 0U);
  const Lines lines{
      "normal: missing in 1 answers to hits; 1 of 1 wrong answers are right under the convention normal = none",
      "point2: missing in 2 answers to hits; 2 of 2 wrong answers are right under the convention points = first_only"};
  EXPECT_EQ(diagnosis.lines(), lines);
  diagnosis.merge(other);
  EXPECT_EQ(diagnosis.missing("normal"), 2U);
}

TEST(Diagnosis, SilenceIsCountedByPairAndIsSometimesSo) {
  Campaign run;
  run.says(coincident(), silent)
      .says(coincident(), silent)
      .says(boxes({3, 1, 1}, 0), silent)
      .right(boxes({1, 1, 1}, 0));
  EXPECT_EQ(run.sentences(), (Lines{"gives no answer, in sphere_sphere: 2 questions",
                                    "gives no answer, sometimes, in cube_cube: 1 questions"}));
  EXPECT_EQ(run.diagnosis.findings()[0].cause, "no-answer");
  EXPECT_EQ(run.diagnosis.findings()[0].explained, 2U);
}

TEST(Diagnosis, AnAnswerOutsideTheDomainIsNamedByWhatIsWrongThere) {
  Diagnosis diagnosis;
  diagnosis.add_outside_domain(seven_apart(2, -3, 4));
  for (int i = 0; i < 3; ++i) diagnosis.add_outside_domain(seven_apart(kInfinity, kNaN, 4));
  for (int i = 0; i < 2; ++i) diagnosis.add_outside_domain(seven_apart(2, kInfinity, 4));
  EXPECT_EQ(diagnosis.lines(),
            (Lines{"accepts NaN: 3 answers where there is no question",
                   "accepts infinity: 2 answers where there is no question",
                   "accepts a negative radius, extent, length or distance: 1 answers where there is no question"}));
}

TEST(Diagnosis, AFiniteQuestionOutsideTheDomainIsNamedByTheFirstFieldThatBreaksARule) {
  const auto cause = [](const Query& query) {
    Diagnosis diagnosis;
    diagnosis.add_outside_domain(query);
    return diagnosis.findings().at(0).cause;
  };
  const Box box{{2, 0, 0}, {1, 1, 1}};
  const Obb turned{{0, 0, 0}, {0, 0, 0, 1}, {1, 1, 1}};
  const Plane plane{{0, 0, 1}, 0};
  EXPECT_EQ(cause({Pair::cube_cube, Boxes{box, {{0, 0, 0}, {1, 1, 1}}}, {0, 0}}), "accepts-inverted");
  EXPECT_EQ(cause({Pair::sphere_cube, BallAndBox{{{0, 0, 0}, 1}, box}, {0, 0}}), "accepts-inverted");
  EXPECT_EQ(cause(boxes({1, 1, 1}, -1)), "accepts-negative");
  EXPECT_EQ(cause({Pair::obb_plane, Convexes{{Obb{{0, 0, 0}, {0, 0, 0, 1}, {1, -1, 1}}}, {plane}}, {0, 0}}),
            "accepts-negative");
  EXPECT_EQ(cause({Pair::obb_plane, Convexes{{Obb{{0, 0, 0}, {0, 0, 0, 0}, {1, 1, 1}}}, {plane}}, {0, 0}}),
            "accepts-zero");
  EXPECT_EQ(cause({Pair::obb_plane, Convexes{{turned}, {Plane{{0, 0, 0}, 1}}}, {0, 0}}), "accepts-zero");
  EXPECT_EQ(cause({Pair::cast_sphere, CastAt<Ball>{Cast{{{0, 0, 0}, {0, 0, 0}, 1}}, {{3, 0, 0}, 1}}, {0, 0}}),
            "accepts-zero");
  EXPECT_EQ(cause({Pair::hull_plane, Convexes{{Hull{{}, 0}}, {plane}}, {0, 0}}), "accepts-vertices");
}

TEST(Diagnosis, AConventionIsNamedWhereHalfAFieldIsRightUnderIt) {
  Campaign run;
  run.says(seven_apart(4, 4, 0), value(1)).says(seven_apart(4, 5, 0), value(2));
  run.says(seven_apart(4, 6, 0, 1), value(77)).says(seven_apart(4, 7, 0, 1), value(1234));
  const auto names = [&] {
    const Lines lines = run.diagnosis.lines();
    return std::find(lines.begin(), lines.end(),
                     "value: 2 of 4 wrong answers are right under the convention value = depth less contact") !=
           lines.end();
  };
  EXPECT_TRUE(names());
  run.says(seven_apart(4, 7.5, 0, 1), value(5678));
  for (const std::string& line : run.diagnosis.lines())
    EXPECT_EQ(line.find("under the convention"), std::string::npos) << line;
}

TEST(Diagnosis, WhatIsContradictedInOnePlaceIsExplainedInOthers) {
  Campaign run;
  for (int i = 0; i < 10; ++i) run.says(seven_apart(1 + 0.125 * i, 2, 8, 1), reversed);
  for (int i = 0; i < 3; ++i) run.says(seven_apart(4, 4 + 0.125 * i, 0, 1), reversed);
  for (int i = 0; i < 3; ++i) run.right(seven_apart(4, 4 + 0.125 * i, 0, 1));
  EXPECT_EQ(run.sentences(),
            (Lines{"normal points from second to first, short of the alarm distance: explains 10 of 13 wrong "
                   "normal claims",
                   "3 of 13 wrong claims fit no known mistake"}));
}

TEST(Diagnosis, WhatIsRightInOneRunSpeaksAgainstWhatIsWrongInAnother) {
  // The radius of the first sphere for both, which comes first in the rule base.
  Campaign wrong;
  Campaign right;
  for (int i = 0; i < 3; ++i) {
    wrong.says(seven_apart(2, 3 + 0.125 * i, 8, 1), value(7 - 4 - 1));
    right.right(seven_apart(2, 3 + 0.125 * i, 8, 1));
  }
  EXPECT_EQ(wrong.sentences(), (Lines{"radius of the first sphere used for both: explains 3 of 3 wrong value claims"}));
  wrong.diagnosis.merge(right.diagnosis);
  EXPECT_EQ(wrong.sentences(), (Lines{"3 of 3 wrong claims fit no known mistake"}));
}

TEST(Diagnosis, AVagueMistakeIsNamedWhereNoOtherFits) {
  Campaign run;
  run.says(seven_apart(2, 3, 4, 1), value(1.001));  // 8 x 17 / 2^15 = 0.004, / 2^18 = 0.0005
  EXPECT_EQ(run.diagnosis.findings().at(0).cause, "four-digits");
  Campaign finer;
  finer.says(seven_apart(2, 3, 4, 1), value(1.00001));  // 8 x 17 / 2^23 = 0.000016
  EXPECT_EQ(finer.diagnosis.findings().at(0).cause, "single-precision");
  Campaign all;  // touching and not
  for (int i = 0; i < 3; ++i) all.says(seven_apart(3, 4, 0), missed).says(seven_apart(4, 4, 0), missed);
  EXPECT_NE(all.diagnosis.findings().at(0).cause, "edge-open");
}

TEST(Diagnosis, AFormulaIsMetWithinWhatRoundingsDoWhereItsMistakeShowsBeyondThem) {
  const auto found = [](double claimed, double r1 = 2) {
    Campaign run;
    run.says(seven_apart(r1, 3, 8, 1), value(claimed));
    return run.diagnosis.findings().at(0).cause;
  };
  // Eight roundings of the largest number: radii, distances and separation together, 5 + 8 + 1 + 7.
  EXPECT_EQ(found(7 + 168 * 0x1p-52), "value-is-distance");
  EXPECT_EQ(found(7 - 168 * 0x1p-52), "value-is-distance");
  EXPECT_EQ(found(7 + 172 * 0x1p-52), "");
  EXPECT_EQ(found(7 - 172 * 0x1p-52), "");
}

TEST(Diagnosis, AFormulaThatIsHardlyNearerThanTheTruthExplainsNothing) {
  // 1e-6 added to a distance of 2^29 takes 8.4 ulps of the normal's length, and the bound is 8.
  const auto found = [](double ulps) {
    Campaign run;
    run.says({Pair::sphere_sphere, Balls{{{0, 0, 0}, 0x1p28}, {{0x1p29, 0, 0}, 0x1p28}}, {0, 0}}, [ulps](Claim& claim) {
      claim.overlap.reset();
      claim.contact.emplace().normal = Vector3(1 - ulps * 0x1p-52, 0, 0);
    });
    return run.diagnosis.findings().at(0).cause;
  };
  EXPECT_EQ(found(9), "normal-plus-1e-6");
  EXPECT_EQ(found(15), "rounding") << "6.6 from the formula, and 15 from the truth";
}

TEST(Diagnosis, AFormulaThatExplainsEveryOtherDecisionExplainsNoneBeyondChance) {
  // Without the first radius, five of ten missed hits are misses. Ten right hits are exactly at the edge without it, so
  // that it says nothing of them; they contradict an engine that never hits.
  Campaign run;
  for (int i = 0; i < 5; ++i) {
    run.says(seven_apart(7.5, 3 + 0.125 * i, 0), missed).says(seven_apart(1, 7.5 + 0.0625 * i, 0), missed);
    run.right(seven_apart(1 + 0.125 * i, 7, 0)).right(seven_apart(2 + 0.125 * i, 7, 0));
  }
  for (const Finding& finding : run.diagnosis.findings())
    EXPECT_NE(finding.cause, "first-radius-missing") << finding.sentence;
}

TEST(Diagnosis, NearDecisionsThatAFormulaMeetsEveryOtherTimeAreNoEvidenceForIt) {
  // A hair from touching, on either side, every other decision is wrong: formulas explain the false hits, or the missed
  // ones, and as many right decisions contradict them.
  const auto hit = [](Claim& claim) {
    claim = {};
    claim.overlap = true;
  };
  const double hair = 0x1p-50;
  Campaign run;
  for (int i = 0; i < 10; ++i) {
    run.says(seven_apart(3 + 0.125 * i, 4 - 0.125 * i - hair, 0), hit)
        .right(seven_apart(3 + 0.25 * i, 4 - 0.25 * i - hair, 0));
    run.says(seven_apart(3 + 0.125 * i, 4 - 0.125 * i + hair, 0), missed)
        .right(seven_apart(3 + 0.25 * i, 4 - 0.25 * i + hair, 0));
  }
  EXPECT_EQ(run.diagnosis.findings().at(0).cause, "rounding");
}

TEST(Diagnosis, AFormulaIsNamedBeforeTheArithmeticThatExplainsMore) {
  Campaign run;
  for (int i = 0; i < 40; ++i) run.says(seven_apart(3, 4, 0), missed);
  for (int i = 0; i < 5; ++i) run.says(seven_apart(2, 1 + 0.125 * i, 8, 1 + i), value(7));
  EXPECT_EQ(run.diagnosis.findings().at(0).cause, "value-is-distance");
}

TEST(Diagnosis, AnArithmeticIsBelievedWhereTheErrorsHaveItsSize) {
  const auto found = [](double off) {
    Campaign run;
    run.says(seven_apart(2, 3, 4, 1), value(1 + off));
    return run.diagnosis.findings().at(0).cause;
  };
  EXPECT_EQ(found(0x1p-40), "");  // far less than single precision does, and more than double
  EXPECT_EQ(found(0x1p-24), "single-precision");
  EXPECT_EQ(found(0.3), "");  // more than three digits
}

TEST(Diagnosis, OneMidpointIsDiagnosedAsTwoPointsAre) {
  Declaration declared;
  declared.conventions.points = Points::midpoint;
  Diagnosis diagnosis;
  for (int i = 0; i < 3; ++i) {
    const Query query = seven_apart(2, 1 + 0.125 * i, 8, 1);
    const Truth truth = truth_of(query);
    Claim claim = right_claim(query, truth, declared);
    claim.contact->point = Vector3(-*claim.contact->point);
    diagnosis.add(static_cast<std::uint64_t>(i), query, truth, claim, declared, judge(query, truth, claim, declared));
  }
  ASSERT_FALSE(diagnosis.findings().empty());
  EXPECT_EQ(diagnosis.findings().at(0).sentence, "contact point negated: explains 3 of 3 wrong point claims");
}

TEST(Diagnosis, OfTwoThatExplainTheSameTheOneThatIsRightElsewhereIsNamed) {
  // Depths and values without their sign are the same where shapes overlap.
  Campaign run;
  for (int i = 0; i < 90; ++i) run.says(seven_apart(4, 4 + 0.0625 * i, 0), value(1 + 0.0625 * i));
  EXPECT_EQ(run.diagnosis.findings().at(0).cause, "value-depth");
  run.says(seven_apart(1, 2, 8, 0, Pair::sphere_rigid_sphere), value(4));
  EXPECT_EQ(run.diagnosis.findings().at(0).cause, "value-unsigned");
  // A depth explains one claim more, and one of the four places with right claims contradicts it: 91 less a twentieth
  // of a quarter is 89.9, against 90.
  run.says(seven_apart(1, 2, 8), value(-4));
  EXPECT_EQ(run.diagnosis.findings().at(0).cause, "value-unsigned");
  EXPECT_EQ(run.diagnosis.findings().at(0).explained, 90U);
}

TEST(Diagnosis, APointThatFollowsANormalIsExplainedOnlyWithIt) {
  Campaign run;
  for (int i = 0; i < 3; ++i) {
    run.says(seven_apart(2, 1 + i, 8, 1), [i](Claim& claim) {
      claim.overlap.reset();
      ContactClaim& contact = claim.contact.emplace();
      contact.normal = Vector3(1, 0, 0);
      contact.point2 = Vector3(3 - (1 + i), 5, 10);
    });
    run.says(seven_apart(2, 1 + i, 8, 1), [](Claim& claim) {
      claim.overlap.reset();
      const Vector3 n = *claim.contact->normal;
      claim.contact.emplace().normal = n;
    });
  }
  EXPECT_EQ(run.sentences(), (Lines{"6 of 6 wrong claims fit no known mistake"}));
}

TEST(Diagnosis, ASimpleMistakeIsNamedBeforeAVagueOne) {
  const auto first = [](const Query& query, auto change) {
    Campaign run;
    run.says(query, change);
    return run.diagnosis.findings().at(0).cause;
  };
  const auto hit = [](Claim& claim) {
    claim = {};
    claim.overlap = true;
  };
  // A tolerance of 1e-2 explains these too.
  EXPECT_FALSE(first(seven_apart(2, 3, 2 + 0x1p-9, 0x1p-8), missed).starts_with("tolerance"));
  EXPECT_FALSE(first(seven_apart(2, 3, 2 - 0x1p-9, 0x1p-8), hit).starts_with("tolerance"));
  // A sum leaves the range here, and squares do below.
  const Query large{Pair::cube_cube, Boxes{{{0, 0, 0}, {0x1p1023, 1, 1}}, {{0, 0, 0}, {1, 1, 1}}}, {0x1p1023, 0}};
  EXPECT_EQ(Example(large).say("sum-range").hit.kind, Said::Kind::anything);
  EXPECT_NE(first(large, missed), "sum-range");
  const Query far{Pair::sphere_sphere, Balls{{{0, 0, 0}, 0x1p600}, {{0x1p600, 0, 0}, 0x1p600}}, {0, 0}};
  EXPECT_EQ(Example(far).say("square-range").value.kind, Said::Kind::anything);
  EXPECT_NE(first(far, value(0x1p600)), "square-range");
}

TEST(Diagnosis, ANumberPastTheRangeIsHeldAgainstEveryComponent) {
  // Twice the first radius is three quarters of 2^1024, which counts as past the range.
  const auto found = [](double x) {
    Campaign run;
    run.says({Pair::sphere_sphere, Balls{{{0, 0, 0}, 0x1.8p1022}, {{0, 0x1p1020, 0}, 0x1p1022}}, {0, 0}},
             [x](Claim& claim) {
               claim.overlap.reset();
               claim.contact.emplace().point1 = Vector3(x, kInfinity, 0);
             });
    return run.diagnosis.findings().at(0).cause;
  };
  EXPECT_EQ(found(0), "radii-doubled");
  EXPECT_NE(found(0x1p1000), "radii-doubled");
}

TEST(Diagnosis, NamesSixMistakesAtMost) {
  Campaign run;
  run.diagnosis.add_outside_domain(seven_apart(2, -3, 4));
  run.diagnosis.add_outside_domain(seven_apart(kNaN, 3, 4));
  run.diagnosis.add_outside_domain(seven_apart(2, kInfinity, 4));
  run.diagnosis.add_outside_domain({Pair::cube_cube, Boxes{{{1, 0, 0}, {0, 1, 1}}, {{0, 0, 0}, {1, 1, 1}}}, {0, 0}});
  for (int i = 0; i < 9; ++i) run.says(seven_apart(2, 1 + 0.125 * i, 8, 1 + i), value(7));
  for (int i = 0; i < 5; ++i) run.says(seven_apart(2, 1 + 0.125 * i, 8, 1 + i), reversed);
  EXPECT_EQ(run.diagnosis.findings().size(), 6U);
  run.says(boxes({1, 1, 1}, 0), missed);
  ASSERT_EQ(run.diagnosis.findings().size(), 6U) << "1 of 15 is no tenth";
  EXPECT_EQ(run.diagnosis.findings()[5].cause, "delta-reversed");
}

TEST(Diagnosis, ConventionsAreCountedOverAllParts) {
  Campaign one;
  Campaign other;
  for (Campaign* run : {&one, &other}) run->says(seven_apart(4, 4, 0), value(1)).says(seven_apart(4, 5, 0), value(2));
  one.diagnosis.merge(other.diagnosis);
  EXPECT_EQ(one.diagnosis.lines().back(),
            "value: 4 of 4 wrong answers are right under the convention value = depth less contact");
}

/// An archive that shows every member of a diagnosis to `look`.
template <class Look>
struct Members {
  Look look;
  template <class... Member>
  void operator()(Member&... members) {
    look(members...);
  }
};
template <class Look>
void look_inside(Diagnosis& diagnosis, Look look) {
  Members<Look> archive{look};
  diagnosis.serialize(archive);
}

TEST(Diagnosis, WhatCannotHaveBeenCountedIsNotSound) {
  Campaign run;
  run.says(seven_apart(2, 3, 8, 1), value(7)).right(seven_apart(4, 4, 0, 1));
  EXPECT_TRUE(run.diagnosis.is_sound());
  look_inside(run.diagnosis, [](auto&, auto&, auto& sample, auto& contradicted, auto&...) {
    ASSERT_FALSE(sample.empty());
    ASSERT_FALSE(contradicted.empty());
  });
  ASSERT_FALSE(HasFatalFailure());
  Diagnosis other = run.diagnosis;
  look_inside(other, [](auto&, auto& wrong, auto&...) { wrong.clear(); });
  EXPECT_FALSE(other.is_sound()) << "a sample of what is not wrong";
  for (const int longer : {-1, 1}) {
    other = run.diagnosis;
    look_inside(other, [&](auto&, auto&, auto&, auto& contradicted, auto&...) {
      auto& counts = contradicted.begin()->second;
      counts.resize(counts.size() + static_cast<std::size_t>(longer));
    });
    EXPECT_FALSE(other.is_sound()) << "counts of causes that there are not";
  }
  for (const int field : {0, 1, 2}) {
    const auto spoil = [&](auto& place) {
      if (field == 0) place.aspect = static_cast<Aspect>(kAspectNames.size());
      if (field == 1) place.pair = static_cast<Pair>(kPairs.size());
      if (field == 2) place.region = static_cast<Region>(kRegionNames.size());
    };
    other = run.diagnosis;
    look_inside(other, [&](auto&, auto&, auto&, auto& contradicted, auto&...) {
      auto node = contradicted.extract(contradicted.begin());
      spoil(node.key());
      contradicted.insert(std::move(node));
    });
    EXPECT_FALSE(other.is_sound()) << field;
    other = run.diagnosis;
    look_inside(other, [&](auto&, auto&, auto& sample, auto&...) {
      auto node = sample.extract(sample.begin());
      spoil(node.key().place);
      sample.insert(std::move(node));
    });
    EXPECT_FALSE(other.is_sound()) << field;
  }
  other = run.diagnosis;
  look_inside(other, [](auto&, auto&, auto& sample, auto&...) {
    auto node = sample.extract(sample.begin());
    node.key().by.set(causes().size());
    sample.insert(std::move(node));
  });
  EXPECT_FALSE(other.is_sound()) << "explained by a cause that there is not";
  for (const bool is_silent : {false, true}) {
    other = run.diagnosis;
    look_inside(other, [&](auto&, auto&, auto&, auto&, auto& answered, auto& silent_ones, auto&...) {
      (is_silent ? silent_ones : answered)[static_cast<Pair>(kPairs.size())] = 1;
    });
    EXPECT_FALSE(other.is_sound()) << "a pair that there is not" << is_silent;
  }
  other = run.diagnosis;
  other.add_outside_domain(seven_apart(2, -3, 4));
  EXPECT_TRUE(other.is_sound());
  look_inside(other, [](auto&, auto&, auto&, auto&, auto&, auto&, auto& outside, auto&...) { outside["x"] = 1; });
  EXPECT_FALSE(other.is_sound()) << "answers outside the domain by a cause that there is not";
}

TEST(Diagnosis, AnAnswerOfWeightNothingLeavesNoCounts) {
  Campaign run;
  run.right(seven_apart(4, 4, 0, 1), 0);
  look_inside(run.diagnosis, [](auto&, auto&, auto&, auto& contradicted, auto& answered, auto&...) {
    EXPECT_TRUE(contradicted.empty());
    EXPECT_EQ(answered.at(Pair::sphere_sphere), 1U);
  });
}

TEST(Diagnosis, OfManyWrongClaimsASampleSpeaksForAll) {
  const Example hit(boxes({1, 1, 1}, 0));
  Claim claim;
  claim.overlap = false;
  const Verdict verdict = judge(hit.query, hit.truth, claim, {});
  Diagnosis diagnosis;
  std::uint64_t key = 0;
  while (key < Diagnosis::kSample) diagnosis.add(++key, hit.query, hit.truth, claim, {}, verdict);
  EXPECT_EQ(diagnosis.findings().at(0).sentence.find("about"), std::string::npos);
  while (key < Diagnosis::kSample + 1000) diagnosis.add(++key, hit.query, hit.truth, claim, {}, verdict);
  const Finding found = diagnosis.findings().at(0);
  EXPECT_NE(found.sentence.find(": explains about 17384 of 17384 wrong overlap claims"), std::string::npos)
      << found.sentence;
  EXPECT_EQ(found.explained, 17384U);
}

TEST(Diagnosis, DoesNotDependOnHowTheAnswersWereDivided) {
  const auto part = [](int which) {
    Campaign run;
    for (int i = 0; i < 9; ++i) {
      const Query query = seven_apart(2, 1 + 0.125 * i, 8, 1 + i);
      if (which != -1 && i % 3 != which) {
        continue;
      }
      run.says(query, value(7)).right(seven_apart(4, 4, 0, i)).says(coincident(), silent);
      run.diagnosis.add_outside_domain(seven_apart(2, -3, 4));
      if (i > 5) run.says(query, value(77)).says(query, value(-7 + 3 + 0.125 * i + 1 + i));
    }
    return run.diagnosis;
  };
  const Diagnosis whole = part(-1);
  Diagnosis merged = part(2);
  merged.merge(part(0));
  merged.merge(part(1));
  EXPECT_EQ(merged.lines(), whole.lines());
  EXPECT_EQ(merged.wrong(), whole.wrong());
  EXPECT_GT(whole.lines().size(), 3U);
  Diagnosis other = merged;
  other.merge(whole);
  EXPECT_EQ(other.wrong().at("value"), 2 * whole.wrong().at("value"));
  EXPECT_TRUE(other.is_sound());
}

}  // namespace
}  // namespace contact::oracle::diagnosis_test
