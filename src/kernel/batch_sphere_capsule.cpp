// Many pairs of a sphere and a capsule at once.
//
//   delta = w + t v     w = start - center     v = end - start     t = -(v.w) / (v.v), clamped
//
// t comes from plain arithmetic. The delta of this t is computed in double-double arithmetic, and how far it is from
// perpendicular to v corrects t, by so little that plain arithmetic has the correction.
#ifndef HWY_TARGET_INCLUDE  // else one of those of batch_vectors.cpp
#define HWY_TARGET_INCLUDE "kernel/batch_sphere_capsule.cpp"
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
struct Feet<Ball, Capsule> {
  Points center, start, end;
  Points w, v;  // rounded
  V ww, vv, minus_reciprocal, t, radii;

  HWY_INLINE Feet(const SphereCapsulePairs& pairs, std::size_t i)
      : center(&pairs.a[0], i),
        start(&pairs.b[0], i),
        end(&pairs.b[3], i),
        w(from_to(center, start)),
        v(from_to(start, end)),
        ww(plain_dot(w, w)),
        vv(plain_dot(v, v)) {
    // A segment whose square is nothing is its start.
    minus_reciprocal = hn::IfThenElseZero(hn::Ge(vv, all(bounds::kLeast)), hn::Div(all(-1), vv));
    t = clamped(hn::Mul(plain_dot(v, w), minus_reciprocal));
    radii = hn::Add(hn::LoadU(D(), pairs.a[3] + i), hn::LoadU(D(), pairs.b[6] + i));
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
  HWY_INLINE void find_cores(CoreColumns& to, std::size_t i) const {
    const Delta along = exactly_from_to(start, end);
    const Delta d = moved(exactly_from_to(center, start), t, along);
    const V correction = hn::Mul(dot(d, along), minus_reciprocal);
    const V step = hn::Max(hn::Min(correction, hn::Sub(all(1), t)), hn::Neg(t));
    store(stepped(d, step, along), to.d, i);
    const M holds = hn::And(hn::Ge(ww, all(bounds::kLeastSquare)), hn::Le(hn::Max(ww, vv), all(bounds::kMostSquare)));
    store_error(hn::Mul(magnitude(w), all(bounds::kFootError)), holds, to.d_error + i);
  }
#endif
};

#endif  // HWY_HAVE_FLOAT64

batch::Count test_sphere_capsules(const SphereCapsulePairs& pairs, double alarm, std::uint8_t* hit) {
  return test_cores(pairs, alarm, hit);
}
batch::Count compute_sphere_capsules(const SphereCapsulePairs& pairs, const ContactQuestion& question,
                                     const ContactRows& out) {
  return compute_cores(pairs, question, out);
}
bool cores_of_sphere_capsules(const SphereCapsulePairs& pairs, CoreColumns& to) { return cores_of_strip(pairs, to); }

}  // namespace HWY_NAMESPACE
}  // namespace contact::kernel
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace contact::kernel {

HWY_EXPORT(test_sphere_capsules);
HWY_EXPORT(compute_sphere_capsules);
HWY_EXPORT(cores_of_sphere_capsules);

bool find_cores(const SphereCapsulePairs& pairs, CoreColumns& to) {
  return HWY_DYNAMIC_DISPATCH(cores_of_sphere_capsules)(pairs, to);
}

batch::Count test_vectors(const SphereCapsulePairs& pairs, double alarm, std::uint8_t* hit) {
  return HWY_DYNAMIC_DISPATCH(test_sphere_capsules)(pairs, alarm, hit);
}

batch::Count compute_vectors(const SphereCapsulePairs& pairs, const ContactQuestion& question, const ContactRows& out) {
  return HWY_DYNAMIC_DISPATCH(compute_sphere_capsules)(pairs, question, out);
}

batch::Count compute_hits_vectors(const SphereCapsulePairs& pairs, const ContactQuestion& question,
                                  std::uint32_t* index, const ContactRows& out) {
  return compute_hits_by_strips(pairs, question, index, out);
}

}  // namespace contact::kernel
#endif  // HWY_ONCE
