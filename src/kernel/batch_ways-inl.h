// Many pairs of two segments, or of a point and a triangle, at once: two capsules, a sphere and a triangle.
//
//   delta = w + s u + t v     w from one core to the other, u and v along the segments or edges     |delta|^2 = least
//
// s and t come from plain arithmetic. The delta of these is computed in double-double arithmetic, and its products with
// u and v say how far off they are: of those that are at no end, by so little that plain arithmetic has the correction,
// and of those at an end, whether they belong there. The decisions are those of contact/plain_cores.hpp.
#if defined(CONTACT_KERNEL_BATCH_WAYS_INL_H) == defined(HWY_TARGET_TOGGLE)  // once a target
#ifdef CONTACT_KERNEL_BATCH_WAYS_INL_H
#undef CONTACT_KERNEL_BATCH_WAYS_INL_H
#else
#define CONTACT_KERNEL_BATCH_WAYS_INL_H
#endif

#include "kernel/batch_cores-inl.h"

#if HWY_HAVE_FLOAT64  // else nothing is here, and no attribute for it
HWY_BEFORE_NAMESPACE();
namespace contact::kernel {
namespace HWY_NAMESPACE {

/// The products of w, u and v.
struct Spread {
  V ww, uu, vv, uv, uw, vw;

  HWY_INLINE Spread(const Points& w, const Points& u, const Points& v)
      : ww(plain_dot(w, w)),
        uu(plain_dot(u, u)),
        vv(plain_dot(v, v)),
        uv(plain_dot(u, v)),
        uw(plain_dot(u, w)),
        vw(plain_dot(v, w)) {}
  [[nodiscard]] HWY_INLINE V size() const { return hn::Add(ww, hn::Add(uu, vv)); }
};

struct Weights {
  V s, t;

  HWY_INLINE Weights(V of_u, V of_v) : s(of_u), t(of_v) {}
};

/// What weights prove. `together`: s + t is at most 1; else each of them is.
template <bool together>
HWY_INLINE void filter_weights(const Spread& x, const Weights& weights, V reach, M& hit, M& miss) {
  using plain = plain_decision::CoreBounds;
  const auto& [s, t] = weights;
  const V along_u = hn::Add(x.uw, hn::MulAdd(s, x.uu, hn::Mul(t, x.uv)));
  const V along_v = hn::Add(x.vw, hn::MulAdd(s, x.uv, hn::Mul(t, x.vv)));
  const V along_w = hn::Add(x.ww, hn::MulAdd(s, x.uw, hn::Mul(t, x.vw)));
  const V moved = hn::MulAdd(s, along_u, hn::Mul(t, along_v));
  const V u_takes = hn::Min(along_u, all(0));
  const V v_takes = hn::Min(along_v, all(0));
  const V takes = together ? hn::Min(u_takes, v_takes) : hn::Add(u_takes, v_takes);
  const V d2 = hn::Add(along_w, moved);
  const V least = hn::MulAdd(all(2), takes, hn::Sub(along_w, moved));
  const V reach2 = hn::Mul(reach, reach);
  const V sizes = hn::Add(x.size(), reach2);
  const V gap = hn::MulAdd(sizes, all(plain::kGap), all(plain::kFloor));
  const M in_range = hn::Lt(sizes, all(plain::kMost));
  hit = hn::And(in_range, hn::Gt(hn::Sub(reach2, d2), gap));
  miss = hn::And(in_range, hn::Gt(hn::Sub(least, reach2), gap));
}

#if HWY_NATIVE_FMA

/// The ways w + s u + t v, exactly.
struct Ways {
  Delta w, u, v;
  Spread x;

  HWY_INLINE Ways(const Delta& of_w, const Delta& of_u, const Delta& of_v)
      : w(of_w), u(of_u), v(of_v), x(rounded_to_plain(w), rounded_to_plain(u), rounded_to_plain(v)) {}

