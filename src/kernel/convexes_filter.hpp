// Whether two convex cores are within reach of each other, in plain double, where it can prove so: most questions end here.
//
// A miss is proved by a direction along which every corner of B lies farther than the reach from every corner of A. A hit is proved where 0 lies below every
// facet of A - B, by a point of each core, sums of corners with parts >= 0, or by a tetrahedron of corners of B - A that 0 lies in. The directions of the facets
// are tried first; then Gilbert, Johnson and Keerthi's algorithm says which direction and which corners; that it may say the wrong ones costs time, and no proof
// rests on it.
//
// Bounds, with u = 2^-53, S the largest coordinate and e how far a coordinate may be off, of A and B together: a sum of three products of a direction v
// is off by less than |v|_1 (e + 8 u S), a point of a simplex in each coordinate by less than e + 32 u S, a determinant of differences of corners by less
// than 20 R^2 (e + u R) + 64 u R^3, R being the largest coordinate of these. What is used below is at least twice as wide.
// Domain: round to nearest.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>

#include "contact/pairs.hpp"
#include "kernel/expanding_polytope.hpp"

namespace contact::kernel {

/// A core by its corners, at most so many, each coordinate within `error` of what it is.
template <std::size_t kMost>
struct NearCorners {
  using Vector = std::array<double, 3>;
  std::array<Vector, kMost> corners;
  std::size_t count = 0;
  Vector base{};    ///< in the middle, about
  double size = 0;  ///< the largest coordinate, or infinity where a bound does not hold
  double radius = 0;
  double error = 0;

  [[nodiscard]] const Vector& corner(std::size_t k) const { return corners[k]; }
  void add(const Vector& x) {
    corners[count++] = x;
    size = std::max({size, std::abs(x[0]), std::abs(x[1]), std::abs(x[2])});
  }
};
/// A hull: its vertices, where they are given. Maybe some are no corners, or one is there twice.
struct NearHull {
  using Vector = std::array<double, 3>;
  const Vector3* vertices;
  std::size_t count;
  Vector base{};
  double size = 0;
  double radius;
  static constexpr double error = 0;

  [[nodiscard]] Vector corner(std::size_t k) const { return {vertices[k][0], vertices[k][1], vertices[k][2]}; }
};
/// A core with ways between its corners. What is no triangle is the middle, `base`, and any part of each way, forth or back: three of a box, one of a segment. A
/// triangle is its first corner, `base`, and ways from this to the others and between these. A box has axes too, along which its ways lead as far as `half` says; its
/// corners are written nowhere.
struct NearCore : NearCorners<3> {
  std::array<Vector, 3> ways{};
  std::array<Vector, 3> axes;  ///< of a box
  std::array<double, 3> half;  ///< of a box

  [[nodiscard]] bool is_triangle() const { return count == 3; }
  [[nodiscard]] bool is_box() const { return count == 8; }
  /// How many ways there are, each in a direction of its own.
  [[nodiscard]] std::size_t directions() const { return count < 3 ? count - 1 : 3; }
  /// A corner; of a box that whose bits say of each way whether it leads forth.
  [[nodiscard]] Vector corner(std::size_t k) const {
    if (!is_box()) return corners[k];
    Vector at = base;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double sign = k >> axis & 1 ? 1 : -1;
      for (std::size_t i = 0; i < 3; ++i) at[i] += sign * ways[axis][i];
    }
    return at;
  }
  /// Makes it a box, of its base, axes and half lengths.
  void set_box() {
    count = 8;
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t i = 0; i < 3; ++i) ways[axis][i] = half[axis] * axes[axis][i];
    for (std::size_t i = 0; i < 3; ++i)
      size = std::max(size, std::abs(base[i]) + std::abs(ways[0][i]) + std::abs(ways[1][i]) + std::abs(ways[2][i]));
    error =
        0x1p-48 * (std::max({std::abs(base[0]), std::abs(base[1]), std::abs(base[2])}) + half[0] + half[1] + half[2]);
  }
};
/// Whether the facets of A - B are made by ways of both.
template <class A, class B>
inline constexpr bool kHaveWays = std::same_as<A, NearCore>&& std::same_as<B, NearCore>;

/// Between these no product of three numbers leaves the range, nor is what underflows as large as a bound.
constexpr double kLargestNear = 0x1p200;
constexpr double kSmallestNear = 0x1p-200;
inline bool is_near_range(double x) { return x > kSmallestNear && x < kLargestNear; }

