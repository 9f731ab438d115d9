// Many pairs at once, as structures of arrays: the decisions and contacts of test_sphere_sphere, compute_sphere_sphere
// and their like for other pairs, bit for bit, by vector instructions chosen at run time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "contact/contact.hpp"
#include "contact/geometry.hpp"

namespace contact::inline CONTACT_ABI::batch {

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

/// n capsules, one column per coordinate (x, y, z) of start and end, and the radii. All columns have the same length.
struct CapsuleColumns {
  std::array<std::span<const double>, 3> start;
  std::array<std::span<const double>, 3> end;
  std::span<const double> radius;
};

/// n triangles, one column per vertex and coordinate (x, y, z). All columns have the same length.
struct TriangleColumns {
  std::array<std::array<std::span<const double>, 3>, 3> vertices;
};

/// n half-spaces, one column per coordinate (x, y, z) of the normals, and the offsets. All columns have the same length.
struct PlaneColumns {
  std::array<std::span<const double>, 3> normal;
  std::span<const double> offset;
};

/// n rays, one column per coordinate (x, y, z) of origin and direction, and the lengths. All columns have the same
/// length.
struct RayColumns {
  std::array<std::span<const double>, 3> origin;
  std::array<std::span<const double>, 3> direction;
  std::span<const double> length;
};

/// n segments, one column per coordinate (x, y, z) of start and end. All columns have the same length.
struct LineColumns {
  std::array<std::span<const double>, 3> start;
  std::array<std::span<const double>, 3> end;
};

/// What a pair turned out to be.
enum class PairState : std::uint8_t {
  miss = 0,        ///< farther apart than the alarm distance: no contact
  contact = 1,     ///< within it
  degenerate = 2,  ///< a contact without a direction of its own, as of balls whose centres coincide
  many = 3,        ///< a contact of which many points are nearest, as of capsules side by side
  degenerate_and_many = 4,
};
/// What Contact says of the same.
[[nodiscard]] constexpr bool is_degenerate(PairState state) {
  return state == PairState::degenerate || state == PairState::degenerate_and_many;
}
[[nodiscard]] constexpr bool is_unique(PairState state) { return state < PairState::many; }
[[nodiscard]] constexpr PairState state_of(const Contact& contact) {
  if (contact.unique) return contact.degenerate ? PairState::degenerate : PairState::contact;
  return contact.degenerate ? PairState::degenerate_and_many : PairState::many;
}

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

  Count& operator+=(const Count& more) {
    hits += more.hits;
    exact += more.exact;
    return *this;
  }
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

/// The pairs that have these functions, X(name, first shape, second shape): those whose contacts have numbers, and all.
#define CONTACT_BATCH_CONTACTS(X)      \
  X(sphere_sphere, Ball, Ball)         \
  X(sphere_cube, Ball, Box)            \
  X(sphere_capsule, Ball, Capsule)     \
  X(capsule_capsule, Capsule, Capsule) \
  X(sphere_triangle, Ball, Triangle)   \
  X(ray_sphere, Ray, Ball)             \
  X(sphere_plane, Ball, Plane)         \
  X(capsule_plane, Capsule, Plane)     \
  X(ray_triangle, Ray, Triangle)       \
  X(triangle_line, Triangle, Line)
#define CONTACT_BATCH_PAIRS(X) \
  CONTACT_BATCH_CONTACTS(X)    \
  X(cube_cube, Box, Box)

// test_sphere_sphere, test_sphere_cube, test_cube_cube and so on: hit[i] = 1 where the shapes are within the alarm
// distance, else 0, as the function of that name for one pair decides.
#define CONTACT_TEST(name, A, B) \
  Count test_##name(const A##Columns& a, const B##Columns& b, double alarm, std::span<std::uint8_t> hit);
CONTACT_BATCH_PAIRS(CONTACT_TEST)
#undef CONTACT_TEST

// compute_sphere_sphere, compute_sphere_cube and so on: row i is the contact of pair i, as the function of that name
// for one pair gives it; every number of a miss is +0.
//
// compute_sphere_sphere_hits, compute_sphere_cube_hits and so on: the hits alone, in the order of the pairs. Row k of
// `out` is the contact of pair index[k], for every k below Count::hits. The contents of the rows after these are not
// specified.
// Domain      fewer than 2^32 pairs; `index` is as long as the columns.
#define CONTACT_COMPUTE(name, A, B)                                                                              \
  Count compute_##name(const A##Columns& a, const B##Columns& b, Distances distances, const ContactColumns& out, \
                       ContactPoints points = {});                                                               \
  Count compute_##name##_hits(const A##Columns& a, const B##Columns& b, Distances distances,                     \
                              std::span<std::uint32_t> index, const ContactColumns& out, ContactPoints points = {});
CONTACT_BATCH_CONTACTS(CONTACT_COMPUTE)
#undef CONTACT_COMPUTE

}  // namespace contact::inline CONTACT_ABI::batch
