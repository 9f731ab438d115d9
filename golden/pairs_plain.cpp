// Pairs whose formulas in plain arithmetic are short: two segments, a segment over a plane, and one that crosses a
// triangle, where a ball is a segment without length; a sphere and a triangle; two axis-aligned boxes.
#include "golden/plain_crossings.hpp"
#include "golden/plain_planes.hpp"

namespace contact::golden {

#define CONTACT_OF_SEGMENTS(A, B)                                                                             \
  bool plain_overlap(const Two<A, B>& shapes, Distances distances, Scalar scalar) {                           \
    return scalar == Scalar::binary32 ? plain_overlap_of_segments<float>(shapes, distances, scalar)           \
                                      : plain_overlap_of_segments<double>(shapes, distances, scalar);         \
  }                                                                                                           \
  std::optional<Contact> plain_contact(const Two<A, B>& shapes, Distances distances, Scalar scalar,           \
                                       ContactPoints points) {                                                \
    return scalar == Scalar::binary32 ? plain_contact_of_segments<float>(shapes, distances, scalar, points)   \
                                      : plain_contact_of_segments<double>(shapes, distances, scalar, points); \
  }
CONTACT_OF_SEGMENTS(Ball, Capsule)
CONTACT_OF_SEGMENTS(Capsule, Capsule)
CONTACT_OF_SEGMENTS(Ray, Ball)

#define CONTACT_WITH_CONTACT(A, B, contact)                                                                          \
  std::optional<Contact> plain_contact(const Two<A, B>& shapes, [[maybe_unused]] Distances distances, Scalar scalar, \
                                       [[maybe_unused]] ContactPoints points) {                                      \
    return contact;                                                                                                  \
  }                                                                                                                  \
  bool plain_overlap(const Two<A, B>& shapes, Distances distances, Scalar scalar) {                                  \
    return plain_contact(shapes, distances, scalar).has_value();                                                     \
  }
CONTACT_WITH_CONTACT(Ball, Plane, plain_contact_over_plane(shapes, distances, scalar, points))
CONTACT_WITH_CONTACT(Capsule, Plane, plain_contact_over_plane(shapes, distances, scalar, points))
CONTACT_WITH_CONTACT(Ray, Triangle, plain_crossing(shapes, scalar))
CONTACT_WITH_CONTACT(Triangle, Line, plain_crossing(shapes, scalar))

// A sphere and a triangle: two spheres, the second without extent at the triangle's nearest point.
namespace {

template <class Real>
NearestPoints<Real> nearest_of(const BallAndTriangle& shapes) {
  const Triple<Real> c = in_scalar<Real>(shapes.a.center);
  return {c, nearest_point(c, vertices_of<Real>(shapes.b)), true};
}

template <class Real>
bool overlap_in(const BallAndTriangle& shapes, Distances distances, Scalar scalar) {
  return plain_overlap(at_nearest(nearest_of<Real>(shapes), static_cast<Real>(shapes.a.radius), Real{0}), distances,
                       scalar);
}

template <class Real>
std::optional<Contact> contact_in(const BallAndTriangle& shapes, Distances distances, Scalar scalar,
                                  ContactPoints points) {
  return plain_contact_at(nearest_of<Real>(shapes), static_cast<Real>(shapes.a.radius), Real{0},
                          parting_normal(vertices_of<Real>(shapes.b)), distances, scalar, points);
}

}  // namespace

bool plain_overlap(const BallAndTriangle& shapes, Distances distances, Scalar scalar) {
  return scalar == Scalar::binary32 ? overlap_in<float>(shapes, distances, scalar)
                                    : overlap_in<double>(shapes, distances, scalar);
}

std::optional<Contact> plain_contact(const BallAndTriangle& shapes, Distances distances, Scalar scalar,
                                     ContactPoints points) {
  return scalar == Scalar::binary32 ? contact_in<float>(shapes, distances, scalar, points)
                                    : contact_in<double>(shapes, distances, scalar, points);
}

// Two axis-aligned boxes.
namespace {

/// Upstream's box test: no axis on which one minimum exceeds the other maximum plus the alarm distance.
template <class Real>
bool overlap_in(const Boxes& boxes, Distances distances) {
  const Real alarm = static_cast<Real>(distances.alarm);
  for (int axis = 0; axis < 3; ++axis) {
    const Real min1 = static_cast<Real>(boxes.a.min[axis]);
    const Real max1 = static_cast<Real>(boxes.a.max[axis]);
    const Real min2 = static_cast<Real>(boxes.b.min[axis]);
    const Real max2 = static_cast<Real>(boxes.b.max[axis]);
    if (min1 > max2 + alarm || min2 > max1 + alarm) return false;
  }
  return true;
}

}  // namespace

bool plain_overlap(const Boxes& boxes, Distances distances, Scalar scalar) {
  return scalar == Scalar::binary32 ? overlap_in<float>(boxes, distances) : overlap_in<double>(boxes, distances);
}

std::optional<Contact> plain_contact(const Boxes& /*boxes*/, Distances /*distances*/, Scalar /*scalar*/,
                                     ContactPoints /*points*/) {
  return std::nullopt;
}

}  // namespace contact::golden
