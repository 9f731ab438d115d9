// What the FCL adapters share: its shapes in their places.
#pragma once

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision_object.h>

#include "engines/adapters/adapter.hpp"

namespace contact::adapters {

inline std::shared_ptr<fcl::CollisionGeometryd> fcl_geometry(const Shape& x) {
  if (x.kind == Kind::sphere) return std::make_shared<fcl::Sphered>(x.radius);
  if (x.is_box()) return std::make_shared<fcl::Boxd>(x.size[0], x.size[1], x.size[2]);
  if (x.kind == Kind::capsule) return std::make_shared<fcl::Capsuled>(x.radius, x.length());
  if (x.kind == Kind::plane) return std::make_shared<fcl::Halfspaced>(fcl::Vector3d(x.normal), x.offset);
  // A triangle of its own cannot be asked; a mesh of one can.
  auto mesh = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  mesh->beginModel(1, 3);
  mesh->addTriangle(fcl::Vector3d(x.vertex(0)), fcl::Vector3d(x.vertex(1)), fcl::Vector3d(x.vertex(2)));
  mesh->endModel();
  return mesh;
}

inline fcl::CollisionObjectd fcl_object(const Shape& x) {
  fcl::Matrix3d upright = fcl::Matrix3d::Identity();
  for (int row = 0; row < 3 && (x.kind == Kind::capsule || x.kind == Kind::obb); ++row)
    for (int column = 0; column < 3; ++column) upright(row, column) = x.rotation(row, column);
  return {fcl_geometry(x), upright, fcl::Vector3d(x.center)};
}

}  // namespace contact::adapters