  /// The shortest of them, near which the weights are. A weight that is 0, or 1 where each may be, stays there. Returns
  /// what s lacks.
  template <bool together, class InPlane>
  HWY_INLINE V find_shortest(const Weights& weights, const InPlane& in_plane, CoreColumns& to, std::size_t i) const {
    const V zero = all(0);
    const V one = all(1);
    const auto& [s, t] = weights;
    const Delta d = moved(moved(w, t, v), s, u);
    const V d_u = dot(d, u);
    const V d_v = dot(d, v);
    const auto at_end = [&](V weight) HWY_ATTR {
      const M at_start = hn::Eq(weight, zero);
      return together ? at_start : hn::Or(at_start, hn::Eq(weight, one));
    };
    const M s_ends = at_end(s);
    const M t_ends = at_end(t);
    const V A = hn::IfThenElse(s_ends, one, x.uu);
    const V E = hn::IfThenElse(t_ends, one, x.vv);
    const V B = hn::IfThenZeroElse(hn::Or(s_ends, t_ends), x.uv);
    const V by_s = hn::IfThenZeroElse(s_ends, d_u);
    const V by_t = hn::IfThenZeroElse(t_ends, d_v);
    const V AE = hn::Mul(A, E);
    const V determinant = hn::NegMulAdd(B, B, AE);
    const V reciprocal = hn::Div(one, determinant);
    const V s_step = hn::Mul(hn::MulSub(B, by_t, hn::Mul(E, by_s)), reciprocal);
    const V t_step = hn::Mul(hn::MulSub(B, by_s, hn::Mul(A, by_t)), reciprocal);
    store_way(stepped(stepped(d, t_step, v), s_step, u), in_plane, to, i);

    const V length1 = magnitude(rounded_to_plain(u));
    const V length2 = magnitude(rounded_to_plain(v));
    const V steps = hn::MulAdd(hn::Abs(s_step), length1, hn::Mul(hn::Abs(t_step), length2));
    const V lengths = hn::Add(hn::Add(length1, length2), magnitude(rounded_to_plain(w)));
    const V k = hn::Mul(AE, reciprocal);
    const V error = hn::Mul(k, hn::MulAdd(lengths, all(bounds::kFootError), hn::Mul(steps, all(bounds::kStepError))));
    const V size = x.size();
    M holds = hn::And(hn::Ge(size, all(bounds::kLeastSize)), hn::Le(size, all(bounds::kMostSize)));
    holds = hn::And(holds, hn::Ge(hn::Mul(determinant, all(bounds::kMostParallel)), AE));
    holds = hn::And(holds, hn::Ge(hn::Min(A, E), all(bounds::kLeastSize)));
    // At an end: beyond it the distance would still fall. Elsewhere: no end is within the error.
    const auto belongs = [&](M ends, V at, V step, V rising, V length) HWY_ATTR {
      const V outwards = together ? rising : hn::IfThenElse(hn::Eq(at, zero), rising, hn::Neg(rising));
      const V from_start = hn::Add(at, step);
      const V room = together ? from_start : hn::Min(from_start, hn::Sub(hn::Sub(one, at), step));
      return hn::Ge(hn::IfThenElse(ends, outwards, hn::Mul(room, length)),
                    hn::IfThenElse(ends, hn::Mul(hn::Mul(error, all(2)), length), hn::Mul(error, all(4))));
    };
    holds = hn::And(holds, belongs(s_ends, s, s_step, hn::MulAdd(x.uv, t_step, d_u), length1));
    holds = hn::And(holds, belongs(t_ends, t, t_step, hn::MulAdd(x.uv, s_step, d_v), length2));
    if constexpr (together) {
      const V rest = hn::Sub(hn::Sub(one, hn::Add(s, s_step)), hn::Add(t, t_step));
      holds = hn::And(holds, hn::Ge(rest, all(bounds::kLeastRest)));
      holds = hn::And(holds, hn::Ge(hn::Mul(rest, hn::Min(length1, length2)), hn::Mul(error, all(8))));
    }
    store_error(error, holds, to.d_error + i);
    return s_step;
  }
};

#endif

/// Backwards along the first axis, and along the second.
template <>
struct Feet<Capsule, Capsule> {
  using Pairs = PairColumns<Capsule, Capsule>;
  const Pairs& pairs;
  Points start1, end1, start2, end2;
  Spread x;
  Weights weights;
  V radii;

