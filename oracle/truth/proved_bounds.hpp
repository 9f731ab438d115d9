// The proved bounds of the oracle's double-double stage, from proofs/bounds.json: written by proofs/prove.py --write.
#pragma once

namespace contact::oracle::proved {

inline constexpr double kOracleProduct = 0x1.801064p-104;       // 6.001 u^2
inline constexpr double kOracleReciprocal = 0x1.000832p-103;    // 8.001 u^2
inline constexpr double kOracleRoot = 0x1.08f5c4p-104;          // 4.14 u^2
inline constexpr double kRadiusRounding = 0x1.0000000000008p0;  // 1 + 2^-49

}  // namespace contact::oracle::proved
