// Many pairs of a sphere or a capsule and a plane at once: plane_cores.hpp, with the formulas of cores_one_vector.hpp.
//
//   p the lowest point     h = n.p - offset     s = h / |n|     normal -n / |n|     point1 p - r n / |n|
//   point2 p - s n / |n|   value s - r - contact
//
// Over a floor or beside a wall, a plane with a normal along an axis, each number is a sum of numbers of the question and
// of offset / |n|.
#if defined(CONTACT_KERNEL_BATCH_OVER_PLANE_INL_H) == defined(HWY_TARGET_TOGGLE)  // once a target
#ifdef CONTACT_KERNEL_BATCH_OVER_PLANE_INL_H
#undef CONTACT_KERNEL_BATCH_OVER_PLANE_INL_H
#else
#define CONTACT_KERNEL_BATCH_OVER_PLANE_INL_H
#endif

#include "kernel/batch_cores-inl.h"

#if HWY_HAVE_FLOAT64  // else nothing is here, and no attribute for it
HWY_BEFORE_NAMESPACE();
namespace contact::kernel {
namespace HWY_NAMESPACE {

/// A vector of planes and of radii over them, in plain arithmetic.
struct OverPlane {
  Points n;
  V offset, size_of_normal, radius;

  HWY_INLINE OverPlane(const double* const* plane, const double* radii, std::size_t i)
      : n(plane, i),
        offset(hn::LoadU(D(), plane[3] + i)),
        size_of_normal(magnitude(n)),
        radius(hn::LoadU(D(), radii + i)) {}

