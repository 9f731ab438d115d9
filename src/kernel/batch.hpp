// The batch kernels behind contact/batch.hpp: their arguments, the scalar kernel that specifies them, and dispatch.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "contact/batch.hpp"
#include "contact/contact.hpp"
#include "contact/geometry.hpp"

namespace contact::kernel {

/// Columns of pairs of balls: x, y, z, radius of each side.
struct SpherePairs {
  std::array<const double*, 4> a;
  std::array<const double*, 4> b;
  std::size_t size;

  [[nodiscard]] Ball first(std::size_t i) const { return {{a[0][i], a[1][i], a[2][i]}, a[3][i]}; }
  [[nodiscard]] Ball second(std::size_t i) const { return {{b[0][i], b[1][i], b[2][i]}, b[3][i]}; }
};

/// Columns of pairs of boxes: min x, y, z, then max x, y, z of each side.
struct BoxPairs {
  std::array<const double*, 6> a;
  std::array<const double*, 6> b;
  std::size_t size;

  [[nodiscard]] Box first(std::size_t i) const { return {{a[0][i], a[1][i], a[2][i]}, {a[3][i], a[4][i], a[5][i]}}; }
  [[nodiscard]] Box second(std::size_t i) const { return {{b[0][i], b[1][i], b[2][i]}, {b[3][i], b[4][i], b[5][i]}}; }
};

/// Columns of contacts: normal, point1, point2 (x, y, z each), value; and the state.
struct ContactRows {
  static constexpr std::size_t kNumbers = 10;
  std::array<double*, kNumbers> number;
  batch::PairState* state;

  [[nodiscard]] ContactRows from(std::size_t row) const {
    ContactRows rest = *this;
    for (double*& column : rest.number) column += row;
    rest.state += row;
    return rest;
  }
};

/// What all pairs of a call share.
struct SphereQuestion {
  Distances distances;
  ContactPoints points;
};

// The specification: one pair after the other.

/// Writes the contact of pair i to a row; zeros for a miss.
void contact_of_one_pair(const SpherePairs& pairs, const SphereQuestion& question, std::size_t i,
                         const ContactRows& out, std::size_t row);
/// Settles some numbers of pair i, which is a hit, in its row: those whose bits are set, as the functions of one pair
/// do.
void round_numbers(const SpherePairs& pairs, const SphereQuestion& question, std::size_t i, unsigned numbers,
                   const ContactRows& out);
batch::Count test_sphere_sphere_scalar(const SpherePairs& pairs, double alarm, std::uint8_t* hit);
batch::Count compute_sphere_sphere_scalar(const SpherePairs& pairs, const SphereQuestion& question,
                                          const ContactRows& out);
/// Writes the numbers of the hits, and of no other pair, one after the other.
batch::Count compute_sphere_sphere_hits_scalar(const SpherePairs& pairs, const SphereQuestion& question,
                                               std::uint32_t* index, const ContactRows& out);
batch::Count test_cube_cube_scalar(const BoxPairs& pairs, double alarm, std::uint8_t* hit);

// The vectors, by the best instruction set that the processor has. Domain: round to nearest, subnormals kept.

batch::Count test_sphere_sphere_vectors(const SpherePairs& pairs, double alarm, std::uint8_t* hit);
batch::Count compute_sphere_sphere_vectors(const SpherePairs& pairs, const SphereQuestion& question,
                                           const ContactRows& out);
batch::Count compute_sphere_sphere_hits_vectors(const SpherePairs& pairs, const SphereQuestion& question,
                                                std::uint32_t* index, const ContactRows& out);
batch::Count test_cube_cube_vectors(const BoxPairs& pairs, double alarm, std::uint8_t* hit);

// For tests and benchmarks.

/// The instruction sets that the kernels are compiled for and the processor has, in Highway's names, best first.
[[nodiscard]] std::vector<std::string> instruction_sets();
/// Whether the one that serves computes contacts in vectors: it takes a fused multiply-add.
[[nodiscard]] bool vectors_compute_contacts();
/// From now on that one serves, in all threads; with an empty name the best again.
void use_instruction_set(std::string_view name);

}  // namespace contact::kernel
