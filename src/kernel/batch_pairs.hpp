// Pairs of any kind in columns, with room for their answers: for whoever has the shapes one by one.
#pragma once

#include <bit>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "contact/batch_functions.hpp"
#include "contact/pairs.hpp"

namespace contact::inline CONTACT_ABI::batch {

/// What stands in a column of numbers, by contact and number: normal, point1, point2, value.
inline double& number_of(Contact& contact, std::size_t k) {
  const auto axis = static_cast<Eigen::Index>(k % 3);
  return k < 3 ? contact.normal[axis] : k < 6 ? contact.point1[axis] : k < 9 ? contact.point2[axis] : contact.value;
}

template <class A, class B>
class Pairs {
 public:
  explicit Pairs(std::size_t size)
      : size_(size),
        numbers_((kFirst + kSecond + kContact) * size, std::numeric_limits<double>::quiet_NaN()),
        hit_(size, 77),
        state_(size),
        index_(size) {}

  [[nodiscard]] std::size_t size() const { return size_; }
  void set(std::size_t i, const Two<A, B>& shapes) {
    std::size_t column = 0;
    const auto put = [&](double x) { at(column++)[i] = x; };
    for_each_number(shapes.a, put);
    for_each_number(shapes.b, put);
  }
  [[nodiscard]] ColumnsOf<A> first() const { return columns<A, kFirst>(0); }
  [[nodiscard]] ColumnsOf<B> second() const { return columns<B, kSecond>(kFirst); }

  Count test(double alarm) { return batch::test(first(), second(), alarm, hit_); }
  Count compute(Distances distances, ContactPoints points = {}) requires Computes<A, B> {
    return batch::compute(first(), second(), distances, out(), points);
  }
  Count compute_hits(Distances distances, ContactPoints points = {}) requires Computes<A, B> {
    return batch::compute_hits(first(), second(), distances, index_, out(), points);
  }

  // What the last call has written.
  [[nodiscard]] const std::vector<std::uint8_t>& hit() const { return hit_; }
  [[nodiscard]] const std::vector<std::uint32_t>& index() const { return index_; }
  [[nodiscard]] const std::vector<PairState>& state() const { return state_; }
  /// The contact in a row, or nothing where it is a miss.
  [[nodiscard]] std::optional<Contact> contact(std::size_t row) const {
    if (state_[row] == PairState::miss) return std::nullopt;
    return numbers(row);
  }
  /// The numbers in a row, whatever they are.
  [[nodiscard]] Contact numbers(std::size_t row) const {
    Contact contact;
    for (std::size_t k = 0; k < kContact; ++k) number_of(contact, k) = at(kFirst + kSecond + k)[row];
    contact.degenerate = is_degenerate(state_[row]);
    contact.unique = is_unique(state_[row]);
    return contact;
  }

 private:
  static constexpr std::size_t kFirst = kNumbersOf<A>;
  static constexpr std::size_t kSecond = kNumbersOf<B>;
  static constexpr std::size_t kContact = 10;

  [[nodiscard]] double* at(std::size_t column) { return numbers_.data() + column * size_; }
  [[nodiscard]] const double* at(std::size_t column) const { return numbers_.data() + column * size_; }
  template <class Shape, std::size_t kCount>
  [[nodiscard]] ColumnsOf<Shape> columns(std::size_t from) const {
    std::array<std::span<const double>, kCount> all;
    for (std::size_t k = 0; k < kCount; ++k) all[k] = {at(from + k), size_};
    return std::bit_cast<ColumnsOf<Shape>>(all);
  }
  [[nodiscard]] ContactColumns out() {
    const auto column = [this](std::size_t k) { return std::span(at(kFirst + kSecond + k), size_); };
    const auto three = [&](std::size_t k) { return std::array{column(k), column(k + 1), column(k + 2)}; };
    return {three(0), three(3), three(6), column(9), state_};
  }

  std::size_t size_;
  std::vector<double> numbers_;
  std::vector<std::uint8_t> hit_;
  std::vector<PairState> state_;
  std::vector<std::uint32_t> index_;
};

}  // namespace contact::inline CONTACT_ABI::batch
