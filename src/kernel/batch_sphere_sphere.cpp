// Many pairs of balls at once: filter, double-double arithmetic and rounding test in vectors. What they leave goes to
// the functions of one pair.
//
// batch_columns-inl.h            vectors of pairs out of columns, and of numbers into them
// sphere_sphere_formula-inl.h    direction, points, value and what they round to
// batch_arithmetic-inl.h         its lanes, the filter, scales
// batch_near_touching-inl.h      D - T^2 without cancellation
// batch_finishing-inl.h          what the quick tests leave
// batch_lifted-inl.h             pairs far from 1 in units of their own
// batch_balls-inl.h              the hits alone
// here                           the quick tests, loops over columns, and the choice of an instruction set
#ifndef HWY_TARGET_INCLUDE  // else one of those of batch_vectors.cpp
#define HWY_TARGET_INCLUDE "kernel/batch_sphere_sphere.cpp"
#endif
#include "kernel/batch_targets.hpp"
// foreach_target.h includes this file once a target, so it comes before the rest.
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "contact/sphere_sphere.hpp"
#include "kernel/batch.hpp"
#include "kernel/batch_finishing-inl.h"
#include "kernel/batch_lifted-inl.h"

HWY_BEFORE_NAMESPACE();
namespace contact::kernel {
namespace HWY_NAMESPACE {

#if HWY_HAVE_FLOAT64

#if HWY_NATIVE_FMA

// A vector of contacts is computed in three parts, whose steps wait for one another. A loop does each part of several
// vectors before the next one, so that a processor computes one vector while another waits. Without kExtent the second
// balls are points.

/// First: the decision, and the root.
template <bool kScaled, bool kExtent>
HWY_INLINE void roots_of_vector(const Job& job, const SpherePairs& pairs, std::size_t i, Stage& stage) {
  const Loaded in(pairs, i);
  const Delta d = delta_of(in);
  Delta unit = d;
  if constexpr (kScaled) unit = scaled(d, scale_of(d).down);
  const V d2 = squared_length(unit.x.high, unit.y.high, unit.z.high);
  M hit;
  M miss;
  filter(d2, reach_of<kScaled, kExtent>(job, in, d), hit, miss);
  stage.d2 = d2;
  stage.reciprocal = reciprocal_root(d2);
  stage.hit = hit;
  stage.miss = miss;
}

/// Second: normal and length.
template <bool kScaled>
HWY_INLINE void directions_of_vector(const SpherePairs& pairs, const ContactRows& out, std::size_t i, Stage& stage) {
  const Loaded in(pairs, i);
  const Delta d = delta_of(in);
  Delta unit = d;
  if constexpr (kScaled) unit = scaled(d, scale_of(d).down);
  const Direction n(unit, stage.d2, stage.reciprocal);
  const M wanted = hn::Not(stage.miss);
  M x_agrees = wanted;  // three masks, and not one that each comparison waits for
  M y_agrees = wanted;
  M z_agrees = wanted;
  const auto write = [&](std::size_t k, V number) HWY_ATTR { hn::StoreU(number, D(), out.number[k] + i); };
  write(0, rounded(n.q.x, n.low.x, bounds::kNormalEta, wanted, x_agrees));
  write(1, rounded(n.q.y, n.low.y, bounds::kNormalEta, wanted, y_agrees));
  write(2, rounded(n.q.z, n.low.z, bounds::kNormalEta, wanted, z_agrees));
  // A component that is 0 is exactly so, and what follows from it.
  const auto if_any = [](V q, V delta) HWY_ATTR { return hn::IfThenElse(hn::Eq(delta, all(0)), all(1), q); };
  const V component =
      lesser_magnitude(least_magnitude(if_any(n.q.x, d.x.high), if_any(n.q.y, d.y.high)), if_any(n.q.z, d.z.high));

  // Member by member: a copy of the whole would be made in memory first.
  stage.qx = n.q.x;
  stage.qy = n.q.y;
  stage.qz = n.q.z;
  stage.low_x = n.low.x;
  stage.low_y = n.low.y;
  stage.low_z = n.low.z;
  stage.root.high = n.root.high;
  stage.root.low = n.root.low;
  stage.axes_agree = hn::And(hn::And(x_agrees, y_agrees), z_agrees);
  stage.in_range =
      and_at_least(and_at_least(stage.hit, stage.d2, all(bounds::kLeast)), component, all(bounds::kLeastComponent));
}

/// Third: points and value, and what the vectors leave. False, and nothing that counts written, where a pair needs to be
/// scaled first.
template <bool kScaled, bool kExtent>
HWY_INLINE bool points_of_vector(Job& job, const SpherePairs& pairs, const ContactRows& out, std::size_t i,
                                 const Stage& stage, LeftLanes& left_over) {
  const Loaded in(pairs, i);
  Double2 radii{in.ar, all(0)};
  if constexpr (kExtent) radii = two_sum(in.ar, in.br);
  Double2 root{stage.root.high, stage.root.low};
  if constexpr (kScaled) root = scaled(root, scale_of(delta_of(in)).up);
  const Less less(radii, kScaled ? hn::LoadU(D(), job.contacts) : all(job.question.distances.contact));
  const V uncancelled = uncancelled_share(root, less);
  const M hit = stage.hit;
  const M miss = stage.miss;

  // Written as they come, and again where they do not hold: there are too few registers to keep them.
  const auto write = [&](std::size_t k, V number) HWY_ATTR { hn::StoreU(number, D(), out.number[k] + i); };
  const M wanted = hn::Not(miss);
  M first_agrees = stage.axes_agree;
  M second_agrees = wanted;
  M value_agrees = wanted;
  const Double2 value = value_of(root, less);
  write(9, rounded(value.high, value.low, bounds::kSumEta, wanted, value_agrees));
  V left = hn::Abs(value.high);  // the least that cancellation has left of a point or the value
  const auto rounded_point = [&](V center, V radius, V q, V low, M& agrees) HWY_ATTR {
    const Double2 at = point(center, radius, q, low);
    left = lesser_magnitude(left, at.high);
    return rounded(at.high, at.low, bounds::kSumEta, wanted, agrees);
  };
  const V radius1 = hn::Mul(in.ar, all(job.sign1));
  [[maybe_unused]] const V radius2 = hn::Mul(in.br, all(job.sign2));
  write(3, rounded_point(in.ax, radius1, stage.qx, stage.low_x, first_agrees));
  write(4, rounded_point(in.ay, radius1, stage.qy, stage.low_y, first_agrees));
  write(5, rounded_point(in.az, radius1, stage.qz, stage.low_z, first_agrees));
  if constexpr (kExtent) {
    write(6, rounded_point(in.bx, radius2, stage.qx, stage.low_x, second_agrees));
    write(7, rounded_point(in.by, radius2, stage.qy, stage.low_y, second_agrees));
    write(8, rounded_point(in.bz, radius2, stage.qz, stage.low_z, second_agrees));
  } else {
    const auto center = [&](V x) HWY_ATTR { return hn::IfThenElseZero(wanted, hn::Add(x, all(0))); };  // 0 is +0
    write(6, center(in.bx));
    write(7, center(in.by));
    write(8, center(in.bz));
  }

  const M axes_agree = hn::And(first_agrees, second_agrees);
  M good = hn::And(hn::And(hit, axes_agree), value_agrees);
  good = and_at_least(good, left, uncancelled);
  good = hn::And(good, stage.in_range);
  if (HWY_LIKELY(hn::AllTrue(D(), hn::Or(miss, good)))) {
    store_flags(hit, reinterpret_cast<std::uint8_t*>(out.state + i));
    job.count.hits += hn::CountTrue(D(), hit);
    return true;
  }
  if constexpr (!kScaled) {
    const Delta d = delta_of(in);
    const V reach = reach_of<kScaled, kExtent>(job, in, d);
    const V most = all(bounds::kMost);
    const M in_range = hn::And(hn::Ge(stage.d2, all(bounds::kLeast)), hn::Le(hn::MulAdd(reach, reach, stage.d2), most));
    if (!hn::AllTrue(D(), hn::Or(hn::Or(miss, in_range), coincide(d)))) return false;
  }
  // Member by member: what goes to another function by itself would be kept in memory on the quick way too.
  Stage rest;
  rest.d2 = stage.d2;
  rest.qx = stage.qx;
  rest.qy = stage.qy;
  rest.qz = stage.qz;
  rest.low_x = stage.low_x;
  rest.low_y = stage.low_y;
  rest.low_z = stage.low_z;
  rest.root.high = stage.root.high;
  rest.root.low = stage.root.low;
  rest.hit = hit;
  rest.miss = miss;
  rest.uncancelled = uncancelled;
  rest.axes_agree = axes_agree;
  rest.value_agrees = value_agrees;
  finish<kScaled>(job, i, rest, left_over);
  return true;
}

/// The contacts of a vector of pairs in units of their deltas.
template <bool kExtent>
HWY_NOINLINE void contacts_of_scaled_vector(Job& job, std::size_t i, LeftLanes& left) {
  Stage stage;
  roots_of_vector<true, kExtent>(job, job.pairs, i, stage);
  directions_of_vector<true>(job.pairs, job.out, i, stage);
  points_of_vector<true, kExtent>(job, job.pairs, job.out, i, stage, left);
}

/// The same of pairs far from 1, in units of their own.
template <bool kExtent>
HWY_NOINLINE void contacts_of_lifted_vector(Job& job, std::size_t i) {
  const Lifted lifted(job.pairs, i, job.question.distances);
  HWY_ALIGN double numbers[ContactRows::kNumbers][kMostLanes];
  batch::PairState states[kMostLanes];
  ContactRows rows{};
  for (std::size_t k = 0; k < ContactRows::kNumbers; ++k) rows.number[k] = numbers[k];
  rows.state = states;
  const std::size_t lanes = hn::Lanes(D());
  Job own{lifted.pairs(), job.question, rows, kMostLanes, job.sign1, job.sign2};
  std::copy_n(lifted.number[8], lanes, own.alarms);
  std::copy_n(lifted.number[9], lanes, own.contacts);
  LeftLanes left;
  contacts_of_scaled_vector<kExtent>(own, 0, left);
  job.count.hits += own.count.hits;

  left.any = true;
  left.undecided |= lifted.left;
  for (std::size_t k = 0; k < ContactRows::kNumbers; ++k) {
    if (k >= kPointNumber) {
      const unsigned outside = lifted.lower(numbers[k]);
      left.uncertain[k < kValueNumber ? k % 3 : 3] |= outside;
    }
    std::copy_n(numbers[k], lanes, job.out.number[k] + i);
  }
  std::copy_n(states, lanes, job.out.state + i);
  settle(job, i, left);
}

/// How many pairs go unscaled again before a pair that had to be scaled is forgotten.
constexpr std::size_t kStrip = 256;
/// How many vectors have one part done before the next. With AVX-512 more than one at a time are slower from memory.
constexpr std::size_t kBlock = HWY_TARGET <= HWY_AVX3 ? 1 : 8;

/// A vector with a pair that has to be scaled.
template <bool kExtent>
HWY_NOINLINE void contacts_of_far_vector(Job& job, std::size_t i) {
  if (Lifted::is_far_from_1(job.pairs, i, job.question.distances)) {
    contacts_of_lifted_vector<kExtent>(job, i);
    return;
  }
  LeftLanes left;
  contacts_of_scaled_vector<kExtent>(job, i, left);
  if (left.any) settle(job, i, left);
}

template <bool kExtent>
HWY_INLINE void contacts_of_whole_vectors(Job& job, std::size_t end) {
  const std::size_t lanes = hn::Lanes(D());
  std::fill_n(job.alarms, kMostLanes, job.question.distances.alarm);
  std::fill_n(job.contacts, kMostLanes, job.question.distances.contact);
  const SpherePairs pairs = job.pairs;
  const ContactRows out = job.out;
  for (std::size_t strip = 0; strip < end; strip += kStrip) {
    const std::size_t strip_end = std::min(end, strip + kStrip);
    bool scale = false;
    for (std::size_t block = strip; block < strip_end; block += kBlock * lanes) {
      const std::size_t vectors = std::min(kBlock, (strip_end - block + lanes - 1) / lanes);
      Stage stages[kBlock];
      for (std::size_t k = 0; k < kBlock && k < vectors && !scale; ++k)
        roots_of_vector<false, kExtent>(job, pairs, block + k * lanes, stages[k]);
      for (std::size_t k = 0; k < kBlock && k < vectors && !scale; ++k)
        directions_of_vector<false>(pairs, out, block + k * lanes, stages[k]);
      for (std::size_t k = 0; k < kBlock && k < vectors; ++k) {
        const std::size_t i = block + k * lanes;
        LeftLanes left;
        scale = scale || !points_of_vector<false, kExtent>(job, pairs, out, i, stages[k], left);
        if (scale)
          contacts_of_far_vector<kExtent>(job, i);
        else if (left.any)
          settle(job, i, left);
      }
    }
  }
}

HWY_INLINE Job job_of(const SpherePairs& pairs, const ContactQuestion& question, const ContactRows& out) {
  return {pairs, question, out, pairs.size, sign_of(question.points.first, 1), sign_of(question.points.second, -1)};
}

batch::Count compute_spheres(const SpherePairs& pairs, const ContactQuestion& question, const ContactRows& out) {
  Job job = job_of(pairs, question, out);
  const std::size_t whole = pairs.size - pairs.size % hn::Lanes(D());
  contacts_of_whole_vectors<true>(job, whole);
  if (whole == pairs.size) return job.count;

  const Padded last(pairs, whole);
  double numbers[ContactRows::kNumbers][kMostLanes];
  batch::PairState states[kMostLanes];
  ContactRows rows{};
  for (std::size_t k = 0; k < ContactRows::kNumbers; ++k) rows.number[k] = numbers[k];
  rows.state = states;
  Job rest{last.pairs, question, rows, last.count, job.sign1, job.sign2};
  contacts_of_whole_vectors<true>(rest, 1);
  job.count.exact += rest.count.exact;
  for (std::size_t lane = 0; lane < last.count; ++lane) {
    for (std::size_t k = 0; k < ContactRows::kNumbers; ++k) out.number[k][whole + lane] = numbers[k][lane];
    out.state[whole + lane] = states[lane];
    job.count.hits += states[lane] != batch::PairState::miss ? 1U : 0U;
  }
  return job.count;
}

// As batch_balls-inl.h declares them.
template <bool kExtent>
HWY_INLINE std::size_t contacts_with_room(const SpherePairs& pairs, const ContactQuestion& question,
                                          const ContactRows& out) {
  Job job = job_of(pairs, question, out);
  contacts_of_whole_vectors<kExtent>(job, pairs.size);
  return job.count.exact;
}
std::size_t contacts_with_balls(const SpherePairs& pairs, const ContactQuestion& question, const ContactRows& out) {
  return contacts_with_room<true>(pairs, question, out);
}
std::size_t contacts_with_points(const SpherePairs& pairs, const ContactQuestion& question, const ContactRows& out) {
  return contacts_with_room<false>(pairs, question, out);
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
  return test_scalar(pairs, alarm, hit);
}

#endif  // HWY_HAVE_FLOAT64

#if !HWY_HAVE_FLOAT64 || !HWY_NATIVE_FMA

// Without a fused multiply-add the numbers come from the functions of one pair.

batch::Count compute_spheres(const SpherePairs& pairs, const ContactQuestion& question, const ContactRows& out) {
  return compute_scalar(pairs, question, out);
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
HWY_EXPORT(computes_contacts);

batch::Count test_vectors(const SpherePairs& pairs, double alarm, std::uint8_t* hit) {
  return HWY_DYNAMIC_DISPATCH(test_spheres)(pairs, alarm, hit);
}

batch::Count compute_vectors(const SpherePairs& pairs, const ContactQuestion& question, const ContactRows& out) {
  return HWY_DYNAMIC_DISPATCH(compute_spheres)(pairs, question, out);
}

bool vectors_compute_contacts() { return HWY_DYNAMIC_DISPATCH(computes_contacts)(); }

}  // namespace contact::kernel
#endif  // HWY_ONCE
