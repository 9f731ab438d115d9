// What detection must find: every pair put to the exact oracle, without a spatial index and without the component.
#pragma once

#include <optional>
#include <utility>

#include "contact/detection_output.hpp"
#include "oracle/truth/truth.hpp"

namespace contact::component {

/// The contact of two elements with these shapes, at the nearest surface points; nothing beyond the alarm distance.
template <class A, class B>
std::optional<DetectionOutput> expected_contact(const CollisionElement& elem1, const A& shape1,
                                                const CollisionElement& elem2, const B& shape2, Distances distances) {
  const Shapes shapes = Two<A, B>{shape1, shape2};
  const oracle::Truth truth = oracle::truth_of({pairs_of_kinds()[shapes.index()], shapes, distances});
  if (!truth.hit()) return std::nullopt;
  const Contact contact = *oracle::expectation(truth, Scalar::binary64).contact;
  const Index size1 = elem1.getCollisionModel().getSize();
  const Index size2 = elem2.getCollisionModel().getSize();
  return DetectionOutput{.elem = {elem1, elem2},
                         .id = size1 > size2 ? elem1.getIndex() : elem2.getIndex(),
                         .point = {contact.point1, contact.point2},
                         .normal = contact.normal,
                         .value = contact.value};
}

/// The same of an intersector that takes the two in the reverse order: this shows where their cores meet, since the
/// normal is an agreement there.
template <class A, class B>
std::optional<DetectionOutput> expected_swapped(const CollisionElement& elem1, const A& shape1,
                                                const CollisionElement& elem2, const B& shape2, Distances distances) {
  auto output = expected_contact(elem2, shape2, elem1, shape1, distances);
  if (!output) return output;
  output->elem = {elem1, elem2};
  if (elem1.getCollisionModel().getSize() == elem2.getCollisionModel().getSize()) output->id = elem2.getIndex();
  std::swap(output->point[0], output->point[1]);
  output->normal = Vector3::Zero() - output->normal;
  return output;
}

/// Whether two boxes are within the alarm distance.
inline bool expected_hit(const Box& box1, const Box& box2, double alarm) {
  return oracle::truth_of({Pair::cube_cube, Boxes{box1, box2}, {alarm, 0}}).hit();
}

}  // namespace contact::component
