// Pairs whose numbers are far from 1, in units of their own: lengths times a power of two for each pair, changed by
// their bits, and the answers' lengths back. Nothing is lost or rounded on either way. The arithmetic between sees no
// subnormal number, for which some processors take many times as long, and few squares out of the range.
#if defined(CONTACT_KERNEL_BATCH_LIFTED_INL_H) == defined(HWY_TARGET_TOGGLE)  // once a target
#ifdef CONTACT_KERNEL_BATCH_LIFTED_INL_H
#undef CONTACT_KERNEL_BATCH_LIFTED_INL_H
#else
#define CONTACT_KERNEL_BATCH_LIFTED_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "kernel/batch_columns-inl.h"

#if HWY_HAVE_FLOAT64 && HWY_NATIVE_FMA  // else nothing is here, and no attribute for it
HWY_BEFORE_NAMESPACE();
namespace contact::kernel {
namespace HWY_NAMESPACE {

/// A vector of pairs, lifted. Loops over lanes without branches: a compiler makes vectors of them.
struct Lifted {
  static constexpr std::size_t kNumbers = 10;  ///< of two balls, the alarm and the contact distance
  /// Of biased exponents: the largest number of a pair gets the one, and a pair with a number that is not 0 and would
  /// get less than the other is left.
  static constexpr std::int64_t kLargest = 1023 + 900;
  static constexpr std::int64_t kLeast = 1023 - 900;

  HWY_ALIGN double number[kNumbers][kMostLanes];
  std::int64_t exponent[kMostLanes];  ///< of the power of two
  unsigned left = 0;                  ///< the lanes of pairs that are left; misses stand for them

  /// Whether a number of these pairs is not 0 and outside 2^-900 .. 2^1000: within, no more than a few are subnormal.
  HWY_ATTR static bool is_far_from_1(const SpherePairs& pairs, std::size_t i, Distances distances) {
    const auto is_far = [](double x) {
      const auto magnitude = static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(x) << 1 >> 1);
      constexpr auto kLow = std::bit_cast<std::int64_t>(0x1p-900);
      constexpr auto kHigh = std::bit_cast<std::int64_t>(0x1p1000);
      return static_cast<std::int64_t>(magnitude != 0) &
             (static_cast<std::int64_t>(magnitude < kLow) | static_cast<std::int64_t>(magnitude > kHigh));
    };
    const std::size_t lanes = hn::Lanes(D());
    std::int64_t far = is_far(distances.alarm) | is_far(distances.contact);
    for (std::size_t k = 0; k < 8; ++k) {
      const double* column = (k < 4 ? pairs.a[k] : pairs.b[k - 4]) + i;
      for (std::size_t lane = 0; lane < lanes; ++lane) far |= is_far(column[lane]);
    }
    return far != 0;
  }

