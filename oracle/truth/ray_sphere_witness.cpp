// The witness of a ray and a sphere: the exact truth's, since the nearest point of the ray is no integer on a grid.
#include "oracle/truth/grid.hpp"
#include "oracle/truth/segments.hpp"

namespace contact::oracle {

Witness quick_witness(const RayAndBall& shapes, Distances distances) {
  return witness_of(exact_truth(shapes, distances));
}

}  // namespace contact::oracle
