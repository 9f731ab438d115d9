// Bullet: btBoxBoxDetector, which its simulation asks of two boxes where contactPairTest asks
// btConvexConvexAlgorithm.
#include "engines/adapters/bullet.hpp"

#include <BulletCollision/CollisionDispatch/btBoxBoxDetector.h>

namespace contact::adapters {
namespace {

/// Keeps the deepest of the points that it is told of.
struct Deepest final : btDiscreteCollisionDetectorInterface::Result {
  void setShapeIdentifiersA(int, int) override {}
  void setShapeIdentifiersB(int, int) override {}
  void addContactPoint(const btVector3& normal_on_second, const btVector3& on_second, btScalar signed_depth) override {
    if (found && signed_depth >= depth) return;
    found = true;
    normal = normal_on_second;
    point = on_second;
    depth = signed_depth;
  }
  bool found = false;
  btVector3 normal;
  btVector3 point;
  btScalar depth = 0;
};

}  // namespace

std::string declaration() {
  return bullet_declaration("-box", R"(["obb_obb","cube_obb"])",
                            R"({"normal":"second-to-first","points":"second_only","value_less_contact":false,)"
                            R"("margin":"none","shapes":"centered","depth":"any_separating"})");
}

void answer(const Question& q, Answer& said) {
  const BulletShape a(q.a);
  const BulletShape b(q.b);
  const auto box = [](const BulletShape& x) { return static_cast<const btBoxShape*>(x.shape.get()); };
  btBoxBoxDetector detector(box(a), box(b));
  btDiscreteCollisionDetectorInterface::ClosestPointInput input;
  input.m_transformA = a.place;
  input.m_transformB = b.place;
  Deepest deepest;
  detector.getClosestPoints(input, deepest, nullptr);
  said.hit(deepest.found);
  if (!deepest.found) return;
  said.normal(deepest.normal);
  said.point2(deepest.point);
  said.value(deepest.depth);
}

}  // namespace contact::adapters
