// The proved bounds of the kernels' numbers, from proofs/bounds.json: written by proofs/prove.py --write.
#pragma once

namespace contact::kernel::proved {

inline constexpr double kFilterGap = 0x1.400348p-51;              // 5.0002 u
inline constexpr double kFilterFloor = 0x1p-951;                  // 2^-951
inline constexpr double kScalarGap = 0x1.600832p-49;              // 22.002 u
inline constexpr double kScalarFloor = 0x1p-1000;                 // 2^-1000
inline constexpr double kLeastRoom = 0x1p-1010;                   // 2^-1010
inline constexpr double kCoreGap = 0x1.719999ap-46;               // 184.8 u
inline constexpr double kCoreSign = 0x1.400832p-49;               // 20.002 u
inline constexpr double kCoreHeight = 0x1.401064p-50;             // 10.002 u
inline constexpr double kLeast = 0x1p-900;                        // 2^-900
inline constexpr double kLeastComponent = 0x1p-960;               // 2^-960
inline constexpr double kLeastFactor = 0x1p-450;                  // 2^-450
inline constexpr double kNormal = 0x1.2fae148p-100;               // 75.92 u^2
inline constexpr double kPointInterval = 0x1.9666668p-100;        // 101.6 u^2
inline constexpr double kPointSumInterval = 0x1.00a3d8p-104;      // 4.01 u^2
inline constexpr double kValueOfS = 0x1.03ccccep-99;              // 129.9 u^2
inline constexpr double kValueOfT = 0x1.c0a3d8p-104;              // 7.01 u^2
inline constexpr double kUncancelledSum = 0x1.04p-99;             // 130 u^2
inline constexpr double kRootInterval = 0x1.eep-100;              // 123.5 u^2
inline constexpr double kLowInterval = 0x1.0020c8p-52;            // 2.001 u
inline constexpr double kNear = 0x1p-9;                           // 2^-9
inline constexpr double kNearError = 0x1.60b852p-147;             // 44.09 * 2^-152
inline constexpr double kNearSpread = 0x1.60cccdp-148;            // 22.05 * 2^-152
inline constexpr double kNearQuotientInterval = 0x1.a633334p-99;  // 211.1 u^2
inline constexpr double kPairNormalNeeded = 0x1.be8f5dp-102;      // 27.91 u^2
inline constexpr double kPairPointNeeded = 0x1.075c29p-101;       // 32.92 u^2
inline constexpr double kPairValueRootNeeded = 0x1.128f5dp-102;   // 17.16 u^2
inline constexpr double kPairValueLessNeeded = 0x1.00a3d8p-103;   // 8.02 u^2
inline constexpr double kPairLastSumNeeded = 0x1.0147bp-105;      // 2.01 u^2
inline constexpr double kSegmentProduct = 0x1.801064p-104;        // 6.001 u^2
inline constexpr double kSegmentSum = 0x1.8020c8p-105;            // 3.001 u^2
inline constexpr double kSegmentQuotient = 0x1.600832p-103;       // 11.001 u^2
inline constexpr double kSegmentDot = 0x1.3028f6p-102;            // 19.01 u^2
inline constexpr double kPlaneHeight = 0x1.6051ecp-103;           // 11.01 u^2

}  // namespace contact::kernel::proved
