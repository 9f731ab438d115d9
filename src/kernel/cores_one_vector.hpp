// The contact of one pair of cores with x, y and z in one vector: what sphere_sphere_one_vector.hpp does for two balls. It settles all
// ten numbers of a hit or none; cores_stages.hpp asks its other stages for what is left.
// Errors: docs/error-bounds.md, "Cores in one vector".
#pragma once

#include <algorithm>
#include <cmath>

#include "kernel/crossing_cores.hpp"
#include "kernel/plane_cores.hpp"
#include "kernel/segment_cores.hpp"
#include "kernel/sphere_sphere_one_vector.hpp"
#include "kernel/triangle_cores.hpp"

#if CONTACT_HAS_ONE_VECTOR

namespace contact::kernel::one_vector {

#define CONTACT_LANES [[gnu::always_inline, gnu::target("avx2,fma")]] inline

using plain_decision::Spread;
using plain_decision::Weights;

/// The least that delta is of its error. A foot's is 320 u^2 |w|, so that what corrects it, 13 u |w|, is short beside delta too.
inline constexpr double kClear = 0x1p80;
/// The square of delta over that of a correction: one that is shorter changes |d|^2 by less than u / 64 of it.
inline constexpr double kLeastSteps = 0x1p60;
/// The least third weight in a triangle: what rounding the others costs it is less.
inline constexpr double kLeastRest = 0x1p-40;
/// The least n.d of a crossing: no product that underflows matters beside it, numbers being below 2^250.
inline constexpr double kLeastThrough = 0x1p-300;

/// One number after the other: cores are built just before, and a processor does not forward what was stored in pieces.
CONTACT_LANES Axes load(const Vector3& v) { return {_mm256_setr_pd(v[0], v[1], v[2], 0)}; }
CONTACT_LANES Number sum_of(Axes a) { return (x_of(a) + y_of(a)) + z_of(a); }
CONTACT_LANES Number plain_dot(Axes a, Axes b) { return sum_of(hn::Mul(a, b)); }
CONTACT_LANES Number magnitude(Axes a) { return sum_of(hn::Abs(a)); }
CONTACT_LANES Axes zero_where(Mask mask, Axes x) { return {_mm256_andnot_pd(mask.lanes, x.lanes)}; }
CONTACT_LANES Delta exact(Axes x) { return Delta(x, all<Axes>(0)); }
CONTACT_LANES Delta negative(const Delta& x) {
  return Delta(hn::Sub(all<Axes>(0), x.high), hn::Sub(all<Axes>(0), x.low));
}

// What feet are made of, as in batch_cores-inl.h.

/// From the start of a segment to its end, exactly.
CONTACT_LANES Delta exactly_along(const Segment& segment) {
  return two_difference(load(segment.end), load(segment.start));
}
CONTACT_LANES Delta exactly_along(const DirectedSegment& segment) {
  const Axes direction = load(segment.direction);
  const Axes product = hn::Mul(direction, all<Axes>(segment.length));
  return Delta(product, hn::MulSub(direction, all<Axes>(segment.length), product));
}
/// w + t v.
CONTACT_LANES Delta moved(const Delta& w, Number t, const Delta& v) {
  const Axes way = product(v, t);
  const Axes way_low = product_rest(v, t, way);
  const Delta high = two_sum(w.high, way);
  return Delta(high.high, hn::Add(high.low, hn::Add(w.low, way_low)));
}
/// d + step v, where the step is so short that its product with v's low part is nothing.
CONTACT_LANES Delta stepped(const Delta& d, Number step, const Delta& v) {
  const Axes more = times_plus(v.high, step, d.low);
  const Axes high = hn::Add(d.high, more);
  return Delta(high, hn::Sub(more, hn::Sub(high, d.high)));
}
/// x.y, rounded.
CONTACT_LANES Number dot(const Delta& x, const Delta& y) {
  const Axes p = hn::Mul(x.high, y.high);
  const Number rests = sum_of(hn::MulAdd(x.high, y.low, hn::MulAdd(x.low, y.high, hn::MulSub(x.high, y.high, p))));
  const Double2 xy = two_sum(x_of(p), y_of(p));
  return (xy.high + z_of(p)) + (xy.low + rests);
}

/// Two cores: d from the first to the second, |d|^2 in plain arithmetic, and the first, p. `same`: lanes whose coordinate all points
/// share.
struct Cores {
  Delta d;
  Number d2;
  Number d_error;
  Delta p;
  Number p_error;
  Mask same;

