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
#include <limits>

#include "contact/pair_functions.hpp"
#include "kernel/batch_arithmetic-inl.h"
#include "kernel/batch_cores.hpp"
#include "kernel/sphere_sphere_numbers.hpp"

#if HWY_HAVE_FLOAT64  // else nothing is here, and no attribute for it
HWY_BEFORE_NAMESPACE();
namespace contact::kernel {
namespace HWY_NAMESPACE {

/// Nearest points of a vector of pairs in plain arithmetic, constructed from (pairs, i):
///   filter(alarm, hit, miss)     where the decision is certain
///   find_cores(to, i)            d, its error and, where the first core is no point, p, from here on in double-double
template <class A, class B>
struct Feet;

/// Calls work(lane) for every lane below `size` where `lanes` are so.
template <class Work>
HWY_INLINE void for_each_lane(M lanes, std::size_t size, const Work& work) {
  const unsigned bits = bits_of(lanes);
  for (std::size_t lane = 0; lane < std::min(size, hn::Lanes(D())); ++lane)
    if (((bits >> lane) & 1) != 0) work(lane);
}

/// Points of a vector of pairs.
struct Points {
  V x, y, z;

  HWY_INLINE Points(V on_x, V on_y, V on_z) : x(on_x), y(on_y), z(on_z) {}
  HWY_INLINE Points(const double* const* columns, std::size_t i)
      : x(hn::LoadU(D(), columns[0] + i)), y(hn::LoadU(D(), columns[1] + i)), z(hn::LoadU(D(), columns[2] + i)) {}
};
HWY_INLINE Points from_to(const Points& a, const Points& b) {
  return {hn::Sub(b.x, a.x), hn::Sub(b.y, a.y), hn::Sub(b.z, a.z)};
}
HWY_INLINE Points plus(const Points& w, V t, const Points& v) {
  return {hn::MulAdd(t, v.x, w.x), hn::MulAdd(t, v.y, w.y), hn::MulAdd(t, v.z, w.z)};
}
HWY_INLINE V plain_dot(const Points& a, const Points& b) {
  return hn::MulAdd(a.z, b.z, hn::MulAdd(a.y, b.y, hn::Mul(a.x, b.x)));
}
HWY_INLINE V clamped(V t) { return hn::Min(hn::Max(t, all(0)), all(1)); }

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

// What Feet are made of. Errors: docs/error-bounds.md, "Feet in vectors".

/// w + t v.
HWY_INLINE Double2 moved(Double2 w, V t, Double2 v) {
  const V way = hn::Mul(t, v.high);
  const V way_low = hn::MulAdd(t, v.low, hn::MulSub(t, v.high, way));
  const Double2 high = two_sum(w.high, way);
  return {high.high, hn::Add(high.low, hn::Add(w.low, way_low))};
}

/// d + step v, where the step is so short that its product with v's low part is nothing.
HWY_INLINE Double2 stepped(Double2 d, V step, Double2 v) {
  const V more = hn::MulAdd(step, v.high, d.low);
  const V high = hn::Add(d.high, more);
  return {high, hn::Sub(more, hn::Sub(high, d.high))};  // Dekker: exact where d.high is not less than the rest
}

/// x.y, rounded.
HWY_INLINE V dot(const Delta& x, const Delta& y) {
  const V product_x = hn::Mul(x.x.high, y.x.high);
  const V product_y = hn::Mul(x.y.high, y.y.high);
  const V product_z = hn::Mul(x.z.high, y.z.high);
  const auto rest = [](Double2 a, Double2 b, V product) HWY_ATTR {
    return hn::MulAdd(a.high, b.low, hn::MulAdd(a.low, b.high, hn::MulSub(a.high, b.high, product)));
  };
  const V rests = hn::Add(hn::Add(rest(x.x, y.x, product_x), rest(x.y, y.y, product_y)), rest(x.z, y.z, product_z));
  const Double2 xy = two_sum(product_x, product_y);
  return hn::Add(hn::Add(xy.high, product_z), hn::Add(xy.low, rests));
}

HWY_INLINE V magnitude(const Points& a) { return hn::Add(hn::Add(hn::Abs(a.x), hn::Abs(a.y)), hn::Abs(a.z)); }
HWY_INLINE Delta exactly_from_to(const Points& a, const Points& b) {
  return {two_difference(b.x, a.x), two_difference(b.y, a.y), two_difference(b.z, a.z)};
}
HWY_INLINE Delta moved(const Delta& w, V t, const Delta& v) {
  return {moved(w.x, t, v.x), moved(w.y, t, v.y), moved(w.z, t, v.z)};
}
HWY_INLINE Delta stepped(const Delta& d, V step, const Delta& v) {
  return {stepped(d.x, step, v.x), stepped(d.y, step, v.y), stepped(d.z, step, v.z)};
}
HWY_INLINE void store_error(V error, M holds, double* to) {
  hn::StoreU(hn::IfThenElse(holds, error, all(std::numeric_limits<double>::infinity())), D(), to);
}

HWY_INLINE void store(const Delta& d, double (&to)[6][CoreColumns::kRoom], std::size_t i) {
  const D tag;
  hn::StoreU(d.x.high, tag, to[0] + i);
  hn::StoreU(d.x.low, tag, to[1] + i);
  hn::StoreU(d.y.high, tag, to[2] + i);
  hn::StoreU(d.y.low, tag, to[3] + i);
  hn::StoreU(d.z.high, tag, to[4] + i);
  hn::StoreU(d.z.low, tag, to[5] + i);
}
HWY_INLINE Double2 load(const double (&from)[6][CoreColumns::kRoom], std::size_t axis, std::size_t i) {
  const D tag;
  return {hn::LoadU(tag, from[2 * axis] + i), hn::LoadU(tag, from[2 * axis + 1] + i)};
}

/// The first core on an axis, and its error. A centre is a number; an error above 0 has room for underflows.
template <class B>
HWY_INLINE V first_core(const PairColumns<Ball, B>& pairs, const CoreColumns& /*from*/, std::size_t axis,
                        std::size_t i) {
  return hn::LoadU(D(), pairs.a[axis] + i);
}
template <class B>
HWY_INLINE V first_error(const PairColumns<Ball, B>& /*pairs*/, const CoreColumns& /*from*/, std::size_t /*i*/) {
  return all(bounds::kLeast);
}
template <class B>
HWY_INLINE Double2 first_core(const PairColumns<Capsule, B>& /*pairs*/, const CoreColumns& from, std::size_t axis,
                              std::size_t i) {
  return load(from.p, axis, i);
}
template <class B>
HWY_INLINE V first_error(const PairColumns<Capsule, B>& /*pairs*/, const CoreColumns& from, std::size_t i) {
  return hn::LoadU(D(), from.p_error + i);
}

/// Where all points of both shapes have one coordinate: what delta has of it is 0, with no error.
template <class A>
HWY_INLINE M in_plane(const PairColumns<A, Capsule>& pairs, std::size_t axis, std::size_t i) {
  const auto same = [&](const double* column)
                        HWY_ATTR { return hn::Eq(hn::LoadU(D(), column + i), hn::LoadU(D(), pairs.b[axis] + i)); };
  const M all_same = hn::And(same(pairs.a[axis]), same(pairs.b[3 + axis]));
  return pairs.a.size() == 4 ? all_same : hn::And(all_same, same(pairs.a[(3 + axis) % pairs.a.size()]));
}

/// core + length n.
HWY_INLINE Double2 point_beside(V core, V length, V q, V low) { return point(core, length, q, low); }
HWY_INLINE Double2 point_beside(V core, Double2 length, V q, V low) {
  const Double2 at = point(core, length.high, q, low);
  return {at.high, hn::MulAdd(length.low, q, at.low)};
}
template <class Length>
HWY_INLINE Double2 point_beside(Double2 core, Length length, V q, V low) {
  const Double2 at = point_beside(core.high, length, q, low);
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

/// The first half. (Two loops: each has a chain of operations that is short enough for the processor to begin the next
/// vectors, which takes a sixth of the time off.)
template <class A, class B>
HWY_INLINE void cores_of_vector(const PairColumns<A, B>& pairs, double alarm, std::size_t i, CoreColumns& to) {
  const Feet<A, B> feet(pairs, i);
  M hit;
  M miss;
  feet.filter(alarm, hit, miss);
  const V decision = hn::IfThenElse(hit, all(1), hn::IfThenElseZero(hn::Not(miss), all(0.5)));
  hn::StoreU(decision, D(), to.decision + i);
  if (!hn::AllTrue(D(), miss)) feet.find_cores(to, i);
}

/// The contacts of a vector of pairs; `i` + lanes may be beyond pairs.size, and out has room for these.
template <class A, class B>
HWY_INLINE void contacts_of_vector(const PairColumns<A, B>& pairs, const ContactQuestion& question, std::size_t i,
                                   const CoreColumns& from, const ContactRows& out, batch::Count& count) {
  const D tag;
  const V decision = hn::LoadU(tag, from.decision + i);
  M hit = hn::Eq(decision, all(1));
  M miss = hn::Eq(decision, all(0));
  auto* const states = reinterpret_cast<std::uint8_t*>(out.state + i);
  if (hn::AllTrue(tag, miss)) {
    for (double* column : out.number) hn::StoreU(all(0), tag, column + i);
    store_flags(hit, states);
    return;
  }
  const Delta d{load(from.d, 0, i), load(from.d, 1, i), load(from.d, 2, i)};
  const V radius1 = hn::LoadU(tag, pairs.a.back() + i);
  const V radius2 = hn::LoadU(tag, pairs.b.back() + i);
  const V d_error = hn::LoadU(tag, from.d_error + i);
  const V p_error = first_error(pairs, from, i);
  const Direction n(d, squared_length(d.x.high, d.y.high, d.z.high));
  const V length = n.root.high;
  const V turn = hn::Mul(hn::Mul(d_error, all(bounds::kTurn)), n.reciprocal);
  const V of_length = hn::Add(turn, all(bounds::kCoreError));
  M certain = hn::Ge(length, hn::Mul(d_error, all(bounds::kClear)));

  // From the first core to a surface of the second shape.
  const auto as_far_as = [&](V radius) HWY_ATTR {
    const Double2 sum = two_sum(length, radius);
    return Double2(sum.high, hn::Add(sum.low, n.root.low));
  };
  const Double2 to_surface = as_far_as(hn::Neg(radius2));
  V error;
  // The distance of the surfaces less another one, and its error.
  const auto beyond = [&](double distance) HWY_ATTR {
    const Double2 rest = two_sum(radius1, all(distance));
    const Double2 sum = two_difference(to_surface.high, rest.high);
    const V lengths = hn::Add(hn::Add(length, radius2), rest.high);
    error = hn::MulAdd(lengths, all(bounds::kCoreError), d_error);
    return Double2(sum.high, hn::Add(sum.low, hn::Sub(to_surface.low, rest.low)));
  };
  if (HWY_UNLIKELY(!hn::AllTrue(tag, hn::Or(hit, miss)))) {
    const Double2 gap = beyond(question.distances.alarm);
    const M nearer = hn::Lt(hn::Add(gap.high, hn::Add(gap.low, error)), all(0));
    const M farther = hn::Gt(hn::Add(gap.high, hn::Sub(gap.low, error)), all(0));
    hit = hn::Or(hit, hn::And(certain, nearer));
    miss = hn::Or(miss, hn::And(certain, farther));
  }

  const V zero = all(0);
  M flat_x = hn::Eq(d.x.high, zero);
  M flat_y = hn::Eq(d.y.high, zero);
  M flat_z = hn::Eq(d.z.high, zero);
  if (HWY_UNLIKELY(!hn::AllFalse(tag, hn::Or(hn::Or(flat_x, flat_y), flat_z)))) {
    flat_x = hn::And(flat_x, in_plane(pairs, 0, i));
    flat_y = hn::And(flat_y, in_plane(pairs, 1, i));
    flat_z = hn::And(flat_z, in_plane(pairs, 2, i));
  }
  certain = hn::And(certain, hit);
  const auto write = [&](std::size_t k, const Double2& number, V within) HWY_ATTR {
    const V radius = hn::MulAdd(hn::Abs(number.low), all(bounds::kCoreEta), within);
    const V above = hn::Add(number.high, hn::Add(number.low, radius));
    const V below = hn::Add(number.high, hn::Sub(number.low, radius));
    certain = and_equal(certain, above, below);
    hn::StoreU(hn::IfThenElseZero(hit, above), tag, out.number[k] + i);
  };
  write(0, Double2(n.q.x, n.low.x), hn::IfThenZeroElse(flat_x, turn));
  write(1, Double2(n.q.y, n.low.y), hn::IfThenZeroElse(flat_y, turn));
  write(2, Double2(n.q.z, n.low.z), hn::IfThenZeroElse(flat_z, turn));
  const Double2 value = beyond(question.distances.contact);
  write(9, value, error);
  const auto write_points = [&](std::size_t k, const auto& from_first, V within) HWY_ATTR {
    write(k, point_beside(first_core(pairs, from, 0, i), from_first, n.q.x, n.low.x),
          hn::IfThenZeroElse(flat_x, within));
    write(k + 1, point_beside(first_core(pairs, from, 1, i), from_first, n.q.y, n.low.y),
          hn::IfThenZeroElse(flat_y, within));
    write(k + 2, point_beside(first_core(pairs, from, 2, i), from_first, n.q.z, n.low.z),
          hn::IfThenZeroElse(flat_z, within));
  };
  const V signed1 = hn::Mul(radius1, all(sign_of(question.points.first, 1)));
  write_points(3, signed1, hn::MulAdd(radius1, of_length, p_error));
  Double2 to_second = to_surface;
  if (question.points.second != PointOn::nearest_surface)
    to_second = as_far_as(hn::Mul(radius2, all(sign_of(question.points.second, -1))));
  write_points(6, to_second, hn::MulAdd(hn::Add(radius2, length), of_length, hn::Add(p_error, d_error)));

  store_flags(certain, states);
  count.hits += hn::CountTrue(tag, hn::And(certain, hn::FirstN(tag, pairs.size - i)));
  const M settled = hn::Or(miss, certain);
  if (HWY_UNLIKELY(!hn::AllTrue(tag, settled))) leave_contacts(pairs, question, i, hn::Not(settled), out, count);
}

template <class A, class B>
bool cores_of_strip(const PairColumns<A, B>& pairs, CoreColumns& to) {
  // No pair is plainly a miss.
  for (std::size_t i = 0; i < pairs.size; i += hn::Lanes(D()))
    cores_of_vector(pairs, std::numeric_limits<double>::max(), i, to);
  return true;
}

template <class A, class B>
HWY_INLINE void contacts_of_vectors(const PairColumns<A, B>& pairs, const ContactQuestion& question,
                                    const ContactRows& out, CoreColumns& columns, batch::Count& count) {
  const std::size_t lanes = hn::Lanes(D());
  for (std::size_t i = 0; i < pairs.size; i += lanes) cores_of_vector(pairs, question.distances.alarm, i, columns);
  for (std::size_t i = 0; i < pairs.size; i += lanes) contacts_of_vector(pairs, question, i, columns, out, count);
}

template <class A, class B>
batch::Count compute_cores(const PairColumns<A, B>& pairs, const ContactQuestion& question, const ContactRows& out) {
  batch::Count count;
  CoreColumns columns;
  const std::size_t whole = pairs.size - pairs.size % hn::Lanes(D());
  for_each_strip(pairs.from(0, whole), [&](const PairColumns<A, B>& strip, std::size_t begin) HWY_ATTR {
    contacts_of_vectors(strip, question, out.from(begin), columns, count);
  });
  if (whole == pairs.size) return count;

  const Padded last(pairs, whole);
  double numbers[ContactRows::kNumbers][kMostLanes];
  batch::PairState states[kMostLanes];
  ContactRows rows{};
  for (std::size_t k = 0; k < ContactRows::kNumbers; ++k) rows.number[k] = numbers[k];
  rows.state = states;
  contacts_of_vectors(last.pairs, question, rows, columns, count);
  for (std::size_t k = 0; k < ContactRows::kNumbers; ++k) std::copy_n(numbers[k], last.count, out.number[k] + whole);
  std::copy_n(states, last.count, out.state + whole);
  return count;
}

#else

// Without a fused multiply-add the numbers come from the functions of one pair.

template <class A, class B>
bool cores_of_strip(const PairColumns<A, B>& /*pairs*/, CoreColumns& /*to*/) {
  return false;
}
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
bool cores_of_strip(const PairColumns<A, B>& /*pairs*/, CoreColumns& /*to*/) {
  return false;
}
template <class A, class B>
batch::Count compute_cores(const PairColumns<A, B>& pairs, const ContactQuestion& question, const ContactRows& out) {
  return compute_scalar(pairs, question, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace contact::kernel
#endif  // HWY_HAVE_FLOAT64

#endif  // once a target
