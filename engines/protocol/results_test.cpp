// What engines say on paper: declarations and claims, written and read back.
#include "engines/protocol/results.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace contact::engines {
namespace {

EngineInfo read_back(const EngineInfo& info) {
  const formats::Location where{"here", 1};
  const auto json = formats::parse_object(to_line(info), where);
  return read_engine_info(formats::Node(json, where), {"format", "version"});
}

Claim claim_of(const std::string& text) {
  const formats::Location where{"here", 1};
  const auto json = formats::parse_object(text, where);
  return read_claim(formats::Node(json, where));
}

TEST(Claim, ADecimalOfABinary32NumberIsThisNumberAndNoOtherNumberIsChanged) {
  const std::string text =
      R"({"contact":{"normal":[0.1,0.5,14.8314590],"point":[1e-45,3.4028235e38,0.10000000149],"value":14.83145901234}})";
  Claim claim = claim_of(text);
  EXPECT_EQ(settle_decimals(claim, Scalar::binary64), 0);
  EXPECT_EQ(claim.contact->value, 14.83145901234);
  EXPECT_EQ(settle_decimals(claim, Scalar::binary32), 5);
  EXPECT_EQ(*claim.contact->normal, Vector3(0x1.99999ap-4, 0.5, 0x1.da9b5p+3));
  EXPECT_EQ(*claim.contact->point, Vector3(0x1p-149, 0x1.fffffep127, 0x1.99999ap-4));
  EXPECT_EQ(claim.contact->value, 14.83145901234);  // a binary32 number has other digits there
  EXPECT_EQ(settle_decimals(claim, Scalar::binary32), 0);
}

TEST(EngineInfo, EveryConventionSurvivesWritingAndReading) {
  EngineInfo info;
  info.name = "an \"engine\"";
  info.version = "1";
  info.pairs = {Pair::cube_cube};
  info.declared.scalar = Scalar::binary32;
  info.declared.bounds = {3, 2, 64};
  Conventions& c = info.declared.conventions;
  const auto same = [&] {
    const EngineInfo back = read_back(info);
    return back.name == info.name && back.pairs == info.pairs && back.declared.scalar == info.declared.scalar &&
           back.declared.bounds == info.declared.bounds && back.declared.conventions == c;
  };
  EXPECT_TRUE(same());
  c.normal = NormalDirection::second_to_first;
  c.normal_unit = false;
  c.value_less_contact = false;
  c.touching_overlap = Touching::open;
  c.scale_min = 1e-30;
  c.scale_max = 1e30;
  EXPECT_TRUE(same());
  for (std::size_t i = 0; i < kPointsNames.size(); ++i) {
    c.points = static_cast<Points>(i);
    c.value = static_cast<ValueKind>(i % kValueKindNames.size());
    c.margin = static_cast<Margin>(i % kMarginNames.size());
    c.coincident = static_cast<Coincident>(i % kCoincidentNames.size());
    c.touching_contact = static_cast<Touching>(i % kTouchingNames.size());
    c.shapes = static_cast<ShapesAs>(i % kShapesAsNames.size());
    c.depth = static_cast<DepthOf>(i % kDepthOfNames.size());
    c.most_points = c.points == Points::manifold ? 3 : 8;
    EXPECT_TRUE(same()) << kPointsNames[i];
  }
}

TEST(EngineInfo, ClaimsSurviveWritingAndReadingAndAreAbsentWhereNotDeclared) {
  EngineInfo info;
  EXPECT_EQ(to_line(info).find("claims"), std::string::npos);
  EXPECT_FALSE(read_back(info).declared.claims);
  info.declared.claims = Aspects{Aspect::overlap, Aspect::contact, Aspect::value};
  EXPECT_NE(to_line(info).find(R"("claims":["overlap","contact","value"])"), std::string::npos);
  EXPECT_EQ(read_back(info).declared.claims, info.declared.claims);
}

TEST(EngineInfo, WhatIsRoundedSurvivesWritingAndReadingAndIsAbsentWhereNotDeclared) {
  EngineInfo info;
  EXPECT_EQ(to_line(info).find("rounds"), std::string::npos);
  EXPECT_FALSE(read_back(info).declared.rounds_orientation);
  info.declared.rounds_orientation = true;
  EXPECT_NE(to_line(info).find(R"("rounds":["orientation"])"), std::string::npos);
  EXPECT_TRUE(read_back(info).declared.rounds_orientation);
}

EngineInfo declaring(const std::string& text) {
  const formats::Location where{"here", 1};
  const auto json = formats::parse_object(
      R"({"engine":{"name":"x","version":"1"},"scalar":"binary64","pairs":["sphere_sphere"],)" + text + "}", where);
  return read_engine_info(formats::Node(json, where), {});
}

TEST(EngineInfo, APairHasTheConventionsOfAllButForWhatItNames) {
  const EngineInfo info = declaring(
      R"("conventions":{"points":"none","value":"depth"},"pair_conventions":{"sphere_sphere":{"points":"midpoint"}},)"
      R"("claims":["overlap","point"])");
  Conventions own = info.declared.conventions;
  own.points = Points::midpoint;
  EXPECT_EQ(info.declared_for(Pair::sphere_sphere).conventions, own);
  EXPECT_EQ(info.declared_for(Pair::cube_cube), info.declared);
  EXPECT_EQ(read_back(info).pair_conventions, info.pair_conventions);
  EXPECT_TRUE(info.declared_for(Pair::sphere_sphere).claimed().has(Aspect::point));
  EXPECT_FALSE(info.declared.claimed().has(Aspect::point));
}

TEST(EngineInfo, APairOfAnyScaleKeepsItWhereTheEngineHasOne) {
  const EngineInfo info = declaring(R"("conventions":{"scale":{"min":0,"max":1e10}},)"
                                    R"("pair_conventions":{"sphere_sphere":{"scale":{"min":0,"max":"Infinity"}}})");
  ASSERT_EQ(info.declared_for(Pair::sphere_sphere).conventions, Conventions{});
  EXPECT_EQ(read_back(info).declared.conventions, info.declared.conventions);
  EXPECT_EQ(read_back(info).pair_conventions, info.pair_conventions);
}

TEST(EngineInfo, ConventionsOfAPairThatIsNotServedOrNotKnownAreRefused) {
  for (const char* of_pairs :
       {R"({"cube_cube":{}})", R"({"cone_cone":{}})", R"({"sphere_sphere":{"points":"centre"}})", "[]"})
    EXPECT_THROW(declaring(R"("pair_conventions":)" + std::string(of_pairs)), formats::InputError) << of_pairs;
}

TEST(EngineInfo, ANumberThatIsClaimedIsOneOfAContact) {
  EXPECT_EQ(declaring(R"("claims":["normal"])").declared.claims, (Aspects{Aspect::contact, Aspect::normal}));
}

TEST(EngineInfo, ClaimsOfNothingOfWhatThereIsNotAndAgainstTheConventionsAreRefused) {
  for (const char* claims :
       {R"("claims":[])", R"("claims":["speed"])", R"("claims":"overlap")", R"("claims":["point"])",
        R"("conventions":{"points":"none"},"claims":["overlap","point1"])",
        R"("conventions":{"value":"none"},"claims":["value"])",
        R"("conventions":{"points":"first_only"},"claims":["point2"])",
        R"("conventions":{"points":"midpoint"},"claims":["point1"])"})
    EXPECT_THROW(declaring(claims), formats::InputError) << claims;
}

TEST(Claim, AnAbsentKeyMakesNoClaimAndNullClaimsNoContact) {
  EXPECT_FALSE(claim_of(R"({"overlap":true})").speaks_of_contact);
  EXPECT_FALSE(claim_of(R"({"contact":null})").overlap.has_value());
  EXPECT_TRUE(claim_of(R"({"contact":null})").speaks_of_contact);
  EXPECT_FALSE(claim_of(R"({"contact":null})").contact.has_value());
  const Claim partial = claim_of(R"({"contact":{"value":"-Infinity"}})");
  EXPECT_FALSE(partial.contact->normal.has_value());
  EXPECT_EQ(*partial.contact->value, -std::numeric_limits<double>::infinity());
}

TEST(Claim, SurvivesWritingAndReading) {
  for (
      const std::string line :
      {R"({"id":"x","overlap":true,"contact":{"normal":[1,0,0],"point1":["NaN",0,0.1],"point2":[0,0,0],"value":-1}})",
       R"({"id":"x","contact":null})", R"({"id":"x","unsupported":"why"})", R"({"id":"x","rejected":"alarm"})",
       R"({"id":"x","error":"text"})", R"({"id":"x","overlap":false,"contact":{"point":[1,2,3]}})",
       R"({"id":"x","contact":{"normal":[0,0,1],"points":[[1,2,3],["NaN",0.1,5]],"depths":[0.25,"Infinity"],"value":1}})"})
    EXPECT_EQ(to_line("x", claim_of(line)), line);
  Claim rounded = claim_of(R"({"contact":{"points":[[0.1,0,0]],"depths":[0.10000000149]}})");
  EXPECT_EQ(settle_decimals(rounded, Scalar::binary32), 2);
  EXPECT_EQ(rounded.contact->points[0].at[0], 0x1.99999ap-4);
  EXPECT_EQ(rounded.contact->points[0].depth, 0x1.99999ap-4);
}

TEST(Claim, HasFromOneTo64PointsEachWithItsDepth) {
  const auto text = [](std::size_t points, std::size_t depths) {
    std::string all = R"({"contact":{"points":[)";
    for (std::size_t i = 0; i < points; ++i) all += i == 0 ? "[1,2,3]" : ",[1,2,3]";
    all += R"(],"depths":[)";
    for (std::size_t i = 0; i < depths; ++i) all += i == 0 ? "0" : ",0";
    return all + "]}}";
  };
  EXPECT_EQ(claim_of(text(64, 64)).contact->points.size(), 64U);
  for (const std::string& wrong :
       {text(65, 65), text(0, 0), text(2, 1), text(1, 2), std::string(R"({"contact":{"points":[[1,2,3]]}})"),
        std::string(R"({"contact":{"depths":[1]}})"), std::string(R"({"contact":{"points":[[1,2]],"depths":[1]}})")})
    EXPECT_THROW(claim_of(wrong), formats::InputError) << wrong;
}

TEST(EngineInfo, DeclaresFrom1To64Points) {
  for (const char* most : {"0", "65", "-1", "1.5", "\"4\""})
    EXPECT_THROW(declaring(R"("conventions":{"points":"manifold","most_points":)" + std::string(most) + "}"),
                 formats::InputError)
        << most;
  const EngineInfo info = declaring(R"("conventions":{"points":"manifold","most_points":64},"claims":["points"])");
  EXPECT_EQ(info.declared.conventions.most_points, 64);
  EXPECT_EQ(info.declared.claims, (Aspects{Aspect::contact, Aspect::points}));
}

TEST(Claim, CannotClaimAndExcuseItselfAtOnce) {
  EXPECT_THROW(claim_of(R"({"overlap":true,"error":"x"})"), formats::InputError);
  EXPECT_THROW(claim_of(R"({"unsupported":"x","error":"x"})"), formats::InputError);
}

}  // namespace
}  // namespace contact::engines
