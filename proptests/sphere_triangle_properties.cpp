// Production's functions for a sphere and a triangle against both oracles, and what ties them to the other pairs.
#include "contact/sphere_triangle.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <map>
#include <string>

#include "contact/sphere_capsule.hpp"
#include "contact/sphere_sphere.hpp"
#include "oracle/truth/interval_oracle.hpp"
#include "oracle/truth/truth.hpp"
#include "proptests/generators.hpp"

namespace contact {
namespace {

using namespace proptests;

rc::Gen<Query> drawn() { return queries(static_cast<const BallAndTriangle*>(nullptr), Range()); }

const BallAndTriangle& shapes_in(const Query& query) { return std::get<BallAndTriangle>(query.shapes); }

Expectation computed(const Ball& a, const Triangle& b, Distances distances) {
  const auto contact = compute_sphere_triangle(a, b, distances);
  return {contact.has_value(), contact};
}

RC_GTEST_PROP(SphereTriangle, production_equals_both_oracles, ()) {
  const Query query = *drawn();
  RC_ASSERT(!outside_domain(query));
  const auto& [a, b] = shapes_in(query);
  const Expectation contact = computed(a, b, query.distances);
  RC_ASSERT(test_sphere_triangle(a, b, query.distances.alarm) == contact.hit);
  RC_ASSERT(first_difference(contact, oracle::expectation(oracle::truth_of(query), Scalar::binary64)) == std::nullopt);
  RC_ASSERT(first_difference(contact, oracle::interval_answer(query, Scalar::binary64).expected) == std::nullopt);
}

/// A sphere and a segment or a point in other words; `numbers` without what is agreed where the centre lies on it.
Expectation of_segment(const Ball& a, const Vector3& start, const Vector3& end, Distances distances) {
  const auto contact = compute_sphere_capsule(a, {start, end, 0}, distances);
  return {contact.has_value(), contact};
}

RC_GTEST_PROP(SphereTriangle, a_triangle_of_one_point_is_a_sphere_of_radius_0, ()) {
  Query query = *drawn();
  auto& [a, b] = std::get<BallAndTriangle>(query.shapes);
  b.vertices[2] = b.vertices[1] = b.vertices[0];
  const auto spheres = compute_sphere_sphere(a, {b.vertices[0], 0}, query.distances);
  RC_ASSERT(first_difference(computed(a, b, query.distances), {spheres.has_value(), spheres}) == std::nullopt);
}

RC_GTEST_PROP(SphereTriangle, a_triangle_of_two_points_is_a_capsule_of_radius_0, ()) {
  Query query = *drawn();
  auto& [a, b] = std::get<BallAndTriangle>(query.shapes);
  const int twice = *integer(0, 2);
  auto& v = b.vertices;
  v[static_cast<std::size_t>(twice)] = v[static_cast<std::size_t>((twice + 1) % 3)];
  const Vector3& other = v[static_cast<std::size_t>((twice + 2) % 3)];
  RC_ASSERT(first_difference(computed(a, b, query.distances), of_segment(a, v[static_cast<std::size_t>(twice)], other,
                                                                         query.distances)) == std::nullopt);
}

RC_GTEST_PROP(SphereTriangle, the_order_of_the_vertices_says_nothing, ()) {
  const Query query = *drawn();
  const auto& [a, b] = shapes_in(query);
  const Expectation as_is = computed(a, b, query.distances);
  Triangle other = b;
  std::rotate(other.vertices.begin(), other.vertices.begin() + 1, other.vertices.end());
  // Of three points on a line the first two that differ give the direction of what is agreed, up to its sign alone.
  RC_ASSERT(first_difference(as_is, computed(a, other, query.distances)) == std::nullopt);
  std::swap(other.vertices[0], other.vertices[1]);
  RC_ASSERT(first_difference(as_is, computed(a, other, query.distances)) == std::nullopt);
}

RC_GTEST_PROP(SphereTriangle, no_edge_is_nearer_and_of_two_parts_the_nearer_decides, ()) {
  const Query query = *drawn();
  const auto& [a, b] = shapes_in(query);
  const auto& [v0, v1, v2] = b.vertices;
  const Expectation whole = computed(a, b, query.distances);
  for (const auto& [start, end] : {std::pair{v0, v1}, {v1, v2}, {v2, v0}}) {
    const Expectation edge = of_segment(a, start, end, query.distances);
    RC_ASSERT(!edge.hit || whole.hit);
    if (edge.hit) RC_ASSERT(edge.contact->value >= whole.contact->value);
  }
  const auto cut = exact_middle(v0, v1);
  RC_PRE(cut.has_value());
  const Expectation parts[] = {computed(a, {{v0, *cut, v2}}, query.distances),
                               computed(a, {{*cut, v1, v2}}, query.distances)};
  RC_ASSERT(whole.hit == (parts[0].hit || parts[1].hit));
  if (!whole.hit) return;
  const Expectation& nearer =
      !parts[1].hit || (parts[0].hit && parts[0].contact->value <= parts[1].contact->value) ? parts[0] : parts[1];
  RC_ASSERT(nearer.contact->value == whole.contact->value);
}

RC_GTEST_PROP(SphereTriangle, a_larger_radius_hits_as_well, ()) {
  const Query query = *drawn();
  const auto& [a, b] = shapes_in(query);
  const double alarm = query.distances.alarm;
  const double more = std::abs(*any_number(Range()));
  RC_ASSERT(test_sphere_triangle({a.center, alarm}, b, a.radius) == test_sphere_triangle(a, b, alarm));
  if (!test_sphere_triangle(a, b, alarm)) return;
  RC_ASSERT(test_sphere_triangle({a.center, std::max(a.radius, more)}, b, alarm));
  RC_ASSERT(test_sphere_triangle(a, b, std::max(alarm, more)));
}

// What the properties were asked: shares of a sample with a fixed seed.
TEST(SphereTriangleQuestions, hold_enough_of_every_kind) {
  constexpr int kCount = 4000;
  int asked = 0;
  std::map<std::string, int> counts;
  for (const Query& query : sample(drawn(), kCount)) {
    if (!Range().contains(query)) continue;
    ++asked;
    const oracle::Truth truth = oracle::truth_of(query);
    const auto& [a, b] = shapes_in(query);
    counts["hits"] += truth.hit() ? 1 : 0;
    counts["exactly at the alarm distance"] += truth.at_alarm == oracle::Side::at ? 1 : 0;
    counts["on the triangle"] += truth.degenerate() ? 1 : 0;
    const auto& [v0, v1, v2] = b.vertices;
    const Vector3 u = v1 - v0;
    const Vector3 v = v2 - v0;
    const Vector3 n = u.cross(v);
    if (n.isZero(0)) {
      ++counts["without an inside"];
      continue;
    }
    int beyond = 0;
    for (const auto& [x, y] : {std::pair{v0, v1}, {v1, v2}, {v2, v0}})
      beyond += n.dot((x - a.center).cross(y - a.center)) < 0 ? 1 : 0;
    ++counts[beyond == 0 ? "over the face" : beyond == 1 ? "beyond one edge" : "beyond two edges"];
  }
  const auto share = [&](const std::string& kind) {
    RecordProperty(kind, std::to_string(100.0 * counts[kind] / asked) + " %");
    return 100.0 * counts[kind] / asked;
  };
  EXPECT_GT(asked, kCount * 9 / 10);
  EXPECT_GT(share("hits"), 30);
  EXPECT_LT(share("hits"), 85);
  EXPECT_GT(share("exactly at the alarm distance"), 3);
  EXPECT_GT(share("on the triangle"), 3);
  EXPECT_GT(share("without an inside"), 10);
  EXPECT_GT(share("over the face"), 10);
  EXPECT_GT(share("beyond one edge"), 10);
  EXPECT_GT(share("beyond two edges"), 5);
}

}  // namespace
}  // namespace contact
