// ExactDiscreteIntersection: SOFA's elements in, this project's decisions and numbers out.
#include "engines/sofa/plugin/exact_discrete_intersection.hpp"

#include <numbers>

#include "contact/cube_cube.hpp"
#include "contact/domain.hpp"
#include "contact/sphere_sphere.hpp"
#include "engines/sofa/plugin/shapes.hpp"

namespace contact::sofa_plugin {

ExactDiscreteIntersection::ExactDiscreteIntersection()
    : d_alarmDistance(initData(&d_alarmDistance, SReal(0), "alarmDistance", "Pairs up to this far apart are contacts")),
      d_contactDistance(initData(&d_contactDistance, SReal(0), "contactDistance", "What a contact's value is less")),
      d_contactPoints(initData(&d_contactPoints, std::string("center"), "contactPoints",
                               "center: of a deformable sphere its centre, as in DiscreteIntersection; "
                               "nearest_surface: of both kinds the nearest point of the surface")) {}

void ExactDiscreteIntersection::init() {
  DiscreteIntersection::init();
  const std::string& points = d_contactPoints.getValue();
  if (points == "nearest_surface")
    points_ = PointConvention::nearest_surface;
  else if (points == "center")
    points_ = PointConvention::center;
  else
    msg_error() << "contactPoints='" << points << "': expected center or nearest_surface; it stays center";
  for (auto* distance : {&d_alarmDistance, &d_contactDistance})
    if (const auto error = outside_domain(distance->getName(), distance->getValue())) {
      msg_error() << error->field << "='" << distance->getValue() << "': " << error->rule << "; it becomes 0";
      distance->setValue(0);
    }
}

/// Kernels check nothing; a simulation that has exploded has NaN for positions.
template <class First, class Second>
bool ExactDiscreteIntersection::serves(const First& a, const Second& b, Distances distances) {
  auto error = outside_domain("first", a);
  if (!error) error = outside_domain("second", b);
  if (!error) error = outside_domain(distances);
  if (!error) return true;
  if (!told_.test_and_set())
    msg_warning() << error->field << ": " << error->rule
                  << ". Such a pair has no contact. This is the first one, and the others are not told.";
  return false;
}

template <class First, class Second>
bool ExactDiscreteIntersection::test(First& sph1, Second& sph2, const Current& current) {
  const double alarm = current.getAlarmDistance();
  const Ball a = shape_of(sph1);
  const Ball b = shape_of(sph2);
  return serves(a, b, {.alarm = alarm, .contact = 0}) && test_sphere_sphere(a, b, alarm);
}

template <class First, class Second>
int ExactDiscreteIntersection::compute(First& sph1, Second& sph2, OutputVector& contacts, const Current& current) {
  const Distances distances{.alarm = current.getAlarmDistance(), .contact = current.getContactDistance()};
  const Ball a = shape_of(sph1);
  const Ball b = shape_of(sph2);
  if (!serves(a, b, distances)) return 0;
  const auto found =
      compute_sphere_sphere(a, b, distances, {point_on(points_, kind_of(sph1)), point_on(points_, kind_of(sph2))});
  if (!found) return 0;
  contacts.resize(contacts.size() + 1);
  auto& detection = contacts.back();
  detection.normal = vec_of(found->normal);
  detection.point[0] = vec_of(found->point1);
  detection.point[1] = vec_of(found->point2);
  detection.value = found->value;
  detection.elem.first = sph1;
  detection.elem.second = sph2;
  const bool first_is_larger = sph1.getCollisionModel()->getSize() > sph2.getCollisionModel()->getSize();
  detection.id = first_is_larger ? sph1.getIndex() : sph2.getIndex();
  return 1;
}

bool ExactDiscreteIntersection::testIntersection(Cube& cube1, Cube& cube2, const Current* current) {
  // A cube against itself: whether its cone of normals spans a half turn, so that what it bounds may touch itself.
  if (cube1 == cube2) return cube1.getConeAngle() >= std::numbers::pi / 2;
  const double alarm = current->getAlarmDistance();
  const Box a = shape_of(cube1);
  const Box b = shape_of(cube2);
  return serves(a, b, {.alarm = alarm, .contact = 0}) && test_cube_cube(a, b, alarm);
}
int ExactDiscreteIntersection::computeIntersection(Cube&, Cube&, OutputVector*, const Current*) { return 0; }

bool ExactDiscreteIntersection::testIntersection(Sphere& sph1, Sphere& sph2, const Current* current) {
  return test(sph1, sph2, *current);
}
bool ExactDiscreteIntersection::testIntersection(RigidSphere& sph1, RigidSphere& sph2, const Current* current) {
  return test(sph1, sph2, *current);
}
bool ExactDiscreteIntersection::testIntersection(Sphere& sph1, RigidSphere& sph2, const Current* current) {
  return test(sph1, sph2, *current);
}
int ExactDiscreteIntersection::computeIntersection(Sphere& sph1, Sphere& sph2, OutputVector* contacts,
                                                   const Current* current) {
  return compute(sph1, sph2, *contacts, *current);
}
int ExactDiscreteIntersection::computeIntersection(RigidSphere& sph1, RigidSphere& sph2, OutputVector* contacts,
                                                   const Current* current) {
  return compute(sph1, sph2, *contacts, *current);
}
int ExactDiscreteIntersection::computeIntersection(Sphere& sph1, RigidSphere& sph2, OutputVector* contacts,
                                                   const Current* current) {
  return compute(sph1, sph2, *contacts, *current);
}

}  // namespace contact::sofa_plugin
