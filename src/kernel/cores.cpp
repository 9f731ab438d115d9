// The contact of two cores with known nearest points, in integers.
#include "kernel/cores.hpp"

#include <algorithm>
#include <limits>

#include "kernel/sphere_sphere_numbers.hpp"

namespace contact::kernel {

IntegerVector operator-(const IntegerVector& a, const IntegerVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Integer dot(const IntegerVector& a, const IntegerVector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

IntegerVector cross(const IntegerVector& a, const IntegerVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

IntegerVector combined(const Integer& a, const IntegerVector& x, const Integer& b, const IntegerVector& y) {
  return {a * x[0] + b * y[0], a * x[1] + b * y[1], a * x[2] + b * y[2]};
}

IntegerVector on_grid(const Grid& grid, const Vector3& v) { return {grid(v[0]), grid(v[1]), grid(v[2])}; }

bool is_preferred(const IntegerVector& n, const IntegerVector& to) {
  const auto size = [](const IntegerVector& v) { return Integer(abs(v[0]) + abs(v[1]) + abs(v[2])); };
  const Integer of_n = size(n);
  const Integer of_other = size(to);
  for (std::size_t i = 0; i < 3; ++i)
    if (const int order = Integer(n[i] * of_other).compare(to[i] * of_n)) return order > 0;
  return false;
}

bool is_hit(const ExactNearest& nearest, const Grid& grid, const Lengths& lengths) {
  if (lengths.alarm == std::numeric_limits<double>::infinity()) return true;  // no number of a grid
  const IntegerVector delta = nearest.q - nearest.p;
  const Integer reach = (grid(lengths.alarm) + grid(lengths.radius1) + grid(lengths.radius2)) * nearest.over;
  return dot(delta, delta) <= reach * reach;
}

void round_exactly(const ExactNearest& nearest, const Grid& grid, const Lengths& lengths, ContactPoints points,
                   unsigned numbers, Contact& contact) {
  const IntegerVector delta = nearest.q - nearest.p;
  const Integer D = dot(delta, delta);
  contact.degenerate = D.is_zero();
  contact.unique = nearest.unique;
  // The normal is along / |along|.
  const IntegerVector along = contact.degenerate ? nearest.agreed : nearest.overlap ? nearest.p - nearest.q : delta;
  const Integer length2 = contact.degenerate ? dot(along, along) : D;
  // sign radius over: what the normal is multiplied by in a point's numerator.
  const Integer out1 = grid(sign_of(points.first, 1) * lengths.radius1) * nearest.over;
  const Integer out2 = grid(sign_of(points.second, -1) * lengths.radius2) * nearest.over;
  for (unsigned i = 0; i < 3; ++i) {
    if (numbers >> i & 1) contact.normal[i] = round_sum(0, along[i], length2, 0);
    if (numbers >> (kPointNumber + i) & 1)
      contact.point1[i] = round_sum(nearest.p[i], out1 * along[i], length2, grid.exponent(), nearest.over);
    if (numbers >> (2 * kPointNumber + i) & 1)
      contact.point2[i] = round_sum(nearest.q[i], out2 * along[i], length2, grid.exponent(), nearest.over);
  }
  if (numbers >> kValueNumber & 1) {
    const Integer less = grid(lengths.radius1) + grid(lengths.radius2) + grid(lengths.contact);
    contact.value = contact.degenerate ? round_integer(-less, grid.exponent())
                    : nearest.overlap  ? round_sum(-less * nearest.over, -D, D, grid.exponent(), nearest.over)
                                       : round_root_less(D, less * nearest.over, grid.exponent(), nearest.over);
  }
}

}  // namespace contact::kernel
