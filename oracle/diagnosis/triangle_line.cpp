// What can go wrong about a triangle and a line alone: the causes of all crossings are in wrong_crossings.cpp.
#include "oracle/diagnosis/formulas.hpp"

namespace contact::oracle::formulas {

bool one_inside_the_other(F /*f*/, const TriangleAndLine& /*shapes*/) { return false; }

std::vector<Cause> wrong_about(const TriangleAndLine* /*kind*/) { return {}; }

}  // namespace contact::oracle::formulas
