// Ray against triangle: a segment that crosses three points.
#include "contact/ray_triangle.hpp"

#include "contact/pair_functions.hpp"
#include "kernel/crossing_cores.hpp"

namespace contact::inline CONTACT_ABI {
namespace {

kernel::DirectedSegment segment_of(const Ray& ray) { return {ray.origin, ray.direction, ray.length}; }

}  // namespace

bool test_ray_triangle(const Ray& a, const Triangle& b) {
  return kernel::decide(segment_of(a), kernel::Corners{b.vertices}, {0, 0, 0, 0});
}

std::optional<Contact> compute_ray_triangle(const Ray& a, const Triangle& b) {
  return kernel::contact_between(segment_of(a), kernel::Corners{b.vertices}, {0, 0, 0, 0}, {});
}

bool is_hit(const RayAndTriangle& shapes, Distances /*distances*/) { return test_ray_triangle(shapes.a, shapes.b); }
std::optional<Contact> contact_of(const RayAndTriangle& shapes, Distances /*distances*/, ContactPoints /*points*/) {
  return compute_ray_triangle(shapes.a, shapes.b);
}

}  // namespace contact::inline CONTACT_ABI
