// Models by the name of their type, from named columns of numbers.
#include "contact/model_factory.hpp"

#include <algorithm>
#include <concepts>

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

using Column = ModelColumn;

/// Models of this class, whose constructor takes these columns in their order.
template <class Model>
ModelMaker maker_of(const std::same_as<Column> auto&... columns) {
  return {std::string(Model::kName), {columns...}, [columns...](std::string name, const ModelColumns& given) {
            return std::make_unique<Model>(std::move(name), given.at(columns.name)...);
          }};
}

}  // namespace

ModelFactory::ModelFactory()
    : makers_{maker_of<SphereCollisionModel>(Column{"centers", 3}, Column{"radii", 1}),
              maker_of<RigidSphereModel>(Column{"positions", 3}, Column{"orientations", 4}, Column{"radii", 1}),
              maker_of<CubeCollisionModel>(Column{"min", 3}, Column{"max", 3}),
              maker_of<CapsuleCollisionModel>(Column{"starts", 3}, Column{"ends", 3}, Column{"radii", 1}),
              maker_of<TriangleCollisionModel>(Column{"p1", 3}, Column{"p2", 3}, Column{"p3", 3}),
              maker_of<RayCollisionModel>(Column{"origins", 3}, Column{"directions", 3}, Column{"lengths", 1}),
              maker_of<PlaneCollisionModel>(Column{"normals", 3}, Column{"offsets", 1}),
              maker_of<LineCollisionModel>(Column{"p1", 3}, Column{"p2", 3})} {}

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
