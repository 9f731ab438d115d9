// Derivatives against differences: the exact oracle is asked again, one number moved by less than any rounding would show.
#include "oracle/gradient/gradient.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

#include "golden/dataset.hpp"
#include "golden/families.hpp"
#include "golden/right_case.hpp"
#include "oracle/truth/cores.hpp"

namespace contact::golden::gradients {
namespace {

using oracle::Derivative;
using oracle::Exact;
using oracle::Rational;
using oracle::Whole;

constexpr int kStepBits = 400;  // a step in the largest number of its field, and more where other numbers are as small
constexpr int kSameBits = 200;  // two quotients that differ by less in what is natural are one derivative

/// What the exact oracle says.
struct Answer {
  oracle::DistanceTruth truth;
  std::array<Rational, 2> radius;
  Rational size;  ///< the largest coordinate of the cores

  [[nodiscard]] bool unique() const { return truth.spread().empty(); }
};

/// The numbers of an answer in whole multiples of a power of two: differences of these cost little.
class Grid {
 public:
  /// So that a number as large as `size` has so many bits.
  Grid(int bits, const Rational& size) : length_(bits - oracle::floor_log2(size)), direction_(bits) {}

  /// An output is that many times 2^-of(output).
  [[nodiscard]] long of(std::size_t output) const { return output > 0 && output < 4 ? direction_ : length_; }

  [[nodiscard]] std::array<Whole, oracle::kOutputs> numbers(const Answer& answer) const {
    const auto& [truth, radius, size] = answer;
    std::array<Whole, oracle::kOutputs> numbers;
    numbers[0] = on(truth.core_distance(), length_) - floor(radius[0] + radius[1]);
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      const Whole n = on(truth.normal(axis), direction_);
      numbers[1 + k] = n;
      numbers[4 + k] = on(truth.point(0, axis, PointOn::center), length_) + shifted(floor(radius[0]) * n, -direction_);
      numbers[7 + k] = on(truth.point(1, axis, PointOn::center), length_) - shifted(floor(radius[1]) * n, -direction_);
    }
    return numbers;
  }

  /// n 2^by, down to a whole number.
  static Whole shifted(const Whole& n, long by) { return by < 0 ? n >> -by : n << by; }
  /// x 2^by, down to a whole number.
  static Whole floor(const Rational& x, long by) {
    Whole whole;
    const Whole n = x.numerator() << std::max(by, 0L);
    mpz_fdiv_q(whole.mpz(), n.mpz(), (x.denominator() << std::max(-by, 0L)).mpz());
    return whole;
  }

 private:
  [[nodiscard]] Whole floor(const Rational& x) const { return floor(x, length_); }
  [[nodiscard]] Whole on(const Exact& x, long exponent) const {
    const Exact::Scaled scaled = x.in_whole_numbers(direction_);
    return shifted(scaled.least, exponent - scaled.exponent);
  }

  long length_;
  long direction_;
};

/// A question one of whose numbers is moved, as the exact oracle answers it.
class Neighbour {
 public:
  explicit Neighbour(const Query& query) : query_(query), named_(query) {
    double name = kFirst;
    for_each_number_unnamed(named_, [&](double& x) { x = name++; });
    for_each_number_unnamed(query_, [&](const double& x) { values_.emplace_back(x); });
  }

  [[nodiscard]] Answer at(std::size_t moving, const Rational& by) const {
    const auto make = [&](double x) -> Rational {
      if (std::abs(x) < kFirst) return Rational(x);
      const auto k = static_cast<std::size_t>(std::abs(x) - kFirst);
      const Rational value = values_[k] + (k == moving ? by : Rational(0));
      return x < 0 ? -value : value;
    };
    std::array<oracle::ExactCore, 2> cores;
    std::array<Rational, 2> radius{Rational(0), Rational(0)};
    std::optional<oracle::ExactTruth> truth;
    std::size_t i = 0;
    for_each_shape(named_, [&]<class Shape>(const Shape& shape) {
      if constexpr (std::same_as<Shape, Plane>)
        truth = truth_of_cores(cores[0], oracle::vec(make, shape.normal), make(shape.offset), query_.distances);
      else
        cores[i] = core(make, shape);
      if constexpr (kHasRadius<Shape>) radius[i] = make(shape.radius);
      ++i;
    });
    if (!truth) {
      enclose_in_range(cores[0], cores[1]);
      truth = truth_of_cores(cores[0], cores[1], query_.distances,
                             is_convex(query_.pair) ? oracle::Rules::of_all : oracle::Rules::of_the_pair);
    }
    Answer answer{std::get<oracle::DistanceTruth>(truth->numbers), radius, Rational(0)};
    for (const oracle::ExactCore& core : cores)
      if (!core.vertices.empty()) answer.size = std::max(answer.size, oracle::largest_coordinate(core.vertices));
    return answer;
  }

