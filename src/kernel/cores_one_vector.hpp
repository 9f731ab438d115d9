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
#include "kernel/sum_of_two.hpp"
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

/// One number after the other: cores are built just before, and a processor does not forward what was stored in pieces.
CONTACT_LANES Axes load(const Vector3& v) { return {_mm256_setr_pd(v[0], v[1], v[2], 0)}; }
CONTACT_LANES Number sum_of(Axes a) { return (x_of(a) + y_of(a)) + z_of(a); }
CONTACT_LANES Number plain_dot(Axes a, Axes b) { return sum_of(hn::Mul(a, b)); }
CONTACT_LANES Number magnitude(Axes a) { return sum_of(hn::Abs(a)); }
CONTACT_LANES Axes zero_where(Mask mask, Axes x) { return {_mm256_andnot_pd(mask.lanes, x.lanes)}; }
CONTACT_LANES Axes chosen(Mask first, Axes a, Axes b) { return {_mm256_blendv_pd(b.lanes, a.lanes, first.lanes)}; }
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

/// y, z, x.
CONTACT_LANES Axes turned_once(Axes a) { return {_mm256_permute4x64_pd(a.lanes, 0b11001001)}; }
CONTACT_LANES Delta turned_once(const Delta& x) { return Delta(turned_once(x.high), turned_once(x.low)); }
/// The components of u x v whose products are 0.
CONTACT_LANES Mask zeros_of_cross(Axes u, Axes v) {
  const Axes zero = all<Axes>(0);
  const Mask one = hn::Or(hn::Eq(u, zero), hn::Eq(turned_once(v), zero));
  return turned_once(hn::And(one, hn::Or(hn::Eq(turned_once(u), zero), hn::Eq(v, zero))));
}

/// Two cores: d from the first to the second, |d|^2 in plain arithmetic, and the first, p. `same`: lanes whose coordinate all points
/// share. `flat`: lanes of d that are 0. `level`: lanes that all points of the second core share, those of `second`.
struct Cores {
  Delta d;
  Number d2;
  Number d_error;
  Delta p;
  Number p_error;
  Mask same;
  Mask flat;
  Axes second;
  Mask level;

  CONTACT_LANES Cores() : flat(all<Axes>(0)) {}
};

/// A point and a segment: batch_point_segment-inl.h. The decision is that of plain_cores.hpp.
template <class AnySegment>
CONTACT_LANES Filtered find_cores(const Vector3& point, const AnySegment& segment, Mask along_same, Number reach,
                                  Cores& cores) {
  const Axes c = load(point);
  const Axes start = load(segment.start);
  const Delta v = exactly_along(segment);
  const int level = bits_of(hn::Eq(v.high, all<Axes>(0))) & 0b111;
  if ((level & (level - 1)) != 0) return Filtered::undecided;  // along an axis: simple_points.hpp
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
  cores.second = start;
  cores.level = along_same;
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

/// The shortest of them, near which the weights are: batch_ways-inl.h. A weight that is 0, or 1 where each may be, stays
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
  cores.flat = all<Axes>(0);
  if (!s_ends && !t_ends &&
      ((bits_of(hn::Eq(way.u.high, all<Axes>(0))) | bits_of(hn::Eq(way.v.high, all<Axes>(0)))) & 0b111) != 0) {
    // d is along u x v, and 0 where that is.
    cores.flat = zeros_of_cross(way.u.high, way.v.high);
    cores.d = Delta(zero_where(cores.flat, cores.d.high), zero_where(cores.flat, cores.d.low));
  }
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
         (!together || (rest >= bounds::kLeastRest && rest * std::min(length1, length2) >= 8 * error)) &&
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
  const Axes zero = all<Axes>(0);
  const Axes rounded = hn::Add(end, zero);  // every zero is +0
  certain = hn::And(certain, ends_of(point1, end));
  const Axes rounded1 = hn::Add(end, zero);
  // The value is rounded in the second point's last lane.
  const Mask last_certain = ends_of(
      Near<Axes>(DoubleDouble<Axes>(with_last(point2.x.high, value.x.high), with_last(point2.x.low, value.x.low)),
                 with_last(point2.error, value.error)),
      end);
  store(rounded, rounded1, hn::Add(end, zero), false, contact);
  return ((bits_of(certain) | 0b1000) & bits_of(last_certain)) == 0b1111;
}

