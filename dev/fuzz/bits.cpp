// Numbers of any bits: the functions of one pair and every vector width under any floating-point environment, and all
// oracles say the same.
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "contact/batch.hpp"
#include "contact/cube_cube.hpp"
#include "contact/sphere_sphere.hpp"
#include "environment/floating_point_environments.hpp"
#include "fuzz/fuzz.hpp"
#include "golden/dataset.hpp"
#include "kernel/batch.hpp"
#include "tool/run/pipeline.hpp"

namespace contact::fuzz {
namespace {

/// A question of two spheres or two boxes inside the domain, whatever the bytes: eight bytes a number, missing ones 0.
class Numbers {
 public:
  explicit Numbers(Bytes bytes) : rest_(bytes) {}

  [[nodiscard]] std::uint64_t bits() {
    std::uint64_t value = 0;
    const std::size_t n = std::min<std::size_t>(rest_.size(), 8);
    std::memcpy(&value, rest_.data(), n);
    rest_ = rest_.subspan(n);
    return value;
  }
  /// What is not finite becomes a finite number of the same sign and fraction.
  [[nodiscard]] double any() {
    const double x = std::bit_cast<double>(bits());
    return std::isfinite(x) ? x : std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & ~(std::uint64_t{1} << 62));
  }
  [[nodiscard]] double length() { return std::abs(any()); }
  [[nodiscard]] Vector3 vector() {
    const double x = any();
    const double y = any();
    return {x, y, any()};
  }

 private:
  Bytes rest_;
};

using Row = std::array<std::uint64_t, 11>;

Row row_of(const std::optional<Contact>& contact) {
  Row bits{};
  if (!contact) return bits;
  std::size_t k = 0;
  for (const Vector3* v : {&contact->normal, &contact->point1, &contact->point2})
    for (int axis = 0; axis < 3; ++axis) bits[k++] = std::bit_cast<std::uint64_t>((*v)[axis]);
  bits[k++] = std::bit_cast<std::uint64_t>(contact->value);
  bits[k] = contact->degenerate ? 2 : 1;
  return bits;
}

/// Zeros of either sign are one to the oracles.
Row without_signs_of_zeros(Row bits) {
  for (std::uint64_t& b : bits)
    if (b == std::uint64_t{1} << 63) b = 0;
  return bits;
}

/// Pairs of a batch: every lane of a vector and some behind the last whole one.
constexpr std::size_t kPairs = 11;

/// What stands beside the pair that is asked about: cheap to answer, whatever the distances.
const Balls kNeighbour{{{0, 0, 0}, 1}, {{3, 0, 4}, 1}};

/// Where the pair that is asked about stands in a batch: in two lanes, since what is left to exact arithmetic is slow.
bool is_asked(std::size_t lane, std::uint64_t kind) {
  return lane == kind / 32 % kPairs || lane == kind / 32 / kPairs % kPairs;
}

std::vector<Row> batch_rows(const Balls& asked, Distances distances, std::uint64_t kind) {
  std::array<std::array<double, kPairs>, 8> in{};
  for (std::size_t i = 0; i < kPairs; ++i) {
    const Balls& balls = is_asked(i, kind) ? asked : kNeighbour;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      in[axis][i] = balls.a.center[static_cast<Eigen::Index>(axis)];
      in[4 + axis][i] = balls.b.center[static_cast<Eigen::Index>(axis)];
    }
    in[3][i] = balls.a.radius;
    in[7][i] = balls.b.radius;
  }
  std::array<std::array<double, kPairs>, 10> n{};
  std::array<batch::PairState, kPairs> state{};
  batch::compute_sphere_sphere({in[0], in[1], in[2], in[3]}, {in[4], in[5], in[6], in[7]}, distances,
                               {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]}, n[9], state});
  std::vector<Row> rows(kPairs);
  for (std::size_t i = 0; i < kPairs; ++i) {
    for (std::size_t k = 0; k < n.size(); ++k) rows[i][k] = std::bit_cast<std::uint64_t>(n[k][i]);
    rows[i][10] = static_cast<std::uint64_t>(state[i]);
  }
  return rows;
}

