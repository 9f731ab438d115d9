// Whether two convex cores are within reach of each other, in plain double, where it can prove so: most questions end here.
//
// A miss is proved by a direction along which every corner of B lies farther than the reach from every corner of A. A hit is proved by a point of each core,
// sums of corners with parts >= 0, or by a tetrahedron of corners of B - A that 0 lies in. Which direction, and which corners, Gilbert, Johnson and Keerthi's
// algorithm says; that it may say the wrong ones costs time, and no proof rests on it.
//
// Bounds, with u = 2^-53, S the largest coordinate and e how far a coordinate may be off, of A and B together: a sum of three products of a direction v
// is off by less than |v|_1 (e + 8 u S), a point of a simplex in each coordinate by less than e + 32 u S, a determinant of differences of corners by less
// than 20 (2 S)^2 (e + 2 u S) + 64 u (2 S)^3. What is used below is at least twice as wide.
// Domain: round to nearest.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "contact/geometry.hpp"

namespace contact::kernel {

/// A core by its corners, each coordinate within `error` of what it is.
struct NearCore {
  std::array<std::array<double, 3>, 8> corners{};
  std::size_t count = 0;
  double radius = 0;
  double size = 0;  ///< the largest coordinate, or infinity where a bound does not hold
  double error = 0;

  void add(const Vector3& x) {
    corners[count++] = {x[0], x[1], x[2]};
    size = std::max({size, std::abs(x[0]), std::abs(x[1]), std::abs(x[2])});
  }
};
/// Between these no product of three numbers leaves the range, nor is what underflows as large as a bound.
constexpr double kLargestNear = 0x1p200;
constexpr double kSmallestNear = 0x1p-200;
inline bool is_near_range(double x) { return x > kSmallestNear && x < kLargestNear; }

inline NearCore near_core(const Ball& ball) {
  NearCore core;
  core.add(ball.center);
  core.radius = ball.radius;
  return core;
}
inline NearCore near_core(const Capsule& capsule) {
  NearCore core;
  core.add(capsule.start);
  core.add(capsule.end);
  core.radius = capsule.radius;
  return core;
}
inline NearCore near_core(const Triangle& triangle) {
  NearCore core;
  for (const Vector3& x : triangle.vertices) core.add(x);
  return core;
}
inline NearCore near_core(const Box& box) {
  NearCore core;
  for (int k = 0; k < 8; ++k)
    core.add({(k & 1 ? box.max : box.min)[0], (k & 2 ? box.max : box.min)[1], (k & 4 ? box.max : box.min)[2]});
  return core;
}
inline NearCore near_core(const Obb& box) {
  NearCore core;
  const auto& [x, y, z, w] = box.orientation;
  const double N = x * x + y * y + z * z + w * w;
  // Each number of the rotation is off by less than 9 u, each corner by 14 u (|c| + the sum of the extents).
  const std::array<Vector3, 3> columns{
      Vector3((w * w + x * x - y * y - z * z) / N, 2 * (x * y + w * z) / N, 2 * (x * z - w * y) / N),
      Vector3(2 * (x * y - w * z) / N, (w * w - x * x + y * y - z * z) / N, 2 * (y * z + w * x) / N),
      Vector3(2 * (x * z + w * y) / N, 2 * (y * z - w * x) / N, (w * w - x * x - y * y + z * z) / N)};
  for (int k = 0; k < 8; ++k) {
    Vector3 corner = box.center;
    for (int axis = 0; axis < 3; ++axis)
      corner += (k >> axis & 1 ? box.extents[axis] : -box.extents[axis]) * columns[static_cast<std::size_t>(axis)];
    core.add(corner);
  }
  core.error = 0x1p-48 * (box.center.cwiseAbs().maxCoeff() + box.extents[0] + box.extents[1] + box.extents[2]);
  if (!is_near_range(std::max({std::abs(x), std::abs(y), std::abs(z), std::abs(w)})))
    core.size = std::numeric_limits<double>::infinity();
  return core;
}

inline NearCore near_core(const Plane& /*plane*/) { return {}; }  // it has no corners

enum class NearSide { miss, hit, unknown };

/// The point of a simplex of corners of B - A that is nearest to 0, as plain double finds it.
class NearSimplex {
 public:
  using Vector = std::array<double, 3>;
  explicit NearSimplex(const Vector& corner) : corners_{corner}, count_(1), at_(corner) {}

