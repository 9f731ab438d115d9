// Droplets: a model type derived from a built-in one, and an intersector that another translation unit registers.
#include "droplets.hpp"

namespace example {
namespace {

using namespace contact;

/// Droplets that touch flow together: they meet, but have no contact.
class DropletIntersector : public BaseIntersector {
 public:
  static constexpr std::string_view kName = "DropletIntersector";

  explicit DropletIntersector(DiscreteIntersection& object) {
    object.intersectors.add<Droplets, Droplets>(*this);
    object.intersectors.ignore<Droplets, CubeCollisionModel>();
  }

  bool testIntersection(const Sphere& drop1, const Sphere& drop2, const Intersection& current) const {
    return test_sphere_sphere(drop1.ball(), drop2.ball(), current.getAlarmDistance());
  }
  int computeIntersection(const Sphere&, const Sphere&, OutputVector&, const Intersection&) const { return 0; }
};

const IntersectorCreator<DropletIntersector> registered("DropletIntersector");

}  // namespace
}  // namespace example
