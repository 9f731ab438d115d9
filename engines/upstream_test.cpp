// SOFA's own answers, recorded from the compiled component, against plain-double: the emulation is SOFA to the bit.
#include <gtest/gtest.h>

#include <filesystem>

#include "engines/engine.hpp"
#include "golden/dataset.hpp"
#include "golden/right_case.hpp"

namespace contact::engines {
namespace {

/// Equal bit for bit, NaN where NaN; the sign of a zero does not count.
bool same(double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); }
bool same(const Vector3& x, const Vector3& y) { return same(x[0], y[0]) && same(x[1], y[1]) && same(x[2], y[2]); }

TEST(Upstream, PlainDoubleUnderTheCenterConventionIsSofaToTheBit) {
  const auto sofa = make_built_in("plain-double", PointConvention::center);
  const std::filesystem::path golden = std::filesystem::path(CONTACT_SOURCE_DIR) / "golden";
  std::size_t compared = 0;
  std::size_t contacts = 0;
  std::size_t not_finite = 0;
  for (const Pair pair : kPairs) {
    if (!is_discrete_intersections(pair)) continue;
    const std::string folder(name(pair));
    const engines::Results recorded = engines::read_results(golden / "recorded/sofa-2a278d8" / (folder + ".jsonl"));
    golden::DatasetReader reader(golden / folder / "upstream.jsonl", golden::is_made);
    while (const auto c = reader.next()) {
      const auto it = recorded.claims.find(c->id);
      ASSERT_NE(it, recorded.claims.end()) << c->id;
      const Claim& theirs = it->second;
      const std::vector<Question> question{{c->id, c->query}};
      const Claim ours = sofa->answer(question).front();
      ++compared;
      EXPECT_EQ(ours.overlap, theirs.overlap) << c->id;
      EXPECT_EQ(ours.contact.has_value(), theirs.contact.has_value()) << c->id;
      if (!ours.contact || !theirs.contact) continue;
      ++contacts;
      not_finite += theirs.contact->normal->allFinite() ? 0 : 1;
      EXPECT_TRUE(same(*ours.contact->normal, *theirs.contact->normal)) << c->id;
      EXPECT_TRUE(same(*ours.contact->point1, *theirs.contact->point1)) << c->id;
      EXPECT_TRUE(same(*ours.contact->point2, *theirs.contact->point2)) << c->id;
      EXPECT_TRUE(same(*ours.contact->value, *theirs.contact->value)) << c->id;
    }
  }
  EXPECT_EQ(compared, 2400U);
  EXPECT_GT(contacts, 900U);
  EXPECT_GT(not_finite, 200U);
  RecordProperty("contacts", static_cast<int>(contacts));
}

}  // namespace
}  // namespace contact::engines