/// core + length n.
template <class AnyWay>
CONTACT_LANES Delta beside(const Delta& core, const Double2& length, const AnyWay& n) {
  const Delta at = point(core.high, all<Axes>(length.high), n.q, n.low);
  return Delta(at.high, hn::Add(hn::MulAdd(all<Axes>(length.low), n.q, at.low), core.low));
}

/// The contact of cores with a distance: the second core is the first and s n, and its surface nearer by the radius. `turned`: what
/// comes first in the question is second here. `second_is_bare`: it has no radius, and its points on itself.
template <bool turned, bool first_is_point, bool second_is_bare>
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
  const Mask same = hn::And(hn::Eq(cores.d.high, all<Axes>(0)), cores.same);
  const Mask flat = hn::Or(cores.flat, same);
  const Mask exact = first_is_point ? flat : same;
  const Near<Axes> point1(beside(cores.p, Double2(sign_of(on1, 1) * radius1, 0), n),
                          zero_where(exact, all<Axes>(radius1 * of_length + cores.p_error)));
  const Delta beside2 = beside(cores.p, to_second, n);
  const Axes error2 = all<Axes>((radius2 + length) * of_length + (cores.p_error + cores.d_error));
  const Near<Axes> point2 =
      second_is_bare
          ? Near<Axes>(Delta(chosen(cores.level, cores.second, beside2.high), zero_where(cores.level, beside2.low)),
                       zero_where(hn::Or(exact, cores.level), error2))
          : Near<Axes>(beside2, zero_where(exact, error2));
  const Delta direction(n.q, n.low);
  const Near<Axes> normal(turned ? negative(direction) : direction, zero_where(flat, all<Axes>(turn)));
  const bool settled =
      turned ? write(normal, point2, point1, value, contact) : write(normal, point1, point2, value, contact);
  return settled ? Filtered::hit : Filtered::undecided;
}

// A miss, a hit whose contact is settled, or neither.

CONTACT_LANES Filtered settled(bool all_numbers) { return all_numbers ? Filtered::hit : Filtered::undecided; }

CONTACT_LANES Filtered contact_of(const Vector3& c, const Segment& segment, const Lengths& lengths,
                                  ContactPoints points, Contact& contact) {
  Cores cores;
  const Mask same = hn::Eq(load(segment.start), load(segment.end));
  const Filtered filtered = find_cores(c, segment, same, reach_of(lengths), cores);
  return filtered == Filtered::hit ? contact_of_cores<false, true, false>(cores, lengths, points, contact) : filtered;
}
CONTACT_LANES Filtered contact_of(const DirectedSegment& segment, const Vector3& c, const Lengths& lengths,
                                  ContactPoints points, Contact& contact) {
  Cores cores;
  const Mask same = hn::Eq(load(segment.direction), all<Axes>(0));
  const Filtered filtered = find_cores(c, segment, same, reach_of(lengths), cores);
  return filtered == Filtered::hit ? contact_of_cores<true, true, true>(cores, lengths, points, contact) : filtered;
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
  return contact_of_cores<false, false, false>(cores, lengths, points, contact);
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
  cores.level = hn::And(hn::Eq(v0, v1), hn::Eq(v0, v2));
  cores.second = v0;
  cores.same = hn::And(hn::Eq(c, v0), cores.level);
  return contact_of_cores<false, true, true>(cores, lengths, points, contact);
}

// Where plain arithmetic says that there is a hit: all that is left is numbers.

