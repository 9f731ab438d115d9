// The floating-point environments that a caller may have set: what no answer may depend on.
#pragma once

#include <cfenv>
#include <string>
#include <vector>

#if defined(__SSE2__) || defined(_M_X64)
#include <immintrin.h>
#endif

namespace contact {

struct FloatingPointEnvironment {
  std::string name;
  int rounding;
  bool flush;          ///< flush-to-zero and denormals-are-zero
  bool traps = false;  ///< every exception unmasked: one that is raised ends the program
};

/// Without those that trap for a test of steps that a guard shields from them.
inline std::vector<FloatingPointEnvironment> floating_point_environments(bool trapping = true) {
  std::vector<FloatingPointEnvironment> all;
  for (const bool flush : {false, true}) {
#if !defined(__SSE2__) && !defined(_M_X64)
    if (flush) continue;
#endif
    const std::string suffix = flush ? ", flushing subnormals" : "";
    all.push_back({"to nearest" + suffix, FE_TONEAREST, flush});
    all.push_back({"upward" + suffix, FE_UPWARD, flush});
    all.push_back({"downward" + suffix, FE_DOWNWARD, flush});
    all.push_back({"toward zero" + suffix, FE_TOWARDZERO, flush});
    if (!trapping) continue;
#if defined(__SSE2__) || defined(_M_X64)
    all.push_back({"to nearest" + suffix + ", trapping", FE_TONEAREST, flush, true});
    all.push_back({"upward" + suffix + ", trapping", FE_UPWARD, flush, true});
#endif
  }
  return all;
}

/// Calls `work` in an environment and restores the one before. Compare numbers outside: == itself obeys the flags.
template <class Work>
void in_environment(const FloatingPointEnvironment& environment, Work&& work) {
  std::fenv_t before;
  std::fegetenv(&before);
  std::fesetround(environment.rounding);
#if defined(__SSE2__) || defined(_M_X64)
  constexpr unsigned kFlushToZeroAndDenormalsAreZero = 0x8040;
  constexpr unsigned kMasks = 0x1f80;
  constexpr unsigned kFlags = 0x3f;
  if (environment.flush) _mm_setcsr(_mm_getcsr() | kFlushToZeroAndDenormalsAreZero);
#if defined(__GLIBC__)
  if (environment.traps) {  // the x87's too, of which an old one that is unmasked traps at the next wait
    std::feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(FE_ALL_EXCEPT);
  }
#endif
  if (environment.traps) _mm_setcsr(_mm_getcsr() & ~(kMasks | kFlags));  // that of subnormal operands too
#endif
  work();
  std::fesetenv(&before);
}

}  // namespace contact
