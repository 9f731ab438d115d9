// A polytope around 0 that grows corner by corner: Van den Bergen's expanding polytope algorithm, in integers or in plain double.
#pragma once

#include <algorithm>
#include <array>
#include <boost/container/small_vector.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace contact::kernel {

/// Triangles that close a surface. In integers it is the boundary of the convex hull of all corners, which may lie in planes and on lines. In plain double a new
/// corner may be taken to lie beyond a face where it does not, but each edge is still led through as often one way as the other.
/// `Nearness` gives a number that grows with height^2 / square, and says from which difference on that is so.
template <class Number, class Nearness>
class ExpandingPolytope {
 public:
  using Vector = std::array<Number, 3>;

  struct Face {
    std::array<std::size_t, 3> corners;  ///< counterclockwise, seen from outside
    Vector normal;                       ///< of twice the triangle's area
    Number square;                       ///< of the normal
    Number height;                       ///< of the corners along the normal
    double nearness;

    [[nodiscard]] bool is_nearer_than(const Face& other) const {
      if (std::abs(nearness - other.nearness) > Nearness::kCertain) return nearness < other.nearness;
      return height * height * other.square < other.height * other.height * square;
    }
    [[nodiscard]] bool is_below(const Vector& x) const { return product(normal, x) > height; }
  };

  /// Domain: a tetrahedron with a volume, and 0 in it.
  explicit ExpandingPolytope(const std::array<Vector, 4>& tetrahedron)
      : corners_(tetrahedron.begin(), tetrahedron.end()) {
    const bool is_turned = Face{face(0, 1, 2)}.is_below(corners_[3]);
    for (const auto& [i, j, k] : {std::array<std::size_t, 3>{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}})
      faces_.push_back(is_turned ? face(i, k, j) : face(i, j, k));
  }

  [[nodiscard]] const Vector& corner(std::size_t k) const { return corners_[k]; }
  [[nodiscard]] const auto& faces() const { return faces_; }
  /// The face that is nearest to 0. Domain: there is one.
  [[nodiscard]] const Face& nearest() const {
    double least = std::numeric_limits<double>::infinity();
    for (const Face& face : faces_) least = std::min(least, face.nearness);
    const Face* best = nullptr;
    for (const Face& face : faces_)
      if (face.nearness <= least + Nearness::kCertain && (best == nullptr || face.is_nearer_than(*best))) best = &face;
    return best == nullptr ? faces_.front() : *best;  // none is no number
  }
  /// Takes a face out of the list, beyond which no corner will lie.
  Face finished(const Face& face) {
    const auto at = faces_.begin() + (&face - faces_.data());
    Face taken = std::move(*at);
    faces_.erase(at);
    return taken;
  }
  /// Puts the corner, and triangles between it and the horizon, in place of the faces that it lies beyond; whether there are any. No triangle is one without area: on the line
  /// of an edge of the horizon the corner would not lie beyond a face there.
  bool insert(Vector corner) {
    horizon_.clear();
    const auto gone = std::remove_if(faces_.begin(), faces_.end(), [&](const Face& face) {
      if (!face.is_below(corner)) return false;
      for (std::size_t k = 0; k < 3; ++k) {
        const Edge edge{face.corners[k], face.corners[(k + 1) % 3]};
        const auto back = std::find(horizon_.begin(), horizon_.end(), Edge{edge.second, edge.first});
        if (back == horizon_.end())
          horizon_.push_back(edge);
        else
          horizon_.erase(back);
      }
      return true;
    });
    if (gone == faces_.end()) return false;
    faces_.erase(gone, faces_.end());
    corners_.push_back(std::move(corner));
    for (const auto& [from, to] : horizon_) faces_.push_back(face(from, to, corners_.size() - 1));
    return true;
  }

 private:
  using Edge = std::pair<std::size_t, std::size_t>;

  [[nodiscard]] static Number product(const Vector& x, const Vector& y) {
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
  }
  [[nodiscard]] Face face(std::size_t i, std::size_t j, std::size_t k) const {
    const Vector& o = corners_[i];
    const auto from_first = [&](const Vector& x) { return Vector{x[0] - o[0], x[1] - o[1], x[2] - o[2]}; };
    const Vector u = from_first(corners_[j]);
    const Vector w = from_first(corners_[k]);
    Face made{{i, j, k}, {u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]}, {}, {}, 0};
    made.square = product(made.normal, made.normal);
    made.height = product(made.normal, o);
    made.nearness = Nearness::of(made.height, made.square);
    return made;
  }

  boost::container::small_vector<Vector, 32> corners_;
  boost::container::small_vector<Face, 64> faces_;
  boost::container::small_vector<Edge, 32> horizon_;
};

}  // namespace contact::kernel
