// Pairs whose formulas in plain arithmetic are those of two segments, of a segment over a plane, and of one that crosses a
// triangle: a ball is a segment without length.
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

#define CONTACT_OVER_PLANE(A)                                                                           \
  bool plain_overlap(const Two<A, Plane>& shapes, Distances distances, Scalar scalar) {                 \
    return plain_overlap_over_plane(shapes, distances, scalar);                                         \
  }                                                                                                     \
  std::optional<Contact> plain_contact(const Two<A, Plane>& shapes, Distances distances, Scalar scalar, \
                                       ContactPoints points) {                                          \
    return plain_contact_over_plane(shapes, distances, scalar, points);                                 \
  }
CONTACT_OVER_PLANE(Ball)
CONTACT_OVER_PLANE(Capsule)

#define CONTACT_CROSSING(A, B)                                                                          \
  bool plain_overlap(const Two<A, B>& shapes, Distances /*distances*/, Scalar scalar) {                 \
    return plain_crossing(shapes, scalar).has_value();                                                  \
  }                                                                                                     \
  std::optional<Contact> plain_contact(const Two<A, B>& shapes, Distances /*distances*/, Scalar scalar, \
                                       ContactPoints /*points*/) {                                      \
    return plain_crossing(shapes, scalar);                                                              \
  }
CONTACT_CROSSING(Ray, Triangle)
CONTACT_CROSSING(Triangle, Line)

}  // namespace contact::golden