std::array<std::uint8_t, kPairs> batch_hits(const Boxes& boxes, double alarm) {
  std::array<std::array<double, kPairs>, 12> in{};
  batch::BoxColumns a;
  batch::BoxColumns b;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<Eigen::Index>(axis);
    in[axis].fill(boxes.a.min[k]);
    in[3 + axis].fill(boxes.a.max[k]);
    in[6 + axis].fill(boxes.b.min[k]);
    in[9 + axis].fill(boxes.b.max[k]);
    a.min[axis] = in[axis];
    a.max[axis] = in[3 + axis];
    b.min[axis] = in[6 + axis];
    b.max[axis] = in[9 + axis];
  }
  std::array<std::uint8_t, kPairs> hit{};
  batch::test_cube_cube(a, b, alarm, hit);
  return hit;
}

/// While fuzzing, one instruction set an input, so that more of them are tried; else all.
std::vector<std::string> chosen_sets([[maybe_unused]] std::uint64_t chooser) {
  std::vector<std::string> sets = kernel::instruction_sets();
#ifdef CONTACT_LIBFUZZER
  sets = {sets[chooser % sets.size()]};
#endif
  return sets;
}

/// Production with one instruction set after the other, in an environment, held against `right`.
void try_production(const Query& query, const Expectation& right, std::uint64_t kind, std::uint64_t chooser) {
  static const auto environments = floating_point_environments();
  const FloatingPointEnvironment& environment = environments[kind / 4 % environments.size()];
  for (const std::string& set : chosen_sets(chooser)) {
    kernel::use_instruction_set(set);
    std::string differs;
    if (const Balls* balls = query.balls()) {
      std::optional<Contact> one;
      std::optional<Contact> neighbour;
      std::vector<Row> many;
      bool hit = false;
      in_environment(environment, [&] {
        one = compute_sphere_sphere(balls->a, balls->b, query.distances);
        hit = test_sphere_sphere(balls->a, balls->b, query.distances.alarm);
        neighbour = compute_sphere_sphere(kNeighbour.a, kNeighbour.b, query.distances);
        many = batch_rows(*balls, query.distances, kind);
      });
      if (hit != right.hit) differs = "test_sphere_sphere";
      if (without_signs_of_zeros(row_of(one)) != without_signs_of_zeros(row_of(right.contact)))
        differs = "compute_sphere_sphere";
      for (std::size_t i = 0; i < many.size(); ++i)
        if (many[i] != row_of(is_asked(i, kind) ? one : neighbour)) differs = "batch::compute_sphere_sphere";
    } else {
      bool one = false;
      std::array<std::uint8_t, kPairs> many{};
      in_environment(environment, [&] {
        one = test_cube_cube(query.boxes()->a, query.boxes()->b, query.distances.alarm);
        many = batch_hits(*query.boxes(), query.distances.alarm);
      });
      if (one != right.hit) differs = "test_cube_cube";
      for (const std::uint8_t hit : many)
        if ((hit != 0) != right.hit) differs = "batch::test_cube_cube";
    }
    require(differs.empty(), differs + " with " + set + ", rounding " + environment.name +
                                 ", is not what the oracles say of\n" + golden::query_line(query, Scalar::binary64));
  }
  kernel::use_instruction_set("");
}

}  // namespace

void try_input(Bytes bytes) {
  Numbers numbers(bytes);
  const std::uint64_t kind = numbers.bits();
  Query query{};
  if (kind % 4 != 3) {
    query.pair = Pair::sphere_sphere;
    Balls balls;
    balls.a.center = numbers.vector();
    balls.a.radius = numbers.length();
    balls.b.center = numbers.vector();
    balls.b.radius = numbers.length();
    query.shapes = balls;
  } else {
    query.pair = Pair::cube_cube;
    Boxes boxes;
    for (Box* box : {&boxes.a, &boxes.b}) {
      const Vector3 x = numbers.vector();
      const Vector3 y = numbers.vector();
      box->min = x.cwiseMin(y);
      box->max = x.cwiseMax(y);
    }
    query.shapes = boxes;
  }
  query.distances.alarm = numbers.length();
  query.distances.contact = numbers.length();
  const oracle::Truth truth = oracle::truth_of(query);
  for (const Scalar scalar : kScalars) {
    tool::require_agreement(query, truth, oracle::interval_answer(query, scalar), scalar);
    tool::check_stage(query, oracle::staged_answer(query, scalar), scalar);
  }
  const std::size_t chooser =
      std::hash<std::string_view>{}({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  try_production(query, oracle::expectation(truth, Scalar::binary64), kind, chooser);
}

}  // namespace contact::fuzz
