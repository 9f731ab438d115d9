// Eigen: AlignedBox3d::intersects.
#include <Eigen/Geometry>

#include "engines/adapters/adapter.hpp"

#define TEXT_OF(x) TEXT(x)
#define TEXT(x) #x

namespace contact::adapters {

std::string declaration() {
  return R"({"engine":{"name":"eigen","version":")" TEXT_OF(EIGEN_WORLD_VERSION) "." TEXT_OF(
      EIGEN_MAJOR_VERSION) "." TEXT_OF(EIGEN_MINOR_VERSION) R"("},"scalar":"binary64","pairs":["cube_cube"],"conventions":{"margin":"none"}})";
}

void answer(const Question& q, Answer& said) {
  const auto box = [](const double* x) {
    return Eigen::AlignedBox3d(Eigen::Vector3d(x[0], x[1], x[2]), Eigen::Vector3d(x[3], x[4], x[5]));
  };
  said.overlap(box(q.a).intersects(box(q.b)));
}

}  // namespace contact::adapters
