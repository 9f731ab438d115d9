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
#include "contact/shapes.hpp"

namespace contact::kernel {

/// Columns of pairs of shapes: on each side one for every number of its shape, in order.
template <class A, class B>
struct PairColumns {
  std::array<const double*, kNumbersOf<A>> a;
  std::array<const double*, kNumbersOf<B>> b;
  std::size_t size;

  [[nodiscard]] A first(std::size_t i) const { return shape<A>(a, i); }
  [[nodiscard]] B second(std::size_t i) const { return shape<B>(b, i); }
  /// `count` pairs, beginning with one.
  [[nodiscard]] PairColumns from(std::size_t begin, std::size_t count) const {
    PairColumns some{a, b, count};
    for (const double*& column : some.a) column += begin;
    for (const double*& column : some.b) column += begin;
    return some;
  }

 private:
  template <class Shape>
  static Shape shape(const std::array<const double*, kNumbersOf<Shape>>& columns, std::size_t i) {
    Shape made;
    const double* const* column = columns.data();
    for_each_number(made, [&](double& number) { number = (*column++)[i]; });
    return made;
  }
};
using SpherePairs = PairColumns<Ball, Ball>;
using BoxPairs = PairColumns<Box, Box>;
using SphereCubePairs = PairColumns<Ball, Box>;

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
struct ContactQuestion {
  Distances distances;
  ContactPoints points;
};

/// Settles some numbers of pair i, which is a hit, in its row: those whose bits are set, as the functions of one pair
/// do.
void round_numbers(const SpherePairs& pairs, const ContactQuestion& question, std::size_t i, unsigned numbers,
                   const ContactRows& out);

// The specification: one pair after the other, by the functions of one pair.

/// Writes the contact of pair i to a row; zeros for a miss.
template <class A, class B>
void contact_of_one_pair(const PairColumns<A, B>& pairs, const ContactQuestion& question, std::size_t i,
                         const ContactRows& out, std::size_t row);
template <class A, class B>
batch::Count test_scalar(const PairColumns<A, B>& pairs, double alarm, std::uint8_t* hit);
template <class A, class B>
batch::Count compute_scalar(const PairColumns<A, B>& pairs, const ContactQuestion& question, const ContactRows& out);
/// Writes the numbers of the hits, and of no other pair, one after the other.
template <class A, class B>
batch::Count compute_hits_scalar(const PairColumns<A, B>& pairs, const ContactQuestion& question, std::uint32_t* index,
                                 const ContactRows& out);

// The vectors, by the best instruction set that the processor has. Domain: round to nearest, subnormals kept.

#define CONTACT_TEST(name, A, B) \
  batch::Count test_vectors(const PairColumns<A, B>& pairs, double alarm, std::uint8_t* hit);
#define CONTACT_COMPUTE(name, A, B)                                                                  \
  batch::Count compute_vectors(const PairColumns<A, B>& pairs, const ContactQuestion& question,      \
                               const ContactRows& out);                                              \
  batch::Count compute_hits_vectors(const PairColumns<A, B>& pairs, const ContactQuestion& question, \
                                    std::uint32_t* index, const ContactRows& out);
CONTACT_BATCH_PAIRS(CONTACT_TEST)
CONTACT_BATCH_CONTACTS(CONTACT_COMPUTE)
#undef CONTACT_TEST
#undef CONTACT_COMPUTE

// For tests and benchmarks.

/// The instruction sets that the kernels are compiled for and the processor has, in Highway's names, best first.
[[nodiscard]] std::vector<std::string> instruction_sets();
/// Whether the one that serves computes contacts in vectors: it takes a fused multiply-add.
[[nodiscard]] bool vectors_compute_contacts();
/// From now on that one serves, in all threads; with an empty name the best again.
void use_instruction_set(std::string_view name);

}  // namespace contact::kernel