  HWY_ATTR Lifted(const SpherePairs& pairs, std::size_t i, Distances distances) {
    const std::size_t lanes = hn::Lanes(D());
    for (std::size_t k = 0; k < 8; ++k) std::copy_n((k < 4 ? pairs.a[k] : pairs.b[k - 4]) + i, lanes, number[k]);
    const bool is_limited = distances.alarm < std::numeric_limits<double>::infinity();
    std::fill_n(number[8], lanes, is_limited ? distances.alarm : 0);
    std::fill_n(number[9], lanes, distances.contact);

    // Each number as (1 + fraction) 2^biased, with a subnormal one made normal.
    std::uint64_t fraction[kNumbers][kMostLanes];
    std::int64_t biased[kNumbers][kMostLanes];
    std::int64_t largest[kMostLanes];
    std::fill_n(largest, lanes, -1074);
    for (std::size_t k = 0; k < kNumbers; ++k)
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const std::uint64_t magnitude = std::bit_cast<std::uint64_t>(number[k][lane]) & ~kSign;
        const bool is_small = magnitude <= kFraction;  // a whole number of 2^-1074
        const double whole = std::bit_cast<double>(magnitude | std::bit_cast<std::uint64_t>(0x1p52)) - 0x1p52;
        const std::uint64_t bits = is_small ? std::bit_cast<std::uint64_t>(whole) : magnitude;
        fraction[k][lane] = bits & kFraction;
        biased[k][lane] = static_cast<std::int64_t>(bits >> 52) - (is_small ? 1074 : 0);
        largest[lane] = std::max(largest[lane], biased[k][lane]);
      }
    std::uint64_t lost[kMostLanes] = {};
    for (std::size_t lane = 0; lane < lanes; ++lane) exponent[lane] = kLargest - largest[lane];
    for (std::size_t k = 0; k < kNumbers; ++k)
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const std::uint64_t bits = std::bit_cast<std::uint64_t>(number[k][lane]);
        const std::int64_t to = biased[k][lane] + exponent[lane];
        const std::uint64_t moved = (bits & kSign) | static_cast<std::uint64_t>(to) << 52 | fraction[k][lane];
        const bool is_zero = (bits & ~kSign) == 0;
        number[k][lane] = std::bit_cast<double>(is_zero ? bits : moved);
        lost[lane] |= !is_zero && to < kLeast ? 1U : 0U;
      }
    if (!is_limited) std::fill_n(number[8], lanes, distances.alarm);  // it has no exponent
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      if (lost[lane] == 0) continue;
      left |= 1U << lane;
      for (auto& column : number) column[lane] = 0;
      number[4][lane] = 1;
    }
  }
  Lifted(const Lifted&) = delete;
  Lifted& operator=(const Lifted&) = delete;

  [[nodiscard]] SpherePairs pairs() const {
    return {{number[0], number[1], number[2], number[3]}, {number[4], number[5], number[6], number[7]}, kMostLanes};
  }

  /// Lengths in the pairs' own units back in those of the question; the lanes of those that have no such number there.
  /// Where a rounded length has one, which may be subnormal, what was rounded would be rounded to the same. A length
  /// that is certain is 0 or a normal number before: its terms are multiples of 2^-952.
  HWY_ATTR unsigned lower(double* column) const {
    const std::size_t lanes = hn::Lanes(D());
    std::uint64_t ordinary = 1;
    std::uint64_t lowered[kMostLanes];
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const std::uint64_t bits = std::bit_cast<std::uint64_t>(column[lane]);
      const std::int64_t to = static_cast<std::int64_t>(bits >> 52 & 0x7ff) - exponent[lane];
      const bool is_zero = bits << 1 == 0;
      lowered[lane] = is_zero ? bits : bits - (static_cast<std::uint64_t>(exponent[lane]) << 52);
      ordinary &= static_cast<std::uint64_t>(is_zero) |
                  (static_cast<std::uint64_t>(to >= 1) & static_cast<std::uint64_t>(to <= 2046));
    }
    unsigned outside = 0;
    for (std::size_t lane = 0; ordinary == 0 && lane < lanes; ++lane) {
      const std::uint64_t bits = std::bit_cast<std::uint64_t>(column[lane]);
      const std::int64_t to = static_cast<std::int64_t>(bits >> 52 & 0x7ff) - exponent[lane];
      if (bits << 1 == 0 || (to >= 1 && to <= 2046)) continue;
      const std::int64_t dropped = 1 - to;
      const std::uint64_t significand = (bits & kFraction) | (kFraction + 1);
      const bool is_there = dropped > 0 && dropped < 53 && std::countr_zero(significand) >= dropped;
      lowered[lane] = is_there ? (bits & kSign) | significand >> dropped : 0;
      outside |= (is_there ? 0U : 1U) << lane;
    }
    for (std::size_t lane = 0; lane < lanes; ++lane) column[lane] = std::bit_cast<double>(lowered[lane]);
    return outside;
  }

 private:
  static constexpr std::uint64_t kSign = std::uint64_t{1} << 63;
  static constexpr std::uint64_t kFraction = (std::uint64_t{1} << 52) - 1;
};

}  // namespace HWY_NAMESPACE
}  // namespace contact::kernel
HWY_AFTER_NAMESPACE();
#endif  // HWY_HAVE_FLOAT64 && HWY_NATIVE_FMA

#endif  // once a target
