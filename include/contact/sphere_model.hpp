// Sphere models, deformable and rigid, and their elements.
#pragma once

#include <Eigen/Geometry>

#include "contact/collision_model.hpp"
#include "contact/contact.hpp"
#include "contact/rows.hpp"

namespace contact::inline CONTACT_ABI {

/// A view of many balls as a structure of arrays: x of every centre, then every y, then every z, and the radii.
struct BallArray {
  Eigen::Map<const Rows<3>::Matrix> centers;
  Eigen::Map<const Rows<1>::Matrix> radii;

  [[nodiscard]] Ball operator[](Index i) const { return {centers.row(i).transpose(), radii[i]}; }
};

/// Spheres on the particles of a deformable body.
/// Units       one length unit throughout.
/// Domain      finite centres; finite radii >= 0; as many radii as centres. Anything else throws InvalidModel and
///             does not change the model.
class SphereCollisionModel : public ModelOf<SphereCollisionModel> {
 public:
  static constexpr std::string_view kName = "SphereCollisionModel";
  static constexpr ModelIdentity<SphereCollisionModel> kIdentity{"contact::SphereCollisionModel"};
  static constexpr SphereKind kKind = SphereKind::deformable;
  using Element = class Sphere;

  SphereCollisionModel(std::string name, Rows<3> centers, Rows<1> radii);

  [[nodiscard]] Index getSize() const override { return radii_.size(); }
  [[nodiscard]] Box bounding_box(Index index) const override;
  /// Valid while the model lives, its address stays, and nobody gives it other centres.
  [[nodiscard]] BallArray balls() const { return {centers_.matrix(), radii_.matrix()}; }
  [[nodiscard]] Eigen::Map<const Rows<1>::Matrix> getR() const { return radii_.matrix(); }
  [[nodiscard]] double getRadius(Index index) const { return radii_(index); }

  /// Moves every particle; their number must not change.
  void setCenters(Rows<3> centers);

 private:
  Rows<3> centers_;
  Rows<1> radii_;
};

/// A rigid body's frame: its position and orientation. The orientation is not aligned, because the alignment of
/// Quaterniond depends on the instruction set; it converts to a Quaterniond.
struct Frame {
  Vector3 center;
  Eigen::Quaternion<double, Eigen::DontAlign> orientation;
};

/// Spheres that each sit at the origin of a rigid frame.
/// Units       one length unit throughout; orientations are unit quaternions, columns x, y, z, w as SOFA stores them.
/// Domain      as SphereCollisionModel, and ||q|^2 - 1| <= kUnitTolerance.
class RigidSphereModel : public ModelOf<RigidSphereModel> {
 public:
  static constexpr std::string_view kName = "RigidSphereModel";
  static constexpr ModelIdentity<RigidSphereModel> kIdentity{"contact::RigidSphereModel"};
  static constexpr SphereKind kKind = SphereKind::rigid;
  /// How far |q|^2 of a unit quaternion rounded to binary32 may be from 1, with room: each of the 4 components is
  /// within 2^-25 of its real value.
  static constexpr double kUnitTolerance = 0x1p-20;
  using Element = class RigidSphere;

  RigidSphereModel(std::string name, Rows<3> positions, Rows<4> orientations, Rows<1> radii);

  [[nodiscard]] Index getSize() const override { return radii_.size(); }
  [[nodiscard]] Box bounding_box(Index index) const override;
  /// Valid while the model lives, its address stays, and nobody gives it other centres.
  [[nodiscard]] BallArray balls() const { return {centers_.matrix(), radii_.matrix()}; }
  [[nodiscard]] Eigen::Map<const Rows<1>::Matrix> getR() const { return radii_.matrix(); }
  [[nodiscard]] double getRadius(Index index) const { return radii_(index); }
  [[nodiscard]] Frame frame(Index index) const;

  /// Moves every frame; their number must not change.
  void setFrames(Rows<3> positions, Rows<4> orientations);

 private:
  Rows<3> centers_;
  Rows<1> radii_;
  Rows<4> orientations_;
};

/// A box that contains the ball, in every rounding mode. Your own models can build their bounding_box from it. Its
/// bounds are infinite where the ball reaches beyond the largest finite number.
[[nodiscard]] Box box_around(const Ball& ball);

/// The surface point of a ball for a normal that points into it: center - radius normal. Every coordinate is rounded
/// once (fma; to nearest, whatever the caller has set). `far_surface` gives the opposite point, `center` the centre.
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

  /// The contact point for a normal that points from the contact into this sphere, as in SOFA: pass -n for the first
  /// sphere of a pair and n for the second. The points of a DetectionOutput do not come from here. They are computed
  /// from the exact normal; this function gets a normal that has been rounded already.
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

}  // namespace contact::inline CONTACT_ABI
