// Many pairs of a sphere and a cube at once. Outside the box a pair is two balls, the second the nearest point of the
// box, whose coordinates are numbers of the question: strip by strip these points are written to columns, and the
// kernel of two balls answers. A centre in the box or on it goes to the function of one pair.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernel/batch_sphere_cube.cpp"
#include "kernel/batch_targets.hpp"
// foreach_target.h includes this file once a target, so it comes before the rest.
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "kernel/batch_columns-inl.h"
#include "kernel/batch_strips.hpp"

#ifndef CONTACT_KERNEL_BATCH_SPHERE_CUBE
#define CONTACT_KERNEL_BATCH_SPHERE_CUBE
namespace contact::kernel {

/// Pairs of a strip as balls: what is not among the columns of the question.
struct NearestPoints {
  double point[3][kStrip];
  double no_extent[kStrip] = {};
  double radius[kStrip];  ///< of the spheres, but for centres inside
  std::uint8_t inside[kStrip];

  [[nodiscard]] SpherePairs balls(const SphereCubePairs& pairs, const double* radii) const {
    return {{pairs.a[0], pairs.a[1], pairs.a[2], radii}, {point[0], point[1], point[2], no_extent}, pairs.size};
  }
};

}  // namespace contact::kernel
#endif

HWY_BEFORE_NAMESPACE();
namespace contact::kernel {
namespace HWY_NAMESPACE {

#if HWY_HAVE_FLOAT64

HWY_INLINE V clamped(const SphereCubePairs& pairs, std::size_t axis, std::size_t i, V center) {
  const D d;
  return hn::Min(hn::Max(center, hn::LoadU(d, pairs.b[axis] + i)), hn::LoadU(d, pairs.b[3 + axis] + i));
}

HWY_INLINE void nearest_of_vector(const SphereCubePairs& pairs, std::size_t i, std::size_t to, NearestPoints& out) {
  const D d;
  for (std::size_t axis = 0; axis < 3; ++axis)
    hn::StoreU(clamped(pairs, axis, i, hn::LoadU(d, pairs.a[axis] + i)), d, out.point[axis] + to);
}

/// The same, and a centre inside is left out: a point without extent `aside` of it.
HWY_INLINE void outside_of_vector(const SphereCubePairs& pairs, double aside, std::size_t i, std::size_t to,
                                  NearestPoints& out) {
  const D d;
  const V x = hn::LoadU(d, pairs.a[0] + i);
  const V y = hn::LoadU(d, pairs.a[1] + i);
  const V z = hn::LoadU(d, pairs.a[2] + i);
  const V on_x = clamped(pairs, 0, i, x);
  const V on_y = clamped(pairs, 1, i, y);
  const V on_z = clamped(pairs, 2, i, z);
  const M inside = hn::And(hn::And(hn::Eq(x, on_x), hn::Eq(y, on_y)), hn::Eq(z, on_z));
  const V step = hn::IfThenElseZero(inside, all(aside));
  hn::StoreU(hn::Add(on_x, step), d, out.point[0] + to);
  hn::StoreU(hn::Add(on_y, step), d, out.point[1] + to);
  hn::StoreU(hn::Add(on_z, step), d, out.point[2] + to);
  hn::StoreU(hn::IfThenZeroElse(inside, hn::LoadU(d, pairs.a[3] + i)), d, out.radius + to);
  store_flags(inside, out.inside + to);
}

/// Calls of_vector(pairs, i, to) for every vector of a strip.
template <class OfVector>
HWY_INLINE void for_each_vector(const SphereCubePairs& pairs, const OfVector& of_vector) {
  const std::size_t lanes = hn::Lanes(D());
  std::size_t i = 0;
  for (; i + lanes <= pairs.size; i += lanes) of_vector(pairs, i, i);
  if (i < pairs.size) of_vector(Padded(pairs, i).pairs, 0, i);
}

void nearest_points(const SphereCubePairs& strip, NearestPoints& out) {
  for_each_vector(strip, [&](const SphereCubePairs& pairs, std::size_t i, std::size_t to)
                             HWY_ATTR { nearest_of_vector(pairs, i, to, out); });
}

void points_outside(const SphereCubePairs& strip, double aside, NearestPoints& out) {
  for_each_vector(strip, [&](const SphereCubePairs& pairs, std::size_t i, std::size_t to)
                             HWY_ATTR { outside_of_vector(pairs, aside, i, to, out); });
}

#else  // no vectors of doubles, and no use for them

void nearest_points(const SphereCubePairs& /*strip*/, NearestPoints& /*out*/) {}
void points_outside(const SphereCubePairs& /*strip*/, double /*aside*/, NearestPoints& /*out*/) {}

#endif  // HWY_HAVE_FLOAT64

bool has_doubles() { return HWY_HAVE_FLOAT64; }

}  // namespace HWY_NAMESPACE
}  // namespace contact::kernel
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace contact::kernel {

HWY_EXPORT(nearest_points);
HWY_EXPORT(points_outside);
HWY_EXPORT(has_doubles);

batch::Count test_vectors(const SphereCubePairs& pairs, double alarm, std::uint8_t* hit) {
  if (!HWY_DYNAMIC_DISPATCH(has_doubles)()) return test_scalar(pairs, alarm, hit);
  NearestPoints nearest;
  batch::Count count;
  for_each_strip(pairs, [&](const SphereCubePairs& strip, std::size_t begin) {
    HWY_DYNAMIC_DISPATCH(nearest_points)(strip, nearest);
    count += test_vectors(nearest.balls(strip, strip.a[3]), alarm, hit + begin);
  });
  return count;
}

batch::Count compute_vectors(const SphereCubePairs& pairs, const ContactQuestion& question, const ContactRows& out) {
  if (!vectors_compute_contacts()) return compute_scalar(pairs, question, out);
  // Twice the alarm distance and more away, a centre inside is plainly a miss, which costs nothing; where that is lost
  // beside it or beyond any square, its ball without extent is a hit whose numbers need no exact arithmetic.
  const double alarm = question.distances.alarm;
  const double aside = alarm < 0x1p400 ? 2 * alarm + 1 : 0;
  NearestPoints nearest;
  batch::Count count;
  for_each_strip(pairs, [&](const SphereCubePairs& strip, std::size_t begin) {
    HWY_DYNAMIC_DISPATCH(points_outside)(strip, aside, nearest);
    const ContactRows rows = out.from(begin);
    count += compute_vectors(nearest.balls(strip, nearest.radius), question, rows);
    std::uint16_t left[kStrip];
    const std::size_t size = those_of(strip.size, left, [&](std::size_t i) { return nearest.inside[i] != 0; });
    for (std::size_t k = 0; k < size; ++k) {
      count.hits += rows.state[left[k]] == batch::PairState::miss ? 1U : 0U;
      contact_of_one_pair(strip, question, left[k], rows, left[k]);
    }
    count.exact += size;
  });
  return count;
}

batch::Count compute_hits_vectors(const SphereCubePairs& pairs, const ContactQuestion& question, std::uint32_t* index,
                                  const ContactRows& out) {
  return compute_hits_by_strips(pairs, question, index, out);
}

}  // namespace contact::kernel
#endif  // HWY_ONCE
