// The plane model and its element.
#pragma once

#include "contact/collision_model.hpp"
#include "contact/rows.hpp"

namespace contact::inline CONTACT_ABI {

/// Planes, each with the half-space normal . x <= offset below it, such as a floor.
/// Units       an offset is of the unit of the points times that of the normal, which need not be of length 1.
/// Domain      finite normals other than 0; finite offsets; as many of each. Anything else throws InvalidModel and does
///             not change the model.
/// Contacts    PlaneDiscreteIntersection of contact/shape_intersectors.hpp, which every program with such a model has
///             in its factory.
class PlaneCollisionModel : public ModelOf<PlaneCollisionModel> {
 public:
  static constexpr std::string_view kName = "PlaneCollisionModel";
  static constexpr ModelIdentity<PlaneCollisionModel> kIdentity{"contact::PlaneCollisionModel"};
  using Element = class PlaneElement;

  PlaneCollisionModel(std::string name, Rows<3> normals, Rows<1> offsets);

  [[nodiscard]] Index getSize() const override { return offsets_.size(); }
  [[nodiscard]] Box bounding_box(Index index) const override;
  [[nodiscard]] Plane plane(Index index) const { return {normals_.vector(index), offsets_(index)}; }

  /// Moves and turns every plane; their number must not change.
  void setPlanes(Rows<3> normals, Rows<1> offsets);

 private:
  Rows<3> normals_;
  Rows<1> offsets_;
};

/// A handle to one plane of a model; the shape itself is contact::Plane.
class PlaneElement : public ElementOf<PlaneCollisionModel> {
 public:
  using ElementOf::ElementOf;

  [[nodiscard]] Plane plane() const { return getCollisionModel().plane(getIndex()); }
  [[nodiscard]] Vector3 normal() const { return plane().normal; }
  [[nodiscard]] double offset() const { return plane().offset; }
};

/// A box that contains the half-space: one side of it is finite where the normal lies along an axis, else none.
[[nodiscard]] Box box_around(const Plane& plane);

}  // namespace contact::inline CONTACT_ABI
