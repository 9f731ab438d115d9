// DiscreteIntersection: every method and every behaviour that its source names, by worked examples.
//
// The spheres of the examples are 3-4-5 triangles: centres (0,0,0) and (3,4,0), distance 5, normal (0.6, 0.8, 0).
#include "contact/discrete_intersection.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <type_traits>
#include <vector>

#include "component/models_for_tests.hpp"
#include "extreme_numbers.hpp"

namespace contact {
namespace {

using component::cubes;
using component::Current;
using component::Press;
using component::rigid_spheres;
using component::spheres;
using component::text;
using component::what_of;

static_assert(std::is_base_of_v<Intersection, DiscreteIntersection>);
static_assert(std::is_base_of_v<BaseIntersector, DiscreteIntersection>);
static_assert(std::is_same_v<DiscreteIntersection::OutputVector, std::vector<DetectionOutput>>);
static_assert(std::is_same_v<DiscreteIntersection::IntersectorFactory, IntersectorFactory>);
static_assert(!std::is_copy_constructible_v<DiscreteIntersection>, "its map holds its address");

const Ball kFirst{{0, 0, 0}, 1};
const Ball kSecond{{3, 4, 0}, 2};  // the gap between them is 2

/// The one contact of two elements as text, or how many there are where there is not one.
template <class E1, class E2>
std::string contact_of(const DiscreteIntersection& component, const E1& elem1, const E2& elem2,
                       const Current& current) {
  OutputVector contacts;
  const int written = component.computeIntersection(elem1, elem2, contacts, current);
  if (written != static_cast<int>(contacts.size())) return "the number returned is wrong";
  return written == 1 ? text(contacts[0]) : std::to_string(written) + " contacts";
}

/// The contact of kFirst and kSecond at contact distance 0.5: value 5 - 3 - 0.5.
std::string expected(const CollisionElement& first, const CollisionElement& second, const Vector3& point1,
                     const Vector3& point2) {
  return text(DetectionOutput{
      .elem = {first, second}, .id = 0, .point = {point1, point2}, .normal = {0.6, 0.8, 0}, .value = 1.5, .deltaT = 0});
}

/// A pair of spheres of any two kinds: tested at, beyond and within the alarm distance, then computed.
template <class E1, class E2>
void expect_3_4_5(const E1& sph1, const E2& sph2) {
  const DiscreteIntersection component;
  EXPECT_TRUE(component.testIntersection(sph1, sph2, Current(2))) << "exactly at the alarm distance";
  EXPECT_FALSE(component.testIntersection(sph1, sph2, Current(std::nextafter(2, 0)))) << "one ulp beyond it";
  EXPECT_TRUE(component.testIntersection(sph1, sph2, Current(100, 100)));
  EXPECT_FALSE(component.testIntersection(sph1, sph2, Current(0, 100))) << "the contact distance has no say";
  EXPECT_EQ(contact_of(component, sph1, sph2, Current(2, 0.5)), expected(sph1, sph2, {0.6, 0.8, 0}, {1.8, 2.4, 0}));
  EXPECT_EQ(contact_of(component, sph1, sph2, Current(std::nextafter(2, 0), 0.5)), "0 contacts");
}

TEST(DiscreteIntersection, tests_and_computes_two_spheres) {
  const auto a = spheres("a", {kFirst});
  const auto b = spheres("b", {kSecond});
  expect_3_4_5(Sphere(a, 0), Sphere(b, 0));
}

TEST(DiscreteIntersection, tests_and_computes_two_rigid_spheres) {
  const auto a = rigid_spheres("a", {kFirst});
  const auto b = rigid_spheres("b", {kSecond});
  expect_3_4_5(RigidSphere(a, 0), RigidSphere(b, 0));
}

TEST(DiscreteIntersection, tests_and_computes_a_sphere_and_a_rigid_sphere) {
  const auto a = spheres("a", {kFirst});
  const auto b = rigid_spheres("b", {kSecond});
  expect_3_4_5(Sphere(a, 0), RigidSphere(b, 0));
}

TEST(DiscreteIntersection, touching_spheres_intersect_at_alarm_distance_0) {
  const auto a = spheres("a", {{{0, 0, 0}, 2}});
  const auto b = spheres("b", {{{3, 4, 0}, 3}, {{3, 4, 0}, std::nextafter(3, 0)}});
  const DiscreteIntersection component;
  EXPECT_TRUE(component.testIntersection(Sphere(a, 0), Sphere(b, 0), component));
  EXPECT_FALSE(component.testIntersection(Sphere(a, 0), Sphere(b, 1), component));
}

TEST(DiscreteIntersection, the_value_is_negative_where_spheres_penetrate) {
  const auto a = spheres("a", {{{0, 0, 0}, 4}});
  const auto b = spheres("b", {{{3, 4, 0}, 2}});
  OutputVector contacts;
  const DiscreteIntersection component;
  EXPECT_EQ(component.computeIntersection(Sphere(a, 0), Sphere(b, 0), contacts, Current(0, 0.25)), 1);
  EXPECT_EQ(contacts.at(0).value, -1.25);  // 5 - 6 - 0.25
}

TEST(DiscreteIntersection, the_normal_points_from_the_first_to_the_second) {
  const auto a = spheres("a", {kFirst});
  const auto b = spheres("b", {kSecond});
  OutputVector contacts;
  const DiscreteIntersection component;
  component.computeIntersection(Sphere(b, 0), Sphere(a, 0), contacts, Current(2));
  EXPECT_EQ(contacts.at(0).normal, Vector3(-0.6, -0.8, 0));
  EXPECT_EQ(contacts.at(0).point[0], Vector3(1.8, 2.4, 0));
  EXPECT_EQ(contacts.at(0).point[1], Vector3(0.6, 0.8, 0));
}

TEST(DiscreteIntersection, numbers_a_contact_by_the_element_of_the_larger_model) {
  const auto small = spheres("small", std::vector<Ball>(2, kFirst));
  const auto large = rigid_spheres("large", std::vector<Ball>(4, kSecond));
  const auto same = spheres("same", std::vector<Ball>(2, kSecond));
  const DiscreteIntersection component;
  OutputVector contacts;
  component.computeIntersection(Sphere(small, 1), RigidSphere(large, 3), contacts, Current(2));
  component.computeIntersection(RigidSphere(large, 2), RigidSphere(rigid_spheres("one", {kFirst}), 0), contacts,
                                Current(2));
  component.computeIntersection(Sphere(small, 0), Sphere(same, 1), contacts, Current(2));
  ASSERT_EQ(contacts.size(), 3U);
  EXPECT_EQ(contacts[0].id, 3);
  EXPECT_EQ(contacts[1].id, 2);
  EXPECT_EQ(contacts[2].id, 1) << "models of one size: the second's";
}

TEST(DiscreteIntersection, names_the_elements_first_and_second_and_no_time_of_contact) {
  const auto a = spheres("a", {kFirst, kFirst});
  const auto b = rigid_spheres("b", {kSecond});
  const DiscreteIntersection component;
  OutputVector contacts;
  component.computeIntersection(Sphere(a, 1), RigidSphere(b, 0), contacts, Current(2));
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts[0].elem.first, CollisionElement(a, 1));
  EXPECT_EQ(contacts[0].elem.second, CollisionElement(b, 0));
  EXPECT_EQ(contacts[0].deltaT, 0);
}

TEST(DiscreteIntersection, appends_to_the_contacts_that_are_there) {
  const auto a = spheres("a", {kFirst});
  const auto b = spheres("b", {kSecond});
  const DiscreteIntersection component;
  OutputVector contacts{component::numbered_contact({a, 0}, {a, 0}, 77)};
  EXPECT_EQ(component.computeIntersection(Sphere(a, 0), Sphere(b, 0), contacts, Current(2)), 1);
  EXPECT_EQ(component.computeIntersection(Sphere(a, 0), Sphere(b, 0), contacts, Current(0)), 0);
  EXPECT_EQ(component.computeIntersection(Sphere(b, 0), Sphere(a, 0), contacts, Current(2)), 1);
  ASSERT_EQ(contacts.size(), 3U);
  EXPECT_EQ(contacts[0].id, 77);
  EXPECT_EQ(contacts[1].normal[0], 0.6);
  EXPECT_EQ(contacts[2].normal[0], -0.6);
}

TEST(DiscreteIntersection, its_contact_points_follow_the_convention_and_the_kind_of_each_sphere) {
  const auto s1 = spheres("s1", {kFirst});
  const auto s2 = spheres("s2", {kSecond});
  const auto r1 = rigid_spheres("r1", {kFirst});
  const auto r2 = rigid_spheres("r2", {kSecond});
  const Vector3 near1(0.6, 0.8, 0);
  const Vector3 near2(1.8, 2.4, 0);
  const Vector3 far1(-0.6, -0.8, 0);
  const Vector3 far2(4.2, 5.6, 0);  // (3,4) + 2 n
  struct Case {
    PointConvention convention;
    Vector3 sphere1, sphere2, rigid1, rigid2;
  };
  for (const Case& c : {Case{PointConvention::nearest_surface, near1, near2, near1, near2},
                        Case{PointConvention::center, {0, 0, 0}, {3, 4, 0}, near1, near2},
                        Case{PointConvention::published, far1, far2, far1, far2}}) {
    const DiscreteIntersection component(c.convention);
    EXPECT_EQ(component.points(), c.convention);
    const Current current(2, 0.5);
    EXPECT_EQ(contact_of(component, Sphere(s1, 0), Sphere(s2, 0), current),
              expected({s1, 0}, {s2, 0}, c.sphere1, c.sphere2));
    EXPECT_EQ(contact_of(component, RigidSphere(r1, 0), RigidSphere(r2, 0), current),
              expected({r1, 0}, {r2, 0}, c.rigid1, c.rigid2));
    EXPECT_EQ(contact_of(component, Sphere(s1, 0), RigidSphere(r2, 0), current),
              expected({s1, 0}, {r2, 0}, c.sphere1, c.rigid2));
  }
  EXPECT_EQ(DiscreteIntersection().points(), PointConvention::nearest_surface);
}

TEST(DiscreteIntersection, coincident_centres_have_the_normal_1_0_0) {
  const auto a = spheres("a", {{{3, 4, 5}, 1}});
  const auto b = rigid_spheres("b", {{{3, 4, 5}, 2}});
  const DiscreteIntersection component;
  EXPECT_TRUE(component.testIntersection(Sphere(a, 0), RigidSphere(b, 0), Current(0)));
  EXPECT_EQ(contact_of(component, Sphere(a, 0), RigidSphere(b, 0), Current(0, 0.25)),
            text(DetectionOutput{.elem = {{a, 0}, {b, 0}},
                                 .id = 0,
                                 .point = {Vector3(4, 4, 5), Vector3(1, 4, 5)},
                                 .normal = {1, 0, 0},
                                 .value = -3.25}));
}

TEST(DiscreteIntersection, tests_two_cubes_axis_by_axis_within_the_alarm_distance) {
  const DiscreteIntersection component;
  const auto a = cubes("a", {{{0, 0, 0}, {1, 1, 1}}});
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {-1, 1}) {
      Vector3 shift = Vector3::Zero();
      shift[axis] = side * 3;  // a gap of 2 on this axis alone
      const auto b = cubes("b", {{shift, shift + Vector3::Ones()}});
      EXPECT_FALSE(component.testIntersection(Cube(a, 0), Cube(b, 0), Current(0)));
      EXPECT_FALSE(component.testIntersection(Cube(a, 0), Cube(b, 0), Current(std::nextafter(2, 0))));
      EXPECT_TRUE(component.testIntersection(Cube(a, 0), Cube(b, 0), Current(2)));
    }
  const auto corner =
      cubes("corner", {{{3, 3, 3}, {4, 4, 4}}, {{0.25, 0.25, 0.25}, {0.5, 0.5, 0.5}}, {{1, 1, 1}, {2, 2, 2}}});
  EXPECT_TRUE(component.testIntersection(Cube(a, 0), Cube(corner, 0), Current(2))) << "the corners are sqrt(12) apart";
  EXPECT_TRUE(component.testIntersection(Cube(a, 0), Cube(corner, 1), Current(0))) << "one inside the other";
  EXPECT_TRUE(component.testIntersection(Cube(a, 0), Cube(corner, 2), Current(0))) << "touching in a corner";
}

