// Open Dynamics Engine: dCollide on a sphere geom and another or a box geom.
#include <ode/ode.h>

#include "engines/adapters/adapter.hpp"

namespace contact::adapters {

// dCollideSphereBox puts its contact on the box.
std::string declaration() {
  return R"({"engine":{"name":"ode","version":")" dODE_VERSION R"("},"scalar":")" +
         std::string(sizeof(dReal) == sizeof(double) ? "binary64" : "binary32") +
         R"(","pairs":["sphere_sphere","sphere_cube"],"conventions":{"normal":"second-to-first","points":"midpoint",)"
         R"("value":"depth","value_less_contact":false,"margin":"none"},)"
         R"("pair_conventions":{"sphere_cube":{"points":"second_only","shapes":"centered"}}})";
}

void answer(const Question& q, Answer& said) {
  [[maybe_unused]] static const int initialized = dInitODE2(0);
  static const dGeomID a = dCreateSphere(nullptr, 1);
  static const dGeomID sphere = dCreateSphere(nullptr, 1);
  static const dGeomID box = dCreateBox(nullptr, 1, 1, 1);
  const auto place = [](dGeomID geom, const double* x) {
    dGeomSetPosition(geom, static_cast<dReal>(x[0]), static_cast<dReal>(x[1]), static_cast<dReal>(x[2]));
  };
  const auto set = [&](dGeomID geom, const double* x) {
    dGeomSphereSetRadius(geom, static_cast<dReal>(x[3]));
    place(geom, x);
  };
  set(a, q.a);
  const bool boxed = q.pair == CONTACT_SPHERE_CUBE;
  const dGeomID b = boxed ? box : sphere;
  if (boxed) {
    const CenteredBox x(q.b);
    dGeomBoxSetLengths(box, static_cast<dReal>(x.size[0]), static_cast<dReal>(x.size[1]),
                       static_cast<dReal>(x.size[2]));
    place(box, x.center);
  } else {
    set(sphere, q.b);
  }
  dContactGeom contact;
  const bool hit = dCollide(a, b, 1, &contact, sizeof contact) > 0;
  said.hit(hit);
  if (!hit) return;
  said.normal(contact.normal);
  if (boxed)
    said.point2(contact.pos);
  else
    said.midpoint(contact.pos);
  said.value(contact.depth);
}

}  // namespace contact::adapters
