// What collision detection writes: its numbering, and the same contact seen from the other model.
#include "contact/detection_output.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "component/models_for_tests.hpp"
#include "environment/floating_point_environments.hpp"

namespace contact {
namespace {

using component::spheres;
using component::text;

SphereCollisionModel of_size(std::string name, std::size_t size) {
  return spheres(std::move(name), std::vector<Ball>(size, Ball{{0, 0, 0}, 1}));
}

TEST(ContactId, is_the_index_in_the_larger_model) {
  const auto small = of_size("small", 3);
  const auto large = of_size("large", 7);
  EXPECT_EQ(contact_id({large, 6}, {small, 2}), 6);
  EXPECT_EQ(contact_id({small, 2}, {large, 6}), 6);
}

TEST(ContactId, is_the_index_in_the_second_of_two_models_of_one_size) {
  const auto a = of_size("a", 5);
  const auto b = of_size("b", 5);
  EXPECT_EQ(contact_id({a, 1}, {b, 4}), 4);
  EXPECT_EQ(contact_id({b, 4}, {a, 1}), 1);
  EXPECT_EQ(contact_id({a, 1}, {a, 3}), 3);
}

TEST(ContactId, of_one_element_of_the_larger_model_is_the_same_for_all_it_meets) {
  const auto small = of_size("small", 3);
  const auto large = of_size("large", 7);
  EXPECT_EQ(contact_id({small, 0}, {large, 6}), contact_id({small, 2}, {large, 6}));
}

DetectionOutput output(const CollisionElement& first, const CollisionElement& second, ContactId id) {
  return {.elem = {first, second},
          .id = id,
          .point = {Vector3(1, 2, 3), Vector3(4, 5, 6)},
          .normal = {0.6, 0, -0.8},
          .value = -0.25,
          .deltaT = 0.125};
}

TEST(Mirrored, exchanges_elements_and_points_turns_the_normal_and_keeps_the_rest) {
  const auto small = of_size("small", 3);
  const auto large = of_size("large", 7);
  EXPECT_EQ(text(mirrored(output({small, 1}, {large, 6}, 6))),
            text(DetectionOutput{.elem = {{large, 6}, {small, 1}},
                                 .id = 6,
                                 .point = {Vector3(4, 5, 6), Vector3(1, 2, 3)},
                                 .normal = {-0.6, 0, 0.8},
                                 .value = -0.25,
                                 .deltaT = 0.125}));
}

TEST(Mirrored, leaves_every_zero_of_the_normal_positive) {
  const auto model = of_size("m", 2);
  DetectionOutput contact = output({model, 0}, {model, 1}, 1);
  contact.normal = {0.0, -0.0, 1};
  EXPECT_EQ(text(mirrored(contact).normal), text(Vector3(0.0, 0.0, -1)));
}

TEST(Mirrored, turns_a_normal_whose_least_number_is_subnormal_in_every_environment) {
  const auto model = of_size("m", 2);
  DetectionOutput contact = output({model, 0}, {model, 1}, 1);
  contact.normal = {1, 0x1p-1074, 0};
  for (const FloatingPointEnvironment& environment : floating_point_environments()) {
    Vector3 turned(0, 0, 0);
    in_environment(environment, [&] { turned = mirrored(contact).normal; });
    EXPECT_EQ(text(turned), text(Vector3(-1, -0x1p-1074, 0))) << environment.name;
  }
}

TEST(Mirrored, numbers_the_contact_of_models_of_one_size_by_the_new_second) {
  const auto a = of_size("a", 5);
  const auto b = of_size("b", 5);
  EXPECT_EQ(mirrored(output({a, 1}, {b, 4}, contact_id({a, 1}, {b, 4}))).id, 1);
  EXPECT_EQ(mirrored(output({b, 4}, {a, 1}, contact_id({b, 4}, {a, 1}))).id, 4);
}

TEST(Mirrored, keeps_the_number_that_an_intersector_gave_itself) {
  const auto a = of_size("a", 5);
  const auto b = of_size("b", 5);
  EXPECT_EQ(mirrored(output({a, 1}, {b, 4}, 1000)).id, 1000);
  EXPECT_EQ(mirrored(output({a, 1}, {b, 4}, -7)).id, -7);
  EXPECT_EQ(mirrored(output({a, 1}, {b, 4}, 1)).id, 1) << "a number that happens to be the first element's";
  EXPECT_EQ(mirrored(output({a, 1}, {b, 4}, 4)).id, 4) << "a number that happens to be contact_id's";
  for (const std::int64_t own : {0, 1}) EXPECT_EQ(mirrored(output({a, 0}, {b, 1}, own)).id, own);
}

TEST(Mirrored, twice_is_the_contact_itself) {
  const auto small = of_size("small", 3);
  const auto large = of_size("large", 7);
  const auto other = of_size("other", 7);
  for (const auto& contact :
       {output({small, 1}, {large, 6}, contact_id({small, 1}, {large, 6})),
        output({large, 6}, {small, 1}, contact_id({large, 6}, {small, 1})),
        output({large, 2}, {other, 5}, contact_id({large, 2}, {other, 5})), output({large, 2}, {large, 5}, 5),
        output({large, 2}, {other, 5}, 1000), output({small, 1}, {large, 6}, 1)})
    EXPECT_EQ(text(mirrored(mirrored(contact))), text(contact));
}

}  // namespace
}  // namespace contact
