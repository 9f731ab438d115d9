// Ray against triangle: a segment that crosses three points.
#include "contact/ray_triangle.hpp"

#include "contact/pair_functions.hpp"
#include "kernel/cores_stages.hpp"
#include "kernel/crossing_cores.hpp"

namespace contact::inline CONTACT_ABI {
namespace {

kernel::DirectedSegment segment_of(const Ray& ray) { return {ray.origin, ray.direction, ray.length}; }

}  // namespace

bool out_of_line::test_ray_triangle(const Ray& a, const Triangle& b) {
  return kernel::decide(segment_of(a), kernel::Corners{b.vertices}, {0, 0, 0, 0});
}

std::optional<Contact> out_of_line::compute_ray_triangle(const Ray& a, const Triangle& b) {
  return kernel::contact_between(segment_of(a), kernel::Corners{b.vertices}, {0, 0, 0, 0}, {});
}

std::optional<Contact> of_hit::compute_ray_triangle(const Ray& a, const Triangle& b) {
  return kernel::contact_of_hit(a, b, 0, {}, [&] { return out_of_line::compute_ray_triangle(a, b); });
}

bool test_ray_triangle(const Ray& a, const Triangle& b) { return out_of_line::test_ray_triangle(a, b); }
std::optional<Contact> compute_ray_triangle(const Ray& a, const Triangle& b) {
  return out_of_line::compute_ray_triangle(a, b);
}

bool is_hit(const RayAndTriangle& shapes, Distances /*distances*/) { return test_ray_triangle(shapes.a, shapes.b); }
std::optional<Contact> contact_of(const RayAndTriangle& shapes, Distances /*distances*/, ContactPoints /*points*/) {
  return compute_ray_triangle(shapes.a, shapes.b);
}

}  // namespace contact::inline CONTACT_ABI
