// Intersectors of the pairs that DiscreteIntersection does not have: capsules, rays, lines, triangles and planes, and
// spheres against solid cubes. They join at run time.
#pragma once

#include <type_traits>

#include "contact/capsule_model.hpp"
#include "contact/discrete_intersection.hpp"
#include "contact/line_model.hpp"
#include "contact/pair_functions.hpp"
#include "contact/plane_model.hpp"
#include "contact/ray_model.hpp"
#include "contact/triangle_model.hpp"

namespace contact::inline CONTACT_ABI {

/// The base of an intersector that answers for two elements what production answers for their shapes.
/// Decision, Error, Degenerate, Environment  as test_sphere_capsule, compute_sphere_capsule and so on, the models in
///                                           the order of that name.
/// Points      the convention of the DiscreteIntersection. Under `center` only a rigid sphere reports its surface, and
///             the point of a cube, a triangle or a ray is always on it.
/// Evidence    src/component/shape_intersectors_test.cpp; the engine `component` on every file in golden/.
class ShapeIntersector : public BaseIntersector {
 public:
  /// Whether the two are within the alarm distance of each other.
  template <class Element1, class Element2>
  [[nodiscard]] bool testIntersection(const Element1& elem1, const Element2& elem2,
                                      const Intersection& currentIntersection) const {
    return is_hit(shapes_of(elem1, elem2), distances(currentIntersection));
  }

  /// Appends their contact and returns 1, or returns 0 where they are farther apart than the alarm distance.
  template <class Element1, class Element2>
  int computeIntersection(const Element1& elem1, const Element2& elem2, OutputVector& contacts,
                          const Intersection& currentIntersection) const {
    const auto contact =
        contact_of(shapes_of(elem1, elem2), distances(currentIntersection), {on<Element1>(), on<Element2>()});
    if (!contact) return 0;
    contacts.push_back({.elem = {elem1, elem2},
                        .id = contact_id(elem1, elem2),
                        .point = {contact->point1, contact->point2},
                        .normal = contact->normal,
                        .value = contact->value});
    return 1;
  }

 protected:
  explicit ShapeIntersector(const DiscreteIntersection& object) : points_(object.points()) {}

 private:
  template <class M>
  static Ball shape_of(const SphereOf<M>& sphere) {
    return sphere.ball();
  }
  static Box shape_of(const Cube& cube) { return cube.box(); }
  static Capsule shape_of(const CapsuleElement& element) { return element.capsule(); }
  static Triangle shape_of(const TriangleElement& element) { return element.triangle(); }
  static Ray shape_of(const RayElement& element) { return element.ray(); }
  static Line shape_of(const LineElement& element) { return element.line(); }
  static Plane shape_of(const PlaneElement& element) { return element.plane(); }

  template <class Element1, class Element2>
  static auto shapes_of(const Element1& elem1, const Element2& elem2) {
    return Two<decltype(shape_of(elem1)), decltype(shape_of(elem2))>{shape_of(elem1), shape_of(elem2)};
  }

  static Distances distances(const Intersection& current) {
    return {current.getAlarmDistance(), current.getContactDistance()};
  }
  template <class Element>
  [[nodiscard]] PointOn on() const {
    return point_on(points_, std::is_same_v<Element, RigidSphere> ? SphereKind::rigid : SphereKind::deformable);
  }

  PointConvention points_;
};

/// Capsules against capsules and against both kinds of sphere. As SOFA's class of this name it has registered itself,
/// as "Capsule": a DiscreteIntersection has it wherever the program uses a CapsuleCollisionModel or a ModelFactory.
class CapsuleDiscreteIntersection : public ShapeIntersector {
 public:
  static constexpr std::string_view kName = "CapsuleDiscreteIntersection";
  explicit CapsuleDiscreteIntersection(DiscreteIntersection& object);
};

/// Triangles against lines, as SOFA's class of this name has them: registered by itself, as "Mesh". And both kinds of
/// sphere against triangles, solid and seen from both sides, which SOFA's class has a function for that it registers
/// nowhere.
class MeshDiscreteIntersection : public ShapeIntersector {
 public:
  static constexpr std::string_view kName = "MeshDiscreteIntersection";
  explicit MeshDiscreteIntersection(DiscreteIntersection& object);
};

/// Rays against both kinds of sphere and against triangles, as SOFA's class of this name has them: registered by
/// itself, as "Ray".
class RayDiscreteIntersection : public ShapeIntersector {
 public:
  static constexpr std::string_view kName = "RayDiscreteIntersection";
  explicit RayDiscreteIntersection(DiscreteIntersection& object);
};

/// Both kinds of sphere, and capsules, against planes, each with the half-space below it. SOFA has no such model: its
/// scenes put a plane there as a force field. It has registered itself, as "Plane".
class PlaneDiscreteIntersection : public ShapeIntersector {
 public:
  static constexpr std::string_view kName = "PlaneDiscreteIntersection";
  explicit PlaneDiscreteIntersection(DiscreteIntersection& object);
};

/// Both kinds of sphere against cubes, the cubes taken for solid boxes. To SOFA they are volumes that bound something
/// else, so that its DiscreteIntersection has no such pair, and ours has this one only if you register it:
///   IntersectorFactory::getInstance().registerCreator("SolidCube", creator_of<SolidCubeDiscreteIntersection>());
class SolidCubeDiscreteIntersection : public ShapeIntersector {
 public:
  static constexpr std::string_view kName = "SolidCubeDiscreteIntersection";
  explicit SolidCubeDiscreteIntersection(DiscreteIntersection& object);
};

}  // namespace contact::inline CONTACT_ABI
