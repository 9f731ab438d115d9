// What the Bullet adapters share: they are built twice, with and without BT_USE_DOUBLE_PRECISION.
#pragma once

#include <string>

#include <btBulletCollisionCommon.h>

#include "engines/adapters/adapter.hpp"

namespace contact::adapters {

inline btVector3 bullet_vector(const double* x) {
  return {static_cast<btScalar>(x[0]), static_cast<btScalar>(x[1]), static_cast<btScalar>(x[2])};
}

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
