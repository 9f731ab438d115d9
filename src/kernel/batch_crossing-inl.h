// Many pairs of a triangle and a segment that may cross it at once: a ray and a triangle, a triangle and a line. The
// decisions are those of contact/plain_cores.hpp, the numbers those of cores_one_vector.hpp.
//
//   a the segment's start     d from there to its end     w from there to the vertex that u and v start from     n = u x v
//   X = a + (n.w / n.d) d     normal n / |n|, or -n / |n| where the segment is a ray
#if defined(CONTACT_KERNEL_BATCH_CROSSING_INL_H) == defined(HWY_TARGET_TOGGLE)  // once a target
#ifdef CONTACT_KERNEL_BATCH_CROSSING_INL_H
#undef CONTACT_KERNEL_BATCH_CROSSING_INL_H
#else
#define CONTACT_KERNEL_BATCH_CROSSING_INL_H
#endif

#include "kernel/batch_cores-inl.h"

#if HWY_HAVE_FLOAT64  // else nothing is here, and no attribute for it
HWY_BEFORE_NAMESPACE();
namespace contact::kernel {
namespace HWY_NAMESPACE {

/// A triangle and a segment along d, in plain arithmetic.
struct Crossing {
  Points w, d, u, v;

  HWY_INLINE Crossing(const Points& start, const Points& along, const Points& v0, const Points& v1, const Points& v2)
      : w(from_to(start, v0)), d(along), u(from_to(v0, v1)), v(from_to(v0, v2)) {}

  /// They cross where five numbers have one sign.
  HWY_INLINE void filter(double /*alarm*/, M& hit, M& miss) const {
    using plain = plain_decision::CoreBounds;
    const Points n = plain_cross(u, v);
    const Points q = plain_cross(w, d);
    const V through = plain_dot(n, d);
    const V at = plain_dot(n, w);
    const V of_u = plain_dot(v, q);
    const V of_v = hn::Neg(plain_dot(u, q));
    const V rest = hn::Sub(through, at);
    const V third = hn::Sub(through, hn::Add(of_u, of_v));
    const V least = hn::Min(hn::Min(hn::Min(at, rest), hn::Min(of_u, of_v)), third);
    const V most = hn::Max(hn::Max(hn::Max(at, rest), hn::Max(of_u, of_v)), third);
    const V of_w = magnitude(w);
    const V of_d = magnitude(d);
    const V u_size = magnitude(u);
    const V v_size = magnitude(v);
    const V uv = hn::Add(u_size, v_size);
    const V dw = hn::Add(of_d, of_w);
    const V size = hn::MulAdd(hn::Mul(u_size, v_size), dw, hn::Mul(hn::Mul(of_d, of_w), uv));
    const V error = hn::MulAdd(size, all(plain::kSignGap), all(plain::kFloor));
    const M in_range = hn::Lt(hn::Add(uv, dw), all(plain::kMost));
    hit = hn::And(in_range, hn::Or(hn::Gt(least, error), hn::Lt(most, hn::Neg(error))));
    miss = hn::And(in_range, hn::And(hn::Lt(least, hn::Neg(error)), hn::Gt(most, error)));
  }
};

#if HWY_NATIVE_FMA

/// Which columns the second half reads: the segments' starts, and the triangles. `turned`: the normal is -n / |n|.
struct CrossingRows {
  const double* const* start;
  const double* const* triangle;
  bool turned;
};

/// x_i y_j - x_j y_i.
HWY_INLINE Double2 minor_of(Double2 xi, Double2 xj, Double2 yi, Double2 yj) {
  const Double2 one = product_of(xi, yj);
  const Double2 other = product_of(xj, yi);
  const Double2 high = two_difference(one.high, other.high);
  return {high.high, hn::Add(high.low, hn::Sub(one.low, other.low))};
}
HWY_INLINE Double2 normalised(Double2 x) {
  const V high = hn::Add(x.high, x.low);
  return {high, hn::Add(hn::Sub(x.high, high), x.low)};
}

/// The contacts of a strip of crossings; out has room for whole vectors.
HWY_NOINLINE void contacts_of_crossings(const CrossingRows& rows, std::size_t size, const CoreColumns& from,
                                        const ContactRows& out, Left& left) {
  const D tag;
  const V zero = all(0);
  for (std::size_t i = 0; i < size; i += hn::Lanes(tag)) {
    const V decision = hn::LoadU(tag, from.decision + i);
    const M hit = hn::Eq(decision, all(CoreColumns::kHit));
    const M miss = hn::Eq(decision, all(CoreColumns::kMiss));
    if (wrote_misses(miss, out, i)) continue;
    const Points a(rows.start, i);
    const Points v0(rows.triangle, i);
    const Delta d = load(from.d, i);
    const Delta u = exactly_from_to(v0, Points(rows.triangle + 3, i));
    const Delta v = exactly_from_to(v0, Points(rows.triangle + 6, i));
    const Delta w = exactly_from_to(a, v0);
    const Delta n(minor_of(u.y, u.z, v.y, v.z), minor_of(u.z, u.x, v.z, v.x), minor_of(u.x, u.y, v.x, v.y));
    const Double2 through = normalised(sum_of(products_of(n, d)));
    const Double2 at = normalised(sum_of(products_of(n, w)));
    const Double2 N = normalised(sum_of({square_of(n.x), square_of(n.y), square_of(n.z)}));
    const V reciprocal = hn::Div(all(1), through.high);
    const V q = hn::Mul(at.high, reciprocal);
    const V rest = hn::NegMulAdd(q, through.low, hn::Add(hn::NegMulAdd(q, through.high, at.high), at.low));
    const V part_low = hn::Mul(rest, reciprocal);

    const ReciprocalRoot root(N);
    const V y = root.reciprocal;
    const V signed_y = rows.turned ? hn::Neg(y) : y;

    const V size_of_d = magnitude(rounded_to_plain(d));
    const V S = hn::Mul(hn::Mul(magnitude(rounded_to_plain(u)), magnitude(rounded_to_plain(v))), all(1 + 0x1p-50));
    const V size_of_through = hn::Abs(through.high);
    const V k = hn::Mul(hn::Mul(S, hn::Abs(reciprocal)), all(1 + 0x1p-40));
    const V lengths = hn::Add(magnitude(rounded_to_plain(w)), size_of_d);
    const V part_error =
        hn::MulAdd(hn::Mul(k, lengths), all(96 * bounds::kUnitSquared), all(64 * bounds::kUnitSquared));
    const V turn = hn::Mul(hn::Mul(S, y), all(64 * bounds::kUnitSquared * bounds::kTurn));

    M clear = hn::Gt(size_of_through, hn::Mul(hn::Mul(S, size_of_d), all(0x1p-40)));
    clear = hn::And(clear, hn::Ge(size_of_through, all(bounds::kLeastThrough)));
    clear = hn::And(clear, hn::Ge(N.high, all(bounds::kLeastSize)));
    Numbers numbers(out, i, hit, clear);
    const auto write_normal = [&](std::size_t axis, Double2 of_n, Double2 ui, Double2 uj, Double2 vi, Double2 vj)
                                  HWY_ATTR {
                                    const auto is_zero = [&](Double2 x, Double2 z) HWY_ATTR {
                                      return hn::Or(hn::Eq(x.high, zero), hn::Eq(z.high, zero));
                                    };
                                    const M flat = hn::And(is_zero(ui, vj), is_zero(uj, vi));
                                    numbers.write(axis, root.along(of_n, signed_y), hn::IfThenZeroElse(flat, turn));
                                  };
    write_normal(0, n.x, u.y, u.z, v.y, v.z);
    write_normal(1, n.y, u.z, u.x, v.z, v.x);
    write_normal(2, n.z, u.x, u.y, v.x, v.y);
    const auto write_point = [&](std::size_t axis, V start, Double2 along, V corner, Double2 of_u,
                                 Double2 of_v) HWY_ATTR {
      // Along a plane of an axis the coordinate is the start's.
      const V error = hn::MulAdd(part_error, hn::Abs(along.high), all(bounds::kLeast));
      const Double2 x = point_beside(start, Double2(q, part_low), along.high, along.low);
      // Of a triangle across an axis it is the triangle's.
      const M level = hn::And(hn::Eq(of_u.high, zero), hn::Eq(of_v.high, zero));
      const Double2 number(hn::IfThenElse(level, corner, x.high), hn::IfThenZeroElse(level, x.low));
      numbers.write(3 + axis, number, hn::IfThenZeroElse(hn::Or(level, hn::Eq(along.high, zero)), error));
      hn::StoreU(hn::LoadU(tag, out.number[3 + axis] + i), tag, out.number[6 + axis] + i);
    };
    write_point(0, a.x, d.x, v0.x, u.x, v.x);
    write_point(1, a.y, d.y, v0.y, u.y, v.y);
    write_point(2, a.z, d.z, v0.z, u.z, v.z);
    numbers.write_exact(9, zero);
    numbers.finish(miss, size, left);
  }
}

#endif

template <>
struct Feet<Ray, Triangle> : Crossing {
  using Pairs = PairColumns<Ray, Triangle>;
  Points direction;
  V length;