/// Three numbers that a caller has in memory, not stored just before.
CONTACT_LANES Axes load_given(const Vector3& v) {
  return {_mm256_maskload_pd(v.data(), _mm256_setr_epi64x(-1, -1, -1, 0))};
}

/// x, y and z of three vectors, each in a vector of its own.
struct Columns {
  Axes x;
  Axes y;
  Axes z;

  CONTACT_LANES Columns(Axes a, Axes b, Axes c) {
    const __m256d xz = _mm256_unpacklo_pd(a.lanes, b.lanes);
    const __m256d last_xz = _mm256_unpacklo_pd(c.lanes, c.lanes);
    x = {_mm256_permute2f128_pd(xz, last_xz, 0x20)};
    y = {_mm256_permute2f128_pd(_mm256_unpackhi_pd(a.lanes, b.lanes), _mm256_unpackhi_pd(c.lanes, c.lanes), 0x20)};
    z = {_mm256_permute2f128_pd(xz, last_xz, 0x31)};
  }
};
/// x.y on each axis: the product, and what it lacks.
CONTACT_LANES Delta products(Axes x, Axes y) {
  const Axes p = hn::Mul(x, y);
  return Delta(p, hn::MulSub(x, y, p));
}
CONTACT_LANES Delta products(const Delta& x, const Delta& y) {
  const Axes p = hn::Mul(x.high, y.high);
  return Delta(p, hn::MulAdd(x.low, y.high, hn::MulAdd(x.high, y.low, hn::MulSub(x.high, y.high, p))));
}
CONTACT_LANES Delta squares(const Delta& x) {
  const Axes p = hn::Mul(x.high, x.high);
  const Axes twice = hn::MulAdd(all<Axes>(2), x.high, x.low);
  return Delta(p, hn::MulAdd(x.low, twice, hn::MulSub(x.high, x.high, p)));
}
/// Three sums of x, y and z at once: in the first lanes.
CONTACT_LANES Delta sums_of(const Delta& a, const Delta& b, const Delta& c) {
  const Columns high(a.high, b.high, c.high);
  const Columns low(a.low, b.low, c.low);
  const Delta xy = two_sum(high.x, high.y);
  const Delta xyz = two_sum(xy.high, high.z);
  return Delta(xyz.high, hn::Add(hn::Add(xy.low, xyz.low), hn::Add(hn::Add(low.x, low.y), low.z)));
}

/// 1 / sqrt(N) = reciprocal (1 + half_rho). The root and the quotient do not wait for each other.
struct ReciprocalRoot {
  Number reciprocal;
  Number half_rho;

  CONTACT_LANES explicit ReciprocalRoot(const Double2& N) {
    const Number y = _mm_cvtsd_f64(_mm_sqrt_sd(_mm_setzero_pd(), _mm_set_sd(N.high))) * (1 / N.high);
    const Number half = 0.5 * N.high;
    const Number g = y * y;
    reciprocal = y;
    half_rho = hn::NegMulAdd(g, half, 0.5) - hn::MulAdd(hn::MulSub(y, y, g), half, g * (0.5 * N.low));
  }
};
/// A way as beside() takes it; of a vector n, n / |n|, or -n / |n|.
struct Directed {
  Axes q;
  Axes low;

  CONTACT_LANES explicit Directed(const Delta& way) : q(way.high), low(way.low) {}
  CONTACT_LANES Directed(const Delta& n, const ReciprocalRoot& root, bool backwards) {
    const Number y = backwards ? -root.reciprocal : root.reciprocal;
    q = product(n, y);
    low = times_plus(q, root.half_rho, product_rest(n, y, q));
  }
};

// A ball and a box.

/// The contact of centres that are neither too near nor too far.
CONTACT_LANES bool hit_of_balls(Axes first, Axes second, const Double2& radii, Number signed_radius1,
                                Number signed_radius2, Number contact_distance, Contact& contact) {
  const Axes d = hn::Sub(second, first);
  const Number d2 = plain_dot(d, d);
  return contact_of_hit(first, second, d2, radii, contact_distance, signed_radius1, signed_radius2, contact) &&
         d2 > bounds::kLeast && d2 < bounds::kMost;
}

