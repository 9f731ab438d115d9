// ODE: dCollide on two sphere geometries, or two boxes.
#include <ode/ode.h>

#include "peers/peers.hpp"

#ifndef dDOUBLE
#error "ODE is compared in double precision"
#endif

namespace contact::bench {
namespace {

class Ode {
 public:
  bool test(const Balls& p) {
    set(a_, p.a);
    set(b_, p.b);
    return dCollide(a_, b_, 1, &found_, sizeof found_) > 0;
  }
  bool test(const BallAndBox& p) {
    set(a_, p.a);
    set(box_a_, p.b);
    return dCollide(a_, box_a_, 1, &found_, sizeof found_) > 0;
  }
  template <class Shape>
  bool compute(const Two<Ball, Shape>& p, Contact& out) {
    if (!test(p)) return false;
    out.normal = {found_.normal[0], found_.normal[1], found_.normal[2]};
    out.point1 = {found_.pos[0], found_.pos[1], found_.pos[2]};
    out.value = found_.depth;
    return true;
  }
  bool test(const Boxes& p) {
    set(box_a_, p.a);
    set(box_b_, p.b);
    return dCollide(box_a_, box_b_, 1, &found_, sizeof found_) > 0;
  }

 private:
  static void set(dGeomID sphere, const Ball& ball) {
    dGeomSphereSetRadius(sphere, ball.radius);
    dGeomSetPosition(sphere, ball.center[0], ball.center[1], ball.center[2]);
  }
  static void set(dGeomID box, const Box& bounds) {
    const Vector3 size = bounds.max - bounds.min;
    const Vector3 center = 0.5 * (bounds.min + bounds.max);
    dGeomBoxSetLengths(box, size[0], size[1], size[2]);
    dGeomSetPosition(box, center[0], center[1], center[2]);
  }

  int started_ = dInitODE2(0);
  dGeomID a_ = dCreateSphere(nullptr, 1);
  dGeomID b_ = dCreateSphere(nullptr, 1);
  dGeomID box_a_ = dCreateBox(nullptr, 1, 1, 1);
  dGeomID box_b_ = dCreateBox(nullptr, 1, 1, 1);
  dContactGeom found_{};
};

}  // namespace

std::vector<Peer> ode_peers() {
  return {make_peer("ODE",
                    {.normal = NormalDirection::second_to_first,
                     .points = Points::midpoint,
                     .value = ValueKind::depth,
                     .margin = Margin::none},
                    false, std::make_shared<Ode>())};
}

}  // namespace contact::bench
