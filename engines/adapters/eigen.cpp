// Eigen: AlignedBox3d::intersects; squaredExteriorDistance, compared with a reach^2 that its user rounded.
#include <Eigen/Geometry>

#include "engines/adapters/adapter.hpp"

#define TEXT_OF(x) TEXT(x)
#define TEXT(x) #x

namespace contact::adapters {

std::string declaration() {
  return R"({"engine":{"name":"eigen","version":")" TEXT_OF(EIGEN_WORLD_VERSION) "." TEXT_OF(
      EIGEN_MAJOR_VERSION) "." TEXT_OF(EIGEN_MINOR_VERSION) R"("},"scalar":"binary64","pairs":["cube_cube","sphere_cube"],"conventions":{"margin":"none"},"pair_conventions":{"sphere_cube":{"margin":"inclusive"}},"claims":["overlap"]})";
}

void answer(const Question& q, Answer& said) {
  const auto box = [](const double* x) {
    return Eigen::AlignedBox3d(Eigen::Vector3d(x[0], x[1], x[2]), Eigen::Vector3d(x[3], x[4], x[5]));
  };
  if (q.pair == CONTACT_SPHERE_CUBE) {
    const double reach = q.alarm + q.a[3];
    said.overlap(box(q.b).squaredExteriorDistance(Eigen::Vector3d(q.a[0], q.a[1], q.a[2])) <= reach * reach);
    return;
  }
  said.overlap(box(q.a).intersects(box(q.b)));
}

}  // namespace contact::adapters
