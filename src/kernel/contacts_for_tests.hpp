// What the tests of pairs share: contacts compared bit by bit, what production says of two shapes, and the exact stage
// alone.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "contact/capsule_capsule.hpp"
#include "contact/capsule_plane.hpp"
#include "contact/contact.hpp"
#include "contact/ray_sphere.hpp"
#include "contact/ray_triangle.hpp"
#include "contact/sphere_capsule.hpp"
#include "contact/sphere_cube.hpp"
#include "contact/sphere_plane.hpp"
#include "contact/sphere_sphere.hpp"
#include "contact/sphere_triangle.hpp"
#include "contact/triangle_line.hpp"
#include "environment/floating_point_environments.hpp"
#include "kernel/core_pairs.hpp"
#include "kernel/sphere_sphere_numbers.hpp"

namespace contact {

using TenNumbers = std::array<double, 10>;

inline TenNumbers numbers_of(const Contact& c) {
  return {c.normal[0], c.normal[1], c.normal[2], c.point1[0], c.point1[1],
          c.point1[2], c.point2[0], c.point2[1], c.point2[2], c.value};
}

inline void expect_same(const TenNumbers& actual, const TenNumbers& expected) {
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(actual[i]), std::bit_cast<std::uint64_t>(expected[i]))
        << "number " << i << " is " << actual[i] << ", not " << expected[i];
}

enum class Kind { ordinary, many, degenerate, degenerate_and_many };

inline void expect_contact(const std::optional<Contact>& contact, const TenNumbers& expected, Kind kind) {
  ASSERT_TRUE(contact);
  expect_same(numbers_of(*contact), expected);
  EXPECT_EQ(contact->degenerate, kind == Kind::degenerate || kind == Kind::degenerate_and_many);
  EXPECT_EQ(contact->unique, kind == Kind::ordinary || kind == Kind::degenerate);
}

inline void expect_same(const std::optional<Contact>& actual, const std::optional<Contact>& expected) {
  ASSERT_EQ(actual.has_value(), expected.has_value());
  if (!actual) return;
  expect_same(numbers_of(*actual), numbers_of(*expected));
  EXPECT_EQ(actual->degenerate, expected->degenerate);
  EXPECT_EQ(actual->unique, expected->unique);
}

/// What production says of two shapes: their contact, and the decision. Where exceptions trap, out of line.
using Said = std::pair<std::optional<Contact>, bool>;
#define CONTACT_SAID(name, A, B, of_contact, of_decision)                                             \
  inline Said said(const A& a, const B& b, [[maybe_unused]] Distances distances,                      \
                   [[maybe_unused]] ContactPoints points = {}, bool traps = false) {                  \
    if (traps) return {out_of_line::compute_##name of_contact, out_of_line::test_##name of_decision}; \
    return {compute_##name of_contact, test_##name of_decision};                                      \
  }
#define CONTACT_OF_DISTANCE(name, A, B) CONTACT_SAID(name, A, B, (a, b, distances, points), (a, b, distances.alarm))
#define CONTACT_OF_CROSSING(name, A, B) CONTACT_SAID(name, A, B, (a, b), (a, b))
CONTACT_OF_DISTANCE(sphere_sphere, Ball, Ball)
CONTACT_OF_DISTANCE(sphere_cube, Ball, Box)
CONTACT_OF_DISTANCE(sphere_capsule, Ball, Capsule)
CONTACT_OF_DISTANCE(capsule_capsule, Capsule, Capsule)
CONTACT_OF_DISTANCE(sphere_triangle, Ball, Triangle)
CONTACT_OF_DISTANCE(ray_sphere, Ray, Ball)
CONTACT_OF_DISTANCE(sphere_plane, Ball, Plane)
CONTACT_OF_DISTANCE(capsule_plane, Capsule, Plane)
CONTACT_OF_CROSSING(ray_triangle, Ray, Triangle)
CONTACT_OF_CROSSING(triangle_line, Triangle, Line)
#undef CONTACT_SAID
#undef CONTACT_OF_DISTANCE
#undef CONTACT_OF_CROSSING

/// answer(question, whether exceptions trap) gives a contact and a decision, the same in every environment.
template <class Question, class Answer>
void expect_same_in_every_environment(const std::vector<Question>& asked, Answer answer) {
  const auto answers = [&](bool traps) {
    std::vector<Said> all;
    for (const Question& question : asked) all.push_back(answer(question, traps));
    return all;
  };
  const std::vector<Said> expected = answers(false);
  for (const FloatingPointEnvironment& environment : floating_point_environments()) {
    std::vector<Said> actual;
    in_environment(environment, [&] { actual = answers(environment.traps); });
    for (std::size_t i = 0; i < asked.size(); ++i) {
      expect_same(actual[i].first, expected[i].first);
      EXPECT_EQ(actual[i].second, expected[i].second);
      ASSERT_FALSE(testing::Test::HasFailure()) << environment.name << " " << i;
    }
  }
}

/// The contact of two shapes by the exact stage alone.
template <class A, class B>
std::optional<Contact> computed_exactly(const A& a, const B& b, Distances distances, ContactPoints points = {}) {
  const auto& first = kernel::core_of(a);
  const auto& second = kernel::core_of(b);
  const kernel::Lengths lengths = kernel::lengths_of(a, b, distances);
  const auto grid = grid_of(first, second, lengths);
  const auto nearest = exact_nearest(first, second, grid);
  if (!is_hit(nearest, grid, lengths)) return std::nullopt;
  Contact contact{};
  round_exactly(nearest, grid, lengths, points, kernel::kAllNumbers, contact);
  return contact;
}

}  // namespace contact
