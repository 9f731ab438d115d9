// Some pairs of spheres put to the batch kernel together, and their contacts.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "contact/batch.hpp"
#include "contact/detection_output.hpp"

namespace contact::component {

class SphereContacts {
 public:
  static constexpr std::size_t kMost = 256;  // pairs: what they take stays in the first two levels of cache

  void set(std::size_t k, double x1, double y1, double z1, double r1, double x2, double y2, double z2, double r2) {
    const std::array<double, 8> numbers{x1, y1, z1, r1, x2, y2, z2, r2};
    for (std::size_t column = 0; column < numbers.size(); ++column) in_[column][k] = numbers[column];
  }

  /// Calls made(k, row) for each pair k of the first `size` that is within the alarm distance, in their order.
  template <class Made>
  void compute(std::size_t size, Distances distances, ContactPoints points, const Made& made) {
    const auto given = [&](std::size_t column) { return std::span<const double>(in_[column]).first(size); };
    const auto room = [&](std::size_t column) { return std::span<double>(out_[column]).first(size); };
    const batch::Count count = batch::compute_sphere_sphere_hits({given(0), given(1), given(2), given(3)},
                                                                 {given(4), given(5), given(6), given(7)}, distances,
                                                                 std::span(index_).first(size),
                                                                 {{room(0), room(1), room(2)},
                                                                  {room(3), room(4), room(5)},
                                                                  {room(6), room(7), room(8)},
                                                                  room(9),
                                                                  std::span(state_).first(size)},
                                                                 points);
    for (std::size_t row = 0; row < count.hits; ++row) made(index_[row], row);
  }

  /// The contact of a row, between these elements.
  [[nodiscard]] DetectionOutput contact(std::size_t row, const CollisionElement& elem1, const CollisionElement& elem2,
                                        ContactId id) const {
    const auto vector = [&](std::size_t column) {
      return Vector3(out_[column][row], out_[column + 1][row], out_[column + 2][row]);
    };
    return {
        .elem = {elem1, elem2}, .id = id, .point = {vector(3), vector(6)}, .normal = vector(0), .value = out_[9][row]};
  }

 private:
  std::array<std::array<double, kMost>, 8> in_;
  std::array<std::array<double, kMost>, 10> out_;
  std::array<batch::PairState, kMost> state_;
  std::array<std::uint32_t, kMost> index_;
};

}  // namespace contact::component
