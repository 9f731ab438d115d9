// The witness of a sphere and a triangle: the exact truth's, since the nearest point is no integer on a grid.
#include "oracle/truth/grid.hpp"
#include "oracle/truth/segments.hpp"

namespace contact::oracle {

Witness quick_witness(const BallAndTriangle& shapes, Distances distances) {
  return witness_of(exact_truth(shapes, distances));
}

}  // namespace contact::oracle
