// A segment that crosses a triangle, or does not: what such pairs share of the exact truth.
#pragma once

#include "oracle/truth/segments.hpp"

namespace contact::oracle {

/// `inward` is 1 where the triangle is the first shape, -1 where it is the second.
[[nodiscard]] ExactTruth truth_of_crossing(const Segment& segment, const Triangle& triangle, int inward);

[[nodiscard]] Witness witness_of(const CrossingTruth& crossing);

/// The square of how far a segment is from crossing where it does not, or the other way: the least of the distances
/// from it to the triangle's edges and from its ends to the triangle's plane.
[[nodiscard]] Rational distance2_to_change(const Segment& segment, const Triangle& triangle);

}  // namespace contact::oracle
