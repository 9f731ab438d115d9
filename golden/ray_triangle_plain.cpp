// A ray and a triangle in plain arithmetic.
#include "golden/plain_crossings.hpp"

namespace contact::golden {

bool plain_overlap(const RayAndTriangle& shapes, Distances /*distances*/, Scalar scalar) {
  return plain_crossing(shapes, scalar).has_value();
}
std::optional<Contact> plain_contact(const RayAndTriangle& shapes, Distances /*distances*/, Scalar scalar,
                                     ContactPoints /*points*/) {
  return plain_crossing(shapes, scalar);
}

}  // namespace contact::golden