namespace near {

using Vector = NearCore::Vector;
[[gnu::always_inline]] inline Vector vector(const Vector3& x) { return {x[0], x[1], x[2]}; }
[[gnu::always_inline]] inline Vector difference(const Vector& x, const Vector& y) {
  return {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
}
[[gnu::always_inline]] inline Vector cross(const Vector& x, const Vector& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}
[[gnu::always_inline]] inline double dot(const Vector& x, const Vector& y) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}
[[gnu::always_inline]] inline Vector middle(const Vector& x, const Vector& y) {
  return {x[0] / 2 + y[0] / 2, x[1] / 2 + y[1] / 2, x[2] / 2 + y[2] / 2};
}
/// x + part (y - x), as parts of both: part in [0, 1].
[[gnu::always_inline]] inline Vector between(const Vector& x, double part, const Vector& y) {
  return {(1 - part) * x[0] + part * y[0], (1 - part) * x[1] + part * y[1], (1 - part) * x[2] + part * y[2]};
}
[[gnu::always_inline]] inline double largest(const Vector& x) {
  return std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2])});
}

}  // namespace near

// Middles and halves of what is given are rounded, corners then are not: no more than `error`, where they are used together.

inline NearCore near_core(const Ball& ball) {
  NearCore core;
  core.add(core.base = near::vector(ball.center));
  core.radius = ball.radius;
  return core;
}
inline NearCore near_core(const Capsule& capsule) {
  NearCore core;
  core.add(near::vector(capsule.start));
  core.add(near::vector(capsule.end));
  core.base = near::middle(core.corners[0], core.corners[1]);
  core.ways[0] = near::difference(core.corners[1], core.base);
  core.radius = capsule.radius;
  core.error = 0x1p-52 * core.size;
  return core;
}
inline NearCore near_core(const Triangle& triangle) {
  NearCore core;
  for (const Vector3& x : triangle.vertices) core.add(near::vector(x));
  core.base = core.corners[0];
  core.ways = {near::difference(core.corners[1], core.base), near::difference(core.corners[2], core.base),
               near::difference(core.corners[2], core.corners[1])};
  return core;
}
inline NearCore near_core(const Box& box) {
  NearCore core;
  core.base = near::middle(near::vector(box.min), near::vector(box.max));
  core.axes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  // 0 where it has no extent there, and nowhere else.
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    core.half[axis] = std::max(box.max[i] - core.base[axis], core.base[axis] - box.min[i]);
  }
  core.set_box();
  return core;
}
inline NearCore near_core(const Obb& box) {
  NearCore core;
  const auto& [x, y, z, w] = box.orientation;
  const double N = x * x + y * y + z * z + w * w;
  const double inverse = 1 / N;
  // Each number of the rotation is off by less than 10 u, each corner by 15 u (|c| + the sum of the extents).
  core.axes = {
      {{(w * w + x * x - y * y - z * z) * inverse, 2 * (x * y + w * z) * inverse, 2 * (x * z - w * y) * inverse},
       {2 * (x * y - w * z) * inverse, (w * w - x * x + y * y - z * z) * inverse, 2 * (y * z + w * x) * inverse},
       {2 * (x * z + w * y) * inverse, 2 * (y * z - w * x) * inverse, (w * w - x * x - y * y + z * z) * inverse}}};
  core.base = near::vector(box.center);
  core.half = near::vector(box.extents);
  core.set_box();
  if (!is_near_range(near::largest({std::abs(x), std::abs(y), std::max(std::abs(z), std::abs(w))})))
    core.size = std::numeric_limits<double>::infinity();
  return core;
}

template <HullOfVertices Shape>
inline NearHull near_core(const Shape& hull) {
  NearHull core{hull.vertices.data(), hull.vertices.size(), {}, 0, radius_of(hull)};
  for (const Vector3& x : hull.vertices)
    core.size = std::max(core.size, std::max(std::max(std::abs(x[0]), std::abs(x[1])), std::abs(x[2])));
  core.base = near::middle(core.corner(0), core.corner(core.count / 2));
  return core;
}
inline NearCore near_core(const Plane& /*plane*/) { return {}; }  // it has no corners

enum class NearSide { miss, hit, unknown };

/// The point of a simplex of corners of B - A that is nearest to 0, as plain double finds it.
class NearSimplex {
 public:
  using Vector = NearCore::Vector;
  explicit NearSimplex(const Vector& corner) : corners_{corner}, count_(1), at_(corner) {}

