// The witness of a triangle and a line: the exact truth's, since the crossing is no integer on a grid.
#include "oracle/truth/crossings.hpp"
#include "oracle/truth/grid.hpp"

namespace contact::oracle {

Witness quick_witness(const TriangleAndLine& shapes, Distances distances) {
  return witness_of(std::get<CrossingTruth>(exact_truth(shapes, distances).numbers));
}

}  // namespace contact::oracle
