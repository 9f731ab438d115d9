// FCL: fcl::collide, and fcl::AABB::overlap for two boxes.
#include <fcl/config.h>
#include <fcl/math/bv/AABB.h>
#include <fcl/narrowphase/collision.h>

#include "engines/adapters/fcl.hpp"

namespace contact::adapters {

// The `pos` of two spheres divides the line of centres by the radii, which is neither nearest point nor the middle
// between them; so no points are claimed. Of a shape and a mesh it says the opposite normal, and of a
// sphere and a mesh the depth as a negative number. collide() knows no margin.
std::string declaration() {
  return R"({"engine":{"name":"fcl","version":")" FCL_VERSION
         R"("},"scalar":"binary64","rounds":["orientation"],"pairs":["sphere_sphere","cube_cube","sphere_cube",)"
         R"("sphere_capsule","capsule_capsule","sphere_triangle","sphere_plane","capsule_plane",)" CONVEX_PAIRS
         "," CONVEX_PLANE_PAIRS "," HULL_PAIRS R"(,"hull_plane"],)"
         R"("conventions":{"points":"none","shapes":"centered",)"
         R"("value":"depth","value_less_contact":false,"margin":"none"},)"
         R"("pair_conventions":{"cube_cube":{"shapes":"given"},"sphere_sphere":{"coincident":"zero_normal"},)"
         R"("sphere_cube":{"points":"midpoint"},"sphere_capsule":{"coincident":"zero_normal"},)"
         R"("sphere_triangle":{"normal":"second-to-first","value":"signed","coincident":"zero_normal"},)"
         R"("capsule_triangle":{"normal":"second-to-first"},"cube_triangle":{"normal":"second-to-first"},)"
         R"("obb_triangle":{"normal":"second-to-first"},"obb_obb":{"depth":"any_separating"},)"
         R"("cube_obb":{"depth":"any_separating"},)"
         R"("sphere_plane":{"points":"midpoint"},"capsule_plane":{"points":"midpoint"}}})";
}

void answer(const Question& q, Answer& said) {
  using Vector = fcl::Vector3d;
  if (q.pair == CONTACT_CUBE_CUBE) {
    const auto box = [](const Shape& x) { return fcl::AABBd(Vector(x.numbers), Vector(x.numbers + 3)); };
    said.overlap(box(q.a).overlap(box(q.b)));
    return;
  }
  const auto a = fcl_object(q.a);
  const auto b = fcl_object(q.b);
  if (!a || !b) return said.unsupported();
  fcl::CollisionResultd result;
  said.hit(fcl::collide(&*a, &*b, fcl::CollisionRequestd(1, true), result) > 0);
  if (!result.isCollision()) return;
  const fcl::Contactd& found = result.getContact(0);
  said.normal(found.normal);
  said.value(found.penetration_depth);
  if (q.pair == CONTACT_SPHERE_CUBE || q.pair == CONTACT_SPHERE_PLANE || q.pair == CONTACT_CAPSULE_PLANE)
    said.midpoint(found.pos);
}

}  // namespace contact::adapters