  /// A point of the simplex, a sum of corners with parts > 0.
  [[nodiscard]] const Vector& at() const { return at_; }
  [[nodiscard]] bool has(const Vector& corner) const {
    return std::find(corners_.begin(), corners_.begin() + count_, corner) != corners_.begin() + count_;
  }
  /// Whether 0 surely lies in it, where the cores are off by `error`: on the inner side of each of its sides, by a determinant. Domain: is_whole().
  [[nodiscard]] bool surrounds(double error) const {
    double size = 0;
    for (const Vector& corner : corners_) size = std::max(size, near::largest(corner));
    return least_part_ > (40 * error + 0x1p-45 * size) * size * size;
  }
  [[nodiscard]] bool is_whole() const { return count_ == 4; }
  /// Domain: is_whole().
  [[nodiscard]] const std::array<Vector, 4>& tetrahedron() const { return corners_; }

  /// Takes another corner, and of all the fewest that the nearest point lies between.
  void add(const Vector& corner) {
    const std::size_t last = count_;
    corners_[count_++] = corner;
    // Ways to the others, and the products of these with each other and of 0 with them.
    std::array<Vector, 3> way;
    std::array<std::array<double, 3>, 3> products;
    std::array<double, 3> against;
    for (std::size_t k = 0; k < last; ++k) {
      way[k] = near::difference(corners_[k], corner);
      against[k] = -near::dot(corner, way[k]);
      for (std::size_t i = 0; i <= k; ++i) products[i][k] = near::dot(way[i], way[k]);
    }
    double best = near::dot(corner, corner);
    at_ = corner;
    unsigned kept = 0;
    const auto take = [&](unsigned others, const Vector& at) {
      const double square = near::dot(at, at);
      if (square < best) best = square, at_ = at, kept = others;
    };
    for (std::size_t k = 0; k < last; ++k)
      if (against[k] > 0 && against[k] < products[k][k]) {
        const double part = against[k] / products[k][k];
        take(1U << k, near::between(corner, part, corners_[k]));
      }
    for (std::size_t k = 1; k < last; ++k)
      for (std::size_t i = 0; i < k; ++i) {
        const double whole = products[i][i] * products[k][k] - products[i][k] * products[i][k];
        const double of_i = against[i] * products[k][k] - against[k] * products[i][k];
        const double of_k = against[k] * products[i][i] - against[i] * products[i][k];
        const double of_last = whole - of_i - of_k;
        if (!(whole > 0 && of_i > 0 && of_k > 0 && of_last > 0)) continue;
        const double inverse = 1 / (of_i + of_k + of_last);
        Vector at;
        for (std::size_t x = 0; x < 3; ++x)
          at[x] = of_i * inverse * corners_[i][x] + of_k * inverse * corners_[k][x] + of_last * inverse * corner[x];
        take(1U << i | 1U << k, at);
      }
    if (last == 3 && lies_around()) at_ = {0, 0, 0}, kept = 7;
    std::size_t left = 0;
    for (std::size_t k = 0; k < last; ++k)
      if (kept >> k & 1) corners_[left++] = corners_[k];
    corners_[left++] = corner;
    count_ = left;
  }

 private:
  /// Whether 0 lies in the tetrahedron: each part is the volume that 0 spans with a side.
  [[nodiscard]] bool lies_around() {
    const auto volume = [&](std::size_t i, std::size_t j, std::size_t k) {
      return near::dot(corners_[i], near::cross(corners_[j], corners_[k]));
    };
    std::array<double, 4> part{volume(1, 2, 3), -volume(0, 2, 3), volume(0, 1, 3), -volume(0, 1, 2)};
    if (part[0] < 0)
      for (double& x : part) x = -x;
    least_part_ = *std::min_element(part.begin(), part.end());
    return least_part_ > 0;
  }

  std::array<Vector, 4> corners_{};
  std::size_t count_;
  Vector at_;
  double least_part_ = 0;
};

constexpr double kMore = 1 + 0x1p-48;
constexpr double kLess = 1 - 0x1p-48;

/// What two cores are asked about, in plain double: how far a number may be off, and how near is a hit.
struct NearScale {
  double size;
  double error;
  double reach;

  template <class A, class B>
  NearScale(const A& a, const B& b, double alarm)
      : size(std::max(a.size, b.size)), error(a.error + b.error), reach(alarm + a.radius + b.radius) {}
  /// Whether the bounds hold.
  [[nodiscard]] bool holds() const { return is_near_range(size) && reach < kLargestNear; }
};

/// A direction that facets of A - B may face: across two ways u and w, both of one core, which span a face of it, or the first of A and the second of B.
struct NearAxis {
  bool of_a;
  bool of_b;
  std::size_t u;
  std::size_t w;
};

