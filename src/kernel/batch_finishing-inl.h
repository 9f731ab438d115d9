// What the quick tests leave of a vector of pairs: decisions near touching, simple axes, numbers by their true bounds.
// What is not certain after that goes to the functions of one pair.
#if defined(CONTACT_KERNEL_BATCH_FINISHING_INL_H) == defined(HWY_TARGET_TOGGLE)  // once a target
#ifdef CONTACT_KERNEL_BATCH_FINISHING_INL_H
#undef CONTACT_KERNEL_BATCH_FINISHING_INL_H
#else
#define CONTACT_KERNEL_BATCH_FINISHING_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "contact/sphere_sphere.hpp"
#include "kernel/batch_near_touching-inl.h"
#include "kernel/sphere_sphere_numbers.hpp"

#if HWY_HAVE_FLOAT64 && HWY_NATIVE_FMA  // else nothing is here, and no attribute for it
HWY_BEFORE_NAMESPACE();
namespace contact::kernel {
namespace HWY_NAMESPACE {

/// What a call on contacts works on.
struct Job {
  SpherePairs pairs;
  ContactQuestion question;
  ContactRows out;
  std::size_t size;  ///< pairs[size..] are padding
  double sign1;      ///< point1 = c1 + sign1 r1 n
  double sign2;      ///< point2 = c2 + sign2 r2 n
  batch::Count count{};
  // Of each pair of a vector that is scaled.
  double alarms[kMostLanes] = {};
  double contacts[kMostLanes] = {};
};

/// What the vectors leave of a vector of pairs, as lanes: decisions, and numbers of hits by axis, and values.
struct LeftLanes {
  bool any = false;
  unsigned undecided = 0;
  unsigned uncertain[4] = {};
};

HWY_INLINE Delta delta_of(const Loaded& in) {
  return {two_difference(in.bx, in.ax), two_difference(in.by, in.ay), two_difference(in.bz, in.az)};
}

HWY_INLINE M coincide(const Delta& d) { return hn::Eq(largest_component(d), all(0)); }

/// reach in units of the scale. Where scaling up takes it out of the range it is a hit by far.
HWY_INLINE V scaled_reach(V r1, V r2, V alarm, V down) {
  return hn::Min(hn::MulAdd(alarm, down, hn::Add(hn::Mul(r1, down), hn::Mul(r2, down))), all(bounds::kReachCap));
}

/// What the filter compares with the length of delta, scaled.
template <bool kScaled, bool kExtent>
HWY_INLINE V reach_of(const Job& job, const Loaded& in, const Delta& d) {
  if constexpr (kScaled) return scaled_reach(in.ar, in.br, hn::LoadU(D(), job.alarms), scale_of(d).down);
  return hn::Add(kExtent ? hn::Add(in.ar, in.br) : in.ar, all(job.question.distances.alarm));
}

/// A vector of contacts as the fast stage leaves it; the numbers are in their rows, those of misses 0.
struct Stage {
  V d2;          ///< the squared length of delta, scaled, plainly
  V reciprocal;  ///< that of its root, within 2 u
  V qx, qy, qz, low_x, low_y, low_z;
  Double2 root;
  M hit;
  M miss;
  M in_range;     ///< hits with no number so small that a test of the others means nothing
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

/// A vector of pairs of which some number is not certain yet; what is not certain after that.
template <bool kScaled>
HWY_NOINLINE void finish(Job& job, std::size_t i, const Stage& stage, LeftLanes& left) {
  const Loaded in(job.pairs, i);
  const Delta d = delta_of(in);
  Delta unit = d;
  Scale scale{all(1), all(1)};
  if constexpr (kScaled) {
    scale = scale_of(d);
    unit = scaled(d, scale.down);
  }
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
  const V alarm = kScaled ? hn::LoadU(D(), job.alarms) : all(job.question.distances.alarm);
  const V contact = kScaled ? hn::LoadU(D(), job.contacts) : all(job.question.distances.contact);
  const Length less(in.ar, in.br, contact);
  ContactLanes numbers = ContactLanes::load(job.out, i);
  V value = numbers.value;
  const V uncancelled = hn::Add(stage.uncancelled, stage.uncancelled);  // of rounded numbers
  const M value_agrees = hn::And(stage.value_agrees, usable);
  M value_certain = hn::And(value_agrees, hn::Ge(hn::Abs(value), uncancelled));
  if (!hn::AllFalse(D(), coincident)) {  // value = -T
    value = hn::IfThenElse(coincident, hn::Sub(zero, less.rounded()), value);
    // Beyond the largest number the parts of T are no numbers.
    value_certain = hn::Or(value_certain, hn::And(coincident, hn::IsFinite(value)));
  }
  const bool same = job.question.distances.alarm == job.question.distances.contact;
  M undecided = hn::And(open, usable);
  if (!same && !hn::AllFalse(D(), undecided)) {
    const NearTouching touching(unit, stage.d2, d, scale.down, Length(in.ar, in.br, alarm));
    const M inside = hn::And(undecided, hn::Or(touching.zero, touching.negative()));
    hit = hn::Or(hit, inside);
    open = hn::AndNot(hn::Or(inside, hn::And(undecided, touching.positive())), open);
    undecided = hn::And(open, usable);
  }
  M wanting = hn::AndNot(value_certain, hn::And(usable, hn::Or(hit, undecided)));
  if (!hn::AllFalse(D(), wanting)) {
    const NearTouching touching(unit, stage.d2, d, scale.down, less);
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
  const auto left_of = [hit](M certain_lanes) HWY_ATTR { return bits_of(hn::AndNot(certain_lanes, hit)); };
  left = {true, bits_of(open), {left_of(x.certain), left_of(y.certain), left_of(z.certain), left_of(value_certain)}};
}

/// Puts what is left to the functions of one pair.
inline void settle(Job& job, std::size_t i, const LeftLanes& left) {
  const unsigned numbers = left.uncertain[0] | left.uncertain[1] | left.uncertain[2] | left.uncertain[3];
  const std::size_t lanes = std::min(hn::Lanes(D()), job.size - i);
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    if ((((left.undecided | numbers) >> lane) & 1) == 0) continue;
    ++job.count.exact;
    if (((left.undecided >> lane) & 1) == 0) {
      unsigned numbers_left = ((left.uncertain[3] >> lane) & 1) << kValueNumber;
      for (unsigned axis = 0; axis < 3; ++axis)
        numbers_left |= ((left.uncertain[axis] >> lane) & 1) * (kAxisNumbers << axis);
      round_numbers(job.pairs, job.question, i + lane, numbers_left, job.out);
      continue;
    }
    contact_of_one_pair(job.pairs, job.question, i + lane, job.out, i + lane);
    job.count.hits += job.out.state[i + lane] != batch::PairState::miss ? 1U : 0U;
  }
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
  filter(d2, scaled_reach(in.ar, in.br, all(alarm), scale.down), inside_filter, outside_filter);
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

}  // namespace HWY_NAMESPACE
}  // namespace contact::kernel
HWY_AFTER_NAMESPACE();
#endif  // HWY_HAVE_FLOAT64 && HWY_NATIVE_FMA

#endif  // once a target
