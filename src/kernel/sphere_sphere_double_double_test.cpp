// The fast stage of sphere against sphere: its errors from both sides, its domain, and what it hands on.
#include "kernel/sphere_sphere_double_double.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <string>

#include "environment/floating_point_environments.hpp"

namespace contact::kernel::sphere_sphere_double_double_test {
namespace {

// Wide enough that nothing in the fast stage's domain (numbers down to 2^-272, results down to 2^-715) loses a digit
// that a bound could see.
using Real =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<1000, boost::multiprecision::digit_base_2>,
                                  boost::multiprecision::et_off>;

struct Question {
  Ball a;
  Ball b;
  Distances distances;
};

/// Questions of every kind that the errors depend on: how far exponents lie apart, and what cancels.
class Questions {
 public:
  explicit Questions(std::uint64_t seed) : random_(seed) {}

  Question operator()(int kind) {
    Question q{};
    switch (kind) {
      case 0:  // of one size
        fill(q, [this] { return number(0, 3); });
        break;
      case 1:  // of any size
        fill(q, [this] { return number(-219, 438); });
        break;
      case 2:  // one axis much smaller than the others
        fill(q, [this] { return number(0, 3); });
        q.a.center[2] = number(-60, 40);
        q.b.center[2] = number(-60, 40);
        break;
      case 3: {  // a point that nearly cancels: the first radius brings it to a coordinate plane
        fill(q, [this] { return number(0, 3); });
        const Vector3 delta = q.b.center - q.a.center;
        q.a.radius = std::abs(q.a.center[0] / (delta[0] / delta.norm()));
        break;
      }
      default: {  // a value that nearly cancels
        fill(q, [this] { return number(0, 3); });
        q.a.radius = std::abs((q.b.center - q.a.center).norm() - (q.b.radius + q.distances.contact));
        break;
      }
    }
    return q;
  }
  static constexpr int kKinds = 5;

 private:
  /// A number with a full significand and an exponent from `least` over `range` values, of either sign.
  double number(int least, int range) {
    const auto exponent = least + static_cast<int>(random_() % static_cast<std::uint64_t>(range));
    const double significand = 1 + static_cast<double>(random_() >> 12) * 0x1p-52;
    const double sign = random_() % 2 == 0 ? 1 : -1;
    return sign * std::ldexp(significand, exponent);
  }
  template <class Number>
  void fill(Question& q, Number number) {
    for (int axis = 0; axis < 3; ++axis) {
      q.a.center[axis] = number();
      q.b.center[axis] = number();
    }
    q.a.radius = std::abs(number());
    q.b.radius = std::abs(number());
    q.distances.contact = std::abs(number());
  }

  std::mt19937_64 random_;
};

/// |approximation - real| in units of its error.
double share(const Approximation& approximation, const Real& real) {
  const Real difference = abs(Real(approximation.high) + Real(approximation.low) - real);
  return approximation.error == 0 ? (difference == 0 ? 0.0 : std::numeric_limits<double>::infinity())
                                  : static_cast<double>(difference / Real(approximation.error));
}

TEST(DoubleDoublePair, errors_are_neither_broken_nor_more_than_12_times_too_loose) {
  std::map<std::string, double> worst;
  std::map<std::string, int> certain;
  constexpr int kCount = 25000;
  Questions questions(21);
  for (int n = 0; n < kCount; ++n) {
    const Question q = questions(n % Questions::kKinds);
    const auto pair = DoubleDoublePair::of(q.a, q.b, q.distances);
    ASSERT_TRUE(pair.has_value());
    std::array<Real, 3> delta;
    Real D = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      delta[i] = Real(q.b.center[axis]) - Real(q.a.center[axis]);
      D += delta[i] * delta[i];
    }
    const Real s = sqrt(D);
    const auto check = [&](const std::string& what, const Approximation& approximation, const Real& real) {
      worst[what] = std::max(worst[what], share(approximation, real));
      const auto rounded = approximation.rounded();
      certain[what] += rounded.has_value();
      if (rounded) {
        // Nearest: no nearer neighbour. (What is certain is no tie.)
        const Real away = abs(Real(*rounded) - real);
        const double infinity = std::numeric_limits<double>::infinity();
        EXPECT_LT(away, abs(Real(std::nextafter(*rounded, infinity)) - real)) << what;
        EXPECT_LT(away, abs(Real(std::nextafter(*rounded, -infinity)) - real)) << what;
      }
    };
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      const Real normal = delta[i] / s;
      check("normal", pair->normal(i), normal);
      check("point", pair->point(q.a.center[axis], q.a.radius, i), Real(q.a.center[axis]) + Real(q.a.radius) * normal);
      check("point", pair->point(q.b.center[axis], -q.b.radius, i), Real(q.b.center[axis]) - Real(q.b.radius) * normal);
    }
    // Apart by which term of the bound dominates, so that none of them hides behind the others.
    const Real t = Real(q.a.radius) + Real(q.b.radius) + Real(q.distances.contact);
    check(t < s / 8 ? "value, root" : t > 8 * s ? "value, radii" : "value", pair->value(), s - t);
  }
  for (const auto& [what, share] : worst) {
    RecordProperty(what, std::to_string(share));
    EXPECT_LE(share, 1) << what << ": broken";
    EXPECT_GE(share, 1.0 / 12) << what << ": more than 12 times too loose";
  }
  // A fast stage that hands everything on would pass all of the above. Only what nearly cancels may often be uncertain.
  EXPECT_GE(certain["normal"], kCount * 3 * 0.999);
  EXPECT_GE(certain["point"], kCount * 6 * 0.95);
  EXPECT_GE(certain["value"] + certain["value, root"] + certain["value, radii"], kCount * 0.79);
}