  /// A point of the simplex, a sum of corners with parts > 0.
  [[nodiscard]] const Vector& at() const { return at_; }
  [[nodiscard]] bool has(const Vector& corner) const {
    return std::find(corners_.begin(), corners_.begin() + count_, corner) != corners_.begin() + count_;
  }
  /// Whether 0 lies in it, farther from each of its sides than a determinant may be off.
  [[nodiscard]] bool surrounds(double bound) const { return count_ == 4 && least_part_ > bound; }
  [[nodiscard]] bool is_whole() const { return count_ == 4; }

  /// Takes another corner, and of all the fewest that the nearest point lies between.
  void add(const Vector& corner) {
    corners_[count_++] = corner;
    double best = std::numeric_limits<double>::infinity();
    Vector nearest = corner;
    unsigned kept = 1U << (count_ - 1);
    for (unsigned subset = kept; subset < 1U << count_; ++subset) {
      Vector found;
      double square = 0;
      if (!solve(subset, found)) continue;
      for (const double x : found) square += x * x;
      if (!(square < best)) continue;
      best = square;
      nearest = found;
      kept = subset;
    }
    at_ = nearest;
    std::size_t left = 0;
    for (std::size_t k = 0; k < count_; ++k)
      if (kept >> k & 1) corners_[left++] = corners_[k];
    count_ = left;
  }

  static double dot(const Vector& x, const Vector& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }

 private:
  static Vector difference(const Vector& x, const Vector& y) { return {x[0] - y[0], x[1] - y[1], x[2] - y[2]}; }
  static Vector cross(const Vector& x, const Vector& y) {
    return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
  }

  /// The nearest point of the flat through some corners; whether it lies between them.
  [[nodiscard]] bool solve(unsigned subset, Vector& found) {
    std::array<const Vector*, 4> y{};
    std::size_t n = 0;
    for (std::size_t k = 0; k < count_; ++k)
      if (subset >> k & 1) y[n++] = &corners_[k];
    std::array<double, 4> part{1, 0, 0, 0};
    double whole = 1;
    if (n == 2) {
      const Vector u = difference(*y[1], *y[0]);
      whole = dot(u, u);
      part[1] = -dot(*y[0], u);
    } else if (n == 3) {
      const Vector u = difference(*y[1], *y[0]);
      const Vector v = difference(*y[2], *y[0]);
      const double A = dot(u, u);
      const double B = dot(u, v);
      const double C = dot(v, v);
      const double r = -dot(*y[0], u);
      const double s = -dot(*y[0], v);
      whole = A * C - B * B;
      part[1] = r * C - s * B;
      part[2] = s * A - r * B;
    } else if (n == 4) {
      // Each part is the volume that 0 spans with a side.
      const auto volume = [](const Vector& a, const Vector& b, const Vector& c) { return dot(a, cross(b, c)); };
      part = {volume(*y[1], *y[2], *y[3]), -volume(*y[0], *y[2], *y[3]), volume(*y[0], *y[1], *y[3]),
              -volume(*y[0], *y[1], *y[2])};
      if (part[0] < 0)
        for (double& x : part) x = -x;
      least_part_ = *std::min_element(part.begin(), part.end());
      found = {0, 0, 0};
      return least_part_ > 0;
    }
    if (n > 1) {
      part[0] = whole;
      for (std::size_t k = 1; k < n; ++k) part[0] -= part[k];
    }
    if (!(whole > 0)) return false;
    double sum = 0;
    for (std::size_t k = 0; k < n; ++k) {
      if (!(part[k] > 0)) return false;
      sum += part[k];
    }
    found = {0, 0, 0};
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t i = 0; i < 3; ++i) found[i] += part[k] / sum * (*y[k])[i];
    return true;
  }

  std::array<Vector, 4> corners_{};
  std::size_t count_;
  Vector at_;
  double least_part_ = 0;
};

constexpr double kMore = 1 + 0x1p-48;
constexpr double kLess = 1 - 0x1p-48;

