// Bullet: btCollisionWorld::contactPairTest, which finds btSphereSphereCollisionAlgorithm, for a sphere and a triangle
// btSphereTriangleCollisionAlgorithm, for planes btConvexPlaneCollisionAlgorithm, and for the rest
// btConvexConvexAlgorithm; TestAabbAgainstAabb2 for boxes; btCollisionWorld::rayTestSingle for rays, on a mesh where
// they meet a triangle.
#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include "engines/adapters/bullet.hpp"

namespace contact::adapters {
namespace {

/// Keeps the contact that it is told of; the alarm distance is Bullet's m_closestDistanceThreshold.
struct Keep final : btCollisionWorld::ContactResultCallback {
  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                           const btCollisionObjectWrapper*, int, int) override {
    // Of other shapes than two spheres it tells of gaps up to the contact breaking threshold too: the distance is for
    // the user to compare, as PyBullet does.
    // Where it tells of many points the deepest is the contact.
    if (found && keep_deepest && point.getDistance() >= contact.getDistance()) return 0;
    if (every_contact || point.getDistance() <= m_closestDistanceThreshold) {
      found = true;
      contact = point;
    }
    return 0;
  }
  bool every_contact = true;
  bool keep_deepest = false;
  bool found = false;
  btManifoldPoint contact;
};

struct World {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btCollisionWorld world{&dispatcher, &broadphase, &configuration};
};

/// Casts a ray at a shape. Its normal is the triangle's, however the ray comes.
btCollisionWorld::ClosestRayResultCallback cast(const Shape& ray, btCollisionShape& at, const btTransform& place) {
  btTransform from;
  btTransform to;
  from.setIdentity();
  to.setIdentity();
  from.setOrigin(bullet_vector(ray.start()));
  to.setOrigin(bullet_vector(ray.end));
  btCollisionObject object;
  object.setCollisionShape(&at);
  object.setWorldTransform(place);
  btCollisionWorld::ClosestRayResultCallback found(from.getOrigin(), to.getOrigin());
  found.m_flags |= btTriangleRaycastCallback::kF_KeepUnflippedNormal;
  btCollisionWorld::rayTestSingle(from, to, &object, &at, place, found);
  return found;
}

void crossing(const Shape& line, const Shape& triangle, Answer& said) {
  btTriangleMesh mesh;
  mesh.addTriangle(bullet_vector(triangle.vertex(0)), bullet_vector(triangle.vertex(1)),
                   bullet_vector(triangle.vertex(2)));
  btBvhTriangleMeshShape shape(&mesh, false);
  const auto found = cast(line, shape, btTransform::getIdentity());
  said.hit(found.hasHit());
  if (!found.hasHit()) return;
  said.normal(found.m_hitNormalWorld);
  said.crossing(found.m_hitPointWorld);
}

}  // namespace

// Where a ray enters a sphere is no nearest point: of those decisions alone are claimed. The algorithm of a sphere and
// a triangle does not look at the threshold.
std::string declaration() {
  return bullet_declaration(
      "",
      R"(["sphere_sphere","cube_cube","sphere_cube","sphere_capsule","capsule_capsule","sphere_triangle","ray_sphere",)"
      R"("sphere_plane","capsule_plane","ray_triangle","triangle_line",)" CONVEX_PAIRS "," CONVEX_PLANE_PAIRS
      "," HULL_PAIRS R"(,"hull_plane"])",
      R"({"normal":"second-to-first","value_less_contact":false,"shapes":"centered"},)"
      R"("pair_conventions":{"cube_cube":{"shapes":"given"},"sphere_triangle":{"margin":"none"},)"
      R"("ray_sphere":{"margin":"none","normal":"none","points":"none","value":"none"},)"
      R"("ray_triangle":{"value":"none"},"triangle_line":{"normal":"first-to-second","value":"none"}})");
}

void answer(const Question& q, Answer& said) {
  const auto alarm = static_cast<btScalar>(q.alarm);
  if (q.pair == CONTACT_CUBE_CUBE) {
    btVector3 min = bullet_vector(q.a.numbers);
    btVector3 max = bullet_vector(q.a.numbers + 3);
    const btVector3 margin(alarm, alarm, alarm);
    AabbExpand(min, max, -margin, margin);
    said.overlap(TestAabbAgainstAabb2(min, max, bullet_vector(q.b.numbers), bullet_vector(q.b.numbers + 3)));
    return;
  }
  if (q.pair == CONTACT_RAY_TRIANGLE) return crossing(q.a, q.b, said);
  if (q.pair == CONTACT_TRIANGLE_LINE) return crossing(q.b, q.a, said);
  if (q.pair == CONTACT_RAY_SPHERE) {
    const BulletShape sphere(q.b);
    return said.hit(cast(q.a, *sphere.shape, sphere.place).hasHit());
  }
  static World world;
  const BulletShape first(q.a);
  const BulletShape second(q.b);
  btCollisionObject a;
  btCollisionObject b;
  a.setCollisionShape(first.shape.get());
  b.setCollisionShape(second.shape.get());
  a.setWorldTransform(first.place);
  b.setWorldTransform(second.place);
  Keep keep;
  keep.m_closestDistanceThreshold = q.pair == CONTACT_SPHERE_TRIANGLE ? 0 : alarm;
  keep.every_contact = q.pair == CONTACT_SPHERE_SPHERE;
  keep.keep_deepest = q.pair >= CONTACT_OBB_OBB;
  world.world.contactPairTest(&a, &b, keep);
  said.hit(keep.found);
  if (!keep.found) return;
  said.normal(keep.contact.m_normalWorldOnB);
  said.point1(keep.contact.getPositionWorldOnA());
  said.point2(keep.contact.getPositionWorldOnB());
  said.value(keep.contact.getDistance());
}

}  // namespace contact::adapters
