// Where a segment crosses a triangle, and the contact there, in integers.
#include "kernel/crossing_cores.hpp"

namespace contact::kernel {
namespace {

const IntegerVector kOrigin{0, 0, 0};

ExactCrossing crossing_of(const ExactSegment& segment, const Corners& triangle, const Grid& grid) {
  std::array<IntegerVector, 3> w;
  for (std::size_t k = 0; k < 3; ++k) w[k] = on_grid(grid, triangle.vertices[k]) - segment.start;
  const IntegerVector n = cross(w[1] - w[0], w[2] - w[0]);
  const Integer through = dot(n, segment.along);
  const Integer over = through < 0 ? Integer(-through) : through;
  const int sign = through.sign();
  const Integer part = sign * dot(n, w[0]);
  bool crosses = sign != 0 && part >= 0 && part <= over;
  for (std::size_t k = 0; crosses && k < 3; ++k)
    crosses = sign * dot(segment.along, cross(w[k], w[kNextVertex[k]])) >= 0;
  if (!crosses) return {kOrigin, 0, n};
  return {combined(over, segment.start, part, segment.along), over, n};
}

}  // namespace

Grid grid_of(const Corners& triangle, const Segment& segment, const Lengths& lengths) {
  const auto& [x, y, z] = triangle.vertices;
  const auto& [a, b] = segment;
  return Grid{x[0], x[1], x[2], y[0], y[1], y[2], z[0], z[1], z[2], a[0], a[1], a[2], b[0], b[1], b[2], lengths.alarm};
}
Grid grid_of(const DirectedSegment& segment, const Corners& triangle, const Lengths& lengths) {
  const auto& [x, y, z] = triangle.vertices;
  const Vector3& a = segment.start;
  const Vector3& d = segment.direction;
  return Grid({x[0], x[1], x[2], y[0], y[1], y[2], z[0], z[1], z[2], a[0], a[1], a[2], lengths.alarm},
              Grid{segment.length}, Grid{d[0], d[1], d[2]});
}

ExactCrossing exact_nearest(const Corners& triangle, const Segment& segment, const Grid& grid) {
  const IntegerVector start = on_grid(grid, segment.start);
  return crossing_of({start, on_grid(grid, segment.end) - start}, triangle, grid);
}
ExactCrossing exact_nearest(const DirectedSegment& segment, const Corners& triangle, const Grid& grid) {
  IntegerVector along;
  for (std::size_t i = 0; i < 3; ++i)
    along[i] = grid.product(segment.length, segment.direction[static_cast<Eigen::Index>(i)]);
  ExactCrossing crossing = crossing_of({on_grid(grid, segment.start), along}, triangle, grid);
  crossing.normal = kOrigin - crossing.normal;
  return crossing;
}

bool is_hit(const ExactCrossing& crossing, const Grid& /*grid*/, const Lengths& /*lengths*/) {
  return !crossing.over.is_zero();
}

void round_exactly(const ExactCrossing& crossing, const Grid& grid, const Lengths& /*lengths*/,
                   ContactPoints /*points*/, unsigned numbers, Contact& contact) {
  const IntegerVector& n = crossing.normal;
  const Integer N = dot(n, n);
  contact.degenerate = false;
  contact.unique = true;
  for (unsigned i = 0; i < 3; ++i) {
    if (numbers >> i & 1) contact.normal[i] = round_sum(0, n[i], N, 0);
    const auto point = [&] { return round_sum(crossing.x[i], 0, 1, grid.exponent(), crossing.over); };
    if (numbers >> (kPointNumber + i) & 1) contact.point1[i] = point();
    if (numbers >> (2 * kPointNumber + i) & 1) contact.point2[i] = point();
  }
  if (numbers >> kValueNumber & 1) contact.value = 0;
}

}  // namespace contact::kernel
