// A sphere and a plane in plain arithmetic.
#include "golden/plain_planes.hpp"

namespace contact::golden {

bool plain_overlap(const BallAndPlane& shapes, Distances distances, Scalar scalar) {
  return plain_overlap_over_plane(shapes, distances, scalar);
}

std::optional<Contact> plain_contact(const BallAndPlane& shapes, Distances distances, Scalar scalar,
                                     ContactPoints points) {
  return plain_contact_over_plane(shapes, distances, scalar, points);
}

}  // namespace contact::golden
