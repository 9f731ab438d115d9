// Plain double arithmetic over structures of arrays: the formulas as upstream has them, and their bits. Numbers of
// pairs are multiples of every vector length.
#include "plain_batch.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plain_batch.cpp"
#include "kernel/batch_targets.hpp"
// foreach_target.h includes this file once a target, so it comes before the rest.
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <limits>

HWY_BEFORE_NAMESPACE();
namespace contact::bench {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<double>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

HWY_INLINE void store_flags(M flags, std::uint8_t* to) {
  const hn::Rebind<std::uint8_t, D> bytes;
  const hn::RebindToUnsigned<D> words;
  const auto ones = hn::IfThenElseZero(hn::RebindMask(words, flags), hn::Set(words, 1));
  hn::StoreU(hn::TruncateTo(bytes, ones), bytes, to);
}

/// Three numbers of each pair.
struct Axes {
  V x, y, z;

  HWY_INLINE Axes(V on_x, V on_y, V on_z) : x(on_x), y(on_y), z(on_z) {}
  HWY_INLINE Axes(const double* const* columns, std::size_t i)
      : x(hn::LoadU(D(), columns[0] + i)), y(hn::LoadU(D(), columns[1] + i)), z(hn::LoadU(D(), columns[2] + i)) {}
};
HWY_INLINE Axes operator-(const Axes& a, const Axes& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE Axes plus(const Axes& a, V t, const Axes& b) {
  return {hn::Add(a.x, hn::Mul(t, b.x)), hn::Add(a.y, hn::Mul(t, b.y)), hn::Add(a.z, hn::Mul(t, b.z))};
}
HWY_INLINE Axes times(V t, const Axes& a) { return {hn::Mul(t, a.x), hn::Mul(t, a.y), hn::Mul(t, a.z)}; }
HWY_INLINE V dot(const Axes& a, const Axes& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
HWY_INLINE Axes cross(const Axes& a, const Axes& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}
HWY_INLINE Axes chosen(M first, const Axes& a, const Axes& b) {
  return {hn::IfThenElse(first, a.x, b.x), hn::IfThenElse(first, a.y, b.y), hn::IfThenElse(first, a.z, b.z)};
}
HWY_INLINE V part(V numerator, V whole) {
  return hn::Min(hn::Max(hn::Div(numerator, whole), hn::Zero(D())), hn::Set(D(), 1));
}

/// Two spheres, and whether they meet.
struct Pair {
  Axes a;
  V ar;
  Axes b;
  V br;
  Axes delta;
  V d2, radii;
  M hit;

  HWY_INLINE Pair(const Axes& first, V radius1, const Axes& second, V radius2, double alarm)
      : a(first), ar(radius1), b(second), br(radius2), delta(b - a), d2(dot(delta, delta)), radii(hn::Add(ar, br)) {
    const V reach = hn::Add(radii, hn::Set(D(), alarm));
    hit = hn::Le(d2, hn::Mul(reach, reach));
  }
};

// Other shapes as the spheres at their nearest points.
HWY_INLINE Pair pair_of(const kernel::SpherePairs& pairs, std::size_t i, double alarm) {
  return {Axes(&pairs.a[0], i), hn::LoadU(D(), pairs.a[3] + i), Axes(&pairs.b[0], i), hn::LoadU(D(), pairs.b[3] + i),
          alarm};
}
HWY_INLINE Pair pair_of(const kernel::SphereCubePairs& pairs, std::size_t i, double alarm) {
  const Axes center(&pairs.a[0], i);
  const Axes min(&pairs.b[0], i);
  const Axes max(&pairs.b[3], i);
  const Axes clamped(hn::Min(hn::Max(center.x, min.x), max.x), hn::Min(hn::Max(center.y, min.y), max.y),
                     hn::Min(hn::Max(center.z, min.z), max.z));
  return {center, hn::LoadU(D(), pairs.a[3] + i), clamped, hn::Zero(D()), alarm};
}
HWY_INLINE Pair pair_of(const kernel::PairColumns<Ball, Capsule>& pairs, std::size_t i, double alarm) {
  const Axes center(&pairs.a[0], i);
  const Axes start(&pairs.b[0], i);
  const Axes v = Axes(&pairs.b[3], i) - start;
  const V t = part(hn::Neg(dot(v, start - center)), dot(v, v));
  return {center, hn::LoadU(D(), pairs.a[3] + i), plus(start, t, v), hn::LoadU(D(), pairs.b[6] + i), alarm};
}
HWY_INLINE Pair pair_of(const kernel::PairColumns<Capsule, Capsule>& pairs, std::size_t i, double alarm) {
  const Axes start1(&pairs.a[0], i);
  const Axes start2(&pairs.b[0], i);
  const Axes u = Axes(&pairs.a[3], i) - start1;
  const Axes v = Axes(&pairs.b[3], i) - start2;
  const Axes w = start2 - start1;
  const V A = dot(u, u);
  const V B = dot(u, v);
  const V C = dot(u, w);
  const V E = dot(v, v);
  const V F = dot(v, w);
  V s = part(hn::Sub(hn::Mul(C, E), hn::Mul(B, F)), hn::Sub(hn::Mul(A, E), hn::Mul(B, B)));
  const V t = part(hn::Sub(hn::Mul(B, s), F), E);
  s = part(hn::Add(hn::Mul(B, t), C), A);
  return {plus(start1, s, u), hn::LoadU(D(), pairs.a[6] + i), plus(start2, t, v), hn::LoadU(D(), pairs.b[6] + i),
          alarm};
}
HWY_INLINE Pair pair_of(const kernel::PairColumns<Ray, Ball>& pairs, std::size_t i, double alarm) {
  const Axes origin(&pairs.a[0], i);
  const Axes center(&pairs.b[0], i);
  const Axes v = times(hn::LoadU(D(), pairs.a[6] + i), Axes(&pairs.a[3], i));
  return {plus(origin, part(dot(center - origin, v), dot(v, v)), v), hn::Zero(D()), center,
          hn::LoadU(D(), pairs.b[3] + i), alarm};
}
/// Ericson's closest point on a triangle, all of its cases computed.
HWY_INLINE Pair pair_of(const kernel::PairColumns<Ball, Triangle>& pairs, std::size_t i, double alarm) {
  const V zero = hn::Zero(D());
  const Axes c(&pairs.a[0], i);
  const Axes v0(&pairs.b[0], i);
  const Axes v1(&pairs.b[3], i);
  const Axes v2(&pairs.b[6], i);
  const Axes u = v1 - v0;
  const Axes v = v2 - v0;
  const V d1 = dot(u, c - v0);
  const V d2_ = dot(v, c - v0);
  const V d3 = dot(u, c - v1);
  const V d4 = dot(v, c - v1);
  const V d5 = dot(u, c - v2);
  const V d6 = dot(v, c - v2);
  const V of0 = hn::Sub(hn::Mul(d3, d6), hn::Mul(d5, d4));
  const V of1 = hn::Sub(hn::Mul(d5, d2_), hn::Mul(d1, d6));
  const V of2 = hn::Sub(hn::Mul(d1, d4), hn::Mul(d3, d2_));
  const auto both = [](M a, M b) HWY_ATTR { return hn::And(a, b); };
  const V per_all = hn::Div(hn::Set(D(), 1), hn::Add(hn::Add(of0, of1), of2));
  Axes q = plus(plus(v0, hn::Mul(of1, per_all), u), hn::Mul(of2, per_all), v);
  const V across = hn::Sub(d4, d3);
  const V back = hn::Sub(d5, d6);
  q = chosen(both(both(hn::Le(of0, zero), hn::Ge(across, zero)), hn::Ge(back, zero)),
             plus(v1, hn::Div(across, hn::Add(across, back)), v2 - v1), q);
  q = chosen(both(both(hn::Le(of1, zero), hn::Ge(d2_, zero)), hn::Le(d6, zero)),
             plus(v0, hn::Div(d2_, hn::Sub(d2_, d6)), v), q);
  q = chosen(both(hn::Ge(d6, zero), hn::Le(d5, d6)), v2, q);
  q = chosen(both(both(hn::Le(of2, zero), hn::Ge(d1, zero)), hn::Le(d3, zero)),
             plus(v0, hn::Div(d1, hn::Sub(d1, d3)), u), q);
  q = chosen(both(hn::Ge(d3, zero), hn::Le(d4, d3)), v1, q);
  q = chosen(both(hn::Le(d1, zero), hn::Le(d2_, zero)), v0, q);
  return {c, hn::LoadU(D(), pairs.a[3] + i), q, zero, alarm};
}

struct Numbers {
  V number[10];

  HWY_INLINE Numbers() {}
  HWY_INLINE void take(std::size_t k, const Axes& a) {
    number[k] = a.x;
    number[k + 1] = a.y;
    number[k + 2] = a.z;
  }
  HWY_INLINE Numbers(const Pair& p, double contact) {
    const V s = hn::Sqrt(p.d2);
    const Axes n(hn::Div(p.delta.x, s), hn::Div(p.delta.y, s), hn::Div(p.delta.z, s));
    take(0, n);
    take(3, plus(p.a, p.ar, n));
    take(6, p.b - times(p.br, n));
    number[9] = hn::Sub(hn::Sub(s, p.radii), hn::Set(D(), contact));
  }
};

template <class A, class B>
HWY_INLINE void leave_boxes(const kernel::PairColumns<A, B>&, std::size_t, const Pair&, double, Numbers&) {}

/// Centres inside: out through the nearest face.
HWY_INLINE void leave_boxes(const kernel::SphereCubePairs& pairs, std::size_t i, const Pair& p, double contact,
                            Numbers& n) {
  const D d;
  const V zero = hn::Zero(d);
  const M inside = hn::Eq(p.d2, zero);
  if (hn::AllFalse(d, inside)) return;
  const V center[] = {p.a.x, p.a.y, p.a.z};
  V depth = hn::Set(d, std::numeric_limits<double>::infinity());
  V face[6];
  for (std::size_t k = 0; k < 3; ++k)
    for (const double side : {1.0, -1.0}) {
      const V at = hn::LoadU(d, pairs.b[side > 0 ? k : 3 + k] + i);
      const V sign = hn::Set(d, side);
      const V other = hn::Mul(sign, hn::Sub(center[k], at));
      const M nearer = hn::Lt(other, depth);
      depth = hn::IfThenElse(nearer, other, depth);
      for (std::size_t j = 0; j <= k; ++j) {
        face[j] = hn::IfThenElse(nearer, j == k ? sign : zero, j == k && side > 0 ? zero : face[j]);
        face[3 + j] = hn::IfThenElse(nearer, j == k ? at : center[j], j == k && side > 0 ? center[k] : face[3 + j]);
      }
    }
  for (std::size_t k = 0; k < 3; ++k) {
    n.number[k] = hn::IfThenElse(inside, face[k], n.number[k]);
    n.number[3 + k] = hn::IfThenElse(inside, hn::Add(center[k], hn::Mul(face[k], p.ar)), n.number[3 + k]);
    n.number[6 + k] = hn::IfThenElse(inside, face[3 + k], n.number[6 + k]);
  }
  const V value = hn::Sub(hn::Neg(hn::Add(depth, p.ar)), hn::Set(d, contact));
  n.number[9] = hn::IfThenElse(inside, value, n.number[9]);
}

/// Whether a vector of pairs are hits, and the numbers of their contacts.
template <class A, class B>
struct Answer {
  M hit;
  Numbers numbers;

  HWY_INLINE Answer(const kernel::PairColumns<A, B>& pairs, std::size_t i, Distances distances)
      : Answer(pairs, i, distances, pair_of(pairs, i, distances.alarm)) {}

 private:
  HWY_INLINE Answer(const kernel::PairColumns<A, B>& pairs, std::size_t i, Distances distances, const Pair& p)
      : hit(p.hit), numbers(p, distances.contact) {
    leave_boxes(pairs, i, p, distances.contact, numbers);
  }
};

/// A lowest point over a plane.
struct OverPlane {
  M hit;
  Numbers numbers;

  HWY_INLINE OverPlane(const Axes& p, V radius, const double* const* plane, std::size_t i, Distances distances) {
    const D d;
    const Axes n(plane, i);
    const V length = hn::Sqrt(dot(n, n));
    const V s = hn::Div(hn::Sub(dot(n, p), hn::LoadU(d, plane[3] + i)), length);
    hit = hn::Le(s, hn::Add(radius, hn::Set(d, distances.alarm)));
    const Axes m(hn::Div(n.x, length), hn::Div(n.y, length), hn::Div(n.z, length));
    numbers.take(0, times(hn::Set(d, -1), m));
    numbers.take(3, plus(p, hn::Neg(radius), m));
    numbers.take(6, plus(p, hn::Neg(s), m));
    numbers.number[9] = hn::Sub(hn::Sub(s, radius), hn::Set(d, distances.contact));
  }
};
template <>
struct Answer<Ball, Plane> : OverPlane {
  HWY_INLINE Answer(const kernel::PairColumns<Ball, Plane>& pairs, std::size_t i, Distances distances)
      : OverPlane(Axes(&pairs.a[0], i), hn::LoadU(D(), pairs.a[3] + i), pairs.b.data(), i, distances) {}
};
template <>
struct Answer<Capsule, Plane> : OverPlane {
  HWY_INLINE Answer(const kernel::PairColumns<Capsule, Plane>& pairs, std::size_t i, Distances distances)
      : Answer(Axes(&pairs.a[0], i), Axes(&pairs.a[3], i), Axes(&pairs.b[0], i), pairs, i, distances) {}

 private:
  HWY_INLINE Answer(const Axes& start, const Axes& end, const Axes& n, const kernel::PairColumns<Capsule, Plane>& pairs,
                    std::size_t i, Distances distances)
      : OverPlane(chosen(hn::Le(dot(n, start), dot(n, end)), start, end), hn::LoadU(D(), pairs.a[6] + i),
                  pairs.b.data(), i, distances) {}
};

/// A segment through a triangle, by Moeller and Trumbore.
struct Crossing {
  M hit;
  Numbers numbers;

  HWY_INLINE Crossing(const Axes& start, const Axes& along, const double* const* triangle, double side, std::size_t i) {
    const D d;
    const V zero = hn::Zero(d);
    const V one = hn::Set(d, 1);
    const Axes v0(triangle, i);
    const Axes u = Axes(triangle + 3, i) - v0;
    const Axes v = Axes(triangle + 6, i) - v0;
    const Axes from = start - v0;
    const Axes p = cross(along, v);
    const Axes q = cross(from, u);
    const V per = hn::Div(one, dot(u, p));
    const V a = hn::Mul(dot(from, p), per);
    const V b = hn::Mul(dot(along, q), per);
    const V t = hn::Mul(dot(v, q), per);
    const M inside = hn::And(hn::And(hn::Ge(a, zero), hn::Ge(b, zero)), hn::Le(hn::Add(a, b), one));
    hit = hn::And(inside, hn::And(hn::Ge(t, zero), hn::Le(t, one)));
    const Axes n = cross(u, v);
    const V per_length = hn::Div(hn::Set(d, side), hn::Sqrt(dot(n, n)));
    numbers.take(0, times(per_length, n));
    numbers.take(3, plus(start, t, along));
    numbers.take(6, plus(start, t, along));
    numbers.number[9] = zero;
  }
};
template <>
struct Answer<Ray, Triangle> : Crossing {
  HWY_INLINE Answer(const kernel::PairColumns<Ray, Triangle>& pairs, std::size_t i, Distances /*distances*/)
      : Crossing(Axes(&pairs.a[0], i), times(hn::LoadU(D(), pairs.a[6] + i), Axes(&pairs.a[3], i)), pairs.b.data(), -1,
                 i) {}
};
template <>
struct Answer<Triangle, Line> : Crossing {
  HWY_INLINE Answer(const kernel::PairColumns<Triangle, Line>& pairs, std::size_t i, Distances /*distances*/)
      : Crossing(Axes(&pairs.b[0], i), Axes(&pairs.b[3], i) - Axes(&pairs.b[0], i), pairs.a.data(), 1, i) {}
};

template <class A, class B>
HWY_INLINE void test_pairs(const kernel::PairColumns<A, B>& pairs, double alarm, std::uint8_t* hit) {
  for (std::size_t i = 0; i < pairs.size; i += hn::Lanes(D()))
    store_flags(Answer<A, B>(pairs, i, {alarm, 0}).hit, hit + i);
}

template <class A, class B>
HWY_INLINE void compute_pairs(const kernel::PairColumns<A, B>& pairs, Distances distances,
                              const kernel::ContactRows& out) {
  for (std::size_t i = 0; i < pairs.size; i += hn::Lanes(D())) {
    const Answer<A, B> p(pairs, i, distances);
    const auto& n = p.numbers;
    for (std::size_t k = 0; k < 10; ++k) hn::StoreU(hn::IfThenElseZero(p.hit, n.number[k]), D(), out.number[k] + i);
    store_flags(p.hit, reinterpret_cast<std::uint8_t*>(out.state + i));
  }
}

template <class A, class B>
HWY_INLINE std::size_t compute_hits_of_pairs(const kernel::PairColumns<A, B>& pairs, Distances distances,
                                             std::uint32_t* index, const kernel::ContactRows& out) {
  std::size_t hits = 0;
  HWY_ALIGN std::uint64_t indices[HWY_MAX_BYTES / sizeof(double)];
  const hn::RebindToUnsigned<D> words;
  for (std::size_t i = 0; i < pairs.size; i += hn::Lanes(D())) {
    const Answer<A, B> p(pairs, i, distances);
    const auto& n = p.numbers;
    for (std::size_t k = 0; k < 10; ++k) hn::CompressBlendedStore(n.number[k], p.hit, D(), out.number[k] + hits);
    const std::size_t more = hn::CompressStore(hn::Iota(words, i), hn::RebindMask(words, p.hit), words, indices);
    for (std::size_t k = 0; k < more; ++k) {
      index[hits + k] = static_cast<std::uint32_t>(indices[k]);
      out.state[hits + k] = batch::PairState::contact;
    }
    hits += more;
  }
  return hits;
}

void test_cube_cube(const kernel::BoxPairs& pairs, double alarm_distance, std::uint8_t* hit) {
  const D d;
  const V alarm = hn::Set(d, alarm_distance);
  for (std::size_t i = 0; i < pairs.size; i += hn::Lanes(d)) {
    M hits = hn::Eq(alarm, alarm);
    for (std::size_t k = 0; k < 3; ++k) {
      const V a_min = hn::LoadU(d, pairs.a[k] + i);
      const V a_max = hn::LoadU(d, pairs.a[3 + k] + i);
      const V b_min = hn::LoadU(d, pairs.b[k] + i);
      const V b_max = hn::LoadU(d, pairs.b[3 + k] + i);
      hits = hn::And(hits, hn::Le(a_min, hn::Add(b_max, alarm)));
      hits = hn::And(hits, hn::Le(b_min, hn::Add(a_max, alarm)));
    }
    store_flags(hits, hit + i);
  }
}

#define CONTACT_PLAIN(name, A, B)                                                                                    \
  void test_##name(const kernel::PairColumns<A, B>& pairs, double alarm, std::uint8_t* hit) {                        \
    test_pairs(pairs, alarm, hit);                                                                                   \
  }                                                                                                                  \
  void compute_##name(const kernel::PairColumns<A, B>& pairs, Distances distances, const kernel::ContactRows& out) { \
    compute_pairs(pairs, distances, out);                                                                            \
  }                                                                                                                  \
  std::size_t hits_##name(const kernel::PairColumns<A, B>& pairs, Distances distances, std::uint32_t* index,         \
                          const kernel::ContactRows& out) {                                                          \
    return compute_hits_of_pairs(pairs, distances, index, out);                                                      \
  }
