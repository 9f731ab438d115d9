// What can go wrong about a ray and a triangle alone: the causes of all crossings are in wrong_crossings.cpp.
#include "oracle/diagnosis/formulas.hpp"

namespace contact::oracle::formulas {

bool one_inside_the_other(F /*f*/, const RayAndTriangle& /*shapes*/) { return false; }

std::vector<Cause> wrong_about(const RayAndTriangle* /*kind*/) { return {}; }

}  // namespace contact::oracle::formulas
