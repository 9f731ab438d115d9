// Plug-ins as a program uses them: loaded at run time, models made by name, contacts through detect.
#include "contact/plugin.hpp"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <random>

#include "component/models_for_tests.hpp"
#include "contact/detect.hpp"
#include "contact/discrete_intersection.hpp"
#include "droplets.hpp"
#include "environment/floating_point_environments.hpp"

namespace contact {
namespace {

using component::text;

/// Both plug-ins, and a DiscreteIntersection made before they were loaded: whichever test comes first.
struct Loaded {
  ProximityIntersection before{{.alarm = 1, .contact = 0}};

  Loaded() {
    load_plugin(CAPSULE);
    load_plugin(CUBE_CONTACT);
  }
};
const Loaded& loaded() {
  static const Loaded once;
  return once;
}

std::unique_ptr<CollisionModel> make(const std::string& type, const ModelColumns& columns) {
  return ModelFactory::getInstance().make(type, "of the test", columns);
}

/// The contacts of the same elements the other way round, in the order of those.
std::vector<std::string> mirrored_text(OutputVector outputs) {
  std::transform(outputs.begin(), outputs.end(), outputs.begin(), mirrored);
  std::sort(outputs.begin(), outputs.end(), [](const DetectionOutput& a, const DetectionOutput& b) {
    return std::pair(a.elem.first.getIndex(), a.elem.second.getIndex()) <
           std::pair(b.elem.first.getIndex(), b.elem.second.getIndex());
  });
  return text(outputs);
}

Eigen::MatrixXd random_columns(std::mt19937_64& random, Index rows, Index width, double least, double most) {
  std::uniform_real_distribution<double> number(least, most);
  return Eigen::MatrixXd::NullaryExpr(rows, width, [&] { return number(random); });
}

/// 60 capsules and 40 spheres of either kind, some on the axis of a capsule.
struct Scene {
  std::unique_ptr<CollisionModel> capsules;
  std::unique_ptr<CollisionModel> spheres;
  std::unique_ptr<CollisionModel> rigid;

