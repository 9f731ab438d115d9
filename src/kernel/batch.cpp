// Many pairs at once: the columns' lengths, the floating-point environment, and the kernel for them.
#include "contact/batch.hpp"

#include <limits>
#include <stdexcept>
#include <string>

#include "kernel/batch.hpp"
#include "kernel/floating_point_environment.hpp"

namespace contact::inline CONTACT_ABI::batch {
namespace {

constexpr std::array kAxes{"x", "y", "z"};

template <class T>
void expect_length(const std::string& column, std::span<T> actual, std::size_t expected) {
  if (actual.size() != expected)
    throw std::invalid_argument("column " + column + " holds " + std::to_string(actual.size()) +
                                " numbers where a's first holds " + std::to_string(expected));
}

std::size_t size_of(const BallColumns& balls) { return balls.x.size(); }
std::size_t size_of(const BoxColumns& boxes) { return boxes.min[0].size(); }
std::size_t size_of(const CapsuleColumns& capsules) { return capsules.start[0].size(); }

std::array<const double*, 4> columns(const std::string& side, const BallColumns& balls, std::size_t size) {
  expect_length(side + ".x", balls.x, size);
  expect_length(side + ".y", balls.y, size);
  expect_length(side + ".z", balls.z, size);
  expect_length(side + ".radius", balls.radius, size);
  return {balls.x.data(), balls.y.data(), balls.z.data(), balls.radius.data()};
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

std::array<const double*, 7> columns(const std::string& side, const CapsuleColumns& capsules, std::size_t size) {
  std::array<const double*, 7> all{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    expect_length(side + ".start " + kAxes[axis], capsules.start[axis], size);
    expect_length(side + ".end " + kAxes[axis], capsules.end[axis], size);
    all[axis] = capsules.start[axis].data();
    all[3 + axis] = capsules.end[axis].data();
  }
  expect_length(side + ".radius", capsules.radius, size);
  all[6] = capsules.radius.data();
  return all;
}

template <class A, class B, class First, class Second>
kernel::PairColumns<A, B> pairs_of(const First& a, const Second& b) {
  const std::size_t size = size_of(a);
  return {columns("a", a, size), columns("b", b, size), size};
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

void expect_index(std::span<std::uint32_t> index, std::size_t size) {
  expect_length("index", index, size);
  if (size > std::numeric_limits<std::uint32_t>::max())
    throw std::invalid_argument("more pairs than an index can number: " + std::to_string(size));
}

}  // namespace

#define CONTACT_TEST(name, A, B)                                                                           \
  Count test_##name(const A##Columns& a, const B##Columns& b, double alarm, std::span<std::uint8_t> hit) { \
    const auto pairs = pairs_of<A, B>(a, b);                                                               \
    expect_length("hit", hit, pairs.size);                                                                 \
    const kernel::RoundToNearest environment;                                                              \
    return kernel::test_vectors(pairs, alarm, hit.data());                                                 \
  }
CONTACT_BATCH_PAIRS(CONTACT_TEST)

#define CONTACT_COMPUTE(name, A, B)                                                                              \
  Count compute_##name(const A##Columns& a, const B##Columns& b, Distances distances, const ContactColumns& out, \
                       ContactPoints points) {                                                                   \
    const auto pairs = pairs_of<A, B>(a, b);                                                                     \
    const kernel::ContactRows rows = rows_of(out, pairs.size);                                                   \
    const kernel::RoundToNearest environment;                                                                    \
    return kernel::compute_vectors(pairs, {distances, points}, rows);                                            \
  }                                                                                                              \
  Count compute_##name##_hits(const A##Columns& a, const B##Columns& b, Distances distances,                     \
                              std::span<std::uint32_t> index, const ContactColumns& out, ContactPoints points) { \
    const auto pairs = pairs_of<A, B>(a, b);                                                                     \
    expect_index(index, pairs.size);                                                                             \
    const kernel::ContactRows rows = rows_of(out, pairs.size);                                                   \
    const kernel::RoundToNearest environment;                                                                    \
    return kernel::compute_hits_vectors(pairs, {distances, points}, index.data(), rows);                         \
  }
CONTACT_BATCH_CONTACTS(CONTACT_COMPUTE)
#undef CONTACT_TEST
#undef CONTACT_COMPUTE

}  // namespace contact::inline CONTACT_ABI::batch
