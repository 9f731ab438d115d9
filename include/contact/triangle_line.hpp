// Triangle against line: where a segment crosses a triangle.
#pragma once

#include <optional>

#include "contact/contact.hpp"
#include "contact/geometry.hpp"
#include "contact/plain_cores.hpp"

namespace contact::inline CONTACT_ABI {

/// Whether a segment, which SOFA calls a line, crosses a triangle: X = b.start + t (b.end - b.start) with 0 <= t <= 1
/// lies in it.
///   N = (v1 - v0) x (v2 - v0)     crossing where N . (b.end - b.start) is not 0, the ends and the boundary included
/// Units       any one length unit.
/// Domain      finite. Triangles without an inside and lines of length 0 are included, subnormals and the largest
///             finite numbers too.
/// Decision    exact. A line along the plane of the triangle does not cross it, nor does one of length 0; a triangle
///             without an inside is not crossed. Alarm and contact distances have no say.
/// Environment as test_sphere_sphere.
/// Source      docs/specification.md#crossings.
/// Evidence    src/kernel/crossing_test.cpp; proptests/production_properties.cpp.
[[nodiscard]] bool test_triangle_line(const Triangle& a, const Line& b);

/// The contact of a triangle and a segment that crosses it, or std::nullopt.
///   normal = N / |N|     point1 = point2 = X     value = 0
/// Units       as test_triangle_line; the normal is a unit vector.
/// Domain      as test_triangle_line.
/// Decision    as test_triangle_line.
/// Error       every number is the exact real rounded once to nearest, ties to even (0.5 ulp). Every zero is +0.
/// Normal      by the order of the vertices, from whichever side the line comes.
/// Environment as test_triangle_line.
/// Source      docs/specification.md#crossings.
/// Evidence    src/kernel/crossing_test.cpp; proptests/production_properties.cpp; golden/triangle_line.
[[nodiscard]] std::optional<Contact> compute_triangle_line(const Triangle& a, const Line& b);

namespace out_of_line {
/// The same, all of it in the library: no exception is raised, and none traps.
[[nodiscard]] bool test_triangle_line(const Triangle& a, const Line& b);
[[nodiscard]] std::optional<Contact> compute_triangle_line(const Triangle& a, const Line& b);
}  // namespace out_of_line

namespace of_hit {
/// The contact of a pair that plain_decision::filter_pair says is a hit.
[[nodiscard]] std::optional<Contact> compute_triangle_line(const Triangle& a, const Line& b);
}  // namespace of_hit

#if CONTACT_DECIDES_INLINE
CONTACT_INLINE bool test_triangle_line(const Triangle& a, const Line& b) {
  return plain_decision::decided<out_of_line::test_triangle_line>(plain_decision::filter_pair(a, b), a, b);
}
CONTACT_INLINE std::optional<Contact> compute_triangle_line(const Triangle& a, const Line& b) {
  const plain_decision::Filtered filtered = plain_decision::filter_pair(a, b);
  if (filtered == plain_decision::Filtered::miss) return std::nullopt;
  if (filtered == plain_decision::Filtered::hit) return of_hit::compute_triangle_line(a, b);
  return out_of_line::compute_triangle_line(a, b);
}
#endif

}  // namespace contact::inline CONTACT_ABI
