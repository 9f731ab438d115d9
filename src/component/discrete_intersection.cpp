// DiscreteIntersection: which models can meet, whether two elements do, and their contact.
#include "contact/discrete_intersection.hpp"

#include <numbers>
#include <stdexcept>

#include "component/message.hpp"
#include "contact/cube_cube.hpp"

namespace contact {

bool Intersection::isSupported(const CollisionElement& elem1, const CollisionElement& elem2) const {
  bool swap = false;
  return findIntersector(elem1.getCollisionModel(), elem2.getCollisionModel(), swap) != nullptr;
}

DiscreteIntersection::DiscreteIntersection(PointConvention points, const IntersectorFactory& factory)
    : points_(points) {
  intersectors.add<CubeCollisionModel, CubeCollisionModel>(*this);
  intersectors.add<SphereCollisionModel, SphereCollisionModel>(*this);
  intersectors.add<RigidSphereModel, RigidSphereModel>(*this);
  intersectors.add<SphereCollisionModel, RigidSphereModel>(*this);
  created_ = factory.addIntersectors(*this);
}

const ElementIntersector* DiscreteIntersection::findIntersector(const CollisionModel& object1,
                                                                const CollisionModel& object2, bool& swapModels) const {
  return intersectors.get(object1, object2, swapModels);
}

bool DiscreteIntersection::testIntersection(const Cube& cube1, const Cube& cube2,
                                            const Intersection& currentIntersection) const {
  if (cube1 == cube2) return cube1.getConeAngle() >= std::numbers::pi / 2;
  return test_cube_cube(cube1.box(), cube2.box(), currentIntersection.getAlarmDistance());
}

int DiscreteIntersection::computeIntersection(const Cube&, const Cube&, OutputVector&, const Intersection&) const {
  return 0;
}

bool DiscreteIntersection::testIntersection(const Sphere& sph1, const Sphere& sph2,
                                            const Intersection& currentIntersection) const {
  return testIntersectionSphere(sph1, sph2, currentIntersection.getAlarmDistance());
}

bool DiscreteIntersection::testIntersection(const RigidSphere& sph1, const RigidSphere& sph2,
                                            const Intersection& currentIntersection) const {
  return testIntersectionSphere(sph1, sph2, currentIntersection.getAlarmDistance());
}

bool DiscreteIntersection::testIntersection(const Sphere& sph1, const RigidSphere& sph2,
                                            const Intersection& currentIntersection) const {
  return testIntersectionSphere(sph1, sph2, currentIntersection.getAlarmDistance());
}

int DiscreteIntersection::computeIntersection(const Sphere& sph1, const Sphere& sph2, OutputVector& contacts,
                                              const Intersection& currentIntersection) const {
  return computeIntersectionSphere(sph1, sph2, contacts, currentIntersection.getAlarmDistance(),
                                   currentIntersection.getContactDistance());
}

int DiscreteIntersection::computeIntersection(const RigidSphere& sph1, const RigidSphere& sph2, OutputVector& contacts,
                                              const Intersection& currentIntersection) const {
  return computeIntersectionSphere(sph1, sph2, contacts, currentIntersection.getAlarmDistance(),
                                   currentIntersection.getContactDistance());
}

int DiscreteIntersection::computeIntersection(const Sphere& sph1, const RigidSphere& sph2, OutputVector& contacts,
                                              const Intersection& currentIntersection) const {
  return computeIntersectionSphere(sph1, sph2, contacts, currentIntersection.getAlarmDistance(),
                                   currentIntersection.getContactDistance());
}

ProximityIntersection::ProximityIntersection(Distances distances, PointConvention points,
                                             const IntersectorFactory& factory)
    : DiscreteIntersection(points, factory) {
  set(distances);
}

void ProximityIntersection::setAlarmDistance(double distance) { set({distance, distances_.contact}); }

void ProximityIntersection::setContactDistance(double distance) { set({distances_.alarm, distance}); }

void ProximityIntersection::set(Distances distances) {
  if (const auto error = outside_domain(distances)) throw std::invalid_argument(component::message(*error));
  distances_ = distances;
}

}  // namespace contact
