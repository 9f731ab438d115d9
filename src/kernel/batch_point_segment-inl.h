// Many pairs of a point and a segment at once: a sphere and a capsule, a ray and a sphere.
//
//   delta = w + t v     w = start - center     v along the segment     t = -(v.w) / (v.v), clamped
//
// t comes from plain arithmetic. The delta of this t is computed in double-double arithmetic, and how far it is from
// perpendicular to v corrects t, by so little that plain arithmetic has the correction.
#if defined(CONTACT_KERNEL_BATCH_POINT_SEGMENT_INL_H) == defined(HWY_TARGET_TOGGLE)  // once a target
#ifdef CONTACT_KERNEL_BATCH_POINT_SEGMENT_INL_H
#undef CONTACT_KERNEL_BATCH_POINT_SEGMENT_INL_H
#else
#define CONTACT_KERNEL_BATCH_POINT_SEGMENT_INL_H
#endif

#include "kernel/batch_cores-inl.h"

#if HWY_HAVE_FLOAT64  // else nothing is here, and no attribute for it
HWY_BEFORE_NAMESPACE();
namespace contact::kernel {
namespace HWY_NAMESPACE {

/// The foot of a point on a segment along v, which is rounded.
struct FootOfPoint {
  Points center, start;
  Points w, v;
  V ww, vv, minus_reciprocal, t, radii;

  HWY_INLINE FootOfPoint(const Points& point, const Points& from, const Points& along, V of_both)
      : center(point),
        start(from),
        w(from_to(center, start)),
        v(along),
        ww(plain_dot(w, w)),
        vv(plain_dot(v, v)),
        radii(of_both) {
    // A segment whose square is nothing is its start.
    minus_reciprocal = hn::Neg(reciprocal_or_zero(vv));
    t = clamped(hn::Mul(plain_dot(v, w), minus_reciprocal));
  }

  HWY_INLINE void filter(double alarm, M& hit, M& miss) const {
    const Points d = plus(w, t, v);
    const V d2 = plain_dot(d, d);
    const V reach = hn::Add(radii, all(alarm));
    const V sum = hn::MulAdd(reach, reach, d2);
    const V difference = hn::NegMulAdd(reach, reach, d2);
    const V of_foot = hn::MulAdd(ww, all(bounds::kFootGap), all(bounds::kFootFloor));
    const V gap = hn::MulAdd(sum, all(bounds::kFilterGap), of_foot);
    const M in_range = hn::Le(vv, all(bounds::kMostSquare));
    hit = hn::And(in_range, hn::Lt(difference, hn::Neg(gap)));
    miss = hn::And(in_range, hn::Gt(difference, gap));
  }

#if HWY_NATIVE_FMA
  /// `along` is v exactly.
  template <class InPlane>
  HWY_INLINE void find_foot(const Delta& along, const InPlane& in_plane, CoreColumns& to, std::size_t i) const {
    const Delta d = moved(exactly_from_to(center, start), t, along);
    const V correction = hn::Mul(dot(d, along), minus_reciprocal);
    const V step = hn::Max(hn::Min(correction, hn::Sub(all(1), t)), hn::Neg(t));
    store_way(stepped(d, step, along), in_plane, to, i);
    const M holds = hn::And(hn::Ge(ww, all(bounds::kLeastSquare)), hn::Le(hn::Max(ww, vv), all(bounds::kMostSquare)));
    store_error(hn::Mul(magnitude(w), all(bounds::kFootError)), holds, to.d_error + i);
  }
#endif
};

template <>
struct Feet<Ball, Capsule> : FootOfPoint {
  using Pairs = PairColumns<Ball, Capsule>;
  const Pairs& pairs;
  Points end;

  HWY_INLINE Feet(const Pairs& columns, std::size_t i)
      : Feet(columns, Points(&columns.b[0], i), Points(&columns.b[3], i), i) {}

#if HWY_NATIVE_FMA
  HWY_INLINE void find_cores(CoreColumns& to, std::size_t i) const {
    const auto in_plane = [&](std::size_t axis) HWY_ATTR {
      return hn::And(same(pairs.a[axis], pairs.b[axis], i), same(pairs.a[axis], pairs.b[3 + axis], i));
    };
    find_foot(exactly_from_to(start, end), in_plane, to, i);
  }
  static void contacts(const Strip<Ball, Capsule>& of) {
    const auto& [a, b, size] = of.pairs;
    contacts_apart<true>({{a[0], a[1], a[2]}, a[3], b[6]}, size, of.question, of.cores, of.out, of.left);
  }
#endif

 private:
  HWY_INLINE Feet(const Pairs& columns, const Points& first, const Points& last, std::size_t i)
      : FootOfPoint(Points(&columns.a[0], i), first, from_to(first, last), radii_of(columns, i)),
        pairs(columns),
        end(last) {}
};

template <>
struct Feet<Ray, Ball> : FootOfPoint {
  using Pairs = PairColumns<Ray, Ball>;
  const Pairs& pairs;
  Points direction;
  V ray;

  HWY_INLINE Feet(const Pairs& columns, std::size_t i)
      : Feet(columns, Points(&columns.a[3], i), hn::LoadU(D(), columns.a[6] + i), i) {}

#if HWY_NATIVE_FMA
  HWY_INLINE void find_cores(CoreColumns& to, std::size_t i) const {
    const auto in_plane = [&](std::size_t axis) HWY_ATTR {
      return hn::And(same(pairs.b[axis], pairs.a[axis], i), hn::Eq(hn::LoadU(D(), pairs.a[3 + axis] + i), all(0)));
    };
    find_foot(exactly_times(ray, direction), in_plane, to, i);
  }
  static void contacts(const Strip<Ray, Ball>& of) {
    const auto& [a, b, size] = of.pairs;
    contacts_apart<true, true>({{b[0], b[1], b[2]}, b[3], kZeros}, size, of.question, of.cores, of.out, of.left);
  }
#endif

 private:
  HWY_INLINE Feet(const Pairs& columns, const Points& along, V length, std::size_t i)
      : FootOfPoint(Points(&columns.b[0], i), Points(&columns.a[0], i), times(length, along), radii_of(columns, i)),
        pairs(columns),
        direction(along),
        ray(length) {}
};

}  // namespace HWY_NAMESPACE
}  // namespace contact::kernel
HWY_AFTER_NAMESPACE();
#endif  // HWY_HAVE_FLOAT64

#endif  // once a target
