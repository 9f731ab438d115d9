// Bullet in double precision: btCollisionWorld over a btDbvtBroadphase, performDiscreteCollisionDetection.
#include <btBulletCollisionCommon.h>

#include "peers/models.hpp"

#ifndef BT_USE_DOUBLE_PRECISION
#error "Bullet is compared in double precision"
#endif

namespace contact::bench {
namespace {

/// All that holds objects, in the order in which it is taken apart.
struct Phases {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btCollisionWorld world{&dispatcher, &broadphase, &configuration};
};

class BulletWorld final : public World {
 public:
  explicit BulletWorld(std::span<const Ball> balls) {
    for (const Ball& ball : balls) {
      shapes_.push_back(std::make_unique<btSphereShape>(ball.radius));
      objects_.push_back(std::make_unique<btCollisionObject>());
      objects_.back()->setCollisionShape(shapes_.back().get());
      objects_.back()->setCollisionFlags(0);  // none stands still
      objects_.back()->getWorldTransform().setOrigin({ball.center[0], ball.center[1], ball.center[2]});
    }
  }
  std::size_t from_nothing() override {
    phases_ = std::make_unique<Phases>();
    for (const auto& object : objects_) phases_->world.addCollisionObject(object.get());
    return again();
  }
  std::size_t again() override {
    phases_->world.performDiscreteCollisionDetection();
    std::size_t contacts = 0;
    for (int i = 0; i < phases_->dispatcher.getNumManifolds(); ++i) {
      const btPersistentManifold& manifold = *phases_->dispatcher.getManifoldByIndexInternal(i);
      bool touches = false;
      for (int k = 0; k < manifold.getNumContacts(); ++k) touches |= manifold.getContactPoint(k).getDistance() <= 0;
      contacts += touches ? 1 : 0;
    }
    return contacts;
  }
  /// By itself the world looks through all pairs for each object.
  void forget() override {
    auto* cache = phases_->broadphase.getOverlappingPairCache();
    btBroadphasePairArray& pairs = cache->getOverlappingPairArray();
    for (int i = 0; i < pairs.size(); ++i) cache->cleanOverlappingPair(pairs[i], &phases_->dispatcher);
    for (const auto& object : objects_) object->setBroadphaseHandle(nullptr);
    phases_.reset();
  }

 private:
  std::vector<std::unique_ptr<btSphereShape>> shapes_;
  std::vector<std::unique_ptr<btCollisionObject>> objects_;
  std::unique_ptr<Phases> phases_;
};

}  // namespace

WorldPeer bullet_world() {
  return {"Bullet",
          [](std::span<const Ball> balls) -> std::unique_ptr<World> { return std::make_unique<BulletWorld>(balls); }};
}

}  // namespace contact::bench
