// Mutants: the list is well formed. That each is refuted is for tool/adequacy_test.cpp.
#include "engines/mutants.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string_view>

#include "oracle/diagnosis.hpp"

namespace contact::engines {
namespace {

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
