// Many pairs with a distance between cores at once, for every kind of pairs that has Feet: the filter, the fast stage
// of cores_double_double.hpp in vectors, and the loops over columns. What these leave goes to the function of one pair.
#if defined(CONTACT_KERNEL_BATCH_CORES_INL_H) == defined(HWY_TARGET_TOGGLE)  // once a target
#ifdef CONTACT_KERNEL_BATCH_CORES_INL_H
#undef CONTACT_KERNEL_BATCH_CORES_INL_H
#else
#define CONTACT_KERNEL_BATCH_CORES_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "contact/pair_functions.hpp"
#include "kernel/batch_arithmetic-inl.h"
#include "kernel/sphere_sphere_numbers.hpp"

#if HWY_HAVE_FLOAT64  // else nothing is here, and no attribute for it
HWY_BEFORE_NAMESPACE();
namespace contact::kernel {
namespace HWY_NAMESPACE {

/// Nearest points of a vector of pairs in plain arithmetic, constructed from (pairs, i):
///   radius1, radius2
///   filter(alarm, hit, miss)     where the decision is certain
///   cores()                      from here on in double-double arithmetic
template <class A, class B>
struct Feet;

/// Calls work(lane) for every lane below `size` where `lanes` are so.
template <class Work>
HWY_INLINE void for_each_lane(M lanes, std::size_t size, const Work& work) {
  const unsigned bits = bits_of(lanes);
  for (std::size_t lane = 0; lane < std::min(size, hn::Lanes(D())); ++lane)
    if (((bits >> lane) & 1) != 0) work(lane);
}

template <class A, class B>
HWY_INLINE void test_cores_of_vector(const PairColumns<A, B>& pairs, double alarm, std::size_t i, std::uint8_t* hit,
                                     batch::Count& count) {
  M inside;
  M outside;
  Feet<A, B>(pairs, i).filter(alarm, inside, outside);
  store_flags(inside, hit);
  const M decided = hn::Or(inside, outside);
  if (HWY_LIKELY(hn::AllTrue(D(), decided))) return;
  for_each_lane(hn::Not(decided), pairs.size - i, [&](std::size_t lane) {
    hit[lane] = is_hit(Two<A, B>{pairs.first(i + lane), pairs.second(i + lane)}, {alarm, 0}) ? 1 : 0;
    ++count.exact;
  });
}

template <class A, class B>
batch::Count test_cores(const PairColumns<A, B>& pairs, double alarm, std::uint8_t* hit) {
  batch::Count count;
  const std::size_t lanes = hn::Lanes(D());
  std::size_t i = 0;
  for (; i + lanes <= pairs.size; i += lanes) test_cores_of_vector(pairs, alarm, i, hit + i, count);
  if (i < pairs.size) {
    const Padded last(pairs, i);
    std::uint8_t hits[kMostLanes];
    test_cores_of_vector(last.pairs, alarm, 0, hits, count);
    std::copy_n(hits, last.count, hit + i);
  }
  for (i = 0; i < pairs.size; ++i) count.hits += hit[i];
  return count;
}

#if HWY_NATIVE_FMA

/// Approximate nearest points p and p + d: the coordinates of p, Number each, and the vector d are within `error`,
/// where `holds`.
template <class Number>
struct Cores {
  Number px, py, pz;
  Delta d;
  V error;
  M holds;

