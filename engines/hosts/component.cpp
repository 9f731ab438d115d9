// The engine `component`: production through DiscreteIntersection, each question as two models of one element.
#include <memory>
#include <stdexcept>

#include "contact/detect.hpp"
#include "contact/shape_intersectors.hpp"
#include "engines/engine.hpp"

namespace contact::engines {
namespace {

using Model = std::unique_ptr<const CollisionModel>;

Model model_of(const Ball& ball, bool rigid) {
  const Eigen::VectorXd radius = Eigen::VectorXd::Constant(1, ball.radius);
  if (rigid)
    return std::make_unique<RigidSphereModel>("rigid spheres", ball.center.transpose(), Eigen::RowVector4d(0, 0, 0, 1),
                                              radius);
  return std::make_unique<SphereCollisionModel>("spheres", ball.center.transpose(), radius);
}
Model model_of(const Box& box, bool) {
  return std::make_unique<CubeCollisionModel>("cubes", box.min.transpose(), box.max.transpose());
}
Model model_of(const Capsule& capsule, bool) {
  return std::make_unique<CapsuleCollisionModel>("capsules", capsule.start.transpose(), capsule.end.transpose(),
                                                 Eigen::VectorXd::Constant(1, capsule.radius));
}
Model model_of(const Triangle& triangle, bool) {
  const auto& [v0, v1, v2] = triangle.vertices;
  return std::make_unique<TriangleCollisionModel>("triangles", v0.transpose(), v1.transpose(), v2.transpose());
}
Model model_of(const Ray& ray, bool) {
  return std::make_unique<RayCollisionModel>("rays", ray.origin.transpose(), ray.direction.transpose(),
                                             Eigen::VectorXd::Constant(1, ray.length));
}
/// No model asks where a ray first hits, and none is of rotated boxes.
Model model_of(const Cast& /*ray*/, bool) { return nullptr; }
Model model_of(const Convex& /*shape*/, bool) { return nullptr; }
Model model_of(const Plane& plane, bool) {
  return std::make_unique<PlaneCollisionModel>("planes", plane.normal.transpose(),
                                               Eigen::VectorXd::Constant(1, plane.offset));
}
Model model_of(const Line& line, bool) {
  return std::make_unique<LineCollisionModel>("lines", line.start.transpose(), line.end.transpose());
}

/// The two shapes of a pair as models of one element each.
std::pair<Model, Model> models_of(Pair pair, const Shapes& shapes) {
  return std::visit(
      [&](const auto& two) {
        return std::pair(model_of(two.a, description(pair).first_is_rigid),
                         model_of(two.b, description(pair).second_is_rigid));
      },
      shapes);
}

/// What this library has to be registered, and nothing that plug-ins add: that is not judged here.
const IntersectorFactory& ours() {
  static IntersectorFactory factory;
  static const bool once = factory.registerCreator("Capsule", creator_of<CapsuleDiscreteIntersection>()) &&
                           factory.registerCreator("Mesh", creator_of<MeshDiscreteIntersection>()) &&
                           factory.registerCreator("Ray", creator_of<RayDiscreteIntersection>()) &&
                           factory.registerCreator("Plane", creator_of<PlaneDiscreteIntersection>()) &&
                           factory.registerCreator("SolidCube", creator_of<SolidCubeDiscreteIntersection>());
  (void)once;
  return factory;
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
  DiscreteIntersection intersection(PointConvention::nearest_surface, ours());
  return intersector_of(intersection, model1, model2) != nullptr;
}

Claim component_answer(const Query& query, PointConvention points) {
  if (const auto error = outside_domain(query)) return rejection(*error);
  const auto [model1, model2] = models_of(query.pair, query.shapes);
  ProximityIntersection intersection(query.distances, points, ours());
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
