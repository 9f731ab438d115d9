// A hull as Open Dynamics Engine has it.
#pragma once

#include <ode/ode.h>

#include <array>
#include <cstddef>
#include <vector>

#include "engines/adapters/faces.hpp"

namespace contact::adapters {

/// A convex geom, about the middle of its points, since it wants the origin inside: so its vertices lose their last bits.
class Convex {
 public:
  explicit Convex(const Polyhedron& hull) {
    const auto count = static_cast<double>(hull.vertices.size());
    std::array<double, 3> middle{};
    for (const auto& v : hull.vertices)
      for (std::size_t i = 0; i < 3; ++i) middle[i] += v[i] / count;
    for (const auto& v : hull.vertices)
      for (std::size_t i = 0; i < 3; ++i) points_.push_back(static_cast<dReal>(v[i] - middle[i]));
    for (const Face& face : hull.faces) {
      double offset = face.offset;
      for (std::size_t i = 0; i < 3; ++i) {
        planes_.push_back(static_cast<dReal>(face.normal[i]));
        offset -= face.normal[i] * middle[i];
      }
      planes_.push_back(static_cast<dReal>(offset));
      polygons_.push_back(static_cast<unsigned>(face.around.size()));
      polygons_.insert(polygons_.end(), face.around.begin(), face.around.end());
    }
    geom = dCreateConvex(nullptr, planes_.data(), static_cast<unsigned>(hull.faces.size()), points_.data(),
                         static_cast<unsigned>(hull.vertices.size()), polygons_.data());
    dGeomSetPosition(geom, static_cast<dReal>(middle[0]), static_cast<dReal>(middle[1]), static_cast<dReal>(middle[2]));
  }
  Convex(const Convex&) = delete;
  Convex& operator=(const Convex&) = delete;
  ~Convex() { dGeomDestroy(geom); }

 private:
  std::vector<dReal> points_;
  std::vector<dReal> planes_;
  std::vector<unsigned> polygons_;

 public:
  dGeomID geom;
};

}  // namespace contact::adapters
