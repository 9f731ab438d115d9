// The laws of two boxes: production against both oracles, and what swapping, scaling, turning and growing must do.
#include "contact/cube_cube.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "oracle/interval_oracle.hpp"
#include "oracle/truth.hpp"
#include "proptests/generators.hpp"

namespace contact {
namespace {

using namespace proptests;

bool test(const Query& query) {
  const Boxes& boxes = *query.boxes();
  return test_cube_cube(boxes.a, boxes.b, query.distances.alarm);
}
Boxes& boxes_in(Query& query) { return std::get<Boxes>(query.shapes); }

RC_GTEST_PROP(CubeCubeLaws, production_equals_both_oracles, ()) {
  const Query query = *box_queries();
  RC_ASSERT(!outside_domain(query));
  const bool hit = test(query);
  RC_ASSERT(hit == oracle::truth_of(query).hit());
  RC_ASSERT(hit == oracle::interval_answer(query, Scalar::binary64).expected.hit);
}

RC_GTEST_PROP(CubeCubeLaws, swapped_boxes_have_the_same_answer, ()) {
  const Query query = *box_queries();
  RC_ASSERT(test(query) == test_cube_cube(query.boxes()->b, query.boxes()->a, query.distances.alarm));
}

RC_GTEST_PROP(CubeCubeLaws, a_hit_stays_a_hit_when_a_box_or_the_alarm_distance_grows, ()) {
  const Query query = *box_queries();
  RC_PRE(test(query));
  const double x = *any_number();
  const int axis = *integer(0, 2);
  Query grown = query;
  auto& [a, b] = boxes_in(grown);
  switch (*integer(0, 4)) {
    case 0:
      a.min[axis] = std::min(moved(a.min[axis], -1), x);
      break;
    case 1:
      a.max[axis] = std::max(moved(a.max[axis], 1), x);
      break;
    case 2:
      b.min[axis] = std::min(moved(b.min[axis], -1), x);
      break;
    case 3:
      b.max[axis] = std::max(moved(b.max[axis], 1), x);
      break;
    default:
      grown.distances.alarm = std::max(moved(grown.distances.alarm, 1), x);
  }
  RC_ASSERT(test(grown));
}

RC_GTEST_PROP(CubeCubeLaws, a_miss_stays_a_miss_when_the_alarm_distance_shrinks, ()) {
  Query query = *box_queries();
  RC_PRE(!test(query));
  query.distances.alarm = std::min(query.distances.alarm, *any_length());
  RC_ASSERT(!test(query));
}

RC_GTEST_PROP(CubeCubeLaws, boxes_separated_by_exactly_the_alarm_distance_are_a_hit_and_one_ulp_more_is_none, ()) {
  // Corners and the alarm on one grid of integers below 2^50, so that their sums are exact; the gap lies on one axis.
  const int exponent = *integer(-1074, 900);
  const auto whole = [&] {
    return std::ldexp(static_cast<double>(*full_size(rc::gen::inRange<std::int64_t>(-(1LL << 48), 1LL << 48))),
                      exponent);
  };
  const auto box = [](const Vector3& p, const Vector3& q) { return Box{p.cwiseMin(q), p.cwiseMax(q)}; };
  const auto corner = [&] {
    const double x = whole();
    const double y = whole();
    return Vector3(x, y, whole());
  };
  const Vector3 p = corner();
  const Box a = box(p, corner());
  const double alarm = std::abs(whole());
  const int axis = *integer(0, 2);
  Box above = a;
  above.min[axis] = a.max[axis] + alarm;
  above.max[axis] = above.min[axis] + std::abs(whole());
  RC_ASSERT(test_cube_cube(a, above, alarm));
  above.min[axis] = moved(above.min[axis], 1);
  above.max[axis] = std::max(above.max[axis], above.min[axis]);
  RC_ASSERT(!test_cube_cube(a, above, alarm));
  Box below = a;
  below.max[axis] = a.min[axis] - alarm;
  below.min[axis] = below.max[axis] - std::abs(whole());
  RC_ASSERT(test_cube_cube(a, below, alarm));
  below.max[axis] = moved(below.max[axis], -1);
  below.min[axis] = std::min(below.max[axis], below.min[axis]);
  RC_ASSERT(!test_cube_cube(a, below, alarm));
}

RC_GTEST_PROP(CubeCubeLaws, a_power_of_two_changes_no_answer, ()) {
  const Query query = *rc::gen::oneOf(boxes_from(small_dyadic()), boxes_near_touching(beside_dyadic()),
                                      boxes_near_touching(ordinary()));
  const int exponent = *integer(0, 900);  // upward, which is exact for subnormals, too
  Query scaled = query;
  for_each_number(scaled, [&](const std::string&, double& x) { x = std::ldexp(x, exponent); });
  RC_ASSERT(test(scaled) == test(query));
}

RC_GTEST_PROP(CubeCubeLaws, permuting_and_reflecting_axes_changes_no_answer, ()) {
  const Query query = *box_queries();
  const auto order = *rc::gen::elementOf(
      std::vector<std::array<int, 3>>{{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}});
  const std::array<bool, 3> reflected{*integer(0, 1) == 1, *integer(0, 1) == 1, *integer(0, 1) == 1};
  const auto turned = [&](const Box& box) {
    Box result = box;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      const double low = box.min[order[i]];
      const double high = box.max[order[i]];
      result.min[axis] = reflected[i] ? -high : low;
      result.max[axis] = reflected[i] ? -low : high;
    }
    return result;
  };
  RC_ASSERT(test_cube_cube(turned(query.boxes()->a), turned(query.boxes()->b), query.distances.alarm) == test(query));
}

// What the laws were asked: shares of a sample with a fixed seed.
TEST(CubeCubeQuestions, are_hits_by_half_and_hold_enough_of_every_kind) {
  constexpr int kCount = 6000;
  int hits = 0;
  int exactly = 0;
  int rounded_otherwise = 0;
  int subnormal_input = 0;
  int flat = 0;
  for (const Query& query : sample(box_queries(), kCount)) {
    ASSERT_FALSE(outside_domain(query));
    const oracle::Truth truth = oracle::truth_of(query);
    const auto& [a, b] = *query.boxes();
    hits += truth.hit() ? 1 : 0;
    exactly += truth.at_alarm == CGAL::ZERO ? 1 : 0;
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
