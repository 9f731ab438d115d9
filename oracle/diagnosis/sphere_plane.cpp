// What can go wrong about a sphere and a plane alone.
#include "oracle/diagnosis/formulas.hpp"

namespace contact::oracle::formulas {

bool one_inside_the_other(F f, const BallAndPlane& /*shapes*/) { return f.distance <= -f.radius[0]; }

std::vector<Cause> wrong_about(const BallAndPlane* /*kind*/) { return {}; }

}  // namespace contact::oracle::formulas
