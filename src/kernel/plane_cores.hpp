// The lowest point of a point or a segment over a plane: exactly, and in double-double arithmetic.
//
//   n the plane's normal, of any length     o its offset     h(x) = n.x - o     N = n.n
//   p the end with the lower h, or the middle between two with the same         s = h(p) / sqrt(N)
//   normal -n / sqrt(N)     point1 p - r n / sqrt(N)     point2 p - h(p) n / N  value s - r - contact
// s is signed, and n is not 0, so that nothing is degenerate and nothing grows near s = 0.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "kernel/cores_double_double.hpp"
#include "kernel/segment_cores.hpp"

namespace contact::kernel {

/// A Plane, as a core.
struct HalfSpace {
  Vector3 normal;
  double offset;
};

/// The grids of a question: of points and lengths, and of the normal. The offset is on the grid of their products.
struct PlaneGrids {
  Grid points;
  Grid normal;
};
[[nodiscard]] PlaneGrids grid_of(const Segment& segment, const HalfSpace& plane, const Lengths& lengths);
[[nodiscard]] inline PlaneGrids grid_of(const Vector3& c, const HalfSpace& plane, const Lengths& lengths) {
  return grid_of(Segment{c, c}, plane, lengths);
}

/// The lowest point p / over of a core, on the grid of points, and h(p) = height / over, on that of the products.
struct ExactLowest {
  IntegerVector p;
  Integer over;  ///< 1, or 2 in the middle
  bool unique;
  IntegerVector n;
  Integer height;
};
[[nodiscard]] ExactLowest exact_nearest(const Segment& segment, const HalfSpace& plane, const PlaneGrids& grids);
[[nodiscard]] inline ExactLowest exact_nearest(const Vector3& c, const HalfSpace& plane, const PlaneGrids& grids) {
  return exact_nearest(Segment{c, c}, plane, grids);
}

/// s <= alarm + radius1.
[[nodiscard]] bool is_hit(const ExactLowest& lowest, const PlaneGrids& grids, const Lengths& lengths);
/// The contact, every number rounded once to nearest, as round_exactly of cores.hpp has it.
void round_exactly(const ExactLowest& lowest, const PlaneGrids& grids, const Lengths& lengths, ContactPoints points,
                   unsigned numbers, Contact& contact);

[[gnu::always_inline]] inline bool in_short_range(const HalfSpace& plane) {
  return in_short_range(plane.normal) && in_short_range(plane.offset);
}

[[gnu::always_inline]] inline Filtered plain_filtered(const Vector3& c, const HalfSpace& plane,
                                                      const Lengths& lengths) {
  return plain_decision::filter_point_and_plane(c, plane.normal, plane.offset, reach_of(lengths));
}
[[gnu::always_inline]] inline Filtered plain_filtered(const Segment& segment, const HalfSpace& plane,
                                                      const Lengths& lengths) {
  return plain_decision::filter_segment_and_plane(segment.start, segment.end, plane.normal, plane.offset,
                                                  reach_of(lengths));
}

// What follows computes to nearest, in numbers that are in_short_range. Errors are in units of u^2, as in segment_cores.hpp.

/// The lowest point, exactly, and h of it.
struct ApproximateLowest {
  DoubleDoubles p;
  bool unique;
  HalfSpace plane;
  Bounded height;
};

/// h. The residuals of three products, together at most u T, are added (2), the low parts of three sums, at most u T
/// each (2 + 3), and both (4): 11 T.
inline constexpr double kHeightError = 12 * kUnitSquared;
static_assert(kHeightError >= proved::kPlaneHeight);
[[gnu::always_inline]] inline Bounded height_of(const Vector3& c, const HalfSpace& plane) {
  std::array<double, 3> product;
  double residual = 0;
  double T = std::abs(plane.offset);
#pragma GCC unroll 3
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    product[i] = plane.normal[axis] * c[axis];
    residual += std::fma(plane.normal[axis], c[axis], -product[i]);
    T += std::abs(product[i]);
  }
  const DoubleDouble<double> xy = two_sum(product[0], product[1]);
  const DoubleDouble<double> xyz = two_sum(xy.high, product[2]);
  const DoubleDouble<double> h = two_sum(xyz.high, -plane.offset);
  return {two_sum(h.high, ((xy.low + xyz.low) + h.low) + residual), kHeightError * T};
}

