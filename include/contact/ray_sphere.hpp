// Ray against sphere: the exact decision and the correctly rounded contact.
#pragma once

#include <optional>

#include "contact/contact.hpp"
#include "contact/geometry.hpp"
#include "contact/plain_cores.hpp"

namespace contact::inline CONTACT_ABI {

/// Whether a ray and a sphere are within the alarm distance of each other.
///   p = the point nearest to b.center of the segment from a.origin to a.origin + a.length a.direction
///   D = |b.center - p|^2     reach = alarm + b.radius
/// Units       one length unit for a.origin, the sphere and the distances; a.length counts directions, which need not
///             be of length 1.
/// Domain      finite; the direction not zero; length, radius and alarm >= 0. Subnormals and the largest finite numbers
///             are included: the ray's end need not be a number.
/// Decision    D <= reach^2, exactly: touching counts. The end of the ray is not rounded.
/// Environment as test_sphere_sphere.
/// Source      docs/specification.md#rays.
/// Evidence    src/kernel/ray_test.cpp; proptests/production_properties.cpp.
[[nodiscard]] bool test_ray_sphere(const Ray& a, const Ball& b, double alarm);

/// The contact of a ray with a sphere, or std::nullopt if they are farther apart than `distances.alarm`: that of a
/// capsule of radius 0 with it.
///   normal = (b.center - p) / sqrt(D)     value = sqrt(D) - b.radius - distances.contact
///   point1 = p                            point2 = b.center - b.radius normal              (nearest_surface)
/// Units       as test_ray_sphere; the normal is a unit vector from the ray to the sphere's centre.
/// Domain      as test_ray_sphere; contact distance >= 0.
/// Decision    as test_ray_sphere.
/// Error       as compute_sphere_sphere.
/// Degenerate  D = 0, the centre on the ray: as compute_sphere_capsule has it with u = a.length a.direction.
/// Points      `center` puts them at p and b.center, `far_surface` on the far side of the sphere.
/// Environment as test_ray_sphere.
/// Source      docs/specification.md#rays.
/// Evidence    src/kernel/ray_test.cpp; proptests/production_properties.cpp; golden/ray_sphere.
[[nodiscard]] std::optional<Contact> compute_ray_sphere(const Ray& a, const Ball& b, Distances distances,
                                                        ContactPoints points = {});

namespace out_of_line {
/// The same, all of it in the library: no exception is raised, and none traps.
[[nodiscard]] bool test_ray_sphere(const Ray& a, const Ball& b, double alarm);
[[nodiscard]] std::optional<Contact> compute_ray_sphere(const Ray& a, const Ball& b, Distances distances,
                                                        ContactPoints points = {});
}  // namespace out_of_line

#if CONTACT_DECIDES_INLINE
CONTACT_INLINE bool test_ray_sphere(const Ray& a, const Ball& b, double alarm) {
  return plain_decision::decided<out_of_line::test_ray_sphere>(plain_decision::filter_pair(a, b, alarm), a, b, alarm);
}
CONTACT_INLINE std::optional<Contact> compute_ray_sphere(const Ray& a, const Ball& b, Distances distances,
                                                         ContactPoints points) {
  if (plain_decision::filter_pair(a, b, distances.alarm) == plain_decision::Filtered::miss) return std::nullopt;
  return out_of_line::compute_ray_sphere(a, b, distances, points);
}
#endif

}  // namespace contact::inline CONTACT_ABI
