// Detection between whole models.
#pragma once

#include <optional>

#include "contact/intersection.hpp"

namespace contact::inline CONTACT_ABI {

/// Every contact between the elements of two models. The result is std::nullopt if `intersection` has no intersector
/// for them, which is not the same as an empty vector of contacts. `intersection` also supplies the distances.
///
/// Sides       point[0] and elem.first belong to `model1` and the normal points away from it, in whichever order the
///             intersector takes the two models.
/// Order       by the index in model1, then by the index in model2, then as the intersector wrote them. Contacts from
///             beginIntersect come first, contacts from endIntersect last. The order does not depend on addresses.
/// Candidates  the pairs whose bounding boxes lie within the alarm distance on every axis. A spatial index finds
///             them, in nearly linear time if each element is near a bounded number of others. canIntersect is asked
///             about each candidate, then intersect.
/// Throws      std::invalid_argument if a distance of `intersection` is negative or not finite; std::logic_error if a
///             model's bounding box has a NaN or min > max, or if an intersector wrote a different number of contacts
///             than it returned.
/// Environment any, as for the functions of one pair. Models and intersectors are called in the default environment, so
///             a plug-in's results do not depend on the caller's environment, and a plug-in does not trap.
/// Evidence    src/component/detect_test.cpp; bench/detect.cpp.
[[nodiscard]] std::optional<OutputVector> detect(const Intersection& intersection, const CollisionModel& model1,
                                                 const CollisionModel& model2);

/// Every contact of a model with itself: each pair of different elements once, the lower index first.
[[nodiscard]] std::optional<OutputVector> detect(const Intersection& intersection, const CollisionModel& model);

}  // namespace contact::inline CONTACT_ABI
