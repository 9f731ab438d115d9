// Sphere against triangle: the exact decision and the correctly rounded contact.
#pragma once

#include <optional>

#include "contact/contact.hpp"
#include "contact/geometry.hpp"
#include "contact/plain_cores.hpp"

namespace contact::inline CONTACT_ABI {

/// Whether a sphere and a triangle are within the alarm distance of each other.
///   q = the point of the triangle nearest to a.center     D = |q - a.center|^2     reach = alarm + a.radius
/// Units       one length unit throughout.
/// Domain      finite; radius and alarm >= 0. Triangles whose vertices lie on a line or on one point, subnormals and
///             the largest finite numbers are included.
/// Decision    D <= reach^2, exactly: touching counts.
/// Environment as test_sphere_sphere.
/// Source      docs/specification.md#triangles.
/// Evidence    src/kernel/triangle_test.cpp; proptests/production_properties.cpp.
[[nodiscard]] bool test_sphere_triangle(const Ball& a, const Triangle& b, double alarm);

/// The contact of a sphere with a triangle, or std::nullopt if they are farther apart than `distances.alarm`.
///   normal = (q - a.center) / sqrt(D)     value = sqrt(D) - a.radius - distances.contact
///   point1 = a.center + a.radius normal   point2 = q                                       (nearest_surface)
/// Units       one length unit throughout; the normal is a unit vector from the sphere to the triangle, on whichever
///             side the sphere is: a triangle has two, and the order of its vertices says nothing.
/// Domain      as test_sphere_triangle; contact distance >= 0.
/// Decision    as test_sphere_triangle.
/// Error       as compute_sphere_sphere.
/// Degenerate  D = 0, the centre on the triangle: the normal is that of N = (v1 - v0) x (v2 - v0) or -N whose first
///             component other than 0 is positive. Where N = 0, as compute_sphere_capsule has it with u = v1 - v0, or
///             v2 - v0 where that is 0.
/// Points      `center` puts them at a.center and q, `far_surface` on the far side of the sphere.
/// Environment as test_sphere_triangle.
/// Source      docs/specification.md#triangles.
/// Evidence    src/kernel/triangle_test.cpp; proptests/production_properties.cpp; golden/sphere_triangle.
[[nodiscard]] std::optional<Contact> compute_sphere_triangle(const Ball& a, const Triangle& b, Distances distances,
                                                             ContactPoints points = {});

namespace out_of_line {
/// The same, all of it in the library: no exception is raised, and none traps.
[[nodiscard]] bool test_sphere_triangle(const Ball& a, const Triangle& b, double alarm);
[[nodiscard]] std::optional<Contact> compute_sphere_triangle(const Ball& a, const Triangle& b, Distances distances,
                                                             ContactPoints points = {});
}  // namespace out_of_line

#if CONTACT_DECIDES_INLINE
CONTACT_INLINE bool test_sphere_triangle(const Ball& a, const Triangle& b, double alarm) {
  return plain_decision::decided<out_of_line::test_sphere_triangle>(plain_decision::filter_pair(a, b, alarm), a, b,
                                                                    alarm);
}
CONTACT_INLINE std::optional<Contact> compute_sphere_triangle(const Ball& a, const Triangle& b, Distances distances,
                                                              ContactPoints points) {
  if (plain_decision::filter_pair(a, b, distances.alarm) == plain_decision::Filtered::miss) return std::nullopt;
  return out_of_line::compute_sphere_triangle(a, b, distances, points);
}
#endif

}  // namespace contact::inline CONTACT_ABI
