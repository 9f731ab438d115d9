// Ray against triangle: where the one crosses the other.
#pragma once

#include <optional>

#include "contact/contact.hpp"
#include "contact/geometry.hpp"
#include "contact/plain_cores.hpp"

namespace contact::inline CONTACT_ABI {

/// Whether a ray crosses a triangle: X = a.origin + t a.direction with 0 <= t <= a.length lies in it.
///   N = (v1 - v0) x (v2 - v0)     crossing where N . a.direction is not 0, the ends and the boundary included
/// Units       any one length unit; a.length counts directions.
/// Domain      finite; the direction not zero, and of any length; a.length >= 0. Triangles without an inside and rays
///             of length 0 are included, subnormals and the largest finite numbers too.
/// Decision    exact. A ray along the plane of the triangle does not cross it, nor does one of length 0; a triangle
///             without an inside is not crossed. Alarm and contact distances have no say.
/// Environment as test_sphere_sphere.
/// Source      docs/specification.md#crossings.
/// Evidence    src/kernel/crossing_test.cpp; proptests/production_properties.cpp.
[[nodiscard]] bool test_ray_triangle(const Ray& a, const Triangle& b);

/// The contact of a ray and a triangle that it crosses, or std::nullopt.
///   normal = -N / |N|     point1 = point2 = X     value = 0
/// Units       as test_ray_triangle; the normal is a unit vector.
/// Domain      as test_ray_triangle.
/// Decision    as test_ray_triangle.
/// Error       every number is the exact real rounded once to nearest, ties to even (0.5 ulp). Every zero is +0.
/// Normal      by the order of the vertices, from whichever side the ray comes.
/// Environment as test_ray_triangle.
/// Source      docs/specification.md#crossings.
/// Evidence    src/kernel/crossing_test.cpp; proptests/production_properties.cpp; golden/ray_triangle.
[[nodiscard]] std::optional<Contact> compute_ray_triangle(const Ray& a, const Triangle& b);

namespace out_of_line {
/// The same, all of it in the library: no exception is raised, and none traps.
[[nodiscard]] bool test_ray_triangle(const Ray& a, const Triangle& b);
[[nodiscard]] std::optional<Contact> compute_ray_triangle(const Ray& a, const Triangle& b);
}  // namespace out_of_line

namespace of_hit {
/// The contact of a pair that plain_decision::filter_pair says is a hit.
[[nodiscard]] std::optional<Contact> compute_ray_triangle(const Ray& a, const Triangle& b);
}  // namespace of_hit

#if CONTACT_DECIDES_INLINE
CONTACT_INLINE bool test_ray_triangle(const Ray& a, const Triangle& b) {
  return plain_decision::decided<out_of_line::test_ray_triangle>(plain_decision::filter_pair(a, b), a, b);
}
CONTACT_INLINE std::optional<Contact> compute_ray_triangle(const Ray& a, const Triangle& b) {
  const plain_decision::Filtered filtered = plain_decision::filter_pair(a, b);
  if (filtered == plain_decision::Filtered::miss) return std::nullopt;
  if (filtered == plain_decision::Filtered::hit) return of_hit::compute_ray_triangle(a, b);
  return out_of_line::compute_ray_triangle(a, b);
}
#endif

}  // namespace contact::inline CONTACT_ABI
