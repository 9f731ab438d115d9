// Plain double arithmetic over structures of arrays: the formulas as upstream has them, and their bits. Numbers of
// pairs are multiples of every vector length.
#include "plain_batch.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plain_batch.cpp"
#include "kernel/batch_targets.hpp"
// foreach_target.h includes this file once a target, so it comes before the rest.
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

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

struct Pair {
  V ax, ay, az, ar, bx, by, bz, br, dx, dy, dz, d2, radii;
  M hit;

  HWY_INLINE Pair(const kernel::SpherePairs& pairs, std::size_t i, double alarm) {
    load_first(pairs.a, i);
    const D d;
    bx = hn::LoadU(d, pairs.b[0] + i);
    by = hn::LoadU(d, pairs.b[1] + i);
    bz = hn::LoadU(d, pairs.b[2] + i);
    br = hn::LoadU(d, pairs.b[3] + i);
    decide(alarm);
  }
  HWY_INLINE Pair(const kernel::SphereCubePairs& pairs, std::size_t i, double alarm) {
    load_first(pairs.a, i);
    const D d;
    const auto clamped = [&](V center, std::size_t axis) HWY_ATTR {
      return hn::Min(hn::Max(center, hn::LoadU(d, pairs.b[axis] + i)), hn::LoadU(d, pairs.b[3 + axis] + i));
    };
    bx = clamped(ax, 0);
    by = clamped(ay, 1);
    bz = clamped(az, 2);
    br = hn::Zero(d);
    decide(alarm);
  }

  HWY_INLINE Pair(const kernel::SphereCapsulePairs& pairs, std::size_t i, double alarm) {
    load_first(pairs.a, i);
    const Axis v(pairs.b, i);
    const V t = part(hn::Neg(v.dot(v.from(ax, ay, az))), v.dot(v));
    take_second(v, t);
    decide(alarm);
  }
  HWY_INLINE Pair(const kernel::CapsulePairs& pairs, std::size_t i, double alarm) {
    const Axis u(pairs.a, i);
    const Axis v(pairs.b, i);
    const Axis w = v.from(u.startx, u.starty, u.startz);
    const V A = u.dot(u);
    const V B = u.dot(v);
    const V C = u.dot(w);
    const V E = v.dot(v);
    const V F = v.dot(w);
    V s = part(hn::Sub(hn::Mul(C, E), hn::Mul(B, F)), hn::Sub(hn::Mul(A, E), hn::Mul(B, B)));
    const V t = part(hn::Sub(hn::Mul(B, s), F), E);
    s = part(hn::Add(hn::Mul(B, t), C), A);
    ax = hn::Add(u.startx, hn::Mul(s, u.x));
    ay = hn::Add(u.starty, hn::Mul(s, u.y));
    az = hn::Add(u.startz, hn::Mul(s, u.z));
    ar = u.radius;
    take_second(v, t);
    decide(alarm);
  }

 private:
  /// A capsule's axis, as a vector.
  struct Axis {
    V startx, starty, startz, x, y, z, radius;

