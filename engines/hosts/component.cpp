// The engine `component`: production through DiscreteIntersection, each question as two models of one element.
#include <stdexcept>

#include "contact/detect.hpp"
#include "contact/discrete_intersection.hpp"
#include "engines/engine.hpp"

namespace contact::engines {
namespace {

SphereCollisionModel spheres(const Ball& ball) {
  return {"spheres", ball.center.transpose(), Eigen::VectorXd::Constant(1, ball.radius)};
}
RigidSphereModel rigid_spheres(const Ball& ball) {
  return {"rigid spheres", ball.center.transpose(), Eigen::RowVector4d(0, 0, 0, 1),
          Eigen::VectorXd::Constant(1, ball.radius)};
}
CubeCollisionModel cubes(const Box& box) { return {"cubes", box.min.transpose(), box.max.transpose()}; }

/// Both claims about two models of one element, `overlap` from canIntersect and `contact` from detect.
Claim claim_about(const Intersection& intersection, const CollisionModel& model1, const CollisionModel& model2) {
  bool swap = false;
  const ElementIntersector* intersector = intersection.findIntersector(model1, model2, swap);
  const auto contacts = detect(intersection, model1, model2);
  if (intersector == nullptr || swap || !contacts || contacts->size() > 1)
    throw std::logic_error("component: every pair has an intersector of its own, and two elements one contact at most");
  Claim claim;
  claim.overlap = intersector->canIntersect({model1, 0}, {model2, 0}, intersection);
  claim.speaks_of_contact = true;
  if (!contacts->empty()) {
    const DetectionOutput& c = contacts->front();
    claim.contact = {c.normal, c.point[0], c.point[1], std::nullopt, c.value};
  }
  return claim;
}

/// SOFA's computeIntersection of two cubes writes nothing, so cubes claim their overlap alone.
Claim cubes_claim(const Intersection& intersection, const Boxes& boxes) {
  Claim claim = claim_about(intersection, cubes(boxes.a), cubes(boxes.b));
  if (claim.contact) throw std::logic_error("component: two cubes wrote a contact");
  claim.speaks_of_contact = false;
  return claim;
}

}  // namespace

Claim component_answer(const Query& query, PointConvention points) {
  if (const auto error = outside_domain(query)) return rejection(*error);
  static const IntersectorFactory none;  // what plug-ins add is not what is judged here
  const ProximityIntersection intersection(query.distances, points, none);
  if (const Boxes* boxes = query.boxes()) return cubes_claim(intersection, *boxes);
  if (query.balls() == nullptr) {
    Claim claim;
    claim.status = Claim::Status::unsupported;
    claim.text = "DiscreteIntersection has no such pair";
    return claim;
  }
  const auto& [a, b] = *query.balls();
  switch (query.pair) {
    case Pair::sphere_sphere:
      return claim_about(intersection, spheres(a), spheres(b));
    case Pair::rigid_sphere_rigid_sphere:
      return claim_about(intersection, rigid_spheres(a), rigid_spheres(b));
    default:
      return claim_about(intersection, spheres(a), rigid_spheres(b));
  }
}

}  // namespace contact::engines
