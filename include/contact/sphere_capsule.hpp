// Sphere against capsule: the exact decision and the correctly rounded contact.
#pragma once

#include <optional>

#include "contact/contact.hpp"
#include "contact/geometry.hpp"
#include "contact/plain_cores.hpp"

namespace contact::inline CONTACT_ABI {

/// Whether a sphere and a capsule are within the alarm distance of each other.
///   q = the point of the capsule's axis nearest to a.center     D = |q - a.center|^2
///   reach = alarm + a.radius + b.radius
/// Units       one length unit throughout.
/// Domain      finite; radii and alarm >= 0. Capsules of length 0, subnormals and the largest finite numbers are
///             included.
/// Decision    D <= reach^2, exactly: touching counts.
/// Environment as test_sphere_sphere.
/// Source      docs/specification.md#capsule-pairs.
/// Evidence    src/kernel/capsule_test.cpp; proptests/production_properties.cpp.
[[nodiscard]] bool test_sphere_capsule(const Ball& a, const Capsule& b, double alarm);

/// The contact of a sphere with a capsule, or std::nullopt if they are farther apart than `distances.alarm`.
///   normal = (q - a.center) / sqrt(D)     value = sqrt(D) - (a.radius + b.radius) - distances.contact
///   point1 = a.center + a.radius normal   point2 = q - b.radius normal                      (nearest_surface)
/// Units       one length unit throughout; the normal is a unit vector from the sphere to the capsule.
/// Domain      as test_sphere_capsule; contact distance >= 0.
/// Decision    as test_sphere_capsule.
/// Error       as compute_sphere_sphere.
/// Degenerate  D = 0, the centre on the axis: the normal is the x axis made perpendicular to it, |u|^2 x - (u.x) u of
///             that length, u = end - start; the y axis where u is parallel to x; (1, 0, 0) where u = 0.
/// Points      `center` puts them at a.center and q, `far_surface` on the far side.
/// Environment as test_sphere_capsule.
/// Source      docs/specification.md#capsule-pairs.
/// Evidence    src/kernel/capsule_test.cpp; proptests/production_properties.cpp; golden/sphere_capsule.
[[nodiscard]] std::optional<Contact> compute_sphere_capsule(const Ball& a, const Capsule& b, Distances distances,
                                                            ContactPoints points = {});

namespace out_of_line {
/// The same, all of it in the library: no exception is raised, and none traps.
[[nodiscard]] bool test_sphere_capsule(const Ball& a, const Capsule& b, double alarm);
[[nodiscard]] std::optional<Contact> compute_sphere_capsule(const Ball& a, const Capsule& b, Distances distances,
                                                            ContactPoints points = {});
}  // namespace out_of_line

#if CONTACT_DECIDES_INLINE
CONTACT_INLINE bool test_sphere_capsule(const Ball& a, const Capsule& b, double alarm) {
  return plain_decision::decided<out_of_line::test_sphere_capsule>(plain_decision::filter_pair(a, b, alarm), a, b,
                                                                   alarm);
}
CONTACT_INLINE std::optional<Contact> compute_sphere_capsule(const Ball& a, const Capsule& b, Distances distances,
                                                             ContactPoints points) {
  if (plain_decision::filter_pair(a, b, distances.alarm) == plain_decision::Filtered::miss) return std::nullopt;
  return out_of_line::compute_sphere_capsule(a, b, distances, points);
}
#endif

}  // namespace contact::inline CONTACT_ABI
