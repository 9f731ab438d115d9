// Models by the name of their type, from named columns of numbers.
#include "contact/model_factory.hpp"

#include <algorithm>

#include "contact/capsule_model.hpp"
#include "contact/cube_model.hpp"
#include "contact/line_model.hpp"
#include "contact/plane_model.hpp"
#include "contact/ray_model.hpp"
#include "contact/sphere_model.hpp"
#include "contact/triangle_model.hpp"

namespace contact::inline CONTACT_ABI {
namespace {

[[noreturn]] void refuse(const std::string& type, const std::string& name, const std::string& problem) {
  throw InvalidModel(type + " \"" + name + "\": " + problem);
}

std::unique_ptr<CollisionModel> make_spheres(std::string name, const ModelColumns& columns) {
  return std::make_unique<SphereCollisionModel>(std::move(name), columns.at("centers"), columns.at("radii"));
}

std::unique_ptr<CollisionModel> make_rigid_spheres(std::string name, const ModelColumns& columns) {
  return std::make_unique<RigidSphereModel>(std::move(name), columns.at("positions"), columns.at("orientations"),
                                            columns.at("radii"));
}

std::unique_ptr<CollisionModel> make_cubes(std::string name, const ModelColumns& columns) {
  return std::make_unique<CubeCollisionModel>(std::move(name), columns.at("min"), columns.at("max"));
}

std::unique_ptr<CollisionModel> make_capsules(std::string name, const ModelColumns& columns) {
  return std::make_unique<CapsuleCollisionModel>(std::move(name), columns.at("starts"), columns.at("ends"),
                                                 columns.at("radii"));
}

std::unique_ptr<CollisionModel> make_triangles(std::string name, const ModelColumns& columns) {
  return std::make_unique<TriangleCollisionModel>(std::move(name), columns.at("p1"), columns.at("p2"),
                                                  columns.at("p3"));
}

std::unique_ptr<CollisionModel> make_rays(std::string name, const ModelColumns& columns) {
  return std::make_unique<RayCollisionModel>(std::move(name), columns.at("origins"), columns.at("directions"),
                                             columns.at("lengths"));
}

std::unique_ptr<CollisionModel> make_planes(std::string name, const ModelColumns& columns) {
  return std::make_unique<PlaneCollisionModel>(std::move(name), columns.at("normals"), columns.at("offsets"));
}

std::unique_ptr<CollisionModel> make_lines(std::string name, const ModelColumns& columns) {
  return std::make_unique<LineCollisionModel>(std::move(name), columns.at("p1"), columns.at("p2"));
}

}  // namespace

ModelFactory::ModelFactory()
    : makers_{{std::string(SphereCollisionModel::kName), {{"centers", 3}, {"radii", 1}}, make_spheres},
              {std::string(RigidSphereModel::kName),
               {{"positions", 3}, {"orientations", 4}, {"radii", 1}},
               make_rigid_spheres},
              {std::string(CubeCollisionModel::kName), {{"min", 3}, {"max", 3}}, make_cubes},
              {std::string(CapsuleCollisionModel::kName), {{"starts", 3}, {"ends", 3}, {"radii", 1}}, make_capsules},
              {std::string(TriangleCollisionModel::kName), {{"p1", 3}, {"p2", 3}, {"p3", 3}}, make_triangles},
              {std::string(RayCollisionModel::kName), {{"origins", 3}, {"directions", 3}, {"lengths", 1}}, make_rays},
              {std::string(PlaneCollisionModel::kName), {{"normals", 3}, {"offsets", 1}}, make_planes},
              {std::string(LineCollisionModel::kName), {{"p1", 3}, {"p2", 3}}, make_lines}} {}

bool ModelFactory::registerModel(ModelMaker maker) {
  const std::lock_guard lock(mutex_);
  if (std::any_of(makers_.begin(), makers_.end(), [&](const ModelMaker& m) { return m.type == maker.type; }))
    return false;
  if (!maker.make) throw std::invalid_argument("model type " + maker.type + ": there is nothing to make it with");
  makers_.push_back(std::move(maker));
  return true;
}

std::unique_ptr<CollisionModel> ModelFactory::make(const std::string& type, std::string name,
                                                   const ModelColumns& columns) const {
  const std::vector<ModelMaker> known = makers();
  const auto maker = std::find_if(known.begin(), known.end(), [&](const ModelMaker& m) { return m.type == type; });
  if (maker == known.end()) {
    std::string problem = "unknown type of model; there are";
    for (const ModelMaker& m : known) problem += " " + m.type;
    refuse(type, name, problem);
  }
  for (const auto& [column, numbers] : columns)
    if (std::none_of(maker->columns.begin(), maker->columns.end(),
                     [&wanted = column](const auto& c) { return c.name == wanted; }))
      refuse(type, name, "unknown column " + column);
  for (const ModelColumn& column : maker->columns) {
    const ModelColumn& first = maker->columns.front();
    const auto given = columns.find(column.name);
    if (given == columns.end()) refuse(type, name, "column " + column.name + " is missing");
    if (given->second.cols() != column.width)
      refuse(type, name,
             "column " + column.name + " has " + std::to_string(given->second.cols()) + " numbers a row, not " +
                 std::to_string(column.width));
    if (given->second.rows() != columns.at(first.name).rows())
      refuse(type, name,
             "column " + column.name + " has " + std::to_string(given->second.rows()) + " rows, " + first.name +
                 " has " + std::to_string(columns.at(first.name).rows()));
  }
  auto model = maker->make(name, columns);
  if (!model) refuse(type, name, "its maker made nothing");
  return model;
}

std::vector<ModelMaker> ModelFactory::makers() const {
  const std::lock_guard lock(mutex_);
  return makers_;
}

ModelFactory& ModelFactory::getInstance() {
  static ModelFactory instance;
  return instance;
}

}  // namespace contact::inline CONTACT_ABI
