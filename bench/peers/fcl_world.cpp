// FCL: DynamicAABBTreeCollisionManager, and fcl::collide with one contact on every pair that it gives.
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>

#include "peers/models.hpp"

namespace contact::bench {
namespace {

class FclWorld final : public World {
 public:
  explicit FclWorld(std::span<const Ball> balls) {
    for (const Ball& ball : balls) {
      fcl::Transform3d at = fcl::Transform3d::Identity();
      at.translation() = ball.center;
      made_.push_back(std::make_unique<fcl::CollisionObjectd>(std::make_shared<fcl::Sphered>(ball.radius), at));
      objects_.push_back(made_.back().get());
    }
  }
  std::size_t from_nothing() override {
    manager_ = std::make_unique<fcl::DynamicAABBTreeCollisionManagerd>();
    manager_->registerObjects(objects_);
    manager_->setup();
    return count();
  }
  std::size_t again() override {
    manager_->update();
    return count();
  }
  [[nodiscard]] bool is_built() const override { return manager_ != nullptr; }
  void forget() override { manager_.reset(); }

 private:
  std::size_t count() {
    std::size_t contacts = 0;
    manager_->collide(&contacts, [](fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* data) {
      fcl::CollisionResultd result;
      *static_cast<std::size_t*>(data) += fcl::collide(a, b, fcl::CollisionRequestd(1, true), result) > 0 ? 1 : 0;
      return false;
    });
    return contacts;
  }

  std::vector<std::unique_ptr<fcl::CollisionObjectd>> made_;
  std::vector<fcl::CollisionObjectd*> objects_;
  std::unique_ptr<fcl::DynamicAABBTreeCollisionManagerd> manager_;
};

}  // namespace

WorldPeer fcl_world() {
  return {"FCL",
          [](std::span<const Ball> balls) -> std::unique_ptr<World> { return std::make_unique<FclWorld>(balls); }};
}

}  // namespace contact::bench
