// Mutants, quickly: each is refuted by committed questions.
#include "engines/mutants.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "engines/engine.hpp"
#include "golden/dataset.hpp"
#include "oracle/diagnosis.hpp"

namespace contact::engines {
namespace {

/// Whether an answer that differs from the right one in something is wrong by more than its bounds.
bool refutes(const Query& query, const Claim& claim, const Claim& right, std::optional<oracle::Truth>& truth) {
  if (outside_domain(query)) return oracle::judge_outside_domain(claim).level() > oracle::Level::bounded;
  const bool same_decisions = claim.status == right.status && claim.overlap == right.overlap &&
                              claim.contact.has_value() == right.contact.has_value();
  const auto numbers = [](const ContactClaim& c) { return std::tie(c.normal, c.point1, c.point2, c.value); };
  if (same_decisions && (!claim.contact || numbers(*claim.contact) == numbers(*right.contact))) return false;
  if (!truth) truth = oracle::truth_of(query);
  return oracle::judge(query, *truth, claim, {}).level() > oracle::Level::bounded;
}

TEST(Mutants, every_one_is_refuted_by_ten_committed_questions_and_more) {
  constexpr int kMany = 10;
  std::vector<std::pair<const Mutant*, int>> left;
  for (const Mutant& m : mutants()) left.emplace_back(&m, 0);
  for (const auto& path : golden::dataset_files({std::filesystem::path(CONTACT_SOURCE_DIR) / "golden"})) {
    golden::DatasetReader reader(path);
    while (const auto c = reader.next()) {
      std::optional<oracle::Truth> truth;
      const Claim right = production_answer(c->query, PointConvention::nearest_surface);
      std::erase_if(left, [&](auto& entry) {
        auto& [mutant, count] = entry;
        count += refutes(c->query, answer_of(*mutant, c->query), right, truth) ? 1 : 0;
        return count == kMany;
      });
    }
  }
  for (const auto& [mutant, count] : left)
    ADD_FAILURE() << mutant->id << " is refuted by " << count << " questions alone";
}

TEST(Mutants, ids_are_unique_and_real_ones_have_their_source) {
  std::set<std::string_view> ids;
  for (const Mutant& m : mutants()) {
    EXPECT_TRUE(ids.insert(m.id).second) << m.id;
    EXPECT_NO_THROW(static_cast<void>(oracle::sentence_of(m.cause))) << m.id;
    EXPECT_EQ(m.source.empty(), m.origin != Origin::real) << m.id;
  }
  EXPECT_GE(ids.size(), 150U);
}

}  // namespace
}  // namespace contact::engines
