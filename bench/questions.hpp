// The uniform questions of a kind, in columns and one by one, and room for their answers: one set of each size.
#pragma once

#include <bit>
#include <cstdint>
#include <map>
#include <vector>

#include "columns.hpp"
#include "contact/batch_functions.hpp"
#include "contact/pairs.hpp"
#include "kernel/batch.hpp"
#include "uniform.hpp"

namespace contact::bench {

template <class A, class B>
struct Questions {
  static constexpr std::size_t kFirst = kNumbersOf<A>;
  static constexpr std::size_t kIn = kFirst + kNumbersOf<B>;
  Columns columns;
  std::vector<batch::PairState> state;
  std::vector<std::uint8_t> hit;
  std::vector<std::uint32_t> index;

  explicit Questions(std::size_t size) : columns(kIn + 10, size), state(size), hit(size), index(size) {}
  void set(std::size_t i, const Two<A, B>& shapes) {
    std::size_t k = 0;
    const auto put = [&](double x) { columns[k++][i] = x; };
    for_each_number(shapes.a, put);
    for_each_number(shapes.b, put);
  }
  [[nodiscard]] auto a() const { return side<A>(0); }
  [[nodiscard]] auto b() const { return side<B>(kFirst); }
  [[nodiscard]] batch::ContactColumns contacts() {
    const auto three = [this](std::size_t k) { return std::array{out(k), out(k + 1), out(k + 2)}; };
    return {three(0), three(3), three(6), out(9), state};
  }
  [[nodiscard]] kernel::PairColumns<A, B> pairs() const {
    kernel::PairColumns<A, B> pairs{{}, {}, hit.size()};
    for (std::size_t k = 0; k < kIn; ++k) (k < kFirst ? pairs.a[k] : pairs.b[k - kFirst]) = columns[k].data();
    return pairs;
  }
  [[nodiscard]] kernel::ContactRows rows() {
    kernel::ContactRows rows{{}, state.data()};
    for (std::size_t k = 0; k < rows.number.size(); ++k) rows.number[k] = out(k).data();
    return rows;
  }

 private:
  [[nodiscard]] std::span<double> out(std::size_t k) const { return columns[kIn + k]; }
  template <class Shape>
  [[nodiscard]] batch::ColumnsOf<Shape> side(std::size_t from) const {
    std::array<std::span<const double>, kNumbersOf<Shape>> all;
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = columns[from + k];
    return std::bit_cast<batch::ColumnsOf<Shape>>(all);
  }
};

/// A segment seldom crosses a triangle by chance: half of them go through a point of it.
template <class A, class B>
void aim(Two<A, B>& shapes, Uniform& uniform) {
  const auto inside = [&](const Triangle& triangle) -> Vector3 {
    const auto& v = triangle.vertices;
    const double s = uniform.part();
    return v[0] + s * (v[1] - v[0]) + (1 - s) * uniform.part() * (v[2] - v[0]);
  };
  if constexpr (std::same_as<A, Ray> && std::same_as<B, Triangle>)
    shapes.a.origin = inside(shapes.b) - uniform.part() * shapes.a.length * shapes.a.direction;
  if constexpr (std::same_as<B, Line>) {
    const Vector3 along = shapes.b.end - shapes.b.start;
    shapes.b.start = inside(shapes.a) - uniform.part() * along;
    shapes.b.end = shapes.b.start + along;
  }
}

template <class A, class B>
Questions<A, B> make_questions(std::size_t size) {
  Uniform uniform(1);
  Questions<A, B> made(size);
  for (std::size_t i = 0; i < size; ++i) {
    const A a = uniform.shape<A>();
    Two<A, B> shapes{a, uniform.shape<B>()};
    if (i % 2 == 0) aim(shapes, uniform);
    made.set(i, shapes);
  }
  return made;
}

template <class A, class B>
Questions<A, B>& generic(std::size_t size) {
  static std::map<std::size_t, Questions<A, B>> made;
  const auto found = made.find(size);
  return found != made.end() ? found->second : made.emplace(size, make_questions<A, B>(size)).first->second;
}

/// The same as an array of structures.
template <class A, class B>
const std::vector<Two<A, B>>& one_by_one(std::size_t size) {
  static std::map<std::size_t, std::vector<Two<A, B>>> made;
  std::vector<Two<A, B>>& pairs = made[size];
  if (pairs.empty()) {
    const auto columns = generic<A, B>(size).pairs();
    for (std::size_t i = 0; i < size; ++i) pairs.push_back({columns.first(i), columns.second(i)});
  }
  return pairs;
}

}  // namespace contact::bench
