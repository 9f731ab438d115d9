// The answer that a question should get, rounded: what both oracles derive and what a golden file records.
#pragma once

#include <optional>
#include <string>

#include "contact/contact.hpp"

namespace contact {

struct Expectation {
  bool hit = false;
  std::optional<Contact> contact;  ///< for a hit of two spheres, under `nearest_surface`
};

/// The name of the first field in which two expectations differ, or nothing. Zeros of either sign are equal.
[[nodiscard]] inline std::optional<std::string> first_difference(const Expectation& x, const Expectation& y) {
  if (x.hit != y.hit) return "hit";
  if (x.contact.has_value() != y.contact.has_value()) return "contact";
  if (!x.contact) return std::nullopt;
  if (x.contact->degenerate != y.contact->degenerate) return "degenerate";
  if (x.contact->unique != y.contact->unique) return "unique";
  for (int axis = 0; axis < 3; ++axis) {
    const std::string index = "[" + std::to_string(axis) + "]";
    if (x.contact->normal[axis] != y.contact->normal[axis]) return "normal" + index;
    if (x.contact->point1[axis] != y.contact->point1[axis]) return "point1" + index;
    if (x.contact->point2[axis] != y.contact->point2[axis]) return "point2" + index;
  }
  if (x.contact->value != y.contact->value) return "value";
  return std::nullopt;
}

}  // namespace contact
