// What can go wrong about two spheres alone. Most mistakes about them are those of any two cores with radii.
#include "oracle/diagnosis/formulas.hpp"

namespace contact::oracle::formulas {

bool one_inside_the_other(F f, const Balls& /*spheres*/) { return f.distance <= std::abs(f.radius[0] - f.radius[1]); }

std::vector<Cause> wrong_about(const Balls* /*kind*/) { return {}; }

}  // namespace contact::oracle::formulas