/// Along the axis of n, which is 1 or -1 there and 0 elsewhere, each number is a sum of numbers of the question: sphere_cube.cpp.
CONTACT_LANES bool hit_along_axis(Axes center, Axes face, Axes n, Number radius, Number contact_distance, PointOn on,
                                  bool inside, Contact& contact) {
  one_number::SumOfTwo<double> value(sum_of(hn::Mul(n, face)), -sum_of(hn::Mul(n, center)));
  value.add(-radius);
  value.add(-contact_distance);
  const Axes zero = all<Axes>(0);
  const Axes point1 = hn::MulAdd(n, all<Axes>(sign_of(on, 1) * radius), center);
  store(hn::Add(n, zero), hn::Add(point1, zero), with_last(hn::Add(face, zero), value.rounded()), inside, contact);
  return value.lost == 0;
}
CONTACT_LANES bool contact_of_hit(const Ball& a, const Box& b, Number contact_distance, ContactPoints points,
                                  Contact& contact) {
  const Axes center = load(a);
  const Axes min = load_given(b.min);
  const Axes max = load_given(b.max);
  const Axes q{_mm256_min_pd(_mm256_max_pd(center.lanes, min.lanes), max.lanes)};
  const Axes d = hn::Sub(q, center);
  const int beside = ~bits_of(hn::Eq(d, all<Axes>(0))) & 0b111;
  if ((beside & (beside - 1)) != 0)
    return hit_of_balls(center, q, Double2(a.radius, 0), sign_of(points.first, 1) * a.radius, 0, contact_distance,
                        contact);
  const Axes one = all<Axes>(1);
  if (beside != 0) {
    const __m256d sign = _mm256_and_pd(_mm256_set1_pd(-0.0), d.lanes);
    const Mask before{_mm256_cmp_pd(d.lanes, _mm256_setzero_pd(), _CMP_NEQ_OQ)};
    const Axes n{_mm256_and_pd(before.lanes, _mm256_or_pd(sign, one.lanes))};
    return hit_along_axis(center, q, n, a.radius, contact_distance, points.first, false, contact);
  }
  // Rounding is monotone: a face is nearest that is so after it. Ties are left.
  const Axes before_min = hn::Sub(min, center);
  const Axes before_max = hn::Sub(center, max);
  const Axes nearer{_mm256_max_pd(before_min.lanes, before_max.lanes)};
  const Axes nearest = all<Axes>(std::max(std::max(x_of(nearer), y_of(nearer)), z_of(nearer)));
  const Mask at_min = hn::Eq(before_min, nearest);
  const Mask at_max = hn::Eq(before_max, nearest);
  const int mins = bits_of(at_min) & 0b111;
  const int maxes = bits_of(at_max) & 0b111;
  const int faces = mins | maxes << 3;
  if ((faces & (faces - 1)) != 0) return false;
  const Axes n{_mm256_or_pd(_mm256_and_pd(at_min.lanes, one.lanes), _mm256_and_pd(at_max.lanes, _mm256_set1_pd(-1)))};
  const Axes face{_mm256_blendv_pd(_mm256_blendv_pd(center.lanes, min.lanes, at_min.lanes), max.lanes, at_max.lanes)};
  return hit_along_axis(center, face, n, a.radius, contact_distance, points.first, true, contact);
}

// Planes.

