// Numbers of any bits: the functions of one pair and every vector width under any floating-point environment, and all
// oracles say the same.
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <vector>

#include "contact/batch.hpp"
#include "contact/cube_cube.hpp"
#include "contact/sphere_sphere.hpp"
#include "fuzz/fuzz.hpp"
#include "golden/dataset.hpp"
#include "kernel/batch.hpp"
#include "environment/floating_point_environments.hpp"
#include "tool/pipeline.hpp"

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

/// The same pair in every lane of a vector and some behind the last whole one.
constexpr std::size_t kCopies = 11;

std::vector<Row> batch_rows(const Balls& balls, Distances distances) {
  std::array<std::array<double, kCopies>, 8> in{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    in[axis].fill(balls.a.center[static_cast<Eigen::Index>(axis)]);
    in[4 + axis].fill(balls.b.center[static_cast<Eigen::Index>(axis)]);
  }
  in[3].fill(balls.a.radius);
  in[7].fill(balls.b.radius);
  std::array<std::array<double, kCopies>, 10> n{};
  std::array<batch::PairState, kCopies> state{};
  batch::compute_sphere_sphere({in[0], in[1], in[2], in[3]}, {in[4], in[5], in[6], in[7]}, distances,
                               {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]}, n[9], state});
  std::vector<Row> rows(kCopies);
  for (std::size_t i = 0; i < kCopies; ++i) {
    for (std::size_t k = 0; k < n.size(); ++k) rows[i][k] = std::bit_cast<std::uint64_t>(n[k][i]);
    rows[i][10] = static_cast<std::uint64_t>(state[i]);
  }
  return rows;
}

std::array<std::uint8_t, kCopies> batch_hits(const Boxes& boxes, double alarm) {
  std::array<std::array<double, kCopies>, 12> in{};
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
  std::array<std::uint8_t, kCopies> hit{};
  batch::test_cube_cube(a, b, alarm, hit);
  return hit;
}

/// Production with one instruction set after the other, in an environment, held against `right`.
void try_production(const Query& query, const Expectation& right, const FloatingPointEnvironment& environment) {
  for (const std::string& set : kernel::instruction_sets()) {
    kernel::use_instruction_set(set);
    std::string differs;
    if (const Balls* balls = query.balls()) {
      std::optional<Contact> one;
      std::vector<Row> many;
      bool hit = false;
      in_environment(environment, [&] {
        one = compute_sphere_sphere(balls->a, balls->b, query.distances);
        hit = test_sphere_sphere(balls->a, balls->b, query.distances.alarm);
        many = batch_rows(*balls, query.distances);
      });
      if (hit != right.hit) differs = "test_sphere_sphere";
      if (without_signs_of_zeros(row_of(one)) != without_signs_of_zeros(row_of(right.contact)))
        differs = "compute_sphere_sphere";
      for (const Row& row : many)
        if (row != row_of(one)) differs = "batch::compute_sphere_sphere";
    } else {
      bool one = false;
      std::array<std::uint8_t, kCopies> many{};
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
  static const auto environments = floating_point_environments();
  try_production(query, oracle::expectation(truth, Scalar::binary64), environments[kind / 4 % environments.size()]);
}

}  // namespace contact::fuzz
