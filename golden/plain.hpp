// The seed's formulas in plain arithmetic, in the order in which upstream computes them: what everybody ships.
#pragma once

#include <optional>

#include "contact/contact.hpp"
#include "oracle/truth/query.hpp"

namespace contact::golden {

// Each kind of pairs has these in a file of its own.
//   plain_overlap   what testIntersection says, in arithmetic of the scalar
//   plain_contact   what computeIntersection says; nothing for a pair whose contacts have no numbers
#define CONTACT_DECLARE(A, B)                                                                                     \
  [[nodiscard]] bool plain_overlap(const Two<A, B>& shapes, Distances distances, Scalar scalar);                  \
  [[nodiscard]] std::optional<Contact> plain_contact(const Two<A, B>& shapes, Distances distances, Scalar scalar, \
                                                     ContactPoints points = {});
CONTACT_KINDS(CONTACT_DECLARE)
#undef CONTACT_DECLARE

/// How far out from its core a shape of a radius has its point.
template <class Real>
Real outward(PointOn on, Real radius) {
  return on == PointOn::center ? Real{0} : on == PointOn::far_surface ? -radius : radius;
}

/// What plain arithmetic in the given scalar says of a question.
[[nodiscard]] inline bool plain_overlap(const Query& query, Scalar scalar) {
  return std::visit([&](const auto& shapes) { return plain_overlap(shapes, query.distances, scalar); }, query.shapes);
}
[[nodiscard]] inline std::optional<Contact> plain_contact(const Query& query, Scalar scalar,
                                                          ContactPoints points = {}) {
  return std::visit([&](const auto& shapes) { return plain_contact(shapes, query.distances, scalar, points); },
                    query.shapes);
}

}  // namespace contact::golden
