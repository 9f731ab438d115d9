// The cube model (axis-aligned boxes, each with a cone of normals) and its element.
#pragma once

#include <numbers>

#include "contact/collision_model.hpp"

namespace contact {

/// Axis-aligned boxes. A box may carry the cone of the surface normals inside it (Volino's test for self-collision): a
/// surface whose normals stay within less than a quarter turn of one axis cannot touch itself.
/// Units       one length unit throughout; angles in radians.
/// Domain      finite, min <= max on every axis, as many of one as of the other; cone angle finite and >= 0, cone axis
///             finite. Anything else throws InvalidModel and leaves the model as it was.
class CubeCollisionModel : public ModelOf<CubeCollisionModel> {
 public:
  static constexpr std::string_view kName = "CubeCollisionModel";
  /// The cone of a box about which nothing is known: every direction.
  static constexpr double kWholeTurn = 2 * std::numbers::pi;
  using Element = class Cube;

  CubeCollisionModel(std::string name, Eigen::MatrixX3d min, Eigen::MatrixX3d max);

  [[nodiscard]] Index getSize() const override { return min_.rows(); }
  [[nodiscard]] Box bounding_box(Index index) const override { return box(index); }
  [[nodiscard]] Box box(Index index) const { return {min_.row(index).transpose(), max_.row(index).transpose()}; }
  [[nodiscard]] double cone_angle(Index index) const { return cone_angle_[index]; }
  [[nodiscard]] Vector3 cone_axis(Index index) const { return cone_axis_.row(index).transpose(); }

  /// Gives a box new bounds: without a normal its cone is a whole turn, with one the cone of `angle` around it.
  void setParentOf(Index index, const Vector3& min, const Vector3& max);
  void setParentOf(Index index, const Vector3& min, const Vector3& max, const Vector3& normal, double angle = 0);

 private:
  Eigen::MatrixX3d min_;
  Eigen::MatrixX3d max_;
  Eigen::MatrixX3d cone_axis_;
  Eigen::VectorXd cone_angle_;
};

/// A handle to one box.
class Cube : public ElementOf<CubeCollisionModel> {
 public:
  using ElementOf::ElementOf;

  [[nodiscard]] Box box() const { return getCollisionModel().box(getIndex()); }
  [[nodiscard]] Vector3 minVect() const { return box().min; }
  [[nodiscard]] Vector3 maxVect() const { return box().max; }
  [[nodiscard]] double getConeAngle() const { return getCollisionModel().cone_angle(getIndex()); }
  [[nodiscard]] Vector3 getConeAxis() const { return getCollisionModel().cone_axis(getIndex()); }
};

}  // namespace contact
