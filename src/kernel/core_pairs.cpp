// The functions of the pairs that two cores answer, and of those with files of their own what is the same for all.
#include "kernel/core_pairs.hpp"

#include "contact/capsule_capsule.hpp"
#include "contact/capsule_plane.hpp"
#include "contact/pair_functions.hpp"
#include "contact/ray_sphere.hpp"
#include "contact/ray_triangle.hpp"
#include "contact/sphere_capsule.hpp"
#include "contact/sphere_cube.hpp"
#include "contact/sphere_plane.hpp"
#include "contact/sphere_sphere.hpp"
#include "contact/sphere_triangle.hpp"
#include "contact/triangle_line.hpp"
#include "kernel/cores_stages.hpp"

namespace contact::inline CONTACT_ABI {

/// Of a pair with a distance, what is not inline and what knows no pair by name.
#define CONTACT_FORWARD(name, A, B)                                                                          \
  bool test_##name(const A& a, const B& b, double alarm) { return out_of_line::test_##name(a, b, alarm); }   \
  std::optional<Contact> compute_##name(const A& a, const B& b, Distances distances, ContactPoints points) { \
    return out_of_line::compute_##name(a, b, distances, points);                                             \
  }                                                                                                          \
  bool is_hit(const Two<A, B>& shapes, Distances distances) {                                                \
    return test_##name(shapes.a, shapes.b, distances.alarm);                                                 \
  }                                                                                                          \
  std::optional<Contact> contact_of(const Two<A, B>& shapes, Distances distances, ContactPoints points) {    \
    return compute_##name(shapes.a, shapes.b, distances, points);                                            \
  }
/// Of one that two cores answer, all.
#define CONTACT_DISTANCE(name, A, B)                                                                            \
  bool out_of_line::test_##name(const A& a, const B& b, double alarm) {                                         \
    return kernel::decide(kernel::core_of(a), kernel::core_of(b), kernel::lengths_of(a, b, {alarm, 0}));        \
  }                                                                                                             \
  std::optional<Contact> out_of_line::compute_##name(const A& a, const B& b, Distances distances,               \
                                                     ContactPoints points) {                                    \
    return kernel::contact_between(kernel::core_of(a), kernel::core_of(b), kernel::lengths_of(a, b, distances), \
                                   points);                                                                     \
  }                                                                                                             \
  CONTACT_FORWARD(name, A, B)
/// Where plain arithmetic has said that there is a contact.
#define CONTACT_OF_HIT(name, A, B)                                                                                   \
  std::optional<Contact> of_hit::compute_##name(const A& a, const B& b, Distances distances, ContactPoints points) { \
    return kernel::contact_of_hit(a, b, distances.contact, points,                                                   \
                                  [&] { return out_of_line::compute_##name(a, b, distances, points); });             \
  }
/// Of a pair without a distance, all.
#define CONTACT_CROSSING(name, A, B)                                                                              \
  bool out_of_line::test_##name(const A& a, const B& b) {                                                         \
    return kernel::decide(kernel::core_of(a), kernel::core_of(b), {0, 0, 0, 0});                                  \
  }                                                                                                               \
  std::optional<Contact> out_of_line::compute_##name(const A& a, const B& b) {                                    \
    return kernel::contact_between(kernel::core_of(a), kernel::core_of(b), {0, 0, 0, 0}, {});                     \
  }                                                                                                               \
  std::optional<Contact> of_hit::compute_##name(const A& a, const B& b) {                                         \
    return kernel::contact_of_hit(a, b, 0, {}, [&] { return out_of_line::compute_##name(a, b); });                \
  }                                                                                                               \
  bool test_##name(const A& a, const B& b) { return out_of_line::test_##name(a, b); }                             \
  std::optional<Contact> compute_##name(const A& a, const B& b) { return out_of_line::compute_##name(a, b); }     \
  bool is_hit(const Two<A, B>& shapes, Distances /*distances*/) { return test_##name(shapes.a, shapes.b); }       \
  std::optional<Contact> contact_of(const Two<A, B>& shapes, Distances /*distances*/, ContactPoints /*points*/) { \
    return compute_##name(shapes.a, shapes.b);                                                                    \
  }

CONTACT_FORWARD(sphere_sphere, Ball, Ball)
CONTACT_FORWARD(sphere_cube, Ball, Box)
CONTACT_OF_HIT(sphere_cube, Ball, Box)
CONTACT_DISTANCE(sphere_capsule, Ball, Capsule)
CONTACT_DISTANCE(capsule_capsule, Capsule, Capsule)
CONTACT_DISTANCE(sphere_triangle, Ball, Triangle)
CONTACT_DISTANCE(ray_sphere, Ray, Ball)
CONTACT_DISTANCE(sphere_plane, Ball, Plane)
CONTACT_OF_HIT(sphere_plane, Ball, Plane)
CONTACT_DISTANCE(capsule_plane, Capsule, Plane)
CONTACT_OF_HIT(capsule_plane, Capsule, Plane)
CONTACT_CROSSING(ray_triangle, Ray, Triangle)
CONTACT_CROSSING(triangle_line, Triangle, Line)
#undef CONTACT_FORWARD
#undef CONTACT_DISTANCE
#undef CONTACT_OF_HIT
#undef CONTACT_CROSSING

}  // namespace contact::inline CONTACT_ABI
