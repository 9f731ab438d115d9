// Two axis-aligned boxes in plain arithmetic.
#include "golden/plain.hpp"

namespace contact::golden {
namespace {

/// Upstream's box test: no axis on which one minimum exceeds the other maximum plus the alarm distance.
template <class Real>
bool overlap(const Boxes& boxes, Distances distances) {
  const Real alarm = static_cast<Real>(distances.alarm);
  for (int axis = 0; axis < 3; ++axis) {
    const Real min1 = static_cast<Real>(boxes.a.min[axis]);
    const Real max1 = static_cast<Real>(boxes.a.max[axis]);
    const Real min2 = static_cast<Real>(boxes.b.min[axis]);
    const Real max2 = static_cast<Real>(boxes.b.max[axis]);
    if (min1 > max2 + alarm || min2 > max1 + alarm) return false;
  }
  return true;
}

}  // namespace

bool plain_overlap(const Boxes& boxes, Distances distances, Scalar scalar) {
  return scalar == Scalar::binary32 ? overlap<float>(boxes, distances) : overlap<double>(boxes, distances);
}

std::optional<Contact> plain_contact(const Boxes& /*boxes*/, Distances /*distances*/, Scalar /*scalar*/,
                                     ContactPoints /*points*/) {
  return std::nullopt;
}

}  // namespace contact::golden
