// Sphere against cube (an axis-aligned box): the exact decision and the correctly rounded contact.
#pragma once

#include <optional>

#include "contact/contact.hpp"
#include "contact/geometry.hpp"
#include "contact/plain_decision.hpp"

namespace contact::inline CONTACT_ABI {

/// Whether a sphere and a solid box are within the alarm distance of each other.
///   q = the point of the box nearest to a.center     D = |q - a.center|^2     reach = alarm + a.radius
/// Units       one length unit throughout.
/// Domain      finite; min <= max on every axis, radius and alarm >= 0. Flat boxes, subnormals and the largest finite
///             numbers are included.
/// Decision    D <= reach^2, exactly: touching counts.
/// Environment as test_sphere_sphere.
/// Source      docs/specification.md#sphere-cube-pairs.
/// Evidence    src/kernel/sphere_cube_test.cpp; proptests/production_properties.cpp.
[[nodiscard]] bool test_sphere_cube(const Ball& a, const Box& b, double alarm);

/// The contact of a sphere with a box, or std::nullopt if they are farther apart than `distances.alarm`.
///   normal = (q - a.center) / sqrt(D)     value = sqrt(D) - a.radius - distances.contact
///   point1 = a.center + a.radius normal   point2 = q                                        (nearest_surface)
/// Units       one length unit throughout; the normal is a unit vector from the sphere into the box.
/// Domain      as test_sphere_cube; contact distance >= 0.
/// Decision    as test_sphere_cube.
/// Error       as compute_sphere_sphere.
/// Degenerate  D = 0, the centre in the box or on it: the sphere leaves through the nearest face, x before y before z
///             and min before max. The normal points from that face into the box, point2 is the foot of the centre on
///             the face, and value = -(a.radius + depth) - distances.contact, depth being the distance to the face.
/// Points      `center` puts point1 at the centre, `far_surface` on the far side; point2 stays.
/// Environment as test_sphere_cube.
/// Source      docs/specification.md#sphere-cube-pairs.
/// Evidence    src/kernel/sphere_cube_test.cpp; proptests/production_properties.cpp; golden/sphere_cube.
[[nodiscard]] std::optional<Contact> compute_sphere_cube(const Ball& a, const Box& b, Distances distances,
                                                         ContactPoints points = {});

namespace out_of_line {
/// The same, all of it in the library: no exception is raised, and none traps.
[[nodiscard]] bool test_sphere_cube(const Ball& a, const Box& b, double alarm);
[[nodiscard]] std::optional<Contact> compute_sphere_cube(const Ball& a, const Box& b, Distances distances,
                                                         ContactPoints points = {});
}  // namespace out_of_line

namespace of_hit {
/// The contact of a pair that plain_decision::filter_ball_and_box says is a hit.
[[nodiscard]] std::optional<Contact> compute_sphere_cube(const Ball& a, const Box& b, Distances distances,
                                                         ContactPoints points);
}  // namespace of_hit

#if CONTACT_DECIDES_INLINE
CONTACT_INLINE bool test_sphere_cube(const Ball& a, const Box& b, double alarm) {
  return plain_decision::decided<out_of_line::test_sphere_cube>(plain_decision::filter_ball_and_box(a, b, alarm), a, b,
                                                                alarm);
}
CONTACT_INLINE std::optional<Contact> compute_sphere_cube(const Ball& a, const Box& b, Distances distances,
                                                          ContactPoints points) {
  const plain_decision::Filtered filtered = plain_decision::filter_ball_and_box(a, b, distances.alarm);
  if (filtered == plain_decision::Filtered::miss) return std::nullopt;
  if (filtered == plain_decision::Filtered::hit) return of_hit::compute_sphere_cube(a, b, distances, points);
  return out_of_line::compute_sphere_cube(a, b, distances, points);
}
#endif

}  // namespace contact::inline CONTACT_ABI
