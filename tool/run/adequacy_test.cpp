// The quick cases kill what all cases kill, and adequacy.json says so; all of it is computed anew by a slow test.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "engines/zoo/mutants.hpp"
#include "golden/families.hpp"
#include "golden/manifest.hpp"
#include "tool/run/kill_matrix.hpp"

namespace contact::tool {
namespace {

const std::filesystem::path kGolden = std::filesystem::path(CONTACT_SOURCE_DIR) / "golden";

nlohmann::json adequacy() { return nlohmann::json::parse(formats::open_to_read(kGolden / golden::kAdequacyName)); }

TEST(Adequacy, ten_cases_and_more_kill_every_mutant) {
  const nlohmann::json mutants = adequacy()["mutants"];
  ASSERT_EQ(mutants.size(), engines::mutants().size());
  for (std::size_t m = 0; m < mutants.size(); ++m) {
    const std::string id = mutants[m]["id"];
    EXPECT_EQ(id, engines::mutants()[m].id);
    EXPECT_GE(mutants[m]["cases"], kLeastKills) << mutants[m];
  }
}

TEST(Adequacy, the_quick_cases_kill_what_all_kill_and_are_few) {
  std::set<std::string> all;
  std::map<std::string, std::set<std::string>> said;
  const nlohmann::json recorded = adequacy();
  for (const auto& file : recorded["files"]) {
    const std::set<std::string> kills = file["kills"];
    all.insert(kills.begin(), kills.end());
    said[file["path"]] = kills;
  }
  const KillMatrix matrix = kill_matrix(kGolden, golden::dataset_files({kGolden / golden::kQuickFolder}));
  std::set<std::string> killed;
  for (const FileKills& file : matrix.files) {
    std::set<std::string> kills;
    for (const std::size_t m : file.mutants) kills.emplace(engines::mutants()[m].id);
    EXPECT_EQ(kills, said[file.path]) << file.path;
    killed.insert(kills.begin(), kills.end());
  }
  EXPECT_EQ(killed, all);
  EXPECT_EQ(killed.size(), engines::mutants().size());
  EXPECT_LT(matrix.cases.size(), 80U);
}

TEST(Adequacy, every_file_refutes_who_always_answers_alike_but_those_of_hits_alone) {
  std::map<std::string, nlohmann::json> listed;
  const nlohmann::json manifest = nlohmann::json::parse(formats::open_to_read(kGolden / golden::kManifestName));
  for (const auto& file : manifest["files"]) listed[file["path"]] = file;
  const auto hits_alone = golden::families_of_hits_alone();
  std::set<std::pair<bool, std::string>> met;
  std::map<std::string, std::set<std::string>> quick;  // of a pair
  std::size_t files = 0;
  const nlohmann::json recorded = adequacy();
  for (const auto& file : recorded["files"]) {
    const std::string path = file["path"];
    const nlohmann::json& entry = listed[path];
    const std::string family = entry["family"];
    const std::set<std::string> kills = file["kills"];
    if (family == golden::kInvalidFamily) continue;  // it asks for a refusal, and no decision
    ++files;
    if (entry["origin"] == "selected") {
      quick[entry["pair"]].insert(kills.begin(), kills.end());
      continue;
    }
    const bool spheres = entry["pair"] != "cube_cube";
    const bool of_hits = std::any_of(hits_alone.begin(), hits_alone.end(), [&](const golden::FamilyNote& f) {
      return (f.pair != Pair::cube_cube) == spheres && f.family == family;
    });
    if (of_hits) met.emplace(spheres, family);
    EXPECT_EQ(kills.contains(std::string(engines::kAlwaysHit)), !of_hits) << path;
    EXPECT_TRUE(kills.contains(std::string(engines::kAlwaysMiss))) << path;
    EXPECT_EQ(entry["hits"] == entry["count"], of_hits) << path;
    EXPECT_NE(entry["hits"], 0) << path;
  }
  EXPECT_GT(files, 60U);
  EXPECT_EQ(met.size(), hits_alone.size()) << "what is listed must be there";
  EXPECT_EQ(quick.size(),
            std::count_if(kPairs.begin(), kPairs.end(), [](Pair pair) { return golden::committed_count(pair) > 0; }));
  for (const auto& [pair, kills] : quick)
    for (const std::string_view id : {engines::kAlwaysHit, engines::kAlwaysMiss})
      EXPECT_TRUE(kills.contains(std::string(id))) << "quick " << pair << " " << id;
}

/// Cases that kill the given mutants, and nothing else of them.
std::vector<CaseKills> cases(const std::vector<std::vector<std::size_t>>& kills) {
  const Box point{Vector3::Zero(), Vector3::Zero()};
  const Query query{Pair::cube_cube, Boxes{point, point}, {}};
  std::vector<CaseKills> all;
  for (const auto& mutants : kills) all.push_back({0, "", query, mutants});
  return all;
}

std::vector<std::size_t> cover_in_order(const std::vector<CaseKills>& all) {
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  return cover(all, order);
}

using Places = std::vector<std::size_t>;

TEST(Cover, takes_what_kills_most_of_those_left_and_the_first_of_equals) {
  EXPECT_EQ(cover_in_order(cases({{0}, {0, 1, 2}, {3}, {2, 3}, {3}})), (Places{1, 2}));
  EXPECT_EQ(cover(cases({{0, 1}, {0, 1}, {1}}), {2, 1, 0}), (Places{1}));
  EXPECT_EQ(cover_in_order(cases({{}, {}})), Places{});
}

TEST(Cover, leaves_out_a_case_whose_kills_the_others_have_too) {
  // Greed takes the middle case first, and then needs both others, which kill all of it.
  EXPECT_EQ(cover_in_order(cases({{0, 1, 2}, {1, 2, 3, 4}, {3, 4, 5}})), (Places{0, 2}));
}

TEST(Cover, kills_all_and_no_case_of_it_can_be_spared) {
  std::uint64_t state = 1;
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Places> kills(12);
    for (Places& mutants : kills)
      for (std::size_t m = 0; m < 10; ++m)
        if (state = state * 6364136223846793005 + 1442695040888963407; state >> 62 == 0) mutants.push_back(m);
    const auto all = cases(kills);
    const auto union_of = [&](const Places& places, std::size_t but) {
      std::set<std::size_t> mutants;
      for (const std::size_t i : places)
        if (i != but) mutants.insert(kills[i].begin(), kills[i].end());
      return mutants;
    };
    Places every(kills.size());
    std::iota(every.begin(), every.end(), std::size_t{0});
    const Places chosen = cover_in_order(all);
    const auto whole = union_of(every, kills.size());
    EXPECT_EQ(union_of(chosen, kills.size()), whole);
    for (const std::size_t i : chosen) EXPECT_NE(union_of(chosen, i), whole) << "trial " << trial << " case " << i;
  }
}

}  // namespace
}  // namespace contact::tool
