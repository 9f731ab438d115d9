// What can go wrong about a ray and a sphere alone: the causes of all axes are in wrong_features.cpp.
#include "oracle/diagnosis/formulas.hpp"

namespace contact::oracle::formulas {

bool one_inside_the_other(F /*f*/, const RayAndBall& /*shapes*/) { return false; }

std::vector<Cause> wrong_about(const RayAndBall* /*kind*/) { return {}; }

}  // namespace contact::oracle::formulas