  CONTACT_LANES Cores() {}
};

/// A point and a segment: batch_sphere_capsule.cpp. The decision is that of plain_cores.hpp.
template <class AnySegment>
CONTACT_LANES Filtered find_cores(const Vector3& point, const AnySegment& segment, Mask along_same, Number reach,
                                  Cores& cores) {
  const Axes c = load(point);
  const Axes start = load(segment.start);
  const Delta v = exactly_along(segment);
  const Delta w = two_difference(start, c);
  const Number ww = plain_dot(w.high, w.high);
  const Number vv = plain_dot(v.high, v.high);
  const Number wv = plain_dot(w.high, v.high);
  const Number reciprocal = vv >= bounds::kLeast ? 1 / vv : 0;
  const Number t = plain_decision::clamped(-wv * reciprocal);
  const Number D = ww + t * (2 * wv + t * vv);
  const Filtered filtered = plain_decision::filter_squares(D, D, ww + vv, reach);
  if (filtered != Filtered::hit) return filtered;
  if (!(ww >= bounds::kLeastSquare)) return Filtered::undecided;
  const Delta d = moved(w, t, v);
  const Number correction = -dot(d, v) * reciprocal;
  const Number step = std::max(std::min(correction, 1 - t), -t);
  cores.d = stepped(d, step, v);
  cores.d2 = plain_dot(d.high, d.high);
  cores.d_error = bounds::kFootError * magnitude(w.high);
  cores.p = exact(c);
  cores.p_error = bounds::kLeast;
  cores.same = hn::And(hn::Eq(c, start), along_same);
  return Filtered::hit;
}

/// The ways w + s u + t v.
struct Ways {
  Delta w;
  Delta u;
  Delta v;
  Spread x;

  CONTACT_LANES Ways(const Delta& of_w, const Delta& of_u, const Delta& of_v)
      : w(of_w), u(of_u), v(of_v), x{plain_dot(w.high, w.high), plain_dot(u.high, u.high), plain_dot(v.high, v.high),
                                     plain_dot(u.high, v.high), plain_dot(u.high, w.high), plain_dot(v.high, w.high)} {}
};

/// The shortest of them, near which the weights are: batch_capsule_capsule.cpp. A weight that is 0, or 1 where each may be, stays
/// there. False where it is not certain that no other weights are better. `s_step` is what s lacks.
template <bool together>
CONTACT_LANES bool find_cores(const Ways& way, const Weights& weights, Cores& cores, Number& s_step) {
  const Number s = weights.s;
  const Number t = weights.t;
  const Spread& x = way.x;
  const Delta d = moved(moved(way.w, t, way.v), s, way.u);
  const Number d_u = dot(d, way.u);
  const Number d_v = dot(d, way.v);
  const bool s_ends = s == 0 || (!together && s == 1);
  const bool t_ends = t == 0 || (!together && t == 1);
  const Number A = s_ends ? 1 : x.uu;
  const Number E = t_ends ? 1 : x.vv;
  const Number B = s_ends || t_ends ? 0 : x.uv;
  const Number by_s = s_ends ? 0 : d_u;
  const Number by_t = t_ends ? 0 : d_v;
  const Number AE = A * E;
  const Number determinant = hn::NegMulAdd(B, B, AE);
  const Number reciprocal = 1 / determinant;
  s_step = hn::MulSub(B, by_t, E * by_s) * reciprocal;
  const Number t_step = hn::MulSub(B, by_s, A * by_t) * reciprocal;
  const Number length1 = magnitude(way.u.high);
  const Number length2 = magnitude(way.v.high);
  const Number steps = std::abs(s_step) * length1 + std::abs(t_step) * length2;
  const Number lengths = (length1 + length2) + magnitude(way.w.high);
  const Number error = AE * reciprocal * (lengths * bounds::kFootError + steps * bounds::kStepError);
  cores.d = stepped(stepped(d, t_step, way.v), s_step, way.u);
  cores.d2 = plain_dot(d.high, d.high);
  cores.d_error = error;
  // At an end: beyond it the distance would still fall. Elsewhere: no end is within the error.
  const Number s_rises = hn::MulAdd(x.uv, t_step, d_u);
  const Number t_rises = hn::MulAdd(x.uv, s_step, d_v);
  const auto belongs = [&](bool ends, Number at, Number step, Number rises, Number length)
      __attribute__((always_inline, target("avx2,fma"))) {
    if (ends) return (at == 0 ? rises : -rises) >= 2 * error * length;
    return (together ? at + step : std::min(at + step, (1 - at) - step)) * length >= 4 * error;
  };
  const Number rest = (1 - (s + s_step)) - (t + t_step);
  return belongs(s_ends, s, s_step, s_rises, length1) && belongs(t_ends, t, t_step, t_rises, length2) &&
         (!together || (rest >= kLeastRest && rest * std::min(length1, length2) >= 8 * error)) &&
         determinant * bounds::kMostParallel >= AE && std::min(A, E) >= bounds::kLeastSize &&
         x.ww + (x.uu + x.vv) >= bounds::kLeastSize && steps * steps * kLeastSteps <= cores.d2;
}

/// Numbers before they are rounded: each high + low within `error`, beside what kCoreEta has room for.
template <class T>
struct Near {
  DoubleDouble<T> x;
  T error;

