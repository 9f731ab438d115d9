// Production's functions for a triangle and a line against both oracles, and what ties them to rays.
#include "contact/triangle_line.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "contact/ray_triangle.hpp"
#include "oracle/truth/interval_oracle.hpp"
#include "oracle/truth/truth.hpp"
#include "proptests/generators.hpp"

namespace contact {
namespace {

using namespace proptests;

rc::Gen<Query> drawn() { return queries(static_cast<const TriangleAndLine*>(nullptr), Range()); }

Expectation computed(const Triangle& a, const Line& b) {
  const auto contact = compute_triangle_line(a, b);
  return {contact.has_value(), contact};
}

RC_GTEST_PROP(TriangleLine, production_equals_both_oracles, ()) {
  const Query query = *drawn();
  RC_ASSERT(!outside_domain(query));
  const auto& [a, b] = std::get<TriangleAndLine>(query.shapes);
  const Expectation contact = computed(a, b);
  RC_ASSERT(test_triangle_line(a, b) == contact.hit);
  RC_ASSERT(first_difference(contact, oracle::expectation(oracle::truth_of(query), Scalar::binary64)) == std::nullopt);
  RC_ASSERT(first_difference(contact, oracle::interval_answer(query, Scalar::binary64).expected) == std::nullopt);
}

RC_GTEST_PROP(TriangleLine, ends_exchanged_change_nothing, ()) {
  const Query query = *drawn();
  const auto& [a, b] = std::get<TriangleAndLine>(query.shapes);
  RC_ASSERT(first_difference(computed(a, b), computed(a, {b.end, b.start})) == std::nullopt);
}

RC_GTEST_PROP(TriangleLine, a_line_is_a_ray_whose_end_is_a_number_and_the_normal_is_turned, ()) {
  const Query query = *drawn();
  const auto& [a, b] = std::get<TriangleAndLine>(query.shapes);
  const Vector3 along = b.end - b.start;
  for (int axis = 0; axis < 3; ++axis)
    RC_PRE(std::isfinite(along[axis]) && along[axis] + b.start[axis] == b.end[axis] &&
           b.end[axis] - along[axis] == b.start[axis]);
  RC_PRE(!along.isZero(0));
  auto ray = compute_ray_triangle({b.start, along, 1}, a);
  if (ray) ray->normal = Vector3::Zero() - ray->normal;
  RC_ASSERT(first_difference(computed(a, b), {ray.has_value(), ray}) == std::nullopt);
}

// What the properties were asked: shares of a sample with a fixed seed.
TEST(TriangleLineQuestions, hold_enough_of_every_kind) {
  constexpr int kCount = 4000;
  int asked = 0;
  std::map<std::string, int> counts;
  for (const Query& query : sample(drawn(), kCount)) {
    if (!Range().contains(query)) continue;
    ++asked;
    const auto& [a, b] = std::get<TriangleAndLine>(query.shapes);
    counts["hits"] += oracle::truth_of(query).hit() ? 1 : 0;
    counts["without length"] += b.start == b.end ? 1 : 0;
  }
  const auto share = [&](const std::string& kind) {
    RecordProperty(kind, std::to_string(100.0 * counts[kind] / asked) + " %");
    return 100.0 * counts[kind] / asked;
  };
  EXPECT_GT(asked, kCount * 9 / 10);
  EXPECT_GT(share("hits"), 15);
  EXPECT_LT(share("hits"), 70);
  EXPECT_GT(share("without length"), 0.5);
}

}  // namespace
}  // namespace contact
