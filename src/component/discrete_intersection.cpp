// DiscreteIntersection: which models can meet, whether two elements do, and their contact.
#include "contact/discrete_intersection.hpp"

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "component/built_in.hpp"
#include "component/message.hpp"
#include "component/sphere_contacts.hpp"
#include "contact/cube_cube.hpp"

namespace contact::inline CONTACT_ABI {

bool Intersection::isSupported(const CollisionElement& elem1, const CollisionElement& elem2) const {
  bool swap = false;
  return findIntersector(elem1.getCollisionModel(), elem2.getCollisionModel(), swap) != nullptr;
}

void ElementIntersector::intersectPairs(const CollisionModel& model1, const CollisionModel& model2,
                                        std::span<const ElementPair> pairs, std::span<std::size_t> written,
                                        OutputVector& contacts, const Intersection& currentIntersection) const {
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const CollisionElement elem1(model1, pairs[k].first);
    const CollisionElement elem2(model2, pairs[k].second);
    const std::size_t before = contacts.size();
    if (canIntersect(elem1, elem2, currentIntersection)) intersect(elem1, elem2, contacts, currentIntersection);
    written[k] = contacts.size() - before;
  }
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
  if (cube1 == cube2) return !is_less_by_bits(cube1.getConeAngle(), std::numbers::pi / 2);
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

bool DiscreteIntersection::may_be_overridden() const { return !component::is_built_in(*this); }

bool DiscreteIntersection::intersectCubes(std::span<std::size_t> written) const {
  if (may_be_overridden()) return false;
  std::fill(written.begin(), written.end(), std::size_t{0});  // whatever a test says, boxes have no contacts
  return true;
}

bool DiscreteIntersection::intersectSpheres(const Spheres& first, const Spheres& second,
                                            std::span<const ElementPair> pairs, std::span<std::size_t> written,
                                            OutputVector& contacts, const Intersection& currentIntersection) const {
  if (may_be_overridden()) return false;
  constexpr std::size_t kSome = component::SphereContacts::kMost;
  component::SphereContacts together;
  const Distances distances{currentIntersection.getAlarmDistance(), currentIntersection.getContactDistance()};
  for (std::size_t begin = 0; begin < pairs.size(); begin += kSome) {
    const auto some = pairs.subspan(begin, std::min(kSome, pairs.size() - begin));
    for (std::size_t k = 0; k < some.size(); ++k) {
      const auto number = [](const Spheres& spheres, Index axis, Index i) {
        return spheres.centers[axis * spheres.count + i];
      };
      const auto [i, j] = some[k];
      together.set(k, number(first, 0, i), number(first, 1, i), number(first, 2, i), first.radii[i],
                   number(second, 0, j), number(second, 1, j), number(second, 2, j), second.radii[j]);
    }
    std::fill_n(written.begin() + static_cast<std::ptrdiff_t>(begin), some.size(), std::size_t{0});
    together.compute(some.size(), distances, {first.on, second.on}, [&](std::size_t k, std::size_t row) {
      const CollisionElement elem1(first.model, some[k].first);
      const CollisionElement elem2(second.model, some[k].second);
      contacts.push_back(together.contact(row, elem1, elem2, contact_id(elem1, elem2)));
      written[begin + k] = 1;
    });
  }
  return true;
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

}  // namespace contact::inline CONTACT_ABI