  Scene() {
    std::mt19937_64 random(7);
    const Eigen::MatrixXd p = random_columns(random, 60, 3, -2, 2);
    const Eigen::MatrixXd q = p + random_columns(random, 60, 3, -2, 2);
    Eigen::MatrixXd centers = random_columns(random, 40, 3, -2, 2);
    centers.topRows(5) = p.topRows(5);
    const Eigen::MatrixXd radii = random_columns(random, 40, 1, 0, 0.5);
    Eigen::MatrixXd orientations = Eigen::MatrixXd::Zero(40, 4);
    orientations.col(3).setOnes();
    capsules = make("CapsuleModel", {{"p", p}, {"q", q}, {"radii", random_columns(random, 60, 1, 0, 0.5)}});
    spheres = make("SphereCollisionModel", {{"centers", centers}, {"radii", radii}});
    rigid = make("RigidSphereModel", {{"positions", centers}, {"orientations", orientations}, {"radii", radii}});
  }
};

TEST(Plugins, serve_a_discrete_intersection_made_after_they_were_loaded_and_none_before) {
  const DiscreteIntersection& before = loaded().before;
  const ProximityIntersection after({.alarm = 1, .contact = 0});
  const Scene scene;
  bool swap = false;
  const_cast<DiscreteIntersection&>(before).intersectors.setSink({});  // it would report the missing intersector
  EXPECT_EQ(before.findIntersector(*scene.capsules, *scene.spheres, swap), nullptr);
  EXPECT_FALSE(detect(before, *scene.capsules, *scene.spheres).has_value());
  EXPECT_NE(after.findIntersector(*scene.capsules, *scene.spheres, swap), nullptr);
  EXPECT_TRUE(detect(after, *scene.capsules, *scene.spheres).has_value());

  // [0,1]^3 and [2,3] x [0,1] x [0.5,1]: apart by 1 on x; the middles of [0,1] and [0.5,1] on y and z
  const auto a =
      make("CubeCollisionModel", {{"min", Eigen::RowVector3d(0, 0, 0)}, {"max", Eigen::RowVector3d(1, 1, 1)}});
  const auto b =
      make("CubeCollisionModel", {{"min", Eigen::RowVector3d(2, 0, 0.5)}, {"max", Eigen::RowVector3d(3, 1, 1)}});
  EXPECT_TRUE(detect(before, *a, *b)->empty());
  const OutputVector contacts = *detect(after, *a, *b);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts[0].normal, Vector3(1, 0, 0));
  EXPECT_EQ(contacts[0].point[0], Vector3(1, 0.5, 0.75));
  EXPECT_EQ(contacts[0].point[1], Vector3(2, 0.5, 0.75));
  EXPECT_EQ(contacts[0].value, 1);
}

TEST(Plugins, give_the_same_contacts_whichever_model_comes_first) {
  loaded();
  const Scene scene;
  for (const PointConvention points :
       {PointConvention::nearest_surface, PointConvention::center, PointConvention::published}) {
    const ProximityIntersection intersection({.alarm = 0.25, .contact = 0.125}, points);
    for (const CollisionModel* spheres : {scene.spheres.get(), scene.rigid.get()}) {
      const OutputVector forward = *detect(intersection, *scene.capsules, *spheres);
      const OutputVector backward = *detect(intersection, *spheres, *scene.capsules);
      EXPECT_GE(forward.size(), 30U);
      EXPECT_LE(forward.size(), 1200U);  // of 2400 pairs
      EXPECT_EQ(text(forward), mirrored_text(backward));
      EXPECT_EQ(text(backward), mirrored_text(forward));
      for (const DetectionOutput& output : backward) EXPECT_EQ(&output.elem.first.getCollisionModel(), spheres);
    }
  }
}

TEST(Plugins, give_deformable_and_rigid_spheres_the_same_contact_but_for_the_convention_center) {
  loaded();
  const Scene scene;
  const auto contacts = [&](PointConvention points, const CollisionModel& spheres) {
    return *detect(ProximityIntersection({.alarm = 0.25, .contact = 0}, points), *scene.capsules, spheres);
  };
  EXPECT_EQ(text(contacts(PointConvention::nearest_surface, *scene.spheres)),
            text(contacts(PointConvention::nearest_surface, *scene.rigid)));
  const OutputVector deformable = contacts(PointConvention::center, *scene.spheres);
  const OutputVector rigid = contacts(PointConvention::center, *scene.rigid);
  const OutputVector nearest = contacts(PointConvention::nearest_surface, *scene.rigid);
  ASSERT_EQ(deformable.size(), rigid.size());
  for (std::size_t i = 0; i < rigid.size(); ++i) {
    const Box point = scene.spheres->bounding_box(deformable[i].elem.second.getIndex());
    EXPECT_TRUE(((point.min + point.max) / 2).isApprox(deformable[i].point[1]));
    EXPECT_EQ(rigid[i].point[1], nearest[i].point[1]);
    EXPECT_EQ(rigid[i].point[0], deformable[i].point[0]);
  }
}

/// A plug-in's creators in a factory of the test's own, as load_plugin enters it.
void enter(const char* library, PluginHost& host) {
  void* handle = dlopen(library, RTLD_NOW | RTLD_LOCAL);
  ASSERT_NE(handle, nullptr) << dlerror();
  const auto* entry = static_cast<const PluginEntry*>(dlsym(handle, "contact_plugin_entry"));
  ASSERT_NE(entry, nullptr);
  entry->enter(host);
}

TEST(Plugins, do_not_depend_on_the_order_in_which_they_register) {
  loaded();
  const Scene scene;
  const auto contacts = [&](std::initializer_list<const char*> libraries) {
    IntersectorFactory factory;
    ModelFactory models;
    PluginHost host{factory, models};
    for (const char* library : libraries) enter(library, host);
    EXPECT_EQ(factory.names().size(), 2U);
    const ProximityIntersection intersection({.alarm = 0.25, .contact = 0}, PointConvention::nearest_surface, factory);
    std::vector<std::vector<std::string>> all;
    for (const CollisionModel* spheres : {scene.spheres.get(), scene.rigid.get()}) {
      all.push_back(text(*detect(intersection, *scene.capsules, *spheres)));
      all.push_back(text(*detect(intersection, *spheres, *scene.capsules)));
    }
    return all;
  };
  EXPECT_EQ(contacts({CAPSULE, CUBE_CONTACT}), contacts({CUBE_CONTACT, CAPSULE}));
}

TEST(Plugins, may_be_loaded_again_and_nothing_is_registered_twice) {
  loaded();
  const std::vector<std::string> names = IntersectorFactory::getInstance().names();
  const std::size_t makers = ModelFactory::getInstance().makers().size();
  load_plugin(CAPSULE);
  load_plugin(std::filesystem::relative(CAPSULE));
  EXPECT_EQ(IntersectorFactory::getInstance().names(), names);
  EXPECT_EQ(ModelFactory::getInstance().makers().size(), makers);
  EXPECT_EQ(std::count(names.begin(), names.end(), "SphereCapsuleIntersector"), 1);
  EXPECT_EQ(std::count(names.begin(), names.end(), "CubeContactIntersector"), 1);
}

TEST(Plugins, bring_models_whose_refusals_the_host_understands) {
  loaded();
  ModelColumns columns{
      {"p", Eigen::MatrixXd::Zero(2, 3)}, {"q", Eigen::MatrixXd::Zero(2, 3)}, {"radii", Eigen::MatrixXd::Ones(2, 1)}};
  const auto refusal = [&] {
    try {
      (void)make("CapsuleModel", columns);
    } catch (const InvalidModel& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(refusal(), "accepted");
  columns["radii"](1) = -0.5;
  EXPECT_EQ(refusal(), "CapsuleModel \"of the test\": radii[1] = -0.5: must not be negative");
  columns["q"](0, 2) = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refusal(), "CapsuleModel \"of the test\": q[0][2] = inf: must be finite");
  columns.erase("p");
  EXPECT_EQ(refusal(), "CapsuleModel \"of the test\": column p is missing");
}

/// What load_plugin says of a library that it refuses.
std::string refusal_of(const std::string& library) {
  try {
    load_plugin(library);
  } catch (const PluginError& error) {
    return error.what();
  }
  return "loaded";
}

TEST(Plugins, that_are_missing_or_broken_are_refused_with_the_file_and_the_reason) {
  EXPECT_EQ(refusal_of("/nowhere/missing.so"),
            "/nowhere/missing.so: cannot be loaded: cannot open shared object file: No such file or directory");
  const std::string no_library = testing::TempDir() + "contact_no_library.so";
  std::ofstream(no_library) << "This is no shared library, but it is long enough to be looked at.\n";
  EXPECT_EQ(refusal_of(no_library), no_library + ": cannot be loaded: invalid ELF header");
  std::filesystem::remove(no_library);
  EXPECT_EQ(refusal_of(testing::TempDir()).find(testing::TempDir() + ": cannot be loaded: "), 0U);
  EXPECT_EQ(refusal_of(NO_ENTRY), NO_ENTRY ": is no plug-in: it exports no contact_plugin_entry");
  EXPECT_EQ(refusal_of(WRONG_INTERFACE), WRONG_INTERFACE ": was built for plug-in interface 4, this is 3");
  EXPECT_EQ(refusal_of(""), ": names no file");
  EXPECT_EQ(refusal_of(std::string(CAPSULE) + '\0' + ".txt").find(CAPSULE), 0U)
      << "not taken for the file before the zero";
  EXPECT_EQ(refusal_of(NO_FUNCTION), NO_FUNCTION ": exports no function to register with");
}

TEST(Plugins, are_refused_by_name_from_a_folder_that_is_gone) {
  const std::filesystem::path before = std::filesystem::current_path();
  const std::filesystem::path gone = std::filesystem::path(testing::TempDir()) / "contact_gone";
  std::filesystem::create_directory(gone);
  std::filesystem::current_path(gone);
  std::filesystem::remove(gone);
  const std::string refusal = refusal_of("capsule.so");
  std::filesystem::current_path(before);
  EXPECT_EQ(refusal, "capsule.so: cannot be found: No such file or directory");
}

TEST(Plugins, that_fail_while_they_register_are_refused_and_stay_loaded) {
  // "HalfDone" remains registered, and its creator's code must still be there.
  for (int i = 0; i < 2; ++i)
    EXPECT_EQ(refusal_of(FAILS_TO_REGISTER), FAILS_TO_REGISTER ": failed to register: no licence found");
  const DiscreteIntersection intersection;
  const auto names = IntersectorFactory::getInstance().names();
  EXPECT_EQ(std::count(names.begin(), names.end(), "HalfDone"), 1);
  for (int i = 0; i < 2; ++i)
    EXPECT_EQ(refusal_of(THROWS_A_NUMBER), THROWS_A_NUMBER ": failed to register: what it threw is no std::exception");
  EXPECT_EQ(refusal_of(NOTHING_TO_CALL),
            NOTHING_TO_CALL ": failed to register: creator Nothing: there is nothing to call");
}

TEST(Plugins, give_the_same_contacts_in_every_floating_point_environment) {
  loaded();
  const Scene scene;
  const ProximityIntersection intersection({.alarm = 0.25, .contact = 0.125});
  const auto expected = text(*detect(intersection, *scene.capsules, *scene.spheres));
  for (const FloatingPointEnvironment& environment : floating_point_environments()) {
    std::optional<OutputVector> contacts;  // what a plug-in's arithmetic raises must not trap
    in_environment(environment, [&] { contacts = detect(intersection, *scene.capsules, *scene.spheres); });
    EXPECT_EQ(text(*contacts), expected) << environment.name;
  }
}

/// The value of the one contact between a drop of that type and a sphere; nothing where no intersector serves them.
std::optional<double> size_of_drop(const std::string& type) {
  DiscreteIntersection intersection;
  intersection.intersectors.setSink({});
  const auto drop = make(type, {});
  const SphereCollisionModel sphere("s", Eigen::RowVector3d(0, 0, 0), Eigen::VectorXd::Ones(1));
  const auto contacts = detect(intersection, *drop, sphere);
  if (!contacts) return std::nullopt;
  EXPECT_EQ(contacts->size(), 1U);
  return contacts->at(0).value;
}

TEST(Plugins, that_each_have_a_class_of_one_name_are_served_by_their_own_intersectors) {
  for (const char* plugin : {DROP_FIRST, DROP_SECOND, OPEN_DROP_FIRST, OPEN_DROP_SECOND}) load_plugin(plugin);
  EXPECT_EQ(size_of_drop("drop_first"), 1);
  EXPECT_EQ(size_of_drop("drop_second"), 2);
  EXPECT_EQ(size_of_drop("open_drop_first"), 1);
  EXPECT_EQ(size_of_drop("open_drop_second"), 2);
}

TEST(Plugins, serve_each_others_models_where_both_declare_the_same_identity) {
  for (const char* plugin : {DROP_FIRST, DROP_SECOND, DROP_MODELS}) load_plugin(plugin);
  EXPECT_EQ(size_of_drop("SharedDrop"), std::nullopt) << "nobody's, and not one of the others' by its name";
  load_plugin(DROP_INTERSECTOR);
  EXPECT_EQ(size_of_drop("SharedDrop"), 3);
}

TEST(Droplets, are_registered_by_their_translation_unit_and_are_spheres_to_all_others) {
  loaded();
  const Scene scene;
  const Eigen::MatrixXd centers = Eigen::Vector3d(0, 1, 3).asDiagonal();
  const example::Droplets drops("balls", centers, Eigen::Vector3d(1, 1, 1));
  const SphereCollisionModel spheres("balls", centers, Eigen::Vector3d(1, 1, 1));
  const ProximityIntersection intersection({.alarm = 0.25, .contact = 0});
  // centres (0,0,0), (0,1,0), (0,0,3), radii 1: the first two meet
  EXPECT_EQ(detect(intersection, spheres)->size(), 1U);
  EXPECT_TRUE(detect(intersection, drops)->empty());
  EXPECT_FALSE(detect(intersection, spheres, drops)->empty());
  EXPECT_EQ(text(*detect(intersection, *scene.capsules, drops)), text(*detect(intersection, *scene.capsules, spheres)));
  const CubeCollisionModel cubes("cubes", Eigen::RowVector3d(0, 0, 0), Eigen::RowVector3d(1, 1, 1));
  EXPECT_FALSE(detect(intersection, drops, cubes).has_value());  // ignored, and so without a message
}

}  // namespace
}  // namespace contact
