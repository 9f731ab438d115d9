// Many pairs of a sphere and a cube at once, strip by strip.
//
//   beside an edge or a corner   two balls, the second the nearest point of the box, whose coordinates are numbers of
//                                the question: such points are written to columns, and the kernel of two balls answers
//   before a face, and inside    along an axis every number of the contact is a sum of numbers of the question, which
//                                two numbers hold: another pass over the strip writes them
#ifndef HWY_TARGET_INCLUDE  // else one of those of batch_vectors.cpp
#define HWY_TARGET_INCLUDE "kernel/batch_sphere_cube.cpp"
#endif
#include "kernel/batch_targets.hpp"
// foreach_target.h includes this file once a target, so it comes before the rest.
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <limits>

#include "kernel/batch_arithmetic-inl.h"
#include "kernel/batch_strips.hpp"
#include "kernel/sphere_sphere_numbers.hpp"

#ifndef CONTACT_KERNEL_BATCH_SPHERE_CUBE
#define CONTACT_KERNEL_BATCH_SPHERE_CUBE
namespace contact::kernel {

/// Pairs of a strip as balls: what is not among the columns of the question. Some room between columns keeps them from
/// the same place in a page, where loads look like recent stores to the processor.
struct NearestPoints {
  double point[3][kStrip + 24];
  double no_extent[kStrip] = {};
  double radius[kStrip];  ///< of the spheres, but for those along an axis

  [[nodiscard]] SpherePairs balls(const SphereCubePairs& pairs, const double* radii) const {
    return {{pairs.a[0], pairs.a[1], pairs.a[2], radii}, {point[0], point[1], point[2], no_extent}, pairs.size};
  }
};

/// What the pass over those along an axis says of the pairs of a strip.
enum class AlongAxis : std::uint8_t {
  miss = 0,
  contact = 1,
  degenerate = 2,
  left = 3,  ///< two numbers do not hold the value, or two faces are as near
  none = 4,  ///< not along an axis: the kernel of two balls has answered
};

}  // namespace contact::kernel
#endif

HWY_BEFORE_NAMESPACE();
namespace contact::kernel {
namespace HWY_NAMESPACE {

#if HWY_HAVE_FLOAT64

/// A vector of pairs and the nearest points.
struct Nearest {
  V cx, cy, cz, qx, qy, qz;
  M at_x, at_y, at_z;  ///< where they have the centre's coordinate

  HWY_INLINE Nearest(const SphereCubePairs& pairs, std::size_t i) {
    const D d;
    cx = hn::LoadU(d, pairs.a[0] + i);
    cy = hn::LoadU(d, pairs.a[1] + i);
    cz = hn::LoadU(d, pairs.a[2] + i);
    qx = clamped(pairs, 0, i, cx);
    qy = clamped(pairs, 1, i, cy);
    qz = clamped(pairs, 2, i, cz);
    at_x = hn::Eq(cx, qx);
    at_y = hn::Eq(cy, qy);
    at_z = hn::Eq(cz, qz);
  }
  [[nodiscard]] HWY_INLINE M inside() const { return hn::And(at_x, hn::And(at_y, at_z)); }
  /// On two axes at least.
  [[nodiscard]] HWY_INLINE M along_axis() const {
    return hn::Or(hn::And(at_x, hn::Or(at_y, at_z)), hn::And(at_y, at_z));
  }

