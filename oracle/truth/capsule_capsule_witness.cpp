// The witness of a pair of capsules: the exact truth's, since the nearest points are no integers on a grid.
#include "oracle/truth/grid.hpp"
#include "oracle/truth/segments.hpp"

namespace contact::oracle {

Witness quick_witness(const Capsules& shapes, Distances distances) {
  return witness_of(exact_truth(shapes, distances));
}

}  // namespace contact::oracle
