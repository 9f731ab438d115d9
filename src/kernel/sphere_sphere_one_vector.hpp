// One pair of balls in one vector of four doubles.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__)
#define CONTACT_HAS_ONE_VECTOR 1

#include <immintrin.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "contact/contact.hpp"
#include "contact/geometry.hpp"
#include "kernel/batch_bounds.hpp"

namespace contact::kernel::one_vector {

#define CONTACT_LANES [[gnu::always_inline, gnu::target("avx2,fma")]] inline

using bounds = FastBounds<double>;
using Number = double;
/// Four doubles in a register.
struct Axes {
  __m256d lanes;
};
using Mask = Axes;
/// The mask of all lanes.
struct Every {};

#include "kernel/one_pair_lanes-inl.h"
namespace hn {
CONTACT_LANES Axes Add(Axes a, Axes b) { return {_mm256_add_pd(a.lanes, b.lanes)}; }
CONTACT_LANES Axes Sub(Axes a, Axes b) { return {_mm256_sub_pd(a.lanes, b.lanes)}; }
CONTACT_LANES Axes Mul(Axes a, Axes b) { return {_mm256_mul_pd(a.lanes, b.lanes)}; }
CONTACT_LANES Axes MulAdd(Axes a, Axes b, Axes c) { return {_mm256_fmadd_pd(a.lanes, b.lanes, c.lanes)}; }
CONTACT_LANES Axes MulSub(Axes a, Axes b, Axes c) { return {_mm256_fmsub_pd(a.lanes, b.lanes, c.lanes)}; }
CONTACT_LANES Axes Abs(Axes x) { return {_mm256_andnot_pd(_mm256_set1_pd(-0.0), x.lanes)}; }
CONTACT_LANES Mask Eq(Axes a, Axes b) { return {_mm256_cmp_pd(a.lanes, b.lanes, _CMP_EQ_OQ)}; }
CONTACT_LANES Mask Ge(Axes a, Axes b) { return {_mm256_cmp_pd(a.lanes, b.lanes, _CMP_GE_OQ)}; }
CONTACT_LANES Mask And(Mask a, Mask b) { return {_mm256_and_pd(a.lanes, b.lanes)}; }
CONTACT_LANES Mask Or(Mask a, Mask b) { return {_mm256_or_pd(a.lanes, b.lanes)}; }
}  // namespace hn

/// A constant in every lane.
template <class T>
CONTACT_LANES T all(double x) {
  if constexpr (sizeof(T) == sizeof(Number))
    return x;
  else
    return {_mm256_set1_pd(x)};
}
CONTACT_LANES double x_of(Axes a) { return a.lanes[0]; }
CONTACT_LANES double y_of(Axes a) { return a.lanes[1]; }
CONTACT_LANES double z_of(Axes a) { return a.lanes[2]; }
/// By the instruction: std::sqrt may be a call.
CONTACT_LANES double reciprocal_root(double x) {
  return 1 / _mm_cvtsd_f64(_mm_sqrt_sd(_mm_setzero_pd(), _mm_set_sd(x)));
}
CONTACT_LANES Axes masked_multiply_add(Every /*mask*/, Axes a, Axes b, Axes c) { return hn::MulAdd(a, b, c); }
CONTACT_LANES Mask and_equal(Mask mask, Axes a, Axes b) { return hn::And(mask, hn::Eq(a, b)); }
CONTACT_LANES Axes with_last(Axes x, double last) { return {_mm256_blend_pd(x.lanes, _mm256_set1_pd(last), 0b1000)}; }
/// The lanes as bits, lane 0 lowest.
CONTACT_LANES int bits_of(Mask mask) { return _mm256_movemask_pd(mask.lanes); }

static_assert(sizeof(Ball) == 4 * sizeof(double) && offsetof(Ball, radius) == 3 * sizeof(double));
static_assert(offsetof(Contact, normal) == 0 && offsetof(Contact, point1) == 3 * sizeof(double) &&
              offsetof(Contact, point2) == 6 * sizeof(double) && offsetof(Contact, value) == 9 * sizeof(double) &&
              offsetof(Contact, degenerate) == 10 * sizeof(double) &&
              offsetof(Contact, unique) == offsetof(Contact, degenerate) + 1 && sizeof(Contact) == 11 * sizeof(double));
CONTACT_LANES Axes load(const Ball& ball) { return {_mm256_loadu_pd(reinterpret_cast<const double*>(&ball))}; }
/// Writes a contact, the value in the last lane of the second point. Each member is in one piece of what is written, so that whoever copies
/// it does not wait until it has left the processor: what a fourth lane leaves is overwritten by the next member.
CONTACT_LANES void store(Axes normal, Axes point1, Axes point2_and_value, bool degenerate, Contact& contact) {
  double* const to = reinterpret_cast<double*>(&contact);
  _mm256_storeu_pd(to, normal.lanes);
  _mm256_storeu_pd(to + 3, point1.lanes);
  _mm256_storeu_pd(to + 6, point2_and_value.lanes);
  const std::uint64_t flags = 0x100U | static_cast<std::uint64_t>(degenerate);  // and unique
  std::memcpy(to + 10, &flags, sizeof flags);
}

#include "kernel/sphere_sphere_one_vector-inl.h"

#undef CONTACT_LANES

}  // namespace contact::kernel::one_vector

#else
#define CONTACT_HAS_ONE_VECTOR 0
#endif
