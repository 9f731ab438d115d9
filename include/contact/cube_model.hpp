// The cube model (axis-aligned boxes, each with a cone of normals) and its element.
#pragma once

#include <numbers>
#include <vector>

#include "contact/collision_model.hpp"
#include "contact/rows.hpp"

namespace contact::inline CONTACT_ABI {

/// Axis-aligned boxes. A box may carry the cone of the surface normals inside it (Volino's test for self-collision): a
/// surface whose normals stay within less than a quarter turn of one axis cannot touch itself.
/// Units       one length unit throughout; angles in radians.
/// Domain      finite, min <= max on every axis, as many rows in `max` as in `min`; cone angle finite and >= 0,
///             cone axis finite. Anything else throws InvalidModel and does not change the model.
class CubeCollisionModel : public ModelOf<CubeCollisionModel> {
 public:
  static constexpr std::string_view kName = "CubeCollisionModel";
  static constexpr ModelIdentity<CubeCollisionModel> kIdentity{"contact::CubeCollisionModel"};
  /// The cone angle of a box about which nothing is known: the cone holds every direction.
  static constexpr double kWholeTurn = 2 * std::numbers::pi;
  using Element = class Cube;

  CubeCollisionModel(std::string name, Rows<3> min, Rows<3> max);

  [[nodiscard]] Index getSize() const override { return min_.rows(); }
  [[nodiscard]] Box bounding_box(Index index) const override { return box(index); }
  [[nodiscard]] Box box(Index index) const { return {min_.vector(index), max_.vector(index)}; }
  [[nodiscard]] double cone_angle(Index index) const { return cone_angle_[static_cast<std::size_t>(index)]; }
  [[nodiscard]] Vector3 cone_axis(Index index) const { return cone_axis_.vector(index); }

  /// Gives a box new bounds. Without a normal its cone becomes a whole turn; with one, the cone of `angle` around it.
  void setParentOf(Index index, const Vector3& min, const Vector3& max);
  void setParentOf(Index index, const Vector3& min, const Vector3& max, const Vector3& normal, double angle = 0);

 private:
  Rows<3> min_;
  Rows<3> max_;
  Rows<3> cone_axis_;
  std::vector<double> cone_angle_;
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

}  // namespace contact::inline CONTACT_ABI
