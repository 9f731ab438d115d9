// Sphere against cube: outside it is the sphere pair at the nearest point of the box, whose coordinates are numbers of
// the question. Inside, every number is a sum of such numbers.
#include "contact/sphere_cube.hpp"

#include "contact/exact_sum.hpp"
#include "contact/sphere_sphere.hpp"
#include "kernel/floating_point_environment.hpp"
#include "kernel/sphere_sphere_numbers.hpp"
#include "kernel/sum_of_two.hpp"

namespace contact::inline CONTACT_ABI {
namespace {

/// The nearest point of the box, as a sphere without extent.
Ball nearest_point(const Vector3& center, const Box& box) { return {center.cwiseMax(box.min).cwiseMin(box.max), 0}; }

/// A face of the box that a centre lies before or, inside, behind.
struct Face {
  int axis;
  double sign;  ///< of the normal, which points into the box
  double at;
  double center;

  // How far the centre lies before the face, as a sum.
  [[nodiscard]] double ahead() const { return sign * at; }
  [[nodiscard]] double back() const { return -sign * center; }
};

Face face_of(const Vector3& center, const Box& box, int axis, bool is_min) {
  return {axis, is_min ? 1.0 : -1.0, is_min ? box.min[axis] : box.max[axis], center[axis]};
}

/// The sign of (x + y) - (z + w). Rounding is monotone: sums that differ after it differ so before.
int compare_sums(double x, double y, double z, double w) {
  const double first = x + y;
  const double second = z + w;
  return first < second ? -1 : first > second ? 1 : sign_of_sum({x, y, -z, -w});
}

Face nearest_face(const Vector3& center, const Box& box) {
  Face nearest = face_of(center, box, 0, true);
  for (int i = 1; i < 6; ++i) {
    const Face face = face_of(center, box, i / 2, i % 2 == 0);
    if (compare_sums(face.ahead(), face.back(), nearest.ahead(), nearest.back()) > 0) nearest = face;
  }
  return nearest;
}

double without_sign(double zero) { return zero == 0 ? 0.0 : zero; }

/// Out of the box every number is a sum of numbers of the question.
Contact contact_inside(const Ball& a, const Face& face, double contact_distance, PointOn on) {
  Contact contact{Vector3::Zero(), a.center.unaryExpr(&without_sign), a.center.unaryExpr(&without_sign), 0, true};
  contact.normal[face.axis] = face.sign;
  contact.point1[face.axis] = without_sign(face.center + kernel::sign_of(on, face.sign) * a.radius);
  contact.point2[face.axis] = without_sign(face.at);
  contact.value = kernel::one_number::rounded({face.ahead(), face.back(), -a.radius, -contact_distance});
  return contact;
}

// Not inlined: what RoundToNearest sets must be set before anything is computed.

[[gnu::noinline]] bool decide(const Ball& a, const Box& b, double alarm) {
  const Ball q = nearest_point(a.center, b);
  return q.center == a.center || test_sphere_sphere(a, q, alarm);
}

[[gnu::noinline]] std::optional<Contact> contact_of_pair(const Ball& a, const Box& b, Distances distances,
                                                         ContactPoints points) {
  const Ball q = nearest_point(a.center, b);
  if (q.center == a.center) return contact_inside(a, nearest_face(a.center, b), distances.contact, points.first);
  return compute_sphere_sphere(a, q, distances, points);
}

}  // namespace

bool out_of_line::test_sphere_cube(const Ball& a, const Box& b, double alarm) {
  const kernel::RoundToNearest environment;
  return decide(a, b, alarm);
}

std::optional<Contact> out_of_line::compute_sphere_cube(const Ball& a, const Box& b, Distances distances,
                                                        ContactPoints points) {
  const kernel::RoundToNearest environment;
  return contact_of_pair(a, b, distances, points);
}

}  // namespace contact::inline CONTACT_ABI
