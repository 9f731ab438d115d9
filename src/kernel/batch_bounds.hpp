// The constants of the vector kernels: each bound is derived in docs/error-bounds.md under its own name, and held
// against what docs/proofs proves to suffice.
#pragma once

#include "kernel/proved_bounds.hpp"

namespace contact::kernel::bounds {

inline constexpr double kUnit = 0x1p-53;          // u
inline constexpr double kUnitSquared = 0x1p-106;  // u^2

/// |D - reach^2| decides beyond this share of D + reach^2: 16 u. kFilterFloor covers products that underflow.
inline constexpr double kFilterGap = 16 * kUnit;
inline constexpr double kFilterFloor = 0x1p-950;

/// Numbers of at least this magnitude lose nothing that matters where a product of theirs underflows.
inline constexpr double kLeast = 0x1p-900;
inline constexpr double kMost = 0x1p1020;
/// A component of the normal of at least this magnitude has residuals that are normal numbers.
inline constexpr double kLeastComponent = 0x1p-960;
/// A factor of that magnitude, or 0: no product of two underflows, so that a product is 0 where a factor is.
inline constexpr double kLeastFactor = 0x1p-450;
/// More than any reach that is not plainly a hit, in units of the largest component of delta.
inline constexpr double kReachCap = 0x1p400;

/// |error| of a normal's component, of |n|.
inline constexpr double kNormalError = 96 * kUnitSquared;
/// |error| of a point, of |r n| and of the sum's high part; what rounding the ends of its interval adds included.
inline constexpr double kPointError = 128 * kUnitSquared;
inline constexpr double kPointSumError = 6 * kUnitSquared;
/// |error| of a value, of sqrt D + T.
inline constexpr double kValueError = 160 * kUnitSquared;
/// |error| of a value whose T is kept exactly: of sqrt D, and of the low part, what rounding the ends of its interval
/// adds included.
inline constexpr double kRootError = 160 * kUnitSquared;
inline constexpr double kLowError = 4 * kUnit;

/// fma(low, 1 + eta, high) = fma(low, 1 - eta, high) is the rounded sum where |error| <= eta 2^-55 |high|.
inline constexpr double kNormalEta = 0x1p-42;
inline constexpr double kSumEta = 0x1p-22;
/// The share of sqrt D + T, which is more than both radii, that must be left of a point and a value for kSumEta to
/// hold.
inline constexpr double kUncancelled = 0x1p-21;

/// E = D - T^2 near touching: |error| at most this times the power of two that is at most D.
inline constexpr double kNearError = 0x1p-142;
/// D and T^2 are near where they differ by at most this share of D.
inline constexpr double kNear = 0x1p-9;
/// |error| of E / (sqrt D + T), of itself, beside that of E.
inline constexpr double kQuotientError = 512 * kUnitSquared;

// A filter's gap, and the floor under it.
static_assert(kFilterGap >= proved::kFilterGap && kFilterFloor >= proved::kFilterFloor);
// The proofs assume that what is smaller is not accepted.
static_assert(kLeast >= proved::kLeast && kLeastComponent >= proved::kLeastComponent &&
              kLeastFactor >= proved::kLeastFactor && kNear <= proved::kNear);
// The intervals' errors.
static_assert(kNormalError >= proved::kNormal);
static_assert(kPointError >= proved::kPointInterval && kPointSumError >= proved::kPointSumInterval);
static_assert(kValueError >= proved::kValueOfS && kValueError >= proved::kValueOfT);
static_assert(kRootError >= proved::kRootInterval && kLowError >= proved::kLowInterval);
static_assert(kNearError >= proved::kNearError && kNearError >= proved::kNearSpread);
static_assert(kQuotientError >= proved::kNearQuotientInterval);
// The quick tests allow for eta 2^-55 of what is left.
static_assert(kNormalEta * 0x1p-55 >= proved::kNormal);
static_assert(kSumEta * 0x1p-55 * kUncancelled >= proved::kUncancelledSum);

}  // namespace contact::kernel::bounds
