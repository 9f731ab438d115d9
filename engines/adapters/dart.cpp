// DART: its own collision detector on two sphere shapes.
#include <dart/collision/collision.hpp>
#include <dart/collision/dart/dart.hpp>
#include <dart/config.hpp>
#include <dart/dynamics/SimpleFrame.hpp>
#include <dart/dynamics/SphereShape.hpp>

#include "engines/adapters/adapter.hpp"

namespace contact::adapters {
namespace {

struct Ball {
  void set(const double* x) const {
    sphere->setRadius(x[3]);
    frame->setTranslation(Eigen::Vector3d(x[0], x[1], x[2]));
  }
  std::shared_ptr<dart::dynamics::SphereShape> sphere = std::make_shared<dart::dynamics::SphereShape>(1);
  std::shared_ptr<dart::dynamics::SimpleFrame> frame =
      std::make_shared<dart::dynamics::SimpleFrame>(dart::dynamics::Frame::World());
};

}  // namespace

// The contact's point divides the line of centres by the radii, as FCL's does.
std::string declaration() {
  return R"({"engine":{"name":"dart","version":")" DART_VERSION
         R"("},"scalar":"binary64","pairs":["sphere_sphere"],"conventions":{"normal":"second-to-first",)"
         R"("points":"none","value":"depth","value_less_contact":false,"margin":"none","coincident":"zero_normal"}})";
}

void answer(const Question& q, Answer& said) {
  // Its spheres assert that their radius is not zero, which ends the process.
  if (q.a[3] == 0 || q.b[3] == 0) return said.unsupported();
  static const Ball a;
  static const Ball b;
  static const auto detector = dart::collision::DARTCollisionDetector::create();
  static const auto groups = [] {
    a.frame->setShape(a.sphere);
    b.frame->setShape(b.sphere);
    return std::pair{detector->createCollisionGroup(a.frame.get()), detector->createCollisionGroup(b.frame.get())};
  }();
  a.set(q.a);
  b.set(q.b);
  dart::collision::CollisionResult result;
  const bool hit = groups.first->collide(groups.second.get(), dart::collision::CollisionOption(true, 1), &result);
  said.hit(hit);
  if (!hit) return;
  said.normal(result.getContact(0).normal);
  said.value(result.getContact(0).penetrationDepth);
}

}  // namespace contact::adapters
