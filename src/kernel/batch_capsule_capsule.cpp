// Many pairs of capsules at once.
//
//   delta = w + t v - s u     u, v along the axes, w from the first start to the second     |delta|^2 = least
//
// s and t come from plain arithmetic. The delta of these is computed in double-double arithmetic, and its products with
// u and v say how far off they are: of those that are at no end, by so little that plain arithmetic has the correction,
// and of those at an end, whether they belong there.
#ifndef HWY_TARGET_INCLUDE  // else one of those of batch_vectors.cpp
#define HWY_TARGET_INCLUDE "kernel/batch_capsule_capsule.cpp"
#endif
#include "kernel/batch_targets.hpp"
// foreach_target.h includes this file once a target, so it comes before the rest.
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "kernel/batch_cores-inl.h"

HWY_BEFORE_NAMESPACE();
namespace contact::kernel {
namespace HWY_NAMESPACE {

#if HWY_HAVE_FLOAT64

template <>
struct Feet<Capsule, Capsule> {
  Points start1, end1, start2, end2;
  Points u, v, w;  // rounded
  V uu, uv, vv, size, s, t, radii;

  HWY_INLINE Feet(const CapsulePairs& pairs, std::size_t i)
      : start1(&pairs.a[0], i),
        end1(&pairs.a[3], i),
        start2(&pairs.b[0], i),
        end2(&pairs.b[3], i),
        u(from_to(start1, end1)),
        v(from_to(start2, end2)),
        w(from_to(start1, start2)),
        uu(plain_dot(u, u)),
        uv(plain_dot(u, v)),
        vv(plain_dot(v, v)),
        size(hn::Add(hn::Add(plain_dot(w, w), uu), vv)) {
    const V uw = plain_dot(u, w);
    const V vw = plain_dot(v, w);
    const auto over = [](V numerator, V x) HWY_ATTR {
      return clamped(hn::Mul(numerator, hn::IfThenElseZero(hn::Ge(x, all(bounds::kLeast)), hn::Div(all(1), x))));
    };
    s = over(hn::MulSub(uw, vv, hn::Mul(uv, vw)), hn::MulSub(uu, vv, hn::Mul(uv, uv)));
    t = over(hn::MulSub(uv, s, vw), vv);
    s = over(hn::MulAdd(uv, t, uw), uu);
    radii = hn::Add(hn::LoadU(D(), pairs.a[6] + i), hn::LoadU(D(), pairs.b[6] + i));
  }

