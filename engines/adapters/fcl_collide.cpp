// FCL: fcl::collide for spheres, fcl::AABB::overlap for boxes.
#include <fcl/config.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/math/bv/AABB.h>
#include <fcl/narrowphase/collision.h>

#include "engines/adapters/adapter.hpp"

namespace contact::adapters {

// The contact's `pos` divides the line of centres by the radii, which is neither nearest point nor the middle between
// them; so no points are claimed. collide() knows no margin.
std::string declaration() {
  return R"({"engine":{"name":"fcl","version":")" FCL_VERSION
         R"("},"scalar":"binary64","pairs":["sphere_sphere","cube_cube"],"conventions":{"points":"none",)"
         R"("value":"depth","value_less_contact":false,"margin":"none","coincident":"zero_normal"}})";
}

void answer(const Question& q, Answer& said) {
  using Vector = fcl::Vector3d;
  if (q.boxes) {
    const auto box = [](const double* x) { return fcl::AABBd(Vector(x[0], x[1], x[2]), Vector(x[3], x[4], x[5])); };
    said.overlap(box(q.a).overlap(box(q.b)));
    return;
  }
  const auto ball = [](const double* x) {
    return fcl::CollisionObjectd(std::make_shared<fcl::Sphered>(x[3]), fcl::Matrix3d::Identity(),
                                 Vector(x[0], x[1], x[2]));
  };
  const auto a = ball(q.a);
  const auto b = ball(q.b);
  fcl::CollisionResultd result;
  said.hit(fcl::collide(&a, &b, fcl::CollisionRequestd(1, true), result) > 0);
  if (!result.isCollision()) return;
  said.normal(result.getContact(0).normal);
  said.value(result.getContact(0).penetration_depth);
}

}  // namespace contact::adapters
