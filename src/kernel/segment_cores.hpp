// The nearest points of two segments, each of which may be a point: exactly, and in double-double arithmetic.
//
//   first  a + s u     second  b + t v     w = b - a     0 <= s, t <= 1
//   |w + t v - s u|^2 is least where    A s - B t = C    B s - E t = F
//   A = u.u     B = u.v     E = v.v     C = u.w     F = v.w
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "contact/plain_cores.hpp"
#include "kernel/cores.hpp"
#include "kernel/cores_double_double.hpp"

namespace contact::kernel {

/// A segment, from start to end.
struct Segment {
  Vector3 start;
  Vector3 end;
};

/// The segment from `start` to `start` + `length` `direction`, which is not rounded. Domain: the direction is not zero.
struct DirectedSegment {
  Vector3 start;
  Vector3 direction;
  double length;
};

/// A segment on a grid: its start, and from there to its end.
struct ExactSegment {
  IntegerVector start;
  IntegerVector along;
};
/// Exactly. Of parallel segments side by side p is the middle of all nearest points of the first.
[[nodiscard]] ExactNearest exact_nearest(const ExactSegment& first, const ExactSegment& second);
[[nodiscard]] ExactNearest exact_nearest(const Segment& first, const Segment& second, const Grid& grid);
[[nodiscard]] inline ExactNearest exact_nearest(const Vector3& c, const Segment& segment, const Grid& grid) {
  return exact_nearest(Segment{c, c}, segment, grid);
}
[[nodiscard]] ExactNearest exact_nearest(const DirectedSegment& segment, const Vector3& c, const Grid& grid);
/// The grid of a question.
[[nodiscard]] Grid grid_of(const Segment& first, const Segment& second, const Lengths& lengths);
[[nodiscard]] inline Grid grid_of(const Vector3& c, const Segment& segment, const Lengths& lengths) {
  return grid_of(Segment{c, c}, segment, lengths);
}
[[nodiscard]] Grid grid_of(const DirectedSegment& segment, const Vector3& c, const Lengths& lengths);
/// Across both of two directions, or across the one that is not 0, n being u x v: see compute_capsule_capsule.
[[nodiscard]] IntegerVector agreed_normal(const IntegerVector& n, const IntegerVector& along);

/// Whether a contact's cores are in the range of what follows, beside its lengths.
[[gnu::always_inline]] inline bool in_short_range(const Segment& segment) {
  return in_short_range(segment.start) && in_short_range(segment.end);
}
[[gnu::always_inline]] inline bool in_short_range(const DirectedSegment& segment) {
  return in_short_range(segment.start) && in_short_range(segment.direction) && in_short_range(segment.length);
}

/// The decisions in plain arithmetic, whatever the numbers are.
[[gnu::always_inline]] inline double reach_of(const Lengths& lengths) {
  return (lengths.radius1 + lengths.radius2) + lengths.alarm;
}
[[gnu::always_inline]] inline Filtered plain_filtered(const Vector3& c, const Segment& segment,
                                                      const Lengths& lengths) {
  const auto& [start, end] = segment;
  return plain_decision::filter_point_and_segment(c, start, plain_decision::way(start, end), reach_of(lengths));
}
[[gnu::always_inline]] inline Filtered plain_filtered(const DirectedSegment& segment, const Vector3& c,
                                                      const Lengths& lengths) {
  return plain_decision::filter_point_and_segment(
      c, segment.start, plain_decision::times(segment.length, segment.direction), reach_of(lengths));
}
[[gnu::always_inline]] inline Filtered plain_filtered(const Segment& first, const Segment& second,
                                                      const Lengths& lengths) {
  return plain_decision::filter_segments(first.start, first.end, second.start, second.end, reach_of(lengths));
}

// What follows computes to nearest, in numbers that are in_short_range. Errors are in units of u^2, as those of
// DoubleDoublePair; each total is rounded up for the factors (1 + u)^k left out, and for the rounding of the bound
// itself.

/// A number within `error` of high + low, |low| <= u |high|.
struct Bounded {
  DoubleDouble<double> x;
  double error;

