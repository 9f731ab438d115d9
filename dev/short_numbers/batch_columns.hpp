// Questions as columns for the vector kernels, and what these leave to the functions of one pair.
#pragma once

#include <cstdint>
#include <vector>

#include "dev/short_numbers/harness.hpp"
#include "kernel/batch.hpp"

namespace contact::kernel::tiny {

using ComputeSpheres = batch::Count (*)(const SpherePairs&, const ContactQuestion&, const ContactRows&);
using TestSpheres = batch::Count (*)(const SpherePairs&, double, std::uint8_t*);

void answer_columns(const std::vector<Question>& questions, std::vector<Answer>& answers, ComputeSpheres compute,
                    TestSpheres test);

}  // namespace contact::kernel::tiny
