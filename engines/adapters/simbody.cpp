// Simbody: ContactTracker::SphereSphere, with the alarm distance as its cutoff.
#include <SimTKmath.h>

#include "engines/adapters/adapter.hpp"

namespace contact::adapters {

// The contact's origin lies between the surfaces by their stiffness; so no points are claimed.
std::string declaration() {
  int major = 0;
  int minor = 0;
  int patch = 0;
  SimTK_version_simmath(&major, &minor, &patch);
  return R"({"engine":{"name":"simbody","version":")" + std::to_string(major) + "." + std::to_string(minor) +
         R"("},"scalar":"binary64","pairs":["sphere_sphere"],"conventions":{"points":"none","value":"depth",)"
         R"("value_less_contact":false}})";
}

void answer(const Question& q, Answer& said) {
  using SimTK::ContactGeometry;
  const auto at = [](const Shape& x) { return SimTK::Transform(SimTK::Vec3(x.center[0], x.center[1], x.center[2])); };
  static const SimTK::ContactTracker::SphereSphere tracker;
  const SimTK::UntrackedContact before(SimTK::ContactSurfaceIndex(0), SimTK::ContactSurfaceIndex(1));
  SimTK::Contact now;
  const bool done = tracker.trackContact(before, at(q.a), ContactGeometry::Sphere(q.a.radius), at(q.b),
                                         ContactGeometry::Sphere(q.b.radius), q.alarm, now);
  if (!done) return said.unsupported();  // it gives up on coincident centres, and says so
  const bool hit = !now.isEmpty() && SimTK::CircularPointContact::isInstance(now);
  said.hit(hit);
  if (!hit) return;
  const auto& contact = SimTK::CircularPointContact::getAs(now);
  said.normal(contact.getNormal());
  said.value(contact.getDepth());
}

}  // namespace contact::adapters
