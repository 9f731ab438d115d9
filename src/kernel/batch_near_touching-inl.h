// Pairs near touching, in vectors: the sign of E = D - T^2, and the value E / (s + T), where plain arithmetic cancels.
#if defined(CONTACT_KERNEL_BATCH_NEAR_TOUCHING_INL_H) == defined(HWY_TARGET_TOGGLE)  // once a target
#ifdef CONTACT_KERNEL_BATCH_NEAR_TOUCHING_INL_H
#undef CONTACT_KERNEL_BATCH_NEAR_TOUCHING_INL_H
#else
#define CONTACT_KERNEL_BATCH_NEAR_TOUCHING_INL_H
#endif

#include <hwy/highway.h>

#include "kernel/batch_arithmetic-inl.h"

#if HWY_HAVE_FLOAT64 && HWY_NATIVE_FMA  // else nothing is here, and no attribute for it
HWY_BEFORE_NAMESPACE();
namespace contact::kernel {
namespace HWY_NAMESPACE {

/// r1 + r2 + distance = high + low + tail exactly.
struct Length {
  V high;
  V low;
  V tail;

  HWY_INLINE Length(V r1, V r2, V distance) {
    const Double2 radii = two_sum(r1, r2);
    const Double2 sum = two_sum(radii.high, distance);
    const Double2 rest = two_sum(sum.low, radii.low);
    high = sum.high;
    low = rest.high;
    tail = rest.low;
  }

  /// The length rounded once: low and tail by rounding to odd, which lies on no boundary.
  [[nodiscard]] HWY_INLINE V rounded() const {
    const hn::RebindToUnsigned<D> words;
    const auto bits = hn::BitCast(words, low);
    const auto even = hn::AndNot(bits, hn::Set(words, bounds::kLastBit));
    const auto stepped = hn::IfThenElse(hn::RebindMask(words, hn::Lt(hn::Xor(hn::And(low, all(-0.0)), tail), all(0))),
                                        hn::Sub(bits, even), hn::Add(bits, even));
    const V odd = hn::IfThenElse(hn::Eq(tail, all(0)), low, hn::BitCast(D(), stepped));
    return hn::Add(high, odd);
  }
};

/// What the near path accumulates on two fixed grids and, below them, plainly.
struct Grids {
  V first;   ///< 6 * 2^k: a sum with it rounds to whole numbers of 8 u 2^k
  V second;  ///< 192 u 2^k: to whole numbers of 256 u^2 2^k
  V leading = all(0);
  V middle = all(0);
  V rest = all(0);

  HWY_INLINE explicit Grids(V power)
      : first(hn::Mul(power, all(bounds::kFirstGrid))), second(hn::Mul(power, all(bounds::kSecondGrid))) {}

  /// Adds (high + low)^2, or subtracts it: high^2 is the leading part, 2 high low of the first order.
  template <bool kSubtract>
  HWY_INLINE void add_square(V high, V low) {
    const V square = hn::Mul(high, high);
    const V on_first = hn::Sub(hn::Add(square, first), first);
    const V below_first = hn::Sub(square, on_first);
    const V residual = hn::MulSub(high, high, square);
    const V twice = hn::Add(high, high);
    const V below = hn::Sub(hn::Add(below_first, second), second);
    const V of_residual = hn::Sub(hn::Add(residual, second), second);
    const V of_cross = hn::Sub(hn::MulAdd(twice, low, second), second);
    const V on_second = hn::Add(hn::Add(below, of_residual), of_cross);
    const V remainders = hn::Add(hn::Sub(below_first, below), hn::Sub(residual, of_residual));
    const V under = hn::Add(remainders, hn::MulAdd(low, low, hn::MulSub(twice, low, of_cross)));
    if constexpr (kSubtract) {
      leading = hn::Sub(leading, on_first);
      middle = hn::Sub(middle, on_second);
      rest = hn::Sub(rest, under);
    } else {
      leading = hn::Add(leading, on_first);
      middle = hn::Add(middle, on_second);
      rest = hn::Add(rest, under);
    }
  }

  /// Whether (high + low)^2 lies on the grids, so that nothing of it was added plainly.
  [[nodiscard]] HWY_INLINE M holds_square(V high, V low) const {
    const V square = hn::Mul(high, high);
    const V below_first = hn::Sub(square, hn::Sub(hn::Add(square, first), first));
    const V residual = hn::MulSub(high, high, square);
    const V twice = hn::Add(high, high);
    const V of_cross = hn::Sub(hn::MulAdd(twice, low, second), second);
    return hn::And(hn::And(hn::Eq(below_first, hn::Sub(hn::Add(below_first, second), second)),
                           hn::Eq(residual, hn::Sub(hn::Add(residual, second), second))),
                   hn::And(hn::Eq(hn::MulSub(twice, low, of_cross), all(0)), hn::Eq(low, all(0))));
  }
};

/// 0 or at least kLeastFactor in magnitude, so that a product of two such is 0 only where one of them is. `before` is
/// the number before it was scaled.
HWY_INLINE M proper_factor(V x, V before) {
  return hn::Or(hn::Eq(before, all(0)), hn::Ge(hn::Abs(x), all(bounds::kLeastFactor)));
}

/// E = D - length^2 in units of scale^2, where D and length^2 are near each other.
struct NearTouching {
  Double2 difference;
  V error;
  M near;  ///< where any of it holds
  M zero;  ///< E is 0, proved
  V length_high;
  V length_low;

