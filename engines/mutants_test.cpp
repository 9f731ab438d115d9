// Mutants, quickly: each is refuted by a committed question, and what the bug zoo lists is either a mutant or
// explained.
#include "engines/mutants.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "engines/engine.hpp"
#include "golden/dataset.hpp"
#include "oracle/diagnosis.hpp"

namespace contact::engines {
namespace {

/// No committed pair of boxes overflows in max + alarm and is apart on another axis or side: wherever that sum is
/// infinite there, the answer is a hit.
constexpr std::string_view kSurvivor = "box-sum-overflows";

/// The committed files until every mutant has met a question that refutes it, and how many of them each survived.
TEST(Mutants, every_one_is_refuted_by_a_committed_question) {
  std::vector<const Mutant*> left;
  for (const Mutant& m : mutants()) left.push_back(&m);
  for (const auto& path : golden::dataset_files({std::filesystem::path(CONTACT_SOURCE_DIR) / "golden"})) {
    golden::DatasetReader reader(path);
    while (const auto c = reader.next()) {
      const bool outside = outside_domain(c->query).has_value();
      std::optional<oracle::Truth> truth;
      const Claim right = production_answer(c->query, PointConvention::nearest_surface);
      std::erase_if(left, [&](const Mutant* m) {
        const Claim claim = answer_of(*m, c->query);
        if (outside) return oracle::judge_outside_domain(claim).level() > oracle::Level::bounded;
        if (claim.status == right.status && claim.overlap == right.overlap &&
            claim.contact.has_value() == right.contact.has_value() &&
            (!claim.contact ||
             (claim.contact->normal == right.contact->normal && claim.contact->point1 == right.contact->point1 &&
              claim.contact->point2 == right.contact->point2 && claim.contact->value == right.contact->value)))
          return false;
        if (!truth) truth = oracle::truth_of(c->query);
        return oracle::judge(c->query, *truth, claim, {}).level() > oracle::Level::bounded;
      });
    }
  }
  for (const Mutant* m : left) EXPECT_EQ(m->id, kSurvivor) << "survives every committed question";
  EXPECT_EQ(left.size(), 1U);
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
