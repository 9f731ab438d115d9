// Sphere against capsule: a point and a segment.
#include "contact/sphere_capsule.hpp"

#include "contact/pair_functions.hpp"
#include "kernel/cores_stages.hpp"
#include "kernel/segment_cores.hpp"

namespace contact::inline CONTACT_ABI {

bool out_of_line::test_sphere_capsule(const Ball& a, const Capsule& b, double alarm) {
  return kernel::decide(a.center, kernel::Segment{b.start, b.end}, {a.radius, b.radius, alarm, 0});
}

std::optional<Contact> out_of_line::compute_sphere_capsule(const Ball& a, const Capsule& b, Distances distances,
                                                           ContactPoints points) {
  return kernel::contact_between(a.center, kernel::Segment{b.start, b.end},
                                 {a.radius, b.radius, distances.alarm, distances.contact}, points);
}

bool test_sphere_capsule(const Ball& a, const Capsule& b, double alarm) {
  return out_of_line::test_sphere_capsule(a, b, alarm);
}
std::optional<Contact> compute_sphere_capsule(const Ball& a, const Capsule& b, Distances distances,
                                              ContactPoints points) {
  return out_of_line::compute_sphere_capsule(a, b, distances, points);
}

bool is_hit(const BallAndCapsule& shapes, Distances distances) {
  return test_sphere_capsule(shapes.a, shapes.b, distances.alarm);
}
std::optional<Contact> contact_of(const BallAndCapsule& shapes, Distances distances, ContactPoints points) {
  return compute_sphere_capsule(shapes.a, shapes.b, distances, points);
}

}  // namespace contact::inline CONTACT_ABI
