// Bullet: btCollisionWorld::contactPairTest, which finds btSphereSphereCollisionAlgorithm, and for a sphere and a
// box btConvexConvexAlgorithm; TestAabbAgainstAabb2 for boxes.
#include "engines/adapters/bullet.hpp"

namespace contact::adapters {
namespace {

/// Keeps the contact that it is told of; the alarm distance is Bullet's m_closestDistanceThreshold.
struct Keep final : btCollisionWorld::ContactResultCallback {
  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                           const btCollisionObjectWrapper*, int, int) override {
    // Of a sphere and a box it tells of gaps up to the contact breaking threshold too: the distance is for the user to
    // compare, as PyBullet does.
    if (every_contact || point.getDistance() <= m_closestDistanceThreshold) {
      found = true;
      contact = point;
    }
    return 0;
  }
  bool every_contact = true;
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
  return bullet_declaration("", R"(["sphere_sphere","cube_cube","sphere_cube"])",
                            R"({"normal":"second-to-first","value_less_contact":false},)"
                            R"("pair_conventions":{"sphere_cube":{"shapes":"centered"}})");
}

void answer(const Question& q, Answer& said) {
  const auto alarm = static_cast<btScalar>(q.alarm);
  if (q.pair == CONTACT_CUBE_CUBE) {
    btVector3 min = bullet_vector(q.a);
    btVector3 max = bullet_vector(q.a + 3);
    const btVector3 margin(alarm, alarm, alarm);
    AabbExpand(min, max, -margin, margin);
    said.overlap(TestAabbAgainstAabb2(min, max, bullet_vector(q.b), bullet_vector(q.b + 3)));
    return;
  }
  static World world;
  btSphereShape shape_a(static_cast<btScalar>(q.a[3]));
  const BulletSecond second(q);
  btCollisionObject a;
  btCollisionObject b;
  a.setCollisionShape(&shape_a);
  b.setCollisionShape(second.shape.get());
  a.getWorldTransform().setOrigin(bullet_vector(q.a));
  b.setWorldTransform(second.place);
  Keep keep;
  keep.m_closestDistanceThreshold = alarm;
  keep.every_contact = q.pair == CONTACT_SPHERE_SPHERE;
  world.world.contactPairTest(&a, &b, keep);
  said.hit(keep.found);
  if (!keep.found) return;
  said.normal(keep.contact.m_normalWorldOnB);
  said.point1(keep.contact.getPositionWorldOnA());
  said.point2(keep.contact.getPositionWorldOnB());
  said.value(keep.contact.getDistance());
}

}  // namespace contact::adapters
