// Many pairs of balls at once: filter, double-double arithmetic and rounding test in vectors. What they leave goes to
// the functions of one pair.
//
// batch_columns-inl.h            vectors of pairs out of columns, and of numbers into them
// sphere_sphere_formula-inl.h    direction, points, value and what they round to
// batch_arithmetic-inl.h         its lanes, the filter, scales
// batch_near_touching-inl.h      D - T^2 without cancellation
// batch_finishing-inl.h          what the quick tests leave
// batch_together-inl.h           some lanes of vectors one after the other
// here                           the quick tests, loops over columns, and the choice of an instruction set
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernel/batch_sphere_sphere.cpp"
#include "kernel/batch_targets.hpp"
// foreach_target.h includes this file once a target, so it comes before the rest.
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>

#include "contact/sphere_sphere.hpp"
#include "kernel/batch.hpp"
#include "kernel/batch_finishing-inl.h"
#include "kernel/batch_together-inl.h"

HWY_BEFORE_NAMESPACE();
namespace contact::kernel {
namespace HWY_NAMESPACE {

#if HWY_HAVE_FLOAT64

#if HWY_NATIVE_FMA

/// The contacts of a vector of pairs of which the quick steps below leave some number open, none of them plainly a
/// miss. False, and nothing that counts written, where one needs to be scaled first. Without kExtent the second balls
/// are points.
template <bool kScaled, bool kExtent>
HWY_NOINLINE bool contacts_of_vector(Job& job, std::size_t i) {
  const Loaded in(job.pairs, i);
  const Delta d = delta_of(in);
  Stage stage;
  stage.unit = d;
  Scale scale{all(1), all(1)};
  if constexpr (kScaled) {
    scale = scale_of(d);
    stage.unit = scaled(d, scale.down);
  }
  const V d2 = squared_length(stage.unit.x.high, stage.unit.y.high, stage.unit.z.high);
  Double2 radii{in.ar, all(0)};
  if constexpr (kExtent) radii = two_sum(in.ar, in.br);
  const double alarm = job.question.distances.alarm;
  V reach = hn::Add(radii.high, all(alarm));
  if constexpr (kScaled) reach = scaled_reach(in.ar, in.br, alarm, scale.down);
  filter(d2, reach, stage.hit, stage.miss);
  if constexpr (!kScaled) {
    const M in_range =
        hn::And(hn::Ge(d2, all(bounds::kLeast)), hn::Le(hn::MulAdd(reach, reach, d2), all(bounds::kMost)));
    if (!hn::AllTrue(D(), hn::Or(in_range, coincide(d)))) return false;
  }

  const Direction n(stage.unit, d2);
  Double2 root = n.root;
  if constexpr (kScaled) root = scaled(root, scale.up);
  const Less less(radii, all(job.question.distances.contact));
  const auto write = [&](std::size_t k, V number) HWY_ATTR { hn::StoreU(number, D(), job.out.number[k] + i); };
  stage.axes_agree = hn::Eq(all(0), all(0));
  stage.value_agrees = stage.axes_agree;
  write(0, rounded(n.q.x, n.low.x, bounds::kNormalEta, Every(), stage.axes_agree));
  write(1, rounded(n.q.y, n.low.y, bounds::kNormalEta, Every(), stage.axes_agree));
  write(2, rounded(n.q.z, n.low.z, bounds::kNormalEta, Every(), stage.axes_agree));
  const Double2 value = value_of(root, less);
  write(9, rounded(value.high, value.low, bounds::kSumEta, Every(), stage.value_agrees));
  const auto rounded_point = [&](V center, V radius, V q, V low) HWY_ATTR {
    const Double2 at = point(center, radius, q, low);
    return rounded(at.high, at.low, bounds::kSumEta, Every(), stage.axes_agree);
  };
  const V radius1 = hn::Mul(in.ar, all(job.sign1));
  const V radius2 = hn::Mul(in.br, all(job.sign2));
  write(3, rounded_point(in.ax, radius1, n.q.x, n.low.x));
  write(4, rounded_point(in.ay, radius1, n.q.y, n.low.y));
  write(5, rounded_point(in.az, radius1, n.q.z, n.low.z));
  write(6, rounded_point(in.bx, radius2, n.q.x, n.low.x));
  write(7, rounded_point(in.by, radius2, n.q.y, n.low.y));
  write(8, rounded_point(in.bz, radius2, n.q.z, n.low.z));

  stage.d2 = d2;
  stage.qx = n.q.x;
  stage.qy = n.q.y;
  stage.qz = n.q.z;
  stage.low_x = n.low.x;
  stage.low_y = n.low.y;
  stage.low_z = n.low.z;
  stage.reciprocal = n.reciprocal;
  stage.half_rho = n.half_rho;
  stage.root = n.root;
  stage.uncancelled = uncancelled_share(root, less);
  finish<kScaled>(job, i, stage);
  return true;
}

/// Pairs that are looked at together: what one step writes for the next stays in the first level cache.
constexpr std::size_t kStrip = 128;

/// What the quick steps leave for each other. Each is a loop of its own over a strip: what follows a root takes more
/// instructions than a processor sees at once, and more numbers than it has registers.
struct Steps {
  HWY_ALIGN double reciprocal[kStrip + kMostLanes];  ///< 1 / s within 2 u
  HWY_ALIGN double q[3][kStrip + kMostLanes];
  HWY_ALIGN double low[3][kStrip + kMostLanes];
  HWY_ALIGN double uncancelled[kStrip + kMostLanes];  ///< kMost for a plain miss
  std::uint8_t good[kStrip];                          ///< of every vector: the hits that are settled,
  std::uint8_t miss[kStrip];                          ///< and the plain misses
};

HWY_INLINE void find_root(const Job& job, std::size_t i, Steps& steps) {
  const auto difference = [&](std::size_t axis) HWY_ATTR {
    return hn::Sub(hn::LoadU(D(), job.pairs.b[axis] + i), hn::LoadU(D(), job.pairs.a[axis] + i));
  };
  const V root = reciprocal_root(squared_length(difference(0), difference(1), difference(2)));
  hn::StoreU(root, D(), steps.reciprocal + i);
}

/// Decision, normal and value.
template <bool kExtent>
HWY_INLINE void find_direction(const Job& job, std::size_t i, Steps& steps) {
  const Loaded in(job.pairs, i);
  const Delta d = delta_of(in);
  const V d2 = squared_length(d.x.high, d.y.high, d.z.high);
  Double2 radii{in.ar, all(0)};
  if constexpr (kExtent) radii = two_sum(in.ar, in.br);
  M hit;
  M miss;
  filter(d2, hn::Add(radii.high, all(job.question.distances.alarm)), hit, miss);
  store_flags(hit, reinterpret_cast<std::uint8_t*>(job.out.state + i));
  const M wanted = hn::Not(miss);

  const Direction n(d, d2, hn::LoadU(D(), steps.reciprocal + i));
  const auto write = [&](V number, double* to) HWY_ATTR { hn::StoreU(number, D(), to + i); };
  write(n.q.x, steps.q[0]);
  write(n.q.y, steps.q[1]);
  write(n.q.z, steps.q[2]);
  write(n.low.x, steps.low[0]);
  write(n.low.y, steps.low[1]);
  write(n.low.z, steps.low[2]);
  M good = and_at_least(hit, d2, all(bounds::kLeast));
  write(rounded(n.q.x, n.low.x, bounds::kNormalEta, wanted, good), job.out.number[0]);
  write(rounded(n.q.y, n.low.y, bounds::kNormalEta, wanted, good), job.out.number[1]);
  write(rounded(n.q.z, n.low.z, bounds::kNormalEta, wanted, good), job.out.number[2]);
  // A component that is 0 is exactly so, and what follows from it.
  const auto if_any = [](V q, V delta) HWY_ATTR { return hn::IfThenElse(hn::Eq(delta, all(0)), all(1), q); };
  const V component =
      lesser_magnitude(least_magnitude(if_any(n.q.x, d.x.high), if_any(n.q.y, d.y.high)), if_any(n.q.z, d.z.high));
  good = and_at_least(good, component, all(bounds::kLeastComponent));

  const Less less(radii, all(job.question.distances.contact));
  const V uncancelled = uncancelled_share(n.root, less);
  write(hn::IfThenElse(miss, all(bounds::kMost), uncancelled), steps.uncancelled);
  const Double2 value = value_of(n.root, less);
  write(rounded(value.high, value.low, bounds::kSumEta, wanted, good), job.out.number[9]);
  good = and_at_least(good, hn::Abs(value.high), uncancelled);
  steps.good[i / hn::Lanes(D())] = static_cast<std::uint8_t>(bits_of(good));
  steps.miss[i / hn::Lanes(D())] = static_cast<std::uint8_t>(bits_of(miss));
}

/// Points.
template <bool kExtent>
HWY_INLINE void find_points(const Job& job, std::size_t i, Steps& steps) {
  const auto at = [&](const double* column) HWY_ATTR { return hn::LoadU(D(), column + i); };
  const V uncancelled = at(steps.uncancelled);
  const M wanted = hn::Lt(uncancelled, all(bounds::kMost));
  const V radius1 = hn::Mul(at(job.pairs.a[3]), all(job.sign1));
  V radius2 = radius1;
  if constexpr (kExtent) radius2 = hn::Mul(at(job.pairs.b[3]), all(job.sign2));
  V left = uncancelled;  // the least that cancellation has left of a point, where that is less
  M good = wanted;
  const auto write = [&](V center, V radius, V q, V low, double* to) HWY_ATTR {
    const Double2 sum = point(center, radius, q, low);
    left = lesser_magnitude(left, sum.high);
    hn::StoreU(rounded(sum.high, sum.low, bounds::kSumEta, wanted, good), D(), to + i);
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const V q = at(steps.q[axis]);
    const V low = at(steps.low[axis]);
    write(at(job.pairs.a[axis]), radius1, q, low, job.out.number[3 + axis]);
    const V center = at(job.pairs.b[axis]);
    if constexpr (kExtent)
      write(center, radius2, q, low, job.out.number[6 + axis]);
    else  // every zero is +0
      hn::StoreU(hn::IfThenElseZero(wanted, hn::Add(center, all(0))), D(), job.out.number[6 + axis] + i);
  }
  good = and_at_least(good, left, uncancelled);
  steps.good[i / hn::Lanes(D())] &= static_cast<std::uint8_t>(bits_of(good));
}

/// The contacts of whole vectors of pairs, of a strip at most.
template <bool kExtent>
HWY_NOINLINE void contacts_of_vectors(Job& job) {
  const std::size_t lanes = hn::Lanes(D());
  Steps steps;
  for (std::size_t i = 0; i < job.size; i += lanes) find_root(job, i, steps);
  for (std::size_t i = 0; i < job.size; i += lanes) find_direction<kExtent>(job, i, steps);
  for (std::size_t i = 0; i < job.size; i += lanes) find_points<kExtent>(job, i, steps);
  bool scale = false;
  for (std::size_t i = 0; i < job.size; i += lanes) {
    if ((steps.good[i / lanes] | steps.miss[i / lanes]) == (1U << lanes) - 1) continue;
    if (!scale && contacts_of_vector<false, kExtent>(job, i)) continue;
    scale = true;
    contacts_of_vector<true, kExtent>(job, i);
  }
}

/// Calls work(strip, size, begin) for strips of pairs: whole vectors, of which the first `size` pairs count. The last
/// vector may be filled up.
template <class Work>
HWY_INLINE void for_each_strip_of_vectors(const SpherePairs& pairs, const Work& work) {
  const std::size_t whole = pairs.size - pairs.size % hn::Lanes(D());
  for (std::size_t begin = 0; begin < whole; begin += kStrip) {
    const std::size_t size = std::min(kStrip, whole - begin);
    work(pairs.from(begin, size), size, begin);
  }
  if (whole == pairs.size) return;
  const Padded last(pairs, whole);
  work(last.pairs, last.count, whole);
}

/// The numbers of strips that have no room for whole vectors.
struct Room {
  HWY_ALIGN double number[ContactRows::kNumbers][kStrip + kMostLanes];
  batch::PairState state[kStrip + kMostLanes];

