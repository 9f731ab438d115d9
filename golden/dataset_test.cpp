// Golden files on paper: numbers, ids, lines and what reading gives back. (Bad input: tool/cli_test.py.)
#include "golden/dataset.hpp"
#include "golden/right_case.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "formats/output_file.hpp"
#include "formats/sha256.hpp"
#include "golden/families.hpp"
#include "golden/lint.hpp"
#include "golden/query_id.hpp"

namespace contact::golden {
namespace {

const Query kWorkedSpheres{Pair::sphere_sphere, Balls{{{0, 0, 0}, 1.5}, {{1, 2, 2}, 1.5}}, {0, 0.25}};
const Query kWorkedCubes{Pair::cube_cube, Boxes{{{0, 0, 0}, {1, 1, 1}}, {{1, 0, 0}, {2, 1, 1}}}, {0.5, 0}};

TEST(Numbers, AreShortestAndIntegersFrom2To53AreScientific) {
  EXPECT_EQ(formats::number(0.1), "0.1");
  EXPECT_EQ(formats::number(1.0), "1");
  EXPECT_EQ(formats::number(-0.0), "0");
  EXPECT_EQ(formats::number(0x1p-1074), "5e-324");
  EXPECT_EQ(formats::number(9007199254740991.0), "9007199254740991");       // 2^53 - 1
  EXPECT_EQ(formats::number(9007199254740992.0), "9.007199254740992e+15");  // 2^53
  EXPECT_EQ(formats::number(123456789012345680.0), "1.2345678901234568e+17");
  EXPECT_EQ(formats::number(std::numeric_limits<double>::max()), "1.7976931348623157e+308");
  EXPECT_EQ(formats::number(std::numeric_limits<double>::quiet_NaN()), "\"NaN\"");
  EXPECT_EQ(formats::number(-std::numeric_limits<double>::infinity()), "\"-Infinity\"");
}

TEST(Numbers, ReadBackAsTheSameBinary64) {
  const formats::Location where{"here", 1};
  for (const CommittedFile& file : committed_files()) {
    if (file.family->outside_domain) continue;
    for (std::uint64_t i = 0; i < 50; ++i) {
      const Query query = generate_query(file.pair, *file.family, file.scalar, 3, i);
      const auto json = formats::parse_object(query_line(query, file.scalar), where);
      EXPECT_EQ(query_id(read_query(formats::Node(json, where)).query), query_id(query)) << file.path() << " " << i;
    }
  }
}

TEST(QueryId, OfTheWorkedExamples) {
  // docs/formats.md; recomputed with Python's hashlib and struct.
  EXPECT_EQ(query_id(kWorkedSpheres), "7827fbcb904c1b0d7baa72b0");
  EXPECT_EQ(query_id(kWorkedCubes), "39f8ccec244e593cfa1b7ad5");
}

TEST(QueryId, TakesNegativeZeroForZeroAndEveryNanForOne) {
  Query query = kWorkedSpheres;
  std::get<Balls>(query.shapes).a.center[1] = -0.0;
  EXPECT_EQ(query_id(query), "7827fbcb904c1b0d7baa72b0");
  std::get<Balls>(query.shapes).a.center[1] = std::numeric_limits<double>::quiet_NaN();
  const std::string nan = query_id(query);
  std::get<Balls>(query.shapes).a.center[1] = -std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(query_id(query), nan);
}

TEST(Case, OfTheWorkedExampleIsTheDocumentedLine) {
  // By hand: delta (1,2,2), D 9, reach 3; n (1,2,2)/3; both points c + 1.5 n = (0.5,1,1); value 3 - 3 - 0.25.
  EXPECT_EQ(
      to_line(make_case(kWorkedSpheres, Scalar::binary64)),
      R"({"id":"7827fbcb904c1b0d7baa72b0","a":{"center":[0,0,0],"radius":1.5},"b":{"center":[1,2,2],"radius":1.5},)"
      R"("alarm":0,"contact":0.25,"flags":["Touching"],"expect":{"hit":true,"degenerate":false,)"
      R"("normal":[0.3333333333333333,0.6666666666666666,0.6666666666666666],"point1":[0.5,1,1],"point2":[0.5,1,1],)"
      R"("value":-0.25},"exact":{"distance2":"0x9p0","reach":"0x3p0","margin_ulps":0}})");
  EXPECT_EQ(to_line(make_case(kWorkedCubes, Scalar::binary64)),
            R"({"id":"39f8ccec244e593cfa1b7ad5","a":{"min":[0,0,0],"max":[1,1,1]},"b":{"min":[1,0,0],"max":[2,1,1]},)"
            R"("alarm":0.5,"contact":0,"flags":[],"expect":{"hit":true},"exact":{"gap":["0x0p0","-0x1p0","-0x1p0"]}})");
}

TEST(Case, InBinary32RoundsOnceFromTheExactReal) {
  // 1/3 to 24 bits is 11184811 * 2^-25, 2/3 is twice that.
  const Case c = make_case(kWorkedSpheres, Scalar::binary32);
  EXPECT_EQ(c.expect.contact->normal[0], 11184811 * 0x1p-25);
  EXPECT_EQ(c.expect.contact->normal[1], 11184811 * 0x1p-24);
}

TEST(Reader, GivesBackWhatWasWritten) {
  const std::filesystem::path path = std::filesystem::temp_directory_path() / "contact_oracle_reader_test.jsonl";
  DatasetHeader header;
  header.family = "worked";
  header.count = 1;
  {
    formats::OutputFile file(path);
    file.write(to_line(header) + "\n" + to_line(make_case(kWorkedSpheres, Scalar::binary64)) + "\n");
    file.commit();
  }
  DatasetReader reader(path, is_made);
  EXPECT_EQ(to_line(reader.header()), to_line(header));
  const auto c = reader.next();
  ASSERT_TRUE(c);
  EXPECT_EQ(to_line(*c), reader.text());
  EXPECT_FALSE(reader.next());
  std::filesystem::remove(path);
}

TEST(SeenIds, KnowsEveryIdAgainHoweverManyThereAre) {
  const auto id = [](int i) { return formats::Sha256().add(std::to_string(i)).hex().substr(0, kIdLength); };
  SeenIds seen;
  for (int i = 0; i < 5000; ++i) ASSERT_TRUE(seen.insert(SeenIds::Key(id(i)))) << i;
  for (int i = 0; i < 5000; ++i) ASSERT_FALSE(seen.insert(SeenIds::Key(id(i)))) << i;
  // Ids that begin alike, and one of zeros alone.
  const std::string zeros(kIdLength, '0');
  for (const std::string& other : {zeros, zeros.substr(1) + "1", "1" + zeros.substr(1)}) {
    EXPECT_TRUE(seen.insert(SeenIds::Key(other))) << other;
    EXPECT_FALSE(seen.insert(SeenIds::Key(other))) << other;
  }
}

TEST(OutputFile, LeavesNothingBehindWithoutCommit) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "contact_oracle_output_test";
  std::filesystem::create_directory(folder);
  { formats::OutputFile(folder / "x").write("half"); }
  EXPECT_TRUE(std::filesystem::is_empty(folder));
  std::filesystem::remove(folder);
}

TEST(CheckCase, NamesTheFieldTheValueAndTheRightOne) {
  Case c = make_case(kWorkedSpheres, Scalar::binary64);
  const oracle::Truth truth = oracle::truth_of(kWorkedSpheres);
  const formats::Location where{"file.jsonl", 3};
  EXPECT_NO_THROW(check_case(c, Scalar::binary64, truth, where));
  c.expect.contact->point2[1] = 1.0000000000000002;
  try {
    check_case(c, Scalar::binary64, truth, where);
    FAIL();
  } catch (const formats::InputError& error) {
    EXPECT_STREQ(error.what(),
                 "file.jsonl:3: expect.point2[1]: the file says 1.0000000000000002, the exact answer rounds to 1");
  }
}

TEST(CheckCase, ComparesEveryExactNumber) {
  // A cast ray meets the ball of radius 2 around (5,0,0) from a - sqrt(h) = 5 - sqrt(4) on; a ball's centre lies 1 under
  // a face of a box.
  const formats::Location where{"file.jsonl", 3};
  const auto said_of = [&](const char* line, auto change) {
    const auto json = formats::parse_object(line, where);
    const Query query = read_query(formats::Node(json, where)).query;
    Case c = make_case(query, Scalar::binary64);
    const oracle::Truth truth = oracle::truth_of(query);
    EXPECT_NO_THROW(check_case(c, Scalar::binary64, truth, where));
    change(c.exact);
    try {
      check_case(c, Scalar::binary64, truth, where);
    } catch (const formats::InputError& error) {
      return std::string(error.what());
    }
    return std::string("no complaint");
  };
  constexpr const char* kCast = R"({"pair":"cast_sphere","a":{"origin":[0,0,0],"direction":[1,0,0],"length":10},)"
                                R"("b":{"center":[5,0,0],"radius":2},"alarm":0,"contact":0})";
  constexpr const char* kDeep =
      R"({"pair":"sphere_obb","a":{"center":[1,0,0],"radius":0.5},)"
      R"("b":{"center":[0,0,0],"orientation":[0,0,0,1],"extents":[2,3,4]},"alarm":0,"contact":0})";
  EXPECT_EQ(said_of(kCast, [](oracle::Witness& w) { (*w.cast)[0] = "0x7p0"; }),
            "file.jsonl:3: exact.t[0]: the file says 0x7p0, exact is 0x5p0");
  EXPECT_EQ(said_of(kCast, [](oracle::Witness& w) { (*w.cast)[1] = "0x3p0"; }),
            "file.jsonl:3: exact.t[1]: the file says 0x3p0, exact is 0x1p2");
  EXPECT_EQ(said_of(kCast, [](oracle::Witness& w) { w.cast.reset(); }),
            "file.jsonl:3: exact.t[0]: the file says nothing, exact is 0x5p0");
  EXPECT_EQ(said_of(kDeep, [](oracle::Witness& w) { w.depth2 = "0x3p0"; }),
            "file.jsonl:3: exact.depth2: the file says 0x3p0, exact is 0x1p0");
  EXPECT_EQ(said_of(kDeep, [](oracle::Witness& w) { w.depth2.clear(); }),
            "file.jsonl:3: exact.depth2: the file says nothing, exact is 0x1p0");
}

TEST(Lint, CallsBackAfterEveryCaseAndTellsWhatItSaw) {
  int cases = 0;
  const LintedFile file = lint(CONTACT_SOURCE_DIR "/golden/quick/cube_cube.jsonl", false, [&] { ++cases; });
  EXPECT_EQ(cases, 9);
  EXPECT_EQ(file.header.count, 9U);
  EXPECT_TRUE(file.closest.empty());  // boxes have no rounded number
  // What throws there ends the work.
  struct Enough {};
  EXPECT_THROW((void)lint(CONTACT_SOURCE_DIR "/golden/quick/cube_cube.jsonl", false, [] { throw Enough{}; }), Enough);
}

/// Files in which several numbers are exactly as close: the first of them is named, and `lint golden`, which compares all, is a
/// matter of minutes.
TEST(Lint, NamesTheClosestNumbersThatTheManifestNames) {
  const auto manifest = nlohmann::json::parse(formats::read_text(CONTACT_SOURCE_DIR "/golden/manifest.json"));
  for (const std::string path :
       {"capsule_obb/alarm_edge.f32.jsonl", "cast_triangle/from_inside.jsonl", "hull_plane/alarm_edge.jsonl"}) {
    const auto entry = std::find_if(manifest["files"].begin(), manifest["files"].end(),
                                    [&](const auto& each) { return each["path"] == path; });
    ASSERT_NE(entry, manifest["files"].end()) << path;
    nlohmann::json found;
    for (const Closest& each : lint(std::string(CONTACT_SOURCE_DIR "/golden/") + path, true, [] {}).closest)
      found[std::string(each.field)] = {{"log2_ulps", each.log2}, {"id", each.id}};
    EXPECT_EQ(found, (*entry)["closest"]) << path;
  }
}

}  // namespace
}  // namespace contact::golden
