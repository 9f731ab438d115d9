// The two functions of production for two shapes of any kind: for code that knows no pair by name.
#pragma once

#include <optional>

#include "contact/contact.hpp"
#include "contact/pairs.hpp"

namespace contact::inline CONTACT_ABI {

// src/kernel/core_pairs.cpp has these of most kinds. They are test_sphere_sphere and compute_sphere_sphere,
// test_cube_cube, and so on, whose declarations say what holds.
//   is_hit       whether two shapes are within the alarm distance
//   contact_of   their contact; nothing for a pair whose contacts have no numbers
#define CONTACT_DECLARE(A, B)                                                                   \
  [[nodiscard]] bool is_hit(const Two<A, B>& shapes, Distances distances);                      \
  [[nodiscard]] std::optional<Contact> contact_of(const Two<A, B>& shapes, Distances distances, \
                                                  ContactPoints points = {});
CONTACT_KINDS(CONTACT_DECLARE)
#undef CONTACT_DECLARE

}  // namespace contact::inline CONTACT_ABI
