// What the FCL adapters share: its shapes in their places.
#pragma once

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision_object.h>

#include <memory>
#include <optional>
#include <vector>

#include "engines/adapters/faces.hpp"

namespace contact::adapters {

/// Null where it has no such shape: a hull with a radius, or without a volume.
inline std::shared_ptr<fcl::CollisionGeometryd> fcl_hull(const Shape& x) {
  const std::optional<Polyhedron> found = x.radius > 0 ? std::nullopt : polyhedron_of(x);
  if (!found) return nullptr;
  const auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
  for (const auto& v : found->vertices) vertices->emplace_back(v.data());
  const auto faces = std::make_shared<std::vector<int>>();
  for (const Face& face : found->faces) {
    faces->push_back(static_cast<int>(face.around.size()));
    faces->insert(faces->end(), face.around.begin(), face.around.end());
  }
  return std::make_shared<fcl::Convexd>(vertices, static_cast<int>(found->faces.size()), faces, true);
}

inline std::shared_ptr<fcl::CollisionGeometryd> fcl_geometry(const Shape& x) {
  if (x.kind == Kind::sphere) return std::make_shared<fcl::Sphered>(x.radius);
  if (x.is_box()) return std::make_shared<fcl::Boxd>(x.size[0], x.size[1], x.size[2]);
  if (x.kind == Kind::capsule) return std::make_shared<fcl::Capsuled>(x.radius, x.length());
  if (x.kind == Kind::hull) return fcl_hull(x);
  if (x.kind == Kind::plane) return std::make_shared<fcl::Halfspaced>(fcl::Vector3d(x.normal), x.offset);
  // A triangle of its own cannot be asked; a mesh of one can.
  auto mesh = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  mesh->beginModel(1, 3);
  mesh->addTriangle(fcl::Vector3d(x.vertex(0)), fcl::Vector3d(x.vertex(1)), fcl::Vector3d(x.vertex(2)));
  mesh->endModel();
  return mesh;
}

inline std::optional<fcl::CollisionObjectd> fcl_object(const Shape& x) {
  fcl::Matrix3d upright = fcl::Matrix3d::Identity();
  for (int row = 0; row < 3 && (x.kind == Kind::capsule || x.kind == Kind::obb); ++row)
    for (int column = 0; column < 3; ++column) upright(row, column) = x.rotation(row, column);
  const auto geometry = fcl_geometry(x);
  if (!geometry) return std::nullopt;
  return fcl::CollisionObjectd(geometry, upright, fcl::Vector3d(x.center));
}

}  // namespace contact::adapters
