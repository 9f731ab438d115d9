// What can go wrong about a capsule and a plane alone.
#include "oracle/diagnosis/formulas.hpp"

namespace contact::oracle::formulas {

bool one_inside_the_other(F f, const CapsuleAndPlane& shapes) {
  const AxisInReals axis(shapes.a);
  const PlaneInReals plane(shapes.b);
  return std::max(plane.height(axis.at(0)), plane.height(axis.at(1))) <= -f.radius[0];
}

std::vector<Cause> wrong_about(const CapsuleAndPlane* /*kind*/) { return {}; }

}  // namespace contact::oracle::formulas
