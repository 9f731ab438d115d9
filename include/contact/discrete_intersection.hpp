// DiscreteIntersection: which models can meet, whether two elements do, and their contact.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "contact/contact.hpp"
#include "contact/cube_model.hpp"
#include "contact/intersector_factory.hpp"
#include "contact/intersector_map.hpp"
#include "contact/sphere_model.hpp"
#include "contact/sphere_sphere.hpp"

namespace contact::inline CONTACT_ABI {

/// SOFA's component for discrete detection between cubes and spheres.
///
/// Its own alarm and contact distance are always 0. A test takes its distances from `currentIntersection`, which may be
/// another object (ProximityIntersection below has distances of its own).
/// Decision    exact. Every number of a contact is correctly rounded: see test_sphere_sphere, compute_sphere_sphere and
///             test_cube_cube.
/// Domain      the distances of `currentIntersection` finite and >= 0; models check their data themselves.
/// Threads     the methods are const; any number of threads may test and compute at once.
/// Source      seed.txt; docs/sofa-map.md says what is the same as in SOFA and what differs.
/// Evidence    src/component/discrete_intersection_test.cpp; the engine `component` on every file in golden/.
class DiscreteIntersection : public Intersection, public BaseIntersector {
 public:
  using IntersectorFactory = contact::IntersectorFactory;
  static constexpr std::string_view kName = "DiscreteIntersection";

  /// Supports Cube-Cube, Sphere-Sphere, RigidSphere-RigidSphere and Sphere-RigidSphere, and what `factory` adds.
  explicit DiscreteIntersection(PointConvention points = PointConvention::nearest_surface,
                                const IntersectorFactory& factory = IntersectorFactory::getInstance());

  [[nodiscard]] const ElementIntersector* findIntersector(const CollisionModel& object1, const CollisionModel& object2,
                                                          bool& swapModels) const override;

  IntersectorMap intersectors;

  /// Whether two boxes are within the alarm distance on every axis. For an element against itself the answer is whether
  /// its cone of normals spans a half turn or more (angle >= pi/2 from its axis), so that the surface inside the box
  /// could touch itself.
  [[nodiscard]] virtual bool testIntersection(const Cube& cube1, const Cube& cube2,
                                              const Intersection& currentIntersection) const;
  /// Writes nothing and returns 0.
  virtual int computeIntersection(const Cube& cube1, const Cube& cube2, OutputVector& contacts,
                                  const Intersection& currentIntersection) const;

  /// Whether two spheres are within the alarm distance of each other.
  [[nodiscard]] virtual bool testIntersection(const Sphere& sph1, const Sphere& sph2,
                                              const Intersection& currentIntersection) const;
  [[nodiscard]] virtual bool testIntersection(const RigidSphere& sph1, const RigidSphere& sph2,
                                              const Intersection& currentIntersection) const;
  [[nodiscard]] virtual bool testIntersection(const Sphere& sph1, const RigidSphere& sph2,
                                              const Intersection& currentIntersection) const;
  /// Appends their contact and returns 1, or returns 0 where they are farther apart than the alarm distance.
  virtual int computeIntersection(const Sphere& sph1, const Sphere& sph2, OutputVector& contacts,
                                  const Intersection& currentIntersection) const;
  virtual int computeIntersection(const RigidSphere& sph1, const RigidSphere& sph2, OutputVector& contacts,
                                  const Intersection& currentIntersection) const;
  virtual int computeIntersection(const Sphere& sph1, const RigidSphere& sph2, OutputVector& contacts,
                                  const Intersection& currentIntersection) const;

  /// Intersects many pairs at once, spheres by the batch kernels. It appends the same contacts as computeIntersection,
  /// and none between boxes. It returns false and writes nothing where a derived class may have overridden the methods
  /// above, and for other models.
  template <class Model1, class Model2>
  bool intersectPairs(const Model1& model1, const Model2& model2, std::span<const ElementPair> pairs,
                      std::span<std::size_t> written, OutputVector& contacts,
                      const Intersection& currentIntersection) const {
    constexpr bool kSpheres = requires {
      model1.balls();
      model2.balls();
    };
    if constexpr (kSpheres)
      return intersectSpheres(spheres(model1), spheres(model2), pairs, written, contacts, currentIntersection);
    else if constexpr (std::is_same_v<Model1, CubeCollisionModel> && std::is_same_v<Model2, CubeCollisionModel>)
      return intersectCubes(written);
    else
      return false;
  }

  [[nodiscard]] PointConvention points() const { return points_; }

 protected:
  /// These two serve any two sphere classes that have ball(). A derived component uses them for its own sphere classes.
  template <class SphereType1, class SphereType2>
  [[nodiscard]] bool testIntersectionSphere(const SphereType1& sph1, const SphereType2& sph2, double alarmDist) const {
    return test_sphere_sphere(sph1.ball(), sph2.ball(), alarmDist);
  }

  template <class SphereType1, class SphereType2>
  int computeIntersectionSphere(const SphereType1& sph1, const SphereType2& sph2, OutputVector& contacts,
                                double alarmDist, double contactDist) const {
    const auto kind = [](const auto& sphere) {
      return std::remove_cvref_t<decltype(sphere.getCollisionModel())>::kKind;
    };
    const auto contact = compute_sphere_sphere(sph1.ball(), sph2.ball(), {.alarm = alarmDist, .contact = contactDist},
                                               {point_on(points_, kind(sph1)), point_on(points_, kind(sph2))});
    if (!contact) return 0;
    contacts.push_back({.elem = {sph1, sph2},
                        .id = contact_id(sph1, sph2),
                        .point = {contact->point1, contact->point2},
                        .normal = contact->normal,
                        .value = contact->value});
    return 1;
  }

 private:
  /// Where a model's numbers lie. `centers` holds x of every centre, then every y, then every z.
  struct Spheres {
    const CollisionModel& model;
    const double* centers;
    const double* radii;
    Index count;
    PointOn on;
  };
  template <class Model>
  [[nodiscard]] Spheres spheres(const Model& model) const {
    return {model, model.balls().centers.data(), model.balls().radii.data(), model.balls().radii.size(),
            point_on(points_, Model::kKind)};
  }
  bool intersectSpheres(const Spheres& first, const Spheres& second, std::span<const ElementPair> pairs,
                        std::span<std::size_t> written, OutputVector& contacts,
                        const Intersection& currentIntersection) const;
  bool intersectCubes(std::span<std::size_t> written) const;
  [[nodiscard]] bool may_be_overridden() const;

  PointConvention points_;
  std::vector<std::shared_ptr<const void>> created_;  ///< what the factory's creators made
};

/// A DiscreteIntersection with an alarm and a contact distance of its own, as SOFA's BaseProximityIntersection.
/// Units       of the models' coordinates.
/// Domain      both are finite and >= 0. Anything else throws std::invalid_argument and changes nothing.
class ProximityIntersection : public DiscreteIntersection {
 public:
  explicit ProximityIntersection(Distances distances, PointConvention points = PointConvention::nearest_surface,
                                 const IntersectorFactory& factory = IntersectorFactory::getInstance());

  [[nodiscard]] bool useProximity() const override { return true; }
  [[nodiscard]] double getAlarmDistance() const override { return distances_.alarm; }
  [[nodiscard]] double getContactDistance() const override { return distances_.contact; }
  void setAlarmDistance(double distance) override;
  void setContactDistance(double distance) override;

 private:
  void set(Distances distances);

  Distances distances_{};
};

}  // namespace contact::inline CONTACT_ABI
