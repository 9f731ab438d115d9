// Questions about a sphere and a plane: those about a capsule, of which one end is the sphere.
#include "proptests/generators.hpp"

namespace contact::proptests {

rc::Gen<Query> queries(const BallAndPlane* /*kind*/, const Range& range) { return plane_queries(range, true); }

}  // namespace contact::proptests
