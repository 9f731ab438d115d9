// Capsule against capsule: the exact decision and the correctly rounded contact.
#pragma once

#include <optional>

#include "contact/contact.hpp"
#include "contact/geometry.hpp"
#include "contact/plain_cores.hpp"

namespace contact::inline CONTACT_ABI {

/// Whether two capsules are within the alarm distance of each other.
///   p, q = nearest points of their axes     D = |q - p|^2     reach = alarm + a.radius + b.radius
/// Units       one length unit throughout.
/// Domain      finite; radii and alarm >= 0. Capsules of length 0, subnormals and the largest finite numbers are
///             included.
/// Decision    D <= reach^2, exactly: touching counts.
/// Environment as test_sphere_sphere.
/// Source      docs/specification.md#capsule-pairs.
/// Evidence    src/kernel/capsule_test.cpp; proptests/production_properties.cpp.
[[nodiscard]] bool test_capsule_capsule(const Capsule& a, const Capsule& b, double alarm);

/// The contact of two capsules, or std::nullopt if they are farther apart than `distances.alarm`.
///   normal = (q - p) / sqrt(D)        value = sqrt(D) - (a.radius + b.radius) - distances.contact
///   point1 = p + a.radius normal      point2 = q - b.radius normal                          (nearest_surface)
/// Units       one length unit throughout; the normal is a unit vector from a to b.
/// Domain      as test_capsule_capsule; contact distance >= 0.
/// Decision    as test_capsule_capsule.
/// Error       as compute_sphere_sphere.
/// Unique      false where many points are nearest: parallel axes side by side along more than a point. Then p is the
///             middle of all such points of a's axis, and q the point across.
/// Degenerate  D = 0, the axes meet: with u = a.end - a.start and v = b.end - b.start the normal is u x v of length 1,
///             its first component other than 0 positive; where u x v = 0 the x axis made perpendicular to the first
///             of u and v that is not 0, as compute_sphere_capsule says.
/// Points      `center` puts them at p and q, `far_surface` on the far side.
/// Environment as test_capsule_capsule.
/// Source      docs/specification.md#capsule-pairs.
/// Evidence    src/kernel/capsule_test.cpp; proptests/production_properties.cpp; golden/capsule_capsule.
[[nodiscard]] std::optional<Contact> compute_capsule_capsule(const Capsule& a, const Capsule& b, Distances distances,
                                                             ContactPoints points = {});

namespace out_of_line {
/// The same, all of it in the library: no exception is raised, and none traps.
[[nodiscard]] bool test_capsule_capsule(const Capsule& a, const Capsule& b, double alarm);
[[nodiscard]] std::optional<Contact> compute_capsule_capsule(const Capsule& a, const Capsule& b, Distances distances,
                                                             ContactPoints points = {});
}  // namespace out_of_line

#if CONTACT_DECIDES_INLINE
CONTACT_INLINE bool test_capsule_capsule(const Capsule& a, const Capsule& b, double alarm) {
  return plain_decision::decided<out_of_line::test_capsule_capsule>(plain_decision::filter_pair(a, b, alarm), a, b,
                                                                    alarm);
}
CONTACT_INLINE std::optional<Contact> compute_capsule_capsule(const Capsule& a, const Capsule& b, Distances distances,
                                                              ContactPoints points) {
  if (plain_decision::filter_pair(a, b, distances.alarm) == plain_decision::Filtered::miss) return std::nullopt;
  return out_of_line::compute_capsule_capsule(a, b, distances, points);
}
#endif

}  // namespace contact::inline CONTACT_ABI