[[gnu::always_inline]] inline bool find_nearest(const Vector3& c, const HalfSpace& plane, ApproximateLowest& lowest) {
  lowest = {exactly(c), true, plane, height_of(c, plane)};
  return true;
}
/// False where it is not certain which end is lower, unless each product of the normal and the way between them is 0.
[[gnu::always_inline]] inline bool find_nearest(const Segment& segment, const HalfSpace& plane,
                                                ApproximateLowest& lowest) {
  const auto& [start, end] = segment;
  const DoubleDoubles u = along(segment);
  double size = 0;
#pragma GCC unroll 3
  for (std::size_t i = 0; i < 3; ++i) size += std::abs(plane.normal[static_cast<Eigen::Index>(i)] * u[i].high);
  if (size == 0) {
    lowest = {exactly(start), is_point(segment), plane, height_of(start, plane)};
    if (lowest.unique) return true;
#pragma GCC unroll 3
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      lowest.p[i] = two_sum(0.5 * start[axis], 0.5 * end[axis]);
    }
    return true;
  }
  const Bounded rise{dot(u, exactly(plane.normal)), kDotError * size};
  if (rise.surely_positive()) return find_nearest(start, plane, lowest);
  return rise.surely_negative() && find_nearest(end, plane, lowest);
}

/// The contact with a plane. With m = n / sqrt(N), of which DoubleDoublePair says the errors, and the error e of h:
///   s       e / sqrt(N), 13 |s| of sqrt(N) and 12 |s| of the quotient                e / sqrt(N) + 25 |s|
///   value   that; two low parts, at most |s| and |t|, are added (1 + 1), and to the sum of the highs (1 + 1, and 1 of
///           that sum h), and rounded() rounds once more                              28 |s| + 3 |t| + 2 |h|
///   point1  as ApproximateContact has it, p being exact
///   point2  w = s m: 28 |w| of m and 7 of the product; the sum (4) of |p| and |w|; rounded() (1)
///                                                          39 |w| + 4 |p| + 1 |q| and the error of s times |m|
/// Over a floor or beside a wall, a normal of length 1 along an axis, h, s, m and r m are exact, and ties are frequent:
/// a number that two exact ones add up to has no error.
class ApproximateOverPlane {
 public:
  /// Domain: in_short_range of all numbers of the question, to nearest.
  [[gnu::always_inline]] ApproximateOverPlane(const ApproximateLowest& lowest, const Lengths& lengths)
      : lowest_(lowest),
        lengths_(lengths),
        unit_(*DoubleDoublePair::of(exactly(lowest.plane.normal), DoubleDouble<double>{0, 0})),
        is_along_axis_(is_unit_axis(lowest.plane.normal)),
        s_(is_along_axis_ ? lowest.height.x : quotient(lowest.height.x, unit_.root())),
        s_error_(is_along_axis_ ? 0
                                : (lowest.height.error / unit_.root().high) * (1 + 0x1p-50) +
                                      26 * kUnitSquared * std::abs(s_.high)) {}

  [[nodiscard]] static constexpr bool holds() { return true; }
  [[nodiscard]] bool is_unique() const { return lowest_.unique; }

