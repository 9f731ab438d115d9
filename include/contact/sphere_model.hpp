// Sphere models, deformable and rigid, and their elements.
#pragma once

#include <Eigen/Geometry>

#include "contact/collision_model.hpp"
#include "contact/contact.hpp"

namespace contact {

/// Many balls as a structure of arrays: column x of every centre, then y, then z, and the radii.
struct BallArray {
  Eigen::MatrixX3d centers;
  Eigen::VectorXd radii;

  [[nodiscard]] Ball operator[](Index i) const { return {centers.row(i).transpose(), radii[i]}; }
};

/// Spheres on the particles of something deformable.
/// Units       one length unit throughout.
/// Domain      finite centres; finite radii >= 0; as many of one as of the other. Anything else throws InvalidModel and
///             leaves the model as it was.
class SphereCollisionModel : public ModelOf<SphereCollisionModel> {
 public:
  static constexpr std::string_view kName = "SphereCollisionModel";
  static constexpr SphereKind kKind = SphereKind::deformable;
  using Element = class Sphere;

  SphereCollisionModel(std::string name, Eigen::MatrixX3d centers, Eigen::VectorXd radii);

  [[nodiscard]] Index getSize() const override { return balls_.radii.size(); }
  [[nodiscard]] Box bounding_box(Index index) const override;
  [[nodiscard]] const BallArray& balls() const { return balls_; }
  [[nodiscard]] const Eigen::VectorXd& getR() const { return balls_.radii; }
  [[nodiscard]] double getRadius(Index index) const { return balls_.radii[index]; }

  /// Moves every particle; the number stays.
  void setCenters(Eigen::MatrixX3d centers);

 private:
  BallArray balls_;
};

/// A rigid body's frame: where it is and how it is turned.
struct Frame {
  Vector3 center;
  Eigen::Quaterniond orientation;
};

/// Spheres that each sit at the origin of a rigid frame.
/// Units       one length unit throughout; orientations are unit quaternions, columns x, y, z, w as SOFA stores them.
/// Domain      as SphereCollisionModel, and ||q|^2 - 1| <= kUnitTolerance.
class RigidSphereModel : public ModelOf<RigidSphereModel> {
 public:
  static constexpr std::string_view kName = "RigidSphereModel";
  static constexpr SphereKind kKind = SphereKind::rigid;
  /// What a unit quaternion rounded to binary32 may miss by, with room: 4 components, each within 2^-25 of its real.
  static constexpr double kUnitTolerance = 0x1p-20;
  using Element = class RigidSphere;

  RigidSphereModel(std::string name, Eigen::MatrixX3d positions, Eigen::MatrixX4d orientations, Eigen::VectorXd radii);

  [[nodiscard]] Index getSize() const override { return balls_.radii.size(); }
  [[nodiscard]] Box bounding_box(Index index) const override;
  [[nodiscard]] const BallArray& balls() const { return balls_; }
  [[nodiscard]] const Eigen::VectorXd& getR() const { return balls_.radii; }
  [[nodiscard]] double getRadius(Index index) const { return balls_.radii[index]; }
  [[nodiscard]] Frame frame(Index index) const;

  /// Moves every frame; the number stays.
  void setFrames(Eigen::MatrixX3d positions, Eigen::MatrixX4d orientations);

 private:
  BallArray balls_;
  Eigen::MatrixX4d orientations_;
};

/// A box that contains the ball, in every rounding mode: what a model of your own builds its bounding_box from.
[[nodiscard]] Box box_around(const Ball& ball);

/// The surface point of a ball for a normal that points into it: center - radius normal, every coordinate rounded once
/// (fma; to nearest, in the caller's rounding mode). `far_surface` is the opposite point, `center` the centre.
[[nodiscard]] Vector3 contact_point_by_normal(const Ball& ball, const Vector3& normal, PointOn on);

/// A handle to one sphere of a model of type M.
template <class M>
class SphereOf : public ElementOf<M> {
 public:
  using ElementOf<M>::ElementOf;

  [[nodiscard]] Ball ball() const { return this->getCollisionModel().balls()[this->getIndex()]; }
  [[nodiscard]] Vector3 center() const {
    return this->getCollisionModel().balls().centers.row(this->getIndex()).transpose();
  }
  [[nodiscard]] double r() const { return this->getCollisionModel().getRadius(this->getIndex()); }

  /// The contact point for a normal that points from the contact into this sphere, as SOFA's: pass -n for the first
  /// sphere of a pair and n for the second. Points of a DetectionOutput do not come from here: they follow from the
  /// exact normal, this one from a normal that has been rounded already.
  [[nodiscard]] Vector3 getContactPointByNormal(const Vector3& contactNormal,
                                                PointConvention convention = PointConvention::nearest_surface) const {
    return contact_point_by_normal(ball(), contactNormal, point_on(convention, M::kKind));
  }
};

class Sphere : public SphereOf<SphereCollisionModel> {
 public:
  using SphereOf::SphereOf;
};

class RigidSphere : public SphereOf<RigidSphereModel> {
 public:
  using SphereOf::SphereOf;
  [[nodiscard]] Frame rigidCenter() const { return getCollisionModel().frame(getIndex()); }
};

}  // namespace contact
