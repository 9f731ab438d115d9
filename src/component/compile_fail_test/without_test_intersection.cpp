// Must not compile: an intersector whose testIntersection takes the elements in the other order.
#include "contact/discrete_intersection.hpp"

struct Incomplete : contact::BaseIntersector {
  static constexpr std::string_view kName = "Incomplete";
  bool testIntersection(const contact::Sphere&, const contact::Cube&, const contact::Intersection&) const;
  int computeIntersection(const contact::Cube&, const contact::Sphere&, OutputVector&,
                          const contact::Intersection&) const;
};

void add(contact::IntersectorMap& map, const Incomplete& object) {
  map.add<contact::CubeCollisionModel, contact::SphereCollisionModel>(object);
}
