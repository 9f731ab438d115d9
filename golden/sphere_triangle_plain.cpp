// A sphere and a triangle in plain arithmetic: two spheres, the second without extent at the triangle's nearest point.
#include "golden/plain_triangles.hpp"

namespace contact::golden {
namespace {

template <class Real>
NearestPoints<Real> nearest_of(const BallAndTriangle& shapes) {
  const Triple<Real> c = in_scalar<Real>(shapes.a.center);
  return {c, nearest_point(c, vertices_of<Real>(shapes.b)), true};
}

template <class Real>
bool overlap(const BallAndTriangle& shapes, Distances distances, Scalar scalar) {
  return plain_overlap(at_nearest(nearest_of<Real>(shapes), static_cast<Real>(shapes.a.radius), Real{0}), distances,
                       scalar);
}

template <class Real>
std::optional<Contact> contact_in(const BallAndTriangle& shapes, Distances distances, Scalar scalar,
                                  ContactPoints points) {
  return plain_contact_at(nearest_of<Real>(shapes), static_cast<Real>(shapes.a.radius), Real{0},
                          parting_normal(vertices_of<Real>(shapes.b)), distances, scalar, points);
}

}  // namespace

bool plain_overlap(const BallAndTriangle& shapes, Distances distances, Scalar scalar) {
  return scalar == Scalar::binary32 ? overlap<float>(shapes, distances, scalar)
                                    : overlap<double>(shapes, distances, scalar);
}

std::optional<Contact> plain_contact(const BallAndTriangle& shapes, Distances distances, Scalar scalar,
                                     ContactPoints points) {
  return scalar == Scalar::binary32 ? contact_in<float>(shapes, distances, scalar, points)
                                    : contact_in<double>(shapes, distances, scalar, points);
}

}  // namespace contact::golden
