// What everyone ships, as fast as it goes: plain double arithmetic over structures of arrays, with the same vectors as
// the batch kernels, for comparison. Its answers are wrong near the boundary.
#pragma once

#include <optional>

#include "kernel/batch.hpp"

namespace contact::bench {

void plain_test_sphere_sphere(const kernel::SpherePairs& pairs, double alarm, std::uint8_t* hit);
void plain_compute_sphere_sphere(const kernel::SpherePairs& pairs, Distances distances, const kernel::ContactRows& out);
std::size_t plain_compute_sphere_sphere_hits(const kernel::SpherePairs& pairs, Distances distances,
                                             std::uint32_t* index, const kernel::ContactRows& out);
void plain_test_cube_cube(const kernel::BoxPairs& pairs, double alarm, std::uint8_t* hit);

/// One pair after the other over an array of structures, as the compiler makes it.
struct PlainPair {
  Ball a;
  Ball b;
};
struct PlainContact {
  Contact contact;
  bool hit;
};
void plain_compute_scalar(const PlainPair* pairs, std::size_t size, Distances distances, PlainContact* out);
/// The function of one pair, as compute_sphere_sphere is called.
std::optional<Contact> plain_contact_of_pair(const Ball& a, const Ball& b, Distances distances);

}  // namespace contact::bench
