// Sphere models, deformable and rigid.
#include "contact/sphere_model.hpp"

#include <cmath>

#include "component/columns.hpp"

namespace contact {
namespace {

std::optional<DomainError> outside_domain(const BallArray& balls, const char* centers) {
  if (auto error = component::not_finite(centers, balls.centers)) return error;
  if (auto error = component::wrong_length("radii", balls.radii.size(), centers, balls.centers.rows())) return error;
  for (Index i = 0; i < balls.radii.size(); ++i)
    if (auto error = contact::outside_domain(component::row("radii", i), balls.radii[i])) return error;
  return std::nullopt;
}

std::optional<DomainError> not_unit(const Eigen::MatrixX4d& orientations) {
  if (auto error = component::not_finite("orientations", orientations)) return error;
  for (Index i = 0; i < orientations.rows(); ++i)
    if (const double norm2 = orientations.row(i).squaredNorm();
        !(std::abs(norm2 - 1) <= RigidSphereModel::kUnitTolerance))
      return DomainError{component::row("orientations", i) + " squared length", norm2, "must be 1, a unit quaternion"};
  return std::nullopt;
}

}  // namespace

// Each bound misses the real one by two roundings, and what flushing to zero takes; a margin of 2^-50 of both numbers
// and 2^-1000 pays for them in every rounding mode.
Box box_around(const Ball& ball) {
  const auto margin = [&](double c) { return (std::abs(c) * 0x1p-50 + ball.radius * 0x1p-50) + 0x1p-1000; };
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const double c = ball.center[axis];
    box.min[axis] = (c - ball.radius) - margin(c);
    box.max[axis] = (c + ball.radius) + margin(c);
  }
  return box;
}

Vector3 contact_point_by_normal(const Ball& ball, const Vector3& normal, PointOn on) {
  if (on == PointOn::center) return ball.center;
  const double r = on == PointOn::nearest_surface ? -ball.radius : ball.radius;
  return {std::fma(normal[0], r, ball.center[0]), std::fma(normal[1], r, ball.center[1]),
          std::fma(normal[2], r, ball.center[2])};
}

SphereCollisionModel::SphereCollisionModel(std::string name, Eigen::MatrixX3d centers, Eigen::VectorXd radii)
    : ModelOf(std::move(name)), balls_{std::move(centers), std::move(radii)} {
  refuse(outside_domain(balls_, "centers"));
}

Box SphereCollisionModel::bounding_box(Index index) const { return box_around(balls_[index]); }

void SphereCollisionModel::setCenters(Eigen::MatrixX3d centers) {
  refuse(component::not_finite("centers", centers));
  refuse(component::wrong_length("centers", centers.rows(), "radii", getSize()));
  balls_.centers = std::move(centers);
}

RigidSphereModel::RigidSphereModel(std::string name, Eigen::MatrixX3d positions, Eigen::MatrixX4d orientations,
                                   Eigen::VectorXd radii)
    : ModelOf(std::move(name)), balls_{std::move(positions), std::move(radii)}, orientations_(std::move(orientations)) {
  refuse(outside_domain(balls_, "positions"));
  refuse(component::wrong_length("orientations", orientations_.rows(), "positions", getSize()));
  refuse(not_unit(orientations_));
}

Box RigidSphereModel::bounding_box(Index index) const { return box_around(balls_[index]); }

Frame RigidSphereModel::frame(Index index) const {
  return {balls_.centers.row(index).transpose(),
          Eigen::Quaterniond(Eigen::Vector4d(orientations_.row(index).transpose()))};
}

void RigidSphereModel::setFrames(Eigen::MatrixX3d positions, Eigen::MatrixX4d orientations) {
  refuse(component::not_finite("positions", positions));
  refuse(component::wrong_length("positions", positions.rows(), "radii", getSize()));
  refuse(component::wrong_length("orientations", orientations.rows(), "radii", getSize()));
  refuse(not_unit(orientations));
  balls_.centers = std::move(positions);
  orientations_ = std::move(orientations);
}

}  // namespace contact
