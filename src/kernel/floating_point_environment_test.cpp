// The caller's floating-point environment: no answer depends on it, nothing traps, and it is as it was afterwards.
#include "kernel/floating_point_environment.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "contact/batch.hpp"
#include "contact/cube_cube.hpp"
#include "contact/sphere_cube.hpp"
#include "contact/sphere_sphere.hpp"

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

/// The pairs as columns, and every number of their contacts.
struct Batch {
  std::array<std::vector<double>, 8> in;
  std::array<std::vector<double>, 10> out;
  std::vector<batch::PairState> state;

  explicit Batch(const std::vector<std::pair<Ball, Ball>>& all) : state(all.size()) {
    for (const auto& [a, b] : all) {
      for (std::size_t k = 0; k < 3; ++k) {
        in[k].push_back(a.center[static_cast<Eigen::Index>(k)]);
        in[4 + k].push_back(b.center[static_cast<Eigen::Index>(k)]);
      }
      in[3].push_back(a.radius);
      in[7].push_back(b.radius);
    }
    for (auto& column : out) column.resize(all.size());
  }
  void compute() {
    batch::compute_sphere_sphere(
        {in[0], in[1], in[2], in[3]}, {in[4], in[5], in[6], in[7]}, {0, 0},
        {{out[0], out[1], out[2]}, {out[3], out[4], out[5]}, {out[6], out[7], out[8]}, out[9], state});
  }
  [[nodiscard]] std::vector<std::uint64_t> bits() const {
    std::vector<std::uint64_t> all;
    for (const auto& column : out)
      for (const double x : column) all.push_back(std::bit_cast<std::uint64_t>(x));
    return all;
  }
};

std::vector<std::uint64_t> bits_of(const std::optional<Contact>& contact) {
  if (!contact) return {};
  std::vector<std::uint64_t> bits{std::bit_cast<std::uint64_t>(contact->value)};
  for (int k = 0; k < 3; ++k)
    for (const double x : {contact->normal[k], contact->point1[k], contact->point2[k]})
      bits.push_back(std::bit_cast<std::uint64_t>(x));
  return bits;
}

/// From its centre, as far as its radius: other balls are inside, before a face, and beside an edge or a corner.
Box box_from(const Ball& a) { return {a.center, a.center + Vector3::Constant(a.radius)}; }

/// Inline decisions raise exceptions; where these are masked, their answers are asked for too.
void expect_same_under(unsigned mxcsr) {
  const bool decides_inline = (mxcsr & kMasks) == kMasks;
  const auto all = pairs();
  Batch expected(all);
  expected.compute();
  Batch actual(all);
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
    actual.compute();
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
    for (std::size_t i = 0; i < all.size(); ++i)
      EXPECT_EQ(bits_of(inline_contacts[i]), bits_of(expected_contacts[i])) << i << " inline, under " << mxcsr;
    for (std::size_t i = 0; i < all.size(); ++i)
      EXPECT_EQ(bits_of(inline_contacts_of_boxes[i]), bits_of(expected_of_boxes[i])) << i << " of boxes, " << mxcsr;
    EXPECT_EQ(inline_boxes, expected_boxes);
  }
  EXPECT_EQ(actual.bits(), expected.bits()) << mxcsr;
  for (std::size_t i = 0; i < all.size(); ++i)
    EXPECT_EQ(bits_of(contacts[i]), bits_of(expected_contacts[i])) << i << " under " << mxcsr;
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
