// Plain double arithmetic over structures of arrays: the formulas as upstream has them, and their bits. Numbers of
// pairs are multiples of every vector length.
#include "plain_batch.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plain_batch.cpp"
#include "kernel/batch_targets.hpp"
// foreach_target.h includes this file once a target, so it comes before the rest.
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <cmath>
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
    const D d;
    ax = hn::LoadU(d, pairs.a[0] + i);
    ay = hn::LoadU(d, pairs.a[1] + i);
    az = hn::LoadU(d, pairs.a[2] + i);
    ar = hn::LoadU(d, pairs.a[3] + i);
    bx = hn::LoadU(d, pairs.b[0] + i);
    by = hn::LoadU(d, pairs.b[1] + i);
    bz = hn::LoadU(d, pairs.b[2] + i);
    br = hn::LoadU(d, pairs.b[3] + i);
    dx = hn::Sub(bx, ax);
    dy = hn::Sub(by, ay);
    dz = hn::Sub(bz, az);
    d2 = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
    radii = hn::Add(ar, br);
    const V reach = hn::Add(radii, hn::Set(d, alarm));
    hit = hn::Le(d2, hn::Mul(reach, reach));
  }
};

void test_spheres(const kernel::SpherePairs& pairs, double alarm, std::uint8_t* hit) {
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

void compute_spheres(const kernel::SpherePairs& pairs, Distances distances, const kernel::ContactRows& out) {
  for (std::size_t i = 0; i < pairs.size; i += hn::Lanes(D())) {
    const Pair p(pairs, i, distances.alarm);
    const Numbers n(p, distances.contact);
    for (std::size_t k = 0; k < 10; ++k) hn::StoreU(hn::IfThenElseZero(p.hit, n.number[k]), D(), out.number[k] + i);
    store_flags(p.hit, reinterpret_cast<std::uint8_t*>(out.state + i));
  }
}

std::size_t compute_hits(const kernel::SpherePairs& pairs, Distances distances, std::uint32_t* index,
                         const kernel::ContactRows& out) {
  std::size_t hits = 0;
  HWY_ALIGN std::uint64_t indices[HWY_MAX_BYTES / sizeof(double)];
  const hn::RebindToUnsigned<D> words;
  for (std::size_t i = 0; i < pairs.size; i += hn::Lanes(D())) {
    const Pair p(pairs, i, distances.alarm);
    const Numbers n(p, distances.contact);
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

void test_cubes(const kernel::BoxPairs& pairs, double alarm_distance, std::uint8_t* hit) {
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

}  // namespace HWY_NAMESPACE
}  // namespace contact::bench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace contact::bench {

HWY_EXPORT(test_spheres);
HWY_EXPORT(compute_spheres);
HWY_EXPORT(compute_hits);
HWY_EXPORT(test_cubes);

void plain_test_sphere_sphere(const kernel::SpherePairs& pairs, double alarm, std::uint8_t* hit) {
  HWY_DYNAMIC_DISPATCH(test_spheres)(pairs, alarm, hit);
}

void plain_compute_sphere_sphere(const kernel::SpherePairs& pairs, Distances distances,
                                 const kernel::ContactRows& out) {
  HWY_DYNAMIC_DISPATCH(compute_spheres)(pairs, distances, out);
}

std::size_t plain_compute_sphere_sphere_hits(const kernel::SpherePairs& pairs, Distances distances,
                                             std::uint32_t* index, const kernel::ContactRows& out) {
  return HWY_DYNAMIC_DISPATCH(compute_hits)(pairs, distances, index, out);
}

void plain_test_cube_cube(const kernel::BoxPairs& pairs, double alarm, std::uint8_t* hit) {
  HWY_DYNAMIC_DISPATCH(test_cubes)(pairs, alarm, hit);
}

void plain_compute_scalar(const PlainPair* pairs, std::size_t size, Distances distances, PlainContact* out) {
  for (std::size_t i = 0; i < size; ++i) {
    const Ball& a = pairs[i].a;
    const Ball& b = pairs[i].b;
    const double dx = b.center[0] - a.center[0];
    const double dy = b.center[1] - a.center[1];
    const double dz = b.center[2] - a.center[2];
    const double d2 = dx * dx + dy * dy + dz * dz;
    const double radii = a.radius + b.radius;
    const double reach = radii + distances.alarm;
    out[i].hit = d2 <= reach * reach;
    if (!out[i].hit) continue;
    const double s = std::sqrt(d2);
    const Vector3 n(dx / s, dy / s, dz / s);
    out[i].contact = {n, a.center + a.radius * n, b.center - b.radius * n, s - radii - distances.contact, false};
  }
}

std::optional<Contact> plain_contact_of_pair(const Ball& a, const Ball& b, Distances distances) {
  PlainContact contact{};
  const PlainPair pair{a, b};
  plain_compute_scalar(&pair, 1, distances, &contact);
  return contact.hit ? std::optional(contact.contact) : std::nullopt;
}

}  // namespace contact::bench
#endif  // HWY_ONCE
