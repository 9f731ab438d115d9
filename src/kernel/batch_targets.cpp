// Which instruction sets the batch kernels can use here, for tests and benchmarks.
#include "kernel/batch_targets.hpp"

#include <hwy/highway.h>

#include <stdexcept>

#include "kernel/batch.hpp"

namespace contact::kernel {

std::vector<std::string> instruction_sets() {
  hwy::SetSupportedTargetsForTest(0);
  std::vector<std::string> names;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) names.emplace_back(hwy::TargetName(target));
  return names;
}

void use_instruction_set(std::string_view name) {
  hwy::SetSupportedTargetsForTest(0);
  if (!name.empty()) {
    std::int64_t found = 0;
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
      if (hwy::TargetName(target) == name) found = target;
    if (found == 0) throw std::invalid_argument("no such instruction set here: " + std::string(name));
    hwy::SetSupportedTargetsForTest(found);
  }
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace contact::kernel
