// Bullet: btGjkPairDetector, with its EPA for penetrations, on btSphereShape, btBoxShape, btCapsuleShape,
// btTriangleShape and btConvexHullShape.
#include "engines/adapters/bullet.hpp"

#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

namespace contact::adapters {

// The detector gives the point on the second shape; the other is for its user to derive.
std::string declaration() {
  return bullet_declaration(
      "-gjk",
      R"(["sphere_sphere","sphere_cube","sphere_capsule","capsule_capsule","sphere_triangle",)" CONVEX_PAIRS
      "," HULL_PAIRS "]",
      R"({"normal":"second-to-first","points":"second_only","value_less_contact":false,"shapes":"centered"})");
}

void answer(const Question& q, Answer& said) {
  const BulletShape a(q.a);
  const BulletShape b(q.b);
  btVoronoiSimplexSolver simplex;
  btGjkEpaPenetrationDepthSolver penetration;
  const auto convex = [](const BulletShape& x) { return static_cast<const btConvexShape*>(x.shape.get()); };
  btGjkPairDetector detector(convex(a), convex(b), &simplex, &penetration);
  btGjkPairDetector::ClosestPointInput input;
  input.m_transformA = a.place;
  input.m_transformB = b.place;
  btPointCollector found;
  detector.getClosestPoints(input, found, nullptr);
  const bool hit = found.m_hasResult && found.m_distance <= static_cast<btScalar>(q.alarm);
  said.hit(hit);
  if (!hit) return;
  said.normal(found.m_normalOnBInWorld);
  said.point2(found.m_pointInWorld);
  said.value(found.m_distance);
}

}  // namespace contact::adapters
