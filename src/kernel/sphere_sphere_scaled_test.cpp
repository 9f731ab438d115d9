// Two balls with numbers of every size: what is settled without integers is the nearest number, and most of it is.
#include "kernel/sphere_sphere_scaled.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cfenv>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <utility>

#include "environment/floating_point_environments.hpp"

namespace contact::kernel::sphere_sphere_scaled_test {
namespace {

// Numbers of 2^-1074 beside numbers of 2^1024 lose nothing.
using Real =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<6500, boost::multiprecision::digit_base_2>,
                                  boost::multiprecision::et_off>;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Question {
  Ball a{{0, 0, 0}, 0};
  Ball b{{0, 0, 0}, 0};
  double distance = 0;
};

/// Questions whose sizes differ in every way that a unit depends on.
class Questions {
 public:
  explicit Questions(std::uint64_t seed) : random_(seed) {}

  static constexpr int kKinds = 8;
  static const char* name(int kind) {
    constexpr const char* names[kKinds] = {"any size",     "one size",          "subnormal",       "largest",
                                           "centres near", "a component small", "nearly touching", "touching"};
    return names[kind];
  }

  Question operator()(int kind) {
    switch (kind) {
      case 0:
        return filled([this] { return number(-1074, 2098); });
      case 1: {
        const int size = exponent(-1070, 2090);
        return filled([&] { return number(size, 3); });
      }
      case 2:
        return filled([this] { return number(-1074, 56); });
      case 3:
        return filled([this] { return number(1020, 4); });
      case 4: {
        const int size = exponent(-1070, 1070);
        Question q = filled([this] { return number(0, 3); });
        for (int axis = 0; axis < 3; ++axis) {
          q.a.center[axis] = number(size, 3);
          q.b.center[axis] = number(size, 3);
        }
        return q;
      }
      case 5: {
        Question q = filled([this] { return number(0, 3); });
        const auto axis = static_cast<Eigen::Index>(random_() % 3);
        q.a.center[axis] = 0;
        q.b.center[axis] = number(-1074, 1074);
        return q;
      }
      case 6: {  // t is s rounded, and delta and t are single numbers of full length
        const int size = exponent(-990, 1980);
        Question q;
        for (int axis = 0; axis < 3; ++axis) q.b.center[axis] = number(size, 3);
        q.a.radius = std::hypot(q.b.center[0], q.b.center[1], q.b.center[2]);
        return q;
      }
      default: {  // 3 k, 4 k and 12 k, 13 k apart, by numbers of few digits, and perhaps one of them off by its last
                  // bit
        const double k = std::ldexp(static_cast<double>(1 + random_() % 1024), exponent(-1000, 1980));
        Question q;
        q.b.center = Vector3(3 * k, 4 * k, 12 * k);
        q.a.radius = k * static_cast<double>(random_() % 14);
        q.b.radius = 13 * k - q.a.radius;
        if (random_() % 2 == 0) q.b.center[2] = std::nextafter(q.b.center[2], random_() % 2 == 0 ? 0 : kInfinity);
        return q;
      }
    }
  }

 private:
  int exponent(int least, int range) { return least + static_cast<int>(random_() % static_cast<std::uint64_t>(range)); }
  double number(int least, int range) {
    const double significand = 1 + static_cast<double>(random_() >> 12) * 0x1p-52;
    return (random_() % 2 == 0 ? 1 : -1) * std::ldexp(significand, exponent(least, range));
  }
  template <class Number>
  Question filled(Number number) {
    Question q;
    for (int axis = 0; axis < 3; ++axis) {
      q.a.center[axis] = number();
      q.b.center[axis] = number();
    }
    q.a.radius = std::abs(number());
    q.b.radius = std::abs(number());
    q.distance = random_() % 2 == 0 ? 0 : std::abs(number());
    return q;
  }

