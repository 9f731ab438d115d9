// What collision detection writes: one contact between two elements.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "contact/collision_model.hpp"

namespace contact::inline CONTACT_ABI {

/// A contact's number, and whether contact_id gave it or an intersector that numbers its contacts in another way.
class ContactId {
 public:
  ContactId(std::int64_t number) : number_(number) {}  // NOLINT(google-explicit-constructor): a number is one
  operator std::int64_t() const { return number_; }    // NOLINT(google-explicit-constructor)

  /// Whether contact_id gave the number. Copies keep this; a ContactId made from a plain integer does not have it.
  [[nodiscard]] bool is_of_pair() const { return of_pair_; }

 private:
  friend ContactId contact_id(const CollisionElement& first, const CollisionElement& second);

  std::int64_t number_;
  bool of_pair_ = false;
};

/// One contact. `point[0]` and `elem.first` belong to the first model, `normal` is a unit vector from it to the second.
struct DetectionOutput {
  using ContactId = contact::ContactId;

  std::pair<CollisionElement, CollisionElement> elem;
  ContactId id;                  ///< contact_id of the pair, unless an intersector numbers its contacts in another way
  std::array<Vector3, 2> point;  ///< world coordinates
  Vector3 normal;
  double value;       ///< signed distance of the surfaces, less the contact distance
  double deltaT = 0;  ///< time of contact; discrete detection knows none
};

using OutputVector = std::vector<DetectionOutput>;

/// SOFA's number of a contact: the index of the element of the larger model, or of the second model if both have the
/// same size. If an element of the larger model meets two elements of the smaller one, these contacts share a number.
[[nodiscard]] ContactId contact_id(const CollisionElement& first, const CollisionElement& second);

/// The same contact seen from the other model: elements and points are exchanged and the normal is reversed (zeros stay
/// +0). A number that contact_id gave is computed again for the new order; an intersector's own number stays.
[[nodiscard]] DetectionOutput mirrored(const DetectionOutput& output);

}  // namespace contact::inline CONTACT_ABI
