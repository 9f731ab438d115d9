// Models by the name of their type: what is made, and every refusal word for word.
#include "contact/model_factory.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "component/models_for_tests.hpp"
#include "contact/capsule_model.hpp"
#include "contact/cube_model.hpp"
#include "contact/ray_model.hpp"
#include "contact/sphere_model.hpp"
#include "contact/triangle_model.hpp"

namespace contact {
namespace {

using component::refusal;

Eigen::MatrixXd rows(Index count, Index width, double value = 0) {
  return Eigen::MatrixXd::Constant(count, width, value);
}

/// A model with no data at all.
class Everything : public ModelOf<Everything> {
 public:
  static constexpr std::string_view kName = "Everything";
  explicit Everything(std::string name) : ModelOf(std::move(name)) {}
  [[nodiscard]] Index getSize() const override { return 1; }
  [[nodiscard]] Box bounding_box(Index) const override { return {Vector3::Zero(), Vector3::Zero()}; }
};

ModelMaker maker_of_everything(std::vector<ModelColumn> columns = {}) {
  return {"Everything", std::move(columns),
          [](std::string name, const ModelColumns&) { return std::make_unique<Everything>(std::move(name)); }};
}

TEST(ModelFactory, knows_the_eight_built_in_types_and_their_columns) {
  std::vector<std::string> known;
  for (const ModelMaker& maker : ModelFactory().makers()) {
    known.push_back(maker.type);
    for (const ModelColumn& column : maker.columns) known.back() += " " + column.name + std::to_string(column.width);
  }
  EXPECT_EQ(known, (std::vector<std::string>{
                       "SphereCollisionModel centers3 radii1", "RigidSphereModel positions3 orientations4 radii1",
                       "CubeCollisionModel min3 max3", "CapsuleCollisionModel starts3 ends3 radii1",
                       "TriangleCollisionModel p13 p23 p33", "RayCollisionModel origins3 directions3 lengths1",
                       "PlaneCollisionModel normals3 offsets1", "LineCollisionModel p13 p23"}));
}

TEST(ModelFactory, makes_spheres) {
  Eigen::MatrixXd centers(2, 3);
  centers << 1, 2, 3, 4, 5, 6;
  const auto model =
      ModelFactory().make("SphereCollisionModel", "s", {{"centers", centers}, {"radii", Eigen::Vector2d(7, 8)}});
  EXPECT_EQ(model->getName(), "s");
  const auto& spheres = dynamic_cast<const SphereCollisionModel&>(*model);
  EXPECT_EQ(Sphere(spheres, 1).center(), Vector3(4, 5, 6));
  EXPECT_EQ(Sphere(spheres, 1).r(), 8);
}

TEST(ModelFactory, makes_rigid_spheres) {
  Eigen::MatrixXd orientations(1, 4);
  orientations << 0, 0.6, 0, 0.8;
  const auto model =
      ModelFactory().make("RigidSphereModel", "r",
                          {{"positions", rows(1, 3, 2)}, {"orientations", orientations}, {"radii", rows(1, 1, 5)}});
  const auto& spheres = dynamic_cast<const RigidSphereModel&>(*model);
  EXPECT_EQ(RigidSphere(spheres, 0).center(), Vector3(2, 2, 2));
  EXPECT_EQ(RigidSphere(spheres, 0).r(), 5);
  EXPECT_EQ(RigidSphere(spheres, 0).rigidCenter().orientation.y(), 0.6);
}

TEST(ModelFactory, makes_cubes) {
  const auto model = ModelFactory().make("CubeCollisionModel", "c", {{"min", rows(3, 3, -1)}, {"max", rows(3, 3, 2)}});
  const auto& cubes = dynamic_cast<const CubeCollisionModel&>(*model);
  EXPECT_EQ(cubes.getSize(), 3);
  EXPECT_EQ(Cube(cubes, 2).minVect(), Vector3(-1, -1, -1));
  EXPECT_EQ(Cube(cubes, 2).maxVect(), Vector3(2, 2, 2));
}

TEST(ModelFactory, makes_capsules) {
  const auto model = ModelFactory().make(
      "CapsuleCollisionModel", "c", {{"starts", rows(2, 3, -1)}, {"ends", rows(2, 3, 2)}, {"radii", rows(2, 1, 5)}});
  const auto& capsules = dynamic_cast<const CapsuleCollisionModel&>(*model);
  EXPECT_EQ(CapsuleElement(capsules, 1).point1(), Vector3(-1, -1, -1));
  EXPECT_EQ(CapsuleElement(capsules, 1).point2(), Vector3(2, 2, 2));
  EXPECT_EQ(CapsuleElement(capsules, 1).radius(), 5);
}

TEST(ModelFactory, makes_triangles_and_rays) {
  const auto triangles = ModelFactory().make("TriangleCollisionModel", "t",
                                             {{"p1", rows(2, 3, -1)}, {"p2", rows(2, 3, 2)}, {"p3", rows(2, 3, 5)}});
  const TriangleElement triangle(dynamic_cast<const TriangleCollisionModel&>(*triangles), 1);
  EXPECT_EQ(triangle.p1(), Vector3(-1, -1, -1));
  EXPECT_EQ(triangle.p2(), Vector3(2, 2, 2));
  EXPECT_EQ(triangle.p3(), Vector3(5, 5, 5));
  const auto rays =
      ModelFactory().make("RayCollisionModel", "r",
                          {{"origins", rows(2, 3, -1)}, {"directions", rows(2, 3, 2)}, {"lengths", rows(2, 1, 5)}});
  const RayElement ray(dynamic_cast<const RayCollisionModel&>(*rays), 1);
  EXPECT_EQ(ray.origin(), Vector3(-1, -1, -1));
  EXPECT_EQ(ray.direction(), Vector3(2, 2, 2));
  EXPECT_EQ(ray.l(), 5);
}

TEST(ModelFactory, makes_lines_and_planes) {
  const auto lines = ModelFactory().make("LineCollisionModel", "l", {{"p1", rows(2, 3, -1)}, {"p2", rows(2, 3, 4)}});
  const LineElement line(dynamic_cast<const LineCollisionModel&>(*lines), 1);
  EXPECT_EQ(line.p1(), Vector3(-1, -1, -1));
  EXPECT_EQ(line.p2(), Vector3(4, 4, 4));
  const auto planes =
      ModelFactory().make("PlaneCollisionModel", "p", {{"normals", rows(2, 3, -1)}, {"offsets", rows(2, 1, 5)}});
  const PlaneElement plane(dynamic_cast<const PlaneCollisionModel&>(*planes), 1);
  EXPECT_EQ(plane.normal(), Vector3(-1, -1, -1));
  EXPECT_EQ(plane.offset(), 5);
}

TEST(ModelFactory, makes_models_without_elements) {
  const auto model = ModelFactory().make("SphereCollisionModel", "s", {{"centers", rows(0, 3)}, {"radii", rows(0, 1)}});
  EXPECT_EQ(model->getSize(), 0);
}

TEST(ModelFactory, refuses_a_type_that_it_does_not_know_and_says_which_there_are) {
  EXPECT_EQ(refusal([] { (void)ModelFactory().make("Sphere", "s", {}); }),
            "Sphere \"s\": unknown type of model; there are SphereCollisionModel RigidSphereModel CubeCollisionModel "
            "CapsuleCollisionModel TriangleCollisionModel RayCollisionModel PlaneCollisionModel LineCollisionModel");
}

TEST(ModelFactory, refuses_a_column_that_is_missing_unknown_too_wide_or_too_long) {
  const auto make = [](const ModelColumns& columns) {
    return refusal([&] { (void)ModelFactory().make("SphereCollisionModel", "s", columns); });
  };
  EXPECT_EQ(make({}), "SphereCollisionModel \"s\": column centers is missing");
  EXPECT_EQ(make({{"centers", rows(1, 3)}}), "SphereCollisionModel \"s\": column radii is missing");
  EXPECT_EQ(make({{"radii", rows(1, 1)}}), "SphereCollisionModel \"s\": column centers is missing");
  EXPECT_EQ(make({{"centers", rows(1, 3)}, {"radii", rows(1, 1)}, {"mass", rows(1, 1)}}),
            "SphereCollisionModel \"s\": unknown column mass");
  EXPECT_EQ(make({{"centers", rows(1, 2)}, {"radii", rows(1, 1)}}),
            "SphereCollisionModel \"s\": column centers has 2 numbers a row, not 3");
  EXPECT_EQ(make({{"centers", rows(1, 3)}, {"radii", rows(1, 0)}}),
            "SphereCollisionModel \"s\": column radii has 0 numbers a row, not 1");
  EXPECT_EQ(make({{"centers", rows(1, 3)}, {"radii", rows(2, 1)}}),
            "SphereCollisionModel \"s\": column radii has 2 rows, centers has 1");
}

TEST(ModelFactory, passes_on_what_the_model_itself_refuses) {
  EXPECT_EQ(
      refusal([] {
        (void)ModelFactory().make("SphereCollisionModel", "s", {{"centers", rows(1, 3)}, {"radii", rows(1, 1, -2)}});
      }),
      "SphereCollisionModel \"s\": radii[0] = -2: must not be negative");
  EXPECT_EQ(refusal([] {
              (void)ModelFactory().make("CubeCollisionModel", "c", {{"min", rows(1, 3, 1)}, {"max", rows(1, 3)}});
            }),
            "CubeCollisionModel \"c\": min[0][0] = 1: must not exceed max");
}

TEST(ModelFactory, makes_a_type_that_was_registered) {
  ModelFactory factory;
  EXPECT_TRUE(factory.registerModel(maker_of_everything({{"mass", 1}})));
  EXPECT_EQ(factory.make("Everything", "all", {{"mass", rows(1, 1)}})->getName(), "all");
  EXPECT_EQ(refusal([&] { (void)factory.make("Everything", "all", {}); }),
            "Everything \"all\": column mass is missing");
}

TEST(ModelFactory, makes_a_type_that_takes_no_columns) {
  ModelFactory factory;
  EXPECT_TRUE(factory.registerModel(maker_of_everything()));
  EXPECT_EQ(factory.make("Everything", "all", {})->getName(), "all");
  EXPECT_EQ(refusal([&] {
              (void)factory.make("Everything", "all", {{"mass", rows(1, 1)}});
            }),
            "Everything \"all\": unknown column mass");
}

TEST(ModelFactory, registers_a_type_once) {
  ModelFactory factory;
  EXPECT_TRUE(factory.registerModel(maker_of_everything()));
  EXPECT_FALSE(factory.registerModel(maker_of_everything({{"mass", 1}})));
  EXPECT_FALSE(factory.registerModel({"SphereCollisionModel", {}, {}}));
  EXPECT_EQ(factory.makers().size(), 9U);
  EXPECT_TRUE(factory.makers().back().columns.empty());
}

TEST(ModelFactory, has_one_instance_and_others_are_apart_from_it) {
  EXPECT_EQ(&ModelFactory::getInstance(), &ModelFactory::getInstance());
  ModelFactory factory;
  EXPECT_TRUE(factory.registerModel(maker_of_everything()));
  EXPECT_EQ(ModelFactory::getInstance().makers().size(), 8U);
}

TEST(ModelFactory, refuses_a_maker_that_is_nothing_or_makes_nothing) {
  ModelFactory factory;
  EXPECT_EQ(component::what_of<std::invalid_argument>([&] {
              factory.registerModel({"Nothing", {}, {}});
            }),
            "model type Nothing: there is nothing to make it with");
  EXPECT_TRUE(factory.registerModel({"Nothing", {}, [](std::string, const ModelColumns&) { return nullptr; }}));
  EXPECT_EQ(component::refusal([&] { (void)factory.make("Nothing", "n", {}); }),
            "Nothing \"n\": its maker made nothing");
}

}  // namespace
}  // namespace contact
