// Questions about a sphere and a capsule: those about two capsules, the first without length.
#include "proptests/generators.hpp"

namespace contact::proptests {

rc::Gen<Query> queries(const BallAndCapsule* /*kind*/, const Range& range) { return capsule_queries(range, true); }

}  // namespace contact::proptests
