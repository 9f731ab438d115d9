// What the Bullet adapters share: they are built twice, with and without BT_USE_DOUBLE_PRECISION.
#pragma once

#include <memory>
#include <string>

#include <btBulletCollisionCommon.h>

#include "engines/adapters/adapter.hpp"

namespace contact::adapters {

inline btVector3 bullet_vector(const double* x) {
  return {static_cast<btScalar>(x[0]), static_cast<btScalar>(x[1]), static_cast<btScalar>(x[2])};
}

/// The second shape of a question where it belongs.
struct BulletSecond {
  explicit BulletSecond(const Question& q) {
    place.setIdentity();
    if (q.pair == CONTACT_SPHERE_CUBE) {
      const CenteredBox box(q.b);
      shape = std::make_unique<btBoxShape>(bullet_vector(box.half));
      shape->setMargin(0);  // with one its edges are round
      place.setOrigin(bullet_vector(box.center));
    } else {
      shape = std::make_unique<btSphereShape>(static_cast<btScalar>(q.b[3]));
      place.setOrigin(bullet_vector(q.b));
    }
  }
  std::unique_ptr<btConvexInternalShape> shape;
  btTransform place;
};

/// The declaration of the engine `bullet` followed by `suffix`.
inline std::string bullet_declaration(const std::string& suffix, const std::string& pairs,
                                      const std::string& conventions) {
  constexpr bool kDouble = sizeof(btScalar) == sizeof(double);
  const std::string version = std::to_string(BT_BULLET_VERSION / 100) + "." + std::to_string(BT_BULLET_VERSION % 100);
  return R"({"engine":{"name":"bullet)" + suffix + (kDouble ? "" : "-float") + R"(","version":")" + version +
         R"("},"scalar":")" + (kDouble ? "binary64" : "binary32") + R"(","pairs":)" + pairs + R"(,"conventions":)" +
         conventions + "}";
}

}  // namespace contact::adapters
