// ExactDiscreteIntersection: SOFA's DiscreteIntersection with this project's decisions and numbers.
#pragma once

#include <sofa/component/collision/detection/intersection/DiscreteIntersection.h>

#include <atomic>
#include <string>

#include "contact/contact.hpp"

namespace contact::sofa_plugin {

/// A scene has it in place of DiscreteIntersection, or of a component with alarmDistance and contactDistance.
/// Decision    exact, of spheres and of the boxes that the broad and narrow phase test.
/// Error       every number of a contact is the exact real rounded once. Id, elements and order are SOFA's.
/// Degenerate  coincident centres: normal (1,0,0), as in docs/specification.md#coincident-centres.
/// Domain      a pair with a number that is not finite, or a negative radius, has no contact, and the first is told.
/// Threads     any number may test and compute at once.
/// Other pairs as in SOFA: what its IntersectorFactory adds to a DiscreteIntersection.
/// Evidence    engines/sofa/sofa_test.py.
class ExactDiscreteIntersection : public sofa::component::collision::detection::intersection::DiscreteIntersection {
 public:
  SOFA_CLASS(ExactDiscreteIntersection, sofa::component::collision::detection::intersection::DiscreteIntersection);
  using Current = sofa::core::collision::Intersection;
  using Cube = sofa::component::collision::geometry::Cube;
  using Sphere = sofa::component::collision::geometry::Sphere;
  using RigidSphere = sofa::component::collision::geometry::RigidSphere;

  void init() override;

  bool useProximity() const override { return d_alarmDistance.getValue() > 0; }
  SReal getAlarmDistance() const override { return d_alarmDistance.getValue(); }
  SReal getContactDistance() const override { return d_contactDistance.getValue(); }
  void setAlarmDistance(SReal distance) override { d_alarmDistance.setValue(distance); }
  void setContactDistance(SReal distance) override { d_contactDistance.setValue(distance); }

  bool testIntersection(Cube& cube1, Cube& cube2, const Current* current) override;
  int computeIntersection(Cube& cube1, Cube& cube2, OutputVector* contacts, const Current* current) override;
  bool testIntersection(Sphere& sph1, Sphere& sph2, const Current* current) override;
  int computeIntersection(Sphere& sph1, Sphere& sph2, OutputVector* contacts, const Current* current) override;
  bool testIntersection(RigidSphere& sph1, RigidSphere& sph2, const Current* current) override;
  int computeIntersection(RigidSphere& sph1, RigidSphere& sph2, OutputVector* contacts,
                          const Current* current) override;
  bool testIntersection(Sphere& sph1, RigidSphere& sph2, const Current* current) override;
  int computeIntersection(Sphere& sph1, RigidSphere& sph2, OutputVector* contacts, const Current* current) override;

  sofa::core::objectmodel::Data<SReal> d_alarmDistance;
  sofa::core::objectmodel::Data<SReal> d_contactDistance;
  sofa::core::objectmodel::Data<std::string> d_contactPoints;

 protected:
  ExactDiscreteIntersection();

 private:
  template <class First, class Second>
  bool test(First& sph1, Second& sph2, const Current& current);
  template <class First, class Second>
  int compute(First& sph1, Second& sph2, OutputVector& contacts, const Current& current);
  template <class First, class Second>
  bool serves(const First& a, const Second& b, Distances distances);

  PointConvention points_ = PointConvention::center;
  std::atomic_flag told_ = ATOMIC_FLAG_INIT;
};

}  // namespace contact::sofa_plugin