  /// Any points within reach prove a hit, and any direction along which the axes are farther apart a miss.
  HWY_INLINE void filter(double alarm, M& hit, M& miss) const {
    const Points d = plus(plus(w, t, v), hn::Neg(s), u);
    const V d2 = plain_dot(d, d);
    const V reach = hn::Add(radii, all(alarm));
    const V reach2 = hn::Mul(reach, reach);
    const V rounding = hn::Mul(size, all(bounds::kSegmentGap));
    const V gap = hn::MulAdd(hn::Add(d2, reach2), all(bounds::kFilterGap), rounding);
    const M in_range = hn::And(hn::Ge(size, all(bounds::kLeastSize)), hn::Le(size, all(bounds::kMostSize)));
    hit = hn::And(in_range, hn::Lt(hn::Sub(d2, reach2), hn::Neg(gap)));
    const V apart =
        hn::Sub(hn::Add(plain_dot(d, w), hn::Min(plain_dot(d, v), all(0))), hn::Max(plain_dot(d, u), all(0)));
    const V least = hn::MulAdd(reach2, all(1 + bounds::kSegmentGap), rounding);
    miss = hn::And(hn::And(in_range, hn::Ge(d2, all(bounds::kLeastSize))), hn::Gt(apart, all(0)));
    miss = hn::And(miss, hn::Gt(hn::Mul(apart, apart), hn::Mul(d2, least)));
  }

#if HWY_NATIVE_FMA
  HWY_INLINE void find_cores(CoreColumns& to, std::size_t i) const {
    const V zero = all(0);
    const V one = all(1);
    const Delta along1 = exactly_from_to(start1, end1);
    const Delta along2 = exactly_from_to(start2, end2);
    const Delta d = moved(moved(exactly_from_to(start1, start2), t, along2), hn::Neg(s), along1);
    const V d_u = dot(d, along1);
    const V d_v = dot(d, along2);

    const M s_ends = hn::Or(hn::Eq(s, zero), hn::Eq(s, one));
    const M t_ends = hn::Or(hn::Eq(t, zero), hn::Eq(t, one));
    const V A = hn::IfThenElse(s_ends, one, uu);
    const V E = hn::IfThenElse(t_ends, one, vv);
    const V B = hn::IfThenZeroElse(hn::Or(s_ends, t_ends), uv);
    const V by_s = hn::IfThenZeroElse(s_ends, d_u);
    const V by_t = hn::IfThenZeroElse(t_ends, d_v);
    const V AE = hn::Mul(A, E);
    const V determinant = hn::NegMulAdd(B, B, AE);
    const V reciprocal = hn::Div(one, determinant);
    const V s_step = hn::Mul(hn::MulSub(E, by_s, hn::Mul(B, by_t)), reciprocal);
    const V t_step = hn::Mul(hn::MulSub(B, by_s, hn::Mul(A, by_t)), reciprocal);
    store(stepped(stepped(d, t_step, along2), hn::Neg(s_step), along1), to.d, i);
    const auto first = [&](V start, Double2 along)
                           HWY_ATTR { return stepped(moved(Double2(start, zero), s, along), s_step, along); };
    store({first(start1.x, along1.x), first(start1.y, along1.y), first(start1.z, along1.z)}, to.p, i);

    const V length1 = magnitude(u);
    const V length2 = magnitude(v);
    const V steps = hn::MulAdd(hn::Abs(s_step), length1, hn::Mul(hn::Abs(t_step), length2));
    const V lengths = hn::Add(hn::Add(length1, length2), magnitude(w));
    const V k = hn::Mul(AE, reciprocal);
    const V error = hn::Mul(k, hn::MulAdd(lengths, all(bounds::kFootError), hn::Mul(steps, all(bounds::kStepError))));
    M holds = hn::And(hn::Ge(size, all(bounds::kLeastSize)), hn::Le(size, all(bounds::kMostSize)));
    holds = hn::And(holds, hn::Ge(hn::Mul(determinant, all(bounds::kMostParallel)), AE));
    holds = hn::And(holds, hn::Ge(hn::Min(A, E), all(bounds::kLeastSize)));
    // At an end: beyond it the distance would still fall. Elsewhere: no end is within the error.
    const auto belongs = [&](M ends, V at, V step, V rising, V length) HWY_ATTR {
      const V outwards = hn::IfThenElse(hn::Eq(at, zero), rising, hn::Neg(rising));
      const V room = hn::Mul(hn::Min(hn::Add(at, step), hn::Sub(hn::Sub(one, at), step)), length);
      return hn::Ge(hn::IfThenElse(ends, outwards, room),
                    hn::IfThenElse(ends, hn::Mul(hn::Mul(error, all(2)), length), hn::Mul(error, all(4))));
    };
    holds = hn::And(holds, belongs(s_ends, s, s_step, hn::Neg(hn::MulAdd(uv, t_step, d_u)), length1));
    holds = hn::And(holds, belongs(t_ends, t, t_step, hn::NegMulAdd(uv, s_step, d_v), length2));
    store_error(error, holds, to.d_error + i);
    store_error(error, holds, to.p_error + i);
  }
#endif
};

#endif  // HWY_HAVE_FLOAT64

batch::Count test_capsules(const CapsulePairs& pairs, double alarm, std::uint8_t* hit) {
  return test_cores(pairs, alarm, hit);
}
batch::Count compute_capsules(const CapsulePairs& pairs, const ContactQuestion& question, const ContactRows& out) {
  return compute_cores(pairs, question, out);
}
bool cores_of_capsules(const CapsulePairs& pairs, CoreColumns& to) { return cores_of_strip(pairs, to); }

}  // namespace HWY_NAMESPACE
}  // namespace contact::kernel
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace contact::kernel {

HWY_EXPORT(test_capsules);
HWY_EXPORT(compute_capsules);
HWY_EXPORT(cores_of_capsules);

bool find_cores(const CapsulePairs& pairs, CoreColumns& to) {
  return HWY_DYNAMIC_DISPATCH(cores_of_capsules)(pairs, to);
}

batch::Count test_vectors(const CapsulePairs& pairs, double alarm, std::uint8_t* hit) {
  return HWY_DYNAMIC_DISPATCH(test_capsules)(pairs, alarm, hit);
}

batch::Count compute_vectors(const CapsulePairs& pairs, const ContactQuestion& question, const ContactRows& out) {
  return HWY_DYNAMIC_DISPATCH(compute_capsules)(pairs, question, out);
}

batch::Count compute_hits_vectors(const CapsulePairs& pairs, const ContactQuestion& question, std::uint32_t* index,
                                  const ContactRows& out) {
  return compute_hits_by_strips(pairs, question, index, out);
}

}  // namespace contact::kernel
#endif  // HWY_ONCE
