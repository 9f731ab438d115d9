// The contact of one pair of balls in one vector of four doubles, (x, y, z) and the radius: the formulas, constants and
// tests of the vector kernels (docs/error-bounds.md, "The shared root"), with one root and one division.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__)
#define CONTACT_HAS_ONE_VECTOR 1

#include <immintrin.h>

#include <cmath>
#include <cstddef>

#include "contact/contact.hpp"
#include "contact/geometry.hpp"
#include "kernel/batch_bounds.hpp"

namespace contact::kernel::one_vector {

#define CONTACT_ONE_VECTOR [[gnu::always_inline, gnu::target("avx2,fma")]] inline

using V = __m256d;

static_assert(sizeof(Ball) == 4 * sizeof(double) && offsetof(Ball, radius) == 3 * sizeof(double));
static_assert(offsetof(Contact, normal) == 0 && offsetof(Contact, point1) == 3 * sizeof(double) &&
              offsetof(Contact, point2) == 6 * sizeof(double) && offsetof(Contact, value) == 9 * sizeof(double));

CONTACT_ONE_VECTOR V load(const Ball& ball) { return _mm256_loadu_pd(reinterpret_cast<const double*>(&ball)); }
/// Writes the numbers of a contact from `first` on: what a fourth lane leaves there is to be overwritten.
CONTACT_ONE_VECTOR void store(V x, Contact& contact, std::size_t first) {
  _mm256_storeu_pd(reinterpret_cast<double*>(&contact) + first, x);
}
CONTACT_ONE_VECTOR V all(double x) { return _mm256_set1_pd(x); }
CONTACT_ONE_VECTOR V magnitude(V x) { return _mm256_andnot_pd(all(-0.0), x); }
CONTACT_ONE_VECTOR V with_last(V x, double last) { return _mm256_blend_pd(x, all(last), 0b1000); }

/// By the instruction: std::sqrt may be a call.
CONTACT_ONE_VECTOR double root_of(double x) { return _mm_cvtsd_f64(_mm_sqrt_sd(_mm_setzero_pd(), _mm_set_sd(x))); }

struct Double2 {
  double high;
  double low;
};

CONTACT_ONE_VECTOR Double2 two_sum(double a, double b) {
  const double high = a + b;
  const double b_part = high - a;
  return {high, (a - (high - b_part)) + (b - b_part)};
}

/// high + low rounded; lanes of `certain` become 0 where an error of eta 2^-55 |high| could change it.
CONTACT_ONE_VECTOR V rounded(V high, V low, double eta, V& certain) {
  const V above = _mm256_fmadd_pd(low, all(1 + eta), high);
  const V below = _mm256_fmadd_pd(low, all(1 - eta), high);
  certain = _mm256_and_pd(certain, _mm256_cmp_pd(above, below, _CMP_EQ_OQ));
  return above;
}

/// center + w + w_low rounded, where w and w_low are r n, and at least `uncancelled` of it is left.
CONTACT_ONE_VECTOR V rounded_point(V center, V w, V w_low, V uncancelled, V& certain) {
  const V high = center + w;
  const V w_part = high - center;
  const V low = ((center - (high - w_part)) + (w - w_part)) + w_low;
  certain = _mm256_and_pd(certain, _mm256_cmp_pd(magnitude(high), uncancelled, _CMP_GE_OQ));
  return rounded(high, low, bounds::kSumEta, certain);
}

/// The contact of a hit. D' is |b - a|^2 in plain arithmetic, a normal number of 2^-900 at least; point k is
/// c + signed_radius n. False where some number is not certain; what `contact` holds then is not specified.
/// Domain      to nearest, subnormals kept.
CONTACT_ONE_VECTOR bool contact_of_hit(const Ball& a, const Ball& b, double d2, double contact_distance,
                                       double signed_radius1, double signed_radius2, Contact& contact) {
  const V first = load(a);
  const V second = load(b);
  const V dh = second - first;
  const V part = dh - second;
  const V dl = (second - (dh - part)) - (first + part);

  const double y = 1 / root_of(d2);
  const V q = dh * all(y);
  const V e = _mm256_fmadd_pd(dl, all(y), _mm256_fmsub_pd(dh, all(y), q));
  const double qx = q[0];
  const double qy = q[1];
  const double qz = q[2];
  const double a1 = std::fma(qx, qx, 1);
  const double a2 = std::fma(qy, qy, a1);
  const double rx = std::fma(qx, qx, -(a1 - 1));
  const double ry = std::fma(qy, qy, -(a2 - a1));
  const double rz = std::fma(qz, qz, -(2 - a2));
  const double cross = std::fma(qx, e[0], std::fma(qy, e[1], qz * e[2]));
  const double half_rho = -std::fma(0.5, (rx + ry) + rz, cross);
  const V low = _mm256_fmadd_pd(q, all(half_rho), e);
  const double root = y * d2;
  const double root_low = root * (std::fma(-y, root, 1) - half_rho);

  const Double2 radii = two_sum(a.radius, b.radius);
  const Double2 less = two_sum(radii.high, contact_distance);
  const double least = (root + less.high) * bounds::kUncancelled;
  const V uncancelled = all(least > bounds::kLeast ? least : bounds::kLeast);

  // A component that is 0 is exactly so, and what follows from it.
  V certain = _mm256_or_pd(_mm256_cmp_pd(magnitude(q), all(bounds::kLeastComponent), _CMP_GE_OQ),
                           _mm256_cmp_pd(dh, _mm256_setzero_pd(), _CMP_EQ_OQ));
  const V normal = rounded(q, low, bounds::kNormalEta, certain) + _mm256_setzero_pd();  // every zero is +0
  store(normal, contact, 0);

  const V r1 = all(signed_radius1);
  const V w1 = r1 * q;
  const V w1_low = _mm256_fmadd_pd(r1, low, _mm256_fmsub_pd(r1, q, w1));
  store(rounded_point(first, w1, w1_low, uncancelled, certain), contact, 3);

  // The value, sqrt D - T, is summed in the second point's last lane.
  const V r2 = all(signed_radius2);
  const V w2 = r2 * q;
  const V w2_low = _mm256_fmadd_pd(r2, low, _mm256_fmsub_pd(r2, q, w2));
  V last_certain = _mm256_cmp_pd(dh, dh, _CMP_EQ_OQ);
  store(rounded_point(with_last(second, -less.high), with_last(w2, root),
                      with_last(w2_low, root_low - (less.low + radii.low)), uncancelled, last_certain),
        contact, 6);
  contact.degenerate = false;
  return ((_mm256_movemask_pd(certain) | 0b1000) & _mm256_movemask_pd(last_certain)) == 0b1111;
}

#undef CONTACT_ONE_VECTOR

}  // namespace contact::kernel::one_vector

#else
#define CONTACT_HAS_ONE_VECTOR 0
#endif
