// DART: its own collision detector on a sphere shape and another or a box shape.
#include <dart/collision/collision.hpp>
#include <dart/collision/dart/dart.hpp>
#include <dart/config.hpp>
#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/SimpleFrame.hpp>
#include <dart/dynamics/SphereShape.hpp>

#include "engines/adapters/adapter.hpp"

namespace contact::adapters {
namespace {

Eigen::Vector3d vector(const double* x) { return {x[0], x[1], x[2]}; }

/// A shape in its place, alone in a group of the detector.
template <class Shape>
struct Placed {
  Placed(dart::collision::CollisionDetector& detector, std::shared_ptr<Shape> made) : shape(std::move(made)) {
    frame->setShape(shape);
    group = detector.createCollisionGroup(frame.get());
  }
  std::shared_ptr<Shape> shape;
  std::shared_ptr<dart::dynamics::SimpleFrame> frame =
      std::make_shared<dart::dynamics::SimpleFrame>(dart::dynamics::Frame::World());
  std::unique_ptr<dart::collision::CollisionGroup> group;
};

}  // namespace

// The point of two spheres divides the line of centres by the radii, as FCL's does; that of a sphere and a box lies on
// the box.
std::string declaration() {
  return R"({"engine":{"name":"dart","version":")" DART_VERSION
         R"("},"scalar":"binary64","pairs":["sphere_sphere","sphere_cube"],"conventions":{"normal":"second-to-first",)"
         R"("points":"none","value":"depth","value_less_contact":false,"margin":"none","coincident":"zero_normal"},)"
         R"("pair_conventions":{"sphere_cube":{"points":"second_only","coincident":"any_unit_normal","shapes":"centered"}}})";
}

void answer(const Question& q, Answer& said) {
  using dart::dynamics::BoxShape;
  using dart::dynamics::SphereShape;
  static const auto detector = dart::collision::DARTCollisionDetector::create();
  static const Placed a(*detector, std::make_shared<SphereShape>(1));
  static const Placed sphere(*detector, std::make_shared<SphereShape>(1));
  static const Placed box(*detector, std::make_shared<BoxShape>(Eigen::Vector3d(1, 1, 1)));
  const auto set = [](const Placed<SphereShape>& to, const double* x) {
    to.shape->setRadius(x[3]);
    to.frame->setTranslation(vector(x));
  };
  const bool boxed = q.pair == CONTACT_SPHERE_CUBE;
  // Its spheres assert that their radius is not zero and its boxes that no size is, which ends the process.
  if (q.a[3] == 0) return said.unsupported();
  set(a, q.a);
  if (boxed) {
    const CenteredBox x(q.b);
    if (vector(x.size).minCoeff() == 0) return said.unsupported();
    box.shape->setSize(vector(x.size));
    box.frame->setTranslation(vector(x.center));
  } else {
    if (q.b[3] == 0) return said.unsupported();
    set(sphere, q.b);
  }
  dart::collision::CollisionResult result;
  const bool hit = a.group->collide(boxed ? box.group.get() : sphere.group.get(),
                                    dart::collision::CollisionOption(true, 1), &result);
  said.hit(hit);
  if (!hit) return;
  said.normal(result.getContact(0).normal);
  if (boxed) said.point2(result.getContact(0).point);
  said.value(result.getContact(0).penetrationDepth);
}

}  // namespace contact::adapters
