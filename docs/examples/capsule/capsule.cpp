// A plug-in that adds capsules, and their contacts with both kinds of sphere.
#include "capsule.hpp"

#include "contact/discrete_intersection.hpp"
#include "contact/plugin.hpp"
#include "contact/sphere_capsule.hpp"

namespace example {

using namespace contact;

CapsuleModel::CapsuleModel(std::string name, Eigen::MatrixX3d p, Eigen::MatrixX3d q, Eigen::VectorXd radii)
    : ModelOf(std::move(name)), p_(std::move(p)), q_(std::move(q)), radii_(std::move(radii)) {
  if (p_.rows() != radii_.rows() || q_.rows() != radii_.rows()) refuse("p, q and radii must be of one length");
  for (Index i = 0; i < radii_.rows(); ++i) {
    const std::string row = "[" + std::to_string(i) + "]";
    refuse(outside_domain("p" + row, this->p(i)));
    refuse(outside_domain("q" + row, this->q(i)));
    refuse(outside_domain("radii" + row, radius(i)));
  }
}

Box CapsuleModel::bounding_box(Index index) const {
  const Box at_p = box_around({p(index), radius(index)});
  const Box at_q = box_around({q(index), radius(index)});
  return {at_p.min.cwiseMin(at_q.min), at_p.max.cwiseMax(at_q.max)};
}

namespace {

/// Spheres of both kinds against capsules: the decision is exact and every number is rounded once, as
/// test_sphere_capsule and compute_sphere_capsule say.
/// Points      the convention of the DiscreteIntersection; a capsule is deformable, its centre the nearest point of its
///             axis.
/// Degenerate  the sphere's centre lies on the axis: the normal is the one that compute_sphere_capsule takes, at a
///             right angle to the axis.
class SphereCapsuleIntersector : public BaseIntersector {
 public:
  static constexpr std::string_view kName = "SphereCapsuleIntersector";

  explicit SphereCapsuleIntersector(DiscreteIntersection& object) : points_(object.points()) {
    object.intersectors.add<SphereCollisionModel, CapsuleModel>(*this);
    object.intersectors.add<RigidSphereModel, CapsuleModel>(*this);
  }

  template <class SphereType>
  bool testIntersection(const SphereType& sphere, const Capsule& capsule, const Intersection& current) const {
    return test_sphere_capsule(sphere.ball(), capsule.shape(), current.getAlarmDistance());
  }

  template <class SphereType>
  int computeIntersection(const SphereType& sphere, const Capsule& capsule, OutputVector& contacts,
                          const Intersection& current) const {
    const Distances distances{current.getAlarmDistance(), current.getContactDistance()};
    const ContactPoints points{point_on(points_, sphere.getCollisionModel().kKind),
                               point_on(points_, SphereKind::deformable)};
    const auto contact = compute_sphere_capsule(sphere.ball(), capsule.shape(), distances, points);
    if (!contact) return 0;
    contacts.push_back({.elem = {sphere, capsule},
                        .id = contact_id(sphere, capsule),
                        .point = {contact->point1, contact->point2},
                        .normal = contact->normal,
                        .value = contact->value});
    return 1;
  }

 private:
  PointConvention points_;
};

std::unique_ptr<CollisionModel> make_capsules(std::string name, const ModelColumns& columns) {
  return std::make_unique<CapsuleModel>(std::move(name), columns.at("p"), columns.at("q"), columns.at("radii"));
}

void enter(PluginHost& host) {
  host.models.registerModel({std::string(CapsuleModel::kName), {{"p", 3}, {"q", 3}, {"radii", 1}}, make_capsules});
  host.intersectors.registerCreator("SphereCapsuleIntersector", creator_of<SphereCapsuleIntersector>());
}

}  // namespace
}  // namespace example

CONTACT_PLUGIN(example::enter);
