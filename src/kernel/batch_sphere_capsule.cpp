// Many pairs of a sphere and a capsule at once.
//
//   delta = w + t v     w = start - center     v = end - start     t = -(v.w) / (v.v), clamped
//
// t comes from plain arithmetic. The delta of this t is computed in double-double arithmetic, and how far it is from
// perpendicular to v corrects t, by so little that plain arithmetic has the correction.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernel/batch_sphere_capsule.cpp"
#include "kernel/batch_targets.hpp"
// foreach_target.h includes this file once a target, so it comes before the rest.
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <limits>

#include "kernel/batch_cores-inl.h"

HWY_BEFORE_NAMESPACE();
namespace contact::kernel {
namespace HWY_NAMESPACE {

#if HWY_HAVE_FLOAT64

template <>
struct Feet<Ball, Capsule> {
  V radii;
  V cx, cy, cz, ax, ay, az, bx, by, bz;  // centre, start, end
  V wx, wy, wz, vx, vy, vz;              // rounded
  V ww, vv, minus_reciprocal, t;

  HWY_INLINE Feet(const SphereCapsulePairs& pairs, std::size_t i) {
    const D tag;
    cx = hn::LoadU(tag, pairs.a[0] + i);
    cy = hn::LoadU(tag, pairs.a[1] + i);
    cz = hn::LoadU(tag, pairs.a[2] + i);
    ax = hn::LoadU(tag, pairs.b[0] + i);
    ay = hn::LoadU(tag, pairs.b[1] + i);
    az = hn::LoadU(tag, pairs.b[2] + i);
    bx = hn::LoadU(tag, pairs.b[3] + i);
    by = hn::LoadU(tag, pairs.b[4] + i);
    bz = hn::LoadU(tag, pairs.b[5] + i);
    radii = hn::Add(hn::LoadU(tag, pairs.a[3] + i), hn::LoadU(tag, pairs.b[6] + i));
    wx = hn::Sub(ax, cx);
    wy = hn::Sub(ay, cy);
    wz = hn::Sub(az, cz);
    vx = hn::Sub(bx, ax);
    vy = hn::Sub(by, ay);
    vz = hn::Sub(bz, az);
    ww = squared_length(wx, wy, wz);
    vv = squared_length(vx, vy, vz);
    // A segment whose square is nothing is its start.
    minus_reciprocal = hn::IfThenElseZero(hn::Ge(vv, all(bounds::kLeast)), hn::Div(all(-1), vv));
    t = clamped(hn::Mul(plain_dot(vx, vy, vz, wx, wy, wz), minus_reciprocal));
  }

  HWY_INLINE void filter(double alarm, M& hit, M& miss) const {
    const V d2 = squared_length(hn::MulAdd(t, vx, wx), hn::MulAdd(t, vy, wy), hn::MulAdd(t, vz, wz));
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
    const Delta w{two_difference(ax, cx), two_difference(ay, cy), two_difference(az, cz)};
    const Delta v{two_difference(bx, ax), two_difference(by, ay), two_difference(bz, az)};
    const Delta d{moved(w.x, t, v.x), moved(w.y, t, v.y), moved(w.z, t, v.z)};
    const V step = hn::Max(hn::Min(hn::Mul(dot(d, v), minus_reciprocal), hn::Sub(all(1), t)), hn::Neg(t));
    store({stepped(d.x, step, v.x), stepped(d.y, step, v.y), stepped(d.z, step, v.z)}, to.d, i);
    const M holds = hn::And(hn::Ge(ww, all(bounds::kLeastSquare)), hn::Le(hn::Max(ww, vv), all(bounds::kMostSquare)));
    const V error = hn::Mul(magnitude(wx, wy, wz), all(bounds::kFootError));
    hn::StoreU(hn::IfThenElse(holds, error, all(std::numeric_limits<double>::infinity())), D(), to.d_error + i);
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

}  // namespace HWY_NAMESPACE
}  // namespace contact::kernel
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace contact::kernel {

HWY_EXPORT(test_sphere_capsules);
HWY_EXPORT(compute_sphere_capsules);

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
