// Rays cast at shapes: where a ray first hits a sphere, a box, a capsule, a triangle or a half-space.
#pragma once

#include <optional>

#include "contact/contact.hpp"
#include "contact/geometry.hpp"

namespace contact::inline CONTACT_ABI {

/// Whether a ray hits a solid shape: X = a.origin + t a.direction lies in it for some t with 0 <= t <= a.length.
/// Units       any one length unit; t and a.length count directions.
/// Domain      finite; the direction not zero, and of any length; a.length and radii >= 0. Rays of length 0, boxes and
///             capsules without an extent, triangles without an inside are included, subnormals and the largest finite
///             numbers too.
/// Decision    exact. A shape has its boundary: what touches it hits it, and so does what begins or ends on it. A ray
///             in the plane of a triangle hits its edge. Triangles have no side from which they are not seen.
/// Environment any rounding mode, flush-to-zero and denormals-are-zero: the answer is the same.
/// Source      docs/specification.md#ray-casts.
/// Evidence    src/kernel/casts_test.cpp; proptests/production_properties.cpp.
[[nodiscard]] bool test_cast_sphere(const Ray& a, const Ball& b);
[[nodiscard]] bool test_cast_cube(const Ray& a, const Box& b);
[[nodiscard]] bool test_cast_capsule(const Ray& a, const Capsule& b);
[[nodiscard]] bool test_cast_triangle(const Ray& a, const Triangle& b);
[[nodiscard]] bool test_cast_plane(const Ray& a, const Plane& b);

/// The first hit of a ray, or std::nullopt.
///   value = the least t     point1 = point2 = X there     normal = the shape's outward unit normal at X
/// Units       as the tests; the value counts directions, and the normal is a unit vector.
/// Domain      as the tests.
/// Decision    as the tests.
/// Error       every number is the exact real rounded once to nearest, ties to even (0.5 ulp); beyond the largest
///             finite number it is infinite, as IEEE 754 rounds. Every zero is +0.
/// Normal      where several are right, on edges, on corners, on either side of a triangle: each divided by the sum of
///             the absolute values of its components, the one that is lexicographically greatest.
/// Degenerate  the origin lies in the shape: value 0, the points at the origin, the normal against the direction.
/// Environment as the tests.
/// Source      docs/specification.md#ray-casts.
/// Evidence    src/kernel/casts_test.cpp; proptests/production_properties.cpp; golden/cast_sphere and its like.
[[nodiscard]] std::optional<Contact> compute_cast_sphere(const Ray& a, const Ball& b);
[[nodiscard]] std::optional<Contact> compute_cast_cube(const Ray& a, const Box& b);
[[nodiscard]] std::optional<Contact> compute_cast_capsule(const Ray& a, const Capsule& b);
[[nodiscard]] std::optional<Contact> compute_cast_triangle(const Ray& a, const Triangle& b);
[[nodiscard]] std::optional<Contact> compute_cast_plane(const Ray& a, const Plane& b);

}  // namespace contact::inline CONTACT_ABI