  HWY_INLINE Cores() {}
};

// Corrections of a core. Errors: docs/error-bounds.md, "Feet in vectors".

/// w + t v.
HWY_INLINE Double2 moved(Double2 w, V t, Double2 v) {
  const V way = hn::Mul(t, v.high);
  const V way_low = hn::MulAdd(t, v.low, hn::MulSub(t, v.high, way));
  const Double2 high = two_sum(w.high, way);
  return {high.high, hn::Add(high.low, hn::Add(w.low, way_low))};
}

/// d + step v, where the step is so short that its product with v's low part is nothing; |low| <= u |high|.
HWY_INLINE Double2 stepped(Double2 d, V step, Double2 v) { return two_sum(d.high, hn::MulAdd(step, v.high, d.low)); }

/// x.y, rounded.
HWY_INLINE V dot(const Delta& x, const Delta& y) {
  const V product_x = hn::Mul(x.x.high, y.x.high);
  const V product_y = hn::Mul(x.y.high, y.y.high);
  const V product_z = hn::Mul(x.z.high, y.z.high);
  const auto rest = [](Double2 a, Double2 b, V product) HWY_ATTR {
    return hn::MulAdd(a.high, b.low, hn::MulAdd(a.low, b.high, hn::MulSub(a.high, b.high, product)));
  };
  const V rest_xy = hn::Add(rest(x.x, y.x, product_x), rest(x.y, y.y, product_y));
  const Double2 xy = two_sum(product_x, product_y);
  const Double2 xyz = two_sum(xy.high, product_z);
  return hn::Add(xyz.high, hn::Add(hn::Add(xy.low, xyz.low), hn::Add(rest_xy, rest(x.z, y.z, product_z))));
}

HWY_INLINE Double2 sum(V x, Double2 y) {
  const Double2 high = two_sum(x, y.high);
  return {high.high, hn::Add(high.low, y.low)};
}

/// core + radius n.
HWY_INLINE Double2 point_beside(V core, V radius, V q, V low) { return point(core, radius, q, low); }
HWY_INLINE Double2 point_beside(Double2 core, V radius, V q, V low) {
  const Double2 at = point(core.high, radius, q, low);
  return {at.high, hn::Add(at.low, core.low)};
}

template <class A, class B>
HWY_NOINLINE void leave_contacts(const PairColumns<A, B>& pairs, const ContactQuestion& question, std::size_t i,
                                 M lanes, const ContactRows& out, batch::Count& count) {
  for_each_lane(lanes, pairs.size - i, [&](std::size_t lane) {
    contact_of_one_pair(pairs, question, i + lane, out, i + lane);
    count.hits += out.state[i + lane] != batch::PairState::miss ? 1U : 0U;
    ++count.exact;
  });
}

/// The contacts of a vector of pairs; `i` + lanes may be beyond pairs.size, and out has room for these.
template <class A, class B>
HWY_INLINE void contacts_of_cores(const PairColumns<A, B>& pairs, const ContactQuestion& question, std::size_t i,
                                  const ContactRows& out, batch::Count& count) {
  const D tag;
  const Feet<A, B> feet(pairs, i);
  M hit;
  M miss;
  feet.filter(question.distances.alarm, hit, miss);
  auto* const states = reinterpret_cast<std::uint8_t*>(out.state + i);
  if (hn::AllTrue(tag, miss)) {
    for (double* column : out.number) hn::StoreU(all(0), tag, column + i);
    store_flags(hit, states);
    return;
  }
  const auto cores = feet.cores();
  const Delta& d = cores.d;
  const Direction n(d, squared_length(d.x.high, d.y.high, d.z.high));
  M certain = hn::And(cores.holds, hn::Ge(n.root.high, hn::Mul(cores.error, all(bounds::kClear))));

  const Double2 radii = two_sum(feet.radius1, feet.radius2);
  /// sqrt(D) less a sum, and the error of that.
  const auto beyond = [&](const Less& less, V& error) HWY_ATTR {
    error = hn::MulAdd(hn::Add(n.root.high, less.sum.high), all(bounds::kValueError), cores.error);
    return value_of(n.root, less);
  };
  V error;
  if (HWY_UNLIKELY(!hn::AllTrue(tag, hn::Or(hit, miss)))) {
    const Double2 gap = beyond(Less(radii, all(question.distances.alarm)), error);
    const M nearer = hn::Lt(hn::Add(gap.high, hn::Add(gap.low, error)), all(0));
    const M farther = hn::Gt(hn::Add(gap.high, hn::Sub(gap.low, error)), all(0));
    hit = hn::Or(hit, hn::And(certain, nearer));
    miss = hn::Or(miss, hn::And(certain, farther));
  }

  const auto write = [&](std::size_t k, const Double2& number, V within) HWY_ATTR {
    const V above = hn::Add(number.high, hn::Add(number.low, within));
    certain = and_equal(certain, above, hn::Add(number.high, hn::Sub(number.low, within)));
    hn::StoreU(hn::IfThenElseZero(hit, above), tag, out.number[k] + i);
  };
  const V turn = hn::Mul(hn::Mul(cores.error, all(bounds::kTurn)), n.reciprocal);
  const auto write_normal = [&](std::size_t k, V q, V low) HWY_ATTR {
    write(k, Double2(q, low), hn::MulAdd(hn::Abs(q), all(bounds::kNormalError), turn));
  };
  write_normal(0, n.q.x, n.low.x);
  write_normal(1, n.q.y, n.low.y);
  write_normal(2, n.q.z, n.low.z);
  write(9, beyond(Less(radii, all(question.distances.contact)), error), error);

  const V of_radius = hn::Add(turn, all(bounds::kCorePointError));
  const auto write_point = [&](std::size_t k, const auto& core, V radius, V core_error, V q, V low) HWY_ATTR {
    const Double2 at = point_beside(core, radius, q, low);
    write(k, at, hn::MulAdd(hn::Abs(at.high), all(bounds::kCoreSumError), core_error));
  };
  const auto sign1 = all(sign_of(question.points.first, 1));
  const auto sign2 = all(sign_of(question.points.second, -1));
  const V radius1 = hn::Mul(feet.radius1, sign1);
  const V radius2 = hn::Mul(feet.radius2, sign2);
  const V error1 = hn::MulAdd(hn::Abs(radius1), of_radius, feet.first_error(cores.error));
  const V error2 = hn::MulAdd(hn::Abs(radius2), of_radius, cores.error);
  write_point(3, cores.px, radius1, error1, n.q.x, n.low.x);
  write_point(4, cores.py, radius1, error1, n.q.y, n.low.y);
  write_point(5, cores.pz, radius1, error1, n.q.z, n.low.z);
  write_point(6, sum(cores.px, d.x), radius2, error2, n.q.x, n.low.x);
  write_point(7, sum(cores.py, d.y), radius2, error2, n.q.y, n.low.y);
  write_point(8, sum(cores.pz, d.z), radius2, error2, n.q.z, n.low.z);

  const M good = hn::And(hit, certain);
  store_flags(good, states);
  const M in_columns = hn::FirstN(tag, pairs.size - i);
  count.hits += hn::CountTrue(tag, hn::And(good, in_columns));
  const M settled = hn::Or(miss, good);
  if (HWY_UNLIKELY(!hn::AllTrue(tag, settled))) leave_contacts(pairs, question, i, hn::Not(settled), out, count);
}

template <class A, class B>
batch::Count compute_cores(const PairColumns<A, B>& pairs, const ContactQuestion& question, const ContactRows& out) {
  batch::Count count;
  const std::size_t lanes = hn::Lanes(D());
  std::size_t i = 0;
  for (; i + lanes <= pairs.size; i += lanes) contacts_of_cores(pairs, question, i, out, count);
  if (i == pairs.size) return count;

  const Padded last(pairs, i);
  double numbers[ContactRows::kNumbers][kMostLanes];
  batch::PairState states[kMostLanes];
  ContactRows rows{};
  for (std::size_t k = 0; k < ContactRows::kNumbers; ++k) rows.number[k] = numbers[k];
  rows.state = states;
  contacts_of_cores(last.pairs, question, 0, rows, count);
  for (std::size_t k = 0; k < ContactRows::kNumbers; ++k) std::copy_n(numbers[k], last.count, out.number[k] + i);
  std::copy_n(states, last.count, out.state + i);
  return count;
}

#else

// Without a fused multiply-add the numbers come from the functions of one pair.

template <class A, class B>
batch::Count compute_cores(const PairColumns<A, B>& pairs, const ContactQuestion& question, const ContactRows& out) {
  return compute_scalar(pairs, question, out);
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace contact::kernel
HWY_AFTER_NAMESPACE();

#else   // no vectors of doubles

namespace contact::kernel {
namespace HWY_NAMESPACE {

template <class A, class B>
batch::Count test_cores(const PairColumns<A, B>& pairs, double alarm, std::uint8_t* hit) {
  return test_scalar(pairs, alarm, hit);
}
template <class A, class B>
batch::Count compute_cores(const PairColumns<A, B>& pairs, const ContactQuestion& question, const ContactRows& out) {
  return compute_scalar(pairs, question, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace contact::kernel
#endif  // HWY_HAVE_FLOAT64

#endif  // once a target