/// Over a floor or beside a wall, a plane along two axes: as before a box's face, where offset / |n| is exact.
CONTACT_LANES bool hit_over_floor(Axes lowest, Axes n, Number offset, Number radius, Number contact_distance,
                                  PointOn on, Contact& contact) {
  const Number size = magnitude(n);
  const Number place = offset / size;
  const bool exact = hn::NegMulAdd(place, size, offset) == 0 && size * size >= bounds::kLeastNormalSquare &&
                     (offset == 0 || std::abs(offset) >= bounds::kLeast);
  const Axes unit{_mm256_div_pd(n.lanes, _mm256_set1_pd(size))};
  const Mask level = hn::Eq(unit, all<Axes>(0));
  const Axes face{_mm256_blendv_pd(hn::Mul(unit, all<Axes>(place)).lanes, lowest.lanes, level.lanes)};
  return hit_along_axis(lowest, face, hn::Sub(all<Axes>(0), unit), radius, contact_distance, on, false, contact) &&
         exact;
}
/// The lowest point of a core over a plane.
CONTACT_LANES bool hit_over_plane(Axes lowest, Axes n, Number offset, Number radius, Number contact_distance,
                                  PointOn on, Contact& contact) {
  const Mask level = hn::Eq(n, all<Axes>(0));
  const int axes = bits_of(level) & 0b111;
  if ((axes & (axes - 1)) != 0) return hit_over_floor(lowest, n, offset, radius, contact_distance, on, contact);
  const Delta over = products(n, lowest);
  const Delta square = products(n, n);
  const Delta sums = sums_of(over, square, square);
  const Double2 N(y_of(sums.high), y_of(sums.low));
  const ReciprocalRoot root(N);
  const Double2 h = two_sum(x_of(sums.high), -offset);
  const Number h_low = h.low + x_of(sums.low);
  const Number q = h.high * root.reciprocal;
  const Number rest_of_q = hn::MulAdd(h_low, root.reciprocal, hn::MulSub(h.high, root.reciprocal, q));
  const Double2 s(q, hn::MulAdd(q, root.half_rho, rest_of_q));
  const Number size = std::abs(s.high);
  const Number s_error =
      bounds::kOverPlane * (magnitude(over.high) + std::abs(offset)) * root.reciprocal + bounds::kLeast;
  const Double2 rest = two_sum(radius, contact_distance);
  const Double2 sum = two_difference(s.high, rest.high);
  const Near<Number> value(Double2(sum.high, sum.low + (s.low - rest.low)),
                           (size + rest.high) * bounds::kCoreError + s_error);
  const Directed m(exact(n), root, true);
  const Delta p = exact(lowest);
  const Near<Axes> point1(beside(p, Double2(sign_of(on, 1) * radius, 0), m),
                          zero_where(level, all<Axes>(radius * bounds::kCoreError + bounds::kLeast)));
  const Near<Axes> point2(beside(p, s, m), zero_where(level, all<Axes>(size * bounds::kCoreError + s_error)));
  const Near<Axes> normal(Delta(m.q, m.low), zero_where(level, all<Axes>(bounds::kLeast)));
  return write(normal, point1, point2, value, contact) && N.high >= bounds::kLeastNormalSquare;
}
/// Left are capsules whose ends are nearly level, unless they are so exactly and over a floor.
CONTACT_LANES bool hit_over_plane(Axes start, Axes end, Axes n, Number offset, Number radius, Number contact_distance,
                                  PointOn on, Contact& contact) {
  const Axes of_start = hn::Mul(n, start);
  const Axes of_end = hn::Mul(n, end);
  const Number rise = sum_of(hn::Sub(of_end, of_start));
  const Number sizes = sum_of(hn::Add(hn::Abs(of_start), hn::Abs(of_end)));
  if (!(std::abs(rise) > 8 * bounds::kUnit * sizes + bounds::kLeast)) {
    const int level = bits_of(hn::Eq(n, all<Axes>(0))) & 0b111;
    const int same = bits_of(hn::Eq(start, end)) & 0b111;
    if (same == 0b111) return hit_over_plane(start, n, offset, radius, contact_distance, on, contact);
    if ((level & (level - 1)) == 0 || (level | same) != 0b111) return false;
    // Numbers below 2^250: the half of a sum is rounded once.
    const Axes middle = hn::Mul(all<Axes>(0.5), hn::Add(start, end));
    const bool settled = hit_over_floor(middle, n, offset, radius, contact_distance, on, contact);
    contact.unique = false;
    return settled;
  }
  const Axes lower{
      _mm256_blendv_pd(end.lanes, start.lanes, _mm256_cmp_pd(_mm256_set1_pd(rise), _mm256_setzero_pd(), _CMP_GT_OQ))};
  return hit_over_plane(lower, n, offset, radius, contact_distance, on, contact);
}

