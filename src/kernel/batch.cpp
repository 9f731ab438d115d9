// Many pairs at once: the columns' lengths, the floating-point environment, and the kernel for them.
#include "contact/batch.hpp"

#include <limits>
#include <stdexcept>
#include <string>

#include "kernel/batch.hpp"
#include "kernel/floating_point_environment.hpp"

namespace contact::batch {
namespace {

constexpr std::array kAxes{"x", "y", "z"};

template <class T>
void expect_length(const std::string& column, std::span<T> actual, std::size_t expected) {
  if (actual.size() != expected)
    throw std::invalid_argument("column " + column + " holds " + std::to_string(actual.size()) +
                                " numbers where a's first holds " + std::to_string(expected));
}

std::array<const double*, 4> columns(const std::string& side, const BallColumns& balls, std::size_t size) {
  expect_length(side + ".x", balls.x, size);
  expect_length(side + ".y", balls.y, size);
  expect_length(side + ".z", balls.z, size);
  expect_length(side + ".radius", balls.radius, size);
  return {balls.x.data(), balls.y.data(), balls.z.data(), balls.radius.data()};
}

kernel::SpherePairs pairs_of(const BallColumns& a, const BallColumns& b) {
  const std::size_t size = a.x.size();
  return {columns("a", a, size), columns("b", b, size), size};
}

std::array<const double*, 6> columns(const std::string& side, const BoxColumns& boxes, std::size_t size) {
  std::array<const double*, 6> all{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    expect_length(side + ".min " + kAxes[axis], boxes.min[axis], size);
    expect_length(side + ".max " + kAxes[axis], boxes.max[axis], size);
    all[axis] = boxes.min[axis].data();
    all[3 + axis] = boxes.max[axis].data();
  }
  return all;
}

kernel::ContactRows rows_of(const ContactColumns& out, std::size_t size) {
  kernel::ContactRows rows{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    expect_length(std::string("normal ") + kAxes[axis], out.normal[axis], size);
    expect_length(std::string("point1 ") + kAxes[axis], out.point1[axis], size);
    expect_length(std::string("point2 ") + kAxes[axis], out.point2[axis], size);
    rows.number[axis] = out.normal[axis].data();
    rows.number[3 + axis] = out.point1[axis].data();
    rows.number[6 + axis] = out.point2[axis].data();
  }
  expect_length("value", out.value, size);
  expect_length("state", out.state, size);
  rows.number[9] = out.value.data();
  rows.state = out.state.data();
  return rows;
}

}  // namespace

Count test_sphere_sphere(const BallColumns& a, const BallColumns& b, double alarm, std::span<std::uint8_t> hit) {
  const kernel::SpherePairs pairs = pairs_of(a, b);
  expect_length("hit", hit, pairs.size);
  const kernel::RoundToNearest environment;
  return kernel::test_sphere_sphere_vectors(pairs, alarm, hit.data());
}

Count test_cube_cube(const BoxColumns& a, const BoxColumns& b, double alarm, std::span<std::uint8_t> hit) {
  const std::size_t size = a.min[0].size();
  const kernel::BoxPairs pairs{columns("a", a, size), columns("b", b, size), size};
  expect_length("hit", hit, size);
  const kernel::RoundToNearest environment;
  return kernel::test_cube_cube_vectors(pairs, alarm, hit.data());
}

Count compute_sphere_sphere(const BallColumns& a, const BallColumns& b, Distances distances, const ContactColumns& out,
                            ContactPoints points) {
  const kernel::SpherePairs pairs = pairs_of(a, b);
  const kernel::ContactRows rows = rows_of(out, pairs.size);
  const kernel::RoundToNearest environment;
  return kernel::compute_sphere_sphere_vectors(pairs, {distances, points}, rows);
}

Count compute_sphere_sphere_hits(const BallColumns& a, const BallColumns& b, Distances distances,
                                 std::span<std::uint32_t> index, const ContactColumns& out, ContactPoints points) {
  const kernel::SpherePairs pairs = pairs_of(a, b);
  expect_length("index", index, pairs.size);
  if (pairs.size > std::numeric_limits<std::uint32_t>::max())
    throw std::invalid_argument("more pairs than an index can number: " + std::to_string(pairs.size));
  const kernel::ContactRows rows = rows_of(out, pairs.size);
  const kernel::RoundToNearest environment;
  return kernel::compute_sphere_sphere_hits_vectors(pairs, {distances, points}, index.data(), rows);
}

}  // namespace contact::batch
