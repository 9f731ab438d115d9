// The triangle model.
#include "contact/triangle_model.hpp"

#include "component/columns.hpp"
#include "contact/shape_intersectors.hpp"

namespace contact::inline CONTACT_ABI {
namespace {

/// Here, so that no linker leaves it out of a program that has triangles.
const IntersectorCreator<MeshDiscreteIntersection> mesh_intersectors("Mesh");

std::optional<DomainError> outside_domain(const Rows<3>& p1, const Rows<3>& p2, const Rows<3>& p3) {
  if (auto error = component::not_finite("p1", p1)) return error;
  if (auto error = component::not_finite("p2", p2)) return error;
  if (auto error = component::not_finite("p3", p3)) return error;
  if (auto error = component::wrong_length("p2", p2.rows(), "p1", p1.rows())) return error;
  return component::wrong_length("p3", p3.rows(), "p1", p1.rows());
}

}  // namespace

TriangleCollisionModel::TriangleCollisionModel(std::string name, Rows<3> p1, Rows<3> p2, Rows<3> p3)
    : ModelOf(std::move(name)), p1_(std::move(p1)), p2_(std::move(p2)), p3_(std::move(p3)) {
  refuse(outside_domain(p1_, p2_, p3_));
}

Box TriangleCollisionModel::bounding_box(Index index) const {
  const auto [v0, v1, v2] = triangle(index).vertices;
  return {v0.cwiseMin(v1).cwiseMin(v2), v0.cwiseMax(v1).cwiseMax(v2)};
}

void TriangleCollisionModel::setVertices(Rows<3> p1, Rows<3> p2, Rows<3> p3) {
  refuse(outside_domain(p1, p2, p3));
  refuse(component::wrong_length("p1", p1.rows(), "triangles", getSize()));
  p1_ = std::move(p1);
  p2_ = std::move(p2);
  p3_ = std::move(p3);
}

}  // namespace contact::inline CONTACT_ABI
