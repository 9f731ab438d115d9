// The decisions of segments, triangles and planes in plain arithmetic, inline, as plain_decision.hpp has those of spheres
// and boxes: right in every rounding mode, where subnormal numbers are flushed, and where products and sums are fused.
//
//   w + s u + t v     all ways from one core to the other, for weights s and t that the pair allows
//   D(s, t)           the square of such a way's length
// Any weights prove a hit where D is within reach. They prove a miss as well: D is convex, so that no weights have less
// than D and what its slope from there on takes away. How the weights are found does not matter, then, nor whether they
// are near the best ones.
// Evidence    proofs, core_term.g and core_filter.g; docs/error-bounds.md#decisions-of-one-pair-kcoregap.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "contact/plain_decision.hpp"

namespace contact::inline CONTACT_ABI::plain_decision {

struct CoreBounds {
  static constexpr double kUnit = Bounds<double>::kUnit;
  /// Of the squares |w|^2, |u|^2, |v|^2 and reach^2 together.
  static constexpr double kGap = 192 * kUnit;
  /// Of the products of sums of components that a crossing, or the height over a plane, is made of.
  static constexpr double kSignGap = 24 * kUnit;
  static constexpr double kHeightGap = 12 * kUnit;
  /// What is flushed or underflows costs less than this, as long as nothing is above kMost.
  static constexpr double kFloor = 0x1p-400;
  static constexpr double kMost = 0x1p250;
};

/// A way from one point to another.
struct Way {
  double x;
  double y;
  double z;
};
CONTACT_PLAIN Way way(const Vector3& from, const Vector3& to) {
  return {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
}
CONTACT_PLAIN Way times(double length, const Vector3& direction) {
  return {length * direction[0], length * direction[1], length * direction[2]};
}
CONTACT_PLAIN double dot(const Way& a, const Way& b) {
  CONTACT_PLAIN_ARITHMETIC
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
CONTACT_PLAIN Way cross(const Way& a, const Way& b) {
  CONTACT_PLAIN_ARITHMETIC
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
CONTACT_PLAIN double sum_of_sizes(double x, double y, double z) { return std::abs(x) + std::abs(y) + std::abs(z); }
CONTACT_PLAIN double sum_of_sizes(const Way& a) { return sum_of_sizes(a.x, a.y, a.z); }
// Compilers make branches of the conditional operator, and a wrong guess of one costs as much as a decision. These are none; the lesser
// and the greater are b where a is no number.
#if defined(__SSE2__)
CONTACT_PLAIN double lesser(double a, double b) { return _mm_cvtsd_f64(_mm_min_sd(_mm_set_sd(a), _mm_set_sd(b))); }
CONTACT_PLAIN double greater(double a, double b) { return _mm_cvtsd_f64(_mm_max_sd(_mm_set_sd(a), _mm_set_sd(b))); }
#else
CONTACT_PLAIN double lesser(double a, double b) { return a < b ? a : b; }
CONTACT_PLAIN double greater(double a, double b) { return a > b ? a : b; }
#endif
CONTACT_PLAIN double chosen(bool first, double a, double b) {
  const std::uint64_t mask = -static_cast<std::uint64_t>(first);
  return std::bit_cast<double>((std::bit_cast<std::uint64_t>(a) & mask) | (std::bit_cast<std::uint64_t>(b) & ~mask));
}
/// A weight from 0 to 1; 0 where it is no number.
CONTACT_PLAIN double clamped(double t) { return lesser(greater(t, 0), 1); }

/// The decision where some way has the square D and none has less than `least`, both within kGap of `size`.
CONTACT_PLAIN Filtered filter_squares(double D, double least, double size, double reach) {
  CONTACT_PLAIN_ARITHMETIC
  const double reach2 = reach * reach;
  const double all = size + reach2;
  const double gap = CoreBounds::kGap * all + CoreBounds::kFloor;
  const bool hit = reach2 - D > gap;
  const bool miss = least - reach2 > gap;
  if (!((hit | miss) & (all < CoreBounds::kMost))) return Filtered::undecided;
  return hit ? Filtered::hit : Filtered::miss;
}

/// A point c and the segment from `start` along u. The weight of the foot is off by little, and D by the square of
/// that: no way is shorter.
CONTACT_PLAIN Filtered filter_point_and_segment(const Vector3& c, const Vector3& start, const Way& u, double reach) {
  CONTACT_PLAIN_ARITHMETIC
  const Way w = way(c, start);
  const double W = dot(w, w);
  const double A = dot(u, u);
  const double C = dot(w, u);
  const double s = clamped(-C / A);
  const double D = W + s * (2 * C + s * A);
  return filter_squares(D, D, W + A, reach);
}

/// The products of w, u and v.
struct Spread {
  double ww;
  double uu;
  double vv;
  double uv;
  double uw;
  double vw;
};
CONTACT_PLAIN Spread spread(const Way& w, const Way& u, const Way& v) {
  return {dot(w, w), dot(u, u), dot(v, v), dot(u, v), dot(u, w), dot(v, w)};
}

struct Weights {
  double s;
  double t;
};

/// What weights prove. `together`: s + t is at most 1; else each of them is.
CONTACT_PLAIN Filtered filter_weights(const Spread& x, const Weights& weights, bool together, double reach) {
  CONTACT_PLAIN_ARITHMETIC
  const auto [s, t] = weights;
  const double along_u = x.uw + (s * x.uu + t * x.uv);
  const double along_v = x.vw + (s * x.uv + t * x.vv);
  const double along_w = x.ww + (s * x.uw + t * x.vw);
  const double moved = s * along_u + t * along_v;
  const double u_takes = lesser(along_u, 0);
  const double v_takes = lesser(along_v, 0);
  const double takes = together ? lesser(u_takes, v_takes) : u_takes + v_takes;
  return filter_squares(along_w + moved, (along_w - moved) + 2 * takes, x.ww + (x.uu + x.vv), reach);
}

/// Of two segments each weight is the best one for the other, as far as it goes.
CONTACT_PLAIN Weights weights_of_segments(const Spread& x) {
  CONTACT_PLAIN_ARITHMETIC
  const double per_uu = 1 / x.uu;
  const double per_vv = 1 / x.vv;
  const double at_first = clamped((x.uv * x.vw - x.vv * x.uw) / (x.uu * x.vv - x.uv * x.uv));
  const double t = clamped(-(x.vw + at_first * x.uv) * per_vv);
  return {clamped(-(x.uw + t * x.uv) * per_uu), t};
}
/// From the first segment to the second, backwards along the first, and along the second.
CONTACT_PLAIN Filtered filter_segments(const Vector3& start1, const Vector3& end1, const Vector3& start2,
                                       const Vector3& end2, double reach) {
  const Spread x = spread(way(start1, start2), way(end1, start1), way(start2, end2));
  return filter_weights(x, weights_of_segments(x), false, reach);
}

/// Of a point and a triangle, w to the vertex that u and v start from: over the face, or the nearest of the feet on its edges.
CONTACT_PLAIN Weights weights_of_triangle(const Spread& x) {
  CONTACT_PLAIN_ARITHMETIC
  const double on_u = clamped(-x.uw / x.uu);
  const double by_u = on_u * (2 * x.uw + on_u * x.uu);
  const double on_v = clamped(-x.vw / x.vv);
  const double by_v = on_v * (2 * x.vw + on_v * x.vv);
  const double slope = (x.vw - x.uw) + (x.uv - x.uu);  // from u to v
  const double length2 = (x.uu - x.uv) + (x.vv - x.uv);
  const double across = clamped(-slope / length2);
  const double by_across = (2 * x.uw + x.uu) + across * (2 * slope + across * length2);
  const bool is_v = by_v < by_u;
  const bool is_across = by_across < lesser(by_v, by_u);
  const double of_u = x.uv * x.vw - x.vv * x.uw;
  const double of_v = x.uv * x.uw - x.uu * x.vw;
  const double of_both = x.uu * x.vv - x.uv * x.uv;
  const bool is_inside = (of_u > 0) & (of_v > 0) & (of_u + of_v < of_both);
  const double s = chosen(is_across, 1 - across, chosen(is_v, 0, on_u));
  const double t = chosen(is_across, across, chosen(is_v, on_v, 0));
  return {chosen(is_inside, of_u / of_both, s), chosen(is_inside, of_v / of_both, t)};
}
CONTACT_PLAIN Filtered filter_point_and_triangle(const Vector3& c, const std::array<Vector3, 3>& v, double reach) {
  const Spread x = spread(way(c, v[0]), way(v[0], v[1]), way(v[0], v[2]));
  return filter_weights(x, weights_of_triangle(x), true, reach);
}

/// The height of a point over a plane, times the length of its normal: between `low` and `high`.
struct Height {
  double low;
  double high;
};
CONTACT_PLAIN Height height(const Vector3& c, const Vector3& n, double offset, double size_of_normal) {
  CONTACT_PLAIN_ARITHMETIC
  const double h = ((n[0] * c[0] + n[1] * c[1]) + n[2] * c[2]) - offset;
  const double size = size_of_normal * sum_of_sizes(c[0], c[1], c[2]) + std::abs(offset);
  const double error = CoreBounds::kHeightGap * size + CoreBounds::kFloor;
  return {h - error, h + error};
}
/// The lowest of some heights against reach, each squared with its sign: nothing is divided, and no root is taken.
CONTACT_PLAIN Filtered filter_height(const Height& h, const Vector3& n, double size, double reach) {
  CONTACT_PLAIN_ARITHMETIC
  const Way reached = times(reach, n);
  const double R = dot(reached, reached);
  const double gap = Bounds<double>::kGap * R + CoreBounds::kFloor;
  const bool hit = h.high * std::abs(h.high) + gap < R;
  const bool miss = R + gap < h.low * std::abs(h.low);
  if (!((hit | miss) & (size + reach < CoreBounds::kMost))) return Filtered::undecided;
  return hit ? Filtered::hit : Filtered::miss;
}
CONTACT_PLAIN Filtered filter_point_and_plane(const Vector3& c, const Vector3& n, double offset, double reach) {
  CONTACT_PLAIN_ARITHMETIC
  const double size = sum_of_sizes(n[0], n[1], n[2]);
  const Height h = height(c, n, offset, size);
  return filter_height(h, n, size + sum_of_sizes(c[0], c[1], c[2]) + std::abs(offset), reach);
}
CONTACT_PLAIN Filtered filter_segment_and_plane(const Vector3& start, const Vector3& end, const Vector3& n,
                                                double offset, double reach) {
  CONTACT_PLAIN_ARITHMETIC
  const double size = sum_of_sizes(n[0], n[1], n[2]);
  const Height a = height(start, n, offset, size);
  const Height b = height(end, n, offset, size);
  const Height lowest{lesser(a.low, b.low), lesser(a.high, b.high)};
  const double sizes = sum_of_sizes(start[0], start[1], start[2]) + sum_of_sizes(end[0], end[1], end[2]);
  return filter_height(lowest, n, size + sizes + std::abs(offset), reach);
}

/// Of the segment from w = 0 along d and the triangle from w along u and v, with n = u x v: the segment and the plane meet at the
/// share n.w / n.d of d, in the point of weights v.(w x d) / n.d and -u.(w x d) / n.d.
struct Shares {
  double through;  ///< n.d
  double at;
  double of_u;
  double of_v;
};
/// The sums of components.
struct Sizes {
  double w;
  double d;
  double u;
  double v;
};
/// They cross where these three shares, what is left of 1 by the first, and what is left of 1 by the others are not negative:
/// numbers of one sign.
CONTACT_PLAIN Filtered filter_signs(const Shares& x, const Sizes& of) {
  CONTACT_PLAIN_ARITHMETIC
  const double numbers[5] = {x.at, x.through - x.at, x.of_u, x.of_v, x.through - (x.of_u + x.of_v)};
  double least = numbers[0];
  double most = numbers[0];
  for (const double number : numbers) {
    least = lesser(number, least);
    most = greater(number, most);
  }
  const double size = of.u * of.v * (of.d + of.w) + of.d * of.w * (of.u + of.v);
  const double error = CoreBounds::kSignGap * size + CoreBounds::kFloor;
  const bool hit = (least > error) | (most < -error);
  const bool miss = (least < -error) & (most > error);
  if (!((hit | miss) & ((of.u + of.v) + (of.d + of.w) < CoreBounds::kMost))) return Filtered::undecided;
  return hit ? Filtered::hit : Filtered::miss;
}
CONTACT_PLAIN Filtered filter_crossing(const Vector3& start, const Way& d, const std::array<Vector3, 3>& vertices) {
  const Way w = way(start, vertices[0]);
  const Way u = way(vertices[0], vertices[1]);
  const Way v = way(vertices[0], vertices[2]);
  const Way n = cross(u, v);
  const Way q = cross(w, d);
  return filter_signs({dot(n, d), dot(n, w), dot(v, q), -dot(u, q)},
                      {sum_of_sizes(w), sum_of_sizes(d), sum_of_sizes(u), sum_of_sizes(v)});
}

// The pairs by their shapes.

CONTACT_PLAIN Filtered filter_pair(const Ball& a, const Capsule& b, double alarm) {
  return filter_point_and_segment(a.center, b.start, way(b.start, b.end), (a.radius + b.radius) + alarm);
}
CONTACT_PLAIN Filtered filter_pair(const Capsule& a, const Capsule& b, double alarm) {
  return filter_segments(a.start, a.end, b.start, b.end, (a.radius + b.radius) + alarm);
}
CONTACT_PLAIN Filtered filter_pair(const Ball& a, const Triangle& b, double alarm) {
  return filter_point_and_triangle(a.center, b.vertices, a.radius + alarm);
}
CONTACT_PLAIN Filtered filter_pair(const Ray& a, const Ball& b, double alarm) {
  return filter_point_and_segment(b.center, a.origin, times(a.length, a.direction), b.radius + alarm);
}
CONTACT_PLAIN Filtered filter_pair(const Ball& a, const Plane& b, double alarm) {
  return filter_point_and_plane(a.center, b.normal, b.offset, a.radius + alarm);
}
CONTACT_PLAIN Filtered filter_pair(const Capsule& a, const Plane& b, double alarm) {
  return filter_segment_and_plane(a.start, a.end, b.normal, b.offset, a.radius + alarm);
}
CONTACT_PLAIN Filtered filter_pair(const Ray& a, const Triangle& b) {
  return filter_crossing(a.origin, times(a.length, a.direction), b.vertices);
}
CONTACT_PLAIN Filtered filter_pair(const Triangle& a, const Line& b) {
  return filter_crossing(b.start, way(b.start, b.end), a.vertices);
}

}  // namespace contact::inline CONTACT_ABI::plain_decision
