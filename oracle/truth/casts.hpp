// Rays that are cast: what these pairs share of the exact truth.
#pragma once

#include "oracle/truth/exact_truth.hpp"

namespace contact::oracle {

[[nodiscard]] Witness witness_of(const CastTruth& cast);

/// How far a question is from the other answer, exactly: by how much its shape would have to grow, on every side, for
/// the ray to hit it; or to shrink, for a miss. What has no inside to shrink is moved instead, past an end of the ray
/// or off its line.
[[nodiscard]] Exact distance_to_change(const CastAt<Ball>& shapes, bool is_hit);
[[nodiscard]] Exact distance_to_change(const CastAt<Box>& shapes, bool is_hit);
[[nodiscard]] Exact distance_to_change(const CastAt<Capsule>& shapes, bool is_hit);
[[nodiscard]] Exact distance_to_change(const CastAt<Triangle>& shapes, bool is_hit);
[[nodiscard]] Exact distance_to_change(const CastAt<Plane>& shapes, bool is_hit);

}  // namespace contact::oracle
