// Two spheres in plain arithmetic.
//
// SOFA's two overlap tests disagree on NaN: testIntersection asks norm2 <= reach^2, computeIntersection leaves when
// norm2 > reach^2. Both are kept as they are, so that recorded answers are met bit for bit.
#include <array>
#include <cmath>
#include <cstddef>

#include "golden/plain.hpp"

namespace contact::golden {
namespace {

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

}  // namespace

bool plain_overlap(const Balls& balls, Distances distances, Scalar scalar) {
  return scalar == Scalar::binary32 ? PlainSpheres<float>(balls, distances).overlap()
                                    : PlainSpheres<double>(balls, distances).overlap();
}

std::optional<Contact> plain_contact(const Balls& balls, Distances distances, Scalar scalar, ContactPoints points) {
  return scalar == Scalar::binary32 ? PlainSpheres<float>(balls, distances).contact(points)
                                    : PlainSpheres<double>(balls, distances).contact(points);
}

}  // namespace contact::golden
