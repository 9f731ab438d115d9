// The line model.
#include "contact/line_model.hpp"

#include "component/columns.hpp"

namespace contact::inline CONTACT_ABI {
namespace {

std::optional<DomainError> not_in_domain(const Rows<3>& p1, const Rows<3>& p2) {
  if (auto error = component::not_finite("p1", p1)) return error;
  if (auto error = component::not_finite("p2", p2)) return error;
  return component::wrong_length("p2", p2.rows(), "p1", p1.rows());
}

}  // namespace

LineCollisionModel::LineCollisionModel(std::string name, Rows<3> p1, Rows<3> p2)
    : ModelOf(std::move(name)), p1_(std::move(p1)), p2_(std::move(p2)) {
  refuse(not_in_domain(p1_, p2_));
}

Box LineCollisionModel::bounding_box(Index index) const {
  const auto [start, end] = line(index);
  return {start.cwiseMin(end), start.cwiseMax(end)};
}

void LineCollisionModel::setEnds(Rows<3> p1, Rows<3> p2) {
  refuse(not_in_domain(p1, p2));
  refuse(component::wrong_length("p1", p1.rows(), "lines", getSize()));
  p1_ = std::move(p1);
  p2_ = std::move(p2);
}

}  // namespace contact::inline CONTACT_ABI
