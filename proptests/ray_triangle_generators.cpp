// Questions about a ray and a triangle.
#include "proptests/crossing_generators.hpp"

namespace contact::proptests {

rc::Gen<Query> queries(const RayAndTriangle* /*kind*/, const Range& range) {
  return crossings(range, [](const Laid& laid, Distances distances) {
    const bool none = laid.direction.isZero(0);
    const Vector3 direction = none ? Vector3(1, 2, -2) : laid.direction;
    return Query{Pair::ray_triangle, RayAndTriangle{{laid.start, direction, none ? 0 : laid.length}, laid.triangle},
                 distances};
  });
}

}  // namespace contact::proptests