/// What plain double says of two cores.
struct NearAnswer {
  NearSide side = NearSide::unknown;            ///< whether they are within alarm + both radii, where that is proved
  std::optional<NearSimplex::Vector> way = {};  ///< about q - p; nothing where they seem to overlap
};
/// Until the side is proved, or `to_the_end`: until no corner leads nearer, or a miss is proved.
[[nodiscard]] inline NearAnswer near_answer(const NearCore& a, const NearCore& b, double alarm, bool to_the_end) {
  using Vector = NearSimplex::Vector;
  const double size = std::max(a.size, b.size);
  const double reach = alarm + a.radius + b.radius;
  if (!is_near_range(size) || !(reach < kLargestNear)) return {};
  const double error = a.error + b.error;
  const double off = 2 * error + 0x1p-48 * size;        // of a product with a direction, over |v|_1
  const double off_point = 4 * error + 0x1p-45 * size;  // of the length of a point
  const double off_volume = 160 * size * size * (error + 0x1p-51 * size) + 0x1p-43 * size * size * size;
  const auto farthest = [](const NearCore& core, const Vector& v, double sign) {
    const Vector* best = &core.corners[0];
    double most = sign * NearSimplex::dot(v, *best);
    for (std::size_t k = 1; k < core.count; ++k)
      if (const double along = sign * NearSimplex::dot(v, core.corners[k]); along > most)
        best = &core.corners[k], most = along;
    return *best;
  };
  const auto corner_against = [&](const Vector& v) {
    const Vector p = farthest(a, v, 1);
    const Vector q = farthest(b, v, -1);
    return Vector{q[0] - p[0], q[1] - p[1], q[2] - p[2]};
  };
  const auto middle = [](const NearCore& core) {
    const Vector& first = core.corners[0];
    const Vector& last = core.corners[core.count - 1];
    return Vector{first[0] / 2 + last[0] / 2, first[1] / 2 + last[1] / 2, first[2] / 2 + last[2] / 2};
  };
  const Vector from = middle(a);
  const Vector to = middle(b);
  NearSimplex simplex(corner_against({to[0] - from[0], to[1] - from[1], to[2] - from[2]}));
  const double least_gain = to_the_end ? 0x1p-50 : 0x1p-40;
  NearSide side = NearSide::unknown;
  constexpr int kMostNearSteps = 24;
  for (int step = 0; step < kMostNearSteps; ++step) {
    const Vector& v = simplex.at();
    const double square = NearSimplex::dot(v, v);
    const double length = std::sqrt(square);
    if (length * kMore + off_point < reach * kLess) side = NearSide::hit;
    if (side == NearSide::hit && !to_the_end) return {side};
    const double sum = std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2]);
    if (!(sum > kSmallestNear * kSmallestNear)) return {side};
    const Vector next = corner_against(v);
    const double low = NearSimplex::dot(v, next);
    if (low - sum * off > reach * length * kMore) return {NearSide::miss};
    if (!(square - low > least_gain * square) || simplex.has(next)) return {side, v};
    simplex.add(next);
    if (simplex.is_whole()) return {simplex.surrounds(off_volume) ? NearSide::hit : side};
  }
  return {side, simplex.at()};
}

/// The same of a core over a half-space.
[[nodiscard]] inline NearSide near_side(const NearCore& a, const Plane& plane, double alarm) {
  const double reach = alarm + a.radius;
  const Vector3& n = plane.normal;
  if (!is_near_range(a.size) || !is_near_range(n.cwiseAbs().maxCoeff()) || !(reach < kLargestNear) ||
      !(std::abs(plane.offset) < kLargestNear))
    return NearSide::unknown;
  const NearSimplex::Vector v{n[0], n[1], n[2]};
  double lowest = NearSimplex::dot(v, a.corners[0]);
  for (std::size_t k = 1; k < a.count; ++k) lowest = std::min(lowest, NearSimplex::dot(v, a.corners[k]));
  const double off = (std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2])) * (2 * a.error + 0x1p-48 * a.size) +
                     0x1p-48 * std::abs(plane.offset);
  const double height = lowest - plane.offset;
  const double most = reach * std::sqrt(NearSimplex::dot(v, v));
  if (height - off > most * kMore) return NearSide::miss;
  if (height + off < most * kLess) return NearSide::hit;
  return NearSide::unknown;
}

}  // namespace contact::kernel
