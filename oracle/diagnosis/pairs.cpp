// What can go wrong about pairs that have no mistakes of their own: those of wrong_*.cpp alone. Whether one shape lies inside the other.
#include "oracle/diagnosis/formulas.hpp"

namespace contact::oracle::formulas {

bool one_inside_the_other(F f, const Balls& /*spheres*/) { return f.distance <= std::abs(f.radius[0] - f.radius[1]); }
bool one_inside_the_other(F f, const BallAndCapsule& /*shapes*/) { return f.distance <= f.radius[1] - f.radius[0]; }
bool one_inside_the_other(F f, const BallAndPlane& /*shapes*/) { return f.distance <= -f.radius[0]; }
bool one_inside_the_other(F f, const CapsuleAndPlane& shapes) {
  const AxisInReals axis(shapes.a);
  const PlaneInReals plane(shapes.b);
  return std::max(plane.height(axis.at(0)), plane.height(axis.at(1))) <= -f.radius[0];
}
bool one_inside_the_other(F /*f*/, const Capsules& /*shapes*/) { return false; }
bool one_inside_the_other(F /*f*/, const RayAndBall& /*shapes*/) { return false; }
bool one_inside_the_other(F /*f*/, const RayAndTriangle& /*shapes*/) { return false; }
bool one_inside_the_other(F /*f*/, const TriangleAndLine& /*shapes*/) { return false; }

std::vector<Cause> wrong_about(const Balls* /*kind*/) { return {}; }
std::vector<Cause> wrong_about(const BallAndCapsule* /*kind*/) { return {}; }
std::vector<Cause> wrong_about(const BallAndPlane* /*kind*/) { return {}; }
std::vector<Cause> wrong_about(const CapsuleAndPlane* /*kind*/) { return {}; }
std::vector<Cause> wrong_about(const Capsules* /*kind*/) { return {}; }
std::vector<Cause> wrong_about(const RayAndBall* /*kind*/) { return {}; }
std::vector<Cause> wrong_about(const RayAndTriangle* /*kind*/) { return {}; }
std::vector<Cause> wrong_about(const TriangleAndLine* /*kind*/) { return {}; }

}  // namespace contact::oracle::formulas