CONTACT_LANES Filtered contact_of(const Vector3& point, const HalfSpace& plane, const Lengths& lengths,
                                  ContactPoints points, Contact& contact) {
  const Filtered filtered = plain_filtered(point, plane, lengths);
  if (filtered != Filtered::hit) return filtered;
  return settled(hit_over_plane(load(point), load(plane.normal), plane.offset, lengths.radius1, lengths.contact,
                                points.first, contact));
}
CONTACT_LANES Filtered contact_of(const Segment& segment, const HalfSpace& plane, const Lengths& lengths,
                                  ContactPoints points, Contact& contact) {
  const Filtered filtered = plain_filtered(segment, plane, lengths);
  if (filtered != Filtered::hit) return filtered;
  return settled(hit_over_plane(load(segment.start), load(segment.end), load(plane.normal), plane.offset,
                                lengths.radius1, lengths.contact, points.first, contact));
}
CONTACT_LANES bool contact_of_hit(const Ball& a, const Plane& b, Number contact_distance, ContactPoints points,
                                  Contact& contact) {
  return hit_over_plane(load_given(a.center), load_given(b.normal), b.offset, a.radius, contact_distance, points.first,
                        contact);
}
CONTACT_LANES bool contact_of_hit(const Capsule& a, const Plane& b, Number contact_distance, ContactPoints points,
                                  Contact& contact) {
  return hit_over_plane(load_given(a.start), load_given(a.end), load_given(b.normal), b.offset, a.radius,
                        contact_distance, points.first, contact);
}

// Crossings, by the formulas of crossing_cores.hpp.

/// The sums of the components of four vectors whose last lane is 0.
struct Magnitudes {
  Number first;
  Number second;
  Number third;
  Number fourth;

  CONTACT_LANES Magnitudes(Axes a, Axes b, Axes c, Axes d) {
    const __m256d ab = _mm256_hadd_pd(hn::Abs(a).lanes, hn::Abs(b).lanes);
    const __m256d cd = _mm256_hadd_pd(hn::Abs(c).lanes, hn::Abs(d).lanes);
    const __m256d sums = _mm256_add_pd(_mm256_permute2f128_pd(ab, cd, 0x20), _mm256_permute2f128_pd(ab, cd, 0x31));
    first = sums[0];
    second = sums[1];
    third = sums[2];
    fourth = sums[3];
  }
};

