// Every mutant against the committed golden files: refuted, and told why.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <set>
#include <string>

#include "engines/mutants.hpp"
#include "tool/pipeline.hpp"

namespace contact::tool {
namespace {

/// Every mutant over every committed file, the family `invalid` included, in one pass.
const std::vector<Subject>& judged() {
  static const std::vector<Subject> all = [] {
    std::vector<Subject> subjects;
    for (const engines::Mutant& m : engines::mutants()) {
      subjects.push_back({engines::make_built_in(std::string(engines::kMutantPrefix) + std::string(m.id)), {}});
      subjects.back().report.engine = subjects.back().engine->info();
    }
    Stop never;
    for (const auto& path : golden::dataset_files({std::filesystem::path(CONTACT_SOURCE_DIR) / "golden"})) {
      const golden::DatasetHeader h = golden::DatasetReader(path).header();
      judge_source({h.pair, h.scalar, h.family, h.count, path}, subjects, never);
    }
    return subjects;
  }();
  return all;
}

/// The mutants whose first diagnosis is another than the expected one, and why that is as it should be.
const std::map<std::string_view, std::string_view> kOtherwiseDiagnosed{};

TEST(Mutants, every_mutant_is_refuted_by_the_committed_files) {
  for (const Subject& s : judged()) EXPECT_FALSE(s.report.certified()) << s.report.engine.name;
}

TEST(Mutants, the_first_diagnosis_of_at_least_95_in_100_names_the_mistake) {
  std::size_t right = 0;
  for (std::size_t i = 0; i < engines::mutants().size(); ++i) {
    const engines::Mutant& m = engines::mutants()[i];
    const auto found = judged()[i].report.why.findings();
    const bool named = !found.empty() && found.front().cause == m.cause;
    right += named ? 1 : 0;
    if (named == kOtherwiseDiagnosed.contains(m.id))
      ADD_FAILURE() << m.id << " should be diagnosed as " << m.cause << ", and is as\n  "
                    << (found.empty() ? "nothing" : std::string(found.front().cause) + ": " + found.front().sentence);
  }
  EXPECT_GE(right * 100, engines::mutants().size() * 95);
  RecordProperty("right", std::to_string(right) + " of " + std::to_string(engines::mutants().size()));
}

TEST(Mutants, ids_are_unique_and_every_expected_diagnosis_exists) {
  std::set<std::string_view> ids;
  for (const engines::Mutant& m : engines::mutants()) {
    EXPECT_TRUE(ids.insert(m.id).second) << m.id;
    EXPECT_NO_THROW(static_cast<void>(oracle::sentence_of(m.cause))) << m.id;
    EXPECT_EQ(m.source.empty(), m.origin != engines::Origin::real) << m.id;
  }
  EXPECT_GE(ids.size(), 150U);
}

}  // namespace
}  // namespace contact::tool
