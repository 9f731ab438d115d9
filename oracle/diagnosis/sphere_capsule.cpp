// What can go wrong about a sphere and a capsule alone: the causes of all axes are in wrong_features.cpp.
#include "oracle/diagnosis/formulas.hpp"

namespace contact::oracle::formulas {

bool one_inside_the_other(F f, const BallAndCapsule& /*shapes*/) { return f.distance <= f.radius[1] - f.radius[0]; }

std::vector<Cause> wrong_about(const BallAndCapsule* /*kind*/) { return {}; }

}  // namespace contact::oracle::formulas
