// What everyone ships, as fast as it goes: plain double arithmetic over structures of arrays, with the same vectors as
// the batch kernels, for comparison. Its answers are wrong near the boundary.
#pragma once

#include "contact/pairs.hpp"
#include "kernel/batch.hpp"

namespace contact::bench {

#define CONTACT_TEST(name, A, B) \
  void plain_test(const kernel::PairColumns<A, B>& pairs, double alarm, std::uint8_t* hit);
#define CONTACT_COMPUTE(name, A, B)                                                                                 \
  void plain_compute(const kernel::PairColumns<A, B>& pairs, Distances distances, const kernel::ContactRows& out);  \
  std::size_t plain_compute_hits(const kernel::PairColumns<A, B>& pairs, Distances distances, std::uint32_t* index, \
                                 const kernel::ContactRows& out);
CONTACT_BATCH_PAIRS(CONTACT_TEST)
CONTACT_BATCH_CONTACTS(CONTACT_COMPUTE)
#undef CONTACT_TEST
#undef CONTACT_COMPUTE

}  // namespace contact::bench