  CONTACT_LANES Near(const DoubleDouble<T>& number, T within) : x(number), error(within) {}
};

/// The ends of such an interval, rounded: a number is certain where they are equal.
CONTACT_LANES Mask ends_of(const Near<Axes>& number, Axes& end) {
  const Axes radius = hn::MulAdd(hn::Abs(number.x.low), all<Axes>(bounds::kCoreEta), number.error);
  end = hn::Add(number.x.high, hn::Add(number.x.low, radius));
  return hn::Eq(end, hn::Add(number.x.high, hn::Sub(number.x.low, radius)));
}
CONTACT_LANES bool write(const Near<Axes>& normal, const Near<Axes>& point1, const Near<Axes>& point2,
                         const Near<Number>& value, Contact& contact) {
  Axes end;
  Mask certain = ends_of(normal, end);
  store(hn::Add(end, all<Axes>(0)), contact, 0);  // every zero is +0
  certain = hn::And(certain, ends_of(point1, end));
  store(hn::Add(end, all<Axes>(0)), contact, 3);
  // The value is rounded in the second point's last lane.
  const Mask last_certain = ends_of(
      Near<Axes>(DoubleDouble<Axes>(with_last(point2.x.high, value.x.high), with_last(point2.x.low, value.x.low)),
                 with_last(point2.error, value.error)),
      end);
  store(hn::Add(end, all<Axes>(0)), contact, 6);
  contact.degenerate = false;
  contact.unique = true;
  return ((bits_of(certain) | 0b1000) & bits_of(last_certain)) == 0b1111;
}

/// core + length n.
CONTACT_LANES Delta beside(const Delta& core, const Double2& length, const Direction& n) {
  const Delta at = point(core.high, all<Axes>(length.high), n.q, n.low);
  return Delta(at.high, hn::Add(hn::MulAdd(all<Axes>(length.low), n.q, at.low), core.low));
}

/// The contact of cores with a distance: the second core is the first and s n, and its surface nearer by the radius. `turned`: what
/// comes first in the question is second here.
template <bool turned>
CONTACT_LANES Filtered contact_of_cores(const Cores& cores, const Lengths& lengths, ContactPoints points,
                                        Contact& contact) {
  const Number radius1 = turned ? lengths.radius2 : lengths.radius1;
  const Number radius2 = turned ? lengths.radius1 : lengths.radius2;
  const PointOn on1 = turned ? points.second : points.first;
  const PointOn on2 = turned ? points.first : points.second;
  const Direction n(cores.d, cores.d2);
  const Number length = n.root.high;
  if (!(length >= cores.d_error * kClear)) return Filtered::undecided;
  const Number turn = cores.d_error * bounds::kTurn * n.reciprocal;
  const Number of_length = turn + bounds::kCoreError;
  const Double2 surface = two_sum(length, -radius2);
  const Double2 to_surface(surface.high, surface.low + n.root.low);
  const Double2 rest = two_sum(radius1, lengths.contact);
  const Double2 sum = two_difference(to_surface.high, rest.high);
  const Near<Number> value(Double2(sum.high, sum.low + (to_surface.low - rest.low)),
                           ((length + radius2) + rest.high) * bounds::kCoreError + cores.d_error);
  Double2 to_second = to_surface;
  if (on2 != PointOn::nearest_surface) {
    to_second = two_sum(length, sign_of(on2, -1) * radius2);
    to_second.low += n.root.low;
  }
  const Mask flat = hn::And(hn::Eq(cores.d.high, all<Axes>(0)), cores.same);
  const Near<Axes> point1(beside(cores.p, Double2(sign_of(on1, 1) * radius1, 0), n),
                          zero_where(flat, all<Axes>(radius1 * of_length + cores.p_error)));
  const Near<Axes> point2(beside(cores.p, to_second, n), zero_where(flat, all<Axes>((radius2 + length) * of_length +
                                                                                    (cores.p_error + cores.d_error))));
  const Delta direction(n.q, n.low);
  const Near<Axes> normal(turned ? negative(direction) : direction, zero_where(flat, all<Axes>(turn)));
  const bool settled =
      turned ? write(normal, point2, point1, value, contact) : write(normal, point1, point2, value, contact);
  return settled ? Filtered::hit : Filtered::undecided;
}

// A miss, a hit whose contact is settled, or neither.

CONTACT_LANES Filtered contact_of(const Vector3& c, const Segment& segment, const Lengths& lengths,
                                  ContactPoints points, Contact& contact) {
  Cores cores;
  const Mask same = hn::Eq(load(segment.start), load(segment.end));
  const Filtered filtered = find_cores(c, segment, same, reach_of(lengths), cores);
  return filtered == Filtered::hit ? contact_of_cores<false>(cores, lengths, points, contact) : filtered;
}
CONTACT_LANES Filtered contact_of(const DirectedSegment& segment, const Vector3& c, const Lengths& lengths,
                                  ContactPoints points, Contact& contact) {
  Cores cores;
  const Mask same = hn::Eq(load(segment.direction), all<Axes>(0));
  const Filtered filtered = find_cores(c, segment, same, reach_of(lengths), cores);
  return filtered == Filtered::hit ? contact_of_cores<true>(cores, lengths, points, contact) : filtered;
}
CONTACT_LANES Filtered contact_of(const Segment& first, const Segment& second, const Lengths& lengths,
                                  ContactPoints points, Contact& contact) {
  const Axes start1 = load(first.start);
  const Axes end1 = load(first.end);
  const Axes start2 = load(second.start);
  const Axes end2 = load(second.end);
  const Ways way(two_difference(start2, start1), two_difference(start1, end1), two_difference(end2, start2));
  const Weights weights = plain_decision::weights_of_segments(way.x);
  const Filtered filtered = plain_decision::filter_weights(way.x, weights, false, reach_of(lengths));
  if (filtered != Filtered::hit) return filtered;
  Cores cores;
  Number step;
  if (!find_cores<false>(way, weights, cores, step)) return Filtered::undecided;
  cores.p = stepped(moved(exact(start1), -weights.s, way.u), -step, way.u);
  cores.p_error = cores.d_error;
  cores.same = hn::And(hn::And(hn::Eq(start1, end1), hn::Eq(start1, start2)), hn::Eq(start1, end2));
  return contact_of_cores<false>(cores, lengths, points, contact);
}
CONTACT_LANES Filtered contact_of(const Vector3& point, const Corners& triangle, const Lengths& lengths,
                                  ContactPoints points, Contact& contact) {
  const Axes c = load(point);
  const Axes v0 = load(triangle.vertices[0]);
  const Axes v1 = load(triangle.vertices[1]);
  const Axes v2 = load(triangle.vertices[2]);
  Ways way(two_difference(v0, c), two_difference(v1, v0), two_difference(v2, v0));
  Weights weights = plain_decision::weights_of_triangle(way.x);
  const Filtered filtered = plain_decision::filter_weights(way.x, weights, true, reach_of(lengths));
  if (filtered != Filtered::hit) return filtered;
  // On the edge across, or at its ends, the ways start there.
  if (weights.t == 1 || (weights.t > 0 && weights.s == 1 - weights.t)) {
    way = Ways(two_difference(v2, c), two_difference(v1, v2), two_difference(v0, v2));
    weights.t = 0;
  } else if (weights.s == 1) {
    way = Ways(two_difference(v1, c), two_difference(v0, v1), two_difference(v2, v1));
    weights.s = 0;
  }
  Cores cores;
  Number step;
  if (!find_cores<true>(way, weights, cores, step)) return Filtered::undecided;
  cores.p = exact(c);
  cores.p_error = bounds::kLeast;
  cores.same = hn::And(hn::And(hn::Eq(c, v0), hn::Eq(c, v1)), hn::Eq(c, v2));
  return contact_of_cores<false>(cores, lengths, points, contact);
}

// Planes.

/// Of a point over a plane, times the length of its normal, within `error`: height_of() of plane_cores.hpp.
struct HeightOver {
  Double2 x;
  Number error;

