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
/// On x86 the register MXCSR holds all of it, exception flags included, which are restored too. Reading it waits
/// for what is computed before, on AMD's processors some 20 ns; it is written only where it differs. What is computed under the guard must not be inlined beside it:
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
#elif defined(__aarch64__)
  // Both registers by hand: fesetenv leaves out what it calls reserved, FZ16 among it.
  RoundToNearest() {
    asm volatile("mrs %0, fpcr" : "=r"(control_));
    asm volatile("mrs %0, fpsr" : "=r"(flags_));
    if ((control_ & kModes) != 0) asm volatile("msr fpcr, %0" : : "r"(control_ & ~kModes) : "memory");
  }
  ~RoundToNearest() {
    if ((control_ & kModes) != 0) asm volatile("msr fpcr, %0" : : "r"(control_) : "memory");
    asm volatile("msr fpsr, %0" : : "r"(flags_) : "memory");
  }

 private:
  // FIZ, AH and NEP, by which numbers are flushed, zeros signed and vectors filled otherwise; the traps IOE to IXE and
  // IDE; FZ16, the rounding mode, FZ and DN. A processor without one of them reads 0 there.
  static constexpr std::uint64_t kModes = 0x7 | 0x9f00 | 1 << 19 | 3 << 22 | 1 << 24 | 1 << 25;
  std::uint64_t control_ = 0;
  std::uint64_t flags_ = 0;
#else
  RoundToNearest() {
    std::feholdexcept(&before_);
    std::fesetround(FE_TONEAREST);
#if defined(__arm__) && defined(__ARM_FP)
    std::uint32_t control = 0;
    asm volatile("vmrs %0, fpscr" : "=r"(control));
    constexpr std::uint32_t kFlush = 1U << 24;
    if ((control & kFlush) != 0) asm volatile("vmsr fpscr, %0" : : "r"(control & ~kFlush) : "memory");
#endif
  }
  ~RoundToNearest() { std::fesetenv(&before_); }

 private:
  std::fenv_t before_;
#endif
};

}  // namespace contact::kernel
