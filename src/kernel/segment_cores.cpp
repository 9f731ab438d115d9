// The nearest points of two segments in integers: the foot on the one line, clamped, and from there on the other.
#include "kernel/segment_cores.hpp"

#include <algorithm>

namespace contact::kernel {
namespace {

/// s = s / over, t = t / over.
struct Parameters {
  Integer s;
  Integer t;
  Integer over;
  bool unique = true;
};

Integer clamped(const Integer& x, const Integer& most) { return std::clamp(x, Integer(0), most); }

/// Two directions that are parallel, neither of them 0: s of the second's ends is C / A and (C + B) / A.
Parameters of_parallel(const Integer& A, const Integer& B, const Integer& E, const Integer& C, const Integer& F) {
  const Integer ends[2] = {C, C + B};
  const int low = ends[0] < ends[1] ? 0 : 1;
  // Beyond an end two ends face each other.
  if (ends[1 - low] < 0) return {0, 1 - low, 1};
  if (ends[low] > A) return {1, low, 1};
  const Integer from = std::max(Integer(0), ends[low]);
  const Integer to = std::min(A, ends[1 - low]);
  const Integer both = from + to;  // the middle is both / (2 A)
  return {both * E, both * B - 2 * A * F, 2 * A * E, from == to};
}

Parameters parameters(const IntegerVector& u, const IntegerVector& v, const IntegerVector& w) {
  const Integer A = dot(u, u);
  const Integer E = dot(v, v);
  const Integer C = dot(u, w);
  const Integer F = dot(v, w);
  if (E.is_zero()) return A.is_zero() ? Parameters{0, 0, 1} : Parameters{clamped(C, A), 0, A};
  if (A.is_zero()) return {0, clamped(-F, E), E};
  const Integer B = dot(u, v);
  const Integer det = A * E - B * B;
  if (det.is_zero()) return of_parallel(A, B, E, C, F);

  // s on its line, clamped; t from it. Where t leaves its segment, s from the end that it leaves by.
  const Integer free = C * E - B * F;
  const Integer s = clamped(free, det);
  const Integer t = s == free ? Integer(B * C - A * F) : Integer(B * s - F * det);
  const Integer over = s == free ? det : Integer(E * det);
  if (t < 0) return {clamped(C, A), 0, A};
  if (t > over) return {clamped(B + C, A), A, A};
  return {s == free ? s : Integer(s * E), t, over};
}

const IntegerVector kZero{0, 0, 0};

}  // namespace

IntegerVector agreed_normal(const IntegerVector& n, const IntegerVector& along) {
  if (n != kZero) {
    const auto first = std::find_if(n.begin(), n.end(), [](const Integer& x) { return !x.is_zero(); });
    return *first < 0 ? kZero - n : n;
  }
  if (along == kZero) return {1, 0, 0};
  // The first axis that is not along it, made perpendicular.
  const std::size_t axis = along[1].is_zero() && along[2].is_zero() ? 1 : 0;
  IntegerVector unit = kZero;
  unit[axis] = 1;
  return combined(dot(along, along), unit, -along[axis], along);
}

Grid grid_of(const Segment& first, const Segment& second, const Lengths& lengths) {
  const auto& [a, b] = first;
  const auto& [c, d] = second;
  return Grid{a[0],
              a[1],
              a[2],
              b[0],
              b[1],
              b[2],
              c[0],
              c[1],
              c[2],
              d[0],
              d[1],
              d[2],
              lengths.radius1,
              lengths.radius2,
              lengths.alarm,
              lengths.contact};
}

Grid grid_of(const DirectedSegment& segment, const Vector3& c, const Lengths& lengths) {
  const auto& [start, direction, length] = segment;
  return {{start[0], start[1], start[2], c[0], c[1], c[2], lengths.radius1, lengths.radius2, lengths.alarm,
           lengths.contact},
          Grid{direction[0], direction[1], direction[2]},
          Grid{length}};
}

ExactNearest exact_nearest(const ExactSegment& first, const ExactSegment& second) {
  const auto& [a, u] = first;
  const auto& [b, v] = second;
  const Parameters at = parameters(u, v, b - a);
  ExactNearest nearest{combined(at.over, a, at.s, u), combined(at.over, b, at.t, v), at.over, at.unique, {}};
  if (nearest.p == nearest.q) nearest.agreed = agreed_normal(cross(u, v), u == kZero ? v : u);
  return nearest;
}

ExactNearest exact_nearest(const Segment& first, const Segment& second, const Grid& grid) {
  const IntegerVector a = on_grid(grid, first.start);
  const IntegerVector b = on_grid(grid, second.start);
  return exact_nearest(ExactSegment{a, on_grid(grid, first.end) - a}, ExactSegment{b, on_grid(grid, second.end) - b});
}

ExactNearest exact_nearest(const DirectedSegment& segment, const Vector3& c, const Grid& grid) {
  const auto along = [&](Eigen::Index axis) { return grid.product(segment.length, segment.direction[axis]); };
  return exact_nearest(ExactSegment{on_grid(grid, segment.start), {along(0), along(1), along(2)}},
                       ExactSegment{on_grid(grid, c), kZero});
}

}  // namespace contact::kernel
