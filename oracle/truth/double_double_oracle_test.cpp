// The double-double stage against both other oracles, its bounds against exact arithmetic from both sides, and where it
// declines.
#include "oracle/truth/double_double_oracle.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "oracle/truth/double_double.hpp"
#include "oracle/truth/exact_truth.hpp"
#include "oracle/truth/staged_oracle.hpp"

namespace contact::oracle::double_double_oracle_test {
namespace {

/// Numbers of a kind: few bits, so that results are exact or tied; all bits; and exponents near each other or far
/// apart.
class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : random_(seed) {}

  std::uint64_t below(std::uint64_t n) { return random_() % n; }
  double integer(int limit) { return static_cast<double>(below(static_cast<std::uint64_t>(2 * limit + 1))) - limit; }
  /// Of magnitude 2^least to below 2^(least + span), `bits` significant bits.
  double any(int least, int span, int bits) {
    const double significand = 1 + std::ldexp(static_cast<double>(random_() >> (65 - bits)), 1 - bits);
    const double x = std::ldexp(significand, least + static_cast<int>(below(static_cast<std::uint64_t>(span))));
    return below(2) == 0 ? x : -x;
  }
  /// A double-double with a low part of any size, and no radius.
  DoubleDouble pair(int span) {
    const double high = any(-span / 2, span, 53);
    if (below(8) == 0) return {high, 0, 0};
    return two_sum(high, std::ldexp(any(-1, 1, 53), std::ilogb(high) - 53 - static_cast<int>(below(60))));
  }

  Query spheres() {
    Query query{Pair::sphere_sphere, Balls{{{0, 0, 0}, 0}, {{0, 0, 0}, 0}}, {0, 0}};
    const auto kind = below(6);
    const int exponent = static_cast<int>(below(380)) - 190;
    for_each_number(query, [&](const std::string& field, double& x) {
      x = kind == 0   ? std::ldexp(integer(9), exponent)             // ties, touching
          : kind == 1 ? any(-200, 400, 53)                           // anywhere in range
          : kind == 2 ? any(-3, 6, 24)                               // binary32 numbers
                      : std::ldexp(any(-10, 14, 53), exponent / 4);  // as scenes have them
      if (field.ends_with("radius") || field == "alarm" || field == "contact") x = std::abs(x);
    });
    auto& [a, b] = std::get<Balls>(query.shapes);
    if (below(10) == 0) b.center = a.center;
    if (below(4) == 0) {  // beside touching
      query.distances.alarm = 0;
      double r = (b.center - a.center).norm() - a.radius;
      if (below(2) == 0) r = std::nextafter(r, below(2) == 0 ? 1e300 : 0.0);
      if (r >= 0x1p-190) b.radius = r;
    }
    return query;
  }

  Query cubes() {
    Query query{Pair::cube_cube, Boxes{{{0, 0, 0}, {0, 0, 0}}, {{0, 0, 0}, {0, 0, 0}}}, {0, 0}};
    const auto kind = below(3);
    for_each_number(query, [&](const std::string& field, double& x) {
      x = kind == 0 ? integer(4) : kind == 1 ? any(-1000, 1900, 53) : any(-2, 3, 53);
      if (field == "alarm" || field == "contact") x = std::abs(x);
    });
    auto& [a, b] = std::get<Boxes>(query.shapes);
    for (Box* box : {&a, &b})
      for (int axis = 0; axis < 3; ++axis)
        if (box->min[axis] > box->max[axis]) std::swap(box->min[axis], box->max[axis]);
    return query;
  }

