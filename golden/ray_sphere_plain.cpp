// A ray and a sphere in plain arithmetic: a sphere without extent at the clamped foot of the centre, and the sphere.
#include "golden/segments.hpp"

namespace contact::golden {

bool plain_overlap(const RayAndBall& shapes, Distances distances, Scalar scalar) {
  return scalar == Scalar::binary32 ? plain_overlap_of_segments<float>(shapes, distances, scalar)
                                    : plain_overlap_of_segments<double>(shapes, distances, scalar);
}

std::optional<Contact> plain_contact(const RayAndBall& shapes, Distances distances, Scalar scalar,
                                     ContactPoints points) {
  return scalar == Scalar::binary32 ? plain_contact_of_segments<float>(shapes, distances, scalar, points)
                                    : plain_contact_of_segments<double>(shapes, distances, scalar, points);
}

}  // namespace contact::golden
