// Must not compile: an intersector for a model that did not declare its type, and so is its base to the map.
#include "contact/discrete_intersection.hpp"

struct Droplets : contact::SphereCollisionModel {
  using SphereCollisionModel::SphereCollisionModel;
};

struct Complete : contact::BaseIntersector {
  static constexpr std::string_view kName = "Complete";
  bool testIntersection(const contact::Sphere&, const contact::Sphere&, const contact::Intersection&) const;
  int computeIntersection(const contact::Sphere&, const contact::Sphere&, OutputVector&,
                          const contact::Intersection&) const;
};

void add(contact::IntersectorMap& map, const Complete& object) { map.add<Droplets, Droplets>(object); }
