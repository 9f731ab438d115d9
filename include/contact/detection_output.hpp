// What collision detection writes: one contact between two elements.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "contact/collision_model.hpp"

namespace contact {

/// One contact. `point[0]` and `elem.first` belong to the first model, `normal` is a unit vector from it to the second.
struct DetectionOutput {
  using ContactId = std::int64_t;

  std::pair<CollisionElement, CollisionElement> elem;
  ContactId id;                  ///< contact_id of the pair, unless an intersector numbers its contacts otherwise
  std::array<Vector3, 2> point;  ///< world coordinates
  Vector3 normal;
  double value;       ///< signed distance of the surfaces, less the contact distance
  double deltaT = 0;  ///< time of contact; discrete detection knows none
};

using OutputVector = std::vector<DetectionOutput>;

/// SOFA's number of a contact: the element's index in the larger model, in the second where both are of one size. An
/// element of the larger model that meets two of the smaller gives both contacts the same number.
[[nodiscard]] DetectionOutput::ContactId contact_id(const CollisionElement& first, const CollisionElement& second);

/// The same contact seen from the other model: elements and points exchanged, the normal turned round (zeros stay +0),
/// and the number of a pair that contact_id had numbered is contact_id's again.
[[nodiscard]] DetectionOutput mirrored(const DetectionOutput& output);

}  // namespace contact
