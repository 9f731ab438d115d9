// The targets that batch.cpp is compiled for.
#include "dev/short_numbers/kernels.hpp"

#define CONTACT_TINY_TARGETS(do_this)                                                                            \
  do_this("batch, by division", 12, true, tiny_12) do_this("batch, by an estimate", 12, false, tiny_12_estimate) \
      do_this("batch, by division", 16, false, tiny_16) do_this("batch, by an estimate", 16, true, tiny_16_estimate)

namespace contact::kernel {

#define CONTACT_DECLARE(name, bits, quick, target)                                               \
  namespace target {                                                                             \
  void answer(const std::vector<tiny::Question>& questions, std::vector<tiny::Answer>& answers); \
  const tiny::Places& places();                                                                  \
  }
CONTACT_TINY_TARGETS(CONTACT_DECLARE)

std::vector<tiny::NamedKernel> tiny::batch_kernels() {
  std::vector<NamedKernel> all;
#define CONTACT_ADD(name, bits, quick, target) \
  all.push_back({name, bits, kernel::target::answer, quick, true, &kernel::target::places()});
  CONTACT_TINY_TARGETS(CONTACT_ADD)
  return all;
}

}  // namespace contact::kernel
