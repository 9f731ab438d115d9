// Bullet: btGjkPairDetector, with its EPA for penetrations, on a btSphereShape and another or a
// btBoxShape.
#include "engines/adapters/bullet.hpp"

#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

namespace contact::adapters {

// The detector gives the point on the second shape; the other is for its user to derive.
std::string declaration() {
  return bullet_declaration(
      "-gjk", R"(["sphere_sphere","sphere_cube"])",
      R"({"normal":"second-to-first","points":"second_only","value_less_contact":false,"shapes":"centered"})");
}

void answer(const Question& q, Answer& said) {
  const btSphereShape a(static_cast<btScalar>(q.a[3]));
  const BulletSecond b(q);
  btVoronoiSimplexSolver simplex;
  btGjkEpaPenetrationDepthSolver penetration;
  btGjkPairDetector detector(&a, b.shape.get(), &simplex, &penetration);
  btGjkPairDetector::ClosestPointInput input;
  input.m_transformA.setIdentity();
  input.m_transformA.setOrigin(bullet_vector(q.a));
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
