// Many pairs of balls at once: filter, double-double arithmetic and rounding test in vectors. What they leave goes to
// the functions of one pair.
//
//   d = c2 - c1 = dh + dl exactly     D = |d|^2     s = sqrt(D)     n = d / s     R = r1 + r2     T = R + contact
//
// One root serves all numbers: y = 1/sqrt(D) within 2 u, q = RN(dh y), q + e = d y, and rho = 1 - |q + e|^2 says what y
// lacks, so that n = q + (e + q rho / 2). Formulas and bounds: docs/error-bounds.md.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernel/batch_sphere_sphere.cpp"
#include "kernel/batch_targets.hpp"
// foreach_target.h includes this file once a target, so it comes before the rest.
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <limits>

#include "contact/sphere_sphere.hpp"
#include "kernel/batch.hpp"
#include "kernel/batch_bounds.hpp"
#include "kernel/sphere_sphere_numbers.hpp"

HWY_BEFORE_NAMESPACE();
namespace contact::kernel {
namespace HWY_NAMESPACE {

#if HWY_HAVE_FLOAT64

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<double>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;
using bounds = Bounds<hn::TFromD<D>>;

constexpr std::size_t kMostLanes = HWY_MAX_BYTES / sizeof(double);

HWY_INLINE V all(double x) { return hn::Set(D(), x); }

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

HWY_INLINE void store_flags(M flags, std::uint8_t* to) {
  const hn::Rebind<std::uint8_t, D> bytes;
  const hn::RebindToUnsigned<D> words;
  const auto ones = hn::IfThenElseZero(hn::RebindMask(words, flags), hn::Set(words, 1));
  hn::StoreU(hn::TruncateTo(bytes, ones), bytes, to);
}

/// One byte a lane: 0, 1 for a hit, 2 for a degenerate one.
HWY_INLINE void store_states(M hit, M degenerate, batch::PairState* to) {
  const hn::Rebind<std::uint8_t, D> bytes;
  const hn::RebindToUnsigned<D> words;
  const auto one = hn::Set(words, 1);
  const auto states = hn::Add(hn::IfThenElseZero(hn::RebindMask(words, hit), one),
                              hn::IfThenElseZero(hn::RebindMask(words, degenerate), one));
  hn::StoreU(hn::TruncateTo(bytes, states), bytes, reinterpret_cast<std::uint8_t*>(to));
}

/// The lanes of a mask as bits, lane 0 lowest.
HWY_INLINE unsigned bits_of(M mask) {
  HWY_ALIGN std::uint8_t bytes[kMostLanes < 8 ? 8 : kMostLanes] = {};
  hn::StoreMaskBits(D(), mask, bytes);
  return bytes[0];
}

/// A vector of pairs.
struct Loaded {
  V ax, ay, az, ar, bx, by, bz, br;

  HWY_INLINE Loaded(const SpherePairs& pairs, std::size_t i) {
    const D d;
    ax = hn::LoadU(d, pairs.a[0] + i);
    ay = hn::LoadU(d, pairs.a[1] + i);
    az = hn::LoadU(d, pairs.a[2] + i);
    ar = hn::LoadU(d, pairs.a[3] + i);
    bx = hn::LoadU(d, pairs.b[0] + i);
    by = hn::LoadU(d, pairs.b[1] + i);
    bz = hn::LoadU(d, pairs.b[2] + i);
    br = hn::LoadU(d, pairs.b[3] + i);
  }
};

/// The last pairs of columns, filled up to a vector with copies of the last one.
struct Padded {
  std::size_t count;
  double numbers[8][kMostLanes];
  SpherePairs pairs;

  Padded(const SpherePairs& whole, std::size_t begin) : count(whole.size - begin) {
    for (std::size_t column = 0; column < 8; ++column) {
      const double* from = column < 4 ? whole.a[column] : whole.b[column - 4];
      for (std::size_t lane = 0; lane < kMostLanes; ++lane)
        numbers[column][lane] = from[std::min(begin + lane, whole.size - 1)];
    }
    pairs = {{numbers[0], numbers[1], numbers[2], numbers[3]}, {numbers[4], numbers[5], numbers[6], numbers[7]}, count};
  }
  Padded(const Padded&) = delete;
  Padded& operator=(const Padded&) = delete;
};

#if HWY_NATIVE_FMA

/// high + low, unevaluated. (A constructor that the compiler makes is not compiled for the instruction set of this
/// namespace, and cannot call those of NEON's vectors.)
struct Double2 {
  V high;
  V low;

  HWY_INLINE Double2() {}
  HWY_INLINE Double2(V h, V l) : high(h), low(l) {}
};

/// a + b exactly (Knuth).
HWY_INLINE Double2 two_sum(V a, V b) {
  const V high = hn::Add(a, b);
  const V b_part = hn::Sub(high, a);
  return {high, hn::Add(hn::Sub(a, hn::Sub(high, b_part)), hn::Sub(b, b_part))};
}

/// b - a exactly; +0 where they are equal, but for 0 - -0 and such: zeros of either sign are told apart nowhere here.
HWY_INLINE Double2 two_difference(V b, V a) {
  const V high = hn::Sub(b, a);
  const V a_part = hn::Sub(high, b);
  return {high, hn::Sub(hn::Sub(b, hn::Sub(high, a_part)), hn::Add(a, a_part))};
}

struct Delta {
  Double2 x;
  Double2 y;
  Double2 z;