  /// The height of a point, times the length of n: between `low` and `high`.
  HWY_INLINE void height(const Points& c, V size, V& low, V& high) const {
    using plain = plain_decision::CoreBounds;
    const V h = hn::Sub(plain_dot(n, c), offset);
    const V sizes = hn::MulAdd(size_of_normal, size, hn::Abs(offset));
    const V error = hn::MulAdd(sizes, all(plain::kHeightGap), all(plain::kFloor));
    low = hn::Sub(h, error);
    high = hn::Add(h, error);
  }
  /// Whether no number is so large that something overflows.
  [[nodiscard]] HWY_INLINE M is_in_range(V size, V reach) const {
    const V of_plane = hn::Add(size_of_normal, hn::Abs(offset));
    return hn::Lt(hn::Add(hn::Add(of_plane, size), reach), all(plain_decision::CoreBounds::kMost));
  }
  /// The lowest height against reach, each squared with its sign: nothing is divided, and no root is taken.
  HWY_INLINE void filter(V low, V high, V size, double alarm, M& hit, M& miss) const {
    const V reach = hn::Add(radius, all(alarm));
    const Points reached = times(reach, n);
    const V R = plain_dot(reached, reached);
    const V gap = hn::MulAdd(R, all(plain_decision::Bounds<double>::kGap), all(plain_decision::CoreBounds::kFloor));
    const M in_range = is_in_range(size, reach);
    hit = hn::And(in_range, hn::Lt(hn::MulAdd(high, hn::Abs(high), gap), R));
    miss = hn::And(in_range, hn::Lt(hn::Add(R, gap), hn::Mul(low, hn::Abs(low))));
  }
};

#if HWY_NATIVE_FMA

/// Which columns the second half reads: the lowest points, the planes, and the radii.
struct OverPlaneRows {
  std::array<const double*, 3> p;
  std::array<const double*, 4> plane;
  const double* radius;
};

/// The contacts over floors and beside walls, planes with a normal along an axis, of any length. The decision of those
/// that are `along` becomes certain where it is not; of those that are hits, the numbers are written. Returns where all
/// of them are certain.
HWY_INLINE M contacts_along_axis(const OverPlane& over, const Points& p, M along, const ContactQuestion& question,
                                 const ContactRows& out, std::size_t i, M& hit, M& miss) {
  const D tag;
  const V zero = all(0);
  // Exactly: the others of the three are 0.
  const Points unit(hn::Div(over.n.x, over.size_of_normal), hn::Div(over.n.y, over.size_of_normal),
                    hn::Div(over.n.z, over.size_of_normal));
  const V place = plain_dot(unit, p);
  const V plane = hn::Div(over.offset, over.size_of_normal);
  const V residual = hn::NegMulAdd(plane, over.size_of_normal, over.offset);
  const V rest = hn::Div(residual, over.size_of_normal);
  const M normal_offset = hn::Or(hn::Eq(over.offset, zero), hn::Ge(hn::Abs(over.offset), all(bounds::kLeast)));
  const M exact = hn::And(normal_offset, hn::Eq(residual, zero));
  SumOfTwo<V> height(place, hn::Neg(plane));
  height.add(hn::Neg(over.radius));
  const V sizes = hn::Add(hn::Add(hn::Abs(place), hn::Abs(plane)), over.radius);
  // The distance of the surfaces less another one: both ends of its interval, and whether nothing is lost.
  V above;
  V below;
  const auto beyond = [&](double other) HWY_ATTR {
    SumOfTwo<V> sum = height;
    sum.add(all(-other));
    const V error = hn::MulAdd(hn::Add(sizes, all(other)), all(bounds::kCoreError), all(bounds::kLeast));
    const V low = hn::Sub(sum.low, rest);
    above = hn::Add(sum.high, hn::Add(low, hn::IfThenZeroElse(exact, error)));
    below = hn::Add(sum.high, hn::Sub(low, hn::IfThenZeroElse(exact, error)));
    return hn::And(along, hn::Eq(sum.lost, zero));
  };
  const M decided = beyond(question.distances.alarm);
  hit = hn::Or(hit, hn::And(decided, hn::Le(above, zero)));
  miss = hn::Or(miss, hn::And(decided, hn::Gt(below, zero)));
  const M certain = and_equal(hn::And(beyond(question.distances.contact), hit), above, below);
  const auto write = [&](std::size_t k, V number) HWY_ATTR {
    const V otherwise = hn::LoadU(tag, out.number[k] + i);
    hn::StoreU(hn::IfThenElse(certain, hn::Add(number, zero), otherwise), tag, out.number[k] + i);  // every zero is +0
  };
  const V towards = hn::Mul(over.radius, all(-sign_of(question.points.first, 1)));
  const auto write_axis = [&](std::size_t axis, V n, V on) HWY_ATTR {
    write(axis, hn::Neg(n));
    write(3 + axis, hn::MulAdd(towards, n, on));
    write(6 + axis, hn::IfThenElse(hn::Eq(n, zero), on, hn::Mul(n, plane)));
  };
  write_axis(0, unit.x, p.x);
  write_axis(1, unit.y, p.y);
  write_axis(2, unit.z, p.z);
  write(9, above);
  return certain;
}

/// The contacts of a strip of lowest points over planes; out has room for whole vectors.
HWY_NOINLINE void contacts_over_plane(const OverPlaneRows& rows, std::size_t size, const ContactQuestion& question,
                                      const CoreColumns& from, const ContactRows& out, Left& left) {
  const D tag;
  for (std::size_t i = 0; i < size; i += hn::Lanes(tag)) {
    const V decision = hn::LoadU(tag, from.decision + i);
    M hit = hn::Eq(decision, all(CoreColumns::kHit));
    M miss = hn::Eq(decision, all(CoreColumns::kMiss));
    if (wrote_misses(miss, out, i)) continue;
    const Points p(rows.p.data(), i);
    const OverPlane over(rows.plane.data(), rows.radius, i);
    const Points& n = over.n;
    const V p_error = hn::LoadU(tag, from.p_error + i);
    const V zero = all(0);
    const M level_x = hn::Eq(n.x, zero);
    const M level_y = hn::Eq(n.y, zero);
    const M level_z = hn::Eq(n.z, zero);
    const M one_axis = hn::Or(hn::And(level_x, hn::Or(level_y, level_z)), hn::And(level_y, level_z));
    const M long_enough = hn::Ge(plain_dot(n, n), all(bounds::kLeastNormalSquare));
    const M along = hn::And(hn::And(one_axis, long_enough), hn::Eq(p_error, zero));
    Numbers numbers(out, i, hit, none());
    if (!hn::AllTrue(tag, hn::Or(along, miss))) {
      const Double2 N = sum_of(products_of(n, n));
      const ReciprocalRoot root(N);
      const V y = root.reciprocal;
      const Delta products = products_of(n, p);
      const Double2 sum = sum_of(products);
      const Double2 h = two_difference(sum.high, over.offset);
      const V q = hn::Mul(h.high, y);
      const V rest_of_q = hn::MulAdd(hn::Add(h.low, sum.low), y, hn::MulSub(h.high, y, q));
      const Double2 s(q, hn::MulAdd(q, root.half_rho, rest_of_q));
      const V distance = hn::Abs(q);
      const V sizes = hn::Add(magnitude(rounded_to_plain(products)), hn::Abs(over.offset));
      const V s_error = hn::Add(hn::MulAdd(hn::Mul(sizes, all(bounds::kOverPlane)), y, all(bounds::kLeast)), p_error);
      V error;
      // The distance of the surfaces less another one, and its error.
      const auto beyond = [&](double other) HWY_ATTR {
        const Double2 rest = two_sum(over.radius, all(other));
        const Double2 difference = two_difference(s.high, rest.high);
        error = hn::MulAdd(hn::Add(distance, rest.high), all(bounds::kCoreError), s_error);
        return Double2(difference.high, hn::Add(difference.low, hn::Sub(s.low, rest.low)));
      };
      const M clear = hn::AndNot(one_axis, long_enough);
      if (HWY_UNLIKELY(!hn::AllTrue(tag, hn::Or(hit, miss)))) {
        const Double2 gap = beyond(question.distances.alarm);
        const M nearer = hn::Lt(hn::Add(gap.high, hn::Add(gap.low, error)), zero);
        const M farther = hn::Gt(hn::Add(gap.high, hn::Sub(gap.low, error)), zero);
        hit = hn::Or(hit, hn::And(clear, nearer));
        miss = hn::Or(miss, hn::And(clear, farther));
      }
      numbers.hit = hit;
      numbers.certain = hn::And(hit, clear);
      const Double2 value = beyond(question.distances.contact);
      numbers.write(9, value, error);
      const V minus_y = hn::Neg(y);
      const V signed1 = hn::Mul(over.radius, all(sign_of(question.points.first, 1)));
      const V error1 = hn::MulAdd(over.radius, all(bounds::kCoreError), all(bounds::kLeast));
      const V error2 = hn::MulAdd(distance, all(bounds::kCoreError), s_error);
      const auto write_axis = [&](std::size_t axis, V of_n, V core, M level) HWY_ATTR {
        const Double2 m = root.along(of_n, minus_y);
        numbers.write(axis, m, hn::IfThenZeroElse(level, all(bounds::kLeast)));
        numbers.write(3 + axis, point_beside(core, signed1, m.high, m.low), hn::IfThenZeroElse(level, error1));
        numbers.write(6 + axis, point_beside(core, s, m.high, m.low), hn::IfThenZeroElse(level, error2));
      };
      write_axis(0, n.x, p.x, level_x);
      write_axis(1, n.y, p.y, level_y);
      write_axis(2, n.z, p.z, level_z);
    } else {
      for (double* column : out.number) hn::StoreU(zero, tag, column + i);
    }
    if (!hn::AllFalse(tag, along))
      numbers.certain = hn::Or(numbers.certain, contacts_along_axis(over, p, along, question, out, i, hit, miss));
    numbers.finish(miss, size, left);
  }
}

#endif

template <>
struct Feet<Ball, Plane> : OverPlane {
  using Pairs = PairColumns<Ball, Plane>;
  Points center;

