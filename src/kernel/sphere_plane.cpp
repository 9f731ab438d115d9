// Sphere against plane: a point and a half-space.
#include "contact/sphere_plane.hpp"

#include "contact/pair_functions.hpp"
#include "kernel/cores_stages.hpp"
#include "kernel/plane_cores.hpp"

namespace contact::inline CONTACT_ABI {

bool out_of_line::test_sphere_plane(const Ball& a, const Plane& b, double alarm) {
  return kernel::decide(a.center, kernel::HalfSpace{b.normal, b.offset}, {a.radius, 0, alarm, 0});
}

std::optional<Contact> out_of_line::compute_sphere_plane(const Ball& a, const Plane& b, Distances distances,
                                                         ContactPoints points) {
  return kernel::contact_between(a.center, kernel::HalfSpace{b.normal, b.offset},
                                 {a.radius, 0, distances.alarm, distances.contact}, points);
}

std::optional<Contact> of_hit::compute_sphere_plane(const Ball& a, const Plane& b, Distances distances,
                                                    ContactPoints points) {
  return kernel::contact_of_hit(a, b, distances.contact, points,
                                [&] { return out_of_line::compute_sphere_plane(a, b, distances, points); });
}

bool test_sphere_plane(const Ball& a, const Plane& b, double alarm) {
  return out_of_line::test_sphere_plane(a, b, alarm);
}
std::optional<Contact> compute_sphere_plane(const Ball& a, const Plane& b, Distances distances, ContactPoints points) {
  return out_of_line::compute_sphere_plane(a, b, distances, points);
}

bool is_hit(const BallAndPlane& shapes, Distances distances) {
  return test_sphere_plane(shapes.a, shapes.b, distances.alarm);
}
std::optional<Contact> contact_of(const BallAndPlane& shapes, Distances distances, ContactPoints points) {
  return compute_sphere_plane(shapes.a, shapes.b, distances, points);
}

}  // namespace contact::inline CONTACT_ABI
