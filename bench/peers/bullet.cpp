// Bullet in double precision: the algorithm that its dispatcher picks for two spheres, called directly, and
// btCollisionWorld::contactPairTest; TestAabbAgainstAabb2.
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btSphereSphereCollisionAlgorithm.h>
#include <LinearMath/btAabbUtil2.h>
#include <btBulletCollisionCommon.h>

#include "peers/peers.hpp"

#ifndef BT_USE_DOUBLE_PRECISION
#error "Bullet is compared in double precision"
#endif

namespace contact::bench {
namespace {

btVector3 to_bullet(const Vector3& v) { return {v[0], v[1], v[2]}; }
Vector3 from_bullet(const btVector3& v) { return {v[0], v[1], v[2]}; }

/// Two spheres that are moved and resized from question to question.
struct TwoSpheres {
  btSphereShape shape_a{1};
  btSphereShape shape_b{1};
  btCollisionObject a;
  btCollisionObject b;

  TwoSpheres() {
    a.setCollisionShape(&shape_a);
    b.setCollisionShape(&shape_b);
  }
  void set(const Balls& p) {
    shape_a.setUnscaledRadius(p.a.radius);
    shape_b.setUnscaledRadius(p.b.radius);
    a.getWorldTransform().setOrigin(to_bullet(p.a.center));
    b.getWorldTransform().setOrigin(to_bullet(p.b.center));
  }
};

class Algorithm {
 public:
  bool test(const Balls& p) {
    result_.hit = false;
    spheres_.set(p);
    algorithm_.processCollision(&a_, &b_, info_, &result_);
    return result_.hit;
  }
  bool compute(const Balls& p, Contact& out) {
    if (!test(p)) return false;
    out.normal = from_bullet(result_.normal);
    out.point1 = from_bullet(result_.point + result_.normal * result_.distance);
    out.point2 = from_bullet(result_.point);
    out.value = result_.distance;
    return true;
  }
  static bool test_boxes(const Boxes& p) {
    return TestAabbAgainstAabb2(to_bullet(p.a.min), to_bullet(p.a.max), to_bullet(p.b.min), to_bullet(p.b.max));
  }

 private:
  /// Keeps the contact itself: no manifold, no friction.
  struct Result : btManifoldResult {
    using btManifoldResult::btManifoldResult;
    void addContactPoint(const btVector3& on_b, const btVector3& at, btScalar depth) override {
      hit = true;
      normal = on_b;
      point = at;
      distance = depth;
    }
    bool hit = false;
    btVector3 normal;
    btVector3 point;
    btScalar distance = 0;
  };

  TwoSpheres spheres_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btCollisionObjectWrapper a_{nullptr, &spheres_.shape_a, &spheres_.a, spheres_.a.getWorldTransform(), -1, -1};
  btCollisionObjectWrapper b_{nullptr, &spheres_.shape_b, &spheres_.b, spheres_.b.getWorldTransform(), -1, -1};
  btPersistentManifold* manifold_ = dispatcher_.getNewManifold(&spheres_.a, &spheres_.b);
  btSphereSphereCollisionAlgorithm algorithm_{manifold_, {&dispatcher_, 1}, &a_, &b_};
  btDispatcherInfo info_;
  Result result_{&a_, &b_};
};

class World {
 public:
  bool test(const Balls& p) {
    callback_.hit = false;
    spheres_.set(p);
    world_.contactPairTest(&spheres_.a, &spheres_.b, callback_);
    return callback_.hit;
  }
  bool compute(const Balls& p, Contact& out) {
    if (!test(p)) return false;
    out.normal = from_bullet(callback_.point.m_normalWorldOnB);
    out.point1 = from_bullet(callback_.point.getPositionWorldOnA());
    out.point2 = from_bullet(callback_.point.getPositionWorldOnB());
    out.value = callback_.point.getDistance();
    return true;
  }

 private:
  struct Callback : btCollisionWorld::ContactResultCallback {
    btScalar addSingleResult(btManifoldPoint& found, const btCollisionObjectWrapper*, int, int,
                             const btCollisionObjectWrapper*, int, int) override {
      hit = true;
      point = found;
      return 0;
    }
    bool hit = false;
    btManifoldPoint point;
  };

  TwoSpheres spheres_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btCollisionWorld world_{&dispatcher_, &broadphase_, &configuration_};
  Callback callback_;
};

}  // namespace

std::vector<Peer> bullet_peers() {
  const Conventions conventions{.normal = NormalDirection::second_to_first, .margin = Margin::none};
  return {make_peer("Bullet, algorithm", conventions, false, std::make_shared<Algorithm>()),
          make_peer("Bullet, contactPairTest", conventions, false, std::make_shared<World>())};
}

}  // namespace contact::bench
