// The vector kernels' source on short numbers, for one target: hwy/highway.h, found before Highway's own, says which.
#include "dev/short_numbers/batch_columns.hpp"
#include "kernel/batch_sphere_sphere.cpp"

namespace contact::kernel::HWY_NAMESPACE {

/// Asks for contacts and, beside them, for decisions: both must say the same.
void answer(const std::vector<tiny::Question>& questions, std::vector<tiny::Answer>& answers) {
  tiny::answer_columns(questions, answers, compute_spheres, test_spheres);
}

const tiny::Places& places() { return hwy::HWY_NAMESPACE::places; }

}  // namespace contact::kernel::HWY_NAMESPACE
