// The cube model (axis-aligned boxes, each with a cone of normals).
#include "contact/cube_model.hpp"

#include "component/columns.hpp"

namespace contact::inline CONTACT_ABI {

CubeCollisionModel::CubeCollisionModel(std::string name, Rows<3> min, Rows<3> max)
    : ModelOf(std::move(name)),
      min_(std::move(min)),
      max_(std::move(max)),
      cone_axis_(min_.rows(), 3),
      cone_angle_(static_cast<std::size_t>(min_.rows()), kWholeTurn) {
  refuse(component::not_finite("min", min_));
  refuse(component::not_finite("max", max_));
  refuse(component::wrong_length("max", max_.rows(), "min", min_.rows()));
  for (Index i = 0; i < getSize(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      if (is_less_by_bits(max_(i, axis), min_(i, axis)))
        refuse(DomainError{component::row(component::row("min", i), axis), min_(i, axis), "must not exceed max"});
}

void CubeCollisionModel::setParentOf(Index index, const Vector3& min, const Vector3& max) {
  setParentOf(index, min, max, Vector3::Zero(), kWholeTurn);
}

void CubeCollisionModel::setParentOf(Index index, const Vector3& min, const Vector3& max, const Vector3& normal,
                                     double angle) {
  const std::string box = component::row("box", index);
  if (index < 0 || index >= getSize()) refuse(box + ": there are " + std::to_string(getSize()));
  refuse(outside_domain(box, Box{min, max}));
  refuse(outside_domain(box + ".normal", normal));
  refuse(outside_domain(box + ".angle", angle));
  min_.set(index, min);
  max_.set(index, max);
  cone_axis_.set(index, normal);
  cone_angle_[static_cast<std::size_t>(index)] = angle;
}

}  // namespace contact::inline CONTACT_ABI
