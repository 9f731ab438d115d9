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

/// Settles the numbers of a hit whose bits are set; what becomes of the others is not specified.
/// Domain      to nearest, subnormals kept.
void round_numbers(const Ball& a, const Ball& b, double contact_distance, ContactPoints points, unsigned numbers,
                   Contact& contact);

}  // namespace contact::kernel
