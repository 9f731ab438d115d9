// Many pairs where there is no Highway to make vectors with: one pair after the other.
#include <stdexcept>

#include "kernel/batch.hpp"

namespace contact::kernel {

batch::Count test_sphere_sphere_vectors(const SpherePairs& pairs, double alarm, std::uint8_t* hit) {
  return test_sphere_sphere_scalar(pairs, alarm, hit);
}

batch::Count compute_sphere_sphere_vectors(const SpherePairs& pairs, const SphereQuestion& question,
                                           const ContactRows& out) {
  return compute_sphere_sphere_scalar(pairs, question, out);
}

batch::Count compute_sphere_sphere_hits_vectors(const SpherePairs& pairs, const SphereQuestion& question,
                                                std::uint32_t* index, const ContactRows& out) {
  return compute_sphere_sphere_hits_scalar(pairs, question, index, out);
}

batch::Count test_cube_cube_vectors(const BoxPairs& pairs, double alarm, std::uint8_t* hit) {
  return test_cube_cube_scalar(pairs, alarm, hit);
}

std::vector<std::string> instruction_sets() { return {}; }

void use_instruction_set(std::string_view name) {
  if (!name.empty()) throw std::invalid_argument("no such instruction set here: " + std::string(name));
}

}  // namespace contact::kernel
