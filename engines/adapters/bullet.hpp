// What the Bullet adapters share: they are built twice, with and without BT_USE_DOUBLE_PRECISION.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <btBulletCollisionCommon.h>

#include "engines/adapters/adapter.hpp"

namespace contact::adapters {

inline btVector3 bullet_vector(const double* x) {
  return {static_cast<btScalar>(x[0]), static_cast<btScalar>(x[1]), static_cast<btScalar>(x[2])};
}

/// A shape where it belongs.
struct BulletShape {
  explicit BulletShape(const Shape& x) {
    const auto radius = static_cast<btScalar>(x.radius);
    const auto length = static_cast<btScalar>(x.length());
    place.setIdentity();
    place.setOrigin(bullet_vector(x.center));
    if (x.kind == Kind::sphere) {
      shape = std::make_unique<btSphereShape>(radius);
    } else if (x.is_box()) {
      shape = std::make_unique<btBoxShape>(bullet_vector(x.half));
      shape->setMargin(0);  // with one its edges are round
      const auto turn = [&](int row, int column) { return static_cast<btScalar>(x.rotation(row, column)); };
      place.setBasis(
          {turn(0, 0), turn(0, 1), turn(0, 2), turn(1, 0), turn(1, 1), turn(1, 2), turn(2, 0), turn(2, 1), turn(2, 2)});
    } else if (x.kind == Kind::triangle) {
      shape = std::make_unique<btTriangleShape>(bullet_vector(x.vertex(0)), bullet_vector(x.vertex(1)),
                                                bullet_vector(x.vertex(2)));
      shape->setMargin(0);
    } else if (x.kind == Kind::hull) {
      auto hull = std::make_unique<btConvexHullShape>();
      for (int i = 0; i < x.vertices(); ++i) hull->addPoint(bullet_vector(x.vertex(i)), false);
      hull->recalcLocalAabb();
      hull->setMargin(radius);  // which rounds it
      shape = std::move(hull);
    } else if (x.kind == Kind::plane) {
      shape = std::make_unique<btStaticPlaneShape>(bullet_vector(x.normal), static_cast<btScalar>(x.offset));
    } else if (x.axis == 0) {
      shape = std::make_unique<btCapsuleShapeX>(radius, length);
    } else if (x.axis == 1) {
      shape = std::make_unique<btCapsuleShape>(radius, length);
    } else {
      shape = std::make_unique<btCapsuleShapeZ>(radius, length);
    }
  }
  std::unique_ptr<btCollisionShape> shape;
  btTransform place;
};

/// The declaration of the engine `bullet` followed by `suffix`.
inline std::string bullet_declaration(const std::string& suffix, const std::string& pairs,
                                      const std::string& conventions) {
  constexpr bool kDouble = sizeof(btScalar) == sizeof(double);
  const std::string version = std::to_string(BT_BULLET_VERSION / 100) + "." + std::to_string(BT_BULLET_VERSION % 100);
  return R"({"engine":{"name":"bullet)" + suffix + (kDouble ? "" : "-float") + R"(","version":")" + version +
         R"("},"scalar":")" + (kDouble ? "binary64" : "binary32") + R"(","rounds":["orientation"],"pairs":)" + pairs +
         R"(,"conventions":)" + conventions + "}";
}

}  // namespace contact::adapters
