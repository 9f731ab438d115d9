// Ray against sphere: a segment and a point.
#include "contact/ray_sphere.hpp"

#include "contact/pair_functions.hpp"
#include "kernel/cores_stages.hpp"
#include "kernel/segment_cores.hpp"

namespace contact::inline CONTACT_ABI {
namespace {

kernel::DirectedSegment core_of(const Ray& ray) { return {ray.origin, ray.direction, ray.length}; }

}  // namespace

bool out_of_line::test_ray_sphere(const Ray& a, const Ball& b, double alarm) {
  return kernel::decide(core_of(a), b.center, {0, b.radius, alarm, 0});
}

std::optional<Contact> out_of_line::compute_ray_sphere(const Ray& a, const Ball& b, Distances distances,
                                                       ContactPoints points) {
  return kernel::contact_between(core_of(a), b.center, {0, b.radius, distances.alarm, distances.contact}, points);
}

bool test_ray_sphere(const Ray& a, const Ball& b, double alarm) { return out_of_line::test_ray_sphere(a, b, alarm); }
std::optional<Contact> compute_ray_sphere(const Ray& a, const Ball& b, Distances distances, ContactPoints points) {
  return out_of_line::compute_ray_sphere(a, b, distances, points);
}

bool is_hit(const RayAndBall& shapes, Distances distances) {
  return test_ray_sphere(shapes.a, shapes.b, distances.alarm);
}
std::optional<Contact> contact_of(const RayAndBall& shapes, Distances distances, ContactPoints points) {
  return compute_ray_sphere(shapes.a, shapes.b, distances, points);
}

}  // namespace contact::inline CONTACT_ABI
