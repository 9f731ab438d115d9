// A segment that crosses a triangle, or does not: what such pairs share of the exact truth.
#pragma once

#include "oracle/truth/cores.hpp"

namespace contact::oracle {

/// A segment and a triangle, of a question about a crossing.
struct Crossed {
  ExactCore segment;
  Triangle triangle;
};
[[nodiscard]] Crossed crossed(const Query& query);

/// `inward` is 1 where the triangle is the first shape, -1 where it is the second.
[[nodiscard]] CrossingTruth truth_of_crossing(const ExactCore& segment, const Triangle& triangle, int inward);

/// The square of how far a segment is from crossing where it does not, or the other way: the least of the distances
/// from it to the triangle's edges and from its ends to the triangle's plane.
[[nodiscard]] Rational distance2_to_change(const ExactCore& segment, const Triangle& triangle);

}  // namespace contact::oracle