  /// `unit` is delta scaled, d2 its squared length, `before` delta as it was.
  HWY_INLINE NearTouching(const Delta& unit, V d2, const Delta& before, V down, const Length& length) {
    length_high = hn::Mul(length.high, down);
    length_low = hn::Mul(length.low, down);
    const V tail = hn::Mul(length.tail, down);
    const V power = power_of_two(d2);
    near = hn::And(hn::Le(hn::Abs(hn::NegMulAdd(length_high, length_high, d2)), hn::Mul(d2, all(bounds::kNear))),
                   hn::And(hn::Ge(d2, all(bounds::kLeast)), hn::Le(d2, all(bounds::kMost))));
    Grids grids(power);
    grids.add_square<false>(unit.x.high, unit.x.low);
    grids.add_square<false>(unit.y.high, unit.y.low);
    grids.add_square<false>(unit.z.high, unit.z.low);
    grids.add_square<true>(length_high, length_low);
    grids.rest = hn::NegMulAdd(hn::Add(length_high, length_high), tail, grids.rest);
    const Double2 upper = two_sum(grids.leading, grids.middle);
    const Double2 sum = two_sum(upper.high, grids.rest);
    difference = {sum.high, hn::Add(upper.low, sum.low)};
    error = hn::Mul(power, all(bounds::kNearError));
    zero = hn::And(near, hn::And(hn::Eq(upper.high, all(0)), hn::Eq(grids.rest, all(0))));
    if (hn::AllFalse(D(), zero)) return;
    // Proved where everything lies on the grids, and no product is 0 because it was too small.
    const M on_grids =
        hn::And(hn::And(grids.holds_square(unit.x.high, unit.x.low), grids.holds_square(unit.y.high, unit.y.low)),
                hn::And(grids.holds_square(unit.z.high, unit.z.low), grids.holds_square(length_high, length_low)));
    const M proper = hn::And(hn::And(hn::And(proper_factor(unit.x.high, before.x.high), hn::Eq(before.x.low, all(0))),
                                     hn::And(proper_factor(unit.y.high, before.y.high), hn::Eq(before.y.low, all(0)))),
                             hn::And(hn::And(proper_factor(unit.z.high, before.z.high), hn::Eq(before.z.low, all(0))),
                                     hn::And(hn::Eq(length.low, all(0)), hn::Eq(length.tail, all(0)))));
    zero = hn::And(zero, hn::And(on_grids, proper));
  }

  [[nodiscard]] HWY_INLINE M negative() const {
    return hn::And(near, hn::Lt(hn::Add(difference.high, hn::Add(error, error)), all(0)));
  }
  [[nodiscard]] HWY_INLINE M positive() const {
    return hn::And(near, hn::Gt(hn::Sub(difference.high, hn::Add(error, error)), all(0)));
  }

  /// E / (s + length), times `up`; `root` is s before it was multiplied by `up`.
  HWY_INLINE V value(const Double2& root, V up, M& certain) const {
    const Double2 sum = two_sum(root.high, length_high);
    const V sum_low = hn::Add(sum.low, hn::Add(root.low, length_low));
    const V reciprocal = hn::Div(all(1), sum.high);
    const V quotient = hn::Mul(difference.high, reciprocal);
    const V remainder = hn::NegMulAdd(quotient, sum.high, difference.high);
    const V low = hn::Mul(hn::Add(remainder, hn::NegMulAdd(quotient, sum_low, difference.low)), reciprocal);
    const V spread = hn::Mul(hn::Add(error, error), reciprocal);
    M agree;
    const V result = hn::Mul(
        rounded_within(quotient, low, hn::MulAdd(hn::Abs(quotient), all(bounds::kQuotientError), spread), agree), up);
    const V magnitude = hn::Abs(result);
    const M in_range = hn::And(hn::Ge(magnitude, all(bounds::kLeast)), hn::Le(magnitude, all(bounds::kMost)));
    certain = hn::Or(zero, hn::And(near, hn::And(agree, in_range)));
    return hn::IfThenZeroElse(zero, result);
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace contact::kernel
HWY_AFTER_NAMESPACE();
#endif  // HWY_HAVE_FLOAT64 && HWY_NATIVE_FMA

#endif  // once a target