/// Of the segment from a along d and the triangle from v0, whose last lanes are 0.
template <bool turned>
CONTACT_LANES bool hit_of_crossing(Axes a, const Delta& d, Axes v0, Axes v1, Axes v2, Contact& contact) {
  const Delta u = two_difference(v1, v0);
  const Delta v = two_difference(v2, v0);
  const Delta w = two_difference(v0, a);
  const Magnitudes size(u.high, v.high, w.high, d.high);
  const Delta turned_u = turned_once(u);
  const Delta turned_v = turned_once(v);
  const Delta one = products(u, turned_v);
  const Delta other = products(turned_u, v);
  const Axes zero = all<Axes>(0);
  const Mask flat = zeros_of_cross(u.high, v.high);
  const Delta high = two_difference(one.high, other.high);
  const Delta n = turned_once(Delta(high.high, hn::Add(high.low, hn::Sub(one.low, other.low))));
  const Delta sums = sums_of(products(n, d), products(n, w), squares(n));
  const Axes sum = hn::Add(sums.high, sums.low);
  const Axes sum_low = hn::Add(hn::Sub(sums.high, sum), sums.low);
  const Double2 through(x_of(sum), x_of(sum_low));
  const Double2 at(y_of(sum), y_of(sum_low));
  const Number reciprocal = 1 / through.high;
  const Number q = at.high * reciprocal;
  const Number rest = hn::NegMulAdd(q, through.low, hn::NegMulAdd(q, through.high, at.high) + at.low);
  const Number S = size.first * size.second * (1 + 0x1p-50);
  const Number k = S * std::abs(reciprocal) * (1 + 0x1p-40);
  const Number part_error = kUnitSquared * (96 * k * (size.third + size.fourth) + 64);
  const ReciprocalRoot root(Double2(z_of(sum), z_of(sum_low)));
  const Directed m(n, root, turned);
  const Number turn = 64 * kUnitSquared * S * bounds::kTurn * root.reciprocal;
  const Near<Axes> normal(Delta(m.q, m.low), zero_where(flat, all<Axes>(turn)));
  // Along a plane of an axis the coordinate is the start's.
  // Of a triangle across an axis it is the triangle's.
  const Mask level = hn::And(hn::Eq(u.high, zero), hn::Eq(v.high, zero));
  const Delta x = beside(exact(a), Double2(q, rest * reciprocal), Directed(d));
  const Near<Axes> crossing(Delta(chosen(level, v0, x.high), zero_where(level, x.low)),
                            zero_where(hn::Or(level, hn::Eq(d.high, zero)),
                                       hn::MulAdd(all<Axes>(part_error), hn::Abs(d.high), all<Axes>(bounds::kLeast))));
  return write(normal, crossing, crossing, Near<Number>(Double2(0, 0), 0), contact) &&
         std::abs(through.high) > S * size.fourth * 0x1p-40 && std::abs(through.high) >= bounds::kLeastThrough &&
         z_of(sum) >= bounds::kLeastSize;
}

template <bool turned, class AnySegment>
CONTACT_LANES Filtered contact_of_crossing(Filtered filtered, const AnySegment& segment, const Corners& triangle,
                                           Contact& contact) {
  if (filtered != Filtered::hit) return filtered;
  const auto& v = triangle.vertices;
  return settled(hit_of_crossing<turned>(load(segment.start), exactly_along(segment), load(v[0]), load(v[1]),
                                         load(v[2]), contact));
}
CONTACT_LANES Filtered contact_of(const Corners& triangle, const Segment& segment, const Lengths& lengths,
                                  ContactPoints /*points*/, Contact& contact) {
  return contact_of_crossing<false>(plain_filtered(triangle, segment, lengths), segment, triangle, contact);
}
CONTACT_LANES Filtered contact_of(const DirectedSegment& segment, const Corners& triangle, const Lengths& lengths,
                                  ContactPoints /*points*/, Contact& contact) {
  return contact_of_crossing<true>(plain_filtered(segment, triangle, lengths), segment, triangle, contact);
}
CONTACT_LANES bool contact_of_hit(const Triangle& a, const Line& b, Number /*contact_distance*/,
                                  ContactPoints /*points*/, Contact& contact) {
  const auto& v = a.vertices;
  const Axes start = load_given(b.start);
  return hit_of_crossing<false>(start, two_difference(load_given(b.end), start), load_given(v[0]), load_given(v[1]),
                                load_given(v[2]), contact);
}
CONTACT_LANES bool contact_of_hit(const Ray& a, const Triangle& b, Number /*contact_distance*/,
                                  ContactPoints /*points*/, Contact& contact) {
  const auto& v = b.vertices;
  return hit_of_crossing<true>(load_given(a.origin), products(load_given(a.direction), all<Axes>(a.length)),
                               load_given(v[0]), load_given(v[1]), load_given(v[2]), contact);
}

#undef CONTACT_LANES

}  // namespace contact::kernel::one_vector

#endif
