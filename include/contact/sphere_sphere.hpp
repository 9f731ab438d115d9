// Sphere against sphere: the exact decision and the correctly rounded contact.
#pragma once

#include <optional>

#include "contact/contact.hpp"
#include "contact/geometry.hpp"
#include "contact/plain_decision.hpp"

namespace contact::inline CONTACT_ABI {

/// Whether `a` and `b` are within the alarm distance of each other.
///   delta = b.center - a.center     D = |delta|^2     reach = alarm + a.radius + b.radius
/// Units       one length unit throughout.
/// Domain      finite; radii and alarm >= 0. Subnormals and the largest finite numbers are included. The alarm distance
///             may be infinite: then every pair is a hit.
/// Decision    D <= reach^2, exactly: touching counts. `reach` is a real number and never overflows.
/// Environment any rounding mode, flush-to-zero and denormals-are-zero: the answer is the same.
///             What plain arithmetic decides inline may raise exceptions of the caller's, the inexact one mostly; to
///             raise none there is out_of_line.
/// Source      seed.txt, testIntersectionSphere; docs/specification.md#sphere-pairs.
/// Evidence    src/kernel/sphere_sphere_test.cpp; proptests/production_properties.cpp.
[[nodiscard]] bool test_sphere_sphere(const Ball& a, const Ball& b, double alarm);

/// The contact of `a` with `b`, or std::nullopt if they are farther apart than `distances.alarm`.
///   normal = delta / sqrt(D)       value = sqrt(D) - (a.radius + b.radius) - distances.contact
///   point1 = a.center + a.radius normal     point2 = b.center - b.radius normal     (nearest_surface)
/// Units       one length unit throughout; the normal is a unit vector from a to b.
/// Domain      finite; radii, alarm and contact distance >= 0. Subnormals and the largest finite numbers are included.
///             The alarm distance may be infinite: then every pair has a contact.
/// Decision    as test_sphere_sphere.
/// Error       every number is the exact real rounded once to nearest, ties to even (0.5 ulp); beyond the largest
///             finite number it is infinite, as IEEE 754 rounds. Every zero is +0.
/// Degenerate  D = 0: normal (1,0,0), marked degenerate; points and value follow from it.
/// Environment as test_sphere_sphere.
/// Source      seed.txt, computeIntersectionSphere; docs/specification.md#sphere-pairs.
/// Evidence    src/kernel/sphere_sphere_test.cpp; proptests/production_properties.cpp; every file in golden/.
[[nodiscard]] std::optional<Contact> compute_sphere_sphere(const Ball& a, const Ball& b, Distances distances,
                                                           ContactPoints points = {});

namespace out_of_line {
/// The same, all of it in the library: no exception is raised, and none traps.
[[nodiscard]] bool test_sphere_sphere(const Ball& a, const Ball& b, double alarm);
[[nodiscard]] std::optional<Contact> compute_sphere_sphere(const Ball& a, const Ball& b, Distances distances,
                                                           ContactPoints points = {});
}  // namespace out_of_line

#if CONTACT_DECIDES_INLINE
CONTACT_INLINE bool test_sphere_sphere(const Ball& a, const Ball& b, double alarm) {
  return plain_decision::decided<out_of_line::test_sphere_sphere>(plain_decision::filter_balls(a, b, alarm), a, b,
                                                                  alarm);
}
CONTACT_INLINE std::optional<Contact> compute_sphere_sphere(const Ball& a, const Ball& b, Distances distances,
                                                            ContactPoints points) {
  if (plain_decision::filter_balls(a, b, distances.alarm) == plain_decision::Filtered::miss) return std::nullopt;
  return out_of_line::compute_sphere_sphere(a, b, distances, points);
}
#endif

}  // namespace contact::inline CONTACT_ABI
