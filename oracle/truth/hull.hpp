// Of which vertices, edges and faces the convex hull of some points consists. Every oracle asks in numbers of its own: what is compared is the sign of a difference
// of coordinates, of an area or of a volume.
//
// Points are added one by one. A new one takes the place of the faces that it lies strictly beyond of. Faces are triangles, several of which may lie in one plane; a point
// that no longer is a corner may stay one of them, on an edge or in a face.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "oracle/truth/features.hpp"

namespace contact::oracle {

/// A hull by the places of some points among those given: its corners, and features by the places of these, vertices before edges before faces.
struct HullFeatures {
  std::vector<std::size_t> corners;
  std::vector<Feature> features;
  /// How many faces there are, seen from outside against the clock; none of what is flat.
  std::size_t faces = 0;
};

// What is asked, of points at places.
template <class Vec>
auto coordinate_behind(const std::vector<Vec>& at, std::size_t i, std::size_t j, std::size_t axis) {
  return at[j][axis] - at[i][axis];
}
template <class Vec>
Vec area_between(const std::vector<Vec>& at, std::size_t i, std::size_t j, std::size_t k) {
  const auto u = [&](std::size_t axis) { return at[j][axis] - at[i][axis]; };
  const auto v = [&](std::size_t axis) { return at[k][axis] - at[i][axis]; };
  return {u(1) * v(2) - u(2) * v(1), u(2) * v(0) - u(0) * v(2), u(0) * v(1) - u(1) * v(0)};
}
/// Above 0 where the last lies on the side that sees the others against the clock.
template <class Vec>
auto volume_between(const std::vector<Vec>& at, std::size_t i, std::size_t j, std::size_t k, std::size_t l) {
  const Vec n = area_between(at, i, j, k);
  const auto w = [&](std::size_t axis) { return at[l][axis] - at[i][axis]; };
  return n[0] * w(0) + n[1] * w(1) + n[2] * w(2);
}

/// sign(ask) is that of the number that ask(points) is, exactly.
template <class Sign>
class HullMaker {
 public:
  HullMaker(std::size_t count, Sign sign) : count_(count), sign_(std::move(sign)) {}

  [[nodiscard]] HullFeatures make() {
    order_.resize(count_);
    for (std::size_t k = 0; k < count_; ++k) order_[k] = k;
    const auto is_before = [&](std::size_t i, std::size_t j) { return compare(i, j) < 0; };
    std::sort(order_.begin(), order_.end(), is_before);
    const auto is_same = [&](std::size_t i, std::size_t j) { return compare(i, j) == 0; };
    order_.erase(std::unique(order_.begin(), order_.end(), is_same), order_.end());
    if (order_.size() == 1) return {order_, {features::vertex(0)}};
    // In lexicographic order the first and the last are corners, also of all that lie in a line.
    const auto third = std::find_if(order_.begin() + 1, order_.end() - 1, [&](std::size_t k) { return !in_line(k); });
    if (third == order_.end() - 1)
      return {{order_.front(), order_.back()}, {features::kSegment.begin(), features::kSegment.end()}};
    base_ = {order_.front(), order_.back(), *third};
    const auto fourth = std::find_if(order_.begin(), order_.end(), [&](std::size_t k) { return side(base_, k) != 0; });
    if (fourth == order_.end()) return in_plane();
    return solid(*fourth);
  }

 private:
  using Face = std::array<std::size_t, 3>;

  [[nodiscard]] int compare(std::size_t i, std::size_t j) const {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (const int order = sign_([&](const auto& at) { return coordinate_behind(at, i, j, axis); }); order != 0)
        return -order;
    return 0;
  }
  [[nodiscard]] bool in_line(std::size_t k) const {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (sign_([&](const auto& at) { return area_between(at, order_.front(), order_.back(), k)[axis]; }) != 0)
        return false;
    return true;
  }
  [[nodiscard]] int side(const Face& f, std::size_t k) const {
    if (std::find(f.begin(), f.end(), k) != f.end()) return 0;
    return sign_([&](const auto& at) { return volume_between(at, f[0], f[1], f[2], k); });
  }
  /// Above 0 where the way by three points in the plane of `base_` turns as that one does.
  [[nodiscard]] int turn(std::size_t i, std::size_t j, std::size_t k) const {
    return sign_([&](const auto& at) {
      const auto m = area_between(at, base_[0], base_[1], base_[2]);
      const auto n = area_between(at, i, j, k);
      return m[0] * n[0] + m[1] * n[1] + m[2] * n[2];
    });
  }

  /// Round the polygon: along one side of it in lexicographic order, and back along the other.
  [[nodiscard]] HullFeatures in_plane() const {
    HullFeatures found;
    auto& round = found.corners;
    const auto take = [&](std::size_t from, std::size_t k) {
      while (round.size() > from + 1 && turn(round[round.size() - 2], round.back(), k) <= 0) round.pop_back();
      round.push_back(k);
    };
    for (const std::size_t k : order_) take(0, k);
    const std::size_t half = round.size() - 1;
    for (std::size_t i = order_.size() - 1; i-- > 0;) take(half, order_[i]);
    round.pop_back();  // the first again
    const std::size_t n = round.size();
    for (std::size_t k = 0; k < n; ++k) found.features.push_back(features::vertex(k));
    for (std::size_t k = 0; k < n; ++k) found.features.push_back(features::edge(k, (k + 1) % n));
    for (std::size_t k = 2; k < n; ++k) found.features.push_back({3, {0, k - 1, k}});
    return found;
  }

  [[nodiscard]] HullFeatures solid(std::size_t fourth) const {
    auto [a, b, c] = base_;
    if (side(base_, fourth) > 0) std::swap(b, c);
    std::vector<Face> faces{{a, b, c}, {a, c, fourth}, {c, b, fourth}, {b, a, fourth}};
    for (const std::size_t k : order_) {
      const auto hidden =
          std::stable_partition(faces.begin(), faces.end(), [&](const Face& f) { return side(f, k) > 0; });
      const std::vector<Face> seen(faces.begin(), hidden);
      faces.erase(faces.begin(), hidden);
      const auto has = [&](std::size_t from, std::size_t to) {
        return std::any_of(seen.begin(), seen.end(), [&](const Face& f) {
          return (f[0] == from && f[1] == to) || (f[1] == from && f[2] == to) || (f[2] == from && f[0] == to);
        });
      };
      for (const Face& f : seen)
        for (std::size_t i = 0; i < 3; ++i)
          if (const std::size_t from = f[i], to = f[(i + 1) % 3]; !has(to, from)) faces.push_back({from, to, k});
    }
    HullFeatures found;
    std::vector<std::size_t> place(count_);
    for (const std::size_t k : order_) {
      if (std::none_of(faces.begin(), faces.end(),
                       [&](const Face& f) { return std::count(f.begin(), f.end(), k) > 0; }))
        continue;
      place[k] = found.corners.size();
      found.features.push_back(features::vertex(found.corners.size()));
      found.corners.push_back(k);
    }
    for (const Face& f : faces)
      for (std::size_t i = 0; i < 3; ++i)
        if (const std::size_t from = place[f[i]], to = place[f[(i + 1) % 3]]; from < to)
          found.features.push_back(features::edge(from, to));
    for (const Face& f : faces) found.features.push_back({3, {place[f[0]], place[f[1]], place[f[2]]}});
    found.faces = faces.size();
    return found;
  }

  std::size_t count_;
  Sign sign_;
  std::vector<std::size_t> order_;  ///< lexicographic, each place once
  Face base_{};                     ///< three that are in no line
};

}  // namespace contact::oracle