  [[nodiscard]] ContactRows rows() {
    ContactRows rows{{}, state};
    for (std::size_t k = 0; k < ContactRows::kNumbers; ++k) rows.number[k] = number[k];
    return rows;
  }
};

template <bool kExtent>
HWY_INLINE batch::Count contacts_of_columns(const SpherePairs& pairs, const ContactQuestion& question,
                                            const ContactRows& out) {
  const double sign1 = sign_of(question.points.first, 1);
  const double sign2 = sign_of(question.points.second, -1);
  batch::Count count;
  for_each_strip_of_vectors(pairs, [&](const SpherePairs& strip, std::size_t size, std::size_t begin) HWY_ATTR {
    const ContactRows rows = out.from(begin);
    if (size % hn::Lanes(D()) == 0) {
      Job job{strip, question, rows, size, sign1, sign2};
      contacts_of_vectors<kExtent>(job);
      count.exact += job.exact;
    } else {
      Room room;
      Job job{strip, question, room.rows(), size, sign1, sign2};
      contacts_of_vectors<kExtent>(job);
      count.exact += job.exact;
      for (std::size_t k = 0; k < ContactRows::kNumbers; ++k) std::copy_n(room.number[k], size, rows.number[k]);
      std::copy_n(room.state, size, rows.state);
    }
    for (std::size_t i = 0; i < size; ++i) count.hits += rows.state[i] != batch::PairState::miss ? 1U : 0U;
  });
  return count;
}

batch::Count compute_spheres(const SpherePairs& pairs, const ContactQuestion& question, const ContactRows& out) {
  return contacts_of_columns<true>(pairs, question, out);
}

batch::Count compute_points(const SpherePairs& pairs, const ContactQuestion& question, const ContactRows& out) {
  return contacts_of_columns<false>(pairs, question, out);
}

/// Columns of a strip's pairs that are not plainly misses.
struct Kept {
  HWY_ALIGN double number[8][kStrip + kMostLanes];
  std::size_t size;

