// DART: its own collision detector on a sphere and another or a box, and on two boxes.
#include <dart/collision/collision.hpp>
#include <dart/collision/dart/dart.hpp>
#include <dart/config.hpp>
#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/SimpleFrame.hpp>
#include <dart/dynamics/SphereShape.hpp>

#include <algorithm>

#include "engines/adapters/adapter.hpp"

namespace contact::adapters {
namespace {

using dart::dynamics::BoxShape;
using dart::dynamics::SphereShape;

/// A sphere and a box, each in its place and alone in a group of the detector, of which a question asks one.
class Placed {
 public:
  explicit Placed(dart::collision::CollisionDetector& detector) {
    ball_frame_->setShape(ball_);
    ball_group_ = detector.createCollisionGroup(ball_frame_.get());
    box_frame_->setShape(box_);
    box_group_ = detector.createCollisionGroup(box_frame_.get());
  }
  /// Nothing where it asserts that a radius or a size is not zero, which ends the process.
  dart::collision::CollisionGroup* set(const Shape& x) const {
    const Eigen::Vector3d size(x.size);
    if ((x.is_box() ? size.minCoeff() : x.radius) == 0) return nullptr;
    Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
    place.translation() = Eigen::Vector3d(x.center);
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) place.linear()(row, column) = x.rotation(row, column);
    (x.is_box() ? box_frame_ : ball_frame_)->setTransform(place);
    if (x.is_box())
      box_->setSize(size);
    else
      ball_->setRadius(x.radius);
    return (x.is_box() ? box_group_ : ball_group_).get();
  }

 private:
  static std::shared_ptr<dart::dynamics::SimpleFrame> new_frame() {
    return std::make_shared<dart::dynamics::SimpleFrame>(dart::dynamics::Frame::World());
  }
  std::shared_ptr<SphereShape> ball_ = std::make_shared<SphereShape>(1);
  std::shared_ptr<BoxShape> box_ = std::make_shared<BoxShape>(Eigen::Vector3d(1, 1, 1));
  std::shared_ptr<dart::dynamics::SimpleFrame> ball_frame_ = new_frame();
  std::shared_ptr<dart::dynamics::SimpleFrame> box_frame_ = new_frame();
  std::unique_ptr<dart::collision::CollisionGroup> ball_group_;
  std::unique_ptr<dart::collision::CollisionGroup> box_group_;
};

}  // namespace

// The point of two spheres divides the line of centres by the radii, as FCL's does; that of a sphere and a box lies on
// the box; those of two boxes on either.
std::string declaration() {
  return R"({"engine":{"name":"dart","version":")" DART_VERSION
         R"("},"scalar":"binary64","rounds":["orientation"],"pairs":["sphere_sphere","sphere_cube","obb_obb","sphere_obb","cube_obb"],)"
         R"("conventions":{"normal":"second-to-first","points":"none","value":"depth","value_less_contact":false,)"
         R"("margin":"none","shapes":"centered"},)"
         R"("pair_conventions":{"sphere_sphere":{"coincident":"zero_normal"},"sphere_cube":{"points":"second_only"},)"
         R"("sphere_obb":{"points":"second_only"},"obb_obb":{"depth":"any_separating"},"cube_obb":{"depth":"any_separating"}}})";
}

void answer(const Question& q, Answer& said) {
  static const auto detector = dart::collision::DARTCollisionDetector::create();
  static const Placed first(*detector);
  static const Placed second(*detector);
  auto* const a = first.set(q.a);
  auto* const b = second.set(q.b);
  if (!a || !b) return said.unsupported();
  dart::collision::CollisionResult result;
  const bool hit = a->collide(b, dart::collision::CollisionOption(true, 16), &result);
  said.hit(hit);
  if (!hit) return;
  // Of the points of two boxes the deepest is the contact.
  const auto& contacts = result.getContacts();
  const auto& contact = *std::max_element(contacts.begin(), contacts.end(), [](const auto& x, const auto& y) {
    return x.penetrationDepth < y.penetrationDepth;
  });
  said.normal(contact.normal);
  if (q.a.kind == Kind::sphere && q.b.is_box()) said.point2(contact.point);
  said.value(contact.penetrationDepth);
}

}  // namespace contact::adapters