  HWY_INLINE Feet(const Pairs& pairs, std::size_t i)
      : OverPlane(pairs.b.data(), pairs.a[3], i), center(&pairs.a[0], i) {}

  HWY_INLINE void filter(double alarm, M& hit, M& miss) const {
    const V size = magnitude(center);
    V low;
    V high;
    height(center, size, low, high);
    OverPlane::filter(low, high, size, alarm, hit, miss);
  }

#if HWY_NATIVE_FMA
  HWY_INLINE void find_cores(CoreColumns& to, std::size_t i) const {
    store_error(all(0), is_in_range(magnitude(center), radius), to.p_error + i);
  }
  static void contacts(const Strip<Ball, Plane>& of) {
    const auto& [a, b, size] = of.pairs;
    contacts_over_plane({{a[0], a[1], a[2]}, b, a[3]}, size, of.question, of.cores, of.out, of.left);
  }
#endif
};

template <>
struct Feet<Capsule, Plane> : OverPlane {
  using Pairs = PairColumns<Capsule, Plane>;
  Points start, end;

  HWY_INLINE Feet(const Pairs& pairs, std::size_t i)
      : OverPlane(pairs.b.data(), pairs.a[6], i), start(&pairs.a[0], i), end(&pairs.a[3], i) {}

  HWY_INLINE void filter(double alarm, M& hit, M& miss) const {
    const V of_start = magnitude(start);
    const V of_end = magnitude(end);
    V low[2];
    V high[2];
    height(start, of_start, low[0], high[0]);
    height(end, of_end, low[1], high[1]);
    OverPlane::filter(hn::Min(low[0], low[1]), hn::Min(high[0], high[1]), hn::Add(of_start, of_end), alarm, hit, miss);
  }

#if HWY_NATIVE_FMA
  /// Left are those whose ends are nearly level.
  HWY_INLINE void find_cores(CoreColumns& to, std::size_t i) const {
    const D tag;
    const Points of_start(hn::Mul(n.x, start.x), hn::Mul(n.y, start.y), hn::Mul(n.z, start.z));
    const Points of_end(hn::Mul(n.x, end.x), hn::Mul(n.y, end.y), hn::Mul(n.z, end.z));
    const Points rises = from_to(of_start, of_end);
    const V rise = hn::Add(hn::Add(rises.x, rises.y), rises.z);
    const V sizes = hn::Add(magnitude(of_start), magnitude(of_end));
    const V least = hn::MulAdd(sizes, all(8 * bounds::kUnit), all(bounds::kLeast));
    const Points lowest = chosen(hn::Gt(rise, all(0)), start, end);
    hn::StoreU(lowest.x, tag, to.p[0] + i);
    hn::StoreU(lowest.y, tag, to.p[2] + i);
    hn::StoreU(lowest.z, tag, to.p[4] + i);
    const M in_range = is_in_range(hn::Add(magnitude(start), magnitude(end)), radius);
    store_error(all(0), hn::And(in_range, hn::Gt(hn::Abs(rise), least)), to.p_error + i);
  }
  static void contacts(const Strip<Capsule, Plane>& of) {
    const auto& p = of.cores.p;
    contacts_over_plane({{p[0], p[2], p[4]}, of.pairs.b, of.pairs.a[6]}, of.pairs.size, of.question, of.cores, of.out,
                        of.left);
  }
#endif
};

}  // namespace HWY_NAMESPACE
}  // namespace contact::kernel
HWY_AFTER_NAMESPACE();
#endif  // HWY_HAVE_FLOAT64

#endif  // once a target