  [[gnu::always_inline]] [[nodiscard]] bool surely_negative() const { return x.high + (x.low + error) < 0; }
  [[gnu::always_inline]] [[nodiscard]] bool surely_positive() const { return x.high + (x.low - error) > 0; }
};

/// b - a, exactly.
[[gnu::always_inline]] inline DoubleDoubles difference(const Vector3& b, const Vector3& a) {
  return {two_sum(b[0], -a[0]), two_sum(b[1], -a[1]), two_sum(b[2], -a[2])};
}

/// From the start of a segment to its end, exactly.
[[gnu::always_inline]] inline DoubleDoubles along(const Segment& segment) {
  return difference(segment.end, segment.start);
}
[[gnu::always_inline]] inline DoubleDoubles along(const DirectedSegment& segment) {
  const auto times = [&](double x) {
    const double product = segment.length * x;
    return DoubleDouble<double>{product, std::fma(segment.length, x, -product)};
  };
  return {times(segment.direction[0]), times(segment.direction[1]), times(segment.direction[2])};
}
[[gnu::always_inline]] inline bool is_point(const Segment& segment) { return segment.start == segment.end; }
[[gnu::always_inline]] inline bool is_point(const DirectedSegment& segment) { return segment.length == 0; }

/// |x| at least, and less than twice that.
[[gnu::always_inline]] inline double length_bound(const DoubleDoubles& x) {
  return (std::abs(x[0].high) + std::abs(x[1].high) + std::abs(x[2].high)) * (1 + 0x1p-50);
}

/// x.y. On each axis two products of a high and a low part and the residual, at most 3 u |x_i y_i|, are rounded twice
/// (2 + 3), and the product of the low parts is left out (1). The three residuals are added (3 + 3), the two low parts
/// of the highs' sum (2), and both (5): 19 of |x_1 y_1| + |x_2 y_2| + |x_3 y_3|, which is at most |x| |y|.
inline constexpr double kDotError = 20 * kUnitSquared;
[[gnu::always_inline]] inline DoubleDouble<double> dot(const DoubleDoubles& x, const DoubleDoubles& y) {
  std::array<double, 3> product;
  double residual = 0;
#pragma GCC unroll 3
  for (std::size_t i = 0; i < 3; ++i) {
    product[i] = x[i].high * y[i].high;
    residual +=
        std::fma(x[i].high, y[i].low, std::fma(x[i].low, y[i].high, std::fma(x[i].high, y[i].high, -product[i])));
  }
  const DoubleDouble<double> xy = two_sum(product[0], product[1]);
  const DoubleDouble<double> xyz = two_sum(xy.high, product[2]);
  return two_sum(xyz.high, (xy.low + xyz.low) + residual);
}

/// x / y within kQuotientError |x / y|. What is left of x, at most 3 u |x|, is built in two roundings (2 + 3), divided
/// by y.high instead of y (3), and the quotient is rounded (3).
inline constexpr double kQuotientError = 12 * kUnitSquared;
[[gnu::always_inline]] inline DoubleDouble<double> quotient(const DoubleDouble<double>& x,
                                                            const DoubleDouble<double>& y) {
  const double q = x.high / y.high;
  const double left = std::fma(-q, y.low, std::fma(-q, y.high, x.high) + x.low);
  return two_sum(q, left / y.high);
}

/// x y within kProductError |x y|: as an axis of a dot product, and the low part of the result is not rounded again.
inline constexpr double kProductError = 7 * kUnitSquared;
[[gnu::always_inline]] inline DoubleDouble<double> product(const DoubleDouble<double>& x,
                                                           const DoubleDouble<double>& y) {
  const double p = x.high * y.high;
  return two_sum(p, std::fma(x.high, y.low, std::fma(x.low, y.high, std::fma(x.high, y.high, -p))));
}

/// x + y within kSumError (|x| + |y|): two low parts are added (1), and to the highs' (2).
inline constexpr double kSumError = 4 * kUnitSquared;
[[gnu::always_inline]] inline DoubleDouble<double> sum(const DoubleDouble<double>& x, const DoubleDouble<double>& y) {
  const DoubleDouble<double> h = two_sum(x.high, y.high);
  return two_sum(h.high, h.low + (x.low + y.low));
}
[[gnu::always_inline]] inline DoubleDouble<double> negative(const DoubleDouble<double>& x) { return {-x.high, -x.low}; }

static_assert(kDotError >= proved::kSegmentDot && kQuotientError >= proved::kSegmentQuotient &&
              kProductError >= proved::kSegmentProduct && kSumError >= proved::kSegmentSum);

/// Where on a segment the nearest point to another core is.
enum class Place { start, within, end, open };

/// The nearest point q of a segment to a point c, and delta = q - c. With w = c - start, t = (w.u) / (u.u):
///   t      20 |w| |u| / A and 20 |t| of the dot products, 12 |t| of the quotient; |t| <= |w| / |u|    52 |w| / |u|
///   t u    at most |w|, also clamped: 7 of the product                                                7 |w|
///   q      52 |w| + 7 |w|, and the sum (4) of |t u| and |start|, at most |w| + |q|                    67 |w| + 4 |q|
///   delta  the sum (4) of t u and -w                                                                  67 |w|
struct Foot {
  DoubleDoubles point;
  DoubleDoubles delta;
  double error;  ///< of each coordinate, beside ApproximateNearest::kOwnError of the point's
  Place place;
  static constexpr double kError = 70 * kUnitSquared;
};

/// Domain: not a point.
template <class AnySegment>
[[gnu::always_inline]] inline Foot foot_on(const AnySegment& segment, const Vector3& c) {
  const DoubleDoubles u = along(segment);
  const DoubleDoubles w = difference(c, segment.start);
  DoubleDouble<double> t = quotient(dot(w, u), dot(u, u));
  const double most = length_bound(w);
  Foot foot{{}, {}, Foot::kError * most, Place::within};
  // The true t clamped lies no farther from t clamped than t from t.
  const double error =
      56 * kUnitSquared * most / std::max({std::abs(u[0].high), std::abs(u[1].high), std::abs(u[2].high)});
  const double beyond = (t.high - 1) + t.low;
  if (t.high + (t.low + error) < 0)
    foot.place = Place::start;
  else if (beyond - error > 0)
    foot.place = Place::end;
  else if (!(t.high + (t.low - error) > 0 && beyond + error < 0))
    foot.place = Place::open;
  if (t.high < 0) t = {0, 0};
  if (beyond > 0) t = {1, 0};
#pragma GCC unroll 3
  for (std::size_t i = 0; i < 3; ++i) {
    const DoubleDouble<double> way = product(t, u[i]);
    foot.point[i] = sum({segment.start[static_cast<Eigen::Index>(i)], 0}, way);
    foot.delta[i] = sum(way, negative(w[i]));
  }
  return foot;
}

[[gnu::always_inline]] inline DoubleDoubles exactly(const Vector3& c) { return {{{c[0], 0}, {c[1], 0}, {c[2], 0}}}; }
[[gnu::always_inline]] inline ApproximateNearest nearest_of(const Vector3& c, const Foot& foot) {
  return {exactly(c), foot.point, foot.delta, 0, foot.error, foot.error};
}
/// The nearest points of a point and a segment.
template <class AnySegment>
[[gnu::always_inline]] inline bool find_nearest(const Vector3& c, const AnySegment& segment,
                                                ApproximateNearest& nearest) {
  if (is_point(segment))
    nearest = {exactly(c), exactly(segment.start), difference(segment.start, c), 0, 0, 0};
  else
    nearest = nearest_of(c, foot_on(segment, c));
  return true;
}
[[gnu::always_inline]] inline ApproximateNearest turned_round(const ApproximateNearest& x) {
  return {x.q,       x.p,       {negative(x.delta[0]), negative(x.delta[1]), negative(x.delta[2])},
          x.q_error, x.p_error, x.delta_error};
}
[[gnu::always_inline]] inline bool find_nearest(const DirectedSegment& segment, const Vector3& c,
                                                ApproximateNearest& nearest) {
  find_nearest(c, segment, nearest);
  nearest = turned_round(nearest);
  return true;
}

/// The nearest points of two segments; false where the stage cannot tell which features face each other, or they are
/// nearly parallel. With k = A E / det, |s|, |t| <= 1 and |B| <= |u| |v|:
///   A E, B B     20 + 20 + 7 of the dot products and their product; their difference 4 of both     102 A E
///   C E, B F     the same of |u| |w| E each                                                        102 |u| |w| E
///   s            (102 |u| |w| E + 102 |s| A E) / det, and 12 |s| of the quotient
///   s u          104 k (|w| + |u|) + 12 |u|, and 7 |u| of the product                              123 k (|w| + |u|)
///   t v          the same                                                                          123 k (|w| + |v|)
///   delta        both, and sums (4) of |w|, |u| and |v|, twice        123 k (2 |w| + |u| + |v|) + 8 (|w| + |u| + |v|)
[[gnu::always_inline]] inline bool find_nearest(const Segment& first, const Segment& second,
                                                ApproximateNearest& nearest) {
  constexpr double kDeterminant = 104 * kUnitSquared;
  if (is_point(first)) return find_nearest(first.start, second, nearest);
  if (is_point(second)) {
    nearest = turned_round(nearest_of(second.start, foot_on(first, second.start)));
    return true;
  }
  const DoubleDoubles u = along(first);
  const DoubleDoubles v = along(second);
  const DoubleDoubles w = difference(second.start, first.start);
  const DoubleDouble<double> A = dot(u, u);
  const DoubleDouble<double> B = dot(u, v);
  const DoubleDouble<double> E = dot(v, v);
  const DoubleDouble<double> C = dot(u, w);
  const DoubleDouble<double> F = dot(v, w);
  const double AE = A.high * E.high;
  const DoubleDouble<double> det = sum(product(A, E), negative(product(B, B)));
  if (!(det.high > AE * 0x1p-30)) return false;
  const double lu = length_bound(u);
  const double lv = length_bound(v);
  const double lw = length_bound(w);
  const double det_error = kDeterminant * AE;

  // s of the lines as numerator / det, and which end of the first segment it leaves by.
  const auto place = [&](const Bounded& numerator) {
    const Bounded beyond{sum(numerator.x, negative(det)), numerator.error + det_error + 8 * kUnitSquared * det.high};
    if (numerator.surely_negative()) return Place::start;
    if (beyond.surely_positive()) return Place::end;
    return numerator.surely_positive() && beyond.surely_negative() ? Place::within : Place::open;
  };
  const auto ended = [](const Segment& segment, Place at) { return at == Place::start ? segment.start : segment.end; };
  const auto at_end_of_second = [&](Place t) {
    const Vector3 c = ended(second, t);
    nearest = turned_round(nearest_of(c, foot_on(first, c)));
    return true;
  };
  const Bounded s{sum(product(C, E), negative(product(B, F))), kDeterminant * (lu * lw) * E.high};
  const Place at_s = place(s);
  if (at_s == Place::open) return false;
  if (at_s != Place::within) {
    const Vector3 c = ended(first, at_s);
    const Foot foot = foot_on(second, c);
    if (foot.place == Place::open) return false;
    if (foot.place != Place::within) return at_end_of_second(foot.place);
    nearest = nearest_of(c, foot);
    return true;
  }
  const Bounded t{sum(product(B, C), negative(product(A, F))), kDeterminant * (lv * lw) * A.high};
  const Place at_t = place(t);
  if (at_t == Place::open) return false;
  if (at_t != Place::within) return at_end_of_second(at_t);

  const double k = AE / det.high * (1 + 0x1p-40);
  nearest.p_error = 125 * kUnitSquared * k * (lw + lu);
  nearest.q_error = 125 * kUnitSquared * k * (lw + lv);
  nearest.delta_error = nearest.p_error + nearest.q_error + 9 * kUnitSquared * (lw + lu + lv);
  const DoubleDouble<double> s_ = quotient(s.x, det);
  const DoubleDouble<double> t_ = quotient(t.x, det);
#pragma GCC unroll 3
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    const DoubleDouble<double> along1 = product(s_, u[i]);
    const DoubleDouble<double> along2 = product(t_, v[i]);
    nearest.p[i] = sum({first.start[axis], 0}, along1);
    nearest.q[i] = sum({second.start[axis], 0}, along2);
    nearest.delta[i] = sum(sum(w[i], along2), negative(along1));
  }
  // What the sums of p and q lose is 4 of |s u| and |a|, together at most 2 |u| + |p|.
  nearest.p_error += 9 * kUnitSquared * lu;
  nearest.q_error += 9 * kUnitSquared * lv;
  return true;
}

}  // namespace contact::kernel
