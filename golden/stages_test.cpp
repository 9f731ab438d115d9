// Every stage of the oracle against the others, on every committed case and on fresh questions of every family.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>
#include <variant>

#include "golden/dataset.hpp"
#include "golden/families.hpp"
#include "golden/right_case.hpp"
#include "oracle/truth/quick_witness.hpp"
#include "oracle/truth/staged_oracle.hpp"

namespace contact::golden {
namespace {

using oracle::Stage;

/// Of so many committed cases one is asked; all with CONTACT_EVERY_CASE set, as ./run campaign does: that takes minutes.
const std::uint64_t kEvery = std::getenv("CONTACT_EVERY_CASE") != nullptr ? 1 : 5;
const std::uint64_t kEveryConvex = kEvery == 1 ? 1 : 25;

/// How often a quick stage tells by how much a question is a hit, of those that it decides.
struct Margins {
  std::uint64_t asked = 0;
  std::uint64_t told = 0;
  std::uint64_t of_known_size = 0;

  void add(const oracle::MarginBounds& margin) {
    ++asked;
    told += margin.rounded() ? 1 : 0;
    of_known_size += margin.of_its_size() ? 1 : 0;
  }
};

/// What each stage says by itself is what the exact oracle says, where it says anything.
void expect_stages_agree(const Query& query, Scalar scalar, oracle::StageCounts& decided, Margins& margins) {
  const oracle::Truth truth = oracle::truth_of(query);
  const oracle::RoundedAnswer exact = oracle::rounded_answer(truth, scalar);
  const oracle::Witness witness = oracle::witness(truth, scalar);
  const auto quick = oracle::double_double_answer(query, scalar);
  // As compiled for processors without fma.
  const auto portable = oracle::double_double_answer_without_fma(query, scalar);
  ASSERT_EQ(quick.has_value(), portable.has_value()) << query_line(query, scalar);
  if (quick) {
    ASSERT_EQ(first_difference(*quick, *portable), std::nullopt) << query_line(query, scalar);
    ASSERT_EQ(quick->margin.low, portable->margin.low) << query_line(query, scalar);
    ASSERT_EQ(quick->margin.high, portable->margin.high) << query_line(query, scalar);
    ASSERT_EQ(first_difference(*quick, exact), std::nullopt) << query_line(query, scalar);
    ASSERT_TRUE(quick->margin.allows(witness.margin_ulps)) << query_line(query, scalar);
  }
  if (const auto interval = oracle::interval_answer_within(oracle::kMostBits, query, scalar)) {
    ASSERT_EQ(first_difference(*interval, exact), std::nullopt) << query_line(query, scalar);
    ASSERT_TRUE(interval->margin.allows(witness.margin_ulps)) << query_line(query, scalar);
  }
  if (auto texts = oracle::quick_witness(query)) {
    texts->margin_ulps = witness.margin_ulps;
    ASSERT_EQ(*texts, witness) << query_line(query, scalar);
  }
  const oracle::StagedAnswer staged = oracle::staged_answer(query, scalar);
  ASSERT_EQ(first_difference(rounded_answer(staged), exact), std::nullopt) << query_line(query, scalar);
  decided.add(staged.stage);
  if (query.has_distance() && staged.stage != Stage::exact) margins.add(staged.margin);
}

std::uint64_t count(const oracle::StageCounts& decided, Stage stage) {
  return decided.answers[static_cast<std::size_t>(stage)];
}

TEST(Stages, agree_on_every_committed_case_in_both_scalars) {
  oracle::StageCounts decided;
  Margins margins;
  std::uint64_t cases = 0;
  for (const auto& path : dataset_files({std::filesystem::path(CONTACT_SOURCE_DIR) / "golden"})) {
    DatasetReader reader(path, is_made);
    if (reader.header().family == kInvalidFamily) continue;
    while (const auto c = reader.next()) {
      if (++cases % (is_convex(c->query.pair) ? kEveryConvex : kEvery) != 0) continue;
      for (const Scalar scalar : kScalars)
        ASSERT_NO_FATAL_FAILURE(expect_stages_agree(c->query, scalar, decided, margins));
    }
  }
  EXPECT_GT(cases, 10000U);
  EXPECT_GT(count(decided, Stage::double_double), cases / kEvery);
  EXPECT_GT(count(decided, Stage::interval), cases / kEvery / 10);
  EXPECT_GT(5 * margins.told, 4 * margins.asked) << margins.told << " of " << margins.asked;
  EXPECT_GT(20 * margins.of_known_size, 19 * margins.asked) << margins.of_known_size << " of " << margins.asked;
}

#ifdef CONTACT_SANITIZED
constexpr std::uint64_t kShare = 3;  // with sanitizers a question takes some twenty times as long
#else
constexpr std::uint64_t kShare = 1;
#endif

TEST(Stages, agree_on_fresh_questions_of_every_family) {
  constexpr std::uint64_t kSeed = 20240607;
  oracle::StageCounts decided;
  Margins margins;
  for (const Pair pair : kPairs)
    for (const Family& family : families_of(pair)) {
      if (family.name == kInvalidFamily) continue;
      for (const Scalar scalar : kScalars)
        for (std::uint64_t index = 0; index < (is_convex(pair) ? 6 : 60) / kShare; ++index)
          ASSERT_NO_FATAL_FAILURE(
              expect_stages_agree(generate_query(pair, family, scalar, kSeed, index), scalar, decided, margins));
    }
  EXPECT_GT(count(decided, Stage::double_double), 1000U);
  EXPECT_GT(count(decided, Stage::interval), 100U);
}

TEST(Stages, whole_numbers_of_words_and_long_ones_say_the_same) {
  // Numbers whose first and last bits are so far apart that two words have just room for them, or just none.
  std::mt19937_64 random(5);
  oracle::StageCounts decided;
  Margins margins;
  for (int spread = 0; spread < 16; ++spread)
    for (int i = 0; i < 200; ++i) {
      Query query = zero_query(Pair::sphere_sphere);
      const int shift = static_cast<int>(random() % 120) - 60;
      for_each_number(query, [&](const std::string& field, double& x) {
        const auto digits = static_cast<double>(random() >> 11 | 1 | std::uint64_t{1} << 52);
        x = std::ldexp(digits, shift - 52 - static_cast<int>(random() % static_cast<unsigned>(spread + 1)));
        if (random() % 8 == 0) x = 0;
        if (field.find("center") != std::string::npos && random() % 2 == 0) x = -x;
      });
      // Every other one touches, or nearly: along an axis the sum of lengths is the distance, rounded or not.
      if (i % 2 == 0) {
        auto& [a, b] = std::get<Balls>(query.shapes);
        b.center = a.center;
        b.center[i / 2 % 3] += a.radius + b.radius + query.distances.alarm;
      }
      expect_stages_agree(query, Scalar::binary64, decided, margins);
      ASSERT_FALSE(HasFatalFailure());
    }
  EXPECT_GT(count(decided, Stage::double_double), 1600U);
}

TEST(Stages, the_first_decides_whatever_is_generic) {
  for (const Pair pair : kPairs) {
    if (is_cast(pair)) continue;  // they are left to the exact stage
    oracle::StageCounts decided;
    const Family& generic = *find_family(pair, "generic");
    for (std::uint64_t index = 0; index < 5000; ++index)
      decided.add(
          oracle::staged_answer(generate_query(pair, generic, Scalar::binary64, 1, index), Scalar::binary64).stage);
    // Beside a face of a box a point is a sum of two numbers, which is often a tie: for the interval stage.
    const std::uint64_t least = is_discrete_intersections(pair) ? 4999 : pair == Pair::capsule_cube ? 4000 : 4700;
    EXPECT_GE(count(decided, Stage::double_double), least) << name(pair);
  }
}

}  // namespace
}  // namespace contact::golden
