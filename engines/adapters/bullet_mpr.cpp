// Bullet: btComputeMprPenetration, the Minkowski portal refinement of its headers, which computes in single precision
// whatever btScalar is.
#include "engines/adapters/bullet.hpp"

#include <BulletCollision/NarrowPhaseCollision/btMprPenetration.h>

namespace contact::adapters {
namespace {

/// A convex shape as its templates ask for it; as in Bullet's own test/collision.
struct Convex {
  explicit Convex(const Shape& x) : placed(x) {}
  [[nodiscard]] btVector3 getObjectCenterInWorld() const { return placed.place.getOrigin(); }
  [[nodiscard]] const btTransform& getWorldTransform() const { return placed.place; }
  [[nodiscard]] btVector3 getLocalSupportWithMargin(const btVector3& direction) const {
    return static_cast<const btConvexShape&>(*placed.shape).localGetSupportingVertex(direction);
  }
  BulletShape placed;
};

}  // namespace

// The centre of a triangle's frame is none of its inner points, from which the refinement must begin; so no triangles.
std::string declaration() {
  return bullet_declaration(
      "-mpr",
      R"(["sphere_sphere","sphere_cube","sphere_capsule","capsule_capsule","obb_obb",)"
      R"("sphere_obb","capsule_cube","capsule_obb","cube_obb"])",
      R"({"normal":"second-to-first","points":"none","value_less_contact":false,"margin":"none","shapes":"centered"})");
}

void answer(const Question& q, Answer& said) {
  const btMprCollisionDescription description;
  btMprDistanceInfo found;
  const bool hit = btComputeMprPenetration(Convex(q.a), Convex(q.b), description, &found) == 0;
  said.hit(hit);
  if (!hit) return;
  said.normal(found.m_normalBtoA);
  said.value(found.m_distance);
}

}  // namespace contact::adapters
