// The engine `component`: production through DiscreteIntersection, each question as two models of one element.
#include <concepts>
#include <memory>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <variant>

#include "component/model_of.hpp"
#include "contact/detect.hpp"
#include "engines/engine.hpp"

namespace contact::engines {
namespace {

using Model = std::unique_ptr<const CollisionModel>;

/// The two shapes of a pair as models of one element each.
std::pair<Model, Model> models_of(Pair pair, const Shapes& shapes) {
  return std::visit(
      [&](const auto& two) {
        const auto model = [](const auto& shape, bool rigid) -> Model {
          return component::model_of("model", std::span(&shape, 1), rigid);
        };
        return std::pair(model(two.a, description(pair).first_is_rigid),
                         model(two.b, description(pair).second_is_rigid));
      },
      shapes);
}

/// Nothing where a shape has no model, or two models no intersector.
const ElementIntersector* intersector_of(DiscreteIntersection& intersection, const Model& model1, const Model& model2) {
  if (!model1 || !model2) return nullptr;
  intersection.intersectors.setSink({});
  bool swap = false;
  const ElementIntersector* intersector = intersection.findIntersector(*model1, *model2, swap);
  if (swap) throw std::logic_error("component: every pair has an intersector of its own");
  return intersector;
}

}  // namespace

bool component_serves(Pair pair) {
  Shapes shapes = description(pair).zeros();
  const auto with_direction = [](const auto& field, auto& value) {
    if constexpr (std::same_as<std::remove_reference_t<decltype(value)>, Vector3>)
      if (field.kind == FieldKind::direction) value[0] = 1;  // no model takes 0 for one
  };
  std::visit([&](auto& two) { for_each_field(two.a, with_direction), for_each_field(two.b, with_direction); }, shapes);
  const auto [model1, model2] = models_of(pair, shapes);
  DiscreteIntersection intersection(PointConvention::nearest_surface, component::every_intersector());
  return intersector_of(intersection, model1, model2) != nullptr;
}

Claim component_answer(const Query& query, PointConvention points) {
  if (const auto error = outside_domain(query)) return rejection(*error);
  const auto [model1, model2] = models_of(query.pair, query.shapes);
  ProximityIntersection intersection(query.distances, points, component::every_intersector());
  const ElementIntersector* intersector = intersector_of(intersection, model1, model2);
  if (intersector == nullptr) return Claim::without(Claim::Status::unsupported, "no intersector serves this pair");
  Claim claim;
  claim.overlap = intersector->canIntersect({*model1, 0}, {*model2, 0}, intersection);
  claim.speaks_of_contact = query.has_numbers();  // SOFA's computeIntersection of two cubes writes nothing
  const auto contacts = detect(intersection, *model1, *model2);
  if (!contacts || contacts->size() > (query.has_numbers() ? 1 : 0))
    throw std::logic_error("component: two elements have one contact at most, and two cubes none");
  if (!contacts->empty()) {
    const DetectionOutput& c = contacts->front();
    claim.contact = {c.normal, c.point[0], c.point[1], std::nullopt, c.value};
  }
  return claim;
}

}  // namespace contact::engines
