// The seed's formulas in plain arithmetic, in the order in which upstream computes them: what everybody ships.
//
// SOFA's two overlap tests disagree on NaN: testIntersection asks norm2 <= reach^2, computeIntersection leaves when
// norm2 > reach^2. Both are kept as they are, so that recorded answers are met bit for bit.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "contact/contact.hpp"
#include "oracle/query.hpp"

namespace contact::golden {

template <class Real>
class PlainSpheres {
 public:
  PlainSpheres(const Balls& balls, Distances distances)
      : radius_{static_cast<Real>(balls.a.radius), static_cast<Real>(balls.b.radius)},
        contact_(static_cast<Real>(distances.contact)) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      center_[0][i] = static_cast<Real>(balls.a.center[axis]);
      center_[1][i] = static_cast<Real>(balls.b.center[axis]);
      delta_[i] = center_[1][i] - center_[0][i];
    }
    norm2_ = delta_[0] * delta_[0] + delta_[1] * delta_[1] + delta_[2] * delta_[2];
    const Real reach = (radius_[0] + radius_[1]) + static_cast<Real>(distances.alarm);
    reach2_ = reach * reach;
  }

  /// testIntersection.
  [[nodiscard]] bool overlap() const { return norm2_ <= reach2_; }

  /// computeIntersection. Widening to double is exact, so a Real of float keeps its numbers.
  [[nodiscard]] std::optional<Contact> contact(ContactPoints points) const {
    if (norm2_ > reach2_) return std::nullopt;
    const Real distance = std::sqrt(norm2_);
    std::array<Real, 3> n{};
    for (std::size_t i = 0; i < 3; ++i) n[i] = delta_[i] / distance;
    Contact contact{};
    contact.degenerate = norm2_ == 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      contact.normal[axis] = static_cast<double>(n[i]);
      contact.point1[axis] = static_cast<double>(point(0, points.first, i, n[i]));
      contact.point2[axis] = static_cast<double>(point(1, points.second, i, n[i]));
    }
    contact.value = static_cast<double>((distance - (radius_[0] + radius_[1])) - contact_);
    return contact;
  }

 private:
  [[nodiscard]] Real point(std::size_t sphere, PointOn on, std::size_t i, Real n) const {
    const Real c = center_[sphere][i];
    if (on == PointOn::center) return c;
    const bool along = (on == PointOn::nearest_surface) == (sphere == 0);
    return along ? c + n * radius_[sphere] : c - n * radius_[sphere];
  }

  std::array<std::array<Real, 3>, 2> center_;
  std::array<Real, 2> radius_;
  std::array<Real, 3> delta_;
  Real contact_;
  Real norm2_;
  Real reach2_;
};

/// Upstream's box test: no axis on which one minimum exceeds the other maximum plus the alarm distance.
template <class Real>
[[nodiscard]] bool plain_cubes_overlap(const Boxes& boxes, Distances distances) {
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

/// What plain arithmetic in the given scalar says of a question.
[[nodiscard]] inline bool plain_overlap(const Query& query, Scalar scalar) {
  const bool single = scalar == Scalar::binary32;
  if (const Balls* balls = query.balls())
    return single ? PlainSpheres<float>(*balls, query.distances).overlap()
                  : PlainSpheres<double>(*balls, query.distances).overlap();
  return single ? plain_cubes_overlap<float>(*query.boxes(), query.distances)
                : plain_cubes_overlap<double>(*query.boxes(), query.distances);
}

}  // namespace contact::golden
