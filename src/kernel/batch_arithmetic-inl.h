// The arithmetic of vectors of pairs: the filter, sphere_sphere_formula-inl.h on these lanes, and scales.
#if defined(CONTACT_KERNEL_BATCH_ARITHMETIC_INL_H) == defined(HWY_TARGET_TOGGLE)  // once a target
#ifdef CONTACT_KERNEL_BATCH_ARITHMETIC_INL_H
#undef CONTACT_KERNEL_BATCH_ARITHMETIC_INL_H
#else
#define CONTACT_KERNEL_BATCH_ARITHMETIC_INL_H
#endif

#include <hwy/highway.h>

#include <cstdint>

#include "kernel/batch_bounds.hpp"
#include "kernel/batch_columns-inl.h"

#if HWY_HAVE_FLOAT64  // else nothing is here, and no attribute for it
HWY_BEFORE_NAMESPACE();
namespace contact::kernel {
namespace HWY_NAMESPACE {

using bounds = FastBounds<hn::TFromD<D>>;

/// Whether D and reach^2 differ by more than plain arithmetic may err. (Two masks in one struct would travel through
/// general registers.)
HWY_INLINE void filter(V d2, V reach, M& hit, M& miss) {
  const V sum = hn::MulAdd(reach, reach, d2);
  const V difference = hn::NegMulAdd(reach, reach, d2);
  const V gap = hn::MulAdd(sum, all(bounds::kFilterGap), all(bounds::kFilterFloor));
  hit = hn::Lt(difference, hn::Neg(gap));
  miss = hn::Gt(difference, gap);
}

HWY_INLINE V squared_length(V x, V y, V z) { return hn::MulAdd(z, z, hn::MulAdd(y, y, hn::Mul(x, x))); }

#define CONTACT_LANES HWY_INLINE
#include "kernel/double_double-inl.h"
#include "kernel/sum_of_two-inl.h"
#undef CONTACT_LANES
using Double2 = DoubleDouble<V>;

#if HWY_NATIVE_FMA

/// 1 / sqrt(x) within 2 u.
HWY_INLINE V reciprocal_root(V x) {
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX3
  // From 14 bits by the series (1 - h)^(-1/2) = 1 + h/2 + 3h^2/8 + 5h^3/16 + 35h^4/128 + ...
  const V y{_mm512_rsqrt14_pd(x.raw)};
  const V h = hn::NegMulAdd(hn::Mul(x, y), y, all(1));
  const V series = hn::MulAdd(hn::MulAdd(hn::MulAdd(h, all(35.0 / 128), all(5.0 / 16)), h, all(0.375)), h, all(0.5));
  return hn::MulAdd(hn::Mul(y, h), series, y);
#else
  return hn::Div(all(1), hn::Sqrt(x));
#endif
}

/// mask && a == b, lane by lane.
HWY_INLINE M and_equal(M mask, V a, V b) {
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX3
  return M{_mm512_mask_cmp_pd_mask(mask.raw, a.raw, b.raw, _CMP_EQ_OQ)};  // one instruction
#else
  return hn::And(mask, hn::Eq(a, b));
#endif
}

/// mask && a >= b, lane by lane.
HWY_INLINE M and_at_least(M mask, V a, V b) {
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX3
  return M{_mm512_mask_cmp_pd_mask(mask.raw, a.raw, b.raw, _CMP_GE_OQ)};
#else
  return hn::And(mask, hn::Ge(a, b));
#endif
}

/// a b + c where the mask says so, else 0.
HWY_INLINE V masked_multiply_add(M mask, V a, V b, V c) {
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX3
  return V{_mm512_maskz_fmadd_pd(mask.raw, a.raw, b.raw, c.raw)};
#else
  return hn::IfThenElseZero(mask, hn::MulAdd(a, b, c));
#endif
}

/// The lesser of |a| and |b|.
HWY_INLINE V least_magnitude(V a, V b) {
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX3
  return V{_mm512_range_pd(a.raw, b.raw, 0x8 | 0x2)};  // the one of least magnitude, with its sign cleared
#else
  return hn::Min(hn::Abs(a), hn::Abs(b));
#endif
}

/// The lesser of a, which is not negative, and |b|.
HWY_INLINE V lesser_magnitude(V a, V b) {
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX3
  return least_magnitude(a, b);
#else
  return hn::Min(a, hn::Abs(b));
#endif
}

using Number = V;
using Mask = M;
/// x, y and z of pairs.
struct Axes {
  V x, y, z;

