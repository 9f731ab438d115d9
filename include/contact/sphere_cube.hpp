// Sphere against cube (an axis-aligned box): the exact decision and the correctly rounded contact.
#pragma once

#include <optional>

#include "contact/contact.hpp"
#include "contact/geometry.hpp"

namespace contact::inline CONTACT_ABI {

/// Whether a sphere and a solid box are within the alarm distance of each other.
///   q = the point of the box nearest to a.center     D = |q - a.center|^2     reach = alarm + a.radius
/// Units       one length unit throughout.
/// Domain      finite; min <= max on every axis, radius and alarm >= 0. Flat boxes, subnormals and the largest finite
///             numbers are included.
/// Decision    D <= reach^2, exactly: touching counts.
/// Environment any rounding mode, flush-to-zero and denormals-are-zero: the answer is the same.
/// Source      docs/specification.md#sphere-cube-pairs.
/// Evidence    src/kernel/sphere_cube_test.cpp; proptests/sphere_cube_properties.cpp.
[[nodiscard]] bool test_sphere_cube(const Ball& a, const Box& b, double alarm);

/// The contact of a sphere with a box, or std::nullopt if they are farther apart than `distances.alarm`.
///   normal = (q - a.center) / sqrt(D)     value = sqrt(D) - a.radius - distances.contact
///   point1 = a.center + a.radius normal   point2 = q                                        (nearest_surface)
/// Units       one length unit throughout; the normal is a unit vector from the sphere into the box.
/// Domain      as test_sphere_cube; contact distance >= 0.
/// Decision    as test_sphere_cube.
/// Error       every number is the exact real rounded once to nearest, ties to even (0.5 ulp); beyond the largest
///             finite number it is infinite, as IEEE 754 rounds. Every zero is +0.
/// Degenerate  D = 0, the centre in the box or on it: the sphere leaves through the nearest face, x before y before z
/// and
///             min before max. The normal points from that face into the box, point2 is the foot of the centre on the
///             face, and value = -(a.radius + depth) - distances.contact, depth being the distance to the face.
/// Points      `center` puts point1 at the centre, `far_surface` on the far side; point2 stays.
/// Environment as test_sphere_cube.
/// Source      docs/specification.md#sphere-cube-pairs.
/// Evidence    src/kernel/sphere_cube_test.cpp; proptests/sphere_cube_properties.cpp; golden/sphere_cube.
[[nodiscard]] std::optional<Contact> compute_sphere_cube(const Ball& a, const Box& b, Distances distances,
                                                         ContactPoints points = {});

}  // namespace contact::inline CONTACT_ABI
