// What plain arithmetic decides inline of segments, triangles and planes, against integers: within and about the gaps, at
// the ends of the range that it takes, of numbers of all sizes at once, and in every rounding mode.
#include "contact/plain_cores.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <tuple>
#include <vector>

#include "environment/floating_point_environments.hpp"
#include "extreme_numbers.hpp"
#include "kernel/core_pairs.hpp"
#include "kernel/cores_stages.hpp"
#include "kernel/proved_bounds.hpp"

namespace contact::plain_cores_test {
namespace {

using plain_decision::Filtered;

template <class A, class B>
bool exactly(const A& a, const B& b, double alarm) {
  return kernel::decide_exactly(kernel::core_of(a), kernel::core_of(b), kernel::lengths_of(a, b, {alarm, 0}));
}
template <class A, class B>
Filtered filtered(const A& a, const B& b, double alarm) {
  if constexpr (requires { plain_decision::filter_pair(a, b, alarm); })
    return plain_decision::filter_pair(a, b, alarm);
  else
    return plain_decision::filter_pair(a, b);
}

/// Shapes of numbers from 2^low to 2^high, of one power a question or of any, small integers among them.
class Shapes {
 public:
  Shapes(std::uint64_t seed, int low, int high, bool integers = true)
      : random_(seed), least_(low), most_(high), integers_(integers) {
    next();
  }

  void next() {
    whole_ = integers_ && below(3) == 0;
    low_ = least_ + static_cast<int>(below(static_cast<std::uint64_t>(most_ - least_ + 1)));
    high_ = below(3) == 0 ? most_ : low_;
    if (high_ != low_) low_ = least_;
  }
  std::uint64_t below(std::uint64_t end) { return random_() % end; }
  double length() {
    const double significand =
        whole_ ? static_cast<double>(below(4)) : 1 + static_cast<double>(random_() >> 12) * 0x1p-52;
    return std::ldexp(significand, low_ + static_cast<int>(below(static_cast<std::uint64_t>(high_ - low_ + 1))));
  }
  double coordinate() {
    const double x = length();
    return below(2) == 0 ? -x : x;
  }
  Vector3 vector() {
    const double x = coordinate();
    const double y = coordinate();
    return {x, y, coordinate()};
  }
  /// What makes up the question but for what the caller sets: 0, or as large as the rest.
  void put(Ball& s) { s = {vector(), below(2) == 0 ? 0 : length()}; }
  void put(Capsule& s) {
    s.start = vector();
    s.end = below(8) == 0 ? s.start : vector();
    s.radius = below(2) == 0 ? 0 : length();
  }
  void put(Triangle& s) {
    for (Vector3& v : s.vertices) v = vector();
    if (below(8) == 0) s.vertices[2] = s.vertices[below(2)] * 0.5 + s.vertices[1] * 0.5;
  }
  void put(Ray& s) {
    do s = {vector(), vector(), length()};
    while (s.direction.isZero(0));
  }
  void put(Line& s) { s = {vector(), vector()}; }
  void put(Plane& s) {
    do s.normal = vector();
    while (s.normal.isZero(0));
    s.offset = coordinate();
  }