  HWY_INLINE Delta() {}
  HWY_INLINE Delta(Double2 on_x, Double2 on_y, Double2 on_z) : x(on_x), y(on_y), z(on_z) {}
};

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

/// high + low rounded where `wanted`, else 0; `certain` loses the wanted lanes where an error of eta u / 4 |high| could
/// change it.
HWY_INLINE V rounded(V high, V low, double eta, M wanted, M& certain) {
  const V above = masked_multiply_add(wanted, low, all(1 + eta), high);
  certain = and_equal(certain, above, hn::MulAdd(low, all(1 - eta), high));
  return above;
}

/// high + low rounded, and whether an error could change it.
HWY_INLINE V rounded_within(V high, V low, V error, M& certain) {
  const V above = hn::Add(high, hn::Add(low, error));
  certain = hn::Eq(above, hn::Add(high, hn::Sub(low, error)));
  return above;
}

/// The normal n = q + low and the length s, from delta, its squared length in plain arithmetic, and one root.
struct Direction {
  V qx, qy, qz;
  V low_x, low_y, low_z;
  Double2 root;

  HWY_INLINE Direction(const Delta& d, V d2) {
    const V y = reciprocal_root(d2);
    qx = hn::Mul(d.x.high, y);
    qy = hn::Mul(d.y.high, y);
    qz = hn::Mul(d.z.high, y);
    const V ex = hn::MulAdd(d.x.low, y, hn::MulSub(d.x.high, y, qx));
    const V ey = hn::MulAdd(d.y.low, y, hn::MulSub(d.y.high, y, qy));
    const V ez = hn::MulAdd(d.z.low, y, hn::MulSub(d.z.high, y, qz));
    // 1 - |q|^2: the leading parts of 1 + qx^2 and 1 + qx^2 + qy^2 are whole numbers of 2^-52, their differences exact.
    const V one = all(1);
    const V a1 = hn::MulAdd(qx, qx, one);
    const V a2 = hn::MulAdd(qy, qy, a1);
    const V rx = hn::MulSub(qx, qx, hn::Sub(a1, one));
    const V ry = hn::MulSub(qy, qy, hn::Sub(a2, a1));
    const V rz = hn::MulSub(qz, qz, hn::Sub(all(2), a2));
    const V cross = hn::MulAdd(qx, ex, hn::MulAdd(qy, ey, hn::Mul(qz, ez)));
    const V half_rho = hn::NegMulSub(all(0.5), hn::Add(hn::Add(rx, ry), rz), cross);
    low_x = hn::MulAdd(qx, half_rho, ex);
    low_y = hn::MulAdd(qy, half_rho, ey);
    low_z = hn::MulAdd(qz, half_rho, ez);
    root.high = hn::Mul(y, d2);
    root.low = hn::Mul(root.high, hn::Sub(hn::NegMulAdd(y, root.high, one), half_rho));
  }
};

/// center + radius (q + low).
HWY_INLINE Double2 point(V center, V radius, V q, V low) {
  const V w = hn::Mul(radius, q);
  const V high = hn::Add(center, w);
  const V w_part = hn::Sub(high, center);
  const V center_lost = hn::Sub(center, hn::Sub(high, w_part));  // exact, as in two_sum
  const V w_lost = hn::MulAdd(radius, low, hn::MulSub(radius, q, w_part));
  return {high, hn::Add(center_lost, w_lost)};
}

/// The ten numbers of contacts.
struct Numbers {
  V nx, ny, nz, px, py, pz, rx, ry, rz, value;

  HWY_INLINE static Numbers load(const ContactRows& from, std::size_t i) {
    const auto at = [&](std::size_t k) HWY_ATTR { return hn::LoadU(D(), from.number[k] + i); };
    return {at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7), at(8), at(9)};
  }
  HWY_INLINE void store(const ContactRows& out, std::size_t i) const {
    const D d;
    hn::StoreU(nx, d, out.number[0] + i);
    hn::StoreU(ny, d, out.number[1] + i);
    hn::StoreU(nz, d, out.number[2] + i);
    hn::StoreU(px, d, out.number[3] + i);
    hn::StoreU(py, d, out.number[4] + i);
    hn::StoreU(pz, d, out.number[5] + i);
    hn::StoreU(rx, d, out.number[6] + i);
    hn::StoreU(ry, d, out.number[7] + i);
    hn::StoreU(rz, d, out.number[8] + i);
    hn::StoreU(value, d, out.number[9] + i);
  }
};

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

/// What a call on contacts works on.
struct Job {
  SpherePairs pairs;
  SphereQuestion question;
  ContactRows out;
  std::size_t size;  ///< pairs[size..] are padding
  double sign1;      ///< point1 = c1 + sign1 r1 n
  double sign2;      ///< point2 = c2 + sign2 r2 n
  batch::Count count{};
};

constexpr double sign_of(PointOn on, double towards) {
  return on == PointOn::nearest_surface ? towards : on == PointOn::far_surface ? -towards : 0;
}

HWY_INLINE Delta delta_of(const Loaded& in) {
  return {two_difference(in.bx, in.ax), two_difference(in.by, in.ay), two_difference(in.bz, in.az)};
}

HWY_INLINE M coincide(const Delta& d) { return hn::Eq(largest_component(d), all(0)); }

/// reach in units of the scale. Where scaling up takes it out of the range it is a hit by far.
HWY_INLINE V scaled_reach(V r1, V r2, double alarm, V down) {
  return hn::Min(hn::MulAdd(all(alarm), down, hn::Add(hn::Mul(r1, down), hn::Mul(r2, down))), all(bounds::kReachCap));
}

/// A vector of contacts as the fast stage leaves it; the numbers are in their rows, those of misses 0.
struct Stage {
  Delta unit;  ///< delta, scaled
  V d2;        ///< its squared length, plainly
  V qx, qy, qz, low_x, low_y, low_z;
  Double2 root;
  M hit;
  M miss;
  V uncancelled;  ///< what points and value must be left with for the quick tests to mean anything
  M axes_agree;   ///< the quick tests of normal and points
  M value_agrees;

