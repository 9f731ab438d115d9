// A segment, which may be a point, and a half-space: what the pairs with a plane share of the exact truth.
#pragma once

#include "oracle/truth/segments.hpp"

namespace contact::oracle {

[[nodiscard]] ExactTruth truth_over_plane(const Segment& segment, const Plane& plane, Distances distances);

}  // namespace contact::oracle
