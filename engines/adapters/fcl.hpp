// What the FCL adapters share: its shapes in their places.
#pragma once

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision_object.h>

#include "engines/adapters/adapter.hpp"

namespace contact::adapters {

inline fcl::CollisionObjectd fcl_object(const Shape& x) {
  std::shared_ptr<fcl::CollisionGeometryd> shape;
  if (x.kind == Kind::sphere) shape = std::make_shared<fcl::Sphered>(x.radius);
  if (x.kind == Kind::box) shape = std::make_shared<fcl::Boxd>(x.size[0], x.size[1], x.size[2]);
  if (x.kind == Kind::capsule) shape = std::make_shared<fcl::Capsuled>(x.radius, x.length());
  fcl::Matrix3d upright;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) upright(row, column) = x.rotation(row, column);
  return {shape, upright, fcl::Vector3d(x.center)};
}

}  // namespace contact::adapters
