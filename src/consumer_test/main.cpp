// Somebody else's program: models, contacts and plug-ins across the library's border, built with flags that the library
// was not built with. consumer PLUGIN... loads the capsules' plug-in, built with these flags or others.
#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "contact/batch.hpp"
#include "contact/capsule_model.hpp"
#include "contact/cube_cube.hpp"
#include "contact/detect.hpp"
#include "contact/discrete_intersection.hpp"
#include "contact/exact_sum.hpp"
#include "contact/line_model.hpp"
#include "contact/plane_model.hpp"
#include "contact/plugin.hpp"
#include "contact/ray_model.hpp"
#include "contact/sphere_cube.hpp"
#include "contact/sphere_sphere.hpp"
#include "contact/triangle_model.hpp"

namespace {

using namespace contact;

int failures = 0;

void expect(bool right, const char* what) {
  if (right) return;
  ++failures;
  std::printf("WRONG: %s\n", what);
}

// This file may be told to ignore NaN, infinity and subnormal numbers: they are made and compared as bits.
const double kNaN = std::bit_cast<double>(std::uint64_t{0x7ff8} << 48);
const double kInfinity = std::bit_cast<double>(std::uint64_t{0x7ff0} << 48);
const double kLeast = std::bit_cast<double>(std::uint64_t{1});
const double kMinusLeast = std::bit_cast<double>(std::uint64_t{1} << 63 | 1);

bool same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

template <class Error>
bool refuses(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error&) {
    return true;
  }
  return false;
}

constexpr Index kCount = 101;  // an odd number of doubles, and many small allocations

Eigen::MatrixX3d centers() {
  Eigen::MatrixX3d all(kCount, 3);
  for (Index i = 0; i < kCount; ++i) all.row(i) << static_cast<double>(i), 0, 0;
  return all;
}
Eigen::VectorXd radii(double radius) { return Eigen::VectorXd::Constant(kCount, radius); }
Eigen::MatrixX4d upright() {
  Eigen::MatrixX4d all = Eigen::MatrixX4d::Zero(kCount, 4);
  all.col(3).setOnes();
  return all;
}

void the_readmes_example() {
  // delta (1,2,2), distance 3, so the value is 3 - 3 - 0.25
  const Ball a{{0, 0, 0}, 1.5};
  const Ball b{{1, 2, 2}, 1.5};
  const auto contact = compute_sphere_sphere(a, b, {.alarm = 0, .contact = 0.25});
  expect(contact && contact->value == -0.25, "the example of docs/library.md");
  // 4 of the least apart, of which 2 are the radii. Flushed, they would coincide.
  const auto tiny =
      compute_sphere_sphere({{0, 0, 0}, kLeast}, {{2 * 0x1p-1073, 0, 0}, kLeast}, {.alarm = 1, .contact = 0});
  expect(tiny && same(tiny->value, std::bit_cast<double>(std::uint64_t{2})), "subnormal numbers");
  expect(same(rounded_sum({1, 0x1p-53, kLeast}), std::bit_cast<double>(std::bit_cast<std::uint64_t>(1.0) + 1)),
         "a sum rounded once");
}