 private:
  std::mt19937_64 random_;
  int least_;
  int most_;
  bool integers_;
  int low_ = 0;
  int high_ = 0;
  bool whole_ = false;
};

template <class A, class B>
struct Question {
  A a;
  B b;
  double alarm;
};

/// The least alarm distance that is a hit, by halves: nothing of the code under test says where.
template <class A, class B>
double threshold(const Question<A, B>& q, double most) {
  double low = 0;
  double high = most;
  for (int i = 0; i < 60 && low < high; ++i) {
    const double middle = low + (high - low) / 2;
    (exactly(q.a, q.b, middle) ? high : low) = middle;
  }
  return high;
}

/// One that may be a hit with some alarm distance has it within some share of the least that is: from far beyond the gap to
/// the last bit. The start of a segment beside a triangle is moved to the plane or an edge in the same way.
template <class A, class B>
std::vector<Question<A, B>> questions(std::uint64_t seed, int count, int low, int high) {
  std::vector<Question<A, B>> all;
  Shapes shapes(seed, low, high);
  for (int i = 0; i < count; ++i) {
    shapes.next();
    Question<A, B> q{};
    shapes.put(q.a);
    shapes.put(q.b);
    const double share = std::ldexp(shapes.below(2) == 0 ? -1.0 : 1.0, -static_cast<int>(20 + shapes.below(34)));
    if constexpr (requires { q.a.vertices; }) {
      const auto& v = q.a.vertices;
      const double part = static_cast<double>(shapes.below(5)) / 4;
      if (i % 2 == 0) q.b.start = (v[0] + part * (v[1] - v[0])) * (1 + share);
      if (i % 4 == 0) q.b.end = q.b.start + (q.b.start - q.b.end);
    } else if constexpr (requires {
                           q.b.vertices;
                           q.a.length;
                         }) {
      const auto& v = q.b.vertices;
      const double part = static_cast<double>(shapes.below(5)) / 4;
      if (i % 2 == 0) q.a.origin = (v[0] + part * (v[2] - v[0])) * (1 + share);
      if (i % 4 == 0) q.a.origin -= q.a.direction * q.a.length;
    } else if (i % 4 != 0) {
      const double least = threshold(q, std::ldexp(1.0, std::min(high + 4, 1023)));
      q.alarm = std::max(0.0, i % 8 == 1 ? below(least) : i % 8 == 2 ? least : least * (1 + share));
    } else {
      q.alarm = shapes.below(2) == 0 ? 0 : shapes.length();
    }
    all.push_back(q);
  }
  return all;
}

template <class A, class B>
[[gnu::noinline]] void filter_all(const std::vector<Question<A, B>>& asked, std::vector<Filtered>& said) {
  for (const auto& q : asked) said.push_back(filtered(q.a, q.b, q.alarm));
}

struct Range {
  int low;
  int high;
  int count;
  double least_share;  ///< of decided questions
};

template <class Asked>
struct PlainCores : testing::Test {};
template <class A, class B>
struct Of {};
using Pairs = testing::Types<Of<Ball, Capsule>, Of<Capsule, Capsule>, Of<Ball, Triangle>, Of<Ray, Ball>,
                             Of<Ball, Plane>, Of<Capsule, Plane>, Of<Ray, Triangle>, Of<Triangle, Line>>;
TYPED_TEST_SUITE(PlainCores, Pairs);

template <class A, class B>
void expect_right(Of<A, B> /*pair*/) {
  std::size_t hits = 0;
  std::size_t misses = 0;
  for (const Range& range :
       {Range{-3, 3, 600, 0.2}, Range{50, 62, 100, 0.02}, Range{118, 128, 100, 0}, Range{-140, -60, 150, 0},
        Range{-1074, 1000, 200, 0}, Range{-1074, -900, 100, 0}, Range{400, 1000, 100, 0}}) {
    const auto asked =
        questions<A, B>(static_cast<std::uint64_t>(range.high - range.low), range.count, range.low, range.high);
    std::vector<bool> right;
    for (const auto& q : asked) right.push_back(exactly(q.a, q.b, q.alarm));
    for (const auto& environment : floating_point_environments(false)) {
      std::vector<Filtered> said;
      in_environment(environment, [&] { filter_all(asked, said); });
      std::size_t decided = 0;
      for (std::size_t i = 0; i < asked.size(); ++i) {
        if (said[i] == Filtered::undecided) continue;
        ++decided;
        (right[i] ? hits : misses) += 1;
        ASSERT_EQ(said[i] == Filtered::hit, right[i])
            << environment.name << ", 2^" << range.low << " to 2^" << range.high << ", question " << i;
      }
      EXPECT_GE(static_cast<double>(decided), range.least_share * static_cast<double>(asked.size()))
          << environment.name << ", 2^" << range.low << " to 2^" << range.high;
    }
  }
  EXPECT_GT(hits, 150U);
  EXPECT_GT(misses, 150U);
}
TYPED_TEST(PlainCores, decide_as_integers_do_in_every_environment) { expect_right(TypeParam()); }

/// Of ordinary questions, which are near nothing, none is left open.
template <class A, class B>
void expect_decided(Of<A, B> /*pair*/) {
  Shapes shapes(5, -2, 3, false);
  int open = 0;
  for (int i = 0; i < 4000; ++i) {
    Question<A, B> q{};
    shapes.next();
    shapes.put(q.a);
    shapes.put(q.b);
    open += filtered(q.a, q.b, 0) == Filtered::undecided ? 1 : 0;
  }
  EXPECT_LT(open, 40);
}
TYPED_TEST(PlainCores, decide_ordinary_questions) { expect_decided(TypeParam()); }

/// No number that is none, or infinite, decides anything, whichever number of a question it is.
template <class A, class B>
void expect_open_without_numbers(Of<A, B> /*pair*/) {
  Shapes shapes(6, -2, 2);
  for (const double x : {kNaN, kInfinity, -kInfinity}) {
    Question<A, B> q{};
    shapes.put(q.a);
    shapes.put(q.b);
    const auto each = [&](auto& shape) {
      auto* numbers = reinterpret_cast<double*>(&shape);
      for (std::size_t k = 0; k < sizeof(shape) / sizeof(double); ++k) {
        const double before = numbers[k];
        numbers[k] = x;
        EXPECT_EQ(filtered(q.a, q.b, 0), Filtered::undecided) << x << " as number " << k;
        numbers[k] = before;
      }
    };
    each(q.a);
    each(q.b);
  }
}
TYPED_TEST(PlainCores, leave_what_is_no_number_open) { expect_open_without_numbers(TypeParam()); }

}  // namespace
}  // namespace contact::plain_cores_test
