// A triangle, which may be a segment or a point: what the pairs with one share of the exact truth.
#pragma once

#include "oracle/truth/segments.hpp"

namespace contact::oracle {

using Vertices = std::array<Point, 3>;
[[nodiscard]] Vertices vertices_of(const Triangle& triangle);

/// The point of a triangle that is nearest to another one.
[[nodiscard]] Point nearest_on_triangle(const Point& c, const Vertices& vertices);

}  // namespace contact::oracle
