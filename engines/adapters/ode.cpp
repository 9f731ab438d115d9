// Open Dynamics Engine: dCollide on two sphere geoms.
#include <ode/ode.h>

#include "engines/adapters/adapter.hpp"

namespace contact::adapters {

std::string declaration() {
  return R"({"engine":{"name":"ode","version":")" dODE_VERSION R"("},"scalar":")" +
         std::string(sizeof(dReal) == sizeof(double) ? "binary64" : "binary32") +
         R"(","pairs":["sphere_sphere"],"conventions":{"normal":"second-to-first","points":"midpoint",)"
         R"("value":"depth","value_less_contact":false,"margin":"none"}})";
}

void answer(const Question& q, Answer& said) {
  [[maybe_unused]] static const int initialized = dInitODE2(0);
  static const dGeomID a = dCreateSphere(nullptr, 1);
  static const dGeomID b = dCreateSphere(nullptr, 1);
  const auto set = [](dGeomID geom, const double* x) {
    dGeomSphereSetRadius(geom, static_cast<dReal>(x[3]));
    dGeomSetPosition(geom, static_cast<dReal>(x[0]), static_cast<dReal>(x[1]), static_cast<dReal>(x[2]));
  };
  set(a, q.a);
  set(b, q.b);
  dContactGeom contact;
  const bool hit = dCollide(a, b, 1, &contact, sizeof contact) > 0;
  said.hit(hit);
  if (!hit) return;
  said.normal(contact.normal);
  said.midpoint(contact.pos);
  said.value(contact.depth);
}

}  // namespace contact::adapters