 private:
  HWY_INLINE static V clamped(const SphereCubePairs& pairs, std::size_t axis, std::size_t i, V center) {
    const D d;
    return hn::Min(hn::Max(center, hn::LoadU(d, pairs.b[axis] + i)), hn::LoadU(d, pairs.b[3 + axis] + i));
  }
};

HWY_INLINE void nearest_of_vector(const SphereCubePairs& pairs, std::size_t i, std::size_t to, NearestPoints& out) {
  const D d;
  const Nearest nearest(pairs, i);
  hn::StoreU(nearest.qx, d, out.point[0] + to);
  hn::StoreU(nearest.qy, d, out.point[1] + to);
  hn::StoreU(nearest.qz, d, out.point[2] + to);
}

/// The same, and those along an axis are put aside: a point without extent that far from the centre.
HWY_INLINE void two_balls_of_vector(const SphereCubePairs& pairs, double aside, std::size_t i, std::size_t to,
                                    NearestPoints& out) {
  const D d;
  const Nearest nearest(pairs, i);
  const M along = nearest.along_axis();
  const V step = all(aside);
  const auto point = [&](V center, V q) HWY_ATTR { return hn::IfThenElse(along, hn::Add(center, step), q); };
  hn::StoreU(point(nearest.cx, nearest.qx), d, out.point[0] + to);
  hn::StoreU(point(nearest.cy, nearest.qy), d, out.point[1] + to);
  hn::StoreU(point(nearest.cz, nearest.qz), d, out.point[2] + to);
  hn::StoreU(hn::IfThenZeroElse(along, hn::LoadU(d, pairs.a[3] + i)), d, out.radius + to);
}

/// The face of each pair along an axis: its normal is +-1 on one of them.
struct Face {
  M on_x, on_y, on_z;
  V at, center, sign;
  M tied;  ///< inside: another face is as near by rounded depths, and may be nearer

  /// That before which the centre is.
  HWY_INLINE explicit Face(const Nearest& n)
      : on_x(hn::Not(n.at_x)), on_y(hn::Not(n.at_y)), on_z(hn::Not(n.at_z)), tied(hn::Lt(n.cx, n.cx)) {
    at = hn::IfThenElse(on_x, n.qx, hn::IfThenElse(on_y, n.qy, n.qz));
    center = hn::IfThenElse(on_x, n.cx, hn::IfThenElse(on_y, n.cy, n.cz));
    sign = hn::IfThenElse(hn::Lt(center, at), all(1), all(-1));
  }

