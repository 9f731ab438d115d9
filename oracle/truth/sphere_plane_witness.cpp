// The witness of a sphere and a plane: the exact truth's, since the foot on the plane is no integer on a grid.
#include "oracle/truth/grid.hpp"
#include "oracle/truth/segments.hpp"

namespace contact::oracle {

Witness quick_witness(const BallAndPlane& shapes, Distances distances) {
  return witness_of(exact_truth(shapes, distances));
}

}  // namespace contact::oracle