/// A facet of A - B: it faces along the axis, u x w, or back.
struct NearFacet {
  NearAxis axis;
  bool is_back;
};

/// How deep two cores overlap along each direction that a facet of A - B may face, one way and the other, and how far that may be off; and which is least.
///   Each way is off by e' = 4 e + 2^-50 S in each coordinate, N = u x w by d = 4 (|u| + |w|) e', n = N / |N| by 4 d / |N|, what is farthest along n by
///   16 d S / |N|, and sums of products with n by 14 e + 150 u S. What is used is wider.
class NearDepths {
 public:
  [[gnu::always_inline]] NearDepths(const NearCore& a, const NearCore& b, const NearScale& scale) {
    add_faces(a, true);
    add_faces(b, false);
    for (std::size_t i = 0; i < a.directions(); ++i)
      for (std::size_t j = 0; j < b.directions(); ++j) add({true, true, i, j}, a.ways[i], b.ways[j]);
    const std::size_t padded = (count_ + 3) / 4 * 4;  // whole vectors; what is computed too much is read by nobody
    const Vector between = near::difference(b.base, a.base);
    std::array<double, kMost> low_a;
    std::array<double, kMost> high_a;
    std::array<double, kMost> low_b;
    std::array<double, kMost> high_b;
    extents(a, padded, low_a, high_a);
    extents(b, padded, low_b, high_b);
    const double off_way = 4 * scale.error + 0x1p-50 * scale.size;
    const double off_sums = 16 * (scale.error + 0x1p-48 * scale.size);
    // Loops that the compiler makes vectors of: none of a root, none of what a number decides.
    std::array<double, kMost> lengths;
    for (std::size_t k = 0; k < padded; ++k) lengths[k] = along(k, {x_[k], y_[k], z_[k]});
    for (std::size_t k = 0; k < padded; ++k) lengths[k] = std::sqrt(lengths[k]);
    for (std::size_t k = 0; k < padded; ++k) {
      const double inverse = 1 / lengths[k];
      const double apart = along(k, between);
      const double off_normal = 4 * ways_[k] * off_way;
      forth_[k] = (high_a[k] - low_b[k] - apart) * inverse;
      back_[k] = (high_b[k] - low_a[k] + apart) * inverse;
      off_[k] = 32 * off_normal * scale.size * inverse + off_sums;
      excess_[k] = lengths[k] - 0x1p10 * off_normal;
    }
    for (std::size_t k = 0; k < padded; ++k)
      off_[k] = excess_[k] > 0 ? off_[k] : std::numeric_limits<double>::infinity();
  }

  /// Whether the cores are proved to overlap, or to be farther apart than the reach.
  [[nodiscard, gnu::always_inline]] NearSide side(double reach) const {
    bool may_meet = true;
    bool surely_meet = count_ > 0;
    for (std::size_t k = 0; k < count_; ++k) {
      const double least = std::min(forth_[k], back_[k]);
      may_meet &= !(least + off_[k] < -reach * kMore);
      surely_meet &= least - off_[k] > 0;
    }
    return !may_meet ? NearSide::miss : surely_meet ? NearSide::hit : NearSide::unknown;
  }

