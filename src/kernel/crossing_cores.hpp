// Where a segment crosses a triangle: exactly, and in double-double arithmetic.
//
//   a the segment's start     d from there to its end     w_k = v_k - a     n = (v_1 - v_0) x (v_2 - v_0)
//   e_k = d.(w_k x w_(k+1)), whose sum is n.d     X = a + (n.w_0 / n.d) d
// The segment crosses the triangle where n.d is not 0, no e_k has the other sign than it, and 0 <= n.w_0 / n.d <= 1.
#pragma once

#include <array>
#include <cmath>

#include "kernel/cores_double_double.hpp"
#include "kernel/triangle_cores.hpp"

namespace contact::kernel {

/// The grid of a question.
[[nodiscard]] Grid grid_of(const Corners& triangle, const Segment& segment, const Lengths& lengths);
[[nodiscard]] Grid grid_of(const DirectedSegment& segment, const Corners& triangle, const Lengths& lengths);

/// X = x / over on a grid, over > 0; 0 where there is none.
struct ExactCrossing {
  IntegerVector x;
  Integer over;
  IntegerVector normal;  ///< of the contact, of any length
};
[[nodiscard]] ExactCrossing exact_nearest(const Corners& triangle, const Segment& segment, const Grid& grid);
[[nodiscard]] ExactCrossing exact_nearest(const DirectedSegment& segment, const Corners& triangle, const Grid& grid);

/// Whether there is a crossing.
[[nodiscard]] bool is_hit(const ExactCrossing& crossing, const Grid& grid, const Lengths& lengths);
/// The contact, every number rounded once to nearest, as round_exactly of cores.hpp has it.
void round_exactly(const ExactCrossing& crossing, const Grid& grid, const Lengths& lengths, ContactPoints points,
                   unsigned numbers, Contact& contact);

[[gnu::always_inline]] inline Filtered plain_filtered(const Corners& triangle, const Segment& segment,
                                                      const Lengths& /*lengths*/) {
  const auto& [start, end] = segment;
  return plain_decision::filter_crossing(start, plain_decision::way(start, end), triangle.vertices);
}
[[gnu::always_inline]] inline Filtered plain_filtered(const DirectedSegment& segment, const Corners& triangle,
                                                      const Lengths& /*lengths*/) {
  return plain_decision::filter_crossing(segment.start, plain_decision::times(segment.length, segment.direction),
                                         triangle.vertices);
}

// What follows computes to nearest, in numbers that are in_short_range. Errors are in units of u^2, as in segment_cores.hpp.

/// X of a segment that surely crosses, or nearly, and n with the sign of the contact's normal.
struct ApproximateCrossing {
  std::array<Approximation, 3> x;
  DoubleDoubles n;
  double n_error;               ///< of a component
  std::array<bool, 3> is_flat;  ///< the component is 0 exactly
};

/// False where the segment is nearly parallel to the plane. With S = |u| |v| and k = S / |n.d|:
///   n     16 S its length, 11 S a component
///   n.w   36 S |w_0|, and 36 S |d| of n.d, as foot_on_face has them
///   t     36 k |w_0|, |t| 36 k |d| and 12 |t| of the quotient; |t| <= 1            36 k (|w_0| + |d|) + 12
///   X     that and 7 of the product, of |d_i|; the sum (4) of |a_i| and |t d_i|; rounded() (1)
///                                                              (36 k (|w_0| + |d|) + 24) |d_i| + 4 |a_i| + 1 |x_i|
template <class AnySegment>
[[gnu::always_inline]] inline bool find_crossing(const AnySegment& segment, const Corners& triangle, bool turned,
                                                 ApproximateCrossing& crossing) {
  const auto& v = triangle.vertices;
  const DoubleDoubles d = along(segment);
  const DoubleDoubles u = difference(v[1], v[0]);
  const DoubleDoubles t = difference(v[2], v[0]);
  const DoubleDoubles w = difference(v[0], segment.start);
  const DoubleDoubles n = cross(u, t);
  const DoubleDouble<double> through = dot(n, d);
  const double S = length_bound(u) * length_bound(t);
  const double size = length_bound(d);
  if (!(std::abs(through.high) > S * size * 0x1p-40)) return false;
  const DoubleDouble<double> part = quotient(dot(n, w), through);
  const double k = S / std::abs(through.high) * (1 + 0x1p-40);
  const double part_error = 37 * k * (length_bound(w) + size) + 25;
#pragma GCC unroll 3
  for (std::size_t i = 0; i < 3; ++i) {
    const double a = segment.start[static_cast<Eigen::Index>(i)];
    const DoubleDouble<double> x = sum({a, 0}, product(part, d[i]));
    // Along a plane of an axis the coordinate is the start's.
    const bool stays = d[i].high == 0;
    crossing.x[i] = {
        x.high, x.low,
        stays ? 0 : kUnitSquared * ((part_error * std::abs(d[i].high) + 5 * std::abs(a)) + 2 * std::abs(x.high))};
    const auto is_zero = [](const DoubleDouble<double>& y, const DoubleDouble<double>& z) {
      return y.high == 0 || z.high == 0;
    };
    const std::size_t j = kNextVertex[i];
    const std::size_t l = kNextVertex[j];
    crossing.is_flat[i] = is_zero(u[j], t[l]) && is_zero(u[l], t[j]);
    crossing.n[i] = turned ? negative(n[i]) : n[i];
  }
  crossing.n_error = 12 * kUnitSquared * S;
  return true;
}
[[gnu::always_inline]] inline bool find_nearest(const Corners& triangle, const Segment& segment,
                                                ApproximateCrossing& crossing) {
  return find_crossing(segment, triangle, false, crossing);
}
[[gnu::always_inline]] inline bool find_nearest(const DirectedSegment& segment, const Corners& triangle,
                                                ApproximateCrossing& crossing) {
  return find_crossing(segment, triangle, true, crossing);
}

/// The contact of a crossing. The length of n is off by 2 e at most, e the error of its components, and each component
/// of the normal by 2 e / |n|, as ApproximateContact has it.
class ApproximateContactOfCrossing {
 public:
  /// n is not 0: find_crossing has looked at n.d.
  [[gnu::always_inline]] ApproximateContactOfCrossing(const ApproximateCrossing& crossing, const Lengths& /*lengths*/)
      : crossing_(crossing),
        unit_(*DoubleDoublePair::of(crossing.n, DoubleDouble<double>{0, 0})),
        turn_(2 * crossing.n_error / unit_.root().high * (1 + 0x1p-40)) {}
  [[nodiscard]] static constexpr bool holds() { return true; }
  [[nodiscard]] static constexpr bool is_unique() { return true; }
  /// The filter's signs were not certain, and these are not more so.
  [[nodiscard]] static constexpr Filtered filtered(double /*alarm*/) { return Filtered::undecided; }

  [[gnu::always_inline]] [[nodiscard]] Approximation normal(std::size_t axis) const {
    if (crossing_.is_flat[axis]) return {0, 0, 0};
    const auto& m = unit_.normal_parts(axis);
    return {m.high, m.low, DoubleDoublePair::kNormalError * std::abs(m.high) + turn_};
  }
  [[gnu::always_inline]] [[nodiscard]] Approximation point1(std::size_t axis, double /*signed_radius*/) const {
    return crossing_.x[axis];
  }
  [[gnu::always_inline]] [[nodiscard]] Approximation point2(std::size_t axis, double /*signed_radius*/) const {
    return crossing_.x[axis];
  }
  [[nodiscard]] static constexpr Approximation value() { return {0, 0, 0}; }

 private:
  const ApproximateCrossing& crossing_;
  DoubleDoublePair unit_;
  double turn_;
};

template <>
struct FastStage<Corners, Segment> {
  using Nearest = ApproximateCrossing;
  using OfContact = ApproximateContactOfCrossing;
};
template <>
struct FastStage<DirectedSegment, Corners> {
  using Nearest = ApproximateCrossing;
  using OfContact = ApproximateContactOfCrossing;
};

}  // namespace contact::kernel
