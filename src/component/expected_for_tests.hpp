// What detection must find: every pair put to the exact oracle, without a spatial index and without the component.
#pragma once

#include <optional>

#include "contact/detection_output.hpp"
#include "oracle/truth/truth.hpp"

namespace contact::component {

/// The contact of two elements with these balls, at the nearest surface points; nothing beyond the alarm distance.
/// `turned` is what an intersector for the reverse order gives: it shows in coincident centres alone, whose normal is
/// (1,0,0) from the sphere that the intersector takes first.
inline std::optional<DetectionOutput> expected_contact(const CollisionElement& elem1, const Ball& ball1,
                                                       const CollisionElement& elem2, const Ball& ball2,
                                                       Distances distances, bool turned = false) {
  const oracle::Truth truth = oracle::truth_of({Pair::sphere_sphere, Balls{ball1, ball2}, distances});
  if (!truth.hit()) return std::nullopt;
  const Index size1 = elem1.getCollisionModel().getSize();
  const Index size2 = elem2.getCollisionModel().getSize();
  DetectionOutput output{.elem = {elem1, elem2},
                         .id = size1 > size2 ? elem1.getIndex() : elem2.getIndex(),
                         .point = {Vector3::Zero(), Vector3::Zero()},
                         .normal = Vector3::Zero(),
                         .value = 0};
  const bool reverse = truth.degenerate() && turned;
  const Contact contact =
      *oracle::expectation(reverse ? oracle::truth_of({Pair::sphere_sphere, Balls{ball2, ball1}, distances}) : truth,
                           Scalar::binary64)
           .contact;
  output.point = reverse ? std::array<Vector3, 2>{contact.point2, contact.point1}
                         : std::array<Vector3, 2>{contact.point1, contact.point2};
  output.normal = reverse ? Vector3(-1, 0, 0) : contact.normal;
  output.value = contact.value;
  return output;
}

/// Whether two boxes are within the alarm distance.
inline bool expected_hit(const Box& box1, const Box& box2, double alarm) {
  return oracle::truth_of({Pair::cube_cube, Boxes{box1, box2}, {alarm, 0}}).hit();
}

}  // namespace contact::component
