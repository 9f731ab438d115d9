// Production's functions for a ray and a triangle against both oracles, and what ties them to the other pairs.
#include "contact/ray_triangle.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "contact/ray_sphere.hpp"
#include "contact/sphere_triangle.hpp"
#include "oracle/truth/interval_oracle.hpp"
#include "oracle/truth/truth.hpp"
#include "proptests/generators.hpp"

namespace contact {
namespace {

using namespace proptests;

rc::Gen<Query> drawn() { return queries(static_cast<const RayAndTriangle*>(nullptr), Range()); }

Expectation computed(const Ray& a, const Triangle& b) {
  const auto contact = compute_ray_triangle(a, b);
  return {contact.has_value(), contact};
}

RC_GTEST_PROP(RayTriangle, production_equals_both_oracles, ()) {
  const Query query = *drawn();
  RC_ASSERT(!outside_domain(query));
  const auto& [a, b] = std::get<RayAndTriangle>(query.shapes);
  const Expectation contact = computed(a, b);
  RC_ASSERT(test_ray_triangle(a, b) == contact.hit);
  RC_ASSERT(first_difference(contact, oracle::expectation(oracle::truth_of(query), Scalar::binary64)) == std::nullopt);
  RC_ASSERT(first_difference(contact, oracle::interval_answer(query, Scalar::binary64).expected) == std::nullopt);
}

RC_GTEST_PROP(RayTriangle, vertices_that_go_round_change_nothing_and_two_exchanged_the_sign_of_the_normal, ()) {
  const Query query = *drawn();
  const auto& [a, b] = std::get<RayAndTriangle>(query.shapes);
  const auto& [v0, v1, v2] = b.vertices;
  const Expectation contact = computed(a, b);
  RC_ASSERT(first_difference(contact, computed(a, {{v1, v2, v0}})) == std::nullopt);
  Expectation turned = computed(a, {{v0, v2, v1}});
  if (turned.contact) turned.contact->normal = Vector3::Zero() - turned.contact->normal;
  RC_ASSERT(first_difference(contact, turned) == std::nullopt);
}

RC_GTEST_PROP(RayTriangle, a_longer_ray_crosses_too_and_in_the_same_point, ()) {
  const Query query = *drawn();
  auto [a, b] = std::get<RayAndTriangle>(query.shapes);
  const Expectation contact = computed(a, b);
  a.length = std::max(a.length, std::abs(*any_number(Range())));
  if (contact.hit) RC_ASSERT(first_difference(contact, computed(a, b)) == std::nullopt);
}

// The crossing of a ray with a representable point is at no distance from both shapes.
RC_GTEST_PROP(RayTriangle, where_the_point_is_a_small_dyadic_both_shapes_have_it, ()) {
  const Query query = *drawn();
  const auto& [a, b] = std::get<RayAndTriangle>(query.shapes);
  const auto contact = compute_ray_triangle(a, b);
  if (!contact) return;
  const auto exact = oracle::witness(oracle::truth_of(query), Scalar::binary64).crossing;
  for (const std::string& coordinate : *exact)
    if (coordinate.find('/') != std::string::npos || coordinate.size() >= 15) return;
  RC_ASSERT(test_ray_sphere(a, {contact->point1, 0}, 0));
  RC_ASSERT(test_sphere_triangle({contact->point2, 0}, b, 0));
}

// What the properties were asked: shares of a sample with a fixed seed.
TEST(RayTriangleQuestions, hold_enough_of_every_kind) {
  constexpr int kCount = 4000;
  int asked = 0;
  std::map<std::string, int> counts;
  for (const Query& query : sample(drawn(), kCount)) {
    if (!Range().contains(query)) continue;
    ++asked;
    const auto& [a, b] = std::get<RayAndTriangle>(query.shapes);
    const auto& [v0, v1, v2] = b.vertices;
    counts["hits"] += oracle::truth_of(query).hit() ? 1 : 0;
    counts["hits of a ray that ends there"] +=
        test_ray_triangle(a, b) && !test_ray_triangle({a.origin, a.direction, a.length / 2}, b) ? 1 : 0;
    const Vector3 n = (v1 - v0).cross(v2 - v0);
    ++counts[n.isZero(0) ? "without an inside" : n.dot(a.direction) == 0 ? "along the plane" : "across"];
  }
  const auto share = [&](const std::string& kind) {
    RecordProperty(kind, std::to_string(100.0 * counts[kind] / asked) + " %");
    return 100.0 * counts[kind] / asked;
  };
  EXPECT_GT(asked, kCount * 9 / 10);
  EXPECT_GT(share("hits"), 15);
  EXPECT_LT(share("hits"), 70);
  EXPECT_GT(share("hits of a ray that ends there"), 3);
  EXPECT_GT(share("without an inside"), 4);
  EXPECT_GT(share("along the plane"), 2);
}

}  // namespace
}  // namespace contact
