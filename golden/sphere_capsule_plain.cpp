// A sphere and a capsule in plain arithmetic: two spheres, the second at the clamped foot of the centre on the axis.
#include "golden/segments.hpp"

namespace contact::golden {

bool plain_overlap(const BallAndCapsule& shapes, Distances distances, Scalar scalar) {
  return scalar == Scalar::binary32 ? plain_overlap_of_segments<float>(shapes, distances, scalar)
                                    : plain_overlap_of_segments<double>(shapes, distances, scalar);
}

std::optional<Contact> plain_contact(const BallAndCapsule& shapes, Distances distances, Scalar scalar,
                                     ContactPoints points) {
  return scalar == Scalar::binary32 ? plain_contact_of_segments<float>(shapes, distances, scalar, points)
                                    : plain_contact_of_segments<double>(shapes, distances, scalar, points);
}

}  // namespace contact::golden
