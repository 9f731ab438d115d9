// DiscreteIntersection: which models can meet, whether two elements do, and their contact.
#include "contact/discrete_intersection.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <typeinfo>

#include "component/message.hpp"
#include "contact/batch.hpp"
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

bool DiscreteIntersection::may_be_overridden() const {
  return typeid(*this) != typeid(DiscreteIntersection) && typeid(*this) != typeid(ProximityIntersection);
}

bool DiscreteIntersection::intersectCubes(std::span<std::size_t> written) const {
  if (may_be_overridden()) return false;
  std::fill(written.begin(), written.end(), std::size_t{0});  // whatever a test says, boxes have no contacts
  return true;
}

bool DiscreteIntersection::intersectSpheres(const Spheres& first, const Spheres& second,
                                            std::span<const ElementPair> pairs, std::span<std::size_t> written,
                                            OutputVector& contacts, const Intersection& currentIntersection) const {
  if (may_be_overridden()) return false;
  constexpr std::size_t kSome = 256;
  std::array<std::array<double, kSome>, 8> in;
  std::array<std::array<double, kSome>, 10> out;
  std::array<batch::PairState, kSome> state;
  std::array<std::uint32_t, kSome> index;
  const Distances distances{currentIntersection.getAlarmDistance(), currentIntersection.getContactDistance()};
  for (std::size_t begin = 0; begin < pairs.size(); begin += kSome) {
    const auto some = pairs.subspan(begin, std::min(kSome, pairs.size() - begin));
    const std::size_t size = some.size();
    for (std::size_t k = 0; k < size; ++k) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        in[axis][k] = first.centers[static_cast<Index>(axis) * first.count + some[k].first];
        in[4 + axis][k] = second.centers[static_cast<Index>(axis) * second.count + some[k].second];
      }
      in[3][k] = first.radii[some[k].first];
      in[7][k] = second.radii[some[k].second];
    }
    const auto given = [&](std::size_t column) { return std::span<const double>(in[column]).first(size); };
    const auto room = [&](std::size_t column) { return std::span<double>(out[column]).first(size); };
    const batch::Count count = batch::compute_sphere_sphere_hits({given(0), given(1), given(2), given(3)},
                                                                 {given(4), given(5), given(6), given(7)}, distances,
                                                                 std::span(index).first(size),
                                                                 {{room(0), room(1), room(2)},
                                                                  {room(3), room(4), room(5)},
                                                                  {room(6), room(7), room(8)},
                                                                  room(9),
                                                                  std::span(state).first(size)},
                                                                 {first.on, second.on});
    std::fill_n(written.begin() + static_cast<std::ptrdiff_t>(begin), size, std::size_t{0});
    for (std::size_t row = 0; row < count.hits; ++row) {
      const ElementPair& pair = some[index[row]];
      const CollisionElement elem1(first.model, pair.first);
      const CollisionElement elem2(second.model, pair.second);
      const auto vector = [&](std::size_t column) {
        return Vector3(out[column][row], out[column + 1][row], out[column + 2][row]);
      };
      contacts.push_back({.elem = {elem1, elem2},
                          .id = contact_id(elem1, elem2),
                          .point = {vector(3), vector(6)},
                          .normal = vector(0),
                          .value = out[9][row]});
      written[begin + index[row]] = 1;
    }
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