  CONTACT_LANES HeightOver(Axes c, Axes n, Number offset) {
    const Axes p = hn::Mul(n, c);
    const Number rests = sum_of(hn::MulSub(n, c, p));
    const Double2 xy = two_sum(x_of(p), y_of(p));
    const Double2 xyz = two_sum(xy.high, z_of(p));
    const Double2 h = two_sum(xyz.high, -offset);
    x = two_sum(h.high, ((xy.low + xyz.low) + h.low) + rests);
    error = kHeightError * (magnitude(p) + std::abs(offset));
  }
};

/// Left are planes along two axes, where numbers are exact and ties frequent.
CONTACT_LANES Filtered contact_over_plane(Axes lowest, const HeightOver& h, Axes n, Number sizes,
                                          const HalfSpace& plane, const Lengths& lengths, PointOn on,
                                          Contact& contact) {
  const Number off = 4 * bounds::kUnit * std::abs(h.x.high) + h.error;
  const Filtered filtered =
      plain_decision::filter_height({h.x.high - off, h.x.high + off}, plane.normal,
                                    (magnitude(n) + sizes) + std::abs(plane.offset), reach_of(lengths));
  if (filtered != Filtered::hit) return filtered;
  const Mask level = hn::Eq(n, all<Axes>(0));
  const Number N = plain_dot(n, n);
  const int axes = bits_of(level) & 0b111;
  if ((axes & (axes - 1)) != 0 || !(N >= bounds::kLeastSize)) return Filtered::undecided;
  const Direction m(exact(n), N);
  const Double2 root = two_sum(m.root.high, m.root.low);
  const Number q = h.x.high / root.high;
  const Double2 s = two_sum(q, hn::NegMulAdd(q, root.low, hn::NegMulAdd(q, root.high, h.x.high) + h.x.low) / root.high);
  const Number size = std::abs(s.high);
  const Number s_error = h.error * bounds::kTurn * m.reciprocal + bounds::kLeast;
  const Double2 rest = two_sum(lengths.radius1, lengths.contact);
  const Double2 sum = two_difference(s.high, rest.high);
  const Near<Number> value(Double2(sum.high, sum.low + (s.low - rest.low)),
                           (size + rest.high) * bounds::kCoreError + s_error);
  const Delta p = exact(lowest);
  const Near<Axes> point1(beside(p, Double2(-sign_of(on, 1) * lengths.radius1, 0), m),
                          zero_where(level, all<Axes>(lengths.radius1 * bounds::kCoreError + bounds::kLeast)));
  const Near<Axes> point2(beside(p, Double2(-s.high, -s.low), m),
                          zero_where(level, all<Axes>(size * bounds::kCoreError + s_error)));
  const Near<Axes> normal(negative(Delta(m.q, m.low)), zero_where(level, all<Axes>(bounds::kLeast)));
  return write(normal, point1, point2, value, contact) ? Filtered::hit : Filtered::undecided;
}

CONTACT_LANES Filtered contact_of(const Vector3& point, const HalfSpace& plane, const Lengths& lengths,
                                  ContactPoints points, Contact& contact) {
  const Axes c = load(point);
  const Axes n = load(plane.normal);
  return contact_over_plane(c, HeightOver(c, n, plane.offset), n, magnitude(c), plane, lengths, points.first, contact);
}
CONTACT_LANES Filtered contact_of(const Segment& segment, const HalfSpace& plane, const Lengths& lengths,
                                  ContactPoints points, Contact& contact) {
  const Axes start = load(segment.start);
  const Axes end = load(segment.end);
  const Axes n = load(plane.normal);
  const HeightOver of_start(start, n, plane.offset);
  const HeightOver of_end(end, n, plane.offset);
  const Number rise = (of_end.x.high - of_start.x.high) + (of_end.x.low - of_start.x.low);
  if (!(std::abs(rise) > 4 * (of_start.error + of_end.error))) return Filtered::undecided;
  const Number sizes = magnitude(start) + magnitude(end);
  return rise > 0 ? contact_over_plane(start, of_start, n, sizes, plane, lengths, points.first, contact)
                  : contact_over_plane(end, of_end, n, sizes, plane, lengths, points.first, contact);
}

// Crossings, by the formulas of crossing_cores.hpp.

/// y, z, x and z, x, y.
CONTACT_LANES Axes turned_once(Axes a) { return {_mm256_permute4x64_pd(a.lanes, 0b11001001)}; }
CONTACT_LANES Axes turned_twice(Axes a) { return {_mm256_permute4x64_pd(a.lanes, 0b11010010)}; }
CONTACT_LANES Axes plain_cross(Axes a, Axes b) {
  return hn::Sub(hn::Mul(turned_once(a), turned_twice(b)), hn::Mul(turned_twice(a), turned_once(b)));
}
CONTACT_LANES Delta product(const Delta& x, const Delta& y) {
  const Axes p = hn::Mul(x.high, y.high);
  return two_sum(p, hn::MulAdd(x.high, y.low, hn::MulAdd(x.low, y.high, hn::MulSub(x.high, y.high, p))));
}
CONTACT_LANES Delta sum(const Delta& x, const Delta& y) {
  const Delta h = two_sum(x.high, y.high);
  return two_sum(h.high, hn::Add(h.low, hn::Add(x.low, y.low)));
}
CONTACT_LANES Delta cross(const Delta& x, const Delta& y) {
  const Delta x1(turned_once(x.high), turned_once(x.low));
  const Delta x2(turned_twice(x.high), turned_twice(x.low));
  const Delta y1(turned_once(y.high), turned_once(y.low));
  const Delta y2(turned_twice(y.high), turned_twice(y.low));
  return sum(product(x1, y2), negative(product(x2, y1)));
}
/// x.y in double-double arithmetic.
CONTACT_LANES Double2 whole_dot(const Delta& x, const Delta& y) {
  const Axes p = hn::Mul(x.high, y.high);
  const Number rests = sum_of(hn::MulAdd(x.high, y.low, hn::MulAdd(x.low, y.high, hn::MulSub(x.high, y.high, p))));
  const Double2 xy = two_sum(x_of(p), y_of(p));
  const Double2 xyz = two_sum(xy.high, z_of(p));
  return two_sum(xyz.high, (xy.low + xyz.low) + rests);
}

template <bool turned, class AnySegment>
CONTACT_LANES Filtered contact_of_crossing(const AnySegment& segment, const Corners& triangle, Contact& contact) {
  const Axes a = load(segment.start);
  const Axes v0 = load(triangle.vertices[0]);
  const Delta d = exactly_along(segment);
  const Delta u = two_difference(load(triangle.vertices[1]), v0);
  const Delta v = two_difference(load(triangle.vertices[2]), v0);
  const Delta w = two_difference(v0, a);
  const Axes plain_n = plain_cross(u.high, v.high);
  const Axes plain_q = plain_cross(w.high, d.high);
  const Number size_u = magnitude(u.high);
  const Number size_v = magnitude(v.high);
  const Number size_w = magnitude(w.high);
  const Number size_d = magnitude(d.high);
  const Filtered filtered = plain_decision::filter_signs(
      {plain_dot(plain_n, d.high), plain_dot(plain_n, w.high), plain_dot(v.high, plain_q), -plain_dot(u.high, plain_q)},
      {size_w, size_d, size_u, size_v});
  if (filtered != Filtered::hit) return filtered;
  const Delta n = cross(u, v);
  const Double2 through = whole_dot(n, d);
  const Number S = size_u * size_v * (1 + 0x1p-50);
  if (!(std::abs(through.high) > S * size_d * 0x1p-40 && std::abs(through.high) >= kLeastThrough))
    return Filtered::undecided;
  const Double2 at = whole_dot(n, w);
  const Number q = at.high / through.high;
  const Double2 part =
      two_sum(q, hn::NegMulAdd(q, through.low, hn::NegMulAdd(q, through.high, at.high) + at.low) / through.high);
  const Number k = S / std::abs(through.high) * (1 + 0x1p-40);
  const Number part_error = 37 * k * (size_w + size_d) + 25;
  const Delta x = sum(exact(a), product(Delta(all<Axes>(part.high), all<Axes>(part.low)), d));
  const Axes x_error =
      hn::Mul(all<Axes>(kUnitSquared),
              hn::Add(hn::MulAdd(all<Axes>(part_error), hn::Abs(d.high), hn::Mul(all<Axes>(5), hn::Abs(a))),
                      hn::Mul(all<Axes>(2), hn::Abs(x.high))));
  const Axes zero = all<Axes>(0);
  // Along a plane of an axis the coordinate is the start's.
  const Near<Axes> crossing(x, zero_where(hn::Eq(d.high, zero), hn::Add(x_error, all<Axes>(bounds::kLeast))));
  const auto is_zero = [&](Axes y, Axes z) __attribute__((always_inline, target("avx2,fma"))) {
    return hn::Or(hn::Eq(y, zero), hn::Eq(z, zero));
  };
  const Mask flat =
      hn::And(is_zero(turned_once(u.high), turned_twice(v.high)), is_zero(turned_twice(u.high), turned_once(v.high)));
  const Direction m(turned ? negative(n) : n, plain_dot(n.high, n.high));
  const Number turn = 12 * kUnitSquared * S * bounds::kTurn * m.reciprocal;
  const Near<Axes> normal(Delta(m.q, m.low), zero_where(flat, all<Axes>(turn)));
  return write(normal, crossing, crossing, Near<Number>(Double2(0, 0), 0), contact) ? Filtered::hit
                                                                                    : Filtered::undecided;
}
CONTACT_LANES Filtered contact_of(const Corners& triangle, const Segment& segment, const Lengths& /*lengths*/,
                                  ContactPoints /*points*/, Contact& contact) {
  return contact_of_crossing<false>(segment, triangle, contact);
}
CONTACT_LANES Filtered contact_of(const DirectedSegment& segment, const Corners& triangle, const Lengths& /*lengths*/,
                                  ContactPoints /*points*/, Contact& contact) {
  return contact_of_crossing<true>(segment, triangle, contact);
}

#undef CONTACT_LANES

}  // namespace contact::kernel::one_vector

#endif
