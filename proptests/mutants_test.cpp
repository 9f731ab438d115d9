// The laws against every mutant: which of them no law finds within a few hundred cases.
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "engines/engine.hpp"
#include "engines/zoo/mutants.hpp"
#include "engines/zoo/mutating.hpp"
#include "proptests/run.hpp"

namespace contact::proptests {
namespace {

/// Wrong only where a gap of boxes lies between two distances that are close.
const std::set<std::string> kNotFound{"box-contact-widens"};

/// A law that a mutant breaks within 300 cases, or nothing. Nearly all break one in the first ten, which are the same.
std::string broken_law(const engines::Mutant& mutant) {
  auto engine = engines::make_mutant(mutant.id);
  const auto of_convexes = engines::convex_mutants();
  if (std::none_of(of_convexes.begin(), of_convexes.end(), [&](const auto& m) { return m.id == mutant.id; })) {
    // Only some mutants are of any two convex shapes: the others are not asked about them.
    engines::EngineInfo info = engine->info();
    std::erase_if(info.pairs, [](Pair pair) { return is_convex(pair); });
    engine = std::make_unique<engines::FunctionEngine>(
        std::move(info), [all = std::shared_ptr(std::move(engine))](std::span<const engines::Question> questions) {
          return all->answer(questions);
        });
  }
  // The cases of a law are shared among its pairs: the last few mutants show rarely, and in one of them alone.
  for (const std::uint64_t cases : {10U, 300U, 1500U})
    for (const Law& law : laws()) {
      if (cases > 300 && kNotFound.contains(std::string(mutant.id))) return {};  // it would take minutes
      RunOptions options;
      options.seed = 20;
      options.cases = cases;
      options.names = {std::string(law.name)};
      const RunResult result = run_laws(engine, options);
      if (const LawResult* broken = result.first_violated()) return std::string(broken->law->name);
    }
  return {};
}

TEST(Laws, of_corners_halves_turns_lengths_crossings_and_of_questions_made_of_answers_find_what_they_are_for) {
  for (const auto& [law, mutant] : {std::pair{"corners", "mjx-segment-1e-6"},
                                    {"corners", "capsule-start-only"},
                                    {"corners", "crossing-normal-against"},
                                    {"corners", "hull-last-vertex-missing"},
                                    {"halves", "hull-last-vertex-missing"},
                                    {"halves", "capsule-determinant-1e-6"},
                                    {"onto_point", "mujoco-box-sphere-depth"},
                                    {"tangent_plane", "plane-other-end"},
                                    {"cut_at_point", "capsule-middle-only"},
                                    {"rotate", "hull-bounds"},
                                    {"rotate", "obb-turned-back"},
                                    {"rotate", "plane-not-divided"},
                                    {"without_length", "triangle-area-1e-6"},
                                    {"crossing", "crossing-points-at-start"},
                                    {"crossing", "crossing-value-along"}}) {
    RunOptions options;
    options.seed = 20;
    options.names = {law};
    auto engine = engines::make_mutant(mutant);
    const RunResult result = run_laws(engine, options);
    EXPECT_NE(result.first_violated(), nullptr) << law << " and " << mutant;
  }
}

// Every ninety-sixth, and every one with CONTACT_EVERY_MUTANT set, as ./run campaign does: that takes minutes.
TEST(Laws, find_every_mutant_but_these) {
  const std::size_t step = std::getenv("CONTACT_EVERY_MUTANT") != nullptr ? 1 : 96;
  std::vector<engines::Mutant> asked;
  for (std::size_t i = 0; i < engines::mutants().size(); i += step) asked.push_back(engines::mutants()[i]);
  std::vector<std::string> broken(asked.size());
  tbb::parallel_for(std::size_t{0}, asked.size(), [&](std::size_t i) { broken[i] = broken_law(asked[i]); });
  std::set<std::string> left;
  std::set<std::string> expected;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const std::string id(asked[i].id);
    if (broken[i].empty()) left.insert(id);
    if (kNotFound.contains(id)) expected.insert(id);
  }
  EXPECT_EQ(left, expected);
}

}  // namespace
}  // namespace contact::proptests
