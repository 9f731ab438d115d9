// The line model and its element.
#pragma once

#include "contact/collision_model.hpp"
#include "contact/rows.hpp"

namespace contact::inline CONTACT_ABI {

/// Lines, as SOFA calls segments between two points.
/// Units       one length unit for all ends.
/// Domain      finite; as many first ends as second ones. Anything else throws InvalidModel and does not change the
///             model. The ends of a line may be one point.
/// Contacts    MeshDiscreteIntersection of contact/shape_intersectors.hpp has those with triangles.
class LineCollisionModel : public ModelOf<LineCollisionModel> {
 public:
  static constexpr std::string_view kName = "LineCollisionModel";
  static constexpr ModelIdentity<LineCollisionModel> kIdentity{"contact::LineCollisionModel"};
  using Element = class LineElement;

  LineCollisionModel(std::string name, Rows<3> p1, Rows<3> p2);

  [[nodiscard]] Index getSize() const override { return p1_.rows(); }
  [[nodiscard]] Box bounding_box(Index index) const override;
  [[nodiscard]] Line line(Index index) const { return {p1_.vector(index), p2_.vector(index)}; }

  /// Moves every line; their number must not change.
  void setEnds(Rows<3> p1, Rows<3> p2);

 private:
  Rows<3> p1_;
  Rows<3> p2_;
};

/// A handle to one line of a model; the shape itself is contact::Line.
class LineElement : public ElementOf<LineCollisionModel> {
 public:
  using ElementOf::ElementOf;

  [[nodiscard]] Line line() const { return getCollisionModel().line(getIndex()); }
  [[nodiscard]] Vector3 p1() const { return line().start; }
  [[nodiscard]] Vector3 p2() const { return line().end; }
};

}  // namespace contact::inline CONTACT_ABI
