// Production's functions for rays that are cast against both oracles, and what ties them to each other.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

#include "contact/casts.hpp"
#include "contact/pair_functions.hpp"
#include "oracle/truth/interval_oracle.hpp"
#include "oracle/truth/truth.hpp"
#include "proptests/generators.hpp"

namespace contact {
namespace {

using namespace proptests;

const std::vector<Pair> kCasts{Pair::cast_sphere, Pair::cast_cube, Pair::cast_capsule, Pair::cast_triangle,
                               Pair::cast_plane};

Expectation computed(const Query& query) {
  return std::visit(
      [&](const auto& shapes) {
        const auto contact = contact_of(shapes, query.distances);
        RC_ASSERT(is_hit(shapes, query.distances) == contact.has_value());
        return Expectation{contact.has_value(), contact};
      },
      query.shapes);
}
Cast& ray_of(Query& query) {
  return std::visit(
      []<class A, class B>(Two<A, B>& shapes) -> Cast& {
        if constexpr (std::same_as<A, Cast>) return shapes.a;
        throw std::logic_error("no ray is cast");
      },
      query.shapes);
}
Query drawn() { return *queries(*rc::gen::elementOf(kCasts), Range()); }

RC_GTEST_PROP(Casts, production_equals_both_oracles, ()) {
  const Query query = drawn();
  RC_ASSERT(!outside_domain(query));
  const Expectation contact = computed(query);
  RC_ASSERT(first_difference(contact, oracle::expectation(oracle::truth_of(query), Scalar::binary64)) == std::nullopt);
  RC_ASSERT(first_difference(contact, oracle::interval_answer(query, Scalar::binary64).expected) == std::nullopt);
}

RC_GTEST_PROP(Casts, a_longer_ray_hits_too_and_at_the_same_place, ()) {
  Query query = drawn();
  const Expectation contact = computed(query);
  Cast& ray = ray_of(query);
  ray.length = std::max(ray.length, std::abs(*any_number(Range())));
  if (contact.hit) RC_ASSERT(first_difference(contact, computed(query)) == std::nullopt);
}

RC_GTEST_PROP(Casts, a_direction_twice_as_long_halves_t_and_changes_nothing_else, ()) {
  const Query query = drawn();
  const Expectation contact = computed(query);
  Query longer = query;
  Cast& ray = ray_of(longer);
  const Cast before = ray;
  ray.direction *= 2;
  ray.length /= 2;
  if (!ray.direction.allFinite() || ray.length * 2 != before.length) return;
  Expectation wanted = contact;
  if (wanted.contact) wanted.contact->value /= 2;
  if (wanted.contact && wanted.contact->value * 2 != contact.contact->value) return;  // a subnormal number
  if (wanted.contact && !std::isfinite(wanted.contact->value)) return;
  RC_ASSERT(first_difference(wanted, computed(longer)) == std::nullopt);
}

// Of two triangles with a common edge a ray through the edge hits at least one, wherever rounding puts it.
RC_GTEST_PROP(Casts, a_ray_through_a_common_edge_hits_one_of_two_triangles, ()) {
  const auto x = *numbers(12, rc::gen::oneOf(small_dyadic(Range()), ordinary(Range())));
  const auto vertex = [&](std::size_t k) { return Vector3(x[3 * k], x[3 * k + 1], x[3 * k + 2]); };
  const Vector3 at = vertex(0) + *integer(1, 7) / 8.0 * (vertex(1) - vertex(0));
  const Triangle one{{vertex(0), vertex(1), vertex(2)}};
  const Triangle other{{vertex(1), vertex(0), vertex(0) + vertex(1) - vertex(2)}};
  const Ray ray{vertex(3), at - vertex(3), 2};
  if (!ray.direction.allFinite() || !other.vertices[2].allFinite()) return;
  // Beside the edge there must be room on both sides of it, and the ray must go across.
  const Vector3 edge = (vertex(1) - vertex(0)).stableNormalized();
  const Vector3 side = (vertex(2) - vertex(0)).stableNormalized();
  const double most = std::max({vertex(0).stableNorm(), vertex(1).stableNorm(), vertex(2).stableNorm(),
                                vertex(3).stableNorm(), ray.direction.stableNorm()});
  const double least = std::min((vertex(1) - vertex(0)).stableNorm(), (vertex(2) - vertex(0)).stableNorm());
  const Vector3 n = edge.cross(side);
  if (!(least > most / 1024) || !(n.norm() > 0.125)) return;
  if (!(std::abs(n.dot(ray.direction.stableNormalized())) > 0.125 * n.norm())) return;
  RC_ASSERT(test_cast_triangle(ray, one) || test_cast_triangle(ray, other));
}

Contact hit_of(const std::optional<Contact>& contact) {
  if (!contact) throw std::logic_error("a miss");
  return *contact;
}

// By hand.
TEST(Casts, touching_counts_and_a_step_outside_does_not) {
  const Ray ray{{0, 0, 0}, {2, 0, 0}, 5};
  EXPECT_TRUE(test_cast_sphere(ray, {{4, 0, 1}, 1}));
  EXPECT_FALSE(test_cast_sphere(ray, {{4, 0, 1}, std::nextafter(1.0, 0.0)}));
  EXPECT_TRUE(test_cast_sphere(ray, {{11, 0, 0}, 1}));
  EXPECT_FALSE(test_cast_sphere(ray, {{std::nextafter(11.0, 12.0), 0, 0}, 1}));
  EXPECT_TRUE(test_cast_cube(ray, {{3, 0, -1}, {4, 1, 1}}));
  EXPECT_FALSE(test_cast_cube(ray, {{3, 0x1p-1074, -1}, {4, 1, 1}}));
  EXPECT_TRUE(test_cast_capsule(ray, {{3, 1, -4}, {3, 1, 9}, 1}));
  EXPECT_FALSE(test_cast_capsule(ray, {{3, 1, -4}, {3, 1, 9}, std::nextafter(1.0, 0.0)}));
  // From both sides, in the plane, through an edge; not beside it.
  for (const double side : {-1.0, 1.0})
    EXPECT_TRUE(test_cast_triangle(ray, {{Vector3(3, 0, side), Vector3(3, 2, -side), Vector3(3, -2, -side)}}));
  EXPECT_TRUE(test_cast_triangle(ray, {{Vector3(3, 1, 0), Vector3(5, -1, 0), Vector3(5, 1, 0)}}));
  EXPECT_FALSE(test_cast_triangle(ray, {{Vector3(3, 1, 0), Vector3(5, 0x1p-1074, 0), Vector3(5, 1, 0)}}));
  EXPECT_TRUE(test_cast_plane(ray, {{-3, 0, 0}, -30}));
  EXPECT_FALSE(test_cast_plane(ray, {{-3, 0, 0}, std::nextafter(-30.0, -31.0)}));
  EXPECT_FALSE(test_cast_plane({{0, 0, 1}, {1, 0, 0}, 1e300}, {{0, 0, 1}, 0}));
}

TEST(Casts, from_inside_t_is_0) {
  const Contact contact = hit_of(compute_cast_sphere({{1, 2, 2}, {0, 3, 4}, 7}, {{0, 0, 0}, 3}));
  EXPECT_TRUE(contact.degenerate);
  EXPECT_EQ(contact.value, 0);
  EXPECT_EQ(contact.point1, Vector3(1, 2, 2));
  EXPECT_EQ(contact.normal, Vector3(0, -0.6, -0.8));
  EXPECT_TRUE(hit_of(compute_cast_plane({{0, 0, 0}, {0, 0, 1}, 0}, {{0, 0, 1}, 0})).degenerate);
  EXPECT_FALSE(compute_cast_plane({{0, 0, 1}, {0, 0, 1}, 9}, {{0, 0, 1}, 0}).has_value());
}

TEST(Casts, of_several_normals_the_greatest_is_taken) {
  const Ray up{{0, 0, -5}, {0, 0, 1}, 9};
  const auto of_box = [&](const Vector3& min, const Vector3& max) {
    return hit_of(compute_cast_cube(up, {min, max})).normal;
  };
  EXPECT_EQ(of_box({-1, -1, -1}, {1, 1, 1}), Vector3(0, 0, -1));
  EXPECT_EQ(of_box({-1, -1, -1}, {0, 1, 1}), Vector3(1, 0, 0));
  EXPECT_EQ(of_box({0, -1, -1}, {1, 1, 1}), Vector3(0, 0, -1));
  EXPECT_EQ(of_box({0, -1, -1}, {1, 0, 1}), Vector3(0, 1, 0));
  EXPECT_EQ(of_box({-1, -1, 1}, {1, 1, 1}), Vector3(0, 0, 1));  // without thickness
  // A triangle's inside has two sides, a point every normal, and a segment those across it.
  EXPECT_EQ(hit_of(compute_cast_triangle(up, {{Vector3(-1, -1, 0), Vector3(0, 2, 0), Vector3(2, -1, 0)}})).normal,
            Vector3(0, 0, 1));
  EXPECT_EQ(hit_of(compute_cast_sphere(up, {{0, 0, 0}, 0})).normal, Vector3(1, 0, 0));
  const Vector3 across = hit_of(compute_cast_capsule(up, {{-4, -3, -1}, {4, 3, 1}, 0})).normal;
  EXPECT_EQ(across, Vector3(0.6, -0.8, 0));
}

// What the properties were asked: shares of a sample with a fixed seed.
TEST(CastQuestions, hold_enough_of_every_kind) {
  constexpr int kCount = 1500;
  for (const Pair pair : kCasts) {
    SCOPED_TRACE(name(pair));
    int asked = 0;
    std::map<std::string, int> counts;
    for (const Query& query : sample(queries(pair, Range()), kCount)) {
      if (!Range().contains(query)) continue;
      ++asked;
      const oracle::Truth truth = oracle::truth_of(query);
      counts["hits"] += truth.hit() ? 1 : 0;
      counts["from inside"] += truth.hit() && truth.degenerate() ? 1 : 0;
    }
    const auto share = [&](const std::string& kind) { return 100.0 * counts[kind] / asked; };
    EXPECT_GT(asked, kCount * 8 / 10);
    EXPECT_GT(share("hits"), 15);
    EXPECT_LT(share("hits"), 85);
    EXPECT_GT(share("from inside"), 1);
    EXPECT_GT(share("hits") - share("from inside"), 10);
  }
}

}  // namespace
}  // namespace contact
