// Bullet in double precision: the algorithm of two spheres, and of a sphere and a box, called directly, and
// btCollisionWorld::contactPairTest, which has one for any two convex shapes where a box is one; TestAabbAgainstAabb2.
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btSphereBoxCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btSphereSphereCollisionAlgorithm.h>
#include <LinearMath/btAabbUtil2.h>
#include <btBulletCollisionCommon.h>

#include <concepts>
#include <type_traits>

#include "engines/adapters/bullet.hpp"
#include "peers/adapted.hpp"
#include "peers/peers.hpp"

#ifndef BT_USE_DOUBLE_PRECISION
#error "Bullet is compared in double precision"
#endif

namespace contact::bench {
namespace {

btVector3 to_bullet(const Vector3& v) { return {v[0], v[1], v[2]}; }
Vector3 from_bullet(const btVector3& v) { return {v[0], v[1], v[2]}; }

void set(btSphereShape& shape, btCollisionObject& object, const Ball& ball) {
  shape.setUnscaledRadius(ball.radius);
  object.getWorldTransform().setOrigin(to_bullet(ball.center));
}
void set(btBoxShape& shape, btCollisionObject& object, const Box& box) {
  shape.setImplicitShapeDimensions(to_bullet(0.5 * (box.max - box.min)));
  object.getWorldTransform().setOrigin(to_bullet(0.5 * (box.min + box.max)));
}
void set(btBoxShape& shape, btCollisionObject& object, const Obb& box) {
  const auto& [x, y, z, w] = box.orientation;
  shape.setImplicitShapeDimensions(to_bullet(box.extents));
  object.getWorldTransform().setBasis(btMatrix3x3(btQuaternion(x, y, z, w)));
  object.getWorldTransform().setOrigin(to_bullet(box.center));
}
template <class Shape>
auto unit() {
  if constexpr (std::same_as<Shape, btBoxShape>)
    return btVector3(1, 1, 1);
  else
    return btScalar(1);
}
/// Two shapes that are moved and resized from question to question.
template <class Shape, class First = btSphereShape>
struct Objects {
  First shape_a;
  Shape shape_b;
  btCollisionObject a;
  btCollisionObject b;

  template <class... Sizes>
  explicit Objects(Sizes... sizes) : shape_a(unit<First>()), shape_b(sizes...) {
    a.setCollisionShape(&shape_a);
    b.setCollisionShape(&shape_b);
    // A box's margin makes it smaller and rounder.
    if constexpr (std::same_as<First, btBoxShape>) shape_a.setMargin(0);
    if constexpr (std::same_as<Shape, btBoxShape>) shape_b.setMargin(0);
  }
  template <class A, class B>
  void move(const Two<A, B>& p) {
    set(shape_a, a, p.a);
    set(shape_b, b, p.b);
  }
};

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

/// One algorithm and what it works on.
template <class Collide, class Shape>
struct Called {
  Objects<Shape> objects;
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btCollisionObjectWrapper a{nullptr, &objects.shape_a, &objects.a, objects.a.getWorldTransform(), -1, -1};
  btCollisionObjectWrapper b{nullptr, &objects.shape_b, &objects.b, objects.b.getWorldTransform(), -1, -1};
  btPersistentManifold* manifold = dispatcher.getNewManifold(&objects.a, &objects.b);
  Collide algorithm;
  btDispatcherInfo info;
  Result result{&a, &b};

  template <class Make, class... Sizes>
  explicit Called(const Make& make, Sizes... sizes)
      : objects(sizes...), algorithm(make(manifold, btCollisionAlgorithmConstructionInfo(&dispatcher, 1), &a, &b)) {}

  template <class Second>
  bool test(const Two<Ball, Second>& p) {
    result.hit = false;
    objects.move(p);
    algorithm.processCollision(&a, &b, info, &result);
    return result.hit;
  }
};

class Algorithm {
 public:
  bool test(const Balls& p) { return spheres_.test(p); }
  bool test(const BallAndBox& p) { return box_.test(p); }
  bool compute(const Balls& p, Contact& out) { return spheres_.test(p) && write(spheres_.result, out); }
  bool compute(const BallAndBox& p, Contact& out) { return box_.test(p) && write(box_.result, out); }
  static bool test(const Boxes& p) {
    return TestAabbAgainstAabb2(to_bullet(p.a.min), to_bullet(p.a.max), to_bullet(p.b.min), to_bullet(p.b.max));
  }

 private:
  static bool write(const Result& result, Contact& out) {
    out.normal = from_bullet(result.normal);
    out.point1 = from_bullet(result.point + result.normal * result.distance);
    out.point2 = from_bullet(result.point);
    out.value = result.distance;
    return true;
  }

  using Wrapper = const btCollisionObjectWrapper*;
  Called<btSphereSphereCollisionAlgorithm, btSphereShape> spheres_{
      [](auto* manifold, const auto& info, Wrapper a, Wrapper b) {
        return btSphereSphereCollisionAlgorithm(manifold, info, a, b);
      },
      1.0};
  Called<btSphereBoxCollisionAlgorithm, btBoxShape> box_{[](auto* manifold, const auto& info, Wrapper a, Wrapper b) {
                                                           return btSphereBoxCollisionAlgorithm(manifold, info, a, b,
                                                                                                false);
                                                         },
                                                         btVector3(1, 1, 1)};
};

class World {
 public:
  bool test(const Balls& p) { return test(p, spheres_); }
  bool test(const BallAndBox& p) { return test(p, box_); }
  bool test(const Convexes& p) { return test(obbs(p), rotated_); }
  /// Of a hull, by its vertices.
  struct Made {
    explicit Made(const Convexes& p) : first(Adapted(p.a).shape()), second(Adapted(p.b).shape()) {
      place(a, first);
      place(b, second);
    }
    static void place(btCollisionObject& object, const adapters::BulletShape& shape) {
      object.setCollisionShape(shape.shape.get());
      object.setWorldTransform(shape.place);
    }
    adapters::BulletShape first;
    adapters::BulletShape second;
    btCollisionObject a;
    btCollisionObject b;
  };
  static constexpr bool kHasPlanes = true;
  bool test(Made& made) {
    callback_.hit = false;
    world_.contactPairTest(&made.a, &made.b, callback_);
    return callback_.hit;
  }
  template <class Pair>
  requires kIsOneOf<std::remove_const_t<Pair>, Balls, BallAndBox, Convexes, Made>
  bool compute(Pair& p, Contact& out) {
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
  template <class A, class B, class Made>
  bool test(const Two<A, B>& p, Made& objects) {
    callback_.hit = false;
    objects.move(p);
    world_.contactPairTest(&objects.a, &objects.b, callback_);
    return callback_.hit;
  }

  Objects<btSphereShape> spheres_{1.0};
  Objects<btBoxShape> box_{btVector3(1, 1, 1)};
  Objects<btBoxShape, btBoxShape> rotated_{btVector3(1, 1, 1)};
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
