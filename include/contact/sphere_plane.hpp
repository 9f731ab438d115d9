// Sphere against plane: the exact decision and the correctly rounded contact.
#pragma once

#include <optional>

#include "contact/contact.hpp"
#include "contact/geometry.hpp"
#include "contact/plain_cores.hpp"

namespace contact::inline CONTACT_ABI {

/// Whether a sphere and the half-space below a plane are within the alarm distance of each other.
///   s = (b.normal . a.center - b.offset) / |b.normal|, negative below the plane     reach = alarm + a.radius
/// Units       one length unit for a and alarm; b.offset is of that times the unit of b.normal, whatever that is.
/// Domain      finite; the normal not zero, and of any length; radius and alarm >= 0. Subnormals and the largest finite
///             numbers are included.
/// Decision    s <= reach, exactly: touching counts, and whatever is below the plane hits.
/// Environment as test_sphere_sphere.
/// Source      docs/specification.md#planes.
/// Evidence    src/kernel/plane_test.cpp; proptests/production_properties.cpp.
[[nodiscard]] bool test_sphere_plane(const Ball& a, const Plane& b, double alarm);

/// The contact of a sphere with a plane, or std::nullopt if they are farther apart than `distances.alarm`.
///   normal = -b.normal / |b.normal|           value = s - a.radius - distances.contact
///   point1 = a.center + a.radius normal       point2 = a.center + s normal, on the plane    (nearest_surface)
/// Units       as test_sphere_plane; the normal is a unit vector from the sphere into the half-space.
/// Domain      as test_sphere_plane; contact distance >= 0.
/// Decision    as test_sphere_plane.
/// Error       as compute_sphere_sphere.
/// Degenerate  never: on the plane and below it the normal and the formulas are the same.
/// Points      `center` puts the first at a.center, `far_surface` on the far side of the sphere; the second stays.
/// Environment as test_sphere_plane.
/// Source      docs/specification.md#planes.
/// Evidence    src/kernel/plane_test.cpp; proptests/production_properties.cpp; golden/sphere_plane.
[[nodiscard]] std::optional<Contact> compute_sphere_plane(const Ball& a, const Plane& b, Distances distances,
                                                          ContactPoints points = {});

namespace out_of_line {
/// The same, all of it in the library: no exception is raised, and none traps.
[[nodiscard]] bool test_sphere_plane(const Ball& a, const Plane& b, double alarm);
[[nodiscard]] std::optional<Contact> compute_sphere_plane(const Ball& a, const Plane& b, Distances distances,
                                                          ContactPoints points = {});
}  // namespace out_of_line

namespace of_hit {
/// The contact of a pair that plain_decision::filter_pair says is a hit.
[[nodiscard]] std::optional<Contact> compute_sphere_plane(const Ball& a, const Plane& b, Distances distances,
                                                          ContactPoints points);
}  // namespace of_hit

#if CONTACT_DECIDES_INLINE
CONTACT_INLINE bool test_sphere_plane(const Ball& a, const Plane& b, double alarm) {
  return plain_decision::decided<out_of_line::test_sphere_plane>(plain_decision::filter_pair(a, b, alarm), a, b, alarm);
}
CONTACT_INLINE std::optional<Contact> compute_sphere_plane(const Ball& a, const Plane& b, Distances distances,
                                                           ContactPoints points) {
  const plain_decision::Filtered filtered = plain_decision::filter_pair(a, b, distances.alarm);
  if (filtered == plain_decision::Filtered::miss) return std::nullopt;
  if (filtered == plain_decision::Filtered::hit) return of_hit::compute_sphere_plane(a, b, distances, points);
  return out_of_line::compute_sphere_plane(a, b, distances, points);
}
#endif

}  // namespace contact::inline CONTACT_ABI
