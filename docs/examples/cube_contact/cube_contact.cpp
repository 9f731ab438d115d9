// A plug-in that gives two boxes a contact, where DiscreteIntersection writes none.
#include <array>
#include <limits>

#include "contact/discrete_intersection.hpp"
#include "contact/exact_sum.hpp"
#include "contact/plugin.hpp"

namespace example {
namespace {

using namespace contact;

// Comparisons that see subnormals whatever the processor is set to.
double larger(double x, double y) { return sign_of_sum({x, -y}) < 0 ? y : x; }
double smaller(double x, double y) { return sign_of_sum({x, -y}) > 0 ? y : x; }

/// Two boxes on one axis.
struct Axis {
  Axis(double min1, double max1, double min2, double max2)
      : side(sign_of_sum({min2, max2, -min1, -max1}) < 0 ? -1 : 1),
        face1(side > 0 ? max1 : min1),
        face2(side > 0 ? min2 : max2),
        low(larger(min1, min2)),
        high(smaller(max1, max2)) {}

  [[nodiscard]] double middle() const { return rounded_sum({low, high}, -1); }

  double side;          ///< 1 where the second box lies on the positive side, or neither more than the other; else -1
  double face1, face2;  ///< that look at each other: gap = side (face2 - face1), the larger of min2 - max1, min1 - max2
  double low, high;     ///< of both intervals' common part, where the gap is not positive
};

/// The contact of two boxes.
///   gap > 0 on an axis    g = side gap on such axes, else 0     normal = g / |g|     value = |g| - contact
///                         points: the faces on such axes, else the middle of the common part
///   else                  k the axis of the largest gap, the lowest of equals: least penetration
///                         normal = side e_k     value = gap_k - contact     points: the faces on axis k, else the
///                         middle
/// Units       one length unit throughout; the normal is a unit vector from a to b.
/// Domain      as test_cube_cube; contact distance finite and >= 0.
/// Error       every number is the exact real rounded once to nearest, ties to even; every zero is +0.
/// Degenerate  neither box lies more on the positive side of axis k: the normal is +e_k, also with the boxes exchanged.
///             In every other case exchanging the boxes mirrors the contact bit for bit.
/// Environment any rounding mode, flush-to-zero and denormals-are-zero: the answer is the same.
/// Evidence    cube_contact_test.cpp and cube_contact_properties.cpp beside this file.
Contact compute_cube_cube(const Box& a, const Box& b, double contact_distance) {
  const auto axis = [&](Index k) { return Axis(a.min[k], a.max[k], b.min[k], b.max[k]); };
  const std::array axes{axis(0), axis(1), axis(2)};
  Ball from{Vector3::Zero(), 0};
  Ball to{Vector3::Zero(), 0};
  Contact contact{Vector3::Zero(), Vector3::Zero(), Vector3::Zero(), 0, false};  // Eigen leaves vectors as they are
  std::size_t k = 0;
  bool apart = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Axis& x = axes[i];
    const Axis& most = axes[k];
    const auto at = static_cast<Index>(i);
    contact.point1[at] = contact.point2[at] = x.middle();
    if (sign_of_sum({x.side * x.face2, -x.side * x.face1, -most.side * most.face2, most.side * most.face1}) > 0) k = i;
    if (sign_of_sum({x.side * x.face2, -x.side * x.face1}) <= 0) continue;
    apart = true;
    contact.point1[at] = from.center[at] = rounded_sum({x.face1});
    contact.point2[at] = to.center[at] = rounded_sum({x.face2});
  }
  if (apart) {
    // Two balls of radius 0 have the gap vector between them, at whatever distance.
    const Distances distances{.alarm = std::numeric_limits<double>::infinity(), .contact = contact_distance};
    const Contact balls = *compute_sphere_sphere(from, to, distances);
    contact.normal = balls.normal;
    contact.value = balls.value;
    return contact;
  }
  const Axis& least = axes[k];
  const auto at = static_cast<Index>(k);
  contact.normal[at] = least.side;
  contact.point1[at] = rounded_sum({least.face1});
  contact.point2[at] = rounded_sum({least.face2});
  contact.value = rounded_sum({least.side * least.face2, -least.side * least.face1, -contact_distance});
  return contact;
}

/// Boxes against boxes. Whether they meet is what DiscreteIntersection::testIntersection says: an element against
/// itself has its cone's answer there, and no contact here.
class CubeContactIntersector : public BaseIntersector {
 public:
  static constexpr std::string_view kName = "CubeContactIntersector";

  explicit CubeContactIntersector(DiscreteIntersection& object) : object_(object) {
    object.intersectors.add<CubeCollisionModel, CubeCollisionModel>(*this);
  }

  bool testIntersection(const Cube& cube1, const Cube& cube2, const Intersection& current) const {
    return object_.testIntersection(cube1, cube2, current);
  }

  int computeIntersection(const Cube& cube1, const Cube& cube2, OutputVector& contacts,
                          const Intersection& current) const {
    if (cube1 == cube2 || !testIntersection(cube1, cube2, current)) return 0;
    const Contact contact = compute_cube_cube(cube1.box(), cube2.box(), current.getContactDistance());
    contacts.push_back({.elem = {cube1, cube2},
                        .id = contact_id(cube1, cube2),
                        .point = {contact.point1, contact.point2},
                        .normal = contact.normal,
                        .value = contact.value});
    return 1;
  }

 private:
  const DiscreteIntersection& object_;
};

void enter(PluginHost& host) {
  host.intersectors.registerCreator("CubeContactIntersector", creator_of<CubeContactIntersector>());
}

}  // namespace
}  // namespace example

CONTACT_PLUGIN(example::enter);
