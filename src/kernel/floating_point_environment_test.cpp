// The caller's floating-point environment: no answer depends on it, nothing traps, and it is as it was afterwards.
#include "kernel/floating_point_environment.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "contact/cube_cube.hpp"
#include "contact/sphere_cube.hpp"
#include "contact/sphere_sphere.hpp"
#include "kernel/batch_pairs.hpp"
#include "kernel/contacts_for_tests.hpp"

namespace contact::floating_point_environment_test {
namespace {

#if CONTACT_HAS_MXCSR

constexpr unsigned kMasks = 0x1f80;
constexpr unsigned kFlushToZero = 0x8000;
constexpr unsigned kDenormalsAreZero = 0x0040;

/// Calls `work` with that MXCSR; returns what it left there.
unsigned with_mxcsr(unsigned mxcsr, const std::function<void()>& work) {
  const unsigned before = _mm_getcsr();
  _mm_setcsr(mxcsr);
  work();
  const unsigned after = _mm_getcsr();
  _mm_setcsr(before);
  return after;
}

/// Ordinary, touching, huge, tiny and subnormal pairs, coincident ones among them: every exception has its occasion.
std::vector<std::pair<Ball, Ball>> pairs() {
  std::vector<std::pair<Ball, Ball>> all;
  for (const double scale : {1.0, 0x1p1000, 0x1p-1000, 0x1p-1074, 0x1p500})
    for (const double r : {1.5, 1.0, 0.1, 3.0})
      for (const Vector3& c : {Vector3(1, 2, 2), Vector3(0, 0, 0), Vector3(0.1, 0.7, -3), Vector3(0x1p-1060, 0.7, 1)})
        all.push_back({{{0, 0, 0}, r * scale}, {c * scale, 1.5 * scale}});
  return all;
}

batch::Pairs<Ball, Ball> in_columns(const std::vector<std::pair<Ball, Ball>>& all) {
  batch::Pairs<Ball, Ball> columns(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) columns.set(i, {all[i].first, all[i].second});
  return columns;
}

void expect_all_same(const char* which, const std::vector<std::optional<Contact>>& actual,
                     const std::vector<std::optional<Contact>>& expected) {
  for (std::size_t i = 0; i < expected.size(); ++i) {
    SCOPED_TRACE(which + std::to_string(i));
    expect_same(actual[i], expected[i]);
  }
}

/// From its centre, as far as its radius: other balls are inside, before a face, and beside an edge or a corner.
Box box_from(const Ball& a) { return {a.center, a.center + Vector3::Constant(a.radius)}; }

/// Inline decisions raise exceptions; where these are masked, their answers are asked for too.
void expect_same_under(unsigned mxcsr) {
  SCOPED_TRACE(mxcsr);
  const bool decides_inline = (mxcsr & kMasks) == kMasks;
  const auto all = pairs();
  auto expected = in_columns(all);
  expected.compute({0, 0});
  auto actual = in_columns(all);
  std::vector<std::optional<Contact>> expected_contacts;
  std::vector<std::optional<Contact>> contacts(all.size());
  for (const auto& [a, b] : all) expected_contacts.push_back(compute_sphere_sphere(a, b, {0, 0}));
  const Box box{Vector3(0, 0, 0), Vector3(0.1, 0.1, 0.1)};
  const Box beside{Vector3(0.8, 0.1, 0.1), Vector3(1, 1, 1)};
  const bool expected_boxes = test_cube_cube(box, beside, 0.7);
  bool boxes = !expected_boxes;
  std::vector<std::optional<Contact>> inline_contacts(all.size());
  std::vector<std::optional<Contact>> expected_of_boxes;
  std::vector<std::optional<Contact>> inline_contacts_of_boxes(all.size());
  std::vector<Box> all_boxes;
  for (const auto& [a, b] : all) {
    all_boxes.push_back(box_from(a));
    expected_of_boxes.push_back(compute_sphere_cube(b, all_boxes.back(), {0, 0}));
  }
  bool inline_boxes = !expected_boxes;
  const unsigned after = with_mxcsr(mxcsr, [&] {
    actual.compute({0, 0});
    for (std::size_t i = 0; i < all.size(); ++i)
      contacts[i] = out_of_line::compute_sphere_sphere(all[i].first, all[i].second, {0, 0});
    boxes = out_of_line::test_cube_cube(box, beside, 0.7);
  });
  EXPECT_EQ(after, mxcsr);  // the flags of exceptions too
  if (decides_inline) {
    const unsigned left = with_mxcsr(mxcsr, [&] {
      for (std::size_t i = 0; i < all.size(); ++i)
        inline_contacts[i] = compute_sphere_sphere(all[i].first, all[i].second, {0, 0});
      for (std::size_t i = 0; i < all.size(); ++i)
        inline_contacts_of_boxes[i] = compute_sphere_cube(all[i].second, all_boxes[i], {0, 0});
      inline_boxes = test_cube_cube(box, beside, 0.7);
    });
    EXPECT_EQ(left & ~0x3fU, mxcsr);  // but for the flags
    expect_all_same("inline ", inline_contacts, expected_contacts);
    expect_all_same("of boxes ", inline_contacts_of_boxes, expected_of_boxes);
    EXPECT_EQ(inline_boxes, expected_boxes);
  }
  EXPECT_EQ(actual.state(), expected.state());
  for (std::size_t i = 0; i < all.size(); ++i) expect_same(actual.numbers(i), expected.numbers(i));
  expect_all_same("out of line ", contacts, expected_contacts);
  EXPECT_EQ(boxes, expected_boxes);
}

TEST(FloatingPointEnvironment, no_answer_depends_on_it_and_it_is_as_it_was) {
  for (const unsigned rounding : {0x0000U, 0x2000U, 0x4000U, 0x6000U})
    for (const unsigned flush : {0U, kFlushToZero, kDenormalsAreZero, kFlushToZero | kDenormalsAreZero})
      expect_same_under(kMasks | rounding | flush);
}

TEST(FloatingPointEnvironment, nothing_traps_where_the_caller_has_unmasked_exceptions) {
  for (const unsigned rounding : {0x0000U, 0x2000U, 0x4000U, 0x6000U}) expect_same_under(rounding);
}

#endif

}  // namespace
}  // namespace contact::floating_point_environment_test
