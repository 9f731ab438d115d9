// What the judge leaves out when it asks what a question's last bits do: it has no effect, in the families of all pairs of hulls.
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <vector>

#include "golden/answer_bytes.hpp"
#include "golden/families.hpp"
#include "oracle/judge/conditioning.hpp"
#include "oracle/truth/exact.hpp"
#include "oracle/truth/truth.hpp"

namespace contact::golden::conditioning_test {
namespace {

// With CONTACT_EVERY_NUMBER set, as ./run campaign does, every number of more questions.
const bool kEvery = std::getenv("CONTACT_EVERY_NUMBER") != nullptr;

/// Also how far apart the shapes are, or how deep in each other: of a miss the answer says nothing else.
std::string answer_to(const Query& query) {
  const oracle::Truth truth(query);
  const oracle::Witness exact = oracle::witness(truth, Scalar::binary64);
  return digest_bytes(oracle::expectation(truth, Scalar::binary64)) + exact.distance2 + " " + exact.depth2;
}

TEST(NumbersWithoutEffect, have_none_to_their_last_bit) {
  struct Count {
    std::size_t idle = 0;
    std::size_t of_misses = 0;  ///< of these
    std::size_t all = 0;
  };
  std::map<std::string, Count> counts;
  std::size_t at = 0;
  for (const CommittedFile& file : committed_files()) {
    if (file.family->outside_domain || !has_hull(file.pair)) continue;
    for (std::uint64_t i = 0; i < (kEvery ? 12 : 3); ++i) {
      Query query = generate_query(file.pair, *file.family, file.scalar, kCommittedSeed, i);
      const std::vector<bool> idle = oracle::numbers_without_effect(query, file.scalar);
      if (idle.empty()) continue;
      const std::string right = answer_to(query);
      const bool is_miss = !oracle::truth_of(query).hit();
      Count& count = counts[std::string(file.family->name)];
      count.all += idle.size();
      std::size_t k = 0;
      for_each_number(query, [&](const std::string& number, double& x) {
        if (!idle[k++]) return;
        ++count.idle;
        count.of_misses += is_miss ? 1 : 0;
        if (!kEvery && ++at % 29 != 0) return;
        const double before = x;
        for (const double beside : {oracle::next_up(before, file.scalar), oracle::next_down(before, file.scalar)}) {
          x = beside;
          ASSERT_TRUE(before == 0 || answer_to(query) == right) << file.path() << " " << i << " " << number;
        }
        x = before;
      });
    }
  }
  // Of cores that are apart and of those that overlap, of ordinary ones and of those that plain double cannot tell.
  for (const char* family : {"generic", "deep", "extreme_scale", "near_touching", "parallel"})
    EXPECT_GT(2 * counts[family].idle, counts[family].all) << family << " " << counts[family].idle;
  EXPECT_GT(counts["generic"].of_misses, 0U);
}

/// Whether each number of the first hull's vertices is left out, vertex by vertex.
std::vector<bool> left_out(const Hull& a, const Hull& b) {
  const std::vector<bool> idle =
      oracle::numbers_without_effect({Pair::hull_hull, Convexes{{a}, {b}}, {0, 0}}, Scalar::binary64);
  std::vector<bool> of_vertices;
  for (std::size_t k = 0; k < a.vertices.size(); ++k) of_vertices.push_back(idle.at(3 * k));
  return of_vertices;
}
/// A box whose edge through (x, y, 0) a shape at the origin looks at.
Hull corner_at(double x, double y) {
  return {{{x, y, -9}, {9, y, -9}, {x, 9, -9}, {9, 9, -9}, {x, y, 9}, {9, y, 9}, {x, 9, 9}, {9, 9, 9}}, 0};
}

TEST(NumbersWithoutEffect, are_not_those_that_another_way_out_hangs_on) {
  // The first vertex is 1/4 deep along y; the second one as deep along x, but for less than what its last bit does. All
  // others lie behind both.
  const Vector3 y(0.875, 1, 0);
  const Vector3 x(1, 0.875, 0);
  const std::vector<Vector3> others{{-1, -1, 0.5}, {-1, -1, -0.5}, {-2, -2, 0}};
  const auto shape = [&](const Vector3& first, const Vector3& second) {
    Hull hull{{first, second}, 0};
    hull.vertices.insert(hull.vertices.end(), others.begin(), others.end());
    return hull;
  };
  EXPECT_EQ(left_out(shape(y, x), corner_at(0.75 - 0x1p-53, 0.75)), (std::vector{false, false, true, true, true}));
  EXPECT_EQ(left_out(shape(x, y), corner_at(0.75, 0.75 - 0x1p-53)), (std::vector{false, false, true, true, true}));
}

TEST(NumbersWithoutEffect, are_not_those_that_lie_an_ulp_behind) {
  // The second vertex is an ulp behind the first; the others lie far behind both. Times 2^-140 the ulp of binary32 is
  // its least number, 2^-149.
  const auto idle = [](double ulp, double unit, Scalar scalar) {
    Hull a{{{0, 1, 0}, {0.5, 1 - ulp, 0}, {0, 0, 1}, {0, 0, -1}}, 0};
    Hull b = corner_at(-9, 2);
    for (Hull* hull : {&a, &b})
      for (Vector3& vertex : hull->vertices) vertex *= unit;
    const std::vector<bool> all =
        oracle::numbers_without_effect({Pair::hull_hull, Convexes{{a}, {b}}, {4 * unit, 0}}, scalar);
    return std::vector{all.at(0), all.at(3), all.at(6), all.at(9)};
  };
  const std::vector needed{false, false, true, true};
  EXPECT_EQ(idle(0x1p-53, 1, Scalar::binary64), needed);
  EXPECT_EQ(idle(0x1p-24, 1, Scalar::binary32), needed);
  EXPECT_EQ(idle(0x1p-9, 0x1p-140, Scalar::binary32), needed);
  EXPECT_EQ(idle(0x1p-34, 0x1p-1040, Scalar::binary64), needed);
  // Sixteen ulps of binary32 behind, none of its last bits reaches the first.
  EXPECT_EQ(idle(0x1p-20, 1, Scalar::binary32), (std::vector{false, true, true, true}));
}

}  // namespace
}  // namespace contact::golden::conditioning_test