CONTACT_BATCH_CONTACTS(CONTACT_PLAIN)
#undef CONTACT_PLAIN

}  // namespace HWY_NAMESPACE
}  // namespace contact::bench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace contact::bench {

#define CONTACT_EXPORT(name, A, B)                                                           \
  HWY_EXPORT(test_##name);                                                                   \
  void plain_test(const kernel::PairColumns<A, B>& pairs, double alarm, std::uint8_t* hit) { \
    HWY_DYNAMIC_DISPATCH(test_##name)(pairs, alarm, hit);                                    \
  }
CONTACT_BATCH_PAIRS(CONTACT_EXPORT)
#undef CONTACT_EXPORT
#define CONTACT_EXPORT(name, A, B)                                                                                  \
  HWY_EXPORT(compute_##name);                                                                                       \
  HWY_EXPORT(hits_##name);                                                                                          \
  void plain_compute(const kernel::PairColumns<A, B>& pairs, Distances distances, const kernel::ContactRows& out) { \
    HWY_DYNAMIC_DISPATCH(compute_##name)(pairs, distances, out);                                                    \
  }                                                                                                                 \
  std::size_t plain_compute_hits(const kernel::PairColumns<A, B>& pairs, Distances distances, std::uint32_t* index, \
                                 const kernel::ContactRows& out) {                                                  \
    return HWY_DYNAMIC_DISPATCH(hits_##name)(pairs, distances, index, out);                                         \
  }
CONTACT_BATCH_CONTACTS(CONTACT_EXPORT)
#undef CONTACT_EXPORT

}  // namespace contact::bench
#endif  // HWY_ONCE
