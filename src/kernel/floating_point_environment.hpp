// The floating-point environment that the kernels compute in, whatever their caller has set.
#pragma once

#include <cfenv>
#include <cstdint>

#if defined(__SSE2__) || defined(_M_X64)
#include <immintrin.h>
#define CONTACT_HAS_MXCSR 1
#else
#define CONTACT_HAS_MXCSR 0
#endif

namespace contact::kernel {

/// Rounds to nearest, keeps subnormals and masks exceptions while it lives; then the caller's environment is back.
///
/// On x86 the register MXCSR holds all of it, exception flags included, which are restored too. Reading it costs next
/// to nothing; it is written only where it differs. What is computed under the guard must not be inlined beside it:
/// compilers know nothing of the register.
class RoundToNearest {
 public:
  RoundToNearest(const RoundToNearest&) = delete;
  RoundToNearest& operator=(const RoundToNearest&) = delete;

#if CONTACT_HAS_MXCSR
  RoundToNearest() : before_(_mm_getcsr()) {
    if ((before_ & ~kFlags) != kDefault) _mm_setcsr(kDefault);
  }
  ~RoundToNearest() {
    if (_mm_getcsr() != before_) _mm_setcsr(before_);
  }

 private:
  static constexpr unsigned kFlags = 0x3f;
  static constexpr unsigned kDefault = 0x1f80;  // exceptions masked; to nearest; neither FTZ nor DAZ
  unsigned before_;
#else
  RoundToNearest() {
    std::feholdexcept(&before_);
#if defined(__aarch64__)
    std::uint64_t control = 0;
    asm volatile("mrs %0, fpcr" : "=r"(control));
    constexpr std::uint64_t kModes = (std::uint64_t{3} << 22) | (std::uint64_t{1} << 24) | (std::uint64_t{1} << 19);
    if ((control & kModes) != 0) asm volatile("msr fpcr, %0" : : "r"(control & ~kModes));
#else
    std::fesetround(FE_TONEAREST);
#endif
  }
  ~RoundToNearest() { std::fesetenv(&before_); }

 private:
  std::fenv_t before_;
#endif
};

}  // namespace contact::kernel