// Whatever these flags make of the decisions that are inline: what is touching or nearly so, and what is flushed.
void decisions_are_the_librarys() {
  std::uint64_t state = 1;
  const auto random = [&state] {
    return static_cast<double>((state = state * 6364136223846793005U + 1442695040888963407U) >> 11);
  };
  int hits = 0;
  for (int i = 0; i < 20000; ++i) {
    const double scale = i % 4 == 0 ? 0x1p-1100 : i % 4 == 1 ? 0x1p400 : i % 4 == 2 ? 0x1p-500 : 1;
    const auto number = [&] { return random() * 0x1p-53 * scale; };
    const Ball a{{number(), number(), number()}, number()};
    Ball b{{number(), number(), number()}, number()};
    const Box box{{-number(), -number(), -number()}, {number(), number(), number()}};
    const double alarm = i % 3 == 0 ? 0 : number();
    // Nearly touching: the reach is the distance, wrong by a bit or none.
    if (i % 8 < 4) b.radius = std::max(0.0, (b.center - a.center).norm() - a.radius - alarm);
    Box beside = box;
    if (i % 8 < 4) beside.max[i % 3] = (beside.min[i % 3] = box.max[i % 3] + alarm) + number();
    const bool hit = out_of_line::test_sphere_sphere(a, b, alarm);
    hits += hit ? 1 : 0;
    expect(test_sphere_sphere(a, b, alarm) == hit, "a decision of two spheres");
    expect(compute_sphere_sphere(a, b, {alarm, 0}).has_value() == hit, "a contact of two spheres");
    expect(test_cube_cube(box, beside, alarm) == out_of_line::test_cube_cube(box, beside, alarm), "that of two boxes");
    expect(test_sphere_cube(a, beside, alarm) == out_of_line::test_sphere_cube(a, beside, alarm),
           "of a sphere and a box");
    expect(compute_sphere_cube(a, beside, {alarm, 0}).has_value() == out_of_line::test_sphere_cube(a, beside, alarm),
           "a contact of a sphere and a box");
  }
  expect(hits > 4000 && hits < 19000, "as many hits as misses, about");
}

void models_are_made_copied_moved_and_destroyed() {
  for (int round = 0; round < 20; ++round) {
    std::vector<std::unique_ptr<CollisionModel>> models;
    models.push_back(std::make_unique<SphereCollisionModel>("spheres", centers(), radii(0.5)));
    models.push_back(std::make_unique<RigidSphereModel>("rigid", centers(), upright(), radii(0.25)));
    models.push_back(std::make_unique<CubeCollisionModel>("cubes", centers(), centers()));
    models.push_back(ModelFactory::getInstance().make("SphereCollisionModel", "made",
                                                      {{"centers", centers()}, {"radii", radii(0.5)}}));
    const CapsuleCollisionModel capsules("capsules", centers(), centers().rowwise() + Eigen::RowVector3d(0, 1, 0),
                                         radii(0.25));
    expect(capsules.capsule(7).end == Vector3(7, 1, 0) && capsules.bounding_box(7).max[1] >= 1.25, "a capsule");
    const TriangleCollisionModel triangles("triangles", centers(), centers(), centers());
    expect(triangles.triangle(7).vertices[2] == Vector3(7, 0, 0), "a triangle");
    const PlaneCollisionModel planes("planes", Eigen::MatrixX3d::Ones(kCount, 3), radii(0.25));
    expect(planes.plane(7).offset == 0.25, "a plane");
    const LineCollisionModel lines("lines", centers(), centers());
    expect(lines.line(7).start == lines.line(7).end, "a line");
    const RayCollisionModel rays("rays", centers(), Eigen::MatrixX3d::Ones(kCount, 3), radii(0.25));
    expect(rays.ray(7).length == 0.25 && rays.bounding_box(7).max[1] >= 0.25, "a ray");
    SphereCollisionModel copy(static_cast<const SphereCollisionModel&>(*models[0]));
    const SphereCollisionModel moved(std::move(copy));
    expect(moved.balls()[7].center == Vector3(7, 0, 0) && moved.getR()[100] == 0.5, "a moved model's numbers");
    auto& spheres = static_cast<SphereCollisionModel&>(*models[0]);
    spheres.setCenters(centers().rowwise() + Eigen::RowVector3d(0, 1, 0));
    expect(spheres.balls().centers(3, 1) == 1, "centres that were set");
    auto& rigid = static_cast<RigidSphereModel&>(*models[1]);
    rigid.setFrames(centers(), upright());
    std::vector<Frame> frames;
    for (Index i = 0; i < kCount; ++i) frames.push_back(rigid.frame(i));
    const Eigen::Quaterniond turned(frames[5].orientation);
    expect(turned.w() == 1 && frames[5].center[0] == 5, "a frame");
    static_cast<CubeCollisionModel&>(*models[2]).setParentOf(4, {0, 0, 0}, {1, 1, 1}, {0, 0, 1}, 1);
    expect(models[2]->bounding_box(4).max[2] == 1, "a box that was set");

    const std::unique_ptr<Intersection> intersection = std::make_unique<ProximityIntersection>(Distances{0.25, 0.125});
    const auto contacts = detect(*intersection, *models[3], *models[1]);
    expect(contacts && contacts->size() == kCount + 2 * (kCount - 1), "as many contacts as there are");
    if (contacts) expect(contacts->at(1).value == 0.125 && contacts->at(1).normal[0] == 1, "a contact");
    expect(detect(*intersection, *models[3])->size() == kCount - 1, "of a model with itself");
    const auto beside = detect(*intersection, *models[3], capsules);  // what the library itself registered
    expect(beside && beside->size() == kCount + 2 * (kCount - 1) && beside->at(1).value == 0.125,
           "contacts of capsules");
  }
}