  /// The facet that 0 is nearest to; nothing where another may be as near. Domain: side() is a hit.
  [[nodiscard, gnu::always_inline]] std::optional<NearFacet> least() const {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < count_; ++k)
      if (const double depth = std::min(forth_[k], back_[k]); depth < least) best = k, least = depth;
    const double most = least + off_[best];
    std::size_t as_near = 0;
    for (std::size_t k = 0; k < count_; ++k) {
      as_near += forth_[k] - off_[k] > most ? 0 : 1;
      as_near += back_[k] - off_[k] > most ? 0 : 1;
    }
    if (as_near != 1) return std::nullopt;
    return NearFacet{axes_[best], back_[best] < forth_[best]};
  }

 private:
  using Vector = NearCore::Vector;
  static constexpr std::size_t kMost = 16;

  [[gnu::always_inline]] void add(const NearAxis& axis, const Vector& u, const Vector& w) {
    axes_[count_] = axis;
    x_[count_] = u[1] * w[2] - u[2] * w[1];
    y_[count_] = u[2] * w[0] - u[0] * w[2];
    z_[count_] = u[0] * w[1] - u[1] * w[0];
    ways_[count_++] = near::largest(u) + near::largest(w);
  }
  [[gnu::always_inline]] void add_faces(const NearCore& core, bool is_a) {
    if (core.count < 3) return;
    add({is_a, !is_a, 0, 1}, core.ways[0], core.ways[1]);
    if (core.is_triangle()) return;
    add({is_a, !is_a, 1, 2}, core.ways[1], core.ways[2]);
    add({is_a, !is_a, 2, 0}, core.ways[2], core.ways[0]);
  }
  [[nodiscard]] double along(std::size_t k, const Vector& x) const {
    return x_[k] * x[0] + y_[k] * x[1] + z_[k] * x[2];
  }
  /// How far a core reaches along each axis from its base.
  [[gnu::always_inline]] void extents(const NearCore& core, std::size_t padded, std::array<double, kMost>& low,
                                      std::array<double, kMost>& high) const {
    if (core.is_triangle())
      for (std::size_t k = 0; k < padded; ++k) {
        const double u = along(k, core.ways[0]);
        const double w = along(k, core.ways[1]);
        low[k] = std::min(0.0, std::min(u, w));
        high[k] = std::max(0.0, std::max(u, w));
      }
    else
      for (std::size_t k = 0; k < padded; ++k) {
        high[k] =
            std::abs(along(k, core.ways[0])) + std::abs(along(k, core.ways[1])) + std::abs(along(k, core.ways[2]));
        low[k] = -high[k];
      }
  }

  std::array<NearAxis, kMost> axes_;
  std::size_t count_ = 0;
  std::array<double, kMost> x_{};
  std::array<double, kMost> y_{};
  std::array<double, kMost> z_{};
  std::array<double, kMost> ways_{};
  std::array<double, kMost> forth_;
  std::array<double, kMost> back_;
  std::array<double, kMost> off_;
  std::array<double, kMost> excess_;  ///< of the length of a normal over what its direction needs
};

/// The same of two boxes, by the products of their axes: a_i.b_j, off by less than 40 u, and those of the way between the middles, off by 38 u S, S being 2^48 times the error of both. The depth along
/// a face's axis is off by less than 128 u S; across two edges, times the length m of a_i x b_j, by 300 u S, m by 60 u, and so the depth by 480 u S / m. What is used is at least
/// twice as wide.
class NearBoxes {
 public:
  [[gnu::always_inline]] NearBoxes(const NearCore& a, const NearCore& b, const NearScale& scale)
      : a_(a), b_(b), error_(scale.error) {
    const Vector between = near::difference(b.base, a.base);
    for (std::size_t i = 0; i < 3; ++i) {
      shift_[i] = near::dot(a.axes[i], between);
      shift_[3 + i] = near::dot(b.axes[i], between);
      for (std::size_t j = 0; j < 3; ++j) cosine_[i][j] = near::dot(a.axes[i], b.axes[j]);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      reach_[i] = reach_[3 + i] = 0;
      for (std::size_t j = 0; j < 3; ++j) {
        reach_[i] += b.half[j] * std::abs(cosine_[i][j]);
        reach_[3 + i] += a.half[j] * std::abs(cosine_[j][i]);
      }
      reach_[i] += a.half[i];
      reach_[3 + i] += b.half[i];
    }
  }