  [[gnu::always_inline]] [[nodiscard]] Filtered filtered(double alarm) const {
    const Approximation gap = less(two_sum(lengths_.radius1, alarm));
    if (gap.high + (gap.low - gap.error) > 0) return Filtered::miss;
    if (gap.high + (gap.low + gap.error) < 0) return Filtered::hit;
    return Filtered::undecided;
  }
  [[gnu::always_inline]] [[nodiscard]] Approximation normal(std::size_t axis) const {
    const auto& m = unit_.normal_parts(axis);
    return {-m.high, -m.low, DoubleDoublePair::kNormalError * std::abs(m.high)};
  }
  [[gnu::always_inline]] [[nodiscard]] Approximation point1(std::size_t axis, double signed_radius) const {
    if (is_level(axis)) return {lowest_.p[axis].high, lowest_.p[axis].low, 0};
    Approximation x = point_beside(lowest_.p[axis], 0, unit_.normal_parts(axis), -signed_radius, 0);
    if (is_along_axis_ && lowest_.p[axis].low == 0) x.error = 0;
    return x;
  }
  [[gnu::always_inline]] [[nodiscard]] Approximation point2(std::size_t axis, double /*signed_radius*/) const {
    if (is_level(axis)) return {lowest_.p[axis].high, lowest_.p[axis].low, 0};
    const auto& m = unit_.normal_parts(axis);
    const auto i = static_cast<Eigen::Index>(axis);
    const auto& [n, offset] = lowest_.plane;
    // Along an axis the foot has a coordinate of its own, which may be 0.
    if (n[(i + 1) % 3] == 0 && n[(i + 2) % 3] == 0) {
      const double x = offset / n[i];
      return {x, std::fma(-x, n[i], offset) / n[i], 2 * kUnitSquared * std::abs(x)};
    }
    const DoubleDouble<double> w = product(s_, m);
    const DoubleDouble<double> q = sum(lowest_.p[axis], negative(w));
    return {q.high, q.low,
            (41 * kUnitSquared * std::abs(w.high) + 5 * kUnitSquared * std::abs(lowest_.p[axis].high)) +
                (2 * kUnitSquared * std::abs(q.high) + s_error_ * std::abs(m.high) * (1 + 0x1p-50))};
  }
  [[gnu::always_inline]] [[nodiscard]] Approximation value() const {
    return less(two_sum(lengths_.radius1, lengths_.contact));
  }

 private:
  /// Whether the plane goes along an axis: then both points have the coordinate of p there, half way between two
  /// numbers or not.
  [[gnu::always_inline]] [[nodiscard]] bool is_level(std::size_t axis) const {
    return lowest_.plane.normal[static_cast<Eigen::Index>(axis)] == 0;
  }
  [[gnu::always_inline]] [[nodiscard]] static bool is_unit_axis(const Vector3& n) {
    const Vector3 sizes(std::abs(n[0]), std::abs(n[1]), std::abs(n[2]));
    const auto is_bit = [](double x) { return x == 0 || x == 1; };
    return is_bit(sizes[0]) && is_bit(sizes[1]) && is_bit(sizes[2]) && sizes[0] + sizes[1] + sizes[2] == 1;
  }
  /// s - t.
  [[gnu::always_inline]] [[nodiscard]] Approximation less(const DoubleDouble<double>& t) const {
    const DoubleDouble<double> h = two_sum(s_.high, -t.high);
    if (is_along_axis_ && s_.low == 0 && t.low == 0) return {h.high, h.low, 0};
    return {h.high, h.low + (s_.low - t.low),
            (s_error_ + 4 * kUnitSquared * std::abs(s_.high)) +
                (4 * kUnitSquared * t.high + DoubleDoublePair::kLastSumError * std::abs(h.high))};
  }

  const ApproximateLowest& lowest_;
  const Lengths& lengths_;
  DoubleDoublePair unit_;
  bool is_along_axis_;
  DoubleDouble<double> s_;
  double s_error_;
};

template <class First>
struct FastStage<First, HalfSpace> {
  using Nearest = ApproximateLowest;
  using OfContact = ApproximateOverPlane;
};

}  // namespace contact::kernel
