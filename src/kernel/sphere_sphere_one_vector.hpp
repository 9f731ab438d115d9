// The contact of one pair of balls in one vector of four doubles, (x, y, z) and the radius: the formulas, constants and
// tests of the vector kernels (docs/error-bounds.md, "The shared root"), with one root and one division. Written over
// the vector: production computes with four doubles, and tests with four numbers so short that all of them can be
// tried.
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

/// Four doubles in a register, and their masks.
struct Doubles {
  using Real = double;
  using V = __m256d;
  using M = __m256d;

  static_assert(sizeof(Ball) == 4 * sizeof(double) && offsetof(Ball, radius) == 3 * sizeof(double));
  static_assert(offsetof(Contact, normal) == 0 && offsetof(Contact, point1) == 3 * sizeof(double) &&
                offsetof(Contact, point2) == 6 * sizeof(double) && offsetof(Contact, value) == 9 * sizeof(double));

  CONTACT_ONE_VECTOR static V load(const Ball& ball) { return _mm256_loadu_pd(reinterpret_cast<const double*>(&ball)); }
  /// Writes the numbers of a contact from `first` on: what a fourth lane leaves there is to be overwritten.
  CONTACT_ONE_VECTOR static void store(V x, Contact& contact, std::size_t first) {
    _mm256_storeu_pd(reinterpret_cast<double*>(&contact) + first, x);
  }
  CONTACT_ONE_VECTOR static V all(double x) { return _mm256_set1_pd(x); }
  CONTACT_ONE_VECTOR static V with_last(V x, double last) { return _mm256_blend_pd(x, all(last), 0b1000); }
  CONTACT_ONE_VECTOR static V magnitude(V x) { return _mm256_andnot_pd(all(-0.0), x); }
  CONTACT_ONE_VECTOR static V multiply_add(V a, V b, V c) { return _mm256_fmadd_pd(a, b, c); }
  CONTACT_ONE_VECTOR static V multiply_subtract(V a, V b, V c) { return _mm256_fmsub_pd(a, b, c); }
  /// By the instruction: std::sqrt may be a call.
  CONTACT_ONE_VECTOR static double root_of(double x) {
    return _mm_cvtsd_f64(_mm_sqrt_sd(_mm_setzero_pd(), _mm_set_sd(x)));
  }
  CONTACT_ONE_VECTOR static M equal(V a, V b) { return _mm256_cmp_pd(a, b, _CMP_EQ_OQ); }
  CONTACT_ONE_VECTOR static M at_least(V a, V b) { return _mm256_cmp_pd(a, b, _CMP_GE_OQ); }
  CONTACT_ONE_VECTOR static M both(M a, M b) { return _mm256_and_pd(a, b); }
  CONTACT_ONE_VECTOR static M either(M a, M b) { return _mm256_or_pd(a, b); }
  /// The lanes as bits, lane 0 lowest.
  CONTACT_ONE_VECTOR static int bits(M mask) { return _mm256_movemask_pd(mask); }
};

template <class Real>
struct Double2 {
  Real high;
  Real low;
};

template <class Real>
CONTACT_ONE_VECTOR Double2<Real> two_sum(Real a, Real b) {
  const Real high = a + b;
  const Real b_part = high - a;
  return {high, (a - (high - b_part)) + (b - b_part)};
}

/// high + low rounded; lanes of `certain` become 0 where an error of eta u / 4 |high| could change it.
template <class Lanes>
CONTACT_ONE_VECTOR typename Lanes::V rounded(typename Lanes::V high, typename Lanes::V low, double eta,
                                             typename Lanes::M& certain) {
  const auto above = Lanes::multiply_add(low, Lanes::all(1 + eta), high);
  const auto below = Lanes::multiply_add(low, Lanes::all(1 - eta), high);
  certain = Lanes::both(certain, Lanes::equal(above, below));
  return above;
}

/// center + w + w_low rounded, where w and w_low are r n, and at least `uncancelled` of it is left.
template <class Lanes, class V = typename Lanes::V>
CONTACT_ONE_VECTOR V rounded_point(V center, V w, V w_low, V uncancelled, typename Lanes::M& certain) {
  const V high = center + w;
  const V w_part = high - center;
  const V low = ((center - (high - w_part)) + (w - w_part)) + w_low;
  certain = Lanes::both(certain, Lanes::at_least(Lanes::magnitude(high), uncancelled));
  return rounded<Lanes>(high, low, Bounds<typename Lanes::Real>::kSumEta, certain);
}

