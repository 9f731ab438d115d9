// The floating-point environment that the oracles compute in, whatever their caller has set.
#pragma once

#include <cfenv>
#include <cstdint>
#include <limits>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace contact::oracle {

/// While it lives, sums are rounded to nearest, subnormal numbers kept and exceptions masked; then the caller's
/// environment is back.
///
/// Most of an oracle is integers; doubles come in where questions and claims are read and where answers are rounded.
/// Every function of the oracles' headers that touches one begins with this guard. Entering costs next to nothing where
/// nothing has to be changed.
class DefaultEnvironment {
 public:
  DefaultEnvironment() : changed_(!is_default()) {
    if (!changed_) return;
    std::fegetenv(&before_);
    std::fesetenv(FE_DFL_ENV);
  }
  DefaultEnvironment(const DefaultEnvironment&) = delete;
  DefaultEnvironment& operator=(const DefaultEnvironment&) = delete;
  ~DefaultEnvironment() {
    if (changed_) std::fesetenv(&before_);
  }

  /// The registers are read where they are known, since a sum that shows something may trap.
  static bool is_default() {
#if defined(__x86_64__) || (defined(__i386__) && defined(__SSE2__))
    constexpr unsigned kFlags = 0x3f;
    unsigned short x87 = 0;  // of long double: extended precision, to nearest, exceptions masked
    asm volatile("fnstcw %0" : "=m"(x87));
    return (_mm_getcsr() & ~kFlags) == 0x1f80 && (x87 & 0x0f3f) == 0x033f;
#elif defined(__aarch64__)
    // FIZ, AH and NEP, by which numbers are flushed, zeros signed and vectors filled otherwise; traps, mode and FZ.
    std::uint64_t control = 0;
    asm volatile("mrs %0, fpcr" : "=r"(control));
    return (control & (0x7 | 0x1f00 | 3 << 22 | 1 << 24)) == 0;
#else
    std::fenv_t before;
    std::feholdexcept(&before);
    const bool all = keeps_to_default();
    std::fesetenv(&before);
    return all;
#endif
  }

 private:
#if !defined(__x86_64__) && !(defined(__i386__) && defined(__SSE2__)) && !defined(__aarch64__)
  /// What arithmetic shows.
  [[gnu::noinline]] static bool keeps_to_default() {
    static volatile const double one = 1;
    static volatile const double hair = 0x1p-60;
    static volatile const double half = 0.5;
    static volatile const double least_normal = std::numeric_limits<double>::min();
    static volatile const double least = std::numeric_limits<double>::denorm_min();
    const double x = one;
    const double subnormal = least;
    return x + hair == x && x - hair == x && least_normal * half != 0 && subnormal != 0;
  }
#endif

  bool changed_;
  std::fenv_t before_;
};

}  // namespace contact::oracle
