// Two capsules in plain arithmetic: two spheres at the nearest points of the segments.
#include "golden/segments.hpp"

namespace contact::golden {

bool plain_overlap(const Capsules& shapes, Distances distances, Scalar scalar) {
  return scalar == Scalar::binary32 ? plain_overlap_of_segments<float>(shapes, distances, scalar)
                                    : plain_overlap_of_segments<double>(shapes, distances, scalar);
}

std::optional<Contact> plain_contact(const Capsules& shapes, Distances distances, Scalar scalar, ContactPoints points) {
  return scalar == Scalar::binary32 ? plain_contact_of_segments<float>(shapes, distances, scalar, points)
                                    : plain_contact_of_segments<double>(shapes, distances, scalar, points);
}

}  // namespace contact::golden
