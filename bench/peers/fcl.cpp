// FCL: fcl::collide on two geometries and their transforms, without the broad phase's objects; AABB::overlap.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/math/bv/AABB.h>
#include <fcl/narrowphase/collision.h>

#include <concepts>

#include "engines/adapters/fcl.hpp"
#include "peers/adapted.hpp"
#include "peers/peers.hpp"

namespace contact::bench {
namespace {

/// A shape as FCL has it and where it is: moved and resized from question to question.
struct Placed {
  fcl::Sphered sphere{1};
  fcl::Boxd box{1, 1, 1};
  fcl::Capsuled capsule{1, 1};
  fcl::Halfspaced half_space;
  fcl::Transform3d at = fcl::Transform3d::Identity();

  fcl::Sphered& set(const Ball& ball) {
    sphere.radius = ball.radius;
    at.linear().setIdentity();
    at.translation() = ball.center;
    return sphere;
  }
  fcl::Boxd& set(const Box& bounds) {
    box.side = bounds.max - bounds.min;
    at.linear().setIdentity();
    at.translation() = 0.5 * (bounds.min + bounds.max);
    return box;
  }
  fcl::Boxd& set(const Obb& given) {
    const auto& [x, y, z, w] = given.orientation;
    box.side = 2 * given.extents;
    at.linear() = Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
    at.translation() = given.center;
    return box;
  }
  fcl::Capsuled& set(const Capsule& given) {
    const Vector3 along = given.end - given.start;
    capsule.radius = given.radius;
    capsule.lz = along.norm();
    at.linear() = Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), along).toRotationMatrix();
    at.translation() = 0.5 * (given.start + given.end);
    return capsule;
  }
  fcl::Halfspaced& set(const Plane& plane) {
    const double length = plane.normal.norm();
    half_space.n = plane.normal / length;
    half_space.d = plane.offset / length;
    at = fcl::Transform3d::Identity();
    return half_space;
  }
};

class Fcl {
 public:
  template <class A, class B>
  requires requires(Placed& placed, const Two<A, B>& p) { placed.set(p.a), placed.set(p.b); }
  bool test(const Two<A, B>& p) { return collide(p, {1, false}); }
  template <class A, class B>
  requires(!std::same_as<A, Box> && requires(Placed & placed, const Two<A, B>& p) {
    placed.set(p.a), placed.set(p.b);
  }) bool compute(const Two<A, B>& p, Contact& out) {
    return collide(p, {1, true}) && write(out);
  }
  // Two rotated boxes.
  bool test(const Convexes& p) { return test(obbs(p)); }
  bool compute(const Convexes& p, Contact& out) { return compute(obbs(p), out); }
  /// Of a hull, with the faces that Qhull finds.
  struct Made {
    explicit Made(const Convexes& p)
        : a(*adapters::fcl_object(Adapted(p.a).shape())), b(*adapters::fcl_object(Adapted(p.b).shape())) {}
    fcl::CollisionObjectd a;
    fcl::CollisionObjectd b;
  };
  static constexpr bool kHasPlanes = true;
  bool test(const Made& p) { return collide(p, {1, false}); }
  bool compute(const Made& p, Contact& out) { return collide(p, {1, true}) && write(out); }
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
  template <class A, class B>
  bool collide(const Two<A, B>& p, const fcl::CollisionRequestd& request) {
    auto& a = a_.set(p.a);
    auto& b = b_.set(p.b);
    result_.clear();
    return fcl::collide(&a, a_.at, &b, b_.at, request, result_) > 0;
  }
  bool collide(const Made& p, const fcl::CollisionRequestd& request) {
    result_.clear();
    return fcl::collide(&p.a, &p.b, request, result_) > 0;
  }
  bool write(Contact& out) const {
    const fcl::Contactd& contact = result_.getContact(0);
    out.normal = contact.normal;
    out.point1 = contact.pos;
    out.value = contact.penetration_depth;
    return true;
  }

  Placed a_;
  Placed b_;
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