 private:
  std::mt19937_64 random_;
};

Rational exactly(const DoubleDouble& x) { return Rational(x.high) + Rational(x.low); }

/// The stage's answer, if it has one, is that of both other oracles; whether it had one.
bool agrees(const Query& query, Scalar scalar) {
  const auto found = double_double_answer(query, scalar);
  if (!found) return false;
  const Truth truth = truth_of(query);
  EXPECT_EQ(first_difference(*found, rounded_answer(truth, scalar)), std::nullopt);
  EXPECT_EQ(first_difference(*found, interval_answer(query, scalar)), std::nullopt);
  if (query.has_distance()) {
    EXPECT_TRUE(found->margin.allows(witness(truth, scalar).margin_ulps));
  }
  return true;
}

TEST(DoubleDoubleOracle, answers_spheres_as_both_other_oracles_do) {
  Numbers numbers(51);
  constexpr int kCount = 12000;
  int decided = 0;
  int hits = 0;
  int exact_ties = 0;
  for (int i = 0; i < kCount; ++i) {
    const Query query = numbers.spheres();
    ASSERT_FALSE(outside_domain(query));
    for (const Scalar scalar : kScalars) decided += agrees(query, scalar) ? 1 : 0;
    ASSERT_FALSE(HasFailure()) << i;
    const auto found = double_double_answer(query, Scalar::binary64);
    hits += found && found->expected.hit ? 1 : 0;
    exact_ties += found && (found->at_alarm == 0 || found->at_zero == 0) ? 1 : 0;
  }
  EXPECT_GT(decided, kCount);  // of twice as many
  EXPECT_GT(hits, kCount / 4);
  EXPECT_LT(hits, kCount * 3 / 4);
  EXPECT_GT(exact_ties, 10);
}

TEST(DoubleDoubleOracle, answers_cubes_as_both_other_oracles_do) {
  Numbers numbers(52);
  constexpr int kCount = 6000;
  int decided = 0;
  int hits = 0;
  int touching = 0;
  for (int i = 0; i < kCount; ++i) {
    const Query query = numbers.cubes();
    decided += agrees(query, Scalar::binary64) ? 1 : 0;
    ASSERT_FALSE(HasFailure()) << i;
    const auto found = double_double_answer(query, Scalar::binary64);
    hits += found && found->expected.hit ? 1 : 0;
    touching += found && found->at_alarm == 0 ? 1 : 0;
  }
  EXPECT_GT(decided, kCount * 9 / 10);
  EXPECT_GT(hits, kCount / 10);
  EXPECT_LT(hits, kCount * 9 / 10);
  EXPECT_GT(touching, kCount / 50);
}

TEST(DoubleDoubleOracle, decides_nearly_everything_that_lies_nowhere_special) {
  Numbers numbers(53);
  constexpr int kCount = 100000;
  int decided = 0;
  int hits = 0;
  for (int i = 0; i < kCount; ++i) {
    Query query{Pair::sphere_sphere, Balls{{{0, 0, 0}, 0}, {{0, 0, 0}, 0}}, {0, 0}};
    for_each_number(query, [&](const std::string& field, double& x) {
      x = numbers.any(-5, 7, 53);
      if (field.ends_with("radius") || field == "alarm" || field == "contact") x = std::abs(x);
    });
    const auto found = double_double_answer(query, Scalar::binary64);
    decided += found ? 1 : 0;
    hits += found && found->expected.hit ? 1 : 0;
  }
  EXPECT_GE(decided, kCount - 2);
  EXPECT_GT(hits, kCount / 4);
}

/// The largest share of its own bound that an operation's error reaches, over many operands without a radius.
template <class Operation>
double worst_share(std::uint64_t seed, Operation operation) {
  Numbers numbers(seed);
  double worst = 0;
  for (int i = 0; i < 40000; ++i) {
    const auto [result, error] = operation(numbers);  // error: |result - exact|
    if (result.radius == 0) {
      EXPECT_TRUE(CGAL::is_zero(error));
      continue;
    }
    worst = std::max(worst, CGAL::to_double(error / Rational(result.radius)));
  }
  return worst;
}

struct Performed {
  DoubleDouble result;
  Rational error;
};

Rational distance(const Rational& x, const Rational& y) { return CGAL::abs(x - y); }

// Each bound from both sides: never broken, and not more than 12 times too loose.
void expect_tight(double share) {
  EXPECT_LE(share, 1);
  EXPECT_GE(share, 1.0 / 12);
}

TEST(DoubleDouble, a_sum_stays_within_its_bound) {
  expect_tight(worst_share(61, [](Numbers& n) {
    const DoubleDouble x = n.pair(6);
    const DoubleDouble y = n.pair(6);
    const DoubleDouble r = x + y;
    return Performed{r, distance(exactly(x) + exactly(y), exactly(r))};
  }));
}

TEST(DoubleDouble, a_product_stays_within_its_bound) {
  expect_tight(worst_share(62, [](Numbers& n) {
    const DoubleDouble x = n.pair(40);
    const DoubleDouble y = n.pair(40);
    const DoubleDouble r = x * y;
    return Performed{r, distance(exactly(x) * exactly(y), exactly(r))};
  }));
}

TEST(DoubleDouble, a_reciprocal_stays_within_its_bound) {
  expect_tight(worst_share(63, [](Numbers& n) {
    DoubleDouble x = n.pair(40);
    if (x.high < 0) x = -x;
    const DoubleDouble r = reciprocal(x);
    return Performed{r, distance(Rational(1) / exactly(x), exactly(r))};
  }));
}

TEST(DoubleDouble, a_root_stays_within_its_bound) {
  expect_tight(worst_share(64, [](Numbers& n) {
    DoubleDouble x = n.pair(40);
    if (x.high < 0) x = -x;
    const DoubleDouble r = root(x);
    // |sqrt(x) - r| = |x - r^2| / (sqrt(x) + r), and sqrt(x) is r but for a 2^-100th.
    return Performed{r, distance(exactly(x), exactly(r) * exactly(r)) / (Rational(2) * exactly(r))};
  }));
}

/// A number that the enclosure only knows to its radius: any that lies there must stay enclosed.
TEST(DoubleDouble, operations_carry_the_radius_of_their_operands) {
  Numbers numbers(65);
  for (int i = 0; i < 20000; ++i) {
    const auto blurred = [&](DoubleDouble x) {
      if (x.high < 0) x = -x;
      x.radius = std::ldexp(x.high, -40 - static_cast<int>(numbers.below(70)));
      return x;
    };
    const DoubleDouble x = blurred(numbers.pair(8));
    const DoubleDouble y = blurred(numbers.pair(8));
    for (const double sx : {-1.0, 1.0})
      for (const double sy : {-1.0, 1.0}) {
        const Rational real_x = exactly(x) + Rational(sx) * Rational(x.radius);
        const Rational real_y = exactly(y) + Rational(sy) * Rational(y.radius);
        const auto expect_inside = [&](const DoubleDouble& r, const Rational& real) {
          EXPECT_LE(distance(real, exactly(r)), Rational(r.radius)) << i;
        };
        expect_inside(x + y, real_x + real_y);
        expect_inside(x - y, real_x - real_y);
        expect_inside(x * y, real_x * real_y);
        expect_inside(reciprocal(x), Rational(1) / real_x);
        const DoubleDouble r = root(x);
        const Rational low = exactly(r) - Rational(r.radius);
        const Rational high = exactly(r) + Rational(r.radius);
        EXPECT_LE(low * low, real_x);
        EXPECT_GE(high * high, real_x);
      }
    ASSERT_FALSE(HasFailure());
  }
}

TEST(DoubleDouble, a_sign_is_claimed_only_where_the_whole_enclosure_has_it) {
  EXPECT_EQ((DoubleDouble{0, 0, 0}.sign()), 0);
  EXPECT_EQ((DoubleDouble{1, 0, 0}.sign()), 1);
  EXPECT_EQ((DoubleDouble{-0x1p-300, 0, 0}.sign()), -1);
  EXPECT_EQ((DoubleDouble{0, 0, 0x1p-300}.sign()), std::nullopt);
  EXPECT_EQ((DoubleDouble{1, -0x1p-53, 1 - 0x1p-53}.sign()), std::nullopt);  // 0 is the lower end
  EXPECT_EQ((DoubleDouble{-1, 0x1p-54, 1}.sign()), std::nullopt);
  EXPECT_EQ((DoubleDouble{-1, 0, 0.999}.sign()), -1);
}

std::optional<double> rounded(const DoubleDouble& x, Scalar scalar) { return round_to_nearest(x, scalar); }

TEST(DoubleDouble, rounds_only_what_rounds_to_one_number) {
  constexpr double kUp = 1 + 0x1p-52;
  // Half way between 1 and its upper neighbour: exact it is a tie, to even; enclosed it is anyone's.
  EXPECT_EQ(rounded({1, 0x1p-53, 0}, Scalar::binary64), 1.0);
  EXPECT_EQ(rounded({1, 0x1p-53, 0x1p-160}, Scalar::binary64), std::nullopt);
  EXPECT_EQ(rounded({1, 0x1p-53 - 0x1p-106, 0x1p-106}, Scalar::binary64), std::nullopt);
  EXPECT_EQ(rounded({1, 0x1p-53 - 0x1p-102, 0x1p-106}, Scalar::binary64), 1.0);
  EXPECT_EQ(rounded({kUp, -0x1p-53 + 0x1p-102, 0x1p-106}, Scalar::binary64), kUp);
  EXPECT_EQ(rounded({kUp, -0x1p-53 + 0x1p-106, 0x1p-106}, Scalar::binary64), std::nullopt);
  // A radius that reaches over the boundary, and one that does not.
  EXPECT_EQ(rounded({1, 0, 0x1p-53}, Scalar::binary64), std::nullopt);
  EXPECT_EQ(rounded({kUp, 0, 0x1p-53}, Scalar::binary64), std::nullopt);  // to the very boundary, a tie away from it
  EXPECT_EQ(rounded({1, 0, 0x1.8p-55}, Scalar::binary64), 1.0);
  // binary32: a binary64 number beside its tie must not be rounded twice.
  EXPECT_EQ(rounded({1 + 0x1p-24, 0, 0}, Scalar::binary32), 1.0);
  EXPECT_NE(rounded({1 + 0x1p-24, 0x1p-90, 0}, Scalar::binary32), std::optional(1.0));
  EXPECT_NE(rounded({1 + 0x1p-24, 0x1p-90, 0x1p-100}, Scalar::binary32), std::optional(1.0));
  EXPECT_NE(rounded({1 + 0x1p-24, -0x1p-90, 0}, Scalar::binary32), std::optional(1 + 0x1p-23));
  EXPECT_NE(rounded({1 + 0x1.8p-23, -0x1p-90, 0x1p-100}, Scalar::binary32), std::optional(1 + 0x1p-22));
  EXPECT_EQ(rounded({1 + 0x1p-23, 0x1p-80, 0x1p-90}, Scalar::binary32), 1 + 0x1p-23);
  EXPECT_EQ(rounded({0x1p200, 0, 0}, Scalar::binary32), std::numeric_limits<double>::infinity());
  const auto zero = rounded({-0x1p-190, 0, 0}, Scalar::binary32);
  ASSERT_TRUE(zero);
  EXPECT_EQ(std::bit_cast<std::uint64_t>(*zero), 0U);  // +0
}

TEST(DoubleDoubleOracle, declines_numbers_out_of_its_range) {
  const auto with_radius = [](double r) {
    return Query{Pair::sphere_sphere, Balls{{{0, 0, 0}, 1}, {{1, 2, 2}, r}}, {0, 0.25}};
  };
  EXPECT_TRUE(double_double_answer(with_radius(1.5), Scalar::binary64));
  EXPECT_TRUE(double_double_answer(with_radius(0x1p200), Scalar::binary64));
  EXPECT_FALSE(double_double_answer(with_radius(0x1.0000000000001p200), Scalar::binary64));
  EXPECT_FALSE(double_double_answer(with_radius(0x0.fffffffffffffp-200), Scalar::binary64));
  EXPECT_TRUE(double_double_answer(with_radius(0), Scalar::binary64));
  // Each number alone.
  for (int number = 0; number < 10; ++number) {
    Query query = with_radius(1.5);
    int at = 0;
    for_each_number(query, [&](const std::string&, double& x) {
      if (at++ == number) x = 0x1.8p200;
    });
    EXPECT_FALSE(double_double_answer(query, Scalar::binary64)) << number;
  }
  const auto boxes_up_to = [](double most) {
    return Query{Pair::cube_cube, Boxes{{{0, 0, 0}, {1, 1, 1}}, {{1, 0, 0}, {2, most, 1}}}, {0, 0}};
  };
  EXPECT_TRUE(double_double_answer(boxes_up_to(0x1p1000), Scalar::binary64));
  EXPECT_FALSE(double_double_answer(boxes_up_to(0x1.0000000000001p1000), Scalar::binary64));
}

TEST(DoubleDoubleOracle, tells_the_margin_of_a_golden_file_or_nothing) {
  const auto margin = [](double r1, double r2) {
    const Query query{Pair::sphere_sphere, Balls{{{0, 0, 0}, r1}, {{3, 4, 0}, r2}}, {0, 0}};
    const auto found = double_double_answer(query, Scalar::binary64);
    const double right = witness(truth_of(query), Scalar::binary64).margin_ulps;
    if (!found) return std::optional<double>();
    EXPECT_TRUE(found->margin.allows(right)) << r1 << " " << r2;
    return found->margin.rounded();
  };
  EXPECT_TRUE(margin(2, 2));
  EXPECT_TRUE(margin(0.1, 0.2));
  EXPECT_TRUE(margin(0x1p-150, 0));
  // 1 - 2^-54 rounds to 1, whose ulp is twice as large: that is left to the others
  EXPECT_FALSE(margin(1 - 0x1p-53, 0x1p-54));
  EXPECT_TRUE(margin(1, 0));
}

TEST(MarginBounds, tell_a_number_or_its_size_or_nothing) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ((MarginBounds{1.5, 1.5}.rounded()), 1.5);
  EXPECT_FALSE((MarginBounds{1.5, 1.75}.rounded()));
  EXPECT_FALSE(std::signbit(*MarginBounds{-0.0, 0.0}.rounded()));
  EXPECT_EQ((MarginBounds{1.5, 1.75}.of_its_size()), 1.5);
  EXPECT_EQ((MarginBounds{-1.75, -1.0}.of_its_size()), -1.75);
  EXPECT_EQ((MarginBounds{0, 0}.of_its_size()), 0);
  EXPECT_EQ((MarginBounds{kInfinity, kInfinity}.of_its_size()), kInfinity);
  for (const MarginBounds bounds : {MarginBounds{1.5, 2}, {-2, -1.5}, {-1.5, 1.5}, {0, 1}, {1, kInfinity}, {}})
    EXPECT_FALSE(bounds.of_its_size()) << bounds.low << " " << bounds.high;
  EXPECT_TRUE((MarginBounds{1.5, 2}.allows(2)));
  EXPECT_FALSE((MarginBounds{1.5, 2}.allows(2.5)));
  EXPECT_FALSE((MarginBounds{1.5, 2}.allows(1)));
  EXPECT_TRUE(MarginBounds{}.allows(kInfinity));
}

