// The witness of a ray that is cast: the exact truth's, since t is no integer on a grid.
#include "oracle/truth/casts.hpp"
#include "oracle/truth/grid.hpp"

namespace contact::oracle {

#define CONTACT_CAST(Target)                                                        \
  Witness quick_witness(const CastAt<Target>& shapes, Distances distances) {        \
    return witness_of(std::get<CastTruth>(exact_truth(shapes, distances).numbers)); \
  }
CONTACT_CAST(Ball)
CONTACT_CAST(Box)
CONTACT_CAST(Capsule)
CONTACT_CAST(Triangle)
CONTACT_CAST(Plane)
#undef CONTACT_CAST

}  // namespace contact::oracle
