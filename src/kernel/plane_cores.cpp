// The lowest point of a point or a segment over a plane, and its contact, in integers.
#include "kernel/plane_cores.hpp"

#include <limits>

namespace contact::kernel {

PlaneGrids grid_of(const Segment& segment, const HalfSpace& plane, const Lengths& lengths) {
  const auto& [a, b] = segment;
  const Grid normal{plane.normal[0], plane.normal[1], plane.normal[2]};
  return {Grid({a[0], a[1], a[2], b[0], b[1], b[2], lengths.radius1, lengths.alarm, lengths.contact},
               Grid{plane.offset}.exponent() - normal.exponent()),
          normal};
}

ExactLowest exact_nearest(const Segment& segment, const HalfSpace& plane, const PlaneGrids& grids) {
  const IntegerVector start = on_grid(grids.points, segment.start);
  const IntegerVector end = on_grid(grids.points, segment.end);
  const IntegerVector n = on_grid(grids.normal, plane.normal);
  const int rise = dot(n, end - start).sign();
  const bool unique = rise != 0 || start == end;
  ExactLowest lowest{rise < 0 ? end : start, unique ? 1 : 2, unique, n, 0};
  if (!unique) lowest.p = combined(1, start, 1, end);
  const Grid of_offset{plane.offset};
  const int finer = of_offset.exponent() - (grids.points.exponent() + grids.normal.exponent());
  const Integer offset = of_offset(plane.offset) << static_cast<unsigned>(finer);
  lowest.height = dot(n, lowest.p) - lowest.over * offset;
  return lowest;
}

bool is_hit(const ExactLowest& lowest, const PlaneGrids& grids, const Lengths& lengths) {
  if (lowest.height.sign() <= 0 || lengths.alarm == std::numeric_limits<double>::infinity()) return true;
  const Integer reach = (grids.points(lengths.alarm) + grids.points(lengths.radius1)) * lowest.over;
  return lowest.height * lowest.height <= reach * reach * dot(lowest.n, lowest.n);
}

void round_exactly(const ExactLowest& lowest, const PlaneGrids& grids, const Lengths& lengths, ContactPoints points,
                   unsigned numbers, Contact& contact) {
  const auto& [p, over, unique, n, height] = lowest;
  const Grid& grid = grids.points;
  const Integer N = dot(n, n);
  contact.degenerate = false;
  contact.unique = unique;
  const Integer out = grid(sign_of(points.first, 1) * lengths.radius1) * over;
  for (unsigned i = 0; i < 3; ++i) {
    if (numbers >> i & 1) contact.normal[i] = round_sum(0, -n[i], N, 0);
    if (numbers >> (kPointNumber + i) & 1) contact.point1[i] = round_sum(p[i], -out * n[i], N, grid.exponent(), over);
    if (numbers >> (2 * kPointNumber + i) & 1)
      contact.point2[i] = round_sum(p[i] * N - height * n[i], 0, 1, grid.exponent(), over * N);
  }
  if (numbers >> kValueNumber & 1) {
    const Integer less = grid(lengths.radius1) + grid(lengths.contact);
    contact.value = round_sum(-less * over, height, N, grid.exponent(), over);
  }
}

}  // namespace contact::kernel
