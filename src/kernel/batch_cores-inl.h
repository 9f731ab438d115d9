// Many pairs of a kind that has Feet at once: what Feet are made of, the contact of cores with a distance, which is the
// fast stage of cores_double_double.hpp in vectors, and the loops over columns. What these leave goes to the function of
// one pair.
#if defined(CONTACT_KERNEL_BATCH_CORES_INL_H) == defined(HWY_TARGET_TOGGLE)  // once a target
#ifdef CONTACT_KERNEL_BATCH_CORES_INL_H
#undef CONTACT_KERNEL_BATCH_CORES_INL_H
#else
#define CONTACT_KERNEL_BATCH_CORES_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "contact/pair_functions.hpp"
#include "contact/plain_cores.hpp"
#include "kernel/batch_arithmetic-inl.h"
#include "kernel/batch_cores.hpp"
#include "kernel/sphere_sphere_numbers.hpp"

#if HWY_HAVE_FLOAT64  // else nothing is here, and no attribute for it
HWY_BEFORE_NAMESPACE();
namespace contact::kernel {
namespace HWY_NAMESPACE {

/// The cores of a vector of pairs in plain arithmetic, constructed from (pairs, i):
///   filter(alarm, hit, miss)     where the decision is certain
///   find_cores(to, i)            what the second half needs of CoreColumns, from here on in double-double
///   contacts(strip)              the second half: the contacts of a strip
template <class A, class B>
struct Feet;

/// What the second half has of a strip, and what it writes.
template <class A, class B>
struct Strip {
  const PairColumns<A, B>& pairs;
  const ContactQuestion& question;
  CoreColumns& cores;
  const ContactRows& out;
  Left& left;
};

/// Calls work(lane) for every lane below `size` where `lanes` are so.
template <class Work>
HWY_INLINE void for_each_lane(M lanes, std::size_t size, const Work& work) {
  const unsigned bits = bits_of(lanes);
  for (std::size_t lane = 0; lane < std::min(size, hn::Lanes(D())); ++lane)
    if (((bits >> lane) & 1) != 0) work(lane);
}

HWY_INLINE M none() { return hn::FirstN(D(), 0); }

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
HWY_INLINE Points times(V t, const Points& v) { return {hn::Mul(t, v.x), hn::Mul(t, v.y), hn::Mul(t, v.z)}; }
HWY_INLINE Points plus(const Points& w, V t, const Points& v) {
  return {hn::MulAdd(t, v.x, w.x), hn::MulAdd(t, v.y, w.y), hn::MulAdd(t, v.z, w.z)};
}
HWY_INLINE V plain_dot(const Points& a, const Points& b) {
  return hn::MulAdd(a.z, b.z, hn::MulAdd(a.y, b.y, hn::Mul(a.x, b.x)));
}
HWY_INLINE Points plain_cross(const Points& a, const Points& b) {
  return {hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
          hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
}
HWY_INLINE V magnitude(const Points& a) { return hn::Add(hn::Add(hn::Abs(a.x), hn::Abs(a.y)), hn::Abs(a.z)); }
HWY_INLINE Points chosen(M first, const Points& a, const Points& b) {
  return {hn::IfThenElse(first, a.x, b.x), hn::IfThenElse(first, a.y, b.y), hn::IfThenElse(first, a.z, b.z)};
}
HWY_INLINE V clamped(V t) { return hn::Min(hn::Max(t, all(0)), all(1)); }
/// 1 / x, or 0 where x is nothing.
HWY_INLINE V reciprocal_or_zero(V x) { return hn::IfThenElseZero(hn::Ge(x, all(bounds::kLeast)), hn::Div(all(1), x)); }

template <class Shape>
HWY_INLINE V radius_of(const std::array<const double*, kNumbersOf<Shape>>& columns, std::size_t i) {
  if constexpr (requires(Shape shape) { shape.radius; })
    return hn::LoadU(D(), columns.back() + i);
  else
    return all(0);
}
template <class A, class B>
HWY_INLINE V radii_of(const PairColumns<A, B>& pairs, std::size_t i) {
  return hn::Add(radius_of<A>(pairs.a, i), radius_of<B>(pairs.b, i));
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

/// What plain arithmetic says of a vector of pairs.
template <class A, class B>
HWY_INLINE V decision_of(const Feet<A, B>& feet, double alarm, M& miss) {
  M hit;
  feet.filter(alarm, hit, miss);
  const V open = hn::IfThenElseZero(hn::Not(miss), all(CoreColumns::kOpen));
  return hn::IfThenElse(hit, all(CoreColumns::kHit), open);
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

/// x y, and what the product lacks.
HWY_INLINE Double2 product_of(V x, V y) {
  const V p = hn::Mul(x, y);
  return {p, hn::MulSub(x, y, p)};
}
HWY_INLINE Double2 product_of(Double2 x, Double2 y) {
  const V p = hn::Mul(x.high, y.high);
  return {p, hn::MulAdd(x.high, y.low, hn::MulAdd(x.low, y.high, hn::MulSub(x.high, y.high, p)))};
}
/// x^2, whose low part may be as large as the high one.
HWY_INLINE Double2 square_of(Double2 x) {
  const V p = hn::Mul(x.high, x.high);
  const V twice = hn::MulAdd(all(2), x.high, x.low);
  return {p, hn::MulAdd(x.low, twice, hn::MulSub(x.high, x.high, p))};
}
HWY_INLINE Delta products_of(const Points& x, const Points& y) {
  return {product_of(x.x, y.x), product_of(x.y, y.y), product_of(x.z, y.z)};
}
HWY_INLINE Delta products_of(const Delta& x, const Delta& y) {
  return {product_of(x.x, y.x), product_of(x.y, y.y), product_of(x.z, y.z)};
}
/// The sum of three such.
HWY_INLINE Double2 sum_of(const Delta& x) {
  const Double2 xy = two_sum(x.x.high, x.y.high);
  const Double2 xyz = two_sum(xy.high, x.z.high);
  return {xyz.high, hn::Add(hn::Add(xy.low, xyz.low), hn::Add(hn::Add(x.x.low, x.y.low), x.z.low))};
}
/// 1 / sqrt(N) = reciprocal (1 + half_rho).
struct ReciprocalRoot {
  V reciprocal;
  V half_rho;

  HWY_INLINE explicit ReciprocalRoot(const Double2& N) : reciprocal(reciprocal_root(N.high)) {
    const V half = hn::Mul(all(0.5), N.high);
    const V g = hn::Mul(reciprocal, reciprocal);
    const V rest = hn::Mul(g, hn::Mul(all(0.5), N.low));
    const V lacks = hn::MulAdd(hn::MulSub(reciprocal, reciprocal, g), half, rest);
    half_rho = hn::Sub(hn::NegMulAdd(g, half, all(0.5)), lacks);
  }
  /// A component of n / |n|, the reciprocal as it is or negative.
  HWY_INLINE Double2 along(Double2 n, V signed_reciprocal) const {
    const V m = hn::Mul(n.high, signed_reciprocal);
    const V lost = hn::MulAdd(n.low, signed_reciprocal, hn::MulSub(n.high, signed_reciprocal, m));
    return {m, hn::MulAdd(m, half_rho, lost)};
  }
  HWY_INLINE Double2 along(V n, V signed_reciprocal) const {
    const V m = hn::Mul(n, signed_reciprocal);
    return {m, hn::MulAdd(m, half_rho, hn::MulSub(n, signed_reciprocal, m))};
  }
};

/// x.y, rounded.
HWY_INLINE V dot(const Delta& x, const Delta& y) {
  const Delta p = products_of(x, y);
  const Double2 xy = two_sum(p.x.high, p.y.high);
  return hn::Add(hn::Add(xy.high, p.z.high), hn::Add(xy.low, hn::Add(hn::Add(p.x.low, p.y.low), p.z.low)));
}

HWY_INLINE V plain_square(const Delta& d) { return squared_length(d.x.high, d.y.high, d.z.high); }
HWY_INLINE Points rounded_to_plain(const Delta& d) { return {d.x.high, d.y.high, d.z.high}; }
HWY_INLINE Delta exactly_from_to(const Points& a, const Points& b) {
  return {two_difference(b.x, a.x), two_difference(b.y, a.y), two_difference(b.z, a.z)};
}
HWY_INLINE Delta exactly_times(V t, const Points& v) {
  return {product_of(t, v.x), product_of(t, v.y), product_of(t, v.z)};
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
HWY_INLINE Delta load(const double (&from)[6][CoreColumns::kRoom], std::size_t i) {
  return {load(from, 0, i), load(from, 1, i), load(from, 2, i)};
}

/// Stores d, and where a coordinate of it is 0 because all points of both shapes have the same one: in_plane(axis).
template <class InPlane>
HWY_INLINE void store_way(const Delta& d, const InPlane& in_plane, CoreColumns& to, std::size_t i) {
  const D tag;
  store(d, to.d, i);
  const V zero = all(0);
  const M flat_x = hn::Eq(d.x.high, zero);
  const M flat_y = hn::Eq(d.y.high, zero);
  const M flat_z = hn::Eq(d.z.high, zero);
  to.has_flat[i] = !hn::AllFalse(tag, hn::Or(hn::Or(flat_x, flat_y), flat_z));
  if (HWY_LIKELY(!to.has_flat[i])) return;
  hn::StoreU(hn::VecFromMask(tag, hn::And(flat_x, in_plane(0))), tag, to.flat[0] + i);
  hn::StoreU(hn::VecFromMask(tag, hn::And(flat_y, in_plane(1))), tag, to.flat[1] + i);
  hn::StoreU(hn::VecFromMask(tag, hn::And(flat_z, in_plane(2))), tag, to.flat[2] + i);
}
HWY_INLINE M same(const double* a, const double* b, std::size_t i) {
  return hn::Eq(hn::LoadU(D(), a + i), hn::LoadU(D(), b + i));
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

/// Ten numbers of a vector of pairs: each is written rounded, or as 0 where there is no hit, and is certain where both
/// ends of its interval are rounded to the same.
struct Numbers {
  const ContactRows& out;
  std::size_t i;
  M hit;
  M certain;

  HWY_INLINE Numbers(const ContactRows& rows, std::size_t at, M hits, M sure)
      : out(rows), i(at), hit(hits), certain(hn::And(hits, sure)) {}
  HWY_INLINE void write(std::size_t k, const Double2& number, V within) {
    const V radius = hn::MulAdd(hn::Abs(number.low), all(bounds::kCoreEta), within);
    const V above = hn::Add(number.high, hn::Add(number.low, radius));
    const V below = hn::Add(number.high, hn::Sub(number.low, radius));
    certain = and_equal(certain, above, below);
    write_exact(k, above);
  }
  HWY_INLINE void write_exact(std::size_t k, V number) {
    hn::StoreU(hn::IfThenElseZero(hit, number), D(), out.number[k] + i);
  }
  /// Says which pairs of `size` are left: those that are neither a miss nor certain.
  HWY_INLINE void finish(M miss, std::size_t size, Left& left) const {
    const D tag;
    store_flags(certain, reinterpret_cast<std::uint8_t*>(out.state + i));
    left.hits += hn::CountTrue(tag, hn::And(certain, hn::FirstN(tag, size - i)));
    const M settled = hn::Or(miss, certain);
    if (HWY_UNLIKELY(!hn::AllTrue(tag, settled)))
      for_each_lane(hn::Not(settled), size - i,
                    [&](std::size_t lane) { left.rows[left.size++] = static_cast<std::uint16_t>(i + lane); });
  }
};
/// Where all pairs of a vector are misses: writes that, and says so.
HWY_INLINE bool wrote_misses(M miss, const ContactRows& out, std::size_t i) {
  const D tag;
  if (!hn::AllTrue(tag, miss)) return false;
  for (double* column : out.number) hn::StoreU(all(0), tag, column + i);
  store_flags(hn::Not(miss), reinterpret_cast<std::uint8_t*>(out.state + i));
  return true;
}

/// Which columns the second half reads of cores with a distance.
struct ApartRows {
  std::array<const double*, 3> p;  ///< of a first core that is a point
  const double* radius1;
  const double* radius2;
};

/// The contacts of a strip of cores with a distance; out has room for whole vectors. `turned`: what comes first in the
/// question is second here.
template <bool is_point, bool turned = false>
HWY_NOINLINE void contacts_apart(const ApartRows& rows, std::size_t size, const ContactQuestion& question,
                                 const CoreColumns& from, const ContactRows& out, Left& left) {
  const D tag;
  const PointOn on1 = turned ? question.points.second : question.points.first;
  const PointOn on2 = turned ? question.points.first : question.points.second;
  constexpr std::size_t kFirst = turned ? 6 : 3;
  for (std::size_t i = 0; i < size; i += hn::Lanes(tag)) {
    const V decision = hn::LoadU(tag, from.decision + i);
    M hit = hn::Eq(decision, all(CoreColumns::kHit));
    M miss = hn::Eq(decision, all(CoreColumns::kMiss));
    if (wrote_misses(miss, out, i)) continue;
    const Delta d = load(from.d, i);
    const V radius1 = hn::LoadU(tag, rows.radius1 + i);
    const V radius2 = hn::LoadU(tag, rows.radius2 + i);
    const V d_error = hn::LoadU(tag, from.d_error + i);
    // A point is a number; an error above 0 has room for underflows.
    const V p_error = is_point ? all(bounds::kLeast) : hn::LoadU(tag, from.p_error + i);
    const Direction n(d, plain_square(d));
    const V length = n.root.high;
    const V turn = hn::Mul(hn::Mul(d_error, all(bounds::kTurn)), n.reciprocal);
    const V of_length = hn::Add(turn, all(bounds::kCoreError));
    const M clear = hn::Ge(length, hn::Mul(d_error, all(bounds::kClear)));

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
      hit = hn::Or(hit, hn::And(clear, nearer));
      miss = hn::Or(miss, hn::And(clear, farther));
    }

    M flat_x = none();
    M flat_y = flat_x;
    M flat_z = flat_x;
    if (HWY_UNLIKELY(from.has_flat[i])) {
      flat_x = hn::MaskFromVec(hn::LoadU(tag, from.flat[0] + i));
      flat_y = hn::MaskFromVec(hn::LoadU(tag, from.flat[1] + i));
      flat_z = hn::MaskFromVec(hn::LoadU(tag, from.flat[2] + i));
    }
    Numbers numbers(out, i, hit, clear);
    const auto write_normal = [&](std::size_t k, V q, V low, M flat) HWY_ATTR {
      const Double2 number = turned ? Double2(hn::Neg(q), hn::Neg(low)) : Double2(q, low);
      numbers.write(k, number, hn::IfThenZeroElse(flat, turn));
    };
    write_normal(0, n.q.x, n.low.x, flat_x);
    write_normal(1, n.q.y, n.low.y, flat_y);
    write_normal(2, n.q.z, n.low.z, flat_z);
    const Double2 value = beyond(question.distances.contact);
    numbers.write(9, value, error);
    const auto core = [&](std::size_t axis) HWY_ATTR {
      if constexpr (is_point)
        return hn::LoadU(tag, rows.p[axis] + i);
      else
        return load(from.p, axis, i);
    };
    const auto write_points = [&](std::size_t k, const auto& from_first, V within) HWY_ATTR {
      numbers.write(k, point_beside(core(0), from_first, n.q.x, n.low.x), hn::IfThenZeroElse(flat_x, within));
      numbers.write(k + 1, point_beside(core(1), from_first, n.q.y, n.low.y), hn::IfThenZeroElse(flat_y, within));
      numbers.write(k + 2, point_beside(core(2), from_first, n.q.z, n.low.z), hn::IfThenZeroElse(flat_z, within));
    };
    const V signed1 = hn::Mul(radius1, all(sign_of(on1, 1)));
    write_points(kFirst, signed1, hn::MulAdd(radius1, of_length, p_error));
    Double2 to_second = to_surface;
    if (on2 != PointOn::nearest_surface) to_second = as_far_as(hn::Mul(radius2, all(sign_of(on2, -1))));
    write_points(9 - kFirst, to_second, hn::MulAdd(hn::Add(radius2, length), of_length, hn::Add(p_error, d_error)));
    numbers.finish(miss, size, left);
  }
}

/// The first half. (Two loops: each has a chain of operations that is short enough for the processor to begin the next
/// vectors, which takes a sixth of the time off.)
template <class A, class B>
HWY_INLINE void cores_of_vector(const PairColumns<A, B>& pairs, double alarm, std::size_t i, CoreColumns& to) {
  const Feet<A, B> feet(pairs, i);
  M miss;
  hn::StoreU(decision_of(feet, alarm, miss), D(), to.decision + i);
  if (!hn::AllTrue(D(), miss)) feet.find_cores(to, i);
}

template <class A, class B>
bool cores_of_strip(const PairColumns<A, B>& pairs, CoreColumns& to) {
  // No pair is plainly a miss.
  for (std::size_t i = 0; i < pairs.size; i += hn::Lanes(D()))
    cores_of_vector(pairs, std::numeric_limits<double>::max(), i, to);
  return true;
}

/// The second half, and what the vectors leave.
template <class A, class B>
void finish_contacts(const PairColumns<A, B>& pairs, const ContactQuestion& question, const ContactRows& out,
                     CoreColumns& cores, batch::Count& count) {
  Left left;
  Feet<A, B>::contacts(Strip<A, B>{pairs, question, cores, out, left});
  count.hits += left.hits;
  count.exact += left.size + left.exact;
  for (std::size_t k = 0; k < left.size; ++k) {
    const std::size_t row = left.rows[k];
    contact_of_one_pair(pairs, question, row, out, row);
    count.hits += out.state[row] != batch::PairState::miss ? 1U : 0U;
  }
}

/// All pairs of a strip, of which most are hits.
template <class A, class B>
void contacts_of_dense(const PairColumns<A, B>& pairs, const ContactQuestion& question, const ContactRows& out,
                       CoreColumns& cores, batch::Count& count) {
  for (std::size_t i = 0; i < pairs.size; i += hn::Lanes(D()))
    cores_of_vector(pairs, question.distances.alarm, i, cores);
  finish_contacts(pairs, question, out, cores, count);
}

// Lanes of a vector that are kept are pressed together from the first lane on, and spread again, with 0 between them.
// (Highway 1.0's Compress copies its table to the stack at every call.)
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX3

struct Press {
  M kept;

  HWY_INLINE explicit Press(unsigned bits) : kept{static_cast<__mmask8>(bits)} {}
  HWY_INLINE V operator()(V x) const { return V{_mm512_maskz_compress_pd(kept.raw, x.raw)}; }
};
struct Spreading {
  M kept;

  HWY_INLINE explicit Spreading(unsigned bits) : kept{static_cast<__mmask8>(bits)} {}
  HWY_INLINE V operator()(V x) const { return V{_mm512_maskz_expand_pd(kept.raw, x.raw)}; }
};

#else

/// By masks as bits: which lane each one takes, and all bits where it is kept.
struct LanesOfMasks {
  std::int64_t press[1 << kMostLanes][kMostLanes];
  std::int64_t spread[1 << kMostLanes][kMostLanes];
  std::int64_t kept[1 << kMostLanes][kMostLanes];

  constexpr LanesOfMasks() : press(), spread(), kept() {
    for (std::size_t mask = 0; mask < std::size(press); ++mask) {
      std::int64_t count = 0;
      for (std::size_t lane = 0; lane < kMostLanes; ++lane) {
        if ((mask >> lane & 1) == 0) continue;
        kept[mask][lane] = -1;
        spread[mask][lane] = count;
        press[mask][count++] = static_cast<std::int64_t>(lane);
      }
    }
  }
};
inline constexpr LanesOfMasks kLanesOfMasks;
using Lanes = decltype(hn::SetTableIndices(D(), static_cast<const std::int64_t*>(nullptr)));

struct Press {
  Lanes lanes;

  HWY_INLINE explicit Press(unsigned bits) : lanes(hn::SetTableIndices(D(), kLanesOfMasks.press[bits])) {}
  HWY_INLINE V operator()(V x) const { return hn::TableLookupLanes(x, lanes); }
};
struct Spreading {
  Lanes lanes;
  V kept;

  HWY_INLINE explicit Spreading(unsigned bits)
      : lanes(hn::SetTableIndices(D(), kLanesOfMasks.spread[bits])),
        kept(hn::BitCast(D(), hn::LoadU(hn::RebindToSigned<D>(), kLanesOfMasks.kept[bits]))) {}
  HWY_INLINE V operator()(V x) const { return hn::And(hn::TableLookupLanes(x, lanes), kept); }
};

#endif

/// The pairs of a strip that may be hits, pressed together, with room for their answers. What follows them to the end
/// of a vector are copies of the last one.
template <class A, class B>
struct Pressed {
  static constexpr std::size_t kFirst = kNumbersOf<A>;
  static constexpr std::size_t kSecond = kNumbersOf<B>;
  PairColumns<A, B> pairs;
  double rows[CoreColumns::kRoom];         ///< which of the strip
  std::uint8_t kept[CoreColumns::kPairs];  ///< of every vector of the strip, its lanes
  double numbers[kFirst + kSecond][CoreColumns::kRoom];
  double answers[ContactRows::kNumbers][CoreColumns::kRoom];
  batch::PairState states[CoreColumns::kRoom];
  CoreColumns cores;

  Pressed() {
    for (std::size_t k = 0; k < kFirst; ++k) pairs.a[k] = numbers[k];
    for (std::size_t k = 0; k < kSecond; ++k) pairs.b[k] = numbers[kFirst + k];
  }
  Pressed(const Pressed&) = delete;
  Pressed& operator=(const Pressed&) = delete;

  /// Which of the strip's pairs one is.
  [[nodiscard]] HWY_INLINE std::size_t row(std::size_t i) const { return static_cast<std::uint32_t>(rows[i]); }
  [[nodiscard]] ContactRows out() {
    ContactRows made{};
    for (std::size_t k = 0; k < ContactRows::kNumbers; ++k) made.number[k] = answers[k];
    made.state = states;
    return made;
  }

  /// Leaves their contacts in `to`, which has room for whole vectors.
  void compute(const PairColumns<A, B>& strip, const ContactQuestion& question, const ContactRows& to,
               batch::Count& count) {
    const D tag;
    const std::size_t lanes = hn::Lanes(tag);
    pairs.size = 0;
    for (std::size_t i = 0; i < strip.size; i += lanes) {
      M miss;
      const V decision = decision_of(Feet<A, B>(strip, i), question.distances.alarm, miss);
      const unsigned bits = bits_of(hn::Not(miss));
      kept[i / lanes] = static_cast<std::uint8_t>(bits);
      if (bits != 0) press(strip, i, bits, decision);
    }
    if (pairs.size == 0) return;
    const std::size_t room = (pairs.size + lanes - 1) / lanes * lanes;
    const auto fill_up = [&](double* column) { std::fill(column + pairs.size, column + room, column[pairs.size - 1]); };
    for (double* column : numbers) fill_up(column);
    fill_up(cores.decision);
    for (std::size_t i = 0; i < pairs.size; i += lanes) Feet<A, B>(pairs, i).find_cores(cores, i);
    finish_contacts(pairs, question, to, cores, count);
  }

  /// Writes the answers to the rows of the strip, and misses between them.
  void spread(const ContactRows& to, std::size_t size) const {
    const D tag;
    std::size_t from = 0;
    for (std::size_t i = 0; i < size; i += hn::Lanes(tag)) {
      const unsigned bits = kept[i / hn::Lanes(tag)];
      const Spreading spreading(bits);
      for (std::size_t k = 0; k < ContactRows::kNumbers; ++k)
        hn::StoreU(spreading(hn::LoadU(tag, answers[k] + from)), tag, to.number[k] + i);
      from += static_cast<std::size_t>(std::popcount(bits));
    }
    std::fill_n(to.state, size, batch::PairState::miss);
    for (std::size_t i = 0; i < pairs.size; ++i) to.state[row(i)] = states[i];
  }

 private:
  HWY_INLINE void press(const PairColumns<A, B>& strip, std::size_t i, unsigned bits, V decision) {
    const D tag;
    const Press pressed(bits);
    const auto press_column = [&](V from, double* to) HWY_ATTR { hn::StoreU(pressed(from), tag, to + pairs.size); };
    for (std::size_t k = 0; k < kFirst; ++k) press_column(hn::LoadU(tag, strip.a[k] + i), numbers[k]);
    for (std::size_t k = 0; k < kSecond; ++k) press_column(hn::LoadU(tag, strip.b[k] + i), numbers[kFirst + k]);
    press_column(decision, cores.decision);
    press_column(hn::Iota(tag, static_cast<double>(i)), rows);
    pairs.size += static_cast<std::size_t>(std::popcount(bits));
  }
};

/// From how many sixteenths on a strip is dense: long vectors gain less from pressing.
constexpr std::size_t kDense = kMostLanes > 4 ? 7 : 10;

/// Of a strip of pairs few are hits, or many: what most of them are of one strip is guessed of the next.
template <class A, class B>
batch::Count compute_cores(const PairColumns<A, B>& pairs, const ContactQuestion& question, const ContactRows& out) {
  batch::Count count;
  Pressed<A, B> pressed;
  const std::size_t whole = pairs.size - pairs.size % hn::Lanes(D());
  bool is_dense = false;
  for (std::size_t begin = 0; begin < whole; begin += CoreColumns::kPairs) {
    const PairColumns<A, B> strip = pairs.from(begin, std::min(CoreColumns::kPairs, whole - begin));
    const ContactRows rows = out.from(begin);
    const std::size_t before = count.hits;
    if (is_dense) {
      contacts_of_dense(strip, question, rows, pressed.cores, count);
    } else {
      pressed.compute(strip, question, pressed.out(), count);
      pressed.spread(rows, strip.size);
    }
    is_dense = 16 * (count.hits - before) > kDense * strip.size;
  }
  if (whole == pairs.size) return count;

  const Padded last(pairs, whole);
  contacts_of_dense(last.pairs, question, pressed.out(), pressed.cores, count);
  for (std::size_t k = 0; k < ContactRows::kNumbers; ++k)
    std::copy_n(pressed.answers[k], last.count, out.number[k] + whole);
  std::copy_n(pressed.states, last.count, out.state + whole);
  return count;
}

template <class A, class B>
batch::Count compute_hits_cores(const PairColumns<A, B>& pairs, const ContactQuestion& question, std::uint32_t* index,
                                const ContactRows& out) {
  batch::Count count;
  Pressed<A, B> pressed;
  std::size_t found = 0;
  // Takes the rows of the first `size` of `from`, which may be the place that they go to, where they are hits.
  const auto take = [&](const ContactRows& from, std::size_t size, const auto& index_of) {
    for (std::size_t row = 0; row < size; ++row) {
      if (from.state[row] == batch::PairState::miss) continue;
      index[found] = static_cast<std::uint32_t>(index_of(row));
      for (std::size_t k = 0; k < ContactRows::kNumbers; ++k) out.number[k][found] = from.number[k][row];
      out.state[found++] = from.state[row];
    }
  };
  const std::size_t whole = pairs.size - pairs.size % hn::Lanes(D());
  for (std::size_t begin = 0; begin < whole; begin += CoreColumns::kPairs) {
    const PairColumns<A, B> strip = pairs.from(begin, std::min(CoreColumns::kPairs, whole - begin));
    const ContactRows rows = out.from(found);
    const std::size_t before = count.hits;
    pressed.compute(strip, question, rows, count);
    const std::size_t size = pressed.pairs.size;
    if (count.hits - before == size) {
      for (std::size_t row = 0; row < size; ++row)
        index[found + row] = static_cast<std::uint32_t>(begin + pressed.row(row));
      found += size;
    } else {
      take(rows, size, [&](std::size_t row) { return begin + pressed.row(row); });
    }
  }
  if (whole == pairs.size) return count;

  const Padded last(pairs, whole);
  const ContactRows rows = pressed.out();
  contacts_of_dense(last.pairs, question, rows, pressed.cores, count);
  take(rows, last.count, [&](std::size_t row) { return whole + row; });
  return count;
}

#else

// Without a fused multiply-add the numbers of hits come from the functions of one pair.

template <class A, class B>
bool cores_of_strip(const PairColumns<A, B>& /*pairs*/, CoreColumns& /*to*/) {
  return false;
}

/// Calls work(i) for every pair that may be a hit, in ascending order, and missed(i) for the others.
template <class A, class B, class Work, class Miss>
void for_each_that_may_be_hit(const PairColumns<A, B>& pairs, double alarm, const Work& work, const Miss& missed) {
  const auto of_vector = [&](const PairColumns<A, B>& columns, std::size_t at, std::size_t i) HWY_ATTR {
    M miss;
    M hit;
    Feet<A, B>(columns, at).filter(alarm, hit, miss);
    for_each_lane(miss, pairs.size - i, [&](std::size_t lane) { missed(i + lane); });
    for_each_lane(hn::Not(miss), pairs.size - i, [&](std::size_t lane) { work(i + lane); });
  };
  std::size_t i = 0;
  for (; i + hn::Lanes(D()) <= pairs.size; i += hn::Lanes(D())) of_vector(pairs, i, i);
  if (i < pairs.size) of_vector(Padded(pairs, i).pairs, 0, i);
}

template <class A, class B>
batch::Count compute_cores(const PairColumns<A, B>& pairs, const ContactQuestion& question, const ContactRows& out) {
  batch::Count count;
  for_each_that_may_be_hit(
      pairs, question.distances.alarm,
      [&](std::size_t i) {
        contact_of_one_pair(pairs, question, i, out, i);
        count.hits += out.state[i] != batch::PairState::miss ? 1U : 0U;
        ++count.exact;
      },
      [&](std::size_t i) {
        for (double* column : out.number) column[i] = 0;
        out.state[i] = batch::PairState::miss;
      });
  return count;
}
template <class A, class B>
batch::Count compute_hits_cores(const PairColumns<A, B>& pairs, const ContactQuestion& question, std::uint32_t* index,
                                const ContactRows& out) {
  batch::Count count;
  for_each_that_may_be_hit(
      pairs, question.distances.alarm,
      [&](std::size_t i) {
        contact_of_one_pair(pairs, question, i, out, count.hits);
        if (out.state[count.hits] != batch::PairState::miss) index[count.hits++] = static_cast<std::uint32_t>(i);
        ++count.exact;
      },
      [](std::size_t /*i*/) {});
  return count;
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
template <class A, class B>
batch::Count compute_hits_cores(const PairColumns<A, B>& pairs, const ContactQuestion& question, std::uint32_t* index,
                                const ContactRows& out) {
  return compute_hits_scalar(pairs, question, index, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace contact::kernel
#endif  // HWY_HAVE_FLOAT64

#endif  // once a target
