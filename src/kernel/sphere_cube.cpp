// Sphere against cube: outside the box it is the sphere pair at the nearest point of the box, whose coordinates are
// numbers of the question. Inside, every number is a sum of such numbers.
#include "contact/sphere_cube.hpp"

#include "contact/exact_sum.hpp"
#include "contact/pair_functions.hpp"
#include "contact/sphere_sphere.hpp"
#include "kernel/floating_point_environment.hpp"

namespace contact {
namespace {

/// The nearest point of the box, as a sphere without extent.
Ball nearest_point(const Vector3& center, const Box& box) { return {center.cwiseMax(box.min).cwiseMin(box.max), 0}; }

/// A face of the box, and the depth of a centre inside as two numbers whose sum it is.
struct Face {
  int axis;
  double sign;  ///< of the normal, which points into the box
  double at;
  double depth[2];

  [[nodiscard]] double rounded_depth() const { return depth[0] + depth[1]; }
};

Face face_of(const Vector3& center, const Box& box, int axis, bool is_min) {
  if (is_min) return {axis, 1, box.min[axis], {center[axis], -box.min[axis]}};
  return {axis, -1, box.max[axis], {box.max[axis], -center[axis]}};
}

Face nearest_face(const Vector3& center, const Box& box) {
  Face nearest = face_of(center, box, 0, true);
  for (int i = 1; i < 6; ++i) {
    const Face face = face_of(center, box, i / 2, i % 2 == 0);
    // Rounding is monotone: depths that differ after it differ so before.
    const double depth = face.rounded_depth();
    const double least = nearest.rounded_depth();
    if (depth < least ||
        (depth == least && sign_of_sum({face.depth[0], face.depth[1], -nearest.depth[0], -nearest.depth[1]}) < 0))
      nearest = face;
  }
  return nearest;
}

double without_sign(double zero) { return zero == 0 ? 0.0 : zero; }

Contact contact_inside(const Ball& a, const Box& b, double contact_distance, PointOn on) {
  const Face face = nearest_face(a.center, b);
  Contact contact{Vector3::Zero(), a.center.unaryExpr(&without_sign), a.center.unaryExpr(&without_sign), 0, true};
  contact.normal[face.axis] = face.sign;
  if (on != PointOn::center) {
    const double along = on == PointOn::nearest_surface ? face.sign : -face.sign;
    contact.point1[face.axis] = rounded_sum({a.center[face.axis], along * a.radius});
  }
  contact.point2[face.axis] = without_sign(face.at);
  contact.value = rounded_sum({-a.radius, -face.depth[0], -face.depth[1], -contact_distance});
  return contact;
}

// Not inlined: what RoundToNearest sets must be set before anything is computed.

[[gnu::noinline]] bool decide(const Ball& a, const Box& b, double alarm) {
  return test_sphere_sphere(a, nearest_point(a.center, b), alarm);
}

[[gnu::noinline]] std::optional<Contact> contact_of_pair(const Ball& a, const Box& b, Distances distances,
                                                         ContactPoints points) {
  const Ball q = nearest_point(a.center, b);
  if (q.center == a.center) return contact_inside(a, b, distances.contact, points.first);
  return compute_sphere_sphere(a, q, distances, points);
}

}  // namespace

bool test_sphere_cube(const Ball& a, const Box& b, double alarm) {
  const kernel::RoundToNearest environment;
  return decide(a, b, alarm);
}

std::optional<Contact> compute_sphere_cube(const Ball& a, const Box& b, Distances distances, ContactPoints points) {
  const kernel::RoundToNearest environment;
  return contact_of_pair(a, b, distances, points);
}

bool is_hit(const BallAndBox& shapes, Distances distances) {
  return test_sphere_cube(shapes.a, shapes.b, distances.alarm);
}
std::optional<Contact> contact_of(const BallAndBox& shapes, Distances distances, ContactPoints points) {
  return compute_sphere_cube(shapes.a, shapes.b, distances, points);
}

}  // namespace contact