  HWY_INLINE Feet(const Pairs& columns, std::size_t i)
      : pairs(columns),
        start1(&pairs.a[0], i),
        end1(&pairs.a[3], i),
        start2(&pairs.b[0], i),
        end2(&pairs.b[3], i),
        x(from_to(start1, start2), from_to(end1, start1), from_to(start2, end2)),
        weights(weights_of_segments(x)),
        radii(radii_of(pairs, i)) {}

  HWY_INLINE void filter(double alarm, M& hit, M& miss) const {
    filter_weights<false>(x, weights, hn::Add(radii, all(alarm)), hit, miss);
  }

#if HWY_NATIVE_FMA
  HWY_INLINE void find_cores(CoreColumns& to, std::size_t i) const {
    const auto in_plane = [&](std::size_t axis) HWY_ATTR {
      const auto as_start = [&](const double* column) HWY_ATTR { return same(pairs.a[axis], column, i); };
      return hn::And(as_start(pairs.a[3 + axis]), hn::And(as_start(pairs.b[axis]), as_start(pairs.b[3 + axis])));
    };
    const Ways way(exactly_from_to(start1, start2), exactly_from_to(end1, start1), exactly_from_to(start2, end2));
    const V step = hn::Neg(way.find_shortest<false>(weights, in_plane, to, i));
    const auto first = [&](V start, Double2 back) HWY_ATTR {
      return stepped(moved(Double2(start, all(0)), hn::Neg(weights.s), back), step, back);
    };
    store({first(start1.x, way.u.x), first(start1.y, way.u.y), first(start1.z, way.u.z)}, to.p, i);
    hn::StoreU(hn::LoadU(D(), to.d_error + i), D(), to.p_error + i);
  }
  static void contacts(const Strip<Capsule, Capsule>& of) {
    const auto& [a, b, size] = of.pairs;
    contacts_apart<false>({{}, a[6], b[6]}, size, of.question, of.cores, of.out, of.left);
  }
#endif

 private:
  /// Each is the best one for the other, as far as it goes.
  HWY_INLINE static Weights weights_of_segments(const Spread& x) {
    const V numerator = hn::MulSub(x.uv, x.vw, hn::Mul(x.vv, x.uw));
    const V determinant = hn::MulSub(x.uu, x.vv, hn::Mul(x.uv, x.uv));
    const V at_first = clamped(hn::Mul(numerator, reciprocal_or_zero(determinant)));
    const V t = clamped(hn::Neg(hn::Mul(hn::MulAdd(at_first, x.uv, x.vw), reciprocal_or_zero(x.vv))));
    return {clamped(hn::Neg(hn::Mul(hn::MulAdd(t, x.uv, x.uw), reciprocal_or_zero(x.uu)))), t};
  }
};

template <>
struct Feet<Ball, Triangle> {
  using Pairs = PairColumns<Ball, Triangle>;
  const Pairs& pairs;
  Points center, v0, v1, v2;
  Spread x;
  Weights weights;
  V radii;

  HWY_INLINE Feet(const Pairs& columns, std::size_t i)
      : pairs(columns),
        center(&pairs.a[0], i),
        v0(&pairs.b[0], i),
        v1(&pairs.b[3], i),
        v2(&pairs.b[6], i),
        x(from_to(center, v0), from_to(v0, v1), from_to(v0, v2)),
        weights(weights_of_triangle(x)),
        radii(radii_of(pairs, i)) {}

