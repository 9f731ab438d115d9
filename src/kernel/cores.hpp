// What every pair with a distance shares once the nearest points p and q of its two cores are known, exactly: with
// delta = q - p and D = |delta|^2 it is the sphere pair at p and q, which are quotients now.
#pragma once

#include <array>

#include "contact/contact.hpp"
#include "kernel/exact.hpp"

namespace contact::kernel {

using IntegerVector = std::array<Integer, 3>;

[[nodiscard]] IntegerVector operator-(const IntegerVector& a, const IntegerVector& b);
[[nodiscard]] Integer dot(const IntegerVector& a, const IntegerVector& b);
[[nodiscard]] IntegerVector cross(const IntegerVector& a, const IntegerVector& b);
/// a x + b y.
[[nodiscard]] IntegerVector combined(const Integer& a, const IntegerVector& x, const Integer& b,
                                     const IntegerVector& y);
/// A point or a direction on a grid.
[[nodiscard]] IntegerVector on_grid(const Grid& grid, const Vector3& v);

inline const IntegerVector kNowhere{0, 0, 0};

/// Of two right normals the reference takes the one that is lexicographically greater, each divided by the sum of the absolute values of its
/// components. Whether n is that. Domain: neither is 0.
[[nodiscard]] bool is_preferred(const IntegerVector& n, const IntegerVector& to);

/// The nearest points of two cores: p / over and q / over on a grid.
struct ExactNearest {
  IntegerVector p;
  IntegerVector q;
  Integer over;  ///< > 0
  bool unique;
  /// Where p = q, the normal by agreement, of any length above 0. Domain of the others: not read.
  IntegerVector agreed;
  /// The cores overlap: the normal leads from q to p, and the distance counts below 0.
  bool overlap = false;
};

/// The lengths of a question.
struct Lengths {
  double radius1;
  double radius2;
  double alarm;
  double contact;
};

/// |q - p| <= alarm + radius1 + radius2.
[[nodiscard]] bool is_hit(const ExactNearest& nearest, const Grid& grid, const Lengths& lengths);

/// The contact, every number rounded once to nearest; of the numbers only those whose bits are set, and the rest of
/// `contact` is left as it is. The bits are those of sphere_sphere_numbers.hpp.
void round_exactly(const ExactNearest& nearest, const Grid& grid, const Lengths& lengths, ContactPoints points,
                   unsigned numbers, Contact& contact);

}  // namespace contact::kernel