  HWY_INLINE Stage() {}
};

/// center + radius q on one axis, by the true bounds.
HWY_INLINE V point_within(V center, V signed_radius, V q, V low, M& certain) {
  const V w = hn::Abs(hn::Mul(signed_radius, q));
  const Double2 sum = point(center, signed_radius, q, low);
  const V high = hn::Abs(sum.high);
  const V error = hn::MulAdd(w, all(bounds::kPointError), hn::Mul(high, all(bounds::kPointSumError)));
  const V number = rounded_within(sum.high, sum.low, error, certain);
  const V magnitude = hn::Max(high, w);
  certain = hn::And(certain, hn::And(hn::Ge(magnitude, all(bounds::kLeast)), hn::Le(magnitude, all(bounds::kMost))));
  const M no_radius = hn::Eq(signed_radius, all(0));
  certain = hn::Or(certain, no_radius);
  return hn::Add(hn::IfThenElse(no_radius, center, number), all(0));  // every zero is +0
}

/// One axis of normal and points, by whatever is certain.
struct Axis {
  V n, p, r;
  M certain;

  /// Where delta is 0 on this axis, or on both others: r n is 0 or +-r, and a point one sum, rounded once.
  HWY_INLINE void take_simple(V center1, V radius1, V center2, V radius2, V d_high, M none, M only) {
    const M simple = hn::Or(none, only);
    const V sign = hn::And(d_high, all(-0.0));
    const auto moved = [&](V center, V radius) HWY_ATTR {
      return hn::Add(hn::Add(center, hn::IfThenZeroElse(none, hn::Xor(radius, sign))), all(0));
    };
    n = hn::IfThenElse(simple, hn::IfThenZeroElse(none, hn::Xor(all(1), sign)), n);
    p = hn::IfThenElse(simple, moved(center1, radius1), p);
    r = hn::IfThenElse(simple, moved(center2, radius2), r);
    certain = hn::Or(certain, simple);
  }

