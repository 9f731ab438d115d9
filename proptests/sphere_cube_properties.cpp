// Production's functions for a sphere and a box against both oracles, and what ties them to the other pairs.
#include "contact/sphere_cube.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "contact/sphere_sphere.hpp"
#include "oracle/truth/interval_oracle.hpp"
#include "oracle/truth/truth.hpp"
#include "proptests/generators.hpp"

namespace contact {
namespace {

using namespace proptests;

rc::Gen<Query> drawn() { return queries(static_cast<const BallAndBox*>(nullptr), Range()); }

const BallAndBox& shapes_in(const Query& query) { return std::get<BallAndBox>(query.shapes); }

std::optional<Contact> computed(const BallAndBox& shapes, Distances distances) {
  return compute_sphere_cube(shapes.a, shapes.b, distances);
}

bool same(const Contact& x, const Contact& y) {
  return x.normal == y.normal && x.point1 == y.point1 && x.point2 == y.point2 && x.value == y.value &&
         x.degenerate == y.degenerate;
}

RC_GTEST_PROP(SphereCube, production_equals_both_oracles, ()) {
  const Query query = *drawn();
  RC_ASSERT(!outside_domain(query));
  const auto& [a, b] = shapes_in(query);
  const Expectation truth = oracle::expectation(oracle::truth_of(query), Scalar::binary64);
  const Expectation second = oracle::interval_answer(query, Scalar::binary64).expected;
  const auto contact = compute_sphere_cube(a, b, query.distances);
  RC_ASSERT(test_sphere_cube(a, b, query.distances.alarm) == truth.hit);
  RC_ASSERT(contact.has_value() == truth.hit);
  RC_ASSERT(second.hit == truth.hit);
  if (!contact) return;
  RC_ASSERT(same(*contact, *truth.contact));
  RC_ASSERT(same(*contact, *second.contact));
}

RC_GTEST_PROP(SphereCube, a_point_box_outside_the_centre_is_a_sphere_of_radius_0, ()) {
  Query query = *drawn();
  auto& [a, b] = std::get<BallAndBox>(query.shapes);
  b.max = b.min;
  RC_PRE(a.center != b.min);
  const auto contact = compute_sphere_cube(a, b, query.distances);
  const auto spheres = compute_sphere_sphere(a, {b.min, 0}, query.distances);
  RC_ASSERT(contact.has_value() == spheres.has_value());
  if (contact) RC_ASSERT(same(*contact, *spheres));
}

RC_GTEST_PROP(SphereCube, a_larger_box_or_sphere_is_hit_as_well, ()) {
  const Query query = *drawn();
  Query more = *drawn();
  const auto& [a, b] = shapes_in(query);
  auto& [wider, larger] = std::get<BallAndBox>(more.shapes);
  wider = {a.center, std::max(a.radius, wider.radius)};
  larger = {b.min.cwiseMin(larger.min), b.max.cwiseMax(larger.max)};
  const double alarm = query.distances.alarm;
  if (test_sphere_cube(a, b, alarm)) RC_ASSERT(test_sphere_cube(wider, larger, std::max(alarm, more.distances.alarm)));
}

RC_GTEST_PROP(SphereCube, of_two_halves_of_a_box_the_nearer_decides, ()) {
  Query query = *drawn();
  auto& [a, b] = std::get<BallAndBox>(query.shapes);
  const int axis = *integer(0, 2);
  const double cut = std::clamp(*any_number(Range()), b.min[axis], b.max[axis]);
  Box low = b;
  Box high = b;
  low.max[axis] = high.min[axis] = cut;
  const double alarm = query.distances.alarm;
  RC_ASSERT(test_sphere_cube(a, b, alarm) == (test_sphere_cube(a, low, alarm) || test_sphere_cube(a, high, alarm)));
}

RC_GTEST_PROP(SphereCube, a_mirror_turns_the_answer_round_unless_two_faces_are_as_near, ()) {
  const Query query = *drawn();
  const int axis = *integer(0, 2);
  BallAndBox mirror = shapes_in(query);
  mirror.a.center[axis] = -mirror.a.center[axis];
  std::swap(mirror.b.min[axis], mirror.b.max[axis]);
  mirror.b.min[axis] = -mirror.b.min[axis];
  mirror.b.max[axis] = -mirror.b.max[axis];
  const auto there = computed(shapes_in(query), query.distances);
  auto back = computed(mirror, query.distances);
  RC_ASSERT(there.has_value() == back.has_value());
  if (!there) return;
  RC_ASSERT(there->value == back->value);
  for (Vector3* v : {&back->normal, &back->point1, &back->point2}) (*v)[axis] = 0 - (*v)[axis];
  if (!there->degenerate || there->normal == back->normal) RC_ASSERT(same(*there, *back));
}

// What the properties were asked: shares of a sample with a fixed seed.
TEST(SphereCubeQuestions, hold_enough_of_every_kind) {
  constexpr int kCount = 4000;
  int hits = 0;
  int exactly = 0;
  int inside = 0;
  int touching = 0;
  int features[4] = {};
  for (const Query& query : sample(drawn(), kCount)) {
    if (!Range().contains(query)) continue;
    const oracle::Truth truth = oracle::truth_of(query);
    const auto& [a, b] = shapes_in(query);
    hits += truth.hit() ? 1 : 0;
    exactly += truth.at_alarm == oracle::Side::at ? 1 : 0;
    inside += truth.degenerate() && !truth.coincident() ? 1 : 0;
    touching += truth.coincident() ? 1 : 0;
    ++features[((a.center.array() < b.min.array()) || (a.center.array() > b.max.array())).count()];
  }
  const auto share = [&](const char* kind, int count) {
    RecordProperty(kind, std::to_string(100.0 * count / kCount) + " %");
    return 100.0 * count / kCount;
  };
  EXPECT_GT(share("hits", hits), 30);
  EXPECT_LT(share("hits", hits), 85);
  EXPECT_GT(share("exactly at the alarm distance", exactly), 3);
  EXPECT_GT(share("inside", inside), 2);
  EXPECT_GT(share("on the boundary", touching), 2);
  EXPECT_GT(share("faces", features[1]), 10);
  EXPECT_GT(share("edges", features[2]), 10);
  EXPECT_GT(share("corners", features[3]), 10);
}

// What laws about touching, surfaces and depths are asked: nearly every question is of its kind.
TEST(SphereCubeQuestions, of_a_kind_are_of_that_kind) {
  const auto share = [](const rc::Gen<Query>& gen, auto holds) {
    int asked = 0;
    int of_kind = 0;
    for (const Query& query : sample(gen, 1000)) {
      if (!Range().contains(query)) continue;
      ++asked;
      of_kind += holds(oracle::truth_of(query)) ? 1 : 0;
    }
    EXPECT_GT(asked, 500);
    return 100.0 * of_kind / asked;
  };
  const auto reaches = [](const oracle::Truth& truth) { return truth.at_alarm == oracle::Side::at; };
  EXPECT_GT(share(sphere_touching_box(Range(), false), reaches), 95);
  EXPECT_GT(share(sphere_touching_box(Range(), true), reaches), 95);
  EXPECT_GT(share(sphere_on_box(Range(), any_number(Range())), [](const oracle::Truth& t) { return t.coincident(); }),
            95);
  EXPECT_GT(share(sphere_in_box(Range(), any_number(Range())),
                  [](const oracle::Truth& t) { return t.degenerate() && !t.coincident(); }),
            95);
}

}  // namespace
}  // namespace contact
