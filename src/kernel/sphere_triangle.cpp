// Sphere against triangle: a point and three points.
#include "contact/sphere_triangle.hpp"

#include "contact/pair_functions.hpp"
#include "kernel/cores_stages.hpp"
#include "kernel/triangle_cores.hpp"

namespace contact::inline CONTACT_ABI {

bool out_of_line::test_sphere_triangle(const Ball& a, const Triangle& b, double alarm) {
  return kernel::decide(a.center, kernel::Corners{b.vertices}, {a.radius, 0, alarm, 0});
}

std::optional<Contact> out_of_line::compute_sphere_triangle(const Ball& a, const Triangle& b, Distances distances,
                                                            ContactPoints points) {
  return kernel::contact_between(a.center, kernel::Corners{b.vertices},
                                 {a.radius, 0, distances.alarm, distances.contact}, points);
}

bool test_sphere_triangle(const Ball& a, const Triangle& b, double alarm) {
  return out_of_line::test_sphere_triangle(a, b, alarm);
}
std::optional<Contact> compute_sphere_triangle(const Ball& a, const Triangle& b, Distances distances,
                                               ContactPoints points) {
  return out_of_line::compute_sphere_triangle(a, b, distances, points);
}

bool is_hit(const BallAndTriangle& shapes, Distances distances) {
  return test_sphere_triangle(shapes.a, shapes.b, distances.alarm);
}
std::optional<Contact> contact_of(const BallAndTriangle& shapes, Distances distances, ContactPoints points) {
  return compute_sphere_triangle(shapes.a, shapes.b, distances, points);
}

}  // namespace contact::inline CONTACT_ABI
