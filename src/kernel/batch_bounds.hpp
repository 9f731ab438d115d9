// The constants of the vector kernels: each bound is derived in docs/error-bounds.md under its own name, and held
// against what proofs proves to suffice.
#pragma once

#include <cstdint>
#include <limits>

#include "kernel/proved_bounds.hpp"

namespace contact::kernel {

constexpr double two_to(int exponent) {
  double power = 1;
  for (; exponent > 0; --exponent) power *= 2;
  for (; exponent < 0; ++exponent) power /= 2;
  return power;
}

/// For numbers with as many bits as Real's, and the exponents of double. Real is double; the tests' numbers are
/// shorter.
template <class Real>
struct FastBounds {
  static constexpr int kBits = std::numeric_limits<Real>::digits;  // p
  static constexpr double kUnit = two_to(-kBits);                  // u
  static constexpr double kUnitSquared = kUnit * kUnit;            // u^2
  /// The last bit of a significand, where it is as long as that of double and ends in zeros.
  static constexpr std::uint64_t kLastBit = std::uint64_t{1} << (std::numeric_limits<double>::digits - kBits);

  /// |D - reach^2| decides beyond this share of D + reach^2: 16 u. kFilterFloor covers products that underflow.
  static constexpr double kFilterGap = 16 * kUnit;
  static constexpr double kFilterFloor = 0x1p-950;

  /// Numbers of at least this magnitude lose nothing that matters where a product of theirs underflows.
  static constexpr double kLeast = 0x1p-900;
  static constexpr double kMost = 0x1p1020;
  /// A component of the normal of at least this magnitude has residuals that are normal numbers.
  static constexpr double kLeastComponent = 0x1p-960;
  /// A factor of that magnitude, or 0: no product of two underflows, so that a product is 0 where a factor is.
  static constexpr double kLeastFactor = 0x1p-450;
  /// More than any reach that is not plainly a hit, in units of the largest component of delta.
  static constexpr double kReachCap = 0x1p400;

  /// |error| of a normal's component, of |n|.
  static constexpr double kNormalError = 96 * kUnitSquared;
  /// |error| of a point, of |r n| and of the sum's high part; what rounding the ends of its interval adds included.
  static constexpr double kPointError = 128 * kUnitSquared;
  static constexpr double kPointSumError = 6 * kUnitSquared;
  /// |error| of a value, of sqrt D + T.
  static constexpr double kValueError = 160 * kUnitSquared;
  /// |error| of a value whose T is kept exactly: of sqrt D, and of the low part, what rounding the ends of its interval
  /// adds included.
  static constexpr double kRootError = 160 * kUnitSquared;
  static constexpr double kLowError = 4 * kUnit;

  /// fma(low, 1 + eta, high) = fma(low, 1 - eta, high) is the rounded sum where |error| <= eta u / 4 |high|.
  static constexpr double kNormalEta = 2048 * kUnit;
  static constexpr int kHalf = (kBits - 10) / 2;
  static constexpr double kSumEta = 1024 * kUnit * two_to(kHalf);
  /// The share of sqrt D + T, which is more than both radii, that must be left of a point and a value for kSumEta to
  /// hold.
  static constexpr double kUncancelled = two_to(-kHalf);

  /// E = D - T^2 near touching: |error| at most this times the power of two that is at most D.
  static constexpr double kNearError = 0x1p17 * kUnit * kUnitSquared;
  /// D and T^2 are near where they differ by at most this share of D.
  static constexpr double kNear = 0x1p-9;
  /// Sums with these times that power of two round to its two grids: whole numbers of 8 u and of 256 u^2.
  static constexpr double kFirstGrid = 6;
  static constexpr double kSecondGrid = 0x1.8p7 * kUnit;
  /// |error| of E / (sqrt D + T), of itself, beside that of E.
  static constexpr double kQuotientError = 512 * kUnitSquared;

