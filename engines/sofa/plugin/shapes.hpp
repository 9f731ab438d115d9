// SOFA's elements as the shapes of this project. Nothing is rounded: SReal is double.
#pragma once

#include <sofa/component/collision/geometry/CubeCollisionModel.h>
#include <sofa/component/collision/geometry/SphereCollisionModel.h>

#include "contact/contact.hpp"

namespace contact::sofa_plugin {

static_assert(sizeof(SReal) == sizeof(double), "SOFA is built with SOFA_FLOATING_POINT_TYPE=double");

[[nodiscard]] inline Vector3 vector_of(const sofa::type::Vec3& x) { return {x[0], x[1], x[2]}; }
[[nodiscard]] inline sofa::type::Vec3 vec_of(const Vector3& x) { return {x[0], x[1], x[2]}; }

template <class DataTypes>
[[nodiscard]] Ball shape_of(const sofa::component::collision::geometry::TSphere<DataTypes>& sphere) {
  return {vector_of(sphere.center()), sphere.r()};
}
[[nodiscard]] inline Box shape_of(const sofa::component::collision::geometry::Cube& cube) {
  return {vector_of(cube.minVect()), vector_of(cube.maxVect())};
}

[[nodiscard]] constexpr SphereKind kind_of(const sofa::component::collision::geometry::Sphere&) {
  return SphereKind::deformable;
}
[[nodiscard]] constexpr SphereKind kind_of(const sofa::component::collision::geometry::RigidSphere&) {
  return SphereKind::rigid;
}

}  // namespace contact::sofa_plugin
