// The capsule model and its element.
#pragma once

#include "contact/collision_model.hpp"
#include "contact/rows.hpp"

namespace contact::inline CONTACT_ABI {

/// Capsules: everything within a radius of a segment, given by its two ends.
/// Units       one length unit throughout.
/// Domain      finite ends; finite radii >= 0; as many of each. Equal ends make a ball. Anything else throws
///             InvalidModel and does not change the model.
/// Contacts    CapsuleDiscreteIntersection of contact/shape_intersectors.hpp, which every program with such a model
///             has in its factory.
class CapsuleCollisionModel : public ModelOf<CapsuleCollisionModel> {
 public:
  static constexpr std::string_view kName = "CapsuleCollisionModel";
  static constexpr ModelIdentity<CapsuleCollisionModel> kIdentity{"contact::CapsuleCollisionModel"};
  using Element = class CapsuleElement;

  CapsuleCollisionModel(std::string name, Rows<3> starts, Rows<3> ends, Rows<1> radii);

  [[nodiscard]] Index getSize() const override { return radii_.size(); }
  [[nodiscard]] Box bounding_box(Index index) const override;
  [[nodiscard]] Capsule capsule(Index index) const {
    return {starts_.vector(index), ends_.vector(index), radii_(index)};
  }

  /// Moves every capsule; their number must not change.
  void setEnds(Rows<3> starts, Rows<3> ends);

 private:
  Rows<3> starts_;
  Rows<3> ends_;
  Rows<1> radii_;
};

/// A handle to one capsule of a model; the shape itself is contact::Capsule.
class CapsuleElement : public ElementOf<CapsuleCollisionModel> {
 public:
  using ElementOf::ElementOf;

  [[nodiscard]] Capsule capsule() const { return getCollisionModel().capsule(getIndex()); }
  [[nodiscard]] Vector3 point1() const { return capsule().start; }
  [[nodiscard]] Vector3 point2() const { return capsule().end; }
  [[nodiscard]] double radius() const { return capsule().radius; }
};

/// A box that contains the capsule, as box_around a ball.
[[nodiscard]] Box box_around(const Capsule& capsule);

}  // namespace contact::inline CONTACT_ABI