TEST(DiscreteIntersection, writes_no_contact_for_two_cubes_and_returns_0) {
  const auto a = cubes("a", {{{0, 0, 0}, {1, 1, 1}}, {{0, 0, 0}, {1, 1, 1}}});
  const DiscreteIntersection component;
  OutputVector contacts{component::numbered_contact({a, 0}, {a, 1}, 77)};
  EXPECT_EQ(component.computeIntersection(Cube(a, 0), Cube(a, 1), contacts, Current(1)), 0);
  EXPECT_EQ(contacts.size(), 1U);
}

TEST(DiscreteIntersection, a_cube_meets_itself_where_its_normals_span_a_half_turn_whatever_box_and_alarm) {
  constexpr double kQuarterTurn = std::numbers::pi / 2;
  auto model = cubes("c", {{{0, 0, 0}, {1, 1, 1}}, {{0, 0, 0}, {1, 1, 1}}});
  const DiscreteIntersection component;
  const auto meets_itself = [&](double alarm) {
    return component.testIntersection(Cube(model, 0), Cube(model, 0), Current(alarm));
  };
  EXPECT_TRUE(meets_itself(0)) << "nothing is known of its normals";
  model.setParentOf(0, {0, 0, 0}, {1, 1, 1}, {0, 0, 1}, kQuarterTurn);
  EXPECT_TRUE(meets_itself(0)) << "a half turn counts";
  model.setParentOf(0, {0, 0, 0}, {1, 1, 1}, {0, 0, 1}, std::nextafter(kQuarterTurn, 0));
  EXPECT_FALSE(meets_itself(0)) << "though its box overlaps itself";
  EXPECT_FALSE(meets_itself(1e300));
  EXPECT_TRUE(component.testIntersection(Cube(model, 0), Cube(model, 1), Current(0)))
      << "an equal box of the same model is another element: cones play no part";
  model.setParentOf(0, {0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(Cube(model, 0).getConeAngle(), 2 * std::numbers::pi);
  EXPECT_TRUE(meets_itself(0)) << "a whole turn after bounds without a normal";
}

TEST(DiscreteIntersection, a_cube_and_the_same_box_of_another_model_are_not_the_same_element) {
  auto a = cubes("a", {{{0, 0, 0}, {1, 1, 1}}});
  a.setParentOf(0, {0, 0, 0}, {1, 1, 1}, {0, 0, 1}, 0);
  auto b = a;
  const DiscreteIntersection component;
  EXPECT_TRUE(component.testIntersection(Cube(a, 0), Cube(b, 0), Current(0)));
  EXPECT_FALSE(component.testIntersection(Cube(a, 0), Cube(a, 0), Current(0)));
}

TEST(DiscreteIntersection, its_own_distances_are_0_and_setting_them_has_no_effect) {
  DiscreteIntersection component;
  EXPECT_FALSE(component.useProximity());
  component.setAlarmDistance(3);
  component.setContactDistance(2);
  EXPECT_EQ(component.getAlarmDistance(), 0);
  EXPECT_EQ(component.getContactDistance(), 0);
  component.setAlarmDistance(kNaN);
  EXPECT_EQ(component.getAlarmDistance(), 0);
}

TEST(DiscreteIntersection, takes_the_distances_from_the_current_intersection_not_from_itself) {
  const auto a = spheres("a", {kFirst});
  const auto b = spheres("b", {kSecond});
  const auto c = cubes("c", {{{0, 0, 0}, {1, 1, 1}}, {{3, 0, 0}, {4, 1, 1}}});
  const ProximityIntersection far({.alarm = 10, .contact = 7});
  const DiscreteIntersection none;
  EXPECT_FALSE(far.testIntersection(Sphere(a, 0), Sphere(b, 0), none));
  EXPECT_TRUE(none.testIntersection(Sphere(a, 0), Sphere(b, 0), far));
  EXPECT_FALSE(far.testIntersection(Cube(c, 0), Cube(c, 1), none));
  EXPECT_TRUE(none.testIntersection(Cube(c, 0), Cube(c, 1), far));
  OutputVector contacts;
  EXPECT_EQ(far.computeIntersection(Sphere(a, 0), Sphere(b, 0), contacts, none), 0);
  EXPECT_EQ(none.computeIntersection(Sphere(a, 0), Sphere(b, 0), contacts, far), 1);
  EXPECT_EQ(contacts.at(0).value, -5);  // 5 - 3 - 7
}

/// Finds the intersector, and says whether it swaps.
struct Found {
  const ElementIntersector* intersector;
  bool swap;
};
Found find(const Intersection& intersection, const CollisionModel& a, const CollisionModel& b, bool before = false) {
  Found found{nullptr, before};
  found.intersector = intersection.findIntersector(a, b, found.swap);
  return found;
}

struct OneOfEach {
  CubeCollisionModel cube = cubes("c", {{{0, 0, 0}, {1, 1, 1}}});
  SphereCollisionModel sphere = spheres("s", {kFirst});
  RigidSphereModel rigid = rigid_spheres("r", {kSecond});
};

TEST(DiscreteIntersection, finds_intersectors_for_the_four_built_in_pairs) {
  const OneOfEach scene;
  const DiscreteIntersection component;
  const auto name = [&](const CollisionModel& a, const CollisionModel& b) {
    const Found found = find(component, a, b, true);
    return (found.swap ? "swapped " : "") + (found.intersector ? found.intersector->name() : "none");
  };
  EXPECT_EQ(name(scene.cube, scene.cube), "DiscreteIntersection<CubeCollisionModel,CubeCollisionModel>");
  EXPECT_EQ(name(scene.sphere, scene.sphere), "DiscreteIntersection<SphereCollisionModel,SphereCollisionModel>");
  EXPECT_EQ(name(scene.rigid, scene.rigid), "DiscreteIntersection<RigidSphereModel,RigidSphereModel>");
  EXPECT_EQ(name(scene.sphere, scene.rigid), "DiscreteIntersection<SphereCollisionModel,RigidSphereModel>");
}

TEST(DiscreteIntersection, serves_a_rigid_sphere_and_a_sphere_swapped) {
  const OneOfEach scene;
  const DiscreteIntersection component;
  const Found found = find(component, scene.rigid, scene.sphere);
  ASSERT_NE(found.intersector, nullptr);
  EXPECT_TRUE(found.swap);
  EXPECT_EQ(found.intersector->name(), "DiscreteIntersection<SphereCollisionModel,RigidSphereModel>");
}

TEST(DiscreteIntersection, finds_none_for_a_cube_and_a_sphere_and_leaves_nothing_to_swap) {
  const OneOfEach scene;
  DiscreteIntersection component;
  std::vector<std::string> messages;
  component.intersectors.setSink([&](const std::string& message) { messages.push_back(message); });
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(find(component, scene.cube, scene.sphere, true).intersector, nullptr);
    EXPECT_FALSE(find(component, scene.cube, scene.sphere, true).swap);
  }
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_EQ(messages[0].find("contact: no intersector for CubeCollisionModel-SphereCollisionModel; there are "
                             "DiscreteIntersection<CubeCollisionModel,CubeCollisionModel>"),
            0U)
      << messages[0];
}

TEST(DiscreteIntersection, is_supported_says_whether_there_is_an_intersector) {
  const OneOfEach scene;
  DiscreteIntersection component;
  component.intersectors.setSink({});
  EXPECT_TRUE(component.isSupported({scene.sphere, 0}, {scene.rigid, 0}));
  EXPECT_TRUE(component.isSupported({scene.rigid, 0}, {scene.sphere, 0}));
  EXPECT_TRUE(component.isSupported({scene.cube, 0}, {scene.cube, 0}));
  EXPECT_FALSE(component.isSupported({scene.cube, 0}, {scene.rigid, 0}));
  component.intersectors.ignore<CubeCollisionModel, CubeCollisionModel>();
  EXPECT_FALSE(component.isSupported({scene.cube, 0}, {scene.cube, 0}));
}

TEST(DiscreteIntersection, what_it_finds_tests_and_computes_as_the_methods_do) {
  const OneOfEach scene;
  const DiscreteIntersection component;
  const ElementIntersector* intersector = find(component, scene.sphere, scene.rigid).intersector;
  ASSERT_NE(intersector, nullptr);
  EXPECT_TRUE(intersector->canIntersect({scene.sphere, 0}, {scene.rigid, 0}, Current(2)));
  EXPECT_FALSE(intersector->canIntersect({scene.sphere, 0}, {scene.rigid, 0}, Current(1)));
  OutputVector contacts;
  EXPECT_EQ(intersector->beginIntersect(scene.sphere, scene.rigid, contacts), 0);
  EXPECT_EQ(intersector->intersect({scene.sphere, 0}, {scene.rigid, 0}, contacts, Current(2, 0.5)), 1);
  EXPECT_EQ(intersector->endIntersect(scene.sphere, scene.rigid, contacts), 0);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(text(contacts[0]), expected({scene.sphere, 0}, {scene.rigid, 0}, {0.6, 0.8, 0}, {1.8, 2.4, 0}));
}

/// Turns every virtual method round: what a test allows is refused, and every contact is number 1 to 4.
class Contrary : public DiscreteIntersection {
 public:
  using DiscreteIntersection::computeIntersection;
  using DiscreteIntersection::testIntersection;
  bool testIntersection(const Cube& a, const Cube& b, const Intersection& current) const override {
    return !DiscreteIntersection::testIntersection(a, b, current);
  }
  bool testIntersection(const Sphere& a, const Sphere& b, const Intersection& current) const override {
    return !DiscreteIntersection::testIntersection(a, b, current);
  }
  bool testIntersection(const RigidSphere& a, const RigidSphere& b, const Intersection& current) const override {
    return !DiscreteIntersection::testIntersection(a, b, current);
  }
  bool testIntersection(const Sphere& a, const RigidSphere& b, const Intersection& current) const override {
    return !DiscreteIntersection::testIntersection(a, b, current);
  }
  int computeIntersection(const Cube& a, const Cube& b, OutputVector& contacts, const Intersection&) const override {
    return number(a, b, 1, contacts);
  }
  int computeIntersection(const Sphere& a, const Sphere& b, OutputVector& contacts,
                          const Intersection&) const override {
    return number(a, b, 2, contacts);
  }
  int computeIntersection(const RigidSphere& a, const RigidSphere& b, OutputVector& contacts,
                          const Intersection&) const override {
    return number(a, b, 3, contacts);
  }
  int computeIntersection(const Sphere& a, const RigidSphere& b, OutputVector& contacts,
                          const Intersection&) const override {
    return number(a, b, 4, contacts);
  }

 private:
  static int number(const CollisionElement& a, const CollisionElement& b, int id, OutputVector& contacts) {
    contacts.push_back(component::numbered_contact(a, b, id));
    return 1;
  }
};

TEST(DiscreteIntersection, a_derived_class_overrides_each_method_also_for_what_comes_through_the_map) {
  const OneOfEach scene;
  const Contrary contrary;
  const DiscreteIntersection plain;
  const auto expect = [&](const CollisionModel& a, const CollisionModel& b, int id) {
    const ElementIntersector* intersector = find(contrary, a, b).intersector;
    ASSERT_NE(intersector, nullptr);
    EXPECT_NE(intersector->canIntersect({a, 0}, {b, 0}, Current(2)),
              find(plain, a, b).intersector->canIntersect({a, 0}, {b, 0}, Current(2)));
    OutputVector contacts;
    EXPECT_EQ(intersector->intersect({a, 0}, {b, 0}, contacts, Current(2)), 1);
    EXPECT_EQ(contacts.at(0).id, id);
  };
  expect(scene.cube, scene.cube, 1);
  expect(scene.sphere, scene.sphere, 2);
  expect(scene.rigid, scene.rigid, 3);
  expect(scene.sphere, scene.rigid, 4);
}

/// Particles: spheres of a kind of their own.
class Grains : public ModelOf<Grains, SphereCollisionModel> {
 public:
  static constexpr std::string_view kName = "Grains";
  using ModelOf::ModelOf;
  using Element = SphereOf<Grains>;
};

/// Adds a pair kind with the protected functions for spheres of any class.
class WithGrains : public DiscreteIntersection {
 public:
  static constexpr std::string_view kName = "WithGrains";
  using DiscreteIntersection::computeIntersection;
  using DiscreteIntersection::testIntersection;
  explicit WithGrains(PointConvention points) : DiscreteIntersection(points) {
    intersectors.add<RigidSphereModel, Grains>(*this);
  }
  bool testIntersection(const RigidSphere& a, const Grains::Element& b, const Intersection& current) const {
    return testIntersectionSphere(a, b, current.getAlarmDistance());
  }
  int computeIntersection(const RigidSphere& a, const Grains::Element& b, OutputVector& contacts,
                          const Intersection& current) const {
    return computeIntersectionSphere(a, b, contacts, current.getAlarmDistance(), current.getContactDistance());
  }
};

TEST(DiscreteIntersection, its_protected_functions_serve_a_derived_component_for_spheres_of_other_classes) {
  const auto rigid = rigid_spheres("r", {kFirst});
  const Grains grains("g", component::centers_of({kSecond}), component::radii_of({kSecond}));
  const WithGrains component(PointConvention::center);
  const Grains::Element grain(grains, 0);
  EXPECT_TRUE(component.testIntersection(RigidSphere(rigid, 0), grain, Current(2)));
  EXPECT_FALSE(component.testIntersection(RigidSphere(rigid, 0), grain, Current(std::nextafter(2, 0))));
  OutputVector contacts;
  EXPECT_EQ(component.computeIntersection(RigidSphere(rigid, 0), grain, contacts, Current(2, 0.5)), 1);
  // by upstream's points: a rigid sphere's surface, a deformable one's centre
  EXPECT_EQ(text(contacts.at(0)), expected({rigid, 0}, {grains, 0}, {0.6, 0.8, 0}, {3, 4, 0}));
  EXPECT_EQ(component.computeIntersection(RigidSphere(rigid, 0), grain, contacts, Current(1)), 0);
  ASSERT_NE(find(component, rigid, grains).intersector, nullptr);
  EXPECT_EQ(find(component, rigid, grains).intersector->name(), "WithGrains<RigidSphereModel,Grains>");
}

TEST(DiscreteIntersection, serves_a_derived_sphere_model_by_its_bases_intersector) {
  const auto rigid = rigid_spheres("r", {kFirst});
  const Grains grains("g", component::centers_of({kSecond}), component::radii_of({kSecond}));
  const DiscreteIntersection component;
  const Found found = find(component, rigid, grains);
  ASSERT_NE(found.intersector, nullptr);
  EXPECT_TRUE(found.swap);
  EXPECT_TRUE(found.intersector->canIntersect({grains, 0}, {rigid, 0}, Current(2)));
}

TEST(DiscreteIntersection, takes_new_intersectors_at_run_time) {
  const OneOfEach scene;
  const Press mine(9);  // a cube against a sphere: what the built-in component does not know
  DiscreteIntersection component;
  component.intersectors.setSink({});
  EXPECT_EQ(find(component, scene.cube, scene.sphere).intersector, nullptr);
  component.intersectors.add<CubeCollisionModel, SphereCollisionModel>(mine);
  ASSERT_NE(find(component, scene.cube, scene.sphere).intersector, nullptr);
  EXPECT_FALSE(find(component, scene.cube, scene.sphere).swap);
  EXPECT_TRUE(find(component, scene.sphere, scene.cube).swap);
  OutputVector contacts;
  find(component, scene.cube, scene.sphere)
      .intersector->intersect({scene.cube, 0}, {scene.sphere, 0}, contacts, component);
  EXPECT_EQ(contacts.at(0).id, 9);
}

TEST(BaseIntersector, writes_nothing_before_and_after) {
  const OneOfEach scene;
  const DiscreteIntersection component;
  OutputVector contacts;
  EXPECT_EQ(component.beginIntersection(scene.sphere, scene.rigid, contacts), 0);
  EXPECT_EQ(component.endIntersection(scene.sphere, scene.rigid, contacts), 0);
  EXPECT_TRUE(contacts.empty());
}

TEST(ProximityIntersection, has_distances_of_its_own) {
  ProximityIntersection component({.alarm = 2, .contact = 0.5}, PointConvention::published);
  EXPECT_TRUE(component.useProximity());
  EXPECT_EQ(component.getAlarmDistance(), 2);
  EXPECT_EQ(component.getContactDistance(), 0.5);
  EXPECT_EQ(component.points(), PointConvention::published);
  component.setAlarmDistance(3);
  component.setContactDistance(1);
  EXPECT_EQ(component.getAlarmDistance(), 3);
  EXPECT_EQ(component.getContactDistance(), 1);
  component.setAlarmDistance(0);
  component.setContactDistance(0);
  EXPECT_EQ(component.getAlarmDistance(), 0);
  EXPECT_EQ(component.getContactDistance(), 0);
}

TEST(ProximityIntersection, tests_by_its_own_alarm_distance_where_it_is_the_current_one) {
  const auto a = spheres("a", {kFirst});
  const auto b = spheres("b", {kSecond});
  ProximityIntersection component({.alarm = 2, .contact = 0});
  EXPECT_TRUE(component.testIntersection(Sphere(a, 0), Sphere(b, 0), component));
  component.setAlarmDistance(1.5);
  EXPECT_FALSE(component.testIntersection(Sphere(a, 0), Sphere(b, 0), component));
}

TEST(ProximityIntersection, refuses_distances_that_are_negative_or_not_finite_and_changes_nothing) {
  const auto refused = [](auto&& call) { return what_of<std::invalid_argument>(call); };
  EXPECT_EQ(refused([] { const ProximityIntersection p({-1, 0}); }), "alarm = -1: must not be negative");
  EXPECT_EQ(refused([] { const ProximityIntersection p({0, -0.5}); }), "contact = -0.5: must not be negative");
  EXPECT_EQ(refused([] { const ProximityIntersection p({kNaN, 0}); }), "alarm = nan: must be finite");
  EXPECT_EQ(refused([] { const ProximityIntersection p({0, kInfinity}); }), "contact = inf: must be finite");
  ProximityIntersection component({.alarm = 2, .contact = 0.5});
  EXPECT_EQ(refused([&] { component.setAlarmDistance(-3); }), "alarm = -3: must not be negative");
  EXPECT_EQ(refused([&] { component.setAlarmDistance(kInfinity); }), "alarm = inf: must be finite");
  EXPECT_EQ(refused([&] { component.setContactDistance(-kInfinity); }), "contact = -inf: must be finite");
  EXPECT_EQ(refused([&] { component.setContactDistance(kNaN); }), "contact = nan: must be finite");
  EXPECT_EQ(component.getAlarmDistance(), 2);
  EXPECT_EQ(component.getContactDistance(), 0.5);
}

}  // namespace
}  // namespace contact