    HWY_INLINE Axis(const std::array<const double*, 7>& capsules, std::size_t i) {
      const auto at = [&](std::size_t k) HWY_ATTR { return hn::LoadU(D(), capsules[k] + i); };
      startx = at(0);
      starty = at(1);
      startz = at(2);
      x = hn::Sub(at(3), startx);
      y = hn::Sub(at(4), starty);
      z = hn::Sub(at(5), startz);
      radius = at(6);
    }
    /// From a point to the start.
    [[nodiscard]] HWY_INLINE Axis from(V px, V py, V pz) const {
      Axis w = *this;
      w.x = hn::Sub(startx, px);
      w.y = hn::Sub(starty, py);
      w.z = hn::Sub(startz, pz);
      return w;
    }
    [[nodiscard]] HWY_INLINE V dot(const Axis& o) const {
      return hn::Add(hn::Add(hn::Mul(x, o.x), hn::Mul(y, o.y)), hn::Mul(z, o.z));
    }
  };
  HWY_INLINE static V part(V numerator, V whole) {
    return hn::Min(hn::Max(hn::Div(numerator, whole), hn::Zero(D())), hn::Set(D(), 1));
  }
  HWY_INLINE void take_second(const Axis& v, V t) {
    bx = hn::Add(v.startx, hn::Mul(t, v.x));
    by = hn::Add(v.starty, hn::Mul(t, v.y));
    bz = hn::Add(v.startz, hn::Mul(t, v.z));
    br = v.radius;
  }
  HWY_INLINE void load_first(const std::array<const double*, 4>& a, std::size_t i) {
    const D d;
    ax = hn::LoadU(d, a[0] + i);
    ay = hn::LoadU(d, a[1] + i);
    az = hn::LoadU(d, a[2] + i);
    ar = hn::LoadU(d, a[3] + i);
  }
  HWY_INLINE void decide(double alarm) {
    dx = hn::Sub(bx, ax);
    dy = hn::Sub(by, ay);
    dz = hn::Sub(bz, az);
    d2 = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
    radii = hn::Add(ar, br);
    const V reach = hn::Add(radii, hn::Set(D(), alarm));
    hit = hn::Le(d2, hn::Mul(reach, reach));
  }
};

template <class Pairs>
HWY_INLINE void test_pairs(const Pairs& pairs, double alarm, std::uint8_t* hit) {
  for (std::size_t i = 0; i < pairs.size; i += hn::Lanes(D())) store_flags(Pair(pairs, i, alarm).hit, hit + i);
}

struct Numbers {
  V number[10];

  HWY_INLINE Numbers(const Pair& p, double contact) {
    const V s = hn::Sqrt(p.d2);
    number[0] = hn::Div(p.dx, s);
    number[1] = hn::Div(p.dy, s);
    number[2] = hn::Div(p.dz, s);
    number[3] = hn::Add(p.ax, hn::Mul(p.ar, number[0]));
    number[4] = hn::Add(p.ay, hn::Mul(p.ar, number[1]));
    number[5] = hn::Add(p.az, hn::Mul(p.ar, number[2]));
    number[6] = hn::Sub(p.bx, hn::Mul(p.br, number[0]));
    number[7] = hn::Sub(p.by, hn::Mul(p.br, number[1]));
    number[8] = hn::Sub(p.bz, hn::Mul(p.br, number[2]));
    number[9] = hn::Sub(hn::Sub(s, p.radii), hn::Set(D(), contact));
  }
};

template <class Pairs>
HWY_INLINE void leave_boxes(const Pairs&, std::size_t, const Pair&, double, Numbers&) {}

