// What is true of two cores that overlap where they are parted along a claimed direction, the shortest way out or not.
#pragma once

#include <vector>

#include "oracle/truth/exact_truth.hpp"

namespace contact::oracle {

/// Two cores A and B, and n, from A to B: B moves along n until max n.a = min n.b. An engine has rounded its n, so each component may be off by `slack`.
class Separation {
 public:
  /// Domain: no half-space; n is not 0.
  Separation(const Convexes& shapes, const Point& n, const Rational& slack);

  [[nodiscard]] const Point& along() const { return along_; }
  /// (max n.a - min n.b) / |n|
  [[nodiscard]] const Exact& depth() const { return depth_; }
  /// How much that changes at most where n is off by the slack, and of length 1.
  [[nodiscard]] const Rational& depth_room() const { return depth_room_; }
  /// The square of how far a point is from those of A, or of B, that lie farthest along n, or against it: the least e such that it is at most e from the hull of
  /// the corners that are at most e short of the farthest.
  [[nodiscard]] Rational squared_off(int shape, const Point& x) const;
  /// The same of the middle of two such points.
  [[nodiscard]] Rational squared_off_middle(const Point& x) const;

 private:
  struct Corner {
    Point at;
    Rational missing;  ///< how far short of the farthest, for the n within the slack that is best for it
  };
  [[nodiscard]] static std::vector<Corner> corners_along(std::vector<Point> vertices, const Point& n,
                                                         const Rational& slack);

  Point along_;
  std::array<std::vector<Corner>, 2> corners_;  ///< of each core, the farthest first
  Exact depth_;
  Rational depth_room_;
};

}  // namespace contact::oracle
