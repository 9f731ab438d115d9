// Models of given shapes, and all intersectors that there are of them: for engines and tests, which ask about every pair.
#pragma once

#include <algorithm>
#include <cctype>
#include <concepts>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "contact/model_factory.hpp"
#include "contact/shape_intersectors.hpp"
#include "contact/shapes.hpp"
#include "contact/sphere_model.hpp"

namespace contact::component {

/// A model of these shapes: the numbers of a shape stand in the order of its model's columns. Nothing where no model has
/// such shapes: rotated boxes and hulls, and rays of which the first hit is asked.
template <class Shape>
[[nodiscard]] std::unique_ptr<CollisionModel> model_of(std::string name, std::span<const Shape> all,
                                                       bool rigid = false) {
  if constexpr (std::same_as<Shape, Cast> || AnyConvex<Shape>) {
    return nullptr;
  } else {
    std::string type = std::string(ShapeDescription<Shape>::kName) + "CollisionModel";
    type[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(type[0])));
    if (rigid) type = RigidSphereModel::kName;
    static const std::vector<ModelMaker> makers = ModelFactory().makers();
    const auto maker = std::find_if(makers.begin(), makers.end(), [&](const ModelMaker& m) { return m.type == type; });
    const auto count = static_cast<Index>(all.size());
    ModelColumns columns;
    for (const ModelColumn& column : maker->columns) columns[column.name] = {count, column.width};
    for (Index i = 0; i < count; ++i) {
      std::vector<double> numbers;
      for_each_number(all[static_cast<std::size_t>(i)], [&](double x) { numbers.push_back(x); });
      auto next = numbers.cbegin();
      for (const ModelColumn& column : maker->columns)
        for (Index k = 0; k < column.width; ++k)
          columns[column.name](i, k) = column.name == "orientations" ? (k == 3 ? 1 : 0) : *next++;  // upright
    }
    return maker->make(std::move(name), columns);
  }
}

/// What this library has to be registered, spheres against solid cubes too, and nothing that plug-ins add.
[[nodiscard]] inline const IntersectorFactory& every_intersector() {
  static IntersectorFactory factory;
  static const bool once = factory.registerCreator("Capsule", creator_of<CapsuleDiscreteIntersection>()) &&
                           factory.registerCreator("Mesh", creator_of<MeshDiscreteIntersection>()) &&
                           factory.registerCreator("Ray", creator_of<RayDiscreteIntersection>()) &&
                           factory.registerCreator("Plane", creator_of<PlaneDiscreteIntersection>()) &&
                           factory.registerCreator("SolidCube", creator_of<SolidCubeDiscreteIntersection>());
  (void)once;
  return factory;
}

}  // namespace contact::component
