// FCL: fcl::collide on two geometries and their transforms, without the broad phase's objects; AABB::overlap.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/math/bv/AABB.h>
#include <fcl/narrowphase/collision.h>

#include "peers/peers.hpp"

namespace contact::bench {
namespace {

class Fcl {
 public:
  template <class Shape>
  bool test(const Two<Ball, Shape>& p) {
    return collide(p, {1, false});
  }
  template <class Shape>
  bool compute(const Two<Ball, Shape>& p, Contact& out) {
    if (!collide(p, {1, true})) return false;
    const fcl::Contactd& contact = result_.getContact(0);
    out.normal = contact.normal;
    out.point1 = contact.pos;
    out.value = contact.penetration_depth;
    return true;
  }
  static bool test(const Boxes& p) {
    fcl::AABBd a;
    a.min_ = p.a.min;
    a.max_ = p.a.max;
    fcl::AABBd b;
    b.min_ = p.b.min;
    b.max_ = p.b.max;
    return a.overlap(b);
  }

 private:
  fcl::Sphered& second(const Ball& ball) {
    b_.radius = ball.radius;
    at_b_.translation() = ball.center;
    return b_;
  }
  fcl::Boxd& second(const Box& box) {
    box_.side = box.max - box.min;
    at_b_.translation() = 0.5 * (box.min + box.max);
    return box_;
  }
  template <class Shape>
  bool collide(const Two<Ball, Shape>& p, const fcl::CollisionRequestd& request) {
    a_.radius = p.a.radius;
    at_a_.translation() = p.a.center;
    auto& b = second(p.b);
    result_.clear();
    return fcl::collide(&a_, at_a_, &b, at_b_, request, result_) > 0;
  }

  fcl::Sphered a_{1};
  fcl::Sphered b_{1};
  fcl::Boxd box_{1, 1, 1};
  fcl::Transform3d at_a_ = fcl::Transform3d::Identity();
  fcl::Transform3d at_b_ = fcl::Transform3d::Identity();
  fcl::CollisionResultd result_;
};

}  // namespace

std::vector<Peer> fcl_peers() {
  // Its point divides the segment of the centres by the radii, not half way between the surfaces.
  return {make_peer("FCL",
                    {.points = Points::none,
                     .value = ValueKind::depth,
                     .margin = Margin::none,
                     .coincident = Coincident::zero_normal},
                    false, std::make_shared<Fcl>())};
}

}  // namespace contact::bench
