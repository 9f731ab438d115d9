// FCL: fcl::collide for spheres and a sphere and a box, fcl::AABB::overlap for boxes.
#include <fcl/config.h>
#include <fcl/math/bv/AABB.h>
#include <fcl/narrowphase/collision.h>

#include "engines/adapters/fcl.hpp"

namespace contact::adapters {

// The `pos` of two spheres divides the line of centres by the radii, which is neither nearest point nor the middle
// between them; so no points are claimed. collide() knows no margin.
std::string declaration() {
  return R"({"engine":{"name":"fcl","version":")" FCL_VERSION
         R"("},"scalar":"binary64","pairs":["sphere_sphere","cube_cube","sphere_cube"],"conventions":{"points":"none",)"
         R"("value":"depth","value_less_contact":false,"margin":"none","coincident":"zero_normal"},)"
         R"("pair_conventions":{"sphere_cube":{"points":"midpoint","coincident":"any_unit_normal","shapes":"centered"}}})";
}

void answer(const Question& q, Answer& said) {
  using Vector = fcl::Vector3d;
  if (q.pair == CONTACT_CUBE_CUBE) {
    const auto box = [](const double* x) { return fcl::AABBd(Vector(x[0], x[1], x[2]), Vector(x[3], x[4], x[5])); };
    said.overlap(box(q.a).overlap(box(q.b)));
    return;
  }
  const bool box = q.pair == CONTACT_SPHERE_CUBE;
  const auto a = fcl_ball(q.a);
  const auto b = box ? fcl_box(q.b) : fcl_ball(q.b);
  fcl::CollisionResultd result;
  said.hit(fcl::collide(&a, &b, fcl::CollisionRequestd(1, true), result) > 0);
  if (!result.isCollision()) return;
  said.normal(result.getContact(0).normal);
  if (box) said.midpoint(result.getContact(0).pos);
  said.value(result.getContact(0).penetration_depth);
}

}  // namespace contact::adapters