  HWY_INLINE Axes() {}
  HWY_INLINE Axes(V on_x, V on_y, V on_z) : x(on_x), y(on_y), z(on_z) {}
};
/// d, never as Axes of high and low parts: such copies would be kept in memory, and cost AVX2 a tenth.
struct Delta {
  Double2 x;
  Double2 y;
  Double2 z;

  HWY_INLINE Delta() {}
  HWY_INLINE Delta(Double2 on_x, Double2 on_y, Double2 on_z) : x(on_x), y(on_y), z(on_z) {}
};

HWY_INLINE V x_of(const Axes& a) { return a.x; }
HWY_INLINE V y_of(const Axes& a) { return a.y; }
HWY_INLINE V z_of(const Axes& a) { return a.z; }
HWY_INLINE Axes product(const Delta& d, V k) {
  return {hn::Mul(d.x.high, k), hn::Mul(d.y.high, k), hn::Mul(d.z.high, k)};
}
HWY_INLINE Axes product_rest(const Delta& d, V k, const Axes& q) {
  return {hn::MulAdd(d.x.low, k, hn::MulSub(d.x.high, k, q.x)), hn::MulAdd(d.y.low, k, hn::MulSub(d.y.high, k, q.y)),
          hn::MulAdd(d.z.low, k, hn::MulSub(d.z.high, k, q.z))};
}
HWY_INLINE Axes times_plus(const Axes& a, V k, const Axes& c) {
  return {hn::MulAdd(a.x, k, c.x), hn::MulAdd(a.y, k, c.y), hn::MulAdd(a.z, k, c.z)};
}

#define CONTACT_LANES HWY_INLINE
#include "kernel/sphere_sphere_formula-inl.h"
#undef CONTACT_LANES

/// The power of two that is at most |x|, or 0 for a subnormal x.
HWY_INLINE V power_of_two(V x) {
  const hn::RebindToUnsigned<D> words;
  return hn::BitCast(D(), hn::And(hn::BitCast(words, x), hn::Set(words, std::uint64_t{0x7ff} << 52)));
}

/// 1 / p for a power of two p in [2^-1022, 2^1022], and 2^1023 for 0.
HWY_INLINE V reciprocal_of_power(V p) {
  const hn::RebindToUnsigned<D> words;
  return hn::BitCast(D(), hn::Sub(hn::Set(words, std::uint64_t{2046} << 52), hn::BitCast(words, p)));
}

/// A power of two by which delta is multiplied where its square would leave the range, and its reciprocal; all 1 else.
struct Scale {
  V down;  ///< multiplies delta and lengths
  V up;    ///< multiplies a length back
};

HWY_INLINE V largest_component(const Delta& d) {
  return hn::Max(hn::Max(hn::Abs(d.x.high), hn::Abs(d.y.high)), hn::Abs(d.z.high));
}

HWY_INLINE Scale scale_of(const Delta& d) {
  const V power = power_of_two(largest_component(d));
  return {reciprocal_of_power(power), power};
}

HWY_INLINE Double2 scaled(Double2 x, V by) { return {hn::Mul(x.high, by), hn::Mul(x.low, by)}; }
HWY_INLINE Delta scaled(const Delta& d, V by) { return {scaled(d.x, by), scaled(d.y, by), scaled(d.z, by)}; }

/// high + low rounded, and whether an error could change it.
HWY_INLINE V rounded_within(V high, V low, V error, M& certain) {
  const V above = hn::Add(high, hn::Add(low, error));
  certain = hn::Eq(above, hn::Add(high, hn::Sub(low, error)));
  return above;
}

#endif  // HWY_NATIVE_FMA

}  // namespace HWY_NAMESPACE
}  // namespace contact::kernel
HWY_AFTER_NAMESPACE();
#endif  // HWY_HAVE_FLOAT64

#endif  // once a target
