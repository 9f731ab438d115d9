// The instruction sets that the batch kernels are compiled for: SSE4 (and the SSE2 that every x86-64 has), AVX2,
// AVX-512, NEON, and what Highway needs to stand in for vectors elsewhere. The others would add code and no speed: they
// differ in integer instructions, or have vectors whose length is not known to the compiler. Included before Highway.

#ifndef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS \
  (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV | HWY_PPC8)
#endif