  HWY_INLINE void filter(double alarm, M& hit, M& miss) const {
    filter_weights<true>(x, weights, hn::Add(radii, all(alarm)), hit, miss);
  }

#if HWY_NATIVE_FMA
  HWY_INLINE void find_cores(CoreColumns& to, std::size_t i) const {
    const auto in_plane = [&](std::size_t axis) HWY_ATTR {
      const auto as_center = [&](std::size_t k) HWY_ATTR { return same(pairs.a[axis], pairs.b[k + axis], i); };
      return hn::And(as_center(0), hn::And(as_center(3), as_center(6)));
    };
    // On the edge across, or at its ends, the ways start there.
    const V one = all(1);
    const auto& [s, t] = weights;
    const M between = hn::And(hn::Gt(t, all(0)), hn::Eq(s, hn::Sub(one, t)));
    const M at_last = hn::Or(hn::Eq(t, one), between);
    const M at_next = hn::AndNot(at_last, hn::Eq(s, one));
    const Points first = chosen(at_last, v2, chosen(at_next, v1, v0));
    const Ways way(exactly_from_to(center, first), exactly_from_to(first, chosen(at_next, v0, v1)),
                   exactly_from_to(first, chosen(at_last, v0, v2)));
    const Weights from_first(hn::IfThenZeroElse(at_next, s), hn::IfThenZeroElse(at_last, t));
    way.find_shortest<true>(from_first, in_plane, to, i);
  }
  static void contacts(const Strip<Ball, Triangle>& of) {
    const auto& [a, b, size] = of.pairs;
    contacts_apart<true>({{a[0], a[1], a[2]}, a[3], kZeros}, size, of.question, of.cores, of.out, of.left);
  }
#endif

 private:
  /// w leads to the vertex that u and v start from: over the face, or the nearest of the feet on its edges.
  HWY_INLINE static Weights weights_of_triangle(const Spread& x) {
    const V zero = all(0);
    const V one = all(1);
    const V two = all(2);
    // A foot on an edge, and what |w|^2 has there beside its own.
    const auto foot = [&](V slope, V length2)
                          HWY_ATTR { return clamped(hn::Neg(hn::Mul(slope, reciprocal_or_zero(length2)))); };
    const auto by = [&](V at, V slope, V length2)
                        HWY_ATTR { return hn::Mul(at, hn::MulAdd(at, length2, hn::Mul(two, slope))); };
    const V on_u = foot(x.uw, x.uu);
    const V by_u = by(on_u, x.uw, x.uu);
    const V on_v = foot(x.vw, x.vv);
    const V by_v = by(on_v, x.vw, x.vv);
    const V slope = hn::Add(hn::Sub(x.vw, x.uw), hn::Sub(x.uv, x.uu));  // from u to v
    const V length2 = hn::Add(hn::Sub(x.uu, x.uv), hn::Sub(x.vv, x.uv));
    const V across = foot(slope, length2);
    const V by_across = hn::Add(hn::MulAdd(two, x.uw, x.uu), by(across, slope, length2));
    const M is_v = hn::Lt(by_v, by_u);
    const M is_across = hn::Lt(by_across, hn::Min(by_v, by_u));
    const V of_u = hn::MulSub(x.uv, x.vw, hn::Mul(x.vv, x.uw));
    const V of_v = hn::MulSub(x.uv, x.uw, hn::Mul(x.uu, x.vw));
    const V of_both = hn::MulSub(x.uu, x.vv, hn::Mul(x.uv, x.uv));
    const M is_inside = hn::And(hn::And(hn::Gt(of_u, zero), hn::Gt(of_v, zero)), hn::Lt(hn::Add(of_u, of_v), of_both));
    const V s = hn::IfThenElse(is_across, hn::Sub(one, across), hn::IfThenZeroElse(is_v, on_u));
    const V t = hn::IfThenElse(is_across, across, hn::IfThenElseZero(is_v, on_v));
    const V per_both = hn::Div(one, of_both);
    return {hn::IfThenElse(is_inside, hn::Mul(of_u, per_both), s),
            hn::IfThenElse(is_inside, hn::Mul(of_v, per_both), t)};
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace contact::kernel
HWY_AFTER_NAMESPACE();
#endif  // HWY_HAVE_FLOAT64

#endif  // once a target