  /// Where `inside`: the nearest one. Rounding is monotone: depths that differ after it differ so before.
  HWY_INLINE void take_nearest(const SphereCubePairs& pairs, const Nearest& n, std::size_t i, M inside) {
    const D d;
    V least = hn::Sub(n.cx, hn::LoadU(d, pairs.b[0] + i));
    V number = all(1);  // of the axis, with the sign of the normal
    V bound = hn::LoadU(d, pairs.b[0] + i);
    const auto try_face = [&](V depth, V of_face, double with_sign) HWY_ATTR {
      const M nearer = hn::Lt(depth, least);
      tied = hn::Or(hn::AndNot(nearer, tied), hn::Eq(depth, least));
      least = hn::Min(depth, least);
      number = hn::IfThenElse(nearer, all(with_sign), number);
      bound = hn::IfThenElse(nearer, of_face, bound);
    };
    const auto try_max = [&](V at_center, std::size_t axis) HWY_ATTR {
      const V max = hn::LoadU(d, pairs.b[3 + axis] + i);
      try_face(hn::Sub(max, at_center), max, -1.0 - static_cast<double>(axis));
    };
    const auto try_min = [&](V at_center, std::size_t axis) HWY_ATTR {
      const V min = hn::LoadU(d, pairs.b[axis] + i);
      try_face(hn::Sub(at_center, min), min, 1.0 + static_cast<double>(axis));
    };
    try_max(n.cx, 0);
    try_min(n.cy, 1);
    try_max(n.cy, 1);
    try_min(n.cz, 2);
    try_max(n.cz, 2);
    tied = hn::And(hn::And(tied, inside), hn::Gt(least, all(0)));  // 0 is the depth itself
    at = hn::IfThenElse(inside, bound, at);
    sign = hn::IfThenElse(inside, hn::CopySign(all(1), number), sign);
    const V axis = hn::Abs(number);
    on_x = hn::Or(on_x, hn::And(inside, hn::Eq(axis, all(1))));
    on_y = hn::Or(on_y, hn::And(inside, hn::Eq(axis, all(2))));
    on_z = hn::Or(on_z, hn::And(inside, hn::Eq(axis, all(3))));
    center = hn::IfThenElse(on_x, n.cx, hn::IfThenElse(on_y, n.cy, n.cz));
  }
};

/// Writes the contacts of those along an axis, and says of every pair what became of it.
HWY_INLINE void along_axis_of_vector(const SphereCubePairs& pairs, const ContactQuestion& question, std::size_t i,
                                     const ContactRows& out, std::size_t to, AlongAxis* states) {
  const D d;
  const Nearest n(pairs, i);
  const M along = n.along_axis();
  const M inside = n.inside();
  Face face(n);
  if (!hn::AllFalse(d, inside)) face.take_nearest(pairs, n, i, inside);
  // How far the centre lies before the face, 0 or less inside; sums of two numbers are compared part by part.
  const Double2 before = two_difference(hn::Mul(face.sign, face.at), hn::Mul(face.sign, face.center));
  const V radius = hn::LoadU(d, pairs.a[3] + i);
  const Double2 reach = two_sum(radius, all(question.distances.alarm));
  const M nearer = hn::Lt(before.high, reach.high);
  const M hit = hn::Or(nearer, hn::And(hn::Eq(before.high, reach.high), hn::Le(before.low, reach.low)));
  SumOfTwo<V> value(before);
  value.add(hn::Neg(radius));
  value.add(all(-question.distances.contact));
  // Where a distance overflows, what is lost is no number; a reach that does is beyond every other distance.
  const M sure = hn::AndNot(face.tied, hn::Eq(value.lost, all(0)));

  const auto write = [&](std::size_t k, V number)
                         HWY_ATTR { hn::BlendedStore(hn::IfThenElseZero(hit, number), along, d, out.number[k] + to); };
  write(0, hn::IfThenElseZero(face.on_x, face.sign));
  write(1, hn::IfThenElseZero(face.on_y, face.sign));
  write(2, hn::IfThenElseZero(face.on_z, face.sign));
  // Every zero is +0, as a sum with +0 is.
  const V zero = all(0);
  const V step = hn::MulAdd(face.sign, hn::Mul(radius, all(sign_of(question.points.first, 1))), zero);
  write(3, hn::Add(n.cx, hn::IfThenElseZero(face.on_x, step)));
  write(4, hn::Add(n.cy, hn::IfThenElseZero(face.on_y, step)));
  write(5, hn::Add(n.cz, hn::IfThenElseZero(face.on_z, step)));
  write(6, hn::Add(hn::IfThenElse(face.on_x, face.at, n.cx), zero));
  write(7, hn::Add(hn::IfThenElse(face.on_y, face.at, n.cy), zero));
  write(8, hn::Add(hn::IfThenElse(face.on_z, face.at, n.cz), zero));
  write(9, value.rounded());

  const hn::RebindToUnsigned<D> words;
  const auto say = [&](M where, AlongAxis what, auto otherwise) HWY_ATTR {
    return hn::IfThenElse(hn::RebindMask(words, where), hn::Set(words, static_cast<std::uint64_t>(what)), otherwise);
  };
  auto said = say(hit, AlongAxis::contact, hn::Zero(words));
  said = say(inside, AlongAxis::degenerate, said);
  said = say(hn::Not(sure), AlongAxis::left, said);
  said = say(hn::Not(along), AlongAxis::none, said);
  const hn::Rebind<std::uint8_t, D> bytes;
  hn::StoreU(hn::TruncateTo(bytes, said), bytes, reinterpret_cast<std::uint8_t*>(states));
}

/// Calls of_vector(pairs, i, to) for every vector of a strip, whose numbers go to places from `to` on.
template <class OfVector>
HWY_INLINE void for_each_vector(const SphereCubePairs& strip, const OfVector& of_vector) {
  const std::size_t lanes = hn::Lanes(D());
  std::size_t i = 0;
  for (; i + lanes <= strip.size; i += lanes) of_vector(strip, i, i);
  if (i < strip.size) of_vector(Padded(strip, i).pairs, 0, i);
}

void nearest_points(const SphereCubePairs& strip, NearestPoints& out) {
  for_each_vector(strip, [&](const SphereCubePairs& pairs, std::size_t i, std::size_t to)
                             HWY_ATTR { nearest_of_vector(pairs, i, to, out); });
}

void two_balls(const SphereCubePairs& strip, double aside, NearestPoints& out) {
  for_each_vector(strip, [&](const SphereCubePairs& pairs, std::size_t i, std::size_t to)
                             HWY_ATTR { two_balls_of_vector(pairs, aside, i, to, out); });
}

void along_axis(const SphereCubePairs& strip, const ContactQuestion& question, const ContactRows& out,
                AlongAxis (&states)[kStrip]) {
  const std::size_t lanes = hn::Lanes(D());
  std::size_t i = 0;
  for (; i + lanes <= strip.size; i += lanes) along_axis_of_vector(strip, question, i, out, i, states + i);
  if (i == strip.size) return;
  double numbers[ContactRows::kNumbers][kMostLanes];
  ContactRows rows{};
  for (std::size_t k = 0; k < ContactRows::kNumbers; ++k) rows.number[k] = numbers[k];
  along_axis_of_vector(Padded(strip, i).pairs, question, 0, rows, 0, states + i);
  for (std::size_t lane = 0; i + lane < strip.size; ++lane)
    if (states[i + lane] < AlongAxis::left)
      for (std::size_t k = 0; k < ContactRows::kNumbers; ++k) out.number[k][i + lane] = numbers[k][lane];
}

#else  // no vectors of doubles, and no use for them

void nearest_points(const SphereCubePairs& /*strip*/, NearestPoints& /*out*/) {}
void two_balls(const SphereCubePairs& /*strip*/, double /*aside*/, NearestPoints& /*out*/) {}
void along_axis(const SphereCubePairs& /*strip*/, const ContactQuestion& /*question*/, const ContactRows& /*out*/,
                AlongAxis (&/*states*/)[kStrip]) {}

#endif  // HWY_HAVE_FLOAT64

bool has_doubles() { return HWY_HAVE_FLOAT64; }

}  // namespace HWY_NAMESPACE
}  // namespace contact::kernel
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace contact::kernel {

HWY_EXPORT(nearest_points);
HWY_EXPORT(two_balls);
HWY_EXPORT(along_axis);
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
  // Twice the alarm distance and more away, what is put aside is plainly a miss, which costs nothing; where that is
  // lost beside the centre or beyond any square, it is a hit without extent, whose numbers need no exact arithmetic.
  const double alarm = question.distances.alarm;
  const double aside = alarm < 0x1p400 ? 2 * alarm + 1 : 0;
  NearestPoints nearest;
  batch::Count count;
  for_each_strip(pairs, [&](const SphereCubePairs& strip, std::size_t begin) {
    const ContactRows rows = out.from(begin);
    HWY_DYNAMIC_DISPATCH(two_balls)(strip, aside, nearest);
    count.exact += compute_vectors_to_points(nearest.balls(strip, nearest.radius), question, rows).exact;
    AlongAxis states[kStrip];
    HWY_DYNAMIC_DISPATCH(along_axis)(strip, question, rows, states);
    for (std::size_t i = 0; i < strip.size; ++i)
      rows.state[i] = states[i] < AlongAxis::left ? static_cast<batch::PairState>(states[i]) : rows.state[i];
    const auto left = std::count(states, states + strip.size, AlongAxis::left);
    for (std::size_t i = 0; left != 0 && i < strip.size; ++i)
      if (states[i] == AlongAxis::left) contact_of_one_pair(strip, question, i, rows, i);
    count.exact += static_cast<std::size_t>(left);
    count.hits +=
        strip.size - static_cast<std::size_t>(std::count(rows.state, rows.state + strip.size, batch::PairState::miss));
  });
  return count;
}

batch::Count compute_hits_vectors(const SphereCubePairs& pairs, const ContactQuestion& question, std::uint32_t* index,
                                  const ContactRows& out) {
  return compute_hits_by_strips(pairs, question, index, out);
}

}  // namespace contact::kernel
#endif  // HWY_ONCE
