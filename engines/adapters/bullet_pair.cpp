// Bullet: btCollisionWorld::contactPairTest, which finds btSphereSphereCollisionAlgorithm; TestAabbAgainstAabb2 for
// boxes.
#include "engines/adapters/bullet.hpp"

namespace contact::adapters {
namespace {

/// Keeps the contact that it is told of; the alarm distance is Bullet's m_closestDistanceThreshold.
struct Keep final : btCollisionWorld::ContactResultCallback {
  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                           const btCollisionObjectWrapper*, int, int) override {
    found = true;
    contact = point;
    return 0;
  }
  bool found = false;
  btManifoldPoint contact;
};

struct World {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btCollisionWorld world{&dispatcher, &broadphase, &configuration};
};

}  // namespace

std::string declaration() {
  return bullet_declaration("", R"(["sphere_sphere","cube_cube"])",
                            R"({"normal":"second-to-first","value_less_contact":false})");
}

void answer(const Question& q, Answer& said) {
  const auto alarm = static_cast<btScalar>(q.alarm);
  if (q.boxes) {
    btVector3 min = bullet_vector(q.a);
    btVector3 max = bullet_vector(q.a + 3);
    const btVector3 margin(alarm, alarm, alarm);
    AabbExpand(min, max, -margin, margin);
    said.overlap(TestAabbAgainstAabb2(min, max, bullet_vector(q.b), bullet_vector(q.b + 3)));
    return;
  }
  static World world;
  btSphereShape shape_a(static_cast<btScalar>(q.a[3]));
  btSphereShape shape_b(static_cast<btScalar>(q.b[3]));
  btCollisionObject a;
  btCollisionObject b;
  a.setCollisionShape(&shape_a);
  b.setCollisionShape(&shape_b);
  a.getWorldTransform().setOrigin(bullet_vector(q.a));
  b.getWorldTransform().setOrigin(bullet_vector(q.b));
  Keep keep;
  keep.m_closestDistanceThreshold = alarm;
  world.world.contactPairTest(&a, &b, keep);
  said.hit(keep.found);
  if (!keep.found) return;
  said.normal(keep.contact.m_normalWorldOnB);
  said.point1(keep.contact.getPositionWorldOnA());
  said.point2(keep.contact.getPositionWorldOnB());
  said.value(keep.contact.getDistance());
}

}  // namespace contact::adapters
