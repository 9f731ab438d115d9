// The capsule model.
#include "contact/capsule_model.hpp"

#include "component/columns.hpp"
#include "contact/shape_intersectors.hpp"
#include "kernel/floating_point_environment.hpp"

namespace contact::inline CONTACT_ABI {
namespace {

/// Here, so that no linker leaves it out of a program that has capsules.
const IntersectorCreator<CapsuleDiscreteIntersection> capsule_intersectors("Capsule");

[[gnu::noinline]] Box box_around_both(Box box, const Box& other) {
  for (int axis = 0; axis < 3; ++axis) {
    if (other.min[axis] < box.min[axis]) box.min[axis] = other.min[axis];
    if (other.max[axis] > box.max[axis]) box.max[axis] = other.max[axis];
  }
  return box;
}

}  // namespace

Box box_around(const Capsule& capsule) {
  const kernel::RoundToNearest environment;
  return box_around_both(box_around(Ball{capsule.start, capsule.radius}),
                         box_around(Ball{capsule.end, capsule.radius}));
}

CapsuleCollisionModel::CapsuleCollisionModel(std::string name, Rows<3> starts, Rows<3> ends, Rows<1> radii)
    : ModelOf(std::move(name)), starts_(std::move(starts)), ends_(std::move(ends)), radii_(std::move(radii)) {
  refuse(component::not_finite("starts", starts_));
  refuse(component::not_finite("ends", ends_));
  refuse(component::wrong_length("ends", ends_.rows(), "starts", starts_.rows()));
  refuse(component::wrong_length("radii", radii_.rows(), "starts", starts_.rows()));
  refuse(component::not_a_length("radii", radii_));
}

Box CapsuleCollisionModel::bounding_box(Index index) const { return box_around(capsule(index)); }

void CapsuleCollisionModel::setEnds(Rows<3> starts, Rows<3> ends) {
  refuse(component::not_finite("starts", starts));
  refuse(component::not_finite("ends", ends));
  refuse(component::wrong_length("starts", starts.rows(), "radii", getSize()));
  refuse(component::wrong_length("ends", ends.rows(), "radii", getSize()));
  starts_ = std::move(starts);
  ends_ = std::move(ends);
}

}  // namespace contact::inline CONTACT_ABI
