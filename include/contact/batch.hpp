// Many pairs at once, as structures of arrays: the decisions and contacts of test_sphere_sphere, compute_sphere_sphere
// and test_cube_cube, bit for bit, by vector instructions chosen at run time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "contact/contact.hpp"
#include "contact/geometry.hpp"

namespace contact::batch {

/// n balls, one column per number: ball i has the centre (x[i], y[i], z[i]). All columns have the same length.
struct BallColumns {
  std::span<const double> x;
  std::span<const double> y;
  std::span<const double> z;
  std::span<const double> radius;
};

/// n boxes, one column per bound and axis (x, y, z). All columns have the same length.
struct BoxColumns {
  std::array<std::span<const double>, 3> min;
  std::array<std::span<const double>, 3> max;
};

/// What a pair turned out to be.
enum class PairState : std::uint8_t {
  miss = 0,        ///< farther apart than the alarm distance: no contact
  contact = 1,     ///< within it
  degenerate = 2,  ///< a contact of balls whose centres coincide: the normal is (1,0,0) by agreement
};

/// Room for contacts, one column per number and axis (x, y, z). Each column has one place per pair.
struct ContactColumns {
  std::array<std::span<double>, 3> normal;
  std::array<std::span<double>, 3> point1;
  std::array<std::span<double>, 3> point2;
  std::span<double> value;
  std::span<PairState> state;
};

/// How a call went.
struct Count {
  std::size_t hits = 0;   ///< pairs within the alarm distance
  std::size_t exact = 0;  ///< pairs that the vectors left to the scalar function, and so perhaps to exact arithmetic
};

// The following holds for all functions below. Pair i is the i-th shape of `a` with the i-th shape of `b`.
//
// Units       one length unit throughout.
// Domain      as for the function of one pair: finite; radii, alarm and contact distance >= 0; min <= max. Subnormals
//             and the largest finite numbers are included. The functions do not check this; outside_domain
//             (contact/domain.hpp) does. Outputs overlap neither each other nor the inputs.
// Error       std::invalid_argument, which names the column, if a column is not as long as the first one of `a`. The
//             function has written nothing then.
// Result      the bits that the function of one pair gives, for every vector width and with every instruction set.
// Environment any rounding mode, flush-to-zero and denormals-are-zero, exceptions unmasked: the answer is the same.
//             Afterwards the caller's environment and exception flags are as they were before the call.
// Threads     no shared state: calls on disjoint outputs may run at once.
// Source      docs/error-bounds.md.
// Evidence    src/kernel/batch_test.cpp compares every available instruction set with the functions of one pair.

/// hit[i] = 1 where the balls are within the alarm distance, else 0, as contact::test_sphere_sphere decides.
Count test_sphere_sphere(const BallColumns& a, const BallColumns& b, double alarm, std::span<std::uint8_t> hit);

/// hit[i] = 1 where the boxes are within the alarm distance on every axis, else 0, as contact::test_cube_cube decides.
Count test_cube_cube(const BoxColumns& a, const BoxColumns& b, double alarm, std::span<std::uint8_t> hit);

/// Row i is the contact of pair i, as contact::compute_sphere_sphere gives it; every number of a miss is +0.
Count compute_sphere_sphere(const BallColumns& a, const BallColumns& b, Distances distances, const ContactColumns& out,
                            ContactPoints points = {});

/// Writes the hits alone, in the order of the pairs. Row k of `out` is the contact of pair index[k], for every k below
/// Count::hits. The contents of the rows after these are not specified.
/// Domain      fewer than 2^32 pairs; `index` is as long as the columns.
Count compute_sphere_sphere_hits(const BallColumns& a, const BallColumns& b, Distances distances,
                                 std::span<std::uint32_t> index, const ContactColumns& out, ContactPoints points = {});

}  // namespace contact::batch