  /// Where the quick tests said no though the bounds hold.
  HWY_INLINE void take_bounds(V center1, V radius1, V center2, V radius2, V q, V low, M usable) {
    M agree = hn::And(usable, hn::Ge(hn::Abs(q), all(bounds::kLeastComponent)));
    const V normal = rounded(q, low, bounds::kNormalEta, usable, agree);
    M first;
    M second;
    const V point1 = point_within(center1, radius1, q, low, first);
    const V point2 = point_within(center2, radius2, q, low, second);
    const M better = hn::AndNot(certain, hn::And(agree, hn::And(first, second)));
    n = hn::IfThenElse(better, normal, n);
    p = hn::IfThenElse(better, point1, p);
    r = hn::IfThenElse(better, point2, r);
    certain = hn::Or(certain, better);
  }
};

/// A value that neither the quick test nor the near path settles: the interval of its true bound; the exact sum where
/// delta has one component; T rounded where s is too small to matter but for its sign.
HWY_INLINE V other_value(const Delta& d, M only_axis, const Double2& root, const Length& less, M usable, M& certain) {
  // T is exact, so that all of the error is the root's, and the last sums'.
  const Double2 sum = two_difference(root.high, less.high);
  const Double2 second = two_difference(sum.low, less.low);
  const V sum_low = hn::Add(second.high, hn::Add(root.low, hn::Sub(second.low, less.tail)));
  const V error = hn::MulAdd(root.high, all(bounds::kRootError), hn::Mul(hn::Abs(sum_low), all(bounds::kLowError)));
  V value = rounded_within(sum.high, sum_low, error, certain);
  const V magnitude = hn::Abs(sum.high);
  certain = hn::And(hn::And(certain, usable),
                    hn::And(hn::Ge(magnitude, all(bounds::kLeast)), hn::Le(magnitude, all(bounds::kMost))));
  const M whole = hn::Eq(less.tail, all(0));

  // s = |d| = |dh| +- |dl|: two components are 0, and so are their low parts.
  const V high = hn::Add(hn::Add(hn::Abs(d.x.high), hn::Abs(d.y.high)), hn::Abs(d.z.high));
  const V low =
      hn::Add(hn::Add(hn::Xor(d.x.low, hn::And(d.x.high, all(-0.0))), hn::Xor(d.y.low, hn::And(d.y.high, all(-0.0)))),
              hn::Xor(d.z.low, hn::And(d.z.high, all(-0.0))));
  const Double2 leading = two_difference(high, less.high);
  const Double2 once = two_sum(leading.low, low);
  const Double2 twice = two_difference(once.high, less.low);
  const M exact = hn::And(hn::And(only_axis, whole), hn::And(hn::Eq(once.low, all(0)), hn::Eq(twice.low, all(0))));
  value = hn::IfThenElse(exact, hn::Add(leading.high, twice.high), value);

  // 0 < s < u / 2 |T.low|, or than T where that is one number: no double lies between T.low and T.low - s, and so no
  // rounding boundary. T.low (1 - u) is between the same doubles, or the lower one, which is none; T.low (1 + 2u) where
  // T.low is minus a power of two; elsewhere it may be too far and must agree with T.low itself.
  const M number = hn::Eq(less.low, all(0));
  const V room = hn::IfThenElse(number, less.high, hn::Abs(less.low));
  const M small = hn::And(hn::Gt(high, all(0)), hn::Lt(hn::Mul(high, all(2 / bounds::kUnit)), room));
  const M positive = hn::Gt(less.low, all(0));
  const V nudged =
      hn::MulAdd(less.low, hn::IfThenElse(positive, all(1 - bounds::kUnit), all(1 + 2 * bounds::kUnit)), less.high);
  const M agree = hn::Or(hn::Or(positive, hn::Eq(nudged, hn::Add(less.high, less.low))),
                         hn::Eq(power_of_two(less.low), hn::Abs(less.low)));
  const M tiny = hn::And(hn::And(whole, hn::Ge(less.high, all(bounds::kLeast))), hn::And(small, agree));
  value = hn::IfThenElse(tiny, hn::Neg(nudged), value);
  certain = hn::Or(certain, hn::Or(exact, tiny));
  return hn::Add(value, all(0));
}

/// A vector of pairs of which some number is not certain yet. What is not certain after that goes to the function of
/// one pair.
template <bool kScaled>
HWY_NOINLINE void finish(Job& job, std::size_t i, const Stage& stage) {
  const Loaded in(job.pairs, i);
  const Delta d = kScaled ? delta_of(in) : stage.unit;
  Scale scale{all(1), all(1)};
  if constexpr (kScaled) scale = scale_of(d);
  const V zero = all(0);
  const M coincident = coincide(d);
  M usable = hn::And(hn::Ge(stage.d2, all(bounds::kLeast)), hn::Le(stage.d2, all(bounds::kMost)));
  M hit = stage.hit;
  M open = hn::Not(hn::Or(hit, stage.miss));
  if constexpr (kScaled) {
    // Delta overflowed, or is too large to be scaled: nothing above means anything.
    usable = hn::And(usable, hn::Lt(largest_component(d), all(bounds::kMost)));
    const M lost = hn::Not(hn::Or(usable, coincident));
    hit = hn::AndNot(lost, hit);
    open = hn::Or(open, lost);
  }
  hit = hn::Or(hit, coincident);
  open = hn::AndNot(coincident, open);

  // Decisions and values near touching.
  const double alarm = job.question.distances.alarm;
  const double contact = job.question.distances.contact;
  const Length less(in.ar, in.br, all(contact));
  Numbers numbers = Numbers::load(job.out, i);
  V value = numbers.value;
  const V uncancelled = hn::Add(stage.uncancelled, stage.uncancelled);  // of rounded numbers
  const M value_agrees = hn::And(stage.value_agrees, usable);
  M value_certain = hn::And(value_agrees, hn::Ge(hn::Abs(value), uncancelled));
  if (!hn::AllFalse(D(), coincident)) {  // value = -T
    value = hn::IfThenElse(coincident, hn::Sub(zero, less.rounded()), value);
    // Beyond the largest number the parts of T are no numbers.
    value_certain = hn::Or(value_certain, hn::And(coincident, hn::IsFinite(value)));
  }
  const bool same = alarm == contact;
  M undecided = hn::And(open, usable);
  if (!same && !hn::AllFalse(D(), undecided)) {
    const NearTouching touching(stage.unit, stage.d2, d, scale.down, Length(in.ar, in.br, all(alarm)));
    const M inside = hn::And(undecided, hn::Or(touching.zero, touching.negative()));
    hit = hn::Or(hit, inside);
    open = hn::AndNot(hn::Or(inside, hn::And(undecided, touching.positive())), open);
    undecided = hn::And(open, usable);
  }
  M wanting = hn::AndNot(value_certain, hn::And(usable, hn::Or(hit, undecided)));
  if (!hn::AllFalse(D(), wanting)) {
    const NearTouching touching(stage.unit, stage.d2, d, scale.down, less);
    if (same) {
      const M inside = hn::And(undecided, hn::Or(touching.zero, touching.negative()));
      hit = hn::Or(hit, inside);
      open = hn::AndNot(hn::Or(inside, hn::And(undecided, touching.positive())), open);
    }
    M certain;
    const V near_value = touching.value(stage.root, scale.up, certain);
    certain = hn::And(certain, wanting);
    value = hn::IfThenElse(certain, near_value, value);
    value_certain = hn::Or(value_certain, certain);
  }

  // Where a component of delta is 0 so is that of the normal; where two are, the normal is the third axis.
  const M axes_agree = hn::And(stage.axes_agree, usable);
  const auto quick = [&](V q, V p, V r) HWY_ATTR {
    return hn::And(hn::And(axes_agree, hn::Ge(hn::Abs(q), all(bounds::kLeastComponent))),
                   hn::Ge(least_magnitude(p, r), uncancelled));
  };
  Axis x{numbers.nx, numbers.px, numbers.rx, quick(stage.qx, numbers.px, numbers.rx)};
  Axis y{numbers.ny, numbers.py, numbers.ry, quick(stage.qy, numbers.py, numbers.ry)};
  Axis z{numbers.nz, numbers.pz, numbers.rz, quick(stage.qz, numbers.pz, numbers.rz)};
  M wanting_axis = hn::AndNot(hn::And(x.certain, hn::And(y.certain, z.certain)), hit);
  wanting = hn::AndNot(value_certain, hit);
  if (!hn::AllFalse(D(), hn::Or(wanting_axis, wanting))) {
    const V radius1 = hn::Mul(in.ar, all(job.sign1));
    const V radius2 = hn::Mul(in.br, all(job.sign2));
    const M no_x = hn::Eq(d.x.high, zero);
    const M no_y = hn::Eq(d.y.high, zero);
    const M no_z = hn::Eq(d.z.high, zero);
    const M only_x = hn::And(no_y, no_z);  // coincident centres too
    const M only_y = hn::AndNot(no_y, hn::And(no_x, no_z));
    const M only_z = hn::AndNot(no_z, hn::And(no_x, no_y));
    // +0 stands for a component of coincident centres: the normal is (1,0,0).
    const V x_high = hn::IfThenZeroElse(coincident, d.x.high);
    x.take_simple(in.ax, radius1, in.bx, radius2, x_high, hn::AndNot(coincident, no_x), only_x);
    y.take_simple(in.ay, radius1, in.by, radius2, d.y.high, no_y, only_y);
    z.take_simple(in.az, radius1, in.bz, radius2, d.z.high, no_z, only_z);
    if (!hn::AllFalse(D(), hn::AndNot(x.certain, hit)))
      x.take_bounds(in.ax, radius1, in.bx, radius2, stage.qx, stage.low_x, usable);
    if (!hn::AllFalse(D(), hn::AndNot(y.certain, hit)))
      y.take_bounds(in.ay, radius1, in.by, radius2, stage.qy, stage.low_y, usable);
    if (!hn::AllFalse(D(), hn::AndNot(z.certain, hit)))
      z.take_bounds(in.az, radius1, in.bz, radius2, stage.qz, stage.low_z, usable);
    if (!hn::AllFalse(D(), wanting)) {
      const Double2 root = kScaled ? scaled(stage.root, scale.up) : stage.root;
      M certain;
      const M only_axis = hn::Or(only_x, hn::Or(only_y, only_z));
      const V other = other_value(d, only_axis, root, less, usable, certain);
      certain = hn::And(certain, hn::AndNot(coincident, wanting));
      value = hn::IfThenElse(certain, other, value);
      value_certain = hn::Or(value_certain, certain);
    }
  }
  const auto of_hit = [hit](V number) HWY_ATTR { return hn::IfThenElseZero(hit, number); };
  numbers = {of_hit(x.n), of_hit(y.n), of_hit(z.n), of_hit(x.p), of_hit(y.p),
             of_hit(z.p), of_hit(x.r), of_hit(y.r), of_hit(z.r), of_hit(value)};
  numbers.store(job.out, i);
  store_states(hit, coincident, job.out.state + i);
  job.count.hits += hn::CountTrue(D(), hit);
  const M certain = hn::And(hn::And(x.certain, y.certain), hn::And(z.certain, value_certain));
  const M rest = hn::Or(open, hn::AndNot(certain, hit));
  if (hn::AllFalse(D(), rest)) return;
  const unsigned left = bits_of(rest);
  const unsigned undecided_lanes = bits_of(open);
  const unsigned uncertain[] = {bits_of(hn::Not(x.certain)), bits_of(hn::Not(y.certain)), bits_of(hn::Not(z.certain)),
                                bits_of(hn::Not(value_certain))};
  for (std::size_t lane = 0; lane < hn::Lanes(D()) && i + lane < job.size; ++lane) {
    if (((left >> lane) & 1) == 0) continue;
    ++job.count.exact;
    if (((undecided_lanes >> lane) & 1) == 0) {
      unsigned numbers_left = ((uncertain[3] >> lane) & 1) << kValueNumber;
      for (unsigned axis = 0; axis < 3; ++axis)
        numbers_left |= ((uncertain[axis] >> lane) & 1) * (kAxisNumbers << axis);
      round_numbers(job.pairs, job.question, i + lane, numbers_left, job.out);
      continue;
    }
    contact_of_one_pair(job.pairs, job.question, i + lane, job.out, i + lane);
    job.count.hits += job.out.state[i + lane] != batch::PairState::miss ? 1U : 0U;
  }
}

/// The contacts of a vector of pairs. False, and nothing that counts written, where one needs to be scaled first.
template <bool kScaled>
HWY_INLINE bool contacts_of_vector(Job& job, std::size_t i) {
  const Loaded in(job.pairs, i);
  const Delta d = delta_of(in);
  Delta unit = d;
  Scale scale{all(1), all(1)};
  if constexpr (kScaled) {
    scale = scale_of(d);
    unit = scaled(d, scale.down);
  }
  const V d2 = squared_length(unit.x.high, unit.y.high, unit.z.high);
  const Double2 radii = two_sum(in.ar, in.br);
  const double alarm = job.question.distances.alarm;
  V reach = hn::Add(radii.high, all(alarm));
  if constexpr (kScaled) reach = scaled_reach(in.ar, in.br, alarm, scale.down);
  M hit;
  M miss;
  filter(d2, reach, hit, miss);

  const Direction n(unit, d2);
  Double2 root = n.root;
  if constexpr (kScaled) root = scaled(root, scale.up);
  const Double2 less = two_sum(radii.high, all(job.question.distances.contact));
  const V least = all(bounds::kLeast);
  const V uncancelled = hn::Max(hn::Mul(hn::Add(root.high, less.high), all(bounds::kUncancelled)), least);

  // Written as they come, and again where they do not hold: there are too few registers to keep them.
  const auto write = [&](std::size_t k, V number) HWY_ATTR { hn::StoreU(number, D(), job.out.number[k] + i); };
  const M wanted = hn::Not(miss);
  M axes_agree = wanted;
  M value_agrees = wanted;
  write(0, rounded(n.qx, n.low_x, bounds::kNormalEta, wanted, axes_agree));
  write(1, rounded(n.qy, n.low_y, bounds::kNormalEta, wanted, axes_agree));
  write(2, rounded(n.qz, n.low_z, bounds::kNormalEta, wanted, axes_agree));
  const V component = lesser_magnitude(least_magnitude(n.qx, n.qy), n.qz);

  const Double2 sum = two_difference(root.high, less.high);
  const V sum_low = hn::Add(sum.low, hn::Sub(root.low, hn::Add(less.low, radii.low)));
  write(9, rounded(sum.high, sum_low, bounds::kSumEta, wanted, value_agrees));
  V left = hn::Abs(sum.high);  // the least that cancellation has left of a point or the value
  const auto rounded_point = [&](V center, V radius, V q, V low) HWY_ATTR {
    const Double2 at = point(center, radius, q, low);
    left = lesser_magnitude(left, at.high);
    return rounded(at.high, at.low, bounds::kSumEta, wanted, axes_agree);
  };
  const V radius1 = hn::Mul(in.ar, all(job.sign1));
  const V radius2 = hn::Mul(in.br, all(job.sign2));
  write(3, rounded_point(in.ax, radius1, n.qx, n.low_x));
  write(4, rounded_point(in.ay, radius1, n.qy, n.low_y));
  write(5, rounded_point(in.az, radius1, n.qz, n.low_z));
  write(6, rounded_point(in.bx, radius2, n.qx, n.low_x));
  write(7, rounded_point(in.by, radius2, n.qy, n.low_y));
  write(8, rounded_point(in.bz, radius2, n.qz, n.low_z));

  M good = hn::And(hn::And(hit, axes_agree), value_agrees);
  good = and_at_least(good, left, uncancelled);
  good = and_at_least(good, component, all(bounds::kLeastComponent));
  good = and_at_least(good, d2, least);
  if (HWY_LIKELY(hn::AllTrue(D(), hn::Or(miss, good)))) {
    store_flags(hit, reinterpret_cast<std::uint8_t*>(job.out.state + i));
    job.count.hits += hn::CountTrue(D(), hit);
    return true;
  }
  if constexpr (!kScaled) {
    const V most = all(bounds::kMost);
    const M in_range = hn::And(hn::Ge(d2, least), hn::Le(hn::MulAdd(reach, reach, d2), most));
    if (!hn::AllTrue(D(), hn::Or(hn::Or(miss, in_range), coincide(d)))) return false;
  }
  // Member by member: whole structs would be kept in memory on the quick way too.
  Stage stage;
  stage.unit.x.high = unit.x.high;
  stage.unit.x.low = unit.x.low;
  stage.unit.y.high = unit.y.high;
  stage.unit.y.low = unit.y.low;
  stage.unit.z.high = unit.z.high;
  stage.unit.z.low = unit.z.low;
  stage.d2 = d2;
  stage.qx = n.qx;
  stage.qy = n.qy;
  stage.qz = n.qz;
  stage.low_x = n.low_x;
  stage.low_y = n.low_y;
  stage.low_z = n.low_z;
  stage.root.high = n.root.high;
  stage.root.low = n.root.low;
  stage.hit = hit;
  stage.miss = miss;
  stage.uncancelled = uncancelled;
  stage.axes_agree = axes_agree;
  stage.value_agrees = value_agrees;
  finish<kScaled>(job, i, stage);
  return true;
}

/// How many pairs go unscaled again before a pair that had to be scaled is forgotten.
constexpr std::size_t kStrip = 256;

HWY_INLINE void contacts_of_whole_vectors(Job& job, std::size_t end) {
  const std::size_t lanes = hn::Lanes(D());
  bool scale = false;
  for (std::size_t i = 0; i < end; i += lanes) {
    if (i % kStrip == 0) scale = false;
    if (!scale && contacts_of_vector<false>(job, i)) continue;
    scale = true;
    contacts_of_vector<true>(job, i);
  }
}

batch::Count compute_spheres(const SpherePairs& pairs, const SphereQuestion& question, const ContactRows& out) {
  Job job{pairs, question, out, pairs.size, sign_of(question.points.first, 1), sign_of(question.points.second, -1)};
  const std::size_t whole = pairs.size - pairs.size % hn::Lanes(D());
  contacts_of_whole_vectors(job, whole);
  if (whole == pairs.size) return job.count;

  const Padded last(pairs, whole);
  double numbers[ContactRows::kNumbers][kMostLanes];
  batch::PairState states[kMostLanes];
  ContactRows rows{};
  for (std::size_t k = 0; k < ContactRows::kNumbers; ++k) rows.number[k] = numbers[k];
  rows.state = states;
  Job rest{last.pairs, question, rows, last.count, job.sign1, job.sign2};
  contacts_of_whole_vectors(rest, 1);
  job.count.exact += rest.count.exact;
  for (std::size_t lane = 0; lane < last.count; ++lane) {
    for (std::size_t k = 0; k < ContactRows::kNumbers; ++k) out.number[k][whole + lane] = numbers[k][lane];
    out.state[whole + lane] = states[lane];
    job.count.hits += states[lane] != batch::PairState::miss ? 1U : 0U;
  }
  return job.count;
}

/// Contacts of the pairs that are not plainly misses, strip by strip: their numbers are brought together first.
batch::Count compute_sphere_hits(const SpherePairs& pairs, const SphereQuestion& question, std::uint32_t* index,
                                 const ContactRows& out) {
  const std::size_t lanes = hn::Lanes(D());
  HWY_ALIGN double kept[8][kStrip];
  std::uint32_t kept_index[kStrip];
  batch::Count count;
  for (std::size_t begin = 0; begin < pairs.size; begin += kStrip) {
    const std::size_t end = std::min(begin + kStrip, pairs.size);
    std::size_t k = 0;
    std::size_t i = begin;
    for (; i + lanes <= end; i += lanes) {
      const Loaded in(pairs, i);
      const V d2 = squared_length(hn::Sub(in.bx, in.ax), hn::Sub(in.by, in.ay), hn::Sub(in.bz, in.az));
      M hit;
      M miss;
      filter(d2, hn::Add(hn::Add(in.ar, in.br), all(question.distances.alarm)), hit, miss);
      const unsigned keep = ~bits_of(miss);
      for (std::size_t lane = 0; lane < lanes; ++lane) {  // no branch: hits come in no order
        kept_index[k] = static_cast<std::uint32_t>(i + lane);
        k += (keep >> lane) & 1;
      }
    }
    for (; i < end; ++i) kept_index[k++] = static_cast<std::uint32_t>(i);
    for (std::size_t column = 0; column < 8; ++column) {
      const double* from = column < 4 ? pairs.a[column] : pairs.b[column - 4];
      for (std::size_t row = 0; row < k; ++row) kept[column][row] = from[kept_index[row]];
    }
    const ContactRows rows = out.from(count.hits);
    const batch::Count strip = compute_spheres(
        {{kept[0], kept[1], kept[2], kept[3]}, {kept[4], kept[5], kept[6], kept[7]}, k}, question, rows);
    std::size_t row = 0;
    for (std::size_t from = 0; from < k; ++from) {
      if (strip.hits != k) {  // a miss that was not plain
        if (rows.state[from] == batch::PairState::miss) continue;
        for (double* column : rows.number) column[row] = column[from];
        rows.state[row] = rows.state[from];
      }
      index[count.hits + row++] = kept_index[from];
    }
    count.hits += strip.hits;
    count.exact += strip.exact;
  }
  return count;
}

/// Decides the pairs of a vector that the filter leaves open.
HWY_NOINLINE void finish_test(const SpherePairs& pairs, double alarm, std::size_t i, std::uint8_t* hit,
                              batch::Count& count) {
  const Loaded in(pairs, i);
  const Delta d = delta_of(in);
  const Scale scale = scale_of(d);
  const Delta unit = scaled(d, scale.down);
  const V d2 = squared_length(unit.x.high, unit.y.high, unit.z.high);
  M inside_filter;
  M outside_filter;
  filter(d2, scaled_reach(in.ar, in.br, alarm, scale.down), inside_filter, outside_filter);
  const M coincident = coincide(d);
  const M usable = hn::And(hn::Lt(largest_component(d), all(bounds::kMost)), hn::Ge(d2, all(bounds::kLeast)));
  M hits = hn::Or(coincident, hn::And(usable, inside_filter));
  M open = hn::AndNot(hn::Or(hits, hn::And(usable, outside_filter)), hn::Eq(all(0), all(0)));
  const NearTouching touching(unit, d2, d, scale.down, Length(in.ar, in.br, all(alarm)));
  const M inside = hn::And(hn::And(open, usable), hn::Or(touching.zero, touching.negative()));
  hits = hn::Or(hits, inside);
  open = hn::AndNot(hn::Or(inside, hn::And(usable, touching.positive())), open);
  store_flags(hits, hit);
  const unsigned left = bits_of(open);
  for (std::size_t lane = 0; lane < hn::Lanes(D()) && i + lane < pairs.size; ++lane) {
    if (((left >> lane) & 1) == 0) continue;
    hit[lane] = test_sphere_sphere(pairs.first(i + lane), pairs.second(i + lane), alarm) ? 1 : 0;
    ++count.exact;
  }
}

#endif  // HWY_NATIVE_FMA

/// Decides the pairs of a vector, of which the last ones may be padding.
HWY_INLINE void test_vector(const SpherePairs& pairs, double alarm, std::size_t i, std::uint8_t* hit,
                            batch::Count& count) {
  const Loaded in(pairs, i);
  const V d2 = squared_length(hn::Sub(in.bx, in.ax), hn::Sub(in.by, in.ay), hn::Sub(in.bz, in.az));
  M inside;
  M outside;
  filter(d2, hn::Add(hn::Add(in.ar, in.br), all(alarm)), inside, outside);
  const M decided = hn::Or(inside, outside);
  store_flags(inside, hit);
  if (HWY_LIKELY(hn::AllTrue(D(), decided))) return;
#if HWY_NATIVE_FMA
  finish_test(pairs, alarm, i, hit, count);
#else
  const unsigned left = bits_of(hn::Not(decided));
  for (std::size_t lane = 0; lane < hn::Lanes(D()) && i + lane < pairs.size; ++lane) {
    if (((left >> lane) & 1) == 0) continue;
    hit[lane] = test_sphere_sphere(pairs.first(i + lane), pairs.second(i + lane), alarm) ? 1 : 0;
    ++count.exact;
  }
#endif
}

batch::Count test_spheres(const SpherePairs& pairs, double alarm, std::uint8_t* hit) {
  batch::Count count;
  const std::size_t lanes = hn::Lanes(D());
  std::size_t i = 0;
  for (; i + lanes <= pairs.size; i += lanes) test_vector(pairs, alarm, i, hit + i, count);
  if (i < pairs.size) {
    const Padded last(pairs, i);
    std::uint8_t hits[kMostLanes];
    test_vector(last.pairs, alarm, 0, hits, count);
    std::copy_n(hits, last.count, hit + i);
  }
  for (i = 0; i < pairs.size; ++i) count.hits += hit[i];
  return count;
}

#else  // no vectors of doubles

batch::Count test_spheres(const SpherePairs& pairs, double alarm, std::uint8_t* hit) {
  return test_sphere_sphere_scalar(pairs, alarm, hit);
}

#endif  // HWY_HAVE_FLOAT64

#if !HWY_HAVE_FLOAT64 || !HWY_NATIVE_FMA

// Without a fused multiply-add the numbers come from the functions of one pair.

batch::Count compute_spheres(const SpherePairs& pairs, const SphereQuestion& question, const ContactRows& out) {
  return compute_sphere_sphere_scalar(pairs, question, out);
}

batch::Count compute_sphere_hits(const SpherePairs& pairs, const SphereQuestion& question, std::uint32_t* index,
                                 const ContactRows& out) {
  return compute_sphere_sphere_hits_scalar(pairs, question, index, out);
}

#endif

bool computes_contacts() { return HWY_HAVE_FLOAT64 && HWY_NATIVE_FMA; }

}  // namespace HWY_NAMESPACE
}  // namespace contact::kernel
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace contact::kernel {

HWY_EXPORT(test_spheres);
HWY_EXPORT(compute_spheres);
HWY_EXPORT(compute_sphere_hits);
HWY_EXPORT(computes_contacts);

batch::Count test_sphere_sphere_vectors(const SpherePairs& pairs, double alarm, std::uint8_t* hit) {
  return HWY_DYNAMIC_DISPATCH(test_spheres)(pairs, alarm, hit);
}

batch::Count compute_sphere_sphere_vectors(const SpherePairs& pairs, const SphereQuestion& question,
                                           const ContactRows& out) {
  return HWY_DYNAMIC_DISPATCH(compute_spheres)(pairs, question, out);
}

batch::Count compute_sphere_sphere_hits_vectors(const SpherePairs& pairs, const SphereQuestion& question,
                                                std::uint32_t* index, const ContactRows& out) {
  return HWY_DYNAMIC_DISPATCH(compute_sphere_hits)(pairs, question, index, out);
}

bool vectors_compute_contacts() { return HWY_DYNAMIC_DISPATCH(computes_contacts)(); }

}  // namespace contact::kernel
#endif  // HWY_ONCE