  /// Whether the boxes are proved to overlap, or to be farther apart than the reach.
  [[nodiscard, gnu::always_inline]] NearSide side(double reach) {
    const double off_face = 16 * error_;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < kFaces; ++k) least = std::min(least, reach_[k] - std::abs(shift_[k]));
    if (least + off_face < -reach * kMore) return NearSide::miss;
    bool surely_meet = least > off_face;
    bool may_meet = true;
    const double off_edge = 32 * error_;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        const std::size_t k = kFaces + 3 * i + j;
        const std::size_t i1 = (i + 1) % 3;
        const std::size_t i2 = (i + 2) % 3;
        const std::size_t j1 = (j + 1) % 3;
        const std::size_t j2 = (j + 2) % 3;
        const double x = cosine_[i1][j];
        const double y = cosine_[i2][j];
        length_[k - kFaces] = x * x + y * y;
        shift_[k] = x * shift_[i2] - y * shift_[i1];
        reach_[k] = a_.half[i1] * std::abs(y) + a_.half[i2] * std::abs(x) + b_.half[j1] * std::abs(cosine_[i][j2]) +
                    b_.half[j2] * std::abs(cosine_[i][j1]);
      }
    for (double& x : length_) x = std::sqrt(x);
    for (std::size_t k = 0; k < kEdges; ++k) {
      const double depth = reach_[kFaces + k] - std::abs(shift_[kFaces + k]);
      may_meet &= !(depth + off_edge < -reach * kMore * (length_[k] + 0x1p-46));
      // Without an edge there is no facet.
      surely_meet &= (depth > off_edge && has_direction(k)) || !has_edges(k);
    }
    return !may_meet ? NearSide::miss : surely_meet ? NearSide::hit : NearSide::unknown;
  }

  /// The directions of which one may be that of the facet that 0 is nearest to, as bits: the axes of A, those of B, and across each of A those of B. Domain: side() was asked once, and
  /// the boxes may meet.
  [[nodiscard, gnu::always_inline]] unsigned candidates() {
    std::array<double, kEdges> inverse;
    for (std::size_t k = 0; k < kEdges; ++k) inverse[k] = 1 / length_[k];
    off_.fill(16 * error_);
    for (std::size_t k = 0; k < kEdges; ++k) {
      reach_[kFaces + k] *= inverse[k];
      shift_[kFaces + k] *= inverse[k];
      off_[kFaces + k] = 64 * error_ * inverse[k];
    }
    double most = std::numeric_limits<double>::infinity();
    unsigned known = 0;
    for (std::size_t k = 0; k < kAll; ++k) {
      if (k >= kFaces && !has_direction(k - kFaces)) continue;
      known |= 1U << k;
      most = std::min(most, reach_[k] - std::abs(shift_[k]) + off_[k]);
    }
    unsigned found = 0;
    for (std::size_t k = 0; k < kAll; ++k) {
      const bool is_deeper = known >> k & 1 ? reach_[k] - std::abs(shift_[k]) - off_[k] > most : !has_edges(k - kFaces);
      found |= is_deeper ? 0 : 1U << k;
    }
    return found;
  }
  /// The facet that 0 is nearest to; nothing where another may be as near. Domain: side() is a hit.
  [[nodiscard, gnu::always_inline]] std::optional<NearFacet> least() {
    const unsigned found = candidates();
    const auto best = static_cast<std::size_t>(std::countr_zero(found));
    if (!std::has_single_bit(found) || !(std::abs(shift_[best]) > off_[best] * kMore)) return std::nullopt;
    const NearAxis axis = best < kFaces ? NearAxis{best < 3, best >= 3, (best + 1) % 3, (best + 2) % 3}
                                        : NearAxis{true, true, (best - kFaces) / 3, (best - kFaces) % 3};
    return NearFacet{axis, shift_[best] < 0};
  }

 private:
  using Vector = NearCore::Vector;
  static constexpr std::size_t kFaces = 6;
  static constexpr std::size_t kEdges = 9;
  static constexpr std::size_t kAll = kFaces + kEdges;

  [[nodiscard]] bool has_edges(std::size_t k) const { return a_.half[k / 3] != 0 && b_.half[k % 3] != 0; }
  /// Whether edges are surely not along each other.
  [[nodiscard]] bool has_direction(std::size_t k) const { return length_[k] > 0x1p-20 && has_edges(k); }

  const NearCore& a_;
  const NearCore& b_;
  double error_;
  std::array<std::array<double, 3>, 3> cosine_;
  std::array<double, kAll> reach_;  ///< of both boxes along each direction, together
  std::array<double, kAll> shift_;  ///< from the middle of A to that of B
  std::array<double, kEdges> length_;
  std::array<double, kAll> off_;
};
/// What asks the depths of two cores that have faces.
template <class Ask>
[[gnu::always_inline]] inline auto with_depths(const NearCore& a, const NearCore& b, const NearScale& scale, Ask ask) {
  if (a.is_box() && b.is_box()) {
    NearBoxes depths(a, b, scale);
    return ask(depths);
  }
  NearDepths depths(a, b, scale);
  return ask(depths);
}

