// Several points of one contact: where each may lie, and how deep the shapes are in each other there.
// docs/specification.md#rule-manifold is the law.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "oracle/truth/cores.hpp"
#include "oracle/truth/query.hpp"

namespace contact::oracle {

/// Whether contacts of this pair can have several points: two shapes that reach into each other.
[[nodiscard]] bool has_manifold(Pair pair);

/// The surfaces of two shapes that look at each other along n, from the first shape to the second: each is that of a core, moved by the radius along n.
class Manifold {
 public:
  /// Domain: has_manifold(query.pair), n has the length 1. An engine may have rounded it: what looks along n must do so beside `slack` in each component.
  Manifold(const Query& query, const Point& n, const Rational& slack);

  /// How far a point that says this depth is from where it is right, squared. The point is said to lie on the first surface, on the second or in
  /// the middle between both: the best counts. From there both surfaces must lie where the depth says, along n.
  [[nodiscard]] Rational squared_off(const Point& x, const Rational& depth) const;

 private:
  [[nodiscard]] Rational squared_off_surface(std::size_t shape, const Point& x) const;

  Point n_;
  std::array<Rational, 2> radius_;
  std::array<std::vector<ExactCore>, 2> surface_;  ///< in pieces: faces, edges, or a vertex
  std::optional<Plane> plane_ = {};                ///< in the place of the second
};

}  // namespace contact::oracle
