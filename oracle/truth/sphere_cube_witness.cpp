// The witness of a sphere and a solid box, in integers: that of the sphere and a point of the box, the least that there
// is.
#include <algorithm>

#include "oracle/truth/grid.hpp"

namespace contact::oracle {

Witness quick_witness(const BallAndBox& shapes, Distances distances) {
  Ball nearest{shapes.a.center, 0};
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    nearest.center[axis] = std::clamp(nearest.center[axis], shapes.b.min[axis], shapes.b.max[axis]);
  return quick_witness(Balls{shapes.a, nearest}, distances);
}

}  // namespace contact::oracle
