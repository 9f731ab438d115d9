// The run-time types of models, and handles to their elements.
#include "contact/collision_model.hpp"

#include <gtest/gtest.h>

#include <type_traits>
#include <utility>

#include "component/models_for_tests.hpp"

namespace contact {
namespace {

using component::spheres;

class Droplets : public ModelOf<Droplets, SphereCollisionModel> {
 public:
  static constexpr std::string_view kName = "Droplets";
  using ModelOf::ModelOf;
};

class Mist : public ModelOf<Mist, Droplets> {
 public:
  static constexpr std::string_view kName = "Mist";
  using ModelOf::ModelOf;
};

class UndeclaredSpheres : public SphereCollisionModel {
 public:
  using SphereCollisionModel::SphereCollisionModel;
};

static_assert(DeclaredModel<CollisionModel>);
static_assert(DeclaredModel<SphereCollisionModel>);
static_assert(DeclaredModel<Mist>);
static_assert(!DeclaredModel<UndeclaredSpheres>, "it has not declared itself");
static_assert(!DeclaredModel<Sphere>, "a handle is no model");

template <class Model>
Model one_sphere() {
  return Model("one", component::centers_of({{{1, 2, 3}, 4}}), component::radii_of({{{1, 2, 3}, 4}}));
}

TEST(ModelType, is_one_object_a_class_with_its_name_and_its_base) {
  const ModelType& type = SphereCollisionModel::static_type();
  EXPECT_EQ(&type, &SphereCollisionModel::static_type());
  EXPECT_EQ(type.name, "SphereCollisionModel");
  EXPECT_EQ(type.id, ModelId(typeid(SphereCollisionModel), "contact::SphereCollisionModel"));
  EXPECT_EQ(type.base, &CollisionModel::static_type());
  EXPECT_EQ(CollisionModel::static_type().name, "CollisionModel");
  EXPECT_EQ(CollisionModel::static_type().base, nullptr);
  EXPECT_NE(type.id, RigidSphereModel::static_type().id);
  EXPECT_EQ(RigidSphereModel::static_type().name, "RigidSphereModel");
  EXPECT_EQ(CubeCollisionModel::static_type().name, "CubeCollisionModel");
}

TEST(ModelType, is_known_by_its_identity_where_it_declares_one_which_no_derived_class_inherits) {
  EXPECT_EQ(ModelId(typeid(int), "a"), ModelId(typeid(double), "a"));
  EXPECT_NE(ModelId(typeid(int), "a"), ModelId(typeid(int), "b"));
  EXPECT_NE(ModelId(typeid(int), "a"), ModelId(typeid(int), ""));
  EXPECT_NE(ModelId(typeid(int), ""), ModelId(typeid(double), ""));
  EXPECT_EQ(Droplets::static_type().id, ModelId(typeid(Droplets), ""));
  EXPECT_NE(Droplets::static_type().id, SphereCollisionModel::static_type().id);
}

TEST(ModelType, of_a_derived_model_names_its_whole_lineage) {
  EXPECT_EQ(Mist::static_type().base, &Droplets::static_type());
  EXPECT_EQ(Droplets::static_type().base, &SphereCollisionModel::static_type());
}

TEST(ModelType, of_a_model_is_that_of_its_class_seen_through_any_base) {
  const auto mist = one_sphere<Mist>();
  const CollisionModel& model = mist;
  EXPECT_EQ(&model.type(), &Mist::static_type());
}

TEST(ModelType, of_a_class_that_has_not_declared_itself_is_its_bases) {
  const auto model = one_sphere<UndeclaredSpheres>();
  EXPECT_EQ(&model.type(), &SphereCollisionModel::static_type());
}

TEST(CollisionModel, keeps_its_name_and_its_size) {
  EXPECT_EQ(spheres("marbles", {{{0, 0, 0}, 1}, {{1, 0, 0}, 1}}).getSize(), 2);
  EXPECT_EQ(spheres("marbles", {}).getSize(), 0);
  EXPECT_EQ(spheres("marbles", {}).getName(), "marbles");
  EXPECT_EQ(spheres("", {}).getName(), "");
}

TEST(CollisionElement, is_equal_to_another_of_the_same_model_and_index_only) {
  const auto a = spheres("same", {{{0, 0, 0}, 1}, {{0, 0, 0}, 1}});
  const auto b = spheres("same", {{{0, 0, 0}, 1}, {{0, 0, 0}, 1}});
  EXPECT_EQ(CollisionElement(a, 1), CollisionElement(a, 1));
  EXPECT_NE(CollisionElement(a, 0), CollisionElement(a, 1));
  EXPECT_NE(CollisionElement(a, 0), CollisionElement(b, 0));
  EXPECT_EQ(Sphere(a, 1), CollisionElement(a, 1));
}

TEST(CollisionElement, names_its_model_and_index) {
  const auto model = spheres("s", {{{0, 0, 0}, 1}, {{5, 6, 7}, 2}});
  const CollisionElement element(model, 1);
  EXPECT_EQ(&element.getCollisionModel(), &model);
  EXPECT_EQ(element.getIndex(), 1);
}

TEST(CollisionElement, becomes_a_handle_that_knows_its_models_class) {
  const auto model = spheres("s", {{{0, 0, 0}, 1}, {{5, 6, 7}, 2}});
  const Sphere sphere(CollisionElement(model, 1));
  static_assert(std::is_same_v<decltype(sphere.getCollisionModel()), const SphereCollisionModel&>);
  EXPECT_EQ(&sphere.getCollisionModel(), &model);
  EXPECT_EQ(sphere.getIndex(), 1);
  EXPECT_EQ(sphere.center(), Vector3(5, 6, 7));
}

TEST(CollisionElement, is_two_words_and_copied_as_bytes) {
  static_assert(sizeof(Sphere) == sizeof(CollisionElement) && sizeof(Cube) == sizeof(CollisionElement));
  static_assert(std::is_trivially_copyable_v<Sphere> && std::is_trivially_copyable_v<Cube>);
  EXPECT_LE(sizeof(CollisionElement), 2 * sizeof(Index));
}

}  // namespace
}  // namespace contact