TEST(StagedOracle, passes_on_what_a_stage_declines_and_says_who_decided) {
  const auto stage = [](const Query& query) { return staged_answer(query, Scalar::binary64).stage; };
  EXPECT_EQ(stage({Pair::sphere_sphere, Balls{{{0, 0, 0}, 1.5}, {{1, 2, 2}, 2}}, {0, 0.25}}), Stage::double_double);
  // Half way between two doubles, and out of this stage's range.
  EXPECT_EQ(stage({Pair::sphere_sphere, Balls{{{0, 0, 0}, 0x1p300}, {{0x1p300, 0, 0}, 1}}, {0, 0}}), Stage::interval);
  // Numbers of a hundred scales, products of six of which are compared.
  const Capsule a{{3e177, -3e-281, -1e300}, {4e111, 2e100, -1e-148}, 9e21};
  const Capsule b{{6e159, 8e-252, 2e-208}, {3e-133, -8e18, 6e-120}, 3e-162};
  const Query near{Pair::capsule_capsule, Capsules{a, b}, {0, 0}};
  EXPECT_EQ(stage(near), Stage::interval);
  // Of any two convex shapes what is in no special position, and of faces along each other nothing: the exact stage is faster than intervals there.
  const auto beside = [](const Quaternion& turned) {
    return Query{Pair::obb_obb,
                 Convexes{{Obb{{0, 0, 0}, {0, 0, 1, 1}, {1, 2, 3}}}, {Obb{{3, 0, 0}, turned, {2, 1, 1}}}},
                 {0, 0}};
  };
  const Query askew = beside({1, 2, 3, 4});
  const Query along = beside({0, 0, 1, 1});
  EXPECT_EQ(stage(askew), Stage::double_double);
  EXPECT_EQ(stage(along), Stage::exact);
  for (const Query& query : {near, askew, along}) {
    const StagedAnswer answer = staged_answer(query, Scalar::binary64);
    EXPECT_EQ(first_difference(rounded_answer(answer), rounded_answer(truth_of(query), Scalar::binary64)),
              std::nullopt);
  }
}

TEST(StagedOracle, a_difference_of_two_answers_has_a_name) {
  const Query query{Pair::sphere_sphere, Balls{{{0, 0, 0}, 1.5}, {{1, 2, 2}, 2}}, {0, 0.25}};
  const RoundedAnswer right = rounded_answer(truth_of(query), Scalar::binary64);
  EXPECT_EQ(first_difference(right, right), std::nullopt);
  RoundedAnswer other = right;
  other.at_zero = 1;
  EXPECT_EQ(first_difference(right, other), "the decision");
  other = right;
  other.expected.contact->point2[1] = std::nextafter(other.expected.contact->point2[1], 9.0);
  EXPECT_EQ(first_difference(right, other), "point2[1]");
}

}  // namespace
}  // namespace contact::oracle::double_double_oracle_test