/// What plain double says of two cores.
struct NearAnswer {
  NearSide side = NearSide::unknown;            ///< whether they are within alarm + both radii, where that is proved
  std::optional<NearSimplex::Vector> way = {};  ///< about q - p; nothing where they seem to overlap
  std::optional<std::array<NearSimplex::Vector, 4>> around = {};  ///< corners of B - A that 0 surely lies between
};
[[nodiscard]] inline NearSimplex::Vector farthest_of_box(const NearCore& box, const NearSimplex::Vector& along,
                                                         double sign) {
  std::size_t corner = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (sign * near::dot(along, box.ways[axis]) > 0) corner |= std::size_t{1} << axis;
  return box.corner(corner);
}
[[nodiscard]] inline NearSimplex::Vector farthest(const NearHull& hull, const NearSimplex::Vector& along, double sign) {
  const double u = sign * along[0];
  const double v = sign * along[1];
  const double w = sign * along[2];
  std::size_t best = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < hull.count; ++k) {
    const Vector3& x = hull.vertices[k];
    const double here = u * x[0] + v * x[1] + w * x[2];
    if (here > most) best = k, most = here;
  }
  return hull.corner(best);
}
[[nodiscard]] inline NearSimplex::Vector farthest(const NearCore& core, const NearSimplex::Vector& along, double sign) {
  if (core.is_box()) return farthest_of_box(core, along, sign);
  const NearSimplex::Vector* best = &core.corners[0];
  double most = sign * near::dot(along, *best);
  for (std::size_t k = 1; k < core.count; ++k)
    if (const double here = sign * near::dot(along, core.corners[k]); here > most) best = &core.corners[k], most = here;
  return *best;
}
/// Gilbert, Johnson and Keerthi's algorithm, until the side is proved, or `to_the_end`: until no corner leads nearer, or a miss is proved. Domain: the scale
/// holds.
template <class A, class B>
[[nodiscard, gnu::noinline]] NearAnswer walk(const A& a, const B& b, const NearScale& scale, bool to_the_end) {
  using Vector = NearSimplex::Vector;
  const auto& [size, error, reach] = scale;
  const double off = 2 * error + 0x1p-48 * size;        // of a product with a direction, over |v|_1
  const double off_point = 4 * error + 0x1p-45 * size;  // of the length of a point
  const auto corner_against = [&](const Vector& v) { return near::difference(farthest(b, v, -1), farthest(a, v, 1)); };
  NearSimplex simplex(corner_against(near::difference(b.base, a.base)));
  const double least_gain = to_the_end ? 0x1p-50 : 0x1p-40;
  NearSide side = NearSide::unknown;
  constexpr int kMostNearSteps = 24;
  for (int step = 0; step < kMostNearSteps; ++step) {
    const Vector& v = simplex.at();
    const double square = near::dot(v, v);
    const double length = std::sqrt(square);
    if (length * kMore + off_point < reach * kLess) side = NearSide::hit;
    if (side == NearSide::hit && !to_the_end) return {side};
    const double sum = std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2]);
    if (!(sum > kSmallestNear * kSmallestNear)) return {side};
    const Vector next = corner_against(v);
    const double low = near::dot(v, next);
    if (low - sum * off > reach * length * kMore) return {NearSide::miss};
    if (!(square - low > least_gain * square) || simplex.has(next)) return {side, v};
    simplex.add(next);
    if (!simplex.is_whole()) continue;
    if (!simplex.surrounds(error)) return {side};
    return {NearSide::hit, std::nullopt, simplex.tetrahedron()};
  }
  return {side, simplex.at()};
}

/// A closed surface of triangles around 0, of corners of A - B: what the depth is proved by where there are no ways.
///   Each corner is off by less than c = e + u R in each coordinate, R the largest, so each component of a normal by 16 R c + 32 u R^2, its length by 28 R e + 119 u R^2, and a height, in
///   lengths of the normal, by 72 R^2 e + 240 u R^3. What is used is at least twice as wide.
class NearPolytope {
 public:
  using Vector = NearSimplex::Vector;
  struct Nearness {
    static constexpr double kCertain = 0;
    static double of(double height, double square) { return height * height / square; }
  };
  using Polytope = ExpandingPolytope<double, Nearness>;
  using Face = Polytope::Face;

  /// Grows from a tetrahedron of corners of B - A until no corner lies beyond the nearest face, or has grown enough.
  template <class A, class B>
  NearPolytope(const A& a, const B& b, double error, const std::array<Vector, 4>& around)
      : polytope_({turned(around[0]), turned(around[1]), turned(around[2]), turned(around[3])}), error_(error) {
    for (const Vector& corner : around) size_ = std::max(size_, near::largest(corner));
    constexpr int kMostCorners = 64;
    for (int step = 0; step < kMostCorners; ++step) {
      const Face& face = nearest();
      const Vector corner = near::difference(farthest(a, face.normal, 1), farthest(b, face.normal, -1));
      size_ = std::max(size_, near::largest(corner));
      if (!(near::dot(face.normal, corner) - face.height > off_height()) || !polytope_.insert(corner)) return;
    }
  }

  [[nodiscard]] const Face& nearest() const { return polytope_.nearest(); }

