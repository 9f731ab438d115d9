// Must not compile: an intersector without computeIntersection.
#include "contact/discrete_intersection.hpp"

struct Incomplete : contact::BaseIntersector {
  static constexpr std::string_view kName = "Incomplete";
  bool testIntersection(const contact::Cube&, const contact::Sphere&, const contact::Intersection&) const;
};

void add(contact::IntersectorMap& map, const Incomplete& object) {
  map.add<contact::CubeCollisionModel, contact::SphereCollisionModel>(object);
}
