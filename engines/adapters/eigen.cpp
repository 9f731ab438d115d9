// Eigen: AlignedBox3d::intersects; squaredExteriorDistance, compared with a reach^2 that its user rounded;
// Hyperplane::signedDistance.
#include <Eigen/Geometry>

#include "engines/adapters/adapter.hpp"

#define TEXT_OF(x) TEXT(x)
#define TEXT(x) #x

namespace contact::adapters {

std::string declaration() {
  return R"({"engine":{"name":"eigen","version":")" TEXT_OF(EIGEN_WORLD_VERSION) "." TEXT_OF(
      EIGEN_MAJOR_VERSION) "." TEXT_OF(EIGEN_MINOR_VERSION) R"("},"scalar":"binary64","pairs":["cube_cube","sphere_cube","sphere_plane"],)"
                                                            R"("conventions":{"margin":"none"},"pair_conventions":{"sphere_cube":{"margin":"inclusive"},)"
                                                            R"("sphere_plane":{"margin":"inclusive","shapes":"centered"}},"claims":["overlap"]})";
}

void answer(const Question& q, Answer& said) {
  const auto box = [](const Shape& shape) {
    const double* x = shape.numbers;
    return Eigen::AlignedBox3d(Eigen::Vector3d(x[0], x[1], x[2]), Eigen::Vector3d(x[3], x[4], x[5]));
  };
  if (q.pair == CONTACT_SPHERE_CUBE) {
    const double reach = q.alarm + q.a.radius;
    said.overlap(box(q.b).squaredExteriorDistance(Eigen::Vector3d(q.a.center)) <= reach * reach);
    return;
  }
  if (q.pair == CONTACT_SPHERE_PLANE) {
    const Eigen::Hyperplane<double, 3> plane(Eigen::Vector3d(q.b.normal), -q.b.offset);
    said.overlap(plane.signedDistance(Eigen::Vector3d(q.a.center)) <= q.alarm + q.a.radius);
    return;
  }
  said.overlap(box(q.a).intersects(box(q.b)));
}

}  // namespace contact::adapters
