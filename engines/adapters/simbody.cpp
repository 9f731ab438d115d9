// Simbody: ContactTracker::SphereSphere, HalfSpaceSphere and HalfSpaceBrick, with the alarm distance as its cutoff.
#include <SimTKmath.h>

#include "engines/adapters/adapter.hpp"

namespace contact::adapters {

// The contact's origin lies between the surfaces by their stiffness; so no points are claimed. Of a brick it names the
// lowest vertex, and `height >= cutoff` is apart.
std::string declaration() {
  int major = 0;
  int minor = 0;
  int patch = 0;
  SimTK_version_simmath(&major, &minor, &patch);
  const std::string of_brick = R"({"normal":"none","touching_overlap":"open",)"
                               R"("touching_contact":"open","margin":"exclusive"})";
  return R"({"engine":{"name":"simbody","version":")" + std::to_string(major) + "." + std::to_string(minor) +
         R"("},"scalar":"binary64","rounds":["orientation"],"pairs":["sphere_sphere","sphere_plane","cube_plane","obb_plane"],"conventions":{"points":"none","value":"depth",)"
         R"("value_less_contact":false,"shapes":"centered"},"pair_conventions":{"sphere_plane":{"normal":"second-to-first"},)"
         R"("cube_plane":)" +
         of_brick + R"(,"obb_plane":)" + of_brick + "}}";
}

void answer(const Question& q, Answer& said) {
  using SimTK::ContactGeometry;
  const auto at = [](const Shape& x) {
    SimTK::Mat33 turn;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) turn(row, column) = x.rotation(row, column);
    return SimTK::Transform(SimTK::Rotation(turn, true), SimTK::Vec3(x.center[0], x.center[1], x.center[2]));
  };
  const auto ball = [](const Shape& x) { return ContactGeometry::Sphere(x.radius); };
  static const SimTK::ContactTracker::SphereSphere spheres;
  static const SimTK::ContactTracker::HalfSpaceSphere on_plane;
  static const SimTK::ContactTracker::HalfSpaceBrick brick_on_plane;
  const SimTK::UntrackedContact before(SimTK::ContactSurfaceIndex(0), SimTK::ContactSurfaceIndex(1));
  SimTK::Contact now;
  bool done = false;
  SimTK::Rotation turned;  // from the first surface's frame, which the contact is told in
  if (q.b.kind == Kind::plane) {
    // Its half-space is where x > 0, and comes first.
    const SimTK::Vec3 normal(q.b.normal[0], q.b.normal[1], q.b.normal[2]);
    turned = SimTK::Rotation(SimTK::UnitVec3(-normal), SimTK::XAxis);
    const SimTK::Transform place(turned, q.b.offset * normal);
    if (q.a.is_box()) {
      const ContactGeometry::Brick brick(SimTK::Vec3(q.a.half[0], q.a.half[1], q.a.half[2]));
      done = brick_on_plane.trackContact(before, place, ContactGeometry::HalfSpace(), at(q.a), brick, q.alarm, now);
    } else {
      done = on_plane.trackContact(before, place, ContactGeometry::HalfSpace(), at(q.a), ball(q.a), q.alarm, now);
    }
  } else {
    done = spheres.trackContact(before, at(q.a), ball(q.a), at(q.b), ball(q.b), q.alarm, now);
  }
  if (!done) return said.unsupported();  // it gives up on coincident centres, and says so
  const bool on_brick = !now.isEmpty() && SimTK::BrickHalfSpaceContact::isInstance(now);
  const bool hit = on_brick || (!now.isEmpty() && SimTK::CircularPointContact::isInstance(now));
  said.hit(hit);
  if (!hit) return;
  if (on_brick) return said.value(SimTK::BrickHalfSpaceContact::getAs(now).getDepth());
  const auto& contact = SimTK::CircularPointContact::getAs(now);
  said.normal(turned * contact.getNormal());
  said.value(contact.getDepth());
}

}  // namespace contact::adapters
