// Capsule against plane: the exact decision and the correctly rounded contact.
#pragma once

#include <optional>

#include "contact/contact.hpp"
#include "contact/geometry.hpp"
#include "contact/plain_cores.hpp"

namespace contact::inline CONTACT_ABI {

/// Whether a capsule and the half-space below a plane are within the alarm distance of each other.
///   p = the end of the capsule's axis with the lower b.normal . p
///   s = (b.normal . p - b.offset) / |b.normal|, negative below the plane     reach = alarm + a.radius
/// Units       as test_sphere_plane.
/// Domain      finite; the normal not zero, and of any length; radius and alarm >= 0. Capsules of length 0, subnormals
///             and the largest finite numbers are included.
/// Decision    s <= reach, exactly, and exactly which end is lower: touching counts, and whatever is below the plane
///             hits.
/// Environment as test_sphere_sphere.
/// Source      docs/specification.md#planes.
/// Evidence    src/kernel/plane_test.cpp; proptests/production_properties.cpp.
[[nodiscard]] bool test_capsule_plane(const Capsule& a, const Plane& b, double alarm);

/// The contact of a capsule with a plane, or std::nullopt if they are farther apart than `distances.alarm`.
///   normal = -b.normal / |b.normal|           value = s - a.radius - distances.contact
///   point1 = p + a.radius normal              point2 = p + s normal, on the plane           (nearest_surface)
/// Units       as test_capsule_plane; the normal is a unit vector from the capsule into the half-space.
/// Domain      as test_capsule_plane; contact distance >= 0.
/// Decision    as test_capsule_plane.
/// Error       as compute_sphere_sphere.
/// Unique      not where the capsule is parallel to the plane and its length above 0: every point of the axis is as
///             low, and p is the middle, (a.start + a.end) / 2, which is not rounded.
/// Degenerate  never: on the plane and below it the normal and the formulas are the same.
/// Points      `center` puts the first at p, `far_surface` on the far side of the capsule; the second stays.
/// Environment as test_capsule_plane.
/// Source      docs/specification.md#planes.
/// Evidence    src/kernel/plane_test.cpp; proptests/production_properties.cpp; golden/capsule_plane.
[[nodiscard]] std::optional<Contact> compute_capsule_plane(const Capsule& a, const Plane& b, Distances distances,
                                                           ContactPoints points = {});

namespace out_of_line {
/// The same, all of it in the library: no exception is raised, and none traps.
[[nodiscard]] bool test_capsule_plane(const Capsule& a, const Plane& b, double alarm);
[[nodiscard]] std::optional<Contact> compute_capsule_plane(const Capsule& a, const Plane& b, Distances distances,
                                                           ContactPoints points = {});
}  // namespace out_of_line

namespace of_hit {
/// The contact of a pair that plain_decision::filter_pair says is a hit.
[[nodiscard]] std::optional<Contact> compute_capsule_plane(const Capsule& a, const Plane& b, Distances distances,
                                                           ContactPoints points);
}  // namespace of_hit

#if CONTACT_DECIDES_INLINE
CONTACT_INLINE bool test_capsule_plane(const Capsule& a, const Plane& b, double alarm) {
  return plain_decision::decided<out_of_line::test_capsule_plane>(plain_decision::filter_pair(a, b, alarm), a, b,
                                                                  alarm);
}
CONTACT_INLINE std::optional<Contact> compute_capsule_plane(const Capsule& a, const Plane& b, Distances distances,
                                                            ContactPoints points) {
  const plain_decision::Filtered filtered = plain_decision::filter_pair(a, b, distances.alarm);
  if (filtered == plain_decision::Filtered::miss) return std::nullopt;
  if (filtered == plain_decision::Filtered::hit) return of_hit::compute_capsule_plane(a, b, distances, points);
  return out_of_line::compute_capsule_plane(a, b, distances, points);
}
#endif

}  // namespace contact::inline CONTACT_ABI
