// A stand-in for Highway: vectors of one lane, whose number is Tiny. The vector kernels' source is compiled against it
// as it is. Every mask that is made or used is counted by its place in the source.
//
// CONTACT_TINY_BITS      the bits of a significand
// CONTACT_TINY_ESTIMATE  1: as AVX-512, with a processor's estimate of the reciprocal root; 0: as everything else
// CONTACT_TINY_TARGET    the namespace that takes the place of an instruction set's
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "dev/short_numbers/places.hpp"
#include "dev/short_numbers/tiny.hpp"

#define HWY_NAMESPACE CONTACT_TINY_TARGET
#define HWY_BEFORE_NAMESPACE() static_assert(true)
#define HWY_AFTER_NAMESPACE() static_assert(true)
#define HWY_ONCE 0
#define HWY_INLINE inline
#define HWY_NOINLINE inline
#define HWY_ATTR
#define HWY_ALIGN
#define HWY_LIKELY(x) (x)
#define HWY_MAX_BYTES 8
#define HWY_HAVE_FLOAT64 1
#define HWY_NATIVE_FMA 1
#define HWY_ARCH_X86 CONTACT_TINY_ESTIMATE
#define HWY_TARGET 0
#define HWY_AVX3 0

namespace hwy::HWY_NAMESPACE {

using contact::kernel::tiny::Place;
using Number = contact::kernel::tiny::Tiny<CONTACT_TINY_BITS>;

inline contact::kernel::tiny::Places places;

template <class T>
struct Lane {
  T raw;
};
template <class T>
struct Tag {
  using Memory = T;
  using T_ = T;
};
template <>
struct Tag<double> {
  using Memory = double;
  using T_ = Number;
};

template <class T>
using ScalableTag = Tag<T>;
template <class T, class D>
using Rebind = Tag<T>;
template <class D>
using RebindToUnsigned = Tag<std::uint64_t>;
template <class D>
using TFromD = typename D::T_;
template <class D>
using Vec = Lane<TFromD<D>>;
template <class D>
using Mask = Lane<bool>;

using V = Lane<Number>;
using Words = Lane<std::uint64_t>;
using M = Lane<bool>;

inline M counted(bool is, Place place) {
  places.count(place, is);
  return {is};
}

template <class D>
std::size_t Lanes(D /*tag*/) {
  return 1;
}
/// A number that Tiny holds: constants are not rounded.
inline V Set(Tag<double> /*tag*/, double x) {
  if (!Number::holds(x)) places.refuse(x);
  return {x};
}
inline Words Set(Tag<std::uint64_t> /*tag*/, std::uint64_t x) { return {x}; }
inline V LoadU(Tag<double> tag, const double* from) { return Set(tag, *from); }
template <class T>
void StoreU(Lane<T> x, Tag<T> /*tag*/, T* to) {
  *to = x.raw;
}
inline void StoreU(V x, Tag<double> /*tag*/, double* to) { *to = static_cast<double>(x.raw); }
inline void StoreMaskBits(Tag<double> /*tag*/, M mask, std::uint8_t* to) { *to = mask.raw; }
inline Lane<std::uint8_t> TruncateTo(Tag<std::uint8_t> /*tag*/, Words x) { return {static_cast<std::uint8_t>(x.raw)}; }
inline Words BitCast(Tag<std::uint64_t> /*tag*/, V x) {
  return {std::bit_cast<std::uint64_t>(static_cast<double>(x.raw))};
}
inline V BitCast(Tag<double> tag, Words x) { return Set(tag, std::bit_cast<double>(x.raw)); }
template <class D>
M RebindMask(D /*tag*/, M mask) {
  return mask;
}

inline V Add(V a, V b) { return {a.raw + b.raw}; }
inline V Sub(V a, V b) { return {a.raw - b.raw}; }
inline V Mul(V a, V b) { return {a.raw * b.raw}; }
inline V Div(V a, V b) { return {a.raw / b.raw}; }
inline V Sqrt(V a) { return {sqrt(a.raw)}; }
inline V Neg(V a) { return {-a.raw}; }
inline V Abs(V a) { return {abs(a.raw)}; }
inline V MulAdd(V a, V b, V c) { return {fma(a.raw, b.raw, c.raw)}; }
inline V MulSub(V a, V b, V c) { return {fma(a.raw, b.raw, -c.raw)}; }
inline V NegMulAdd(V a, V b, V c) { return {fma(-a.raw, b.raw, c.raw)}; }
inline V NegMulSub(V a, V b, V c) { return {fma(-a.raw, b.raw, -c.raw)}; }
inline V Min(V a, V b) { return b.raw < a.raw ? b : a; }
inline V Max(V a, V b) { return b.raw > a.raw ? b : a; }

inline Words Add(Words a, Words b) { return {a.raw + b.raw}; }
inline Words Sub(Words a, Words b) { return {a.raw - b.raw}; }
inline Words And(Words a, Words b) { return {a.raw & b.raw}; }
inline Words AndNot(Words a, Words b) { return {~a.raw & b.raw}; }
inline V And(V a, V b) {
  return BitCast(Tag<double>(), And(BitCast(Tag<std::uint64_t>(), a), BitCast(Tag<std::uint64_t>(), b)));
}
inline V Xor(V a, V b) {
  const Tag<std::uint64_t> words;
  return BitCast(Tag<double>(), Words{BitCast(words, a).raw ^ BitCast(words, b).raw});
}

inline M Eq(V a, V b, Place place = CONTACT_HERE) { return counted(a.raw == b.raw, place); }
inline M Lt(V a, V b, Place place = CONTACT_HERE) { return counted(a.raw < b.raw, place); }
inline M Gt(V a, V b, Place place = CONTACT_HERE) { return counted(a.raw > b.raw, place); }
inline M Le(V a, V b, Place place = CONTACT_HERE) { return counted(a.raw <= b.raw, place); }
inline M Ge(V a, V b, Place place = CONTACT_HERE) { return counted(a.raw >= b.raw, place); }
inline M IsFinite(V a, Place place = CONTACT_HERE) { return counted(std::isfinite(static_cast<double>(a.raw)), place); }
inline M And(M a, M b, Place place = CONTACT_HERE) { return counted(a.raw && b.raw, place); }
inline M Or(M a, M b, Place place = CONTACT_HERE) { return counted(a.raw || b.raw, place); }
inline M AndNot(M a, M b, Place place = CONTACT_HERE) { return counted(!a.raw && b.raw, place); }
inline M Not(M a, Place place = CONTACT_HERE) { return counted(!a.raw, place); }

template <class T>
Lane<T> IfThenElse(M mask, Lane<T> yes, Lane<T> no, Place place = CONTACT_HERE) {
  return counted(mask.raw, place).raw ? yes : no;
}
template <class T>
Lane<T> IfThenElseZero(M mask, Lane<T> yes, Place place = CONTACT_HERE) {
  return counted(mask.raw, place).raw ? yes : Lane<T>{0};
}
template <class T>
Lane<T> IfThenZeroElse(M mask, Lane<T> no, Place place = CONTACT_HERE) {
  return counted(mask.raw, place).raw ? Lane<T>{0} : no;
}
inline bool AllTrue(Tag<double> /*tag*/, M mask, Place place = CONTACT_HERE) { return counted(mask.raw, place).raw; }
inline bool AllFalse(Tag<double> /*tag*/, M mask, Place place = CONTACT_HERE) { return !counted(mask.raw, place).raw; }
inline std::size_t CountTrue(Tag<double> /*tag*/, M mask) { return mask.raw ? 1 : 0; }

#if CONTACT_TINY_ESTIMATE
// The instructions of AVX-512 that the kernel names.

enum Compare { _CMP_EQ_OQ, _CMP_GE_OQ };

/// 1 / sqrt x within 2^-kEstimate, now above and now below. The series drops 63/256 h^5, |h| <= 2^-(kEstimate - 1.1):
/// at most 2^-13 u, as from 14 bits for double.
inline Number _mm512_rsqrt14_pd(Number x) {
  constexpr int kEstimate = (CONTACT_TINY_BITS + 11 + 4) / 5 + 1;  // 14 for double
  const auto number = static_cast<double>(x);
  const double most = std::ldexp(0.99, -kEstimate);
  const double off = (std::bit_cast<std::uint64_t>(number) >> (53 - CONTACT_TINY_BITS) & 1) != 0 ? 1 + most : 1 - most;
  return Number::rounded(off / std::sqrt(number));
}
inline bool _mm512_mask_cmp_pd_mask(bool mask, Number a, Number b, Compare how, Place place = CONTACT_HERE) {
  return counted(mask && (how == _CMP_EQ_OQ ? a == b : a >= b), place).raw;
}
inline Number _mm512_maskz_fmadd_pd(bool mask, Number a, Number b, Number c) { return mask ? fma(a, b, c) : Number(0); }
/// The one of least magnitude, with its sign cleared.
inline Number _mm512_range_pd(Number a, Number b, int /*how*/) { return std::min(abs(a), abs(b)); }
#endif

}  // namespace hwy::HWY_NAMESPACE

#if CONTACT_TINY_ESTIMATE
namespace contact::kernel::HWY_NAMESPACE {
using hwy::HWY_NAMESPACE::_CMP_EQ_OQ;
using hwy::HWY_NAMESPACE::_CMP_GE_OQ;
using hwy::HWY_NAMESPACE::_mm512_mask_cmp_pd_mask;
using hwy::HWY_NAMESPACE::_mm512_maskz_fmadd_pd;
using hwy::HWY_NAMESPACE::_mm512_range_pd;
using hwy::HWY_NAMESPACE::_mm512_rsqrt14_pd;
}  // namespace contact::kernel::HWY_NAMESPACE
#endif