  // Points and segments. w is from one to the other's start, |w| the sum of its components.

  /// D of a foot in plain arithmetic: its error beside kFilterGap's, of |w|^2, and what is lost where numbers are
  /// small.
  static constexpr double kFootGap = 40 * kUnit;
  static constexpr double kFootFloor = 0x1p-780;
  /// |error| of delta, of |w|.
  static constexpr double kFootError = 320 * kUnitSquared;
  /// |error| of a value and of a point beside a core, of the lengths in it, but for the core's and the turned normal's.
  static constexpr double kCoreError = 256 * kUnitSquared;
  /// The interval's ends are as much farther as this share of the low part, for errors of a share of the high one.
  static constexpr double kCoreEta = 8192 * kUnit;
  /// The least that delta is of its error, and the error of a normal's component for a delta's.
  static constexpr double kClear = 0x1p40;
  static constexpr double kTurn = 1.125;
  /// Bounds of |w|^2 and |v|^2: within them no product matters that underflows, and none overflows.
  static constexpr double kLeastSquare = 0x1p-680;
  static constexpr double kMostSquare = 0x1p600;

  // Two segments.

  /// |error| of a correction, of its length.
  static constexpr double kStepError = 128 * kUnit;
  /// Bounds of the squares together, and of the square of a direction along which a core moves.
  static constexpr double kLeastSize = 0x1p-400;
  static constexpr double kMostSize = 0x1p400;
  /// The reciprocal squared sine of the angle between the segments, where both cores move.
  static constexpr double kMostParallel = 0x1p20;
  /// The least third weight in a triangle: what rounding the others costs it is less.
  static constexpr double kLeastRest = 0x1p-40;

  // Planes and crossings.

  /// |error| of a signed distance from a plane, of the products in it over |n|, beside kCoreError's.
  static constexpr double kOverPlane = 54 * kUnitSquared;
  /// The least |n|^2 of a plane: what underflows of n.p is less than kLeast of |n|.
  static constexpr double kLeastNormalSquare = 0x1p-100;
  /// The least n.d of a crossing: no product that underflows matters beside it, numbers being below 2^250.
  static constexpr double kLeastThrough = 0x1p-300;
};

using ForDouble = FastBounds<double>;
static_assert(ForDouble::kUnit == 0x1p-53 && ForDouble::kUncancelled == 0x1p-21 && ForDouble::kSumEta == 0x1p-22);
// A filter's gap, and the floor under it.
static_assert(ForDouble::kFilterGap >= proved::kFilterGap && ForDouble::kFilterFloor >= proved::kFilterFloor);
// The proofs assume that what is smaller is not accepted.
static_assert(ForDouble::kLeast >= proved::kLeast && ForDouble::kLeastComponent >= proved::kLeastComponent &&
              ForDouble::kLeastFactor >= proved::kLeastFactor && ForDouble::kNear <= proved::kNear);
// The intervals' errors.
static_assert(ForDouble::kNormalError >= proved::kNormal);
static_assert(ForDouble::kPointError >= proved::kPointInterval &&
              ForDouble::kPointSumError >= proved::kPointSumInterval);
static_assert(ForDouble::kValueError >= proved::kValueOfS && ForDouble::kValueError >= proved::kValueOfT);
static_assert(ForDouble::kRootError >= proved::kRootInterval && ForDouble::kLowError >= proved::kLowInterval);
static_assert(ForDouble::kNearError >= proved::kNearError && ForDouble::kNearError >= proved::kNearSpread);
static_assert(ForDouble::kQuotientError >= proved::kNearQuotientInterval);
// The quick tests allow for eta u / 4 of what is left.
static_assert(ForDouble::kNormalEta * ForDouble::kUnit / 4 >= proved::kNormal);
static_assert(ForDouble::kSumEta * ForDouble::kUnit / 4 * ForDouble::kUncancelled >= proved::kUncancelledSum);

}  // namespace contact::kernel
