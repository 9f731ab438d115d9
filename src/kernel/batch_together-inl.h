// Some lanes of vectors one after the other in columns.
#if defined(CONTACT_KERNEL_BATCH_TOGETHER_INL_H) == defined(HWY_TARGET_TOGGLE)  // once a target
#ifdef CONTACT_KERNEL_BATCH_TOGETHER_INL_H
#undef CONTACT_KERNEL_BATCH_TOGETHER_INL_H
#else
#define CONTACT_KERNEL_BATCH_TOGETHER_INL_H
#endif

#include <hwy/highway.h>

#include <bit>
#include <cstddef>
#include <cstdint>

#include "kernel/batch_columns-inl.h"

#if HWY_HAVE_FLOAT64  // else nothing is here, and no attribute for it
HWY_BEFORE_NAMESPACE();
namespace contact::kernel {
namespace HWY_NAMESPACE {

#define CONTACT_LANES_OF_AVX3 (HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX3)
#define CONTACT_LANES_OF_AVX2 (HWY_ARCH_X86 && !CONTACT_LANES_OF_AVX3 && HWY_TARGET <= HWY_AVX2)

#if CONTACT_LANES_OF_AVX2
/// The halves of doubles that bring every set of four lanes together.
struct SetsOfLanes {
  alignas(32) std::uint32_t together[16][8];
};
constexpr SetsOfLanes sets_of_lanes() {
  SetsOfLanes sets{};
  for (unsigned bits = 0; bits < 16; ++bits) {
    unsigned k = 0;
    for (unsigned lane = 0; lane < 4; ++lane) {
      if ((bits >> lane & 1) == 0) continue;
      for (unsigned half = 0; half < 2; ++half) sets.together[bits][2 * k + half] = 2 * lane + half;
      ++k;
    }
  }
  return sets;
}
constexpr SetsOfLanes kSetsOfLanes = sets_of_lanes();

HWY_INLINE V moved(V x, const std::uint32_t (&halves)[8]) {
  const __m256i at = _mm256_load_si256(reinterpret_cast<const __m256i*>(halves));
  return V{_mm256_castsi256_pd(_mm256_permutevar8x32_epi32(_mm256_castpd_si256(x.raw), at))};
}
#endif

/// The lanes whose bits are set, one after the other.
class Together {
 public:
  HWY_INLINE explicit Together(unsigned bits)
#if CONTACT_LANES_OF_AVX3
      // One instruction for each column: those that bring numbers together themselves are two, and more from memory.
      : from_(_mm512_maskz_compress_epi64(static_cast<__mmask8>(bits), _mm512_set_epi64(7, 6, 5, 4, 3, 2, 1, 0))){}
#else
      : bits_(bits) {
  }
#endif

        /// Those of x; what follows them in a vector's place is not specified.
        HWY_INLINE void store(V x, double* to) const {
#if CONTACT_LANES_OF_AVX3
    hn::StoreU(V{_mm512_permutexvar_pd(from_, x.raw)}, D(), to);
#elif CONTACT_LANES_OF_AVX2
    hn::StoreU(moved(x, kSetsOfLanes.together[bits_]), D(), to);
#else
    HWY_ALIGN double lanes[kMostLanes];
    hn::StoreU(x, D(), lanes);
    std::size_t k = 0;
    for (std::size_t lane = 0; lane < hn::Lanes(D()); ++lane) {  // no branch: they come in no order
      to[k] = lanes[lane];
      k += bits_ >> lane & 1;
    }
#endif
  }

 private:
#if CONTACT_LANES_OF_AVX3
  __m512i from_;
#else
  unsigned bits_;
#endif
};

}  // namespace HWY_NAMESPACE
}  // namespace contact::kernel
HWY_AFTER_NAMESPACE();
#endif  // HWY_HAVE_FLOAT64

#endif  // once a target
