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
  bool flush;  ///< flush-to-zero and denormals-are-zero
};

inline std::vector<FloatingPointEnvironment> floating_point_environments() {
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
  if (environment.flush) _mm_setcsr(_mm_getcsr() | kFlushToZeroAndDenormalsAreZero);
#endif
  work();
  std::fesetenv(&before);
}

}  // namespace contact
