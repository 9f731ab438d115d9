// Simbody: ContactTracker::SphereSphere and HalfSpaceSphere, with the alarm distance as its cutoff.
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
         R"("},"scalar":"binary64","pairs":["sphere_sphere","sphere_plane"],"conventions":{"points":"none","value":"depth",)"
         R"("value_less_contact":false},)"
         R"("pair_conventions":{"sphere_plane":{"normal":"second-to-first","shapes":"centered"}}})";
}

void answer(const Question& q, Answer& said) {
  using SimTK::ContactGeometry;
  const auto at = [](const Shape& x) { return SimTK::Transform(SimTK::Vec3(x.center[0], x.center[1], x.center[2])); };
  const auto ball = [](const Shape& x) { return ContactGeometry::Sphere(x.radius); };
  static const SimTK::ContactTracker::SphereSphere spheres;
  static const SimTK::ContactTracker::HalfSpaceSphere on_plane;
  const SimTK::UntrackedContact before(SimTK::ContactSurfaceIndex(0), SimTK::ContactSurfaceIndex(1));
  SimTK::Contact now;
  bool done = false;
  SimTK::Rotation turned;  // from the first surface's frame, which the contact is told in
  if (q.pair == CONTACT_SPHERE_PLANE) {
    // Its half-space is where x > 0, and comes first.
    const SimTK::Vec3 normal(q.b.normal[0], q.b.normal[1], q.b.normal[2]);
    turned = SimTK::Rotation(SimTK::UnitVec3(-normal), SimTK::XAxis);
    const SimTK::Transform place(turned, q.b.offset * normal);
    done = on_plane.trackContact(before, place, ContactGeometry::HalfSpace(), at(q.a), ball(q.a), q.alarm, now);
  } else {
    done = spheres.trackContact(before, at(q.a), ball(q.a), at(q.b), ball(q.b), q.alarm, now);
  }
  if (!done) return said.unsupported();  // it gives up on coincident centres, and says so
  const bool hit = !now.isEmpty() && SimTK::CircularPointContact::isInstance(now);
  said.hit(hit);
  if (!hit) return;
  const auto& contact = SimTK::CircularPointContact::getAs(now);
  said.normal(turned * contact.getNormal());
  said.value(contact.getDepth());
}

}  // namespace contact::adapters
