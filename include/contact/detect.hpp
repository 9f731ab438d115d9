// Detection between whole models.
#pragma once

#include <optional>

#include "contact/intersection.hpp"

namespace contact {

/// Every contact between the elements of two models, or nothing where `intersection` has no intersector for them
/// (which is not the same as no contact). `intersection` also supplies the distances.
///
/// Sides       point[0] and elem.first belong to `model1` and the normal points from it, whichever way round the
///             intersector takes the two.
/// Order       by the index in model1, then the index in model2, then as the intersector wrote them; what it writes in
///             beginIntersect comes first, what it writes in endIntersect last. Addresses play no part.
/// Candidates  the pairs whose bounding boxes lie within the alarm distance on every axis, from a spatial index: nearly
///             linear time where each element is near a bounded number of others. Each candidate is put to
///             canIntersect, then to intersect.
/// Throws      std::invalid_argument where a distance of `intersection` is negative or not finite.
/// Evidence    src/component/detect_test.cpp; bench/detect.cpp.
[[nodiscard]] std::optional<OutputVector> detect(const Intersection& intersection, const CollisionModel& model1,
                                                 const CollisionModel& model2);

/// Every contact of a model with itself: each pair of different elements once, the lower index first.
[[nodiscard]] std::optional<OutputVector> detect(const Intersection& intersection, const CollisionModel& model);

}  // namespace contact
