// Creators of intersectors: their order, their names, and who owns what they make.
#include "contact/intersector_factory.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "component/models_for_tests.hpp"
#include "component/registered_elsewhere_for_tests.hpp"
#include "contact/detect.hpp"
#include "contact/discrete_intersection.hpp"

namespace contact {
namespace {

using component::Press;
using component::spheres;
using component::StarIntersector;
using component::Stars;

/// For two deformable spheres: writes its number as the contact's id.
IntersectorFactory::Creator numbered(int number) {
  return [number](DiscreteIntersection& object) {
    auto made = std::make_shared<const Press>(number);
    object.intersectors.add<SphereCollisionModel, SphereCollisionModel>(*made);
    return made;
  };
}

/// The id of the one contact of two touching spheres.
DetectionOutput::ContactId who_serves(const Intersection& intersection) {
  const auto a = spheres("a", {{{0, 0, 0}, 1}});
  const auto b = spheres("b", {{{1, 0, 0}, 1}});
  const auto contacts = detect(intersection, a, b);
  return contacts->at(0).id;
}

TEST(IntersectorFactory, without_creators_leaves_the_built_in_intersectors_alone) {
  const IntersectorFactory none;
  const DiscreteIntersection component(PointConvention::nearest_surface, none);
  EXPECT_EQ(component.intersectors.names(),
            (std::vector<std::string>{"DiscreteIntersection<CubeCollisionModel,CubeCollisionModel>",
                                      "DiscreteIntersection<SphereCollisionModel,SphereCollisionModel>",
                                      "DiscreteIntersection<RigidSphereModel,RigidSphereModel>",
                                      "DiscreteIntersection<SphereCollisionModel,RigidSphereModel>"}));
  EXPECT_EQ(none.names(), std::vector<std::string>{});
}

TEST(IntersectorFactory, a_creators_intersector_replaces_the_built_in_one) {
  IntersectorFactory factory;
  EXPECT_TRUE(factory.registerCreator("seven", numbered(7)));
  EXPECT_EQ(who_serves(DiscreteIntersection(PointConvention::nearest_surface, factory)), 7);
}

TEST(IntersectorFactory, the_order_of_registration_decides) {
  for (const bool seven_first : {true, false}) {
    IntersectorFactory factory;
    if (seven_first) factory.registerCreator("seven", numbered(7));
    factory.registerCreator("eight", numbered(8));
    if (!seven_first) factory.registerCreator("seven", numbered(7));
    EXPECT_EQ(who_serves(DiscreteIntersection(PointConvention::nearest_surface, factory)), seven_first ? 8 : 7);
    EXPECT_EQ(factory.names(), seven_first ? (std::vector<std::string>{"seven", "eight"})
                                           : (std::vector<std::string>{"eight", "seven"}));
  }
}

TEST(IntersectorFactory, refuses_a_second_creator_of_a_name) {
  IntersectorFactory factory;
  EXPECT_TRUE(factory.registerCreator("mine", numbered(7)));
  EXPECT_FALSE(factory.registerCreator("mine", numbered(8)));
  EXPECT_EQ(factory.names(), std::vector<std::string>{"mine"});
  EXPECT_EQ(who_serves(DiscreteIntersection(PointConvention::nearest_surface, factory)), 7);
}

TEST(IntersectorFactory, a_component_has_the_creators_registered_before_it_was_made_and_no_later_ones) {
  IntersectorFactory factory;
  const DiscreteIntersection before(PointConvention::nearest_surface, factory);
  factory.registerCreator("seven", numbered(7));
  const DiscreteIntersection after(PointConvention::nearest_surface, factory);
  EXPECT_EQ(who_serves(before), 0);
  EXPECT_EQ(who_serves(after), 7);
}

/// Those that two source files registered while the program started, in no order; the library's own is one.
std::set<std::string> names_of_the_instance() {
  const std::vector<std::string> names = IntersectorFactory::getInstance().names();
  return {names.begin(), names.end()};
}

TEST(IntersectorFactory, its_instance_has_what_another_source_file_registered_while_the_program_started) {
  EXPECT_EQ(names_of_the_instance(), (std::set<std::string>{"Capsule", "Mesh", "Plane", "Ray", "StarIntersector"}));
  EXPECT_EQ(&IntersectorFactory::getInstance(), &IntersectorFactory::getInstance());
  const DiscreteIntersection component;
  const Stars stars("stars");
  const auto model = spheres("s", {{{0, 0, 0}, 1}});
  EXPECT_TRUE(component.isSupported({stars, 0}, {model, 0}));
  EXPECT_TRUE(component.isSupported({model, 0}, {stars, 0}));
  EXPECT_EQ(detect(component, stars, model)->size(), 1U);
}

TEST(IntersectorFactory, a_name_registered_with_the_instance_is_taken) {
  const IntersectorCreator<StarIntersector> again("StarIntersector");
  EXPECT_EQ(names_of_the_instance(), (std::set<std::string>{"Capsule", "Mesh", "Plane", "Ray", "StarIntersector"}));
}

TEST(IntersectorFactory, every_component_owns_intersectors_of_its_own) {
  // Upstream keeps one object a class in the factory, so that a second component destroys the first's.
  const int alive = StarIntersector::alive();
  const Stars stars("stars");
  const auto model = spheres("s", {{{0, 0, 0}, 1}});
  const DiscreteIntersection first(PointConvention::nearest_surface);
  EXPECT_EQ(StarIntersector::alive(), alive + 1);
  {
    const DiscreteIntersection second(PointConvention::published);
    EXPECT_EQ(StarIntersector::alive(), alive + 2);
    EXPECT_EQ(detect(second, stars, model)->at(0).id, static_cast<int>(PointConvention::published));
    EXPECT_EQ(detect(first, stars, model)->at(0).id, static_cast<int>(PointConvention::nearest_surface));
  }
  EXPECT_EQ(StarIntersector::alive(), alive + 1);
  EXPECT_EQ(detect(first, stars, model)->at(0).id, static_cast<int>(PointConvention::nearest_surface));
}

TEST(IntersectorFactory, what_a_creator_made_dies_with_its_component) {
  const int alive = StarIntersector::alive();
  std::optional<ProximityIntersection> component(std::in_place, Distances{1, 0});
  EXPECT_EQ(StarIntersector::alive(), alive + 1);
  component.reset();
  EXPECT_EQ(StarIntersector::alive(), alive);
}

TEST(IntersectorFactory, a_creator_that_throws_stops_the_component_and_what_was_made_dies) {
  IntersectorFactory factory;
  const int alive = StarIntersector::alive();
  factory.registerCreator("stars", creator_of<StarIntersector>());
  factory.registerCreator(
      "broken", [](DiscreteIntersection&) -> std::shared_ptr<const void> { throw std::runtime_error("no licence"); });
  EXPECT_EQ(component::what_of<std::runtime_error>(
                [&] { const DiscreteIntersection component(PointConvention::nearest_surface, factory); }),
            "no licence");
  EXPECT_EQ(StarIntersector::alive(), alive);
}

TEST(IntersectorFactory, a_creator_may_register_another_for_the_components_to_come) {
  IntersectorFactory factory;
  factory.registerCreator("first", [&](DiscreteIntersection& object) {
    factory.registerCreator("second", numbered(8));
    return numbered(7)(object);
  });
  EXPECT_EQ(who_serves(DiscreteIntersection(PointConvention::nearest_surface, factory)), 7);
  EXPECT_EQ(who_serves(DiscreteIntersection(PointConvention::nearest_surface, factory)), 8);
}

TEST(IntersectorFactory, refuses_a_creator_that_is_nothing) {
  IntersectorFactory factory;
  EXPECT_EQ(component::what_of<std::invalid_argument>([&] { factory.registerCreator("Nothing", {}); }),
            "creator Nothing: there is nothing to call");
  EXPECT_TRUE(factory.names().empty());
}

}  // namespace
}  // namespace contact