  /// Whether A - B has no facet as near to 0 as that of `nearest`, which lies in the plane of the corners of which is_of_facet is true.
  ///   Domain      such a plane holds a facet of A - B.
  ///   0 lies below every triangle, so that every ray from 0 leaves through one, as often as the surface leads around 0. None of another plane is as near as the
  ///   facet's: the ray leaves farther than the depth along every other direction, and what A - B reaches along that is no less.
  template <class IsOfFacet>
  [[nodiscard]] bool is_surely_nearest(const Face& nearest, IsOfFacet is_of_facet) const {
    const auto is_in_plane = [&](const Face& face) {
      return std::all_of(face.corners.begin(), face.corners.end(),
                         [&](std::size_t k) { return is_of_facet(polytope_.corner(k)); });
    };
    const double off_length = 64 * size_ * error_ + 0x1p-45 * size_ * size_;
    const double least = std::sqrt(nearest.square) - off_length;
    if (!(least > 0)) return false;
    const double depth = (nearest.height + off_height()) / least * kMore;
    return std::all_of(polytope_.faces().begin(), polytope_.faces().end(), [&](const Face& face) {
      const double height = face.height - off_height();
      return height > 0 && (height > depth * kMore * (std::sqrt(face.square) + off_length) || is_in_plane(face));
    });
  }

 private:
  static Vector turned(const Vector& x) { return {-x[0], -x[1], -x[2]}; }
  [[nodiscard]] double off_height() const { return (160 * error_ + 0x1p-44 * size_) * size_ * size_; }

  Polytope polytope_;
  double error_;
  double size_ = 0;
};

/// Whether two cores are within alarm + both radii, where plain double can prove so. Facets pay where both have faces.
template <class A, class B>
[[nodiscard, gnu::always_inline]] inline NearSide near_side(const A& a, const B& b, double alarm) {
  const NearScale scale(a, b, alarm);
  if (!scale.holds()) return NearSide::unknown;
  NearSide side = NearSide::unknown;
  if constexpr (kHaveWays<A, B>)
    if (a.count > 2 && b.count > 2)
      side = with_depths(a, b, scale, [&](auto& depths) { return depths.side(scale.reach); });
  return side == NearSide::unknown ? walk(a, b, scale, false).side : side;
}

/// The corner of a core that lies lowest along a direction, how high the next one lies, and how far such a product may be off.
class NearLowest {
 public:
  template <class A>
  NearLowest(const A& a, const NearSimplex::Vector& v)
      : holds_(is_near_range(a.size) && is_near_range(near::largest(v))),
        off_((std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2])) * (2 * a.error + 0x1p-48 * a.size)) {
    if constexpr (std::same_as<A, NearCore>)
      if (a.is_box()) {
        find_of_box(a, v);
        return;
      }
    for (std::size_t k = 0; k < a.count; ++k) {
      const double here = near::dot(v, a.corner(k));
      next_ = std::min(next_, std::max(height_, here));
      corner_ = here < height_ ? k : corner_;
      height_ = std::min(height_, here);
    }
  }

  /// The corner that surely lies lowest, or nothing.
  [[nodiscard]] std::optional<std::size_t> corner() const {
    return holds_ && next_ - height_ > 2 * off_ ? std::optional(corner_) : std::nullopt;
  }
  /// Whether the core, with this radius about it, is within reach of the half-space below the plane.
  [[nodiscard]] NearSide side(const Plane& plane, double radius, double alarm) const {
    const double reach = alarm + radius;
    if (!holds_ || !(reach < kLargestNear) || !(std::abs(plane.offset) < kLargestNear)) return NearSide::unknown;
    const NearSimplex::Vector v = near::vector(plane.normal);
    const double off = off_ + 0x1p-48 * std::abs(plane.offset);
    const double height = height_ - plane.offset;
    const double most = reach * std::sqrt(near::dot(v, v));
    if (height - off > most * kMore) return NearSide::miss;
    if (height + off < most * kLess) return NearSide::hit;
    return NearSide::unknown;
  }

 private:
  void find_of_box(const NearCore& box, const NearSimplex::Vector& v) {
    height_ = near::dot(v, box.base);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double along = near::dot(v, box.ways[axis]);
      height_ -= std::abs(along);
      least = std::min(least, std::abs(along));
      if (along < 0) corner_ |= std::size_t{1} << axis;
    }
    next_ = height_ + 2 * least;
  }

  bool holds_;
  double off_;
  std::size_t corner_ = 0;
  double height_ = std::numeric_limits<double>::infinity();
  double next_ = std::numeric_limits<double>::infinity();
};

}  // namespace contact::kernel
