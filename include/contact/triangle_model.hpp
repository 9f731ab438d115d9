// The triangle model and its element.
#pragma once

#include "contact/collision_model.hpp"
#include "contact/rows.hpp"

namespace contact::inline CONTACT_ABI {

/// Triangles, given by their vertices.
/// Units       one length unit throughout.
/// Domain      finite vertices, as many first ones as second and third. Any three points are a triangle. Anything else
///             throws InvalidModel and does not change the model.
/// Contacts    MeshDiscreteIntersection of contact/shape_intersectors.hpp, which every program with such a model has in
///             its factory.
class TriangleCollisionModel : public ModelOf<TriangleCollisionModel> {
 public:
  static constexpr std::string_view kName = "TriangleCollisionModel";
  static constexpr ModelIdentity<TriangleCollisionModel> kIdentity{"contact::TriangleCollisionModel"};
  using Element = class TriangleElement;

  TriangleCollisionModel(std::string name, Rows<3> p1, Rows<3> p2, Rows<3> p3);

  [[nodiscard]] Index getSize() const override { return p1_.rows(); }
  [[nodiscard]] Box bounding_box(Index index) const override;
  [[nodiscard]] Triangle triangle(Index index) const {
    return {{p1_.vector(index), p2_.vector(index), p3_.vector(index)}};
  }

  /// Moves every triangle; their number must not change.
  void setVertices(Rows<3> p1, Rows<3> p2, Rows<3> p3);

 private:
  Rows<3> p1_;
  Rows<3> p2_;
  Rows<3> p3_;
};

/// A handle to one triangle of a model; the shape itself is contact::Triangle.
class TriangleElement : public ElementOf<TriangleCollisionModel> {
 public:
  using ElementOf::ElementOf;

  [[nodiscard]] Triangle triangle() const { return getCollisionModel().triangle(getIndex()); }
  [[nodiscard]] Vector3 p1() const { return triangle().vertices[0]; }
  [[nodiscard]] Vector3 p2() const { return triangle().vertices[1]; }
  [[nodiscard]] Vector3 p3() const { return triangle().vertices[2]; }
};

}  // namespace contact::inline CONTACT_ABI