  [[nodiscard]] SpherePairs pairs() const {
    return {{number[0], number[1], number[2], number[3]}, {number[4], number[5], number[6], number[7]}, size};
  }
};

/// Brings the first `size` pairs of a strip together but for plain misses. `flags` become 1 for those that are kept, 0
/// for others. Domain: whole vectors can be read, of no more than kStrip pairs.
HWY_NOINLINE void keep(const SpherePairs& strip, std::size_t size, double alarm, std::uint8_t* flags, Kept& kept) {
  const std::size_t lanes = hn::Lanes(D());
  std::size_t k = 0;
  for (std::size_t i = 0; i < size; i += lanes) {
    const Loaded in(strip, i);
    const V d2 = squared_length(hn::Sub(in.bx, in.ax), hn::Sub(in.by, in.ay), hn::Sub(in.bz, in.az));
    M hit;
    M miss;
    filter(d2, hn::Add(hn::Add(in.ar, in.br), all(alarm)), hit, miss);
    const M wanted = hn::Not(miss);
    store_flags(wanted, flags + i);
    unsigned bits = bits_of(wanted);
    if (size - i < lanes) bits &= (1U << (size - i)) - 1;
    const Together together(bits);
    together.store(in.ax, kept.number[0] + k);
    together.store(in.ay, kept.number[1] + k);
    together.store(in.az, kept.number[2] + k);
    together.store(in.ar, kept.number[3] + k);
    together.store(in.bx, kept.number[4] + k);
    together.store(in.by, kept.number[5] + k);
    together.store(in.bz, kept.number[6] + k);
    together.store(in.br, kept.number[7] + k);
    k += static_cast<std::size_t>(std::popcount(bits));
  }
  kept.size = k;
  for (double* column : {kept.number[0], kept.number[1], kept.number[2], kept.number[3], kept.number[4], kept.number[5],
                         kept.number[6], kept.number[7]})
    for (std::size_t lane = k; k != 0 && lane % lanes != 0; ++lane) column[lane] = column[k - 1];
}

/// Contacts of the pairs that are not plainly misses, strip by strip.
batch::Count compute_sphere_hits(const SpherePairs& pairs, const ContactQuestion& question, std::uint32_t* index,
                                 const ContactRows& out) {
  const double sign1 = sign_of(question.points.first, 1);
  const double sign2 = sign_of(question.points.second, -1);
  Kept kept;
  batch::Count count;
  for_each_strip_of_vectors(pairs, [&](const SpherePairs& strip, std::size_t size, std::size_t begin) HWY_ATTR {
    std::uint8_t flags[kStrip + kMostLanes];
    keep(strip, size, question.distances.alarm, flags, kept);
    std::uint32_t* const found = index + count.hits;
    std::size_t k = 0;
    for (std::size_t i = 0; i < size; ++i) {  // no branch: they come in no order
      found[k] = static_cast<std::uint32_t>(begin + i);
      k += flags[i];
    }
    const ContactRows rows = out.from(count.hits);
    Room room;
    const bool fits = count.hits + k + hn::Lanes(D()) <= pairs.size;
    Job job{kept.pairs(), question, fits ? rows : room.rows(), k, sign1, sign2};
    contacts_of_vectors<true>(job);
    count.exact += job.exact;
    const auto misses = static_cast<std::size_t>(std::count(job.out.state, job.out.state + k, batch::PairState::miss));
    if (misses != 0 || !fits) {  // a miss that was not plain
      std::size_t row = 0;
      for (std::size_t from = 0; from < k; ++from) {
        if (job.out.state[from] == batch::PairState::miss) continue;
        for (std::size_t column = 0; column < ContactRows::kNumbers; ++column)
          rows.number[column][row] = job.out.number[column][from];
        rows.state[row] = job.out.state[from];
        found[row++] = found[from];
      }
    }
    count.hits += k - misses;
  });
  return count;
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

batch::Count compute_points(const SpherePairs& pairs, const ContactQuestion& question, const ContactRows& out) {
  return compute_scalar(pairs, question, out);
}

batch::Count compute_sphere_hits(const SpherePairs& pairs, const ContactQuestion& question, std::uint32_t* index,
                                 const ContactRows& out) {
  return compute_hits_scalar(pairs, question, index, out);
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
HWY_EXPORT(compute_points);
HWY_EXPORT(compute_sphere_hits);
HWY_EXPORT(computes_contacts);

batch::Count test_vectors(const SpherePairs& pairs, double alarm, std::uint8_t* hit) {
  return HWY_DYNAMIC_DISPATCH(test_spheres)(pairs, alarm, hit);
}

batch::Count compute_vectors(const SpherePairs& pairs, const ContactQuestion& question, const ContactRows& out) {
  return HWY_DYNAMIC_DISPATCH(compute_spheres)(pairs, question, out);
}

batch::Count compute_vectors_to_points(const SpherePairs& pairs, const ContactQuestion& question,
                                       const ContactRows& out) {
  return HWY_DYNAMIC_DISPATCH(compute_points)(pairs, question, out);
}

batch::Count compute_hits_vectors(const SpherePairs& pairs, const ContactQuestion& question, std::uint32_t* index,
                                  const ContactRows& out) {
  return HWY_DYNAMIC_DISPATCH(compute_sphere_hits)(pairs, question, index, out);
}

bool vectors_compute_contacts() { return HWY_DYNAMIC_DISPATCH(computes_contacts)(); }

}  // namespace contact::kernel
#endif  // HWY_ONCE
