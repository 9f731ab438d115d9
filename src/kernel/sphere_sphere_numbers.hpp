// Single numbers of a contact: what the vectors leave of a hit.
#pragma once

#include "contact/contact.hpp"
#include "contact/geometry.hpp"

namespace contact::kernel {

// A contact's numbers as bits of a set: the normal's axes, the first point's, the second's, the value.
inline constexpr unsigned kPointNumber = 3;  ///< of one axis: bits k, k + 3 and k + 6
inline constexpr unsigned kValueNumber = 9;
inline constexpr unsigned kAllNumbers = (1U << 10) - 1;
inline constexpr unsigned kAxisNumbers = 0b001001001;

/// Point k of a contact is c_k + sign r_k n, with `towards` 1 for the first ball and -1 for the second; 0 leaves it at
/// the centre.
constexpr double sign_of(PointOn on, double towards) {
  return on == PointOn::nearest_surface ? towards : on == PointOn::far_surface ? -towards : 0;
}

/// A contact whose numbers are to be written: zeros first would cost as much as a miss.
struct Unset {
  operator Contact() const {  // NOLINT(google-explicit-constructor)
    Contact contact;
    contact.degenerate = false;  // a bool may not be copied before it is set; `unique` is
    return contact;
  }
};

/// Settles the numbers of a hit whose bits are set; what becomes of the others is not specified.
/// Domain      to nearest, subnormals kept.
void round_numbers(const Ball& a, const Ball& b, double contact_distance, ContactPoints points, unsigned numbers,
                   Contact& contact);

// The functions of two balls, for pairs that come to these.
// Domain      to nearest, subnormals kept.

/// Whether they are within the alarm distance.
[[nodiscard]] bool decide_balls(const Ball& a, const Ball& b, double alarm);
/// Whether there is a contact, and it.
[[nodiscard]] bool contact_of_balls(const Ball& a, const Ball& b, Distances distances, ContactPoints points,
                                    Contact& contact);

}  // namespace contact::kernel
