// The ray model and its element.
#pragma once

#include "contact/collision_model.hpp"
#include "contact/rows.hpp"

namespace contact::inline CONTACT_ABI {

/// Rays: segments from an origin along a direction.
/// Units       one length unit for the origins; a length counts directions, which need not be of length 1.
/// Domain      finite origins; finite directions other than 0; finite lengths >= 0; as many of each. Anything else
///             throws InvalidModel and does not change the model.
/// Contacts    RayDiscreteIntersection of contact/shape_intersectors.hpp, which every program with such a model has in
///             its factory.
class RayCollisionModel : public ModelOf<RayCollisionModel> {
 public:
  static constexpr std::string_view kName = "RayCollisionModel";
  static constexpr ModelIdentity<RayCollisionModel> kIdentity{"contact::RayCollisionModel"};
  using Element = class RayElement;

  RayCollisionModel(std::string name, Rows<3> origins, Rows<3> directions, Rows<1> lengths);

  [[nodiscard]] Index getSize() const override { return lengths_.size(); }
  [[nodiscard]] Box bounding_box(Index index) const override;
  [[nodiscard]] Ray ray(Index index) const {
    return {origins_.vector(index), directions_.vector(index), lengths_(index)};
  }

  /// Moves and turns every ray; their number and lengths must not change.
  void setRays(Rows<3> origins, Rows<3> directions);

 private:
  Rows<3> origins_;
  Rows<3> directions_;
  Rows<1> lengths_;
};

/// A handle to one ray of a model; the shape itself is contact::Ray.
class RayElement : public ElementOf<RayCollisionModel> {
 public:
  using ElementOf::ElementOf;

  [[nodiscard]] Ray ray() const { return getCollisionModel().ray(getIndex()); }
  [[nodiscard]] Vector3 origin() const { return ray().origin; }
  [[nodiscard]] Vector3 direction() const { return ray().direction; }
  [[nodiscard]] double l() const { return ray().length; }
};

/// A box that contains the ray, as box_around a ball.
[[nodiscard]] Box box_around(const Ray& ray);

}  // namespace contact::inline CONTACT_ABI
