// Open Dynamics Engine: dCollide on sphere, box and capsule geoms.
#include <ode/ode.h>

#include <array>

#include "engines/adapters/adapter.hpp"

namespace contact::adapters {

// dCollideSphereBox puts its contact on the box.
std::string declaration() {
  return R"({"engine":{"name":"ode","version":")" dODE_VERSION R"("},"scalar":")" +
         std::string(sizeof(dReal) == sizeof(double) ? "binary64" : "binary32") +
         R"(","pairs":["sphere_sphere","sphere_cube","sphere_capsule","capsule_capsule"],"conventions":{"normal":"second-to-first","points":"midpoint",)"
         R"("value":"depth","value_less_contact":false,"margin":"none","shapes":"centered"},)"
         R"("pair_conventions":{"sphere_cube":{"points":"second_only"}}})";
}

void answer(const Question& q, Answer& said) {
  [[maybe_unused]] static const int initialized = dInitODE2(0);
  // One of each kind as the first shape and one as the second.
  static const auto made = [] {
    return std::array{dCreateSphere(nullptr, 1), dCreateBox(nullptr, 1, 1, 1), dCreateCapsule(nullptr, 1, 1)};
  };
  static const auto first = made();
  static const auto second = made();
  const auto set = [](const auto& geoms, const Shape& x) {
    const auto real = [](double number) { return static_cast<dReal>(number); };
    const dGeomID geom = geoms[static_cast<std::size_t>(x.kind)];
    if (x.kind == Kind::sphere) dGeomSphereSetRadius(geom, real(x.radius));
    if (x.kind == Kind::box) dGeomBoxSetLengths(geom, real(x.size[0]), real(x.size[1]), real(x.size[2]));
    if (x.kind == Kind::capsule) dGeomCapsuleSetParams(geom, real(x.radius), real(x.length()));
    dMatrix3 upright{};
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) upright[4 * row + column] = real(x.rotation(row, column));
    dGeomSetRotation(geom, upright);
    dGeomSetPosition(geom, real(x.center[0]), real(x.center[1]), real(x.center[2]));
    return geom;
  };
  const dGeomID a = set(first, q.a);
  const dGeomID b = set(second, q.b);
  dContactGeom contact;
  const bool hit = dCollide(a, b, 1, &contact, sizeof contact) > 0;
  said.hit(hit);
  if (!hit) return;
  said.normal(contact.normal);
  if (q.pair == CONTACT_SPHERE_CUBE)
    said.point2(contact.pos);
  else
    said.midpoint(contact.pos);
  said.value(contact.depth);
}

}  // namespace contact::adapters
