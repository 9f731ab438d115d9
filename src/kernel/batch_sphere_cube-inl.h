// Many pairs of a sphere and a cube at once. Hits are of two kinds:
//
//   beside an edge or a corner   two balls, the second the nearest point of the box, whose coordinates are numbers of
//                                the question: the kernel of two balls answers
//   before a face, and inside    along an axis every number of the contact is a sum of numbers of the question, which
//                                two numbers hold: another pass over the strip writes them
#if defined(CONTACT_KERNEL_BATCH_SPHERE_CUBE_INL_H) == defined(HWY_TARGET_TOGGLE)  // once a target
#ifdef CONTACT_KERNEL_BATCH_SPHERE_CUBE_INL_H
#undef CONTACT_KERNEL_BATCH_SPHERE_CUBE_INL_H
#else
#define CONTACT_KERNEL_BATCH_SPHERE_CUBE_INL_H
#endif

#include "kernel/batch_balls-inl.h"

#if HWY_HAVE_FLOAT64  // else nothing is here, and no attribute for it
HWY_BEFORE_NAMESPACE();
namespace contact::kernel {
namespace HWY_NAMESPACE {

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

#if HWY_NATIVE_FMA

/// The nearest points as balls without extent, with the radii of the others: [0, 1, 2] of `point` are columns of
/// coordinates. Those along an axis are put aside, a point without extent that far from the centre.
HWY_INLINE void two_balls_of_vector(const SphereCubePairs& pairs, double aside, std::size_t i,
                                    const std::array<double*, 3>& point, double* radius) {
  const D d;
  const Nearest nearest(pairs, i);
  const M along = nearest.along_axis();
  const V step = all(aside);
  const auto put = [&](std::size_t axis, V center, V q)
                       HWY_ATTR { hn::StoreU(hn::IfThenElse(along, hn::Add(center, step), q), d, point[axis] + i); };
  put(0, nearest.cx, nearest.qx);
  put(1, nearest.cy, nearest.qy);
  put(2, nearest.cz, nearest.qz);
  hn::StoreU(hn::IfThenZeroElse(along, hn::LoadU(d, pairs.a[3] + i)), d, radius + i);
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

/// Writes the contacts of those along an axis over what is there, and counts the hits of all.
HWY_INLINE void along_axis_of_vector(const SphereCubePairs& pairs, const ContactQuestion& question, std::size_t i,
                                     const ContactRows& out, Left& left) {
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
                         HWY_ATTR { hn::BlendedStore(hn::IfThenElseZero(hit, number), along, d, out.number[k] + i); };
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

  // What the kernel of two balls has said of the others stays.
  const hn::RebindToUnsigned<D> words;
  const hn::Rebind<std::uint8_t, D> bytes;
  std::uint8_t* const states = reinterpret_cast<std::uint8_t*>(out.state + i);
  const M open = hn::AndNot(sure, along);
  const M certain_hit = hn::And(hn::And(along, sure), hit);
  const auto word = [&](batch::PairState state) HWY_ATTR { return hn::Set(words, static_cast<std::uint64_t>(state)); };
  const auto stated = hn::PromoteTo(words, hn::PromoteTo(hn::Rebind<std::uint32_t, D>(), hn::LoadU(bytes, states)));
  const auto kept = hn::IfThenZeroElse(hn::RebindMask(words, along), stated);
  const auto of_hit = hn::IfThenElse(hn::RebindMask(words, inside), word(batch::PairState::degenerate),
                                     word(batch::PairState::contact));
  const auto said = hn::IfThenElse(hn::RebindMask(words, certain_hit), of_hit, kept);
  hn::StoreU(hn::TruncateTo(bytes, said), bytes, states);
  const M counted = hn::RebindMask(d, hn::Ne(said, hn::Zero(words)));
  left.hits += hn::CountTrue(d, hn::And(counted, hn::FirstN(d, pairs.size - i)));
  if (HWY_LIKELY(hn::AllFalse(d, open))) return;
  for_each_lane(open, pairs.size - i,
                [&](std::size_t lane) { left.rows[left.size++] = static_cast<std::uint16_t>(i + lane); });
}

#endif

template <>
struct Feet<Ball, Box> {
  Nearest nearest;
  V radius;

  HWY_INLINE Feet(const SphereCubePairs& pairs, std::size_t i)
      : nearest(pairs, i), radius(hn::LoadU(D(), pairs.a[3] + i)) {}

  HWY_INLINE void filter(double alarm, M& hit, M& miss) const {
    const V d2 = squared_length(hn::Sub(nearest.qx, nearest.cx), hn::Sub(nearest.qy, nearest.cy),
                                hn::Sub(nearest.qz, nearest.cz));
    kernel::HWY_NAMESPACE::filter(d2, hn::Add(radius, all(alarm)), hit, miss);
  }

#if HWY_NATIVE_FMA
  /// The second half begins with the question.
  HWY_INLINE void find_cores(CoreColumns& /*to*/, std::size_t /*i*/) const {}
  HWY_NOINLINE static void contacts(const Strip<Ball, Box>& of) {
    // Twice the alarm distance and more away, what is put aside is plainly a miss, which costs nothing; where that is
    // lost beside the centre or beyond any square, it is a hit without extent, whose numbers need no exact arithmetic.
    const double alarm = of.question.distances.alarm;
    const double aside = alarm < 0x1p400 ? 2 * alarm + 1 : 0;
    auto& [x, y, z, x_low, y_low, z_low] = of.cores.p;
    double* const radius = of.cores.p_error;
    const auto& [a, b, size] = of.pairs;
    for (std::size_t i = 0; i < size; i += hn::Lanes(D())) two_balls_of_vector(of.pairs, aside, i, {x, y, z}, radius);
    of.left.exact += contacts_with_points({{a[0], a[1], a[2], radius}, {x, y, z, kZeros}, size}, of.question, of.out);
    for (std::size_t i = 0; i < size; i += hn::Lanes(D()))
      along_axis_of_vector(of.pairs, of.question, i, of.out, of.left);
  }
#endif
};

}  // namespace HWY_NAMESPACE
}  // namespace contact::kernel
HWY_AFTER_NAMESPACE();
#endif  // HWY_HAVE_FLOAT64

#endif  // once a target
