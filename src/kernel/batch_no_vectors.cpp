// Many pairs where there is no Highway to make vectors with: one pair after the other.
#include <stdexcept>

#include "kernel/batch.hpp"
#include "kernel/batch_cores.hpp"

namespace contact::kernel {

#define CONTACT_TEST(name, A, B)                                                               \
  batch::Count test_vectors(const PairColumns<A, B>& pairs, double alarm, std::uint8_t* hit) { \
    return test_scalar(pairs, alarm, hit);                                                     \
  }
#define CONTACT_COMPUTE(name, A, B)                                                                  \
  batch::Count compute_vectors(const PairColumns<A, B>& pairs, const ContactQuestion& question,      \
                               const ContactRows& out) {                                             \
    return compute_scalar(pairs, question, out);                                                     \
  }                                                                                                  \
  batch::Count compute_hits_vectors(const PairColumns<A, B>& pairs, const ContactQuestion& question, \
                                    std::uint32_t* index, const ContactRows& out) {                  \
    return compute_hits_scalar(pairs, question, index, out);                                         \
  }
CONTACT_BATCH_PAIRS(CONTACT_TEST)
CONTACT_BATCH_CONTACTS(CONTACT_COMPUTE)
#undef CONTACT_TEST
#undef CONTACT_COMPUTE

#define CONTACT_FIND_CORES(name, A, B) \
  bool find_cores(const PairColumns<A, B>& /*pairs*/, CoreColumns& /*to*/) { return false; }
CONTACT_CORES_APART(CONTACT_FIND_CORES)
#undef CONTACT_FIND_CORES

std::vector<std::string> instruction_sets() { return {}; }

void use_instruction_set(std::string_view name) {
  if (!name.empty()) throw std::invalid_argument("no such instruction set here: " + std::string(name));
}

}  // namespace contact::kernel
