// Detection between whole models.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>

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
/// Domain      fewer than 2^32 elements a model: std::length_error otherwise.
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

/// Calls work(0) .. work(count - 1), each once, in any order and on any threads, and returns when all have returned. It
/// may leave out those that are left once one has thrown; then it throws such an exception.
using ParallelFor = std::function<void(std::size_t count, const std::function<void(std::size_t)>& work)>;

/// Receives contacts that follow each other, in some vectors.
using TakeContacts = std::function<void(std::span<const OutputVector> contacts)>;

/// Gives the contacts of detect(intersection, model1, model2) to `take` as they are found, in the order of detect and
/// with the same bits, and keeps none of them. False if `intersection` has no intersector for the models.
///
/// Threads     `take` is called on the caller's thread, not on several at once. With a `parallel_for` models and
///             intersectors are called in its work, on several threads at once if it has several. Neither it nor the
///             number of threads changes what `take` receives, but for how many contacts at a time.
/// Memory      about 150 bytes an element of both models, 64 MiB of candidates and 64 vectors of a thousand contacts,
///             however many contacts there are.
/// Interrupt   what `take`, `parallel_for` or its work throws ends the detection, and comes back.
/// endIntersect  gets an empty vector, not one with all contacts as from detect.
/// Evidence    src/component/detect_test.cpp, detect_scale_test.cpp; bench/detect.cpp.
bool detect_streamed(const Intersection& intersection, const CollisionModel& model1, const CollisionModel& model2,
                     const TakeContacts& take, const ParallelFor& parallel_for = {});

/// The same of a model with itself.
bool detect_streamed(const Intersection& intersection, const CollisionModel& model, const TakeContacts& take,
                     const ParallelFor& parallel_for = {});

}  // namespace contact::inline CONTACT_ABI
