// Cube against cube (axis-aligned boxes): the exact decision.
#pragma once

#include "contact/geometry.hpp"
#include "contact/plain_decision.hpp"

namespace contact::inline CONTACT_ABI {

/// Whether two boxes are within `alarm` of each other on every axis.
/// Units       one length unit throughout.
/// Domain      finite; min <= max on every axis, alarm >= 0. Flat boxes, subnormals and the largest finite numbers are
///             included.
/// Decision    on every axis a.min <= b.max + alarm and b.min <= a.max + alarm, exactly: touching counts.
/// Environment as test_sphere_sphere.
/// Source      seed.txt, testIntersection(Cube&, Cube&); docs/specification.md#cube-pairs. SOFA's computeIntersection
///             of two cubes writes no contact and returns 0, so there is nothing to compute beyond this decision.
/// Evidence    src/kernel/cube_cube_test.cpp; proptests/production_properties.cpp.
[[nodiscard]] bool test_cube_cube(const Box& a, const Box& b, double alarm);

namespace out_of_line {
/// The same, all of it in the library: no exception is raised, and none traps.
[[nodiscard]] bool test_cube_cube(const Box& a, const Box& b, double alarm);
}  // namespace out_of_line

#if CONTACT_DECIDES_INLINE
CONTACT_INLINE bool test_cube_cube(const Box& a, const Box& b, double alarm) {
  return plain_decision::decided<out_of_line::test_cube_cube>(plain_decision::filter_boxes(a, b, alarm), a, b, alarm);
}
#endif

}  // namespace contact::inline CONTACT_ABI
