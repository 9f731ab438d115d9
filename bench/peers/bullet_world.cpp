// Bullet in double precision: btCollisionWorld over a btDbvtBroadphase, performDiscreteCollisionDetection.
#include <btBulletCollisionCommon.h>

#include "peers/models.hpp"

#ifndef BT_USE_DOUBLE_PRECISION
#error "Bullet is compared in double precision"
#endif

namespace contact::bench {
namespace {

/// Room for the pairs whose boxes meet: what does not fit into these pools is taken from the system one by one, which
/// takes many times as long.
btDefaultCollisionConstructionInfo pools(std::size_t balls) {
  btDefaultCollisionConstructionInfo info;
  info.m_defaultMaxPersistentManifoldPoolSize = static_cast<int>(8 * balls);
  info.m_defaultMaxCollisionAlgorithmPoolSize = static_cast<int>(8 * balls);
  return info;
}

/// What is built anew, in the order in which it is taken down.
struct Phases {
  btDbvtBroadphase broadphase;
  btCollisionWorld world;

  Phases(btCollisionDispatcher& dispatcher, btCollisionConfiguration& configuration)
      : world(&dispatcher, &broadphase, &configuration) {
    broadphase.m_deferedcollide = true;  // the pairs of all objects at once
  }
};

class BulletWorld final : public World {
 public:
  explicit BulletWorld(std::span<const Ball> balls) : configuration_(pools(balls.size())) {
    for (const Ball& ball : balls) {
      shapes_.push_back(std::make_unique<btSphereShape>(ball.radius));
      objects_.push_back(std::make_unique<btCollisionObject>());
      objects_.back()->setCollisionShape(shapes_.back().get());
      objects_.back()->setCollisionFlags(0);  // none stands still
      objects_.back()->getWorldTransform().setOrigin({ball.center[0], ball.center[1], ball.center[2]});
    }
  }
  std::size_t from_nothing() override {
    phases_ = std::make_unique<Phases>(dispatcher_, configuration_);
    for (const auto& object : objects_) phases_->world.addCollisionObject(object.get());
    return again();
  }
  std::size_t again() override {
    phases_->world.performDiscreteCollisionDetection();
    std::size_t contacts = 0;
    for (int i = 0; i < dispatcher_.getNumManifolds(); ++i) {
      const btPersistentManifold& manifold = *dispatcher_.getManifoldByIndexInternal(i);
      bool touches = false;
      for (int k = 0; k < manifold.getNumContacts(); ++k) touches |= manifold.getContactPoint(k).getDistance() <= 0;
      contacts += touches ? 1 : 0;
    }
    return contacts;
  }
  ~BulletWorld() override { tear_down(); }
  [[nodiscard]] bool is_built() const override { return phases_ != nullptr; }
  void forget() override { tear_down(); }

 private:
  /// By itself the world looks through all pairs for each object.
  void tear_down() {
    if (!phases_) return;
    auto* cache = phases_->broadphase.getOverlappingPairCache();
    btBroadphasePairArray& pairs = cache->getOverlappingPairArray();
    for (int i = 0; i < pairs.size(); ++i) cache->cleanOverlappingPair(pairs[i], &dispatcher_);
    for (const auto& object : objects_) object->setBroadphaseHandle(nullptr);
    phases_.reset();
  }

  std::vector<std::unique_ptr<btSphereShape>> shapes_;
  std::vector<std::unique_ptr<btCollisionObject>> objects_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  std::unique_ptr<Phases> phases_;
};

}  // namespace

WorldPeer bullet_world() {
  return {"Bullet",
          [](std::span<const Ball> balls) -> std::unique_ptr<World> { return std::make_unique<BulletWorld>(balls); }};
}

}  // namespace contact::bench
