// Many pairs of boxes at once: exact decisions in vectors.
//
//   hit   on every axis and both ways   low <= high + alarm
//
// Rounding is monotone and a bound is a number that it leaves alone: low lies on the same side of the rounded sum as of
// the real one, or is equal to the rounded one. So the least of all (sum - low) decides by its sign, which a difference
// of two numbers always gets right, and where it is 0 the sum's error, which is a number, decides.
#ifndef HWY_TARGET_INCLUDE  // else one of those of batch_vectors.cpp
#define HWY_TARGET_INCLUDE "kernel/batch_cube_cube.cpp"
#endif
#include "kernel/batch_targets.hpp"
// foreach_target.h includes this file once a target, so it comes before the rest.
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "kernel/batch_columns-inl.h"

HWY_BEFORE_NAMESPACE();
namespace contact::kernel {
namespace HWY_NAMESPACE {

#if HWY_HAVE_FLOAT64

/// The least room that an axis leaves: negative where a bound lies beyond another and the alarm distance.
HWY_INLINE V room(const BoxPairs& pairs, std::size_t axis, std::size_t i, V alarm) {
  const D d;
  const V a_min = hn::LoadU(d, pairs.a[axis] + i);
  const V a_max = hn::LoadU(d, pairs.a[3 + axis] + i);
  const V b_min = hn::LoadU(d, pairs.b[axis] + i);
  const V b_max = hn::LoadU(d, pairs.b[3 + axis] + i);
  return hn::Min(hn::Sub(hn::Add(b_max, alarm), a_min), hn::Sub(hn::Add(a_max, alarm), b_min));
}

/// low <= high + alarm, exactly.
HWY_INLINE M within(V low, V high, V alarm) {
  const V sum = hn::Add(high, alarm);
  const V alarm_part = hn::Sub(sum, high);
  const V error = hn::Add(hn::Sub(high, hn::Sub(sum, alarm_part)), hn::Sub(alarm, alarm_part));  // Knuth's two_sum
  return hn::Or(hn::Lt(low, sum), hn::And(hn::Eq(low, sum), hn::Ge(error, hn::Zero(D()))));
}

/// A vector of pairs of which some leave no room: a bound equals a rounded sum.
HWY_NOINLINE void decide_with_errors(const BoxPairs& pairs, double alarm_distance, std::size_t i, std::uint8_t* hit) {
  const D d;
  const V alarm = hn::Set(d, alarm_distance);
  M hits = hn::Eq(alarm, alarm);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    hits = hn::And(hits, within(hn::LoadU(d, pairs.a[axis] + i), hn::LoadU(d, pairs.b[3 + axis] + i), alarm));
    hits = hn::And(hits, within(hn::LoadU(d, pairs.b[axis] + i), hn::LoadU(d, pairs.a[3 + axis] + i), alarm));
  }
  store_flags(hits, hit);
}

HWY_INLINE void decide(const BoxPairs& pairs, double alarm_distance, std::size_t i, std::uint8_t* hit) {
  const D d;
  const V alarm = hn::Set(d, alarm_distance);
  const V zero = hn::Zero(d);
  const V least = hn::Min(hn::Min(room(pairs, 0, i, alarm), room(pairs, 1, i, alarm)), room(pairs, 2, i, alarm));
  store_flags(hn::Ge(least, zero), hit);
  // Without an alarm distance the sums are exact, and equality is a hit.
  if (HWY_UNLIKELY(alarm_distance != 0 && !hn::AllTrue(d, hn::Ne(least, zero))))
    decide_with_errors(pairs, alarm_distance, i, hit);
}

batch::Count test_cubes(const BoxPairs& pairs, double alarm, std::uint8_t* hit) {
  batch::Count count;
  const std::size_t lanes = hn::Lanes(D());
  std::size_t i = 0;
  for (; i + lanes <= pairs.size; i += lanes) decide(pairs, alarm, i, hit + i);
  if (i < pairs.size) {
    const Padded last(pairs, i);
    std::uint8_t hits[kMostLanes];
    decide(last.pairs, alarm, 0, hits);
    std::copy_n(hits, last.count, hit + i);
  }
  for (i = 0; i < pairs.size; ++i) count.hits += hit[i];
  return count;
}

#else  // no vectors of doubles

batch::Count test_cubes(const BoxPairs& pairs, double alarm, std::uint8_t* hit) {
  return test_scalar(pairs, alarm, hit);
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace contact::kernel
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace contact::kernel {

HWY_EXPORT(test_cubes);

batch::Count test_vectors(const BoxPairs& pairs, double alarm, std::uint8_t* hit) {
  return HWY_DYNAMIC_DISPATCH(test_cubes)(pairs, alarm, hit);
}

}  // namespace contact::kernel
#endif  // HWY_ONCE
