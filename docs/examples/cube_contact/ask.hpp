// A question about two boxes, put to the plug-in cube_contact as a program would: loaded, looked up, asked.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <optional>

#include "contact/discrete_intersection.hpp"
#include "contact/plugin.hpp"
#include "oracle/truth/query.hpp"

namespace example {

struct Answer {
  bool test;
  std::optional<contact::Contact> contact;
};

inline Answer ask(const contact::Query& query) {
  using namespace contact;
  load_plugin(CUBE_CONTACT);
  const auto model = [](const Box& box) { return CubeCollisionModel("box", box.min.transpose(), box.max.transpose()); };
  const CubeCollisionModel first = model(query.boxes()->a);
  const CubeCollisionModel second = model(query.boxes()->b);
  const ProximityIntersection intersection(query.distances);
  bool swap = false;
  const ElementIntersector* intersector = intersection.findIntersector(first, second, swap);
  const CollisionElement cube1(first, 0);
  const CollisionElement cube2(second, 0);
  OutputVector contacts;
  Answer answer{intersector->canIntersect(cube1, cube2, intersection), std::nullopt};
  if (intersector->intersect(cube1, cube2, contacts, intersection) == 1)
    answer.contact = Contact{contacts[0].normal, contacts[0].point[0], contacts[0].point[1], contacts[0].value, false};
  return answer;
}

/// Ten numbers as bits: equal means the same number, +0 and -0 told apart.
using Bits = std::array<std::uint64_t, 10>;
template <class ContactType>
Bits bits_of(const ContactType& contact) {
  Bits bits{std::bit_cast<std::uint64_t>(contact.value)};
  std::size_t at = 1;
  for (const contact::Vector3* v : {&contact.normal, &contact.point1, &contact.point2})
    for (const double x : *v) bits[at++] = std::bit_cast<std::uint64_t>(x);
  return bits;
}

}  // namespace example