 private:
  static constexpr double kFirst = 16;

  template <class Make, class Shape>
  static oracle::ExactCore core(const Make& make, const Shape& shape) {
    if constexpr (std::same_as<Shape, Hull>) {
      return oracle::exact_hull(oracle::points_of(make, shape));
    } else {
      auto found = oracle::core_of(make, shape);
      if (found.over)
        for (oracle::Point& x : found.vertices)
          for (Rational& number : x) number /= *found.over;
      return oracle::exact_core(found.vertices, found.features, found.outward);
    }
  }

  Query query_;
  Query named_;
  std::vector<Rational> values_;
};

/// How many derivatives were compared, by what was said of them.
struct Counts {
  std::uint64_t questions = 0;
  std::uint64_t told = 0;
  std::uint64_t kinks = 0;
  std::uint64_t undefined = 0;
  std::uint64_t not_told = 0;
};

/// Whether a number is n 2^-exponent rounded, give or take `noise` of them, beside which the few that whole numbers cut off are nothing.
bool is_rounded(double said, const Whole& n, long exponent, const Whole& noise) {
  const Rational x = Rational(n) * oracle::power_of_two(static_cast<int>(-exponent));
  if (!std::isfinite(said)) return CGAL::abs(x) > Rational(0x1.fffffffffffffp1023);
  const Rational room = oracle::ulp(x, Scalar::binary64) * (Rational(1, 2) + oracle::power_of_two(-40));
  return CGAL::abs(Grid::floor(Rational(said), exponent) - n) <= Grid::floor(room, exponent) + noise + Whole(2);
}

/// How far each number of a question is moved: by next to nothing of what is as large as it can matter.
class Steps {
 public:
  Steps(const Query& query, const Rational& size) : size_(CGAL::is_zero(size) ? Rational(1) : size) {
    std::vector<Rational> directions;  // the largest component of each shape's, or 1
    for_each_shape(query, [&](const auto& shape) {
      Rational largest(0);
      for_each_field(shape, [&](const auto& field, const auto& value) {
        if (has_free_length(field.kind))
          for_each_number_in(value, [&](const double& x) { largest = std::max(largest, CGAL::abs(Rational(x))); });
      });
      directions.push_back(CGAL::is_zero(largest) ? Rational(1) : largest);
    });
    auto direction = directions.begin();
    for_each_shape(query, [&]<class Shape>(const Shape& shape) {
      for_each_field(shape, [&](const auto& field, const auto& value) {
        const bool counts_directions = std::same_as<Shape, Ray> && field.kind == FieldKind::length;
        const Rational natural = has_free_length(field.kind)       ? *direction
                                 : field.kind == FieldKind::offset ? Rational(size_ * *direction)
                                 : counts_directions               ? Rational(size_ / *direction)
                                                                   : size_;
        const bool is_radius = field.name == "radius";
        for_each_number_in(value, [&](const double& x) {
          natural_.push_back(natural);
          if (x != 0 && (!is_radius || Rational(std::abs(x)) > natural))
            ratio_bits_ = std::max(ratio_bits_, std::abs(oracle::floor_log2(natural) - std::ilogb(x)));
        });
      });
      ++direction;
    });
  }
  [[nodiscard]] const Rational& size() const { return size_; }
  [[nodiscard]] const Rational& natural(std::size_t k) const { return natural_[k]; }
  /// A step is two to this.
  [[nodiscard]] int of(std::size_t k) const { return oracle::floor_log2(natural_[k]) - kStepBits - 4 * ratio_bits_; }
  /// A kink may be as small as the smallest numbers are beside the largest, twice: two turned boxes are nearly along each other.
  [[nodiscard]] int same_bits() const { return kSameBits + 2 * ratio_bits_; }
  [[nodiscard]] int root_bits() const { return 4 * kStepBits + 8 * ratio_bits_; }

