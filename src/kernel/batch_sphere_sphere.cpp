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

HWY_BEFORE_NAMESPACE();
namespace contact::kernel {
namespace HWY_NAMESPACE {

#if HWY_HAVE_FLOAT64

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<double>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

constexpr std::size_t kMostLanes = HWY_MAX_BYTES / sizeof(double);

HWY_INLINE V all(double x) { return hn::Set(D(), x); }

/// Whether D and reach^2 differ by more than plain arithmetic may err.
struct Filter {
  M hit;
  M miss;

  HWY_INLINE Filter(V d2, V reach) {
    const V reach2 = hn::Mul(reach, reach);
    const V sum = hn::Add(d2, reach2);
    const V difference = hn::Sub(d2, reach2);
    const V gap = hn::Add(hn::Mul(sum, all(bounds::kFilterGap)), all(bounds::kFilterFloor));
    hit = hn::Lt(difference, hn::Neg(gap));
    miss = hn::Gt(difference, gap);
  }
};

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

/// high + low, unevaluated.
struct Double2 {
  V high;
  V low;
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

/// high + low rounded, and in `certain` whether an error of eta 2^-55 |high| could change it.
HWY_INLINE V rounded(V high, V low, double eta, M& certain) {
  const V above = hn::MulAdd(low, all(1 + eta), high);
  certain = hn::And(certain, hn::Eq(above, hn::MulAdd(low, all(1 - eta), high)));
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
  const V w_low = hn::MulAdd(radius, low, hn::MulSub(radius, q, w));
  const Double2 sum = two_sum(center, w);
  return {sum.high, hn::Add(sum.low, w_low)};
}

/// The ten numbers of contacts.
struct Numbers {
  V nx, ny, nz, px, py, pz, rx, ry, rz, value;

  HWY_INLINE void store(const ContactRows& out, std::size_t i, M hit) const {
    const D d;
    hn::StoreU(hn::IfThenElseZero(hit, nx), d, out.number[0] + i);
    hn::StoreU(hn::IfThenElseZero(hit, ny), d, out.number[1] + i);
    hn::StoreU(hn::IfThenElseZero(hit, nz), d, out.number[2] + i);
    hn::StoreU(hn::IfThenElseZero(hit, px), d, out.number[3] + i);
    hn::StoreU(hn::IfThenElseZero(hit, py), d, out.number[4] + i);
    hn::StoreU(hn::IfThenElseZero(hit, pz), d, out.number[5] + i);
    hn::StoreU(hn::IfThenElseZero(hit, rx), d, out.number[6] + i);
    hn::StoreU(hn::IfThenElseZero(hit, ry), d, out.number[7] + i);
    hn::StoreU(hn::IfThenElseZero(hit, rz), d, out.number[8] + i);
    hn::StoreU(hn::IfThenElseZero(hit, value), d, out.number[9] + i);
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
};

/// What the near path accumulates on two fixed grids and, below them, plainly.
struct Grids {
  V first;   ///< 6 * 2^k: a sum with it rounds to whole numbers of 2^(k-50)
  V second;  ///< 1.5 * 2^(k-46): to whole numbers of 2^(k-98)
  V leading = all(0);
  V middle = all(0);
  V rest = all(0);
  V inexact = all(0);  ///< the sum of what is not on the grids, as magnitudes

  HWY_INLINE explicit Grids(V power) : first(hn::Mul(power, all(6))), second(hn::Mul(power, all(0x1.8p-46))) {}

