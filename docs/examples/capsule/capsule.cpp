// A plug-in that adds capsules, and their contacts with both kinds of sphere.
#include "capsule.hpp"

#include <algorithm>
#include <cmath>

#include "contact/discrete_intersection.hpp"
#include "contact/plugin.hpp"

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

/// The ball of the capsule that is nearest to the point c.
///   d = q - p     t = (c - p).d / d.d, at least 0 and at most 1     center = p (1 - t) + q t
/// Domain      every finite number: all three points are scaled by a power of two, so that nothing overflows and what
///             underflows does not matter.
/// Error       |center - exact| <= 46 (2^-53 S + 2^-1074), S the largest |coordinate| of p, q and c. With u = 2^-53,
///             t is within 11 u |c - p| / |d| (5 u from each of the scalar products' terms, 1 u from the quotient),
///             which moves the centre by 11 u 2 sqrt(3) S; the roundings of the last line move each coordinate by 4 u
///             S.
/// Degenerate  p = q: p.
/// Evidence    docs/examples/capsule/capsule_test.cpp.
Ball nearest_ball(const Capsule& capsule, const Vector3& c) {
  const Vector3 p = capsule.p();
  const Vector3 q = capsule.q();
  int exponent = 0;
  std::frexp(std::max({p.cwiseAbs().maxCoeff(), q.cwiseAbs().maxCoeff(), c.cwiseAbs().maxCoeff()}), &exponent);
  const auto scaled = [&](const Vector3& v) { return v.unaryExpr([&](double x) { return std::ldexp(x, -exponent); }); };
  const Vector3 d = scaled(q) - scaled(p);
  const double d2 = d.squaredNorm();
  const double t = d2 > 0 ? std::clamp((scaled(c) - scaled(p)).dot(d) / d2, 0.0, 1.0) : 0.0;
  const Vector3 center = p * (1 - t) + q * t;
  // No rounding may take the centre out of the segment's box, on which bounding_box relies.
  return {center.cwiseMax(p.cwiseMin(q)).cwiseMin(p.cwiseMax(q)), capsule.r()};
}

/// A unit vector at a right angle to the axis of the capsule; (1,0,0) where p = q.
Vector3 across(const Capsule& capsule) {
  Vector3 d = capsule.q() - capsule.p();
  if (!d.allFinite()) d = capsule.q() / 2 - capsule.p() / 2;
  if (d.isZero(0)) return Vector3::UnitX();
  Index k = 0;  // the axis that d leans to least
  d.cwiseAbs().minCoeff(&k);
  Vector3 normal = Vector3::Zero();
  normal[(k + 1) % 3] = 0 - d[(k + 2) % 3];
  normal[(k + 2) % 3] = d[(k + 1) % 3];
  return (normal / d.cwiseAbs().maxCoeff()).normalized();  // in two steps, of which neither overflows or underflows
}

/// Capsules against spheres: the nearest ball of the capsule against the sphere.
/// Exact       for that ball: the decision, and every number as compute_sphere_sphere rounds it.
/// Not exact   the ball's centre, by the error of nearest_ball: so much a value is off, and so far from the alarm
///             distance a decision may be wrong. Nearer than that to the axis, the direction of the normal means
///             nothing.
/// Points      the convention of the DiscreteIntersection; a capsule is deformable, its centre that of the nearest
///             ball.
/// Degenerate  the sphere's centre is that of the ball: the normal is at a right angle to the axis (1,0,0 may lie
///             along it), and the points follow from it.
class CapsuleSphereIntersector : public BaseIntersector {
 public:
  static constexpr std::string_view kName = "CapsuleSphereIntersector";

  explicit CapsuleSphereIntersector(DiscreteIntersection& object) : points_(object.points()) {
    object.intersectors.add<CapsuleModel, SphereCollisionModel>(*this);
    object.intersectors.add<CapsuleModel, RigidSphereModel>(*this);
  }

  template <class SphereType>
  bool testIntersection(const Capsule& capsule, const SphereType& sphere, const Intersection& current) const {
    return test_sphere_sphere(nearest_ball(capsule, sphere.center()), sphere.ball(), current.getAlarmDistance());
  }

  template <class SphereType>
  int computeIntersection(const Capsule& capsule, const SphereType& sphere, OutputVector& contacts,
                          const Intersection& current) const {
    const Ball ball = nearest_ball(capsule, sphere.center());
    const ContactPoints points{point_on(points_, SphereKind::deformable),
                               point_on(points_, sphere.getCollisionModel().kKind)};
    auto contact =
        compute_sphere_sphere(ball, sphere.ball(), {current.getAlarmDistance(), current.getContactDistance()}, points);
    if (!contact) return 0;
    if (contact->degenerate) {
      contact->normal = across(capsule);
      contact->point1 = contact_point_by_normal(ball, -contact->normal, points.first);
      contact->point2 = contact_point_by_normal(sphere.ball(), contact->normal, points.second);
    }
    contacts.push_back({.elem = {capsule, sphere},
                        .id = contact_id(capsule, sphere),
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
  host.intersectors.registerCreator("CapsuleSphereIntersector", creator_of<CapsuleSphereIntersector>());
}

}  // namespace
}  // namespace example

CONTACT_PLUGIN(example::enter);