 private:
  Rational size_;
  std::vector<Rational> natural_;
  int ratio_bits_ = 0;
};

/// Of the numbers of a question, one in `every` is moved.
void compare(const Query& query, std::size_t every, Counts& counts) {
  const oracle::Truth truth = oracle::truth_of(query);
  const auto gradient = oracle::gradient(query, truth);
  ASSERT_TRUE(gradient);
  const Neighbour beside(query);
  const Answer here = beside.at(0, Rational(0));
  const Steps steps(query, here.size);
  const Grid grid(steps.root_bits(), steps.size());
  const auto before = grid.numbers(here);
  ++counts.questions;
  Query moved = query;
  const auto numbers = numbers_of(moved);
  for (std::size_t k = counts.questions % every; k < gradient->by.size(); k += every) {
    const int step = steps.of(k);
    // At an edge of the domain the number next to it is out of it; so are those next to the largest and the smallest, which are no edges.
    std::array<bool, 2> has_side;
    double& number = *numbers.elements[k];
    const double x = number;
    for (const bool above : {false, true}) {
      number = std::nextafter(x, above ? HUGE_VAL : -HUGE_VAL);
      has_side[above] = inside_domain(moved) || !std::isfinite(number) || (x != 0 && number == 0);
    }
    number = x;
    const Answer above = beside.at(k, oracle::power_of_two(step));
    const Answer below = beside.at(k, -oracle::power_of_two(step));
    const auto numbers_above = grid.numbers(above);
    const auto numbers_below = grid.numbers(below);
    for (std::size_t output = 0; output < oracle::kOutputs; ++output) {
      const Derivative& said = gradient->derivatives[k][output];
      const auto where = [&] {
        return query_line(query, Scalar::binary64) + "\n" + gradient->by[k] + " output " + std::to_string(output) +
               " " + std::string(said.undefined);
      };
      const Whole right = numbers_above[output] - before[output];
      const Whole left = before[output] - numbers_below[output];
      const long exponent = grid.of(output) + step;  // of differences, as quotients
      const bool is_normal = output > 0 && output < 4;
      const Whole noise =
          Grid::floor((is_normal ? Rational(1) : steps.size()) / steps.natural(k), exponent - steps.same_bits());
      const bool differ = CGAL::abs(right - left) > noise + ((CGAL::abs(right) + CGAL::abs(left)) >> steps.same_bits());
      const bool is_point = output > 3;
      if (!has_side[0] || !has_side[1]) {
        ASSERT_FALSE(said.number || (said.sides[0] && said.sides[1])) << where();
      }
      if (said.number) {
        ++counts.told;
        ASSERT_FALSE(differ) << where();
        ASSERT_TRUE(is_rounded(*said.number, left + right, exponent + 1, noise + noise)) << where() << *said.number;
        if (is_point) {
          ASSERT_TRUE(here.unique() && above.unique() && below.unique()) << where();
        }
      } else if (said.undefined.starts_with("not told")) {
        ++counts.not_told;
      } else if (said.sides[0] && said.sides[1]) {
        ++counts.kinks;
        ASSERT_TRUE(differ) << where();
        ASSERT_TRUE(is_rounded(*said.sides[0], left, exponent, noise)) << where() << *said.sides[0];
        ASSERT_TRUE(is_rounded(*said.sides[1], right, exponent, noise)) << where() << *said.sides[1];
      } else if (said.sides[0] || said.sides[1]) {
        ++counts.undefined;
        ASSERT_EQ(has_side, (std::array{said.sides[0].has_value(), said.sides[1].has_value()})) << where();
        ASSERT_TRUE(
            is_rounded(said.sides[0] ? *said.sides[0] : *said.sides[1], said.sides[0] ? left : right, exponent, noise))
            << where();
      } else {
        ++counts.undefined;
        ASSERT_GT(output, 0U) << where();
        ASSERT_TRUE(here.truth.meets() || (is_point && !(here.unique() && above.unique() && below.unique())))
            << where();
      }
    }
  }
}

#ifdef CONTACT_SANITIZED
constexpr std::uint64_t kShare = 3;
#else
constexpr std::uint64_t kShare = 1;
#endif
/// ./run campaign sets CONTACT_EVERY_GRADIENT: how many fresh questions a family.
const char* const kMany = std::getenv("CONTACT_EVERY_GRADIENT");
const bool kEveryGradient = kMany != nullptr;
/// Whoever has many processors sets these besides, each process to others.
const char* const kSeed = std::getenv("CONTACT_GRADIENT_SEED");
const char* const kPair = std::getenv("CONTACT_GRADIENT_PAIR");

/// Of shapes with faces one number in so many is moved, of the next question the next ones: a step of two boxes takes milliseconds.
std::size_t every(Pair pair) { return kShare * (!is_convex(pair) ? 1 : has_hull(pair) ? 19 : 5); }

void expect_enough(const std::map<Pair, Counts>& all) {
  std::uint64_t kinks = 0;
  std::uint64_t undefined = 0;
  for (const auto& [pair, c] : all) {
    std::cout << name(pair) << ": " << c.questions << " questions, " << c.told << " derivatives, " << c.kinks
              << " kinks, " << c.undefined << " undefined, " << c.not_told << " not told\n";
    const std::uint64_t asked = c.told + c.kinks + c.undefined + c.not_told;
    EXPECT_GT(3 * c.told, asked) << name(pair);
    EXPECT_LT((is_convex(pair) ? 4 : 20) * c.not_told, asked) << name(pair);
    kinks += c.kinks;
    undefined += c.undefined;
  }
  if (all.size() == 1) return;
  EXPECT_GT(kinks, 500U / kShare / kShare);
  EXPECT_GT(undefined, 500U / kShare / kShare);
}

TEST(Gradients, are_the_differences_of_exact_answers_to_golden_questions) {
  std::map<Pair, Counts> all;
  for (const auto& path : dataset_files({std::filesystem::path(CONTACT_SOURCE_DIR) / "golden"})) {
    DatasetReader reader(path, is_made);
    const Pair pair = reader.header().pair;
    if (reader.header().family == kInvalidFamily || !has_distance(pair)) continue;
    const std::uint64_t count = reader.header().count;
    const std::uint64_t asked = kEveryGradient ? 100 : is_convex(pair) ? 1 : 3 / kShare;
    const std::uint64_t one_in = (count + asked - 1) / asked;
    std::uint64_t index = 0;
    while (const auto c = reader.next())
      if (index++ % one_in == 0) {
        ASSERT_NO_FATAL_FAILURE(compare(c->query, every(pair), all[pair]));
      }
  }
  EXPECT_GT(all.size(), 15U);
  expect_enough(all);
}

TEST(Gradients, are_the_differences_of_exact_answers_to_fresh_questions) {
  std::map<Pair, Counts> all;
  const std::uint64_t seed = kSeed == nullptr ? 7 : std::strtoull(kSeed, nullptr, 10);
  for (const Pair pair : kPairs) {
    if (!has_distance(pair) || (kPair != nullptr && name(pair) != kPair)) continue;
    for (const Family& family : families_of(pair)) {
      if (family.name == kInvalidFamily) continue;
      const std::uint64_t count = kEveryGradient ? std::strtoull(kMany, nullptr, 10) : is_convex(pair) ? 1 : 3 / kShare;
      for (std::uint64_t index = 0; index < count; ++index)
        ASSERT_NO_FATAL_FAILURE(
            compare(generate_query(pair, family, Scalar::binary64, seed, index), every(pair), all[pair]));
    }
  }
  expect_enough(all);
}

// What families seldom make: features that have no length, or go along each other, until a number moves.
TEST(Gradients, are_the_differences_where_features_coincide) {
  Counts counts;
  for (
      const char* line : {
          // An axis without length over a level plane: it lies along the plane as soon as an end moves.
          R"({"pair":"capsule_plane","a":{"start":[1,2,3],"end":[1,2,3],"radius":1},"b":{"normal":[0,0,2],"offset":1},"alarm":0,"contact":0})",
          // The same beside another axis, and beside a sphere.
          R"({"pair":"capsule_capsule","a":{"start":[0,2,0],"end":[0,2,0],"radius":1},"b":{"start":[-1,0,0],"end":[1,0,0],"radius":1},"alarm":0,"contact":0})",
          R"({"pair":"sphere_capsule","a":{"center":[0,2,0],"radius":1},"b":{"start":[0,0,0],"end":[0,0,0],"radius":1},"alarm":0,"contact":0})",
          // A box that is a segment along an axis: turned, the two cross.
          R"({"pair":"capsule_obb","a":{"start":[-2,0,5],"end":[2,0,5],"radius":1},"b":{"center":[0,0,0],"orientation":[0,0,0,1],"extents":[5,0,0]},"alarm":9,"contact":0})",
          // A hull with a corner twice, and one with a square face whose diagonals cross at the nearest point.
          R"({"pair":"sphere_hull","a":{"center":[0,3,0],"radius":1},"b":{"vertices":[[0,0,0],[0,0,0],[2,-1,0],[0,-1,2]],"radius":0.5},"alarm":9,"contact":0})",
          R"({"pair":"sphere_hull","a":{"center":[1,3,1],"radius":1},"b":{"vertices":[[0,0,0],[2,0,0],[0,0,2],[2,0,2],[1,-1,1]],"radius":0},"alarm":9,"contact":0})",
          // A centre inside a box, as near to two faces; on the axis of a capsule, which it may move along.
          R"({"pair":"sphere_cube","a":{"center":[1,1,3],"radius":1},"b":{"min":[0,0,0],"max":[8,8,8]},"alarm":0,"contact":0})",
          R"({"pair":"sphere_capsule","a":{"center":[1,0,0],"radius":1},"b":{"start":[0,0,0],"end":[3,0,0],"radius":1},"alarm":0,"contact":0})",
      }) {
    const formats::Location where{"question", 0};
    const auto json = formats::parse_object(line, where);
    ASSERT_NO_FATAL_FAILURE(compare(read_query(formats::Node(json, where)).query, 1, counts));
  }
  EXPECT_GT(counts.kinks, 50U);
  EXPECT_GT(counts.undefined, 100U);
  EXPECT_EQ(counts.not_told, 0U);
}

}  // namespace
}  // namespace contact::golden::gradients