  std::mt19937_64 random_;
};

/// Whether no number is nearer to `real` than x, and none is as near with an even last bit where x's is odd.
bool is_nearest(double x, const Real& real) {
  if (std::isinf(x))
    return abs(real) >= Real(std::numeric_limits<double>::max()) + ldexp(Real(1), 970) && (x > 0) == (real > 0);
  if (x == 0 && std::signbit(x)) return false;
  const Real away = abs(Real(x) - real);
  const bool odd = (std::bit_cast<std::uint64_t>(x) & 1) != 0;
  for (const double to : {kInfinity, -kInfinity}) {
    const double next = std::nextafter(x, to);
    const Real other = std::isinf(next) ? Real(x) + (to > 0 ? 1 : -1) * ldexp(Real(1), 971) : Real(next);
    const Real away_from_next = abs(other - real);
    if (away_from_next < away || (odd && away_from_next == away)) return false;
  }
  return true;
}

TEST(ScaledPair, settles_nothing_but_the_nearest_numbers_and_most_of_them) {
  constexpr int kCount = 1200;
  std::map<std::string, std::array<int, 8>> settled;  // of a kind: decisions, normals, points, values; and how many
  Questions questions(26);
  for (int n = 0; n < kCount; ++n) {
    const int kind = n % Questions::kKinds;
    const Question q = questions(kind);
    const auto pair = ScaledPair::of(q.a, q.b);
    std::array<Real, 3> delta;
    Real D = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      delta[i] = Real(q.b.center[axis]) - Real(q.a.center[axis]);
      D += delta[i] * delta[i];
    }
    const Real s = sqrt(D);
    const Real t = Real(q.a.radius) + Real(q.b.radius) + Real(q.distance);
    auto& of_kind = settled[Questions::name(kind)];
    const auto check = [&](std::size_t what, const std::optional<double>& number, const Real& real) {
      ++of_kind[what + 4];
      if (!number) return;
      ++of_kind[what];
      EXPECT_TRUE(is_nearest(*number, real)) << Questions::name(kind) << ", " << what << ": " << *number;
    };
    ++of_kind[4];
    if (const auto hit = pair ? pair->hit(q.distance) : std::nullopt) {
      ++of_kind[0];
      EXPECT_EQ(*hit, D <= t * t) << Questions::name(kind);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      const Real normal = delta[i] / s;
      check(1, pair ? pair->normal(i) : std::nullopt, normal);
      for (const auto& [ball, radius] : {std::pair(q.a, q.a.radius), std::pair(q.b, -q.b.radius)})
        check(2, pair ? pair->point(ball.center[axis], radius, i) : std::nullopt,
              Real(ball.center[axis]) + Real(radius) * normal);
    }
    check(3, pair ? pair->value(q.distance) : std::nullopt, s - t);
  }
  for (const auto& [kind, counts] : settled)
    for (std::size_t what = 0; what < 4; ++what) {
      const double share = static_cast<double>(counts[what]) / counts[what + 4];
      RecordProperty(kind + " " + std::to_string(what), std::to_string(share));
      EXPECT_GE(share, 0.9) << kind << ", " << what;
    }
}

TEST(ScaledPair, decides_and_answers_touching_exactly) {
  const auto touching = ScaledPair::of({{0, 0, 0}, 0x1p1000}, {{0x3p1000, 0x4p1000, 0xcp1000}, 0xcp1000});
  ASSERT_TRUE(touching.has_value());
  EXPECT_EQ(touching->hit(0), true);
  EXPECT_EQ(touching->value(0), 0.0);
  // s is more than one component by less than any number, in the unit of the question.
  EXPECT_EQ(ScaledPair::of({{0, 0, 0}, 1}, {{3, 0x1p-900, 0}, 2})->hit(0), false);
  EXPECT_EQ(ScaledPair::of({{0, 0, 0}, 1}, {{3, 0, 0}, 2})->hit(0), true);
  // The component is not one number: it is less, or more, than the reach by 2^-1000.
  EXPECT_NE(ScaledPair::of({{0x1p-1000, 0, 0}, 1}, {{3, 0, 0}, 2})->hit(0), false);
  EXPECT_NE(ScaledPair::of({{-0x1p-1000, 0, 0}, 1}, {{3, 0, 0}, 2})->hit(0), true);
}

TEST(ScaledPair, takes_the_side_of_a_tie_that_a_tiny_distance_says) {
  // t = 2 + 2^-52 lies midway between two numbers, and s - t on the side of s.
  const Ball a{{0, 0, 0}, 1};
  const Ball b{{0x1p-1000, 0, 0}, 1 + 0x1p-52};
  EXPECT_EQ(ScaledPair::of(a, b)->value(0), -2.0);
  const Ball c{{0x1p-1000, 0, 0}, 1 + 0x3p-52};
  EXPECT_EQ(ScaledPair::of(a, c)->value(0), -(2 + 0x1p-51));
  // A distance that two numbers do not hold beside the radii, or that no number of their unit holds, is on the other.
  const auto third = ScaledPair::of({{0, 0, 0}, 1}, {{0x1p-1000, 0, 0}, 0x1p-53})->value(0x1p-200);
  EXPECT_EQ(third.value_or(-(1 + 0x1p-52)), -(1 + 0x1p-52));
  const auto lost = ScaledPair::of({{0, 0, 0}, 0x1p20}, {{0x1p-1070, 0, 0}, 0x1p-33})->value(0x1p-1060);
  EXPECT_EQ(lost.value_or(-(0x1p20 + 0x1p-32)), -(0x1p20 + 0x1p-32));
}

TEST(ScaledPair, is_nothing_where_centres_coincide_or_arithmetic_is_another) {
  EXPECT_FALSE(ScaledPair::of({{1, 2, 3}, 1}, {{1, 2, 3}, 2}).has_value());
  EXPECT_EQ(ScaledPair::of({{1, 2, 3}, 1}, {{4, 5, 6}, 2})->hit(kInfinity), true);
  for (const auto& environment : floating_point_environments(false)) {
    bool taken = false;
    in_environment(environment, [&] { taken = ScaledPair::of({{1, 2, 3}, 1}, {{4, 5, 6}, 2}).has_value(); });
    EXPECT_EQ(taken, environment.rounding == FE_TONEAREST && !environment.flush) << environment.name;
  }
}

}  // namespace
}  // namespace contact::kernel::sphere_sphere_scaled_test
