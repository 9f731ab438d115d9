// What collision detection writes: its numbering, and the same seen from the other side.
#include "contact/detection_output.hpp"

#include <bit>

namespace contact::inline CONTACT_ABI {

ContactId contact_id(const CollisionElement& first, const CollisionElement& second) {
  ContactId id(first.getCollisionModel().getSize() > second.getCollisionModel().getSize() ? first.getIndex()
                                                                                          : second.getIndex());
  id.of_pair_ = true;
  return id;
}

DetectionOutput mirrored(const DetectionOutput& output) {
  const auto& [first, second] = output.elem;
  DetectionOutput mirror = output;
  mirror.elem = {second, first};
  mirror.point = {output.point[1], output.point[0]};
  for (int axis = 0; axis < 3;
       ++axis) {  // by bits: a comparison would take a subnormal number for 0 where these are flushed
    const auto bits = std::bit_cast<std::uint64_t>(output.normal[axis]);
    mirror.normal[axis] = bits << 1 == 0 ? 0.0 : std::bit_cast<double>(bits ^ std::uint64_t{1} << 63);
  }
  if (output.id.is_of_pair()) mirror.id = contact_id(second, first);
  return mirror;
}

}  // namespace contact::inline CONTACT_ABI
