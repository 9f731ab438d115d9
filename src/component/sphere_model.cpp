// Sphere models, deformable and rigid.
#include "contact/sphere_model.hpp"

#include <cmath>
#include <limits>

#include "component/columns.hpp"
#include "kernel/floating_point_environment.hpp"

namespace contact::inline CONTACT_ABI {
namespace {

std::optional<DomainError> outside_domain(const Rows<3>& centers, const Rows<1>& radii, const char* name) {
  if (auto error = component::not_finite(name, centers)) return error;
  if (auto error = component::wrong_length("radii", radii.rows(), name, centers.rows())) return error;
  return component::not_a_length("radii", radii);
}

// Not inlined, this and what computes below: what RoundToNearest sets must be set before anything is computed.
[[gnu::noinline]] std::optional<DomainError> first_not_unit(const Rows<4>& orientations) {
  for (Index i = 0; i < orientations.rows(); ++i) {
    double norm2 = 0;
    for (int k = 0; k < 4; ++k) norm2 += orientations(i, k) * orientations(i, k);
    if (!(std::abs(norm2 - 1) <= RigidSphereModel::kUnitTolerance))
      return DomainError{component::row("orientations", i) + " squared length", norm2, "must be 1, a unit quaternion"};
  }
  return std::nullopt;
}

std::optional<DomainError> not_unit(const Rows<4>& orientations) {
  if (auto error = component::not_finite("orientations", orientations)) return error;
  const kernel::RoundToNearest environment;
  return first_not_unit(orientations);
}

// Each bound misses the real one by two roundings, and what flushing to zero takes; a margin of 2^-50 of both numbers
// and 2^-1000 pays for them in every rounding mode. Beyond the range the bound is infinite, also where the mode would
// stop at the largest finite number.
[[gnu::noinline]] Box rounded_box_around(const Ball& ball) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto margin = [&](double c) { return (std::abs(c) * 0x1p-50 + ball.radius * 0x1p-50) + 0x1p-1000; };
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const double c = ball.center[axis];
    box.min[axis] = (c - ball.radius) - margin(c);
    box.max[axis] = (c + ball.radius) + margin(c);
    if (box.min[axis] <= -kLargest) box.min[axis] = -kInfinity;
    if (box.max[axis] >= kLargest) box.max[axis] = kInfinity;
  }
  return box;
}

[[gnu::noinline]] Vector3 surface_point(const Ball& ball, const Vector3& normal, PointOn on) {
  const double r = on == PointOn::nearest_surface ? -ball.radius : ball.radius;
  return {std::fma(normal[0], r, ball.center[0]), std::fma(normal[1], r, ball.center[1]),
          std::fma(normal[2], r, ball.center[2])};
}

}  // namespace

Box box_around(const Ball& ball) {
  const kernel::RoundToNearest environment;
  return rounded_box_around(ball);
}

Vector3 contact_point_by_normal(const Ball& ball, const Vector3& normal, PointOn on) {
  if (on == PointOn::center) return ball.center;
  const kernel::RoundToNearest environment;
  return surface_point(ball, normal, on);
}

SphereCollisionModel::SphereCollisionModel(std::string name, Rows<3> centers, Rows<1> radii)
    : ModelOf(std::move(name)), centers_(std::move(centers)), radii_(std::move(radii)) {
  refuse(outside_domain(centers_, radii_, "centers"));
}

Box SphereCollisionModel::bounding_box(Index index) const {
  return box_around(Ball{centers_.vector(index), radii_(index)});
}

void SphereCollisionModel::setCenters(Rows<3> centers) {
  refuse(component::not_finite("centers", centers));
  refuse(component::wrong_length("centers", centers.rows(), "radii", getSize()));
  centers_ = std::move(centers);
}

RigidSphereModel::RigidSphereModel(std::string name, Rows<3> positions, Rows<4> orientations, Rows<1> radii)
    : ModelOf(std::move(name)),
      centers_(std::move(positions)),
      radii_(std::move(radii)),
      orientations_(std::move(orientations)) {
  refuse(outside_domain(centers_, radii_, "positions"));
  refuse(component::wrong_length("orientations", orientations_.rows(), "positions", getSize()));
  refuse(not_unit(orientations_));
}

Box RigidSphereModel::bounding_box(Index index) const {
  return box_around(Ball{centers_.vector(index), radii_(index)});
}

Frame RigidSphereModel::frame(Index index) const {
  return {centers_.vector(index),
          {orientations_(index, 3), orientations_(index, 0), orientations_(index, 1), orientations_(index, 2)}};
}

void RigidSphereModel::setFrames(Rows<3> positions, Rows<4> orientations) {
  refuse(component::not_finite("positions", positions));
  refuse(component::wrong_length("positions", positions.rows(), "radii", getSize()));
  refuse(component::wrong_length("orientations", orientations.rows(), "radii", getSize()));
  refuse(not_unit(orientations));
  centers_ = std::move(positions);
  orientations_ = std::move(orientations);
}

}  // namespace contact::inline CONTACT_ABI
