// Production's function for two boxes against both oracles; the laws of any engine are in laws.cpp.
#include "contact/cube_cube.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "oracle/truth/interval_oracle.hpp"
#include "oracle/truth/truth.hpp"
#include "proptests/generators.hpp"

namespace contact {
namespace {

using namespace proptests;

bool test(const Query& query) {
  const Boxes& boxes = *query.boxes();
  return test_cube_cube(boxes.a, boxes.b, query.distances.alarm);
}

RC_GTEST_PROP(CubeCube, production_equals_both_oracles, ()) {
  const Query query = *box_queries(Range());
  RC_ASSERT(!outside_domain(query));
  const bool hit = test(query);
  RC_ASSERT(hit == oracle::truth_of(query).hit());
  RC_ASSERT(hit == oracle::interval_answer(query, Scalar::binary64).expected.hit);
}

// What the laws were asked: shares of a sample with a fixed seed.
TEST(CubeCubeQuestions, are_hits_by_half_and_hold_enough_of_every_kind) {
  constexpr int kCount = 6000;
  int hits = 0;
  int exactly = 0;
  int rounded_otherwise = 0;
  int subnormal_input = 0;
  int flat = 0;
  for (const Query& query : sample(box_queries(Range()), kCount)) {
    if (!Range().contains(query)) continue;
    const oracle::Truth truth = oracle::truth_of(query);
    const auto& [a, b] = *query.boxes();
    hits += truth.hit() ? 1 : 0;
    exactly += truth.at_alarm == oracle::Side::at ? 1 : 0;
    bool plain = true;
    bool has_subnormal = false;
    bool has_flat = false;
    for (int axis = 0; axis < 3; ++axis) {
      plain = plain && a.min[axis] <= b.max[axis] + query.distances.alarm &&
              b.min[axis] <= a.max[axis] + query.distances.alarm;
      has_flat = has_flat || a.min[axis] == a.max[axis] || b.min[axis] == b.max[axis];
    }
    for_each_number(query, [&](const std::string&, double x) {
      has_subnormal = has_subnormal || (x != 0 && std::abs(x) < 0x1p-1022);
    });
    rounded_otherwise += plain != truth.hit() ? 1 : 0;
    subnormal_input += has_subnormal ? 1 : 0;
    flat += has_flat ? 1 : 0;
  }
  const auto share = [](int count) { return 100.0 * count / kCount; };
  const auto report = [&](const char* kind, int count) { RecordProperty(kind, std::to_string(share(count)) + " %"); };
  report("hits", hits);
  report("exactly at the alarm distance", exactly);
  report("decided otherwise in plain double", rounded_otherwise);
  report("subnormal input", subnormal_input);
  report("flat box", flat);
  EXPECT_GT(share(hits), 30);
  EXPECT_LT(share(hits), 70);
  EXPECT_GT(share(exactly), 5);
  EXPECT_GT(share(rounded_otherwise), 1);
  EXPECT_GT(share(subnormal_input), 15);
  EXPECT_GT(share(flat), 5);
}

}  // namespace
}  // namespace contact
