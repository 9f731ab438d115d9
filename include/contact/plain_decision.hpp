// Decisions of one pair in plain arithmetic, inline: what they are certain of costs neither a call nor a guard of the
// floating-point environment. They are right in every rounding mode, where subnormal numbers are flushed, and where
// products and sums are fused.
#pragma once

#include <cfloat>
#include <cmath>
#include <limits>

#include "contact/geometry.hpp"

// Options that let a compiler change values, as far as it tells.
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || \
    defined(__NO_SIGNED_ZEROS__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || \
    (defined(__GCC_IEC_559) && __GCC_IEC_559 == 0)
#define CONTACT_FAST_MATH 1
#else
#define CONTACT_FAST_MATH 0
#endif
// The registers of the x87, 1 and 2, round twice; other methods leave double as it is.
#if FLT_EVAL_METHOD == 1 || FLT_EVAL_METHOD == 2 || FLT_EVAL_METHOD < 0
#define CONTACT_EXCESS_PRECISION 1
#else
#define CONTACT_EXCESS_PRECISION 0
#endif

// Whether the functions of one pair decide inline first. Define CONTACT_OUT_OF_LINE where they must not: where
// exceptions trap, or their flags are to stay. The macro may differ from file to file: what is inline is never a
// function of its own, and so nothing that a linker could exchange.
#if defined(CONTACT_OUT_OF_LINE) || !defined(__GNUC__) || CONTACT_FAST_MATH || CONTACT_EXCESS_PRECISION
#define CONTACT_DECIDES_INLINE 0
#else
#define CONTACT_DECIDES_INLINE 1
/// A function of the library, with a definition that serves for inlining alone.
#define CONTACT_INLINE [[gnu::gnu_inline, gnu::always_inline]] extern inline
#endif

#if defined(__GNUC__)
#define CONTACT_PLAIN [[gnu::always_inline]] inline
#else
#define CONTACT_PLAIN inline
#endif
// clang has no macro for parts of -ffast-math, but a pragma that undoes them.
#if defined(__clang__)
#define CONTACT_PLAIN_ARITHMETIC _Pragma("clang fp reassociate(off) contract(off)")
#else
#define CONTACT_PLAIN_ARITHMETIC
#endif

namespace contact::inline CONTACT_ABI::plain_decision {

enum class Filtered { hit, miss, undecided };

/// What is certain, or else what the library's function says of the question.
template <auto out_of_line, class... Asked>
CONTACT_PLAIN bool decided(Filtered filtered, const Asked&... asked) {
  if (filtered == Filtered::undecided) [[unlikely]]
    return out_of_line(asked...);
  return filtered == Filtered::hit;
}

template <class Real>
struct Bounds {
  static constexpr double kUnit = static_cast<double>(std::numeric_limits<Real>::epsilon()) / 2;  // u
  /// The lesser of D and reach^2 is the lesser where it would be so with this share of the other added. To nearest, each
  /// is within 5.0001 u of the reals; a directed mode doubles that.
  static constexpr double kGap = 32 * kUnit;
  /// And with this: squares that underflow or are flushed lose less.
  static constexpr double kFloor = 0x1p-900;
  /// A sum of two lengths less a third decides beyond this, which is more than what is flushed.
  static constexpr double kLeastRoom = 0x1p-1000;
};

template <class First, class Second>
CONTACT_PLAIN auto squared_distance(const First& a, const Second& b) {
  CONTACT_PLAIN_ARITHMETIC
  const auto dx = b.center[0] - a.center[0];
  const auto dy = b.center[1] - a.center[1];
  const auto dz = b.center[2] - a.center[2];
  return dx * dx + dy * dy + dz * dz;
}

/// Whether balls whose centres are sqrt(D) apart are within the alarm distance. D is squared_distance(a, b).
/// Only sums of numbers that are not negative are compared. Had D ended at the largest number and a fused product been
/// subtracted from that, the difference would have either sign; no sum below that number has such a part.
/// Evidence    proofs, scalar_filter.g; docs/error-bounds.md#decisions-of-one-pair-kgap.
template <class First, class Second, class Real>
CONTACT_PLAIN Filtered filter(const First& a, const Second& b, Real D, Real alarm) {
  CONTACT_PLAIN_ARITHMETIC
  const Real reach = (a.radius + b.radius) + alarm;
  const Real reach2 = reach * reach;
  const bool hit = D < reach2;
  const Real less = D < reach2 ? D : reach2;
  const Real more = D > reach2 ? D : reach2;
  if (!(less + (Bounds<Real>::kGap * more + Bounds<Real>::kFloor) < more)) return Filtered::undecided;
  return hit ? Filtered::hit : Filtered::miss;
}

/// Whether two boxes are within `alarm` of each other: by the axis and side where there is least room.
/// Evidence    proofs, Boxes.v; docs/error-bounds.md#boxes.
CONTACT_PLAIN Filtered filter_boxes(const Box& a, const Box& b, double alarm) {
  CONTACT_PLAIN_ARITHMETIC
  double least = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double before = (b.max[axis] + alarm) - a.min[axis];
    const double behind = (a.max[axis] + alarm) - b.min[axis];
    const double less = before < behind ? before : behind;
    least = less < least ? less : least;
  }
  if (!(std::abs(least) > Bounds<double>::kLeastRoom)) return Filtered::undecided;
  return least > 0 ? Filtered::hit : Filtered::miss;
}

/// The point of a box that is nearest to `center`, as a ball without extent.
struct Nearest {
  double center[3];
  double radius;
};
CONTACT_PLAIN Nearest nearest_point(const Vector3& center, const Box& box) {
  Nearest nearest{{0, 0, 0}, 0};
  for (int axis = 0; axis < 3; ++axis) {
    const double above = center[axis] < box.min[axis] ? box.min[axis] : center[axis];
    nearest.center[axis] = above < box.max[axis] ? above : box.max[axis];
  }
  return nearest;
}

CONTACT_PLAIN Filtered filter_balls(const Ball& a, const Ball& b, double alarm) {
  return filter(a, b, squared_distance(a, b), alarm);
}
CONTACT_PLAIN Filtered filter_ball_and_box(const Ball& a, const Box& b, double alarm) {
  const Nearest q = nearest_point(a.center, b);
  return filter(q, a, squared_distance(q, a), alarm);
}

}  // namespace contact::inline CONTACT_ABI::plain_decision
