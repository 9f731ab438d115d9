// Any two convex shapes: a sphere, a capsule, a box, a rotated box, a triangle or a hull against another, or over a plane.
#pragma once

#include <optional>

#include "contact/contact.hpp"
#include "contact/pairs.hpp"

namespace contact::inline CONTACT_ABI {

// test_obb_obb, compute_obb_obb, and so on: for every pair of CONTACT_CONVEX_PAIRS
//
//   test_PAIR     whether two shapes are within the alarm distance
//   compute_PAIR  their contact, or std::nullopt
//
// A shape is a core, A or B, blown up by a radius. p and q are nearest points of the cores, or where these overlap, the
// points between which the least translation n d leads that parts them: n the unit vector for which max n.a - min n.b
// is least, d that least.
//   apart    normal = (q - p) / |q - p|    value = |q - p| - (r1 + r2) - contact
//   overlap  normal = n                    value = -d - (r1 + r2) - contact
//   point1 = p + r1 normal     point2 = q - r2 normal
// Over a plane p is the lowest point, q its foot, and the distance is signed, as of capsule_plane.
//
// Units       any one length unit; the normal is a unit vector. Orientations count by their direction alone.
// Domain      finite; radii, extents, `alarm` and `contact` >= 0; orientations and normals of planes not zero; from 1 to
//             kMostVertices vertices. Flat boxes, triangles and capsules without extent, and hulls of any points are
//             included, subnormals and the largest finite numbers too.
// Decision    exact, and closed: what touches, and what is at exactly the alarm distance, hits.
// Error       every number is the exact real rounded once to nearest, ties to even (0.5 ulp); beyond the largest finite
//             number it is infinite, as IEEE 754 rounds. Every zero is +0.
// Normal      where several are right, each divided by the sum of the absolute values of its components, the one that
//             is lexicographically greatest.
// Points      where many are right (`unique` false), the middle between the lexicographically least and greatest vertex
//             of their set.
// Degenerate  the cores touch: the normal is one of those of the facets of A - B through 0.
// Environment any rounding mode, flush-to-zero and denormals-are-zero: the answer is the same.
// Source      docs/specification.md#any-two-convex-shapes.
// Evidence    src/kernel/convexes_test.cpp; proptests/production_properties.cpp; golden/obb_obb and its like.
#define CONTACT_DECLARE(name, A, B, ...)                                                           \
  [[nodiscard]] bool test_##name(const A& a, const B& b, double alarm);                            \
  [[nodiscard]] std::optional<Contact> compute_##name(const A& a, const B& b, Distances distances, \
                                                      ContactPoints points = {});
CONTACT_CONVEX_PAIRS(CONTACT_DECLARE)
#undef CONTACT_DECLARE

}  // namespace contact::inline CONTACT_ABI