  HWY_INLINE Feet(const Pairs& pairs, std::size_t i)
      : Feet(pairs, Points(&pairs.a[3], i), hn::LoadU(D(), pairs.a[6] + i), i) {}

#if HWY_NATIVE_FMA
  HWY_INLINE void find_cores(CoreColumns& to, std::size_t i) const { store(exactly_times(length, direction), to.d, i); }
  static void contacts(const Strip<Ray, Triangle>& of) {
    contacts_of_crossings({of.pairs.a.data(), of.pairs.b.data(), true}, of.pairs.size, of.cores, of.out, of.left);
  }
#endif

 private:
  HWY_INLINE Feet(const Pairs& pairs, const Points& along, V times_that, std::size_t i)
      : Crossing(Points(&pairs.a[0], i), times(times_that, along), Points(&pairs.b[0], i), Points(&pairs.b[3], i),
                 Points(&pairs.b[6], i)),
        direction(along),
        length(times_that) {}
};

template <>
struct Feet<Triangle, Line> : Crossing {
  using Pairs = PairColumns<Triangle, Line>;
  Points start, end;

  HWY_INLINE Feet(const Pairs& pairs, std::size_t i) : Feet(pairs, Points(&pairs.b[0], i), Points(&pairs.b[3], i), i) {}

#if HWY_NATIVE_FMA
  HWY_INLINE void find_cores(CoreColumns& to, std::size_t i) const { store(exactly_from_to(start, end), to.d, i); }
  static void contacts(const Strip<Triangle, Line>& of) {
    contacts_of_crossings({of.pairs.b.data(), of.pairs.a.data(), false}, of.pairs.size, of.cores, of.out, of.left);
  }
#endif

 private:
  HWY_INLINE Feet(const Pairs& pairs, const Points& first, const Points& last, std::size_t i)
      : Crossing(first, from_to(first, last), Points(&pairs.a[0], i), Points(&pairs.a[3], i), Points(&pairs.a[6], i)),
        start(first),
        end(last) {}
};

}  // namespace HWY_NAMESPACE
}  // namespace contact::kernel
HWY_AFTER_NAMESPACE();
#endif  // HWY_HAVE_FLOAT64

#endif  // once a target
