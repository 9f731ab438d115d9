// Registers an intersector at namespace scope, as a user's own source file does.
#include "component/registered_elsewhere_for_tests.hpp"

#include "component/models_for_tests.hpp"

namespace contact::component {
namespace {

const IntersectorCreator<StarIntersector> kRegistered("StarIntersector");

int& count() {
  static int alive = 0;
  return alive;
}

}  // namespace

StarIntersector::StarIntersector(DiscreteIntersection& object) : object_(&object) {
  ++count();
  object.intersectors.add<Stars, SphereCollisionModel>(*this);
}

StarIntersector::~StarIntersector() { --count(); }

int StarIntersector::computeIntersection(const Stars::Element& star, const Sphere& sphere, OutputVector& contacts,
                                         const Intersection&) const {
  // A number that tells which component made this intersector.
  contacts.push_back(numbered_contact(star, sphere, static_cast<std::int64_t>(object_->points())));
  return 1;
}

int StarIntersector::alive() { return count(); }

}  // namespace contact::component