/// The contact of a hit. D' is |b - a|^2 in plain arithmetic, a normal number of 2^-900 at least; point k is
/// c + signed_radius n. False where some number is not certain; what `contact` holds then is not specified.
/// Domain      to nearest, subnormals kept.
template <class Lanes = Doubles, class AnyBall = Ball, class AnyContact = Contact, class Real = typename Lanes::Real>
CONTACT_ONE_VECTOR bool contact_of_hit(const AnyBall& a, const AnyBall& b, Real d2, Real contact_distance,
                                       Real signed_radius1, Real signed_radius2, AnyContact& contact) {
  using V = typename Lanes::V;
  using M = typename Lanes::M;
  using bounds = Bounds<Real>;
  using std::fma;
  const V first = Lanes::load(a);
  const V second = Lanes::load(b);
  const V dh = second - first;
  const V part = dh - second;
  const V dl = (second - (dh - part)) - (first + part);

  const Real y = 1 / Lanes::root_of(d2);
  const V q = dh * Lanes::all(y);
  const V e = Lanes::multiply_add(dl, Lanes::all(y), Lanes::multiply_subtract(dh, Lanes::all(y), q));
  const Real qx = q[0];
  const Real qy = q[1];
  const Real qz = q[2];
  const Real a1 = fma(qx, qx, Real(1));
  const Real a2 = fma(qy, qy, a1);
  const Real rx = fma(qx, qx, -(a1 - 1));
  const Real ry = fma(qy, qy, -(a2 - a1));
  const Real rz = fma(qz, qz, -(2 - a2));
  const Real cross = fma(qx, e[0], fma(qy, e[1], qz * e[2]));
  const Real half_rho = -fma(Real(0.5), (rx + ry) + rz, cross);
  const V low = Lanes::multiply_add(q, Lanes::all(half_rho), e);
  const Real root = y * d2;
  const Real root_low = root * (fma(-y, root, Real(1)) - half_rho);

  const Double2<Real> radii = two_sum(a.radius, b.radius);
  const Double2<Real> less = two_sum(radii.high, contact_distance);
  const Real least = (root + less.high) * bounds::kUncancelled;
  const V uncancelled = Lanes::all(least > bounds::kLeast ? least : bounds::kLeast);

  // A component that is 0 is exactly so, and what follows from it.
  M certain = Lanes::either(Lanes::at_least(Lanes::magnitude(q), Lanes::all(bounds::kLeastComponent)),
                            Lanes::equal(dh, Lanes::all(0)));
  const V normal = rounded<Lanes>(q, low, bounds::kNormalEta, certain) + Lanes::all(0);  // every zero is +0
  Lanes::store(normal, contact, 0);

  const V r1 = Lanes::all(signed_radius1);
  const V w1 = r1 * q;
  const V w1_low = Lanes::multiply_add(r1, low, Lanes::multiply_subtract(r1, q, w1));
  Lanes::store(rounded_point<Lanes>(first, w1, w1_low, uncancelled, certain), contact, 3);

  // The value, sqrt D - T, is summed in the second point's last lane.
  const V r2 = Lanes::all(signed_radius2);
  const V w2 = r2 * q;
  const V w2_low = Lanes::multiply_add(r2, low, Lanes::multiply_subtract(r2, q, w2));
  M last_certain = Lanes::equal(dh, dh);
  Lanes::store(
      rounded_point<Lanes>(Lanes::with_last(second, -less.high), Lanes::with_last(w2, root),
                           Lanes::with_last(w2_low, root_low - (less.low + radii.low)), uncancelled, last_certain),
      contact, 6);
  contact.degenerate = false;
  return ((Lanes::bits(certain) | 0b1000) & Lanes::bits(last_certain)) == 0b1111;
}

#undef CONTACT_ONE_VECTOR

}  // namespace contact::kernel::one_vector

#else
#define CONTACT_HAS_ONE_VECTOR 0
#endif