TEST(DoubleDoublePair, takes_numbers_from_2_to_the_minus_220_to_2_to_the_220_and_zero) {
  const auto taken = [](double x) {
    const Ball a{{1, 0, -2}, 1};
    const Ball b{{-3, 4, 0}, 1};
    const auto with = [&](int place) {
      Ball other = a;
      Distances distances{1, 1};
      (place < 3 ? other.center[place] : place == 3 ? other.radius : distances.contact) = x;
      return DoubleDoublePair::of(other, b, distances).has_value() &&
             (place == 4 || DoubleDoublePair::of(b, other, distances));
    };
    int count = 0;
    for (int place = 0; place < 5; ++place) count += with(place);
    return count;
  };
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double x : {0.0, -0.0, 0x1p-220, -0x1p-220, 0x1p220, -0x1p220}) EXPECT_EQ(taken(x), 5) << x;
  for (const double x : {std::nextafter(0x1p-220, 0), std::nextafter(0x1p220, infinity), 0x1p-1022, 0x1p-1074, infinity,
                         std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::max()})
    EXPECT_EQ(taken(x), 0) << x;
}

TEST(DoubleDoublePair, leaves_coincident_centres_to_exact_arithmetic) {
  EXPECT_FALSE(DoubleDoublePair::of({{1, 2, 3}, 1}, {{1, 2, 3}, 2}, {0, 0}).has_value());
  EXPECT_TRUE(DoubleDoublePair::of({{1, 2, 3}, 1}, {{1, 2, std::nextafter(3, 4)}, 2}, {0, 0}).has_value());
}

TEST(DoubleDoublePair, works_to_nearest_alone_whatever_becomes_of_subnormals) {
  for (const auto& environment : floating_point_environments(false)) {
    bool taken = false;
    bool subnormal_taken = true;
    in_environment(environment, [&] {
      taken = DoubleDoublePair::of({{1, 2, 3}, 1}, {{4, 5, 6}, 2}, {0, 0}).has_value();
      subnormal_taken = DoubleDoublePair::of({{0x1p-1060, 2, 3}, 1}, {{4, 5, 6}, 2}, {0, 0}).has_value();
    });
    EXPECT_EQ(taken, environment.rounding == FE_TONEAREST) << environment.name;
    EXPECT_FALSE(subnormal_taken) << environment.name;
  }
}

TEST(Approximation, is_rounded_where_both_ends_agree_and_nowhere_else) {
  EXPECT_EQ((Approximation{1, 0x1p-60, 0x1p-70}.rounded()), 1.0);
  EXPECT_EQ((Approximation{1, 0x1p-53, 0x1p-70}.rounded()), std::nullopt);  // about a tie
  EXPECT_EQ((Approximation{1, 0x1p-53 + 0x1p-65, 0x1p-70}.rounded()), 1 + 0x1p-52);
  EXPECT_EQ((Approximation{1, -0x1p-54, 0x1p-70}.rounded()), std::nullopt);  // the tie below a power of two is nearer
  EXPECT_EQ((Approximation{0, 0, 0}.rounded()), 0.0);
  EXPECT_FALSE(std::signbit(Approximation{-0.0, -0.0, 0}.rounded().value()));
}

}  // namespace
}  // namespace contact::kernel::sphere_sphere_double_double_test