  HWY_INLINE void add_rest(V x) {
    rest = hn::Add(rest, x);
    inexact = hn::Add(inexact, hn::Abs(x));
  }
  HWY_INLINE void add_middle(V x) {
    const V on_grid = hn::Sub(hn::Add(x, second), second);
    middle = hn::Add(middle, on_grid);
    add_rest(hn::Sub(x, on_grid));
  }
  /// sign (high + low)^2, sign being 1 or -1: high^2 is the leading part, 2 high low of the first order.
  HWY_INLINE void add_square(V high, V low, V sign) {
    const V square = hn::Mul(high, high);
    const V on_grid = hn::Sub(hn::Add(square, first), first);
    leading = hn::MulAdd(on_grid, sign, leading);
    add_middle(hn::Mul(hn::Sub(square, on_grid), sign));
    add_middle(hn::Mul(hn::MulSub(high, high, square), sign));
    const V twice = hn::Mul(hn::Add(high, high), sign);
    const V cross = hn::Sub(hn::MulAdd(twice, low, second), second);
    middle = hn::Add(middle, cross);
    add_rest(hn::MulSub(twice, low, cross));
    add_rest(hn::Mul(hn::Mul(low, low), sign));
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

  HWY_INLINE NearTouching(const Delta& d, const Scale& scale, V d2, const Length& length) {
    const Delta unit = scaled(d, scale.down);
    length_high = hn::Mul(length.high, scale.down);
    length_low = hn::Mul(length.low, scale.down);
    const V tail = hn::Mul(length.tail, scale.down);
    const V power = power_of_two(d2);
    near = hn::And(hn::Le(hn::Abs(hn::NegMulAdd(length_high, length_high, d2)), hn::Mul(d2, all(bounds::kNear))),
                   hn::And(hn::Ge(d2, all(bounds::kLeast)), hn::Le(d2, all(bounds::kMost))));
    Grids grids(power);
    grids.add_square(unit.x.high, unit.x.low, all(1));
    grids.add_square(unit.y.high, unit.y.low, all(1));
    grids.add_square(unit.z.high, unit.z.low, all(1));
    grids.add_square(length_high, length_low, all(-1));
    grids.add_rest(hn::Mul(hn::Add(length_high, length_high), hn::Neg(tail)));
    const Double2 upper = two_sum(grids.leading, grids.middle);
    const Double2 sum = two_sum(upper.high, grids.rest);
    difference = {sum.high, hn::Add(upper.low, sum.low)};
    error = hn::Mul(power, all(bounds::kNearError));
    const M exact =
        hn::And(hn::And(hn::And(hn::And(proper_factor(unit.x.high, d.x.high), proper_factor(unit.x.low, d.x.low)),
                                hn::And(proper_factor(unit.y.high, d.y.high), proper_factor(unit.y.low, d.y.low))),
                        hn::And(proper_factor(unit.z.high, d.z.high), proper_factor(unit.z.low, d.z.low))),
                hn::And(hn::And(proper_factor(length_low, length.low), hn::Eq(length.tail, all(0))),
                        hn::Eq(grids.inexact, all(0))));
    zero = hn::And(hn::And(near, exact), hn::Eq(upper.high, all(0)));
  }

  [[nodiscard]] HWY_INLINE M negative() const {
    return hn::And(near, hn::Lt(hn::Add(difference.high, hn::Add(error, error)), all(0)));
  }
  [[nodiscard]] HWY_INLINE M positive() const {
    return hn::And(near, hn::Gt(hn::Sub(difference.high, hn::Add(error, error)), all(0)));
  }

  /// E / (s + length), times scale.up; `root` is s before it was multiplied by scale.up.
  HWY_INLINE V value(const Double2& root, V up, M& certain) const {
    const Double2 sum = two_sum(root.high, length_high);
    const V sum_low = hn::Add(sum.low, hn::Add(root.low, length_low));
    const V quotient = hn::Div(difference.high, sum.high);
    const V remainder = hn::NegMulAdd(quotient, sum.high, difference.high);
    const V low = hn::Div(hn::Add(remainder, hn::NegMulAdd(quotient, sum_low, difference.low)), sum.high);
    const V relative = hn::Mul(hn::Abs(quotient), all(bounds::kQuotientError));
    const V spread = hn::Div(hn::Add(error, error), sum.high);
    M agree;
    const V result = hn::Mul(rounded_within(quotient, low, hn::Add(relative, spread), agree), up);
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

/// Decides lanes that the filter leaves open.
HWY_INLINE void settle(const Delta& d, const Scale& scale, V d2, const Length& reach, M& hit, M& open) {
  const NearTouching touching(d, scale, d2, reach);
  const M inside = hn::Or(touching.zero, touching.negative());
  hit = hn::Or(hit, hn::And(open, inside));
  open = hn::AndNot(hn::Or(inside, touching.positive()), open);
}

/// One coordinate of a point, by whatever is certain.
struct Coordinate {
  V number;
  M certain;

  HWY_INLINE Coordinate(V center, V signed_radius, V q, V low, V d_high, M only_axis) {
    const V w = hn::Abs(hn::Mul(signed_radius, q));
    const Double2 sum = point(center, signed_radius, q, low);
    const V high = hn::Abs(sum.high);
    const V error = hn::MulAdd(w, all(bounds::kPointError), hn::Mul(high, all(bounds::kPointSumError)));
    number = rounded_within(sum.high, sum.low, error, certain);
    const V magnitude = hn::Max(high, w);
    certain = hn::And(certain, hn::And(hn::Ge(magnitude, all(bounds::kLeast)), hn::Le(magnitude, all(bounds::kMost))));
    // r n is 0, or +-r where the other components of delta are 0: one sum, rounded once.
    const M nothing = hn::Or(hn::Eq(signed_radius, all(0)), hn::Eq(d_high, all(0)));
    const V whole = hn::Xor(signed_radius, hn::And(d_high, all(-0.0)));
    const V plain = hn::Add(center, hn::IfThenZeroElse(nothing, whole));
    const M exact = hn::Or(nothing, only_axis);
    number = hn::IfThenElse(exact, plain, number);
    certain = hn::Or(certain, exact);
  }
};

/// A vector of pairs of which some number is not certain yet: interval tests with the true bounds, the near path, and
/// pairs whose answers are simple. What is not certain after that goes to the scalar function.
template <bool kScaled>
HWY_NOINLINE void finish(Job& job, std::size_t i) {
  const Loaded in(job.pairs, i);
  const Delta d = delta_of(in);
  const V zero = all(0);
  Scale scale{all(1), all(1)};
  if constexpr (kScaled) scale = scale_of(d);
  const Delta unit = scaled(d, scale.down);
  const V d2 = squared_length(unit.x.high, unit.y.high, unit.z.high);
  const M coincident = coincide(d);
  M usable = hn::And(hn::Ge(d2, all(bounds::kLeast)), hn::Le(d2, all(bounds::kMost)));
  if constexpr (kScaled) usable = hn::And(usable, hn::Lt(largest_component(d), all(bounds::kMost)));

  const double alarm = job.question.distances.alarm;
  const double contact = job.question.distances.contact;
  V reach = hn::Add(hn::Add(in.ar, in.br), all(alarm));
  if constexpr (kScaled) reach = scaled_reach(in.ar, in.br, alarm, scale.down);
  const Filter filter(d2, reach);
  M hit = filter.hit;
  M open = hn::Not(hn::Or(filter.hit, filter.miss));
  if constexpr (kScaled) {
    // Delta overflowed, or is too large to be scaled: nothing above means anything.
    const M lost = hn::Not(hn::Or(usable, coincident));
    hit = hn::AndNot(lost, hit);
    open = hn::Or(open, lost);
  }
  hit = hn::Or(hit, coincident);
  open = hn::AndNot(coincident, open);

  const Direction n(unit, d2);
  const Length less(in.ar, in.br, all(contact));
  Double2 root = n.root;
  if constexpr (kScaled) root = scaled(root, scale.up);
  const Double2 sum = two_difference(root.high, less.high);
  const V magnitude = hn::Abs(sum.high);
  M value_certain;
  V value = rounded_within(sum.high, hn::Add(sum.low, hn::Sub(root.low, less.low)),
                           hn::Mul(hn::Add(root.high, less.high), all(bounds::kValueError)), value_certain);
  value_certain =
      hn::And(value_certain, hn::And(hn::Ge(magnitude, all(bounds::kLeast)), hn::Le(magnitude, all(bounds::kMost))));
  value_certain = hn::And(value_certain, usable);

  const bool same = alarm == contact;
  const M undecided = hn::And(open, usable);
  if (!same && !hn::AllFalse(D(), undecided)) {
    M settled = undecided;
    settle(d, scale, d2, Length(in.ar, in.br, all(alarm)), hit, settled);
    open = hn::Or(hn::AndNot(usable, open), settled);
  }
  const M wanting = hn::AndNot(value_certain, hn::And(usable, hn::Or(hit, open)));
  if (!hn::AllFalse(D(), wanting)) {
    const NearTouching touching(d, scale, d2, less);
    if (same) {
      const M inside = hn::And(undecided, hn::Or(touching.zero, touching.negative()));
      hit = hn::Or(hit, inside);
      open = hn::AndNot(hn::Or(inside, hn::And(undecided, touching.positive())), open);
    }
    M certain;
    const V near_value = touching.value(n.root, scale.up, certain);
    certain = hn::And(certain, wanting);
    value = hn::IfThenElse(certain, near_value, value);
    value_certain = hn::Or(value_certain, certain);
  }

  // Where two components of delta are 0 the normal is that axis.
  const M no_x = hn::Eq(d.x.high, zero);
  const M no_y = hn::Eq(d.y.high, zero);
  const M no_z = hn::Eq(d.z.high, zero);
  const M only_x = hn::And(no_y, no_z);  // coincident centres too
  const M only_y = hn::AndNot(no_y, hn::And(no_x, no_z));
  const M only_z = hn::AndNot(no_z, hn::And(no_x, no_y));
  const V along_x = hn::IfThenElse(coincident, all(1), d.x.high);

  Numbers numbers;
  const auto component = [](V q, V low, V d_high, M only_axis, M& certain) HWY_ATTR {
    M agree = hn::Ge(hn::Abs(q), all(bounds::kLeast));
    const V number = rounded(q, low, bounds::kNormalEta, agree);
    const M none = hn::Eq(d_high, all(0));
    certain = hn::And(certain, hn::Or(hn::Or(none, only_axis), agree));
    return hn::IfThenElse(only_axis, hn::CopySign(all(1), d_high), hn::IfThenZeroElse(none, number));
  };
  M certain = hn::Or(usable, hn::Or(only_x, hn::Or(only_y, only_z)));
  numbers.nx = component(n.qx, n.low_x, along_x, only_x, certain);
  numbers.ny = component(n.qy, n.low_y, d.y.high, only_y, certain);
  numbers.nz = component(n.qz, n.low_z, d.z.high, only_z, certain);
  const V radius1 = hn::Mul(in.ar, all(job.sign1));
  const V radius2 = hn::Mul(in.br, all(job.sign2));
  const auto coordinate = [&certain](V center, V radius, V q, V low, V d_high, M only_axis) HWY_ATTR {
    const Coordinate c(center, radius, q, low, d_high, only_axis);
    certain = hn::And(certain, c.certain);
    return hn::Add(c.number, all(0));  // every zero is +0
  };
  numbers.px = coordinate(in.ax, radius1, n.qx, n.low_x, along_x, only_x);
  numbers.py = coordinate(in.ay, radius1, n.qy, n.low_y, d.y.high, only_y);
  numbers.pz = coordinate(in.az, radius1, n.qz, n.low_z, d.z.high, only_z);
  numbers.rx = coordinate(in.bx, radius2, n.qx, n.low_x, along_x, only_x);
  numbers.ry = coordinate(in.by, radius2, n.qy, n.low_y, d.y.high, only_y);
  numbers.rz = coordinate(in.bz, radius2, n.qz, n.low_z, d.z.high, only_z);
  // Coincident: value = -T, one rounding where T is a sum of two numbers.
  const V minus_less = hn::Sub(zero, hn::Add(less.high, less.low));
  numbers.value = hn::IfThenElse(coincident, minus_less, value);
  value_certain = hn::Or(hn::AndNot(coincident, value_certain), hn::And(coincident, hn::Eq(less.tail, zero)));

  numbers.store(job.out, i, hit);
  store_states(hit, coincident, job.out.state + i);
  const unsigned left = bits_of(hn::Or(open, hn::AndNot(hn::And(certain, value_certain), hit)));
  job.count.hits += hn::CountTrue(D(), hit);
  if (left == 0) return;
  const unsigned hits = bits_of(hit);
  for (std::size_t lane = 0; lane < hn::Lanes(D()) && i + lane < job.size; ++lane) {
    if (((left >> lane) & 1) == 0) continue;
    contact_of_one_pair(job.pairs, job.question, i + lane, job.out, i + lane);
    ++job.count.exact;
    job.count.hits += (job.out.state[i + lane] != batch::PairState::miss ? 1U : 0U) - ((hits >> lane) & 1);
  }
}

/// The contacts of a vector of pairs. False, and nothing written, where one needs to be scaled first.
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
  const Filter filter(d2, reach);

  Numbers numbers;
  const Direction n(unit, d2);
  const V least = all(bounds::kLeast);
  M good = hn::And(hn::Ge(d2, least), hn::Ge(hn::Min(hn::Min(hn::Abs(n.qx), hn::Abs(n.qy)), hn::Abs(n.qz)), least));
  numbers.nx = rounded(n.qx, n.low_x, bounds::kNormalEta, good);
  numbers.ny = rounded(n.qy, n.low_y, bounds::kNormalEta, good);
  numbers.nz = rounded(n.qz, n.low_z, bounds::kNormalEta, good);

  const V share = all(bounds::kUncancelled);
  const auto points = [&](V cx, V cy, V cz, V radius, V& px, V& py, V& pz) HWY_ATTR {
    const Double2 x = point(cx, radius, n.qx, n.low_x);
    const Double2 y = point(cy, radius, n.qy, n.low_y);
    const Double2 z = point(cz, radius, n.qz, n.low_z);
    const V smallest = hn::Min(hn::Min(hn::Abs(x.high), hn::Abs(y.high)), hn::Abs(z.high));
    good = hn::And(good, hn::Ge(smallest, hn::Max(hn::Abs(hn::Mul(radius, share)), least)));
    px = rounded(x.high, x.low, bounds::kSumEta, good);
    py = rounded(y.high, y.low, bounds::kSumEta, good);
    pz = rounded(z.high, z.low, bounds::kSumEta, good);
  };
  points(in.ax, in.ay, in.az, hn::Mul(in.ar, all(job.sign1)), numbers.px, numbers.py, numbers.pz);
  points(in.bx, in.by, in.bz, hn::Mul(in.br, all(job.sign2)), numbers.rx, numbers.ry, numbers.rz);

  Double2 root = n.root;
  if constexpr (kScaled) root = scaled(root, scale.up);
  const Double2 less = two_sum(radii.high, all(job.question.distances.contact));
  const Double2 sum = two_difference(root.high, less.high);
  const V sum_low = hn::Add(sum.low, hn::Sub(root.low, hn::Add(less.low, radii.low)));
  good = hn::And(good, hn::Ge(hn::Abs(sum.high), hn::Max(hn::Mul(hn::Add(root.high, less.high), share), least)));
  numbers.value = rounded(sum.high, sum_low, bounds::kSumEta, good);

  if (HWY_LIKELY(hn::AllTrue(D(), hn::Or(filter.miss, hn::And(filter.hit, good))))) {
    numbers.store(job.out, i, filter.hit);
    store_flags(filter.hit, reinterpret_cast<std::uint8_t*>(job.out.state + i));
    job.count.hits += hn::CountTrue(D(), filter.hit);
    return true;
  }
  if constexpr (!kScaled) {
    const V most = all(bounds::kMost);
    const M in_range = hn::And(hn::Ge(d2, least), hn::Le(hn::MulAdd(reach, reach, d2), most));
    if (!hn::AllTrue(D(), hn::Or(hn::Or(filter.miss, in_range), coincide(d)))) return false;
  }
  finish<kScaled>(job, i);
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
  const D d;
  const hn::RebindToUnsigned<D> words;
  const std::size_t lanes = hn::Lanes(d);
  constexpr std::size_t kRoom = kStrip + kMostLanes;
  HWY_ALIGN double kept[8][kRoom];
  HWY_ALIGN std::uint64_t kept_index[kRoom];
  batch::Count count;
  for (std::size_t begin = 0; begin < pairs.size; begin += kStrip) {
    const std::size_t end = std::min(begin + kStrip, pairs.size);
    std::size_t k = 0;
    std::size_t i = begin;
    for (; i + lanes <= end; i += lanes) {
      const Loaded in(pairs, i);
      const V d2 = squared_length(hn::Sub(in.bx, in.ax), hn::Sub(in.by, in.ay), hn::Sub(in.bz, in.az));
      const V reach = hn::Add(hn::Add(in.ar, in.br), all(question.distances.alarm));
      const M keep = hn::Not(Filter(d2, reach).miss);
      hn::CompressStore(in.ax, keep, d, kept[0] + k);
      hn::CompressStore(in.ay, keep, d, kept[1] + k);
      hn::CompressStore(in.az, keep, d, kept[2] + k);
      hn::CompressStore(in.ar, keep, d, kept[3] + k);
      hn::CompressStore(in.bx, keep, d, kept[4] + k);
      hn::CompressStore(in.by, keep, d, kept[5] + k);
      hn::CompressStore(in.bz, keep, d, kept[6] + k);
      hn::CompressStore(in.br, keep, d, kept[7] + k);
      k += hn::CompressStore(hn::Iota(words, i), hn::RebindMask(words, keep), words, kept_index + k);
    }
    for (; i < end; ++i, ++k) {
      for (std::size_t column = 0; column < 4; ++column) {
        kept[column][k] = pairs.a[column][i];
        kept[4 + column][k] = pairs.b[column][i];
      }
      kept_index[k] = i;
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
      index[count.hits + row++] = static_cast<std::uint32_t>(kept_index[from]);
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
  const Filter filter(d2, scaled_reach(in.ar, in.br, alarm, scale.down));
  const M coincident = coincide(d);
  const M usable = hn::And(hn::Lt(largest_component(d), all(bounds::kMost)), hn::Ge(d2, all(bounds::kLeast)));
  M hits = hn::Or(coincident, hn::And(usable, filter.hit));
  M open = hn::AndNot(hn::Or(hits, hn::And(usable, filter.miss)), hn::Eq(all(0), all(0)));
  M near = hn::And(open, usable);
  open = hn::AndNot(usable, open);
  settle(d, scale, d2, Length(in.ar, in.br, all(alarm)), hits, near);
  store_flags(hits, hit);
  const unsigned left = bits_of(hn::Or(open, near));
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
  const Filter filter(d2, hn::Add(hn::Add(in.ar, in.br), all(alarm)));
  const M decided = hn::Or(filter.hit, filter.miss);
  store_flags(filter.hit, hit);
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

}  // namespace HWY_NAMESPACE
}  // namespace contact::kernel
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace contact::kernel {

HWY_EXPORT(test_spheres);
HWY_EXPORT(compute_spheres);
HWY_EXPORT(compute_sphere_hits);

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

}  // namespace contact::kernel
#endif  // HWY_ONCE