void bad_numbers_are_refused() {
  for (const double bad : {kNaN, kInfinity, kMinusLeast, -1.0}) {
    expect(outside_domain("radius", bad).has_value(), "a bad length");
    expect(refuses<InvalidModel>([&] { SphereCollisionModel("m", centers(), radii(bad)); }), "a bad radius");
    expect(refuses<std::invalid_argument>([&] { ProximityIntersection({bad, 0}); }), "a bad distance");
  }
  for (const double bad : {kNaN, kInfinity}) {
    Eigen::MatrixX3d some = centers();
    some(3, 2) = bad;
    expect(outside_domain("center", Vector3(0, 0, bad)).has_value(), "a bad coordinate");
    expect(refuses<InvalidModel>([&] { SphereCollisionModel("m", some, radii(1)); }), "a bad centre");
    expect(refuses<InvalidModel>([&] { RigidSphereModel("m", some, upright(), radii(1)); }), "a bad position");
    expect(refuses<InvalidModel>([&] { CubeCollisionModel("m", centers(), some); }), "a bad bound");
    expect(refuses<InvalidModel>([&] { CapsuleCollisionModel("m", centers(), some, radii(1)); }), "a bad end");
  }
  expect(outside_domain("box", Box{{kLeast, 0, 0}, {0, 0, 0}}).has_value(), "a box the wrong way round");
  expect(refuses<InvalidModel>([&] { RigidSphereModel("m", centers(), Eigen::MatrixX4d::Ones(kCount, 4), radii(1)); }),
         "a quaternion that is none");
  expect(refuses<InvalidModel>([&] { SphereCollisionModel("m", centers(), Eigen::VectorXd::Ones(7)); }),
         "other lengths");
  const Eigen::MatrixXd narrow = Eigen::MatrixXd::Zero(kCount, 2);
  expect(refuses<std::invalid_argument>([&] { SphereCollisionModel("m", narrow, radii(1)); }), "two coordinates");
  const std::vector<double> two(2);
  std::vector<std::uint8_t> hit(1);
  expect(refuses<std::invalid_argument>([&] {
           batch::test_sphere_sphere({two, two, two, two}, {two, two, two, two}, 0, hit);
         }),
         "columns of other lengths");
}

void a_plugin_works(const char* library) {
  load_plugin(library);
  for (int round = 0; round < 20; ++round) {
    const auto capsules = ModelFactory::getInstance().make(
        "CapsuleModel", "capsules", {{"p", centers()}, {"q", centers()}, {"radii", radii(0.25)}});
    const SphereCollisionModel spheres("spheres", centers(), radii(0.25));
    expect(detect(ProximityIntersection({0.25, 0}), *capsules, spheres)->size() == kCount, "a plug-in's contacts");
    expect(refuses<InvalidModel>([&] {
             (void)ModelFactory::getInstance().make("CapsuleModel", "bad",
                                                    {{"p", centers()}, {"q", centers()}, {"radii", radii(kNaN)}});
           }),
           "a plug-in's refusal");
  }
}

}  // namespace

int main(int count, char** arguments) {
  the_readmes_example();
  decisions_are_the_librarys();
  models_are_made_copied_moved_and_destroyed();
  bad_numbers_are_refused();
  for (int i = 1; i < count; ++i) a_plugin_works(arguments[i]);
  std::printf("%d wrong, %d plug-ins\n", failures, count - 1);
  return failures == 0 && count > 1 ? 0 : 1;
}
