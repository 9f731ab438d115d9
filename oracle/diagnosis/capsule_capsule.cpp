// What can go wrong about two capsules alone: the causes of all axes are in wrong_features.cpp.
#include "oracle/diagnosis/formulas.hpp"

namespace contact::oracle::formulas {

bool one_inside_the_other(F /*f*/, const Capsules& /*shapes*/) { return false; }

std::vector<Cause> wrong_about(const Capsules* /*kind*/) { return {}; }

}  // namespace contact::oracle::formulas
