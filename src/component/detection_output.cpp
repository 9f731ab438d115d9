// What collision detection writes: its numbering, and the same seen from the other side.
#include "contact/detection_output.hpp"

namespace contact {

DetectionOutput::ContactId contact_id(const CollisionElement& first, const CollisionElement& second) {
  return first.getCollisionModel().getSize() > second.getCollisionModel().getSize() ? first.getIndex()
                                                                                    : second.getIndex();
}

DetectionOutput mirrored(const DetectionOutput& output) {
  const auto& [first, second] = output.elem;
  DetectionOutput mirror = output;
  mirror.elem = {second, first};
  mirror.point = {output.point[1], output.point[0]};
  for (int axis = 0; axis < 3; ++axis) mirror.normal[axis] = output.normal[axis] == 0 ? 0.0 : -output.normal[axis];
  if (output.id == contact_id(first, second)) mirror.id = contact_id(second, first);
  return mirror;
}

}  // namespace contact
