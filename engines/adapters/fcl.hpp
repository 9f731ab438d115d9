// What the FCL adapters share: its shapes in their places.
#pragma once

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision_object.h>

#include "engines/adapters/adapter.hpp"

namespace contact::adapters {

inline fcl::CollisionObjectd fcl_at(std::shared_ptr<fcl::CollisionGeometryd> shape, const double* center) {
  return {std::move(shape), fcl::Matrix3d::Identity(), fcl::Vector3d(center[0], center[1], center[2])};
}

inline fcl::CollisionObjectd fcl_ball(const double* x) { return fcl_at(std::make_shared<fcl::Sphered>(x[3]), x); }

inline fcl::CollisionObjectd fcl_box(const double* x) {
  const CenteredBox box(x);
  return fcl_at(std::make_shared<fcl::Boxd>(box.size[0], box.size[1], box.size[2]), box.center);
}

}  // namespace contact::adapters
