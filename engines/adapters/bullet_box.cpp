// Bullet: btBoxBoxDetector, which its simulation asks of two boxes where contactPairTest asks
// btConvexConvexAlgorithm.
#include "engines/adapters/bullet.hpp"

#include <BulletCollision/CollisionDispatch/btBoxBoxDetector.h>

#include <algorithm>
#include <vector>

namespace contact::adapters {
namespace {

/// Keeps the points that it is told of, which have one normal.
struct Manifold final : btDiscreteCollisionDetectorInterface::Result {
  struct Point {
    btVector3 on_second;
    btScalar distance;
  };
  void setShapeIdentifiersA(int, int) override {}
  void setShapeIdentifiersB(int, int) override {}
  void addContactPoint(const btVector3& normal_on_second, const btVector3& on_second, btScalar distance) override {
    normal = normal_on_second;
    points.push_back({on_second, distance});
  }
  btVector3 normal;
  std::vector<Point> points;
};

}  // namespace

std::string declaration() {
  return bullet_declaration("-box", R"(["obb_obb","cube_obb"])",
                            R"({"normal":"second-to-first","points":"manifold","value_less_contact":false,)"
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
  Manifold manifold;
  detector.getClosestPoints(input, manifold, nullptr);
  said.hit(!manifold.points.empty());
  if (manifold.points.empty()) return;
  said.normal(manifold.normal);
  btScalar least = manifold.points.front().distance;
  for (const Manifold::Point& point : manifold.points) {
    said.add_point(point.on_second, -point.distance);
    least = std::min(least, point.distance);
  }
  said.value(least);
}

}  // namespace contact::adapters