/// Centres inside: out through the nearest face.
HWY_INLINE void leave_boxes(const kernel::SphereCubePairs& pairs, std::size_t i, const Pair& p, double contact,
                            Numbers& n) {
  const D d;
  const V zero = hn::Zero(d);
  const M inside = hn::Eq(p.d2, zero);
  if (hn::AllFalse(d, inside)) return;
  const V center[] = {p.ax, p.ay, p.az};
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

template <class Pairs>
HWY_INLINE void compute_pairs(const Pairs& pairs, Distances distances, const kernel::ContactRows& out) {
  for (std::size_t i = 0; i < pairs.size; i += hn::Lanes(D())) {
    const Pair p(pairs, i, distances.alarm);
    Numbers n(p, distances.contact);
    leave_boxes(pairs, i, p, distances.contact, n);
    for (std::size_t k = 0; k < 10; ++k) hn::StoreU(hn::IfThenElseZero(p.hit, n.number[k]), D(), out.number[k] + i);
    store_flags(p.hit, reinterpret_cast<std::uint8_t*>(out.state + i));
  }
}

template <class Pairs>
HWY_INLINE std::size_t compute_hits_of_pairs(const Pairs& pairs, Distances distances, std::uint32_t* index,
                                             const kernel::ContactRows& out) {
  std::size_t hits = 0;
  HWY_ALIGN std::uint64_t indices[HWY_MAX_BYTES / sizeof(double)];
  const hn::RebindToUnsigned<D> words;
  for (std::size_t i = 0; i < pairs.size; i += hn::Lanes(D())) {
    const Pair p(pairs, i, distances.alarm);
    Numbers n(p, distances.contact);
    leave_boxes(pairs, i, p, distances.contact, n);
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
namespace {

double part(double numerator, double whole) { return std::clamp(numerator / whole, 0.0, 1.0); }

const Balls& as_balls(const Balls& balls) { return balls; }
Balls as_balls(const BallAndBox& pair) {
  return {pair.a, {pair.a.center.cwiseMax(pair.b.min).cwiseMin(pair.b.max), 0}};
}
Balls as_balls(const BallAndCapsule& pair) {
  const Capsule& b = pair.b;
  const Vector3 v = b.end - b.start;
  return {pair.a, {b.start + part((pair.a.center - b.start).dot(v), v.dot(v)) * v, b.radius}};
}
Balls as_balls(const Capsules& pair) {
  const Vector3 u = pair.a.end - pair.a.start;
  const Vector3 v = pair.b.end - pair.b.start;
  const Vector3 w = pair.b.start - pair.a.start;
  const double A = u.dot(u);
  const double B = u.dot(v);
  const double C = u.dot(w);
  const double E = v.dot(v);
  const double F = v.dot(w);
  const double t = part(B * part(C * E - B * F, A * E - B * B) - F, E);
  return {{pair.a.start + part(B * t + C, A) * u, pair.a.radius}, {pair.b.start + t * v, pair.b.radius}};
}

template <class A, class B>
bool contact_inside(const A&, const B&, double, Contact&) {
  return false;
}
bool contact_inside(const Ball& a, const Box& box, double contact_distance, Contact& out) {
  plain_contact_inside(a, box, contact_distance, out);
  return true;
}

template <class A, class B>
void compute_one_by_one(const Two<A, B>* pairs, std::size_t size, Distances distances, PlainContact* out) {
  for (std::size_t i = 0; i < size; ++i) {
    const auto& [a, b] = as_balls(pairs[i]);
    const double dx = b.center[0] - a.center[0];
    const double dy = b.center[1] - a.center[1];
    const double dz = b.center[2] - a.center[2];
    const double d2 = dx * dx + dy * dy + dz * dz;
    const double radii = a.radius + b.radius;
    const double reach = radii + distances.alarm;
    out[i].hit = d2 <= reach * reach;
    if (!out[i].hit) continue;
    if (d2 == 0 && contact_inside(pairs[i].a, pairs[i].b, distances.contact, out[i].contact)) continue;
    const double s = std::sqrt(d2);
    const Vector3 n(dx / s, dy / s, dz / s);
    out[i].contact = {n, a.center + a.radius * n, b.center - b.radius * n, s - radii - distances.contact, false};
  }
}

}  // namespace

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
  }                                                                                                                 \
  void plain_compute_scalar(const Two<A, B>* pairs, std::size_t size, Distances distances, PlainContact* out) {     \
    compute_one_by_one(pairs, size, distances, out);                                                                \
  }                                                                                                                 \
  std::optional<Contact> plain_contact_of_pair(const Two<A, B>& pair, Distances distances) {                        \
    PlainContact contact{};                                                                                         \
    compute_one_by_one(&pair, 1, distances, &contact);                                                              \
    return contact.hit ? std::optional(contact.contact) : std::nullopt;                                             \
  }
CONTACT_BATCH_CONTACTS(CONTACT_EXPORT)
#undef CONTACT_EXPORT

}  // namespace contact::bench
#endif  // HWY_ONCE
