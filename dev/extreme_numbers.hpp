// The numbers at the ends of double's range, by the names that the tests use.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace contact {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kLargest = std::numeric_limits<double>::max();       ///< the largest finite number
inline constexpr double kLeast = std::numeric_limits<double>::denorm_min();  ///< the least number above 0

/// The next number up, and the next down.
inline double above(double x) { return std::nextafter(x, kInfinity); }
inline double below(double x) { return std::nextafter(x, -kInfinity); }

/// The number of these bits, or of all but one of them where it is not finite.
inline double finite_of(std::uint64_t bits) {
  const auto x = std::bit_cast<double>(bits);
  return std::isfinite(x) ? x : std::bit_cast<double>(bits & ~(std::uint64_t{1} << 62));
}

}  // namespace contact
