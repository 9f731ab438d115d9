// Many pairs at once: the columns' lengths, the floating-point environment, and the kernel for them.
#include "contact/batch.hpp"

#include <bit>
#include <concepts>
#include <limits>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "contact/batch_functions.hpp"
#include "kernel/batch.hpp"
#include "kernel/floating_point_environment.hpp"

namespace contact::inline CONTACT_ABI::batch {
namespace {

constexpr std::array kAxes{"x", "y", "z"};

[[noreturn]] void refuse_length(const std::string& column, std::size_t actual, std::size_t expected) {
  throw std::invalid_argument("column " + column + " holds " + std::to_string(actual) +
                              " numbers where a's first holds " + std::to_string(expected));
}
template <class T>
void expect_length(const std::string& column, std::span<T> actual, std::size_t expected) {
  if (actual.size() != expected) refuse_length(column, actual.size(), expected);
}

/// The names of the columns of a shape, as its struct in contact/batch.hpp has them.
template <class Shape>
std::vector<std::string> column_names() {
  if constexpr (std::same_as<Shape, Ball>) return {"x", "y", "z", "radius"};
  std::vector<std::string> names;
  const auto add = [&]<class Value>(const std::string& name, const Value* /*kind*/) {
    if constexpr (std::same_as<Value, double>)
      names.push_back(name);
    else
      for (const char* axis : kAxes) names.push_back(name + " " + axis);
  };
  const auto add_field = [&]<class Value>(const ShapeField<Shape, Value>& field) {
    const std::string name(field.name);
    if constexpr (std::same_as<Value, std::array<Vector3, 3>>)
      for (const char* index : {"[0]", "[1]", "[2]"}) add(name + index, static_cast<const Vector3*>(nullptr));
    else
      add(name, static_cast<const Value*>(nullptr));
  };
  std::apply([&](const auto&... field) { (add_field(field), ...); }, ShapeDescription<Shape>::kFields);
  return names;
}

template <class Shape>
using Spans = std::array<std::span<const double>, kNumbersOf<Shape>>;

template <class Shape>
std::array<const double*, kNumbersOf<Shape>> columns(const char* side, const Spans<Shape>& spans, std::size_t size) {
  std::array<const double*, kNumbersOf<Shape>> all{};
  for (std::size_t k = 0; k < spans.size(); ++k) {
    if (spans[k].size() != size) refuse_length(side + column_names<Shape>()[k], spans[k].size(), size);
    all[k] = spans[k].data();
  }
  return all;
}

template <class A, class B>
kernel::PairColumns<A, B> pairs_of(const ColumnsOf<A>& a, const ColumnsOf<B>& b) {
  const auto first = std::bit_cast<Spans<A>>(a);
  const std::size_t size = first[0].size();
  return {columns<A>("a.", first, size), columns<B>("b.", std::bit_cast<Spans<B>>(b), size), size};
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
