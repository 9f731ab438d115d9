// The witness of a sphere and a solid box, in integers: that of the sphere and a point of the box, the least that there
// is.
#include "oracle/truth/clamped.hpp"
#include "oracle/truth/grid.hpp"

namespace contact::oracle {

Witness quick_witness(const BallAndBox& shapes, Distances distances) {
  return quick_witness(at_clamped(shapes), distances);
}

}  // namespace contact::oracle
