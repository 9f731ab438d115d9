// The contact of two convex cores, or of one over a half-space, in numbers that bound their own error: most contacts are rounded from them.
//
// Plain double says which features are nearest, or which facet of A - B is, and its bounds prove it:
//   apart     along q - p every vertex of A outside the one feature lies before p, every one of B outside the other behind q
//   overlap   0 lies below every facet of A - B, and is nearer to one of them than to any other; facets are made by a face and a vertex, or by two edges
// Where there are several nearest points or normals, and where something is not certain, there is no contact here: the exact stage answers.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <optional>

#include "kernel/convexes_filter.hpp"
#include "kernel/cores_double_double.hpp"
#include "kernel/enclosure.hpp"

namespace contact::kernel {

inline Enclosures enclosed(const Vector3& x) { return {Enclosure(x[0]), Enclosure(x[1]), Enclosure(x[2])}; }

[[nodiscard]] inline bool in_short_range(const Ball& x) { return in_short_range(x.center) && in_short_range(x.radius); }
[[nodiscard]] inline bool in_short_range(const Capsule& x) {
  return in_short_range(x.start) && in_short_range(x.end) && in_short_range(x.radius);
}
[[nodiscard]] inline bool in_short_range(const Box& x) { return in_short_range(x.min) && in_short_range(x.max); }
[[nodiscard]] inline bool in_short_range(const Triangle& x) {
  return std::all_of(x.vertices.begin(), x.vertices.end(), [](const Vector3& v) { return in_short_range(v); });
}
[[nodiscard]] inline bool in_short_range(const Obb& x) {
  return in_short_range(x.center) && in_short_range(x.extents) &&
         std::all_of(x.orientation.begin(), x.orientation.end(), [](double c) { return in_short_range(c); });
}
[[nodiscard]] inline bool in_short_range(const Plane& x) {
  return in_short_range(x.normal) && in_short_range(x.offset);
}

/// The vertices of a core, in the order of NearCore's.
class EnclosedCorners {
 public:
  explicit EnclosedCorners(const Ball& x) : given_{x.center} {}
  explicit EnclosedCorners(const Capsule& x) : given_{x.start, x.end} {}
  explicit EnclosedCorners(const Triangle& x) : given_{x.vertices[0], x.vertices[1], x.vertices[2]} {}
  explicit EnclosedCorners(const Box& x) : given_{x.min, x.max}, kind_(Kind::box) {}
  explicit EnclosedCorners(const Obb& x) : given_{x.center, x.extents}, orientation_(x.orientation), kind_(Kind::obb) {}

  /// What is computed once. (Not in a constructor: it is compiled for processors with fma where its caller is.)
  void turn() {
    if (kind_ != Kind::obb) return;
    const Enclosure x(orientation_[0]);
    const Enclosure y(orientation_[1]);
    const Enclosure z(orientation_[2]);
    const Enclosure w(orientation_[3]);
    const Enclosure xx = x * x;
    const Enclosure yy = y * y;
    const Enclosure zz = z * z;
    const Enclosure ww = w * w;
    const Enclosure inverse = reciprocal((ww + xx) + (yy + zz));
    const auto twice = [](const Enclosure& n) { return n + n; };
    const Enclosures columns[3] = {{(ww - yy) + (xx - zz), twice(x * y + w * z), twice(x * z - w * y)},
                                   {twice(x * y - w * z), (ww - xx) + (yy - zz), twice(y * z + w * x)},
                                   {twice(x * z + w * y), twice(y * z - w * x), (ww - xx) + (zz - yy)}};
    for (std::size_t axis = 0; axis < 3; ++axis)
      halves_[axis] = (Enclosure(given_[1][static_cast<Eigen::Index>(axis)]) * inverse) * columns[axis];
  }
  [[nodiscard]] Enclosures operator()(std::size_t k) const {
    if (kind_ == Kind::points) return enclosed(given_[k]);
    if (kind_ == Kind::box) return enclosed({given_[k & 1][0], given_[k >> 1 & 1][1], given_[k >> 2 & 1][2]});
    Enclosures corner = enclosed(given_[0]);
    for (std::size_t axis = 0; axis < 3; ++axis)
      corner = k >> axis & 1 ? corner + halves_[axis] : corner - halves_[axis];
    return corner;
  }

 private:
  enum class Kind { points, box, obb };
  std::array<Vector3, 3> given_;
  Quaternion orientation_{};
  Kind kind_ = Kind::points;
  std::array<Enclosures, 3> halves_{};
};

/// A core by its corners, nearly and in enclosures.
struct CornersOf {
  const NearCore& near;
  EnclosedCorners corners;
};

/// A vertex, an edge, a triangle or a side of a box, by its corners: those next to the first one come before the one across.
struct CornerSet {
  std::array<std::size_t, 4> at{};
  std::size_t size = 0;

  [[nodiscard]] std::size_t dimension() const { return std::min<std::size_t>(size, 3) - 1; }
  [[nodiscard]] bool has(std::size_t k) const {
    return std::find(at.begin(), at.begin() + size, k) != at.begin() + size;
  }
  [[nodiscard]] Enclosures way(const EnclosedCorners& corners, std::size_t k) const {
    return corners(at[k]) - corners(at[0]);
  }
};

/// The corners that lie farthest along a direction, or nearly; nothing where they make no feature.
[[nodiscard]] inline std::optional<CornerSet> farthest_set(const NearCore& core, const NearSimplex::Vector& way) {
  std::array<double, 8> along{};
  double most = 0;
  double size = 0;
  for (std::size_t k = 0; k < core.count; ++k) {
    along[k] = NearSimplex::dot(way, core.corners[k]);
    most = k == 0 ? along[k] : std::max(most, along[k]);
    size = std::max(size, std::abs(along[k] - along[0]));
  }
  CornerSet set;
  for (std::size_t k = 0; k < core.count; ++k) {
    if (!(along[k] >= most - 0x1p-30 * size)) continue;
    if (set.size == 4) return std::nullopt;
    set.at[set.size++] = k;
  }
  const auto is_one_bit = [&](std::size_t i, std::size_t j) { return std::has_single_bit(set.at[i] ^ set.at[j]); };
  const bool is_box = core.count == 8;
  const bool is_one = set.size == 1 || (set.size == 2 && (!is_box || is_one_bit(0, 1))) || (set.size == 3 && !is_box) ||
                      (set.size == 4 && is_one_bit(0, 1) && is_one_bit(0, 2) && is_one_bit(1, 3));
  return is_one ? std::optional(set) : std::nullopt;
}

/// A direction, and how far the sum of its components may be off.
struct NearWay {
  NearSimplex::Vector way;
  double off;

  explicit NearWay(const Enclosures& x) : way{x[0].high, x[1].high, x[2].high}, off(0) {
    for (const Enclosure& each : x) off += 0x1p-52 * std::abs(each.high) + each.radius;
  }
};
/// Whether every corner outside of a set lies before its first one, along a direction or against it.
/// The difference of two corners is off by 2 error, and by u of its size, at most 2 `size`; its product with the way by 3 u of that. What is used is at least twice as wide.
[[nodiscard]] inline bool are_others_before(const NearCore& core, const CornerSet& set, const NearWay& along,
                                            double sign) {
  const auto& [way, off] = along;
  const double sum = std::abs(way[0]) + std::abs(way[1]) + std::abs(way[2]);
  const double bound = sum * (4 * core.error + 0x1p-47 * core.size) + off * 8 * core.size;
  const NearSimplex::Vector& from = core.corners[set.at[0]];
  for (std::size_t k = 0; k < core.count; ++k) {
    const NearSimplex::Vector& x = core.corners[k];
    const double before = sign * NearSimplex::dot(way, {from[0] - x[0], from[1] - x[1], from[2] - x[2]});
    if (!set.has(k) && !(before > bound)) return false;
  }
  return true;
}

/// Whether the foot of a point lies inside a face.
[[nodiscard]] inline bool is_over(const Enclosures& u, const Enclosures& w, bool is_parallelogram,
                                  const Enclosures& r) {
  const Enclosure uu = dot(u, u);
  const Enclosure uw = dot(u, w);
  const Enclosure ww = dot(w, w);
  const Enclosure ru = dot(r, u);
  const Enclosure rw = dot(r, w);
  const Enclosure of_u = ru * ww - rw * uw;
  const Enclosure of_w = rw * uu - ru * uw;
  const Enclosure whole = uu * ww - uw * uw;
  if (!of_u.is_positive() || !of_w.is_positive()) return false;
  return is_parallelogram ? (whole - of_u).is_positive() && (whole - of_w).is_positive()
                          : (whole - (of_u + of_w)).is_positive();
}

/// A contact by the nearest points, the normal and the distance, which is below 0 where the cores overlap.
class EnclosedContact {
 public:
  EnclosedContact(const Enclosures& p, const Enclosures& q, const Enclosures& normal, const Enclosure& distance,
                  const Lengths& lengths)
      : p_(p),
        q_(q),
        normal_(normal),
        distance_(distance),
        radii_(two_sum(lengths.radius1, lengths.radius2), 0),
        contact_(lengths.contact) {}

  [[nodiscard]] NearSide side(double alarm) const {
    const Enclosure past = distance_ - (radii_ + Enclosure(alarm));
    return past.is_positive() ? NearSide::miss : (-past).is_positive() ? NearSide::hit : NearSide::unknown;
  }
  [[nodiscard]] Approximation normal(std::size_t axis) const { return normal_[axis].approximation(); }
  [[nodiscard]] Approximation point1(std::size_t axis, double signed_radius) const {
    return (p_[axis] + Enclosure(signed_radius) * normal_[axis]).approximation();
  }
  [[nodiscard]] Approximation point2(std::size_t axis, double signed_radius) const {
    return (q_[axis] + Enclosure(signed_radius) * normal_[axis]).approximation();
  }
  [[nodiscard]] Approximation value() const { return (distance_ - (radii_ + Enclosure(contact_))).approximation(); }
  [[nodiscard]] static constexpr bool is_unique() { return true; }

 private:
  Enclosures p_;
  Enclosures q_;
  Enclosures normal_;
  Enclosure distance_;
  Enclosure radii_;
  double contact_;
};

/// A feature of each core, of which no other point is as near.
class TwoSets {
 public:
  TwoSets(const EnclosedCorners& a, const CornerSet& f, const EnclosedCorners& b, const CornerSet& g)
      : a_(a), f_(f), b_(b), g_(g) {}

  /// Nearest points that surely lie inside both, and the way between.
  struct Nearest {
    Enclosures p;
    Enclosures q;
    Enclosures delta;
  };
  [[nodiscard]] std::optional<Nearest> nearest() const {
    if (f_.size == 1) return of_point(a_(f_.at[0]), b_, g_);
    if (g_.size > 1) return of_edges();
    auto found = of_point(b_(g_.at[0]), a_, f_);
    if (!found) return std::nullopt;
    return Nearest{found->q, found->p, -found->delta};
  }
  /// The normal of both: across the face of one, or across both edges. Domain: a face and a vertex, or two edges.
  [[nodiscard]] Enclosures normal() const {
    if (f_.size > 2) return cross(f_.way(a_, 1), f_.way(a_, 2));
    if (g_.size > 2) return cross(g_.way(b_, 1), g_.way(b_, 2));
    return cross(f_.way(a_, 1), g_.way(b_, 1));
  }
  /// The deepest point of A that surely lies inside both, and that of B, if B is moved back by `out`. Domain: as above.
  [[nodiscard]] std::optional<Nearest> deepest(const Enclosures& out) const {
    const auto is_inside = [](const EnclosedCorners& corners, const CornerSet& face, const Enclosures& x) {
      return is_over(face.way(corners, 1), face.way(corners, 2), face.size == 4, x - corners(face.at[0]));
    };
    if (f_.size > 2) {
      const Enclosures q = b_(g_.at[0]);
      return is_inside(a_, f_, q) ? std::optional(Nearest{q + out, q, out}) : std::nullopt;
    }
    if (g_.size > 2) {
      const Enclosures p = a_(f_.at[0]);
      return is_inside(b_, g_, p) ? std::optional(Nearest{p, p - out, out}) : std::nullopt;
    }
    return of_edges();
  }

 private:
  static std::optional<Nearest> of_point(const Enclosures& p, const EnclosedCorners& corners, const CornerSet& set) {
    const Enclosures o = corners(set.at[0]);
    if (set.size == 1) return Nearest{p, o, o - p};
    const Enclosures r = p - o;
    const Enclosures u = set.way(corners, 1);
    if (set.size == 2) {
      const Enclosure part = dot(r, u);
      const Enclosure whole = dot(u, u);
      if (!whole.is_clear() || !part.is_positive() || !(whole - part).is_positive()) return std::nullopt;
      const Enclosures foot = (part * reciprocal(whole)) * u;
      return Nearest{p, o + foot, foot - r};
    }
    const Enclosures w = set.way(corners, 2);
    const Enclosures n = cross(u, w);
    const Enclosure N = dot(n, n);
    if (!N.is_clear() || !is_over(u, w, set.size == 4, r)) return std::nullopt;
    const Enclosures delta = -((dot(r, n) * reciprocal(N)) * n);
    return Nearest{p, p + delta, delta};
  }
  [[nodiscard]] std::optional<Nearest> of_edges() const {
    if (f_.size != 2 || g_.size != 2) return std::nullopt;
    const Enclosures from = a_(f_.at[0]);
    const Enclosures to = b_(g_.at[0]);
    const Enclosures u = f_.way(a_, 1);
    const Enclosures w = g_.way(b_, 1);
    const Enclosures d = to - from;
    const Enclosures n = cross(u, w);
    const Enclosure N = dot(n, n);
    if (!N.is_clear()) return std::nullopt;
    const Enclosure s = dot(cross(d, w), n);
    const Enclosure t = dot(cross(d, u), n);
    for (const Enclosure& part : {s, t})
      if (!part.is_positive() || !(N - part).is_positive()) return std::nullopt;
    const Enclosure inverse = reciprocal(N);
    return Nearest{from + (s * inverse) * u, to + (t * inverse) * w, (dot(d, n) * inverse) * n};
  }

  const EnclosedCorners& a_;
  const CornerSet& f_;
  const EnclosedCorners& b_;
  const CornerSet& g_;
};

/// The contact of cores that are apart, and nearest about along `way`.
[[nodiscard]] inline std::optional<EnclosedContact> contact_apart(const CornersOf& a, const CornersOf& b,
                                                                  const NearSimplex::Vector& way,
                                                                  const Lengths& lengths) {
  const auto f = farthest_set(a.near, way);
  const auto g = farthest_set(b.near, {-way[0], -way[1], -way[2]});
  if (!f || !g || f->dimension() + g->dimension() > 2) return std::nullopt;
  const auto nearest = TwoSets(a.corners, *f, b.corners, *g).nearest();
  if (!nearest) return std::nullopt;
  const auto& [p, q, delta] = *nearest;
  const Enclosure D = dot(delta, delta);
  const NearWay along(delta);
  if (!D.is_clear() || !are_others_before(a.near, *f, along, 1) || !are_others_before(b.near, *g, along, -1))
    return std::nullopt;
  const Enclosure distance = root(D);
  return EnclosedContact(p, q, reciprocal(distance) * delta, distance, lengths);
}

/// A direction that facets of A - B may face: across two ways between corners. Where both are of one core they span a face of it.
struct NearAxis {
  std::array<std::size_t, 2> u;  ///< from this corner to that one
  std::array<std::size_t, 2> w;
  bool of_a;
  bool of_b;
};
/// The ways of a core, one of each direction: 3 of a box and a triangle, 1 of a segment, none of a point.
inline std::size_t ways_of(const NearCore& core, std::array<std::array<std::size_t, 2>, 3>& ways) {
  if (core.count == 8) return ways = {{{0, 1}, {0, 2}, {0, 4}}}, 3;
  if (core.count == 3) return ways = {{{0, 1}, {0, 2}, {1, 2}}}, 3;
  if (core.count == 2) return ways[0] = {0, 1}, 1;
  return 0;
}
/// All of them, at most 15; how many.
inline std::size_t axes_of(const NearCore& a, const NearCore& b, std::array<NearAxis, 15>& axes) {
  std::array<std::array<std::size_t, 2>, 3> of_a{};
  std::array<std::array<std::size_t, 2>, 3> of_b{};
  const std::size_t n = ways_of(a, of_a);
  const std::size_t m = ways_of(b, of_b);
  std::size_t count = 0;
  const auto add_faces = [&](const NearCore& core, const auto& ways, bool is_a) {
    if (core.count < 3) return;
    axes[count++] = {ways[0], ways[1], is_a, !is_a};
    if (core.count == 3) return;
    axes[count++] = {ways[0], ways[2], is_a, !is_a};
    axes[count++] = {ways[1], ways[2], is_a, !is_a};
  };
  add_faces(a, of_a, true);
  add_faces(b, of_b, false);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < m; ++j) axes[count++] = {of_a[i], of_b[j], true, true};
  return count;
}

/// How deep two cores overlap along each axis, one way and the other, and how far that may be off; and which is least.
///   Each way is off by e' = 4 e + 2^-50 S in each coordinate, N = u x w by d = 4 (|u| + |w|) e', n = N / |N| by 4 d / |N|, what is farthest along n by
///   16 d S / |N|, and products with n by 4 (e + 2^-48 S). What is used is twice as wide.
class NearDepths {
 public:
  NearDepths(const NearCore& a, const NearCore& b) : count_(axes_of(a, b, axes_)) {
    const double size = std::max(a.size, b.size);
    const double error = a.error + b.error;
    const double off_way = 4 * error + 0x1p-50 * size;
    for (std::size_t k = 0; k < count_; ++k) {
      const NearAxis& axis = axes_[k];
      const Vector u = way(axis.of_a ? a : b, axis.u);
      const Vector w = way(axis.of_b ? b : a, axis.w);
      const Vector n = {u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]};
      const double length = std::sqrt(NearSimplex::dot(n, n));
      const double inverse = 1 / length;
      const auto [low_a, high_a] = extent(a, n);
      const auto [low_b, high_b] = extent(b, n);
      depth_[2 * k] = (high_a - low_b) * inverse;
      depth_[2 * k + 1] = (high_b - low_a) * inverse;
      normal_[k] = n;
      const double off_normal = 4 * (largest(u) + largest(w)) * off_way;
      off_[k] = length > 0x1p10 * off_normal ? 32 * off_normal * size * inverse + 8 * (error + 0x1p-48 * size)
                                             : std::numeric_limits<double>::infinity();
    }
  }

  /// The place of the least, 2 k or 2 k + 1 of an axis k; nothing where another may be as deep, or 0 may lie outside.
  [[nodiscard]] std::optional<std::size_t> least() const {
    if (count_ == 0) return std::nullopt;
    const std::size_t best =
        static_cast<std::size_t>(std::min_element(depth_.begin(), depth_.begin() + 2 * count_) - depth_.begin());
    if (!(depth_[best] - off_[best / 2] > 0)) return std::nullopt;
    const double most = depth_[best] + off_[best / 2];
    for (std::size_t k = 0; k < 2 * count_; ++k)
      if (k != best && !(depth_[k] - off_[k / 2] > most)) return std::nullopt;
    return best;
  }
  [[nodiscard]] const NearAxis& axis(std::size_t place) const { return axes_[place / 2]; }
  [[nodiscard]] NearSimplex::Vector normal(std::size_t place) const {
    const auto& [x, y, z] = normal_[place / 2];
    return place % 2 == 0 ? NearSimplex::Vector{x, y, z} : NearSimplex::Vector{-x, -y, -z};
  }

 private:
  using Vector = NearSimplex::Vector;
  static Vector way(const NearCore& core, const std::array<std::size_t, 2>& places) {
    const Vector& from = core.corners[places[0]];
    const Vector& to = core.corners[places[1]];
    return {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
  }
  static double largest(const Vector& x) { return std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2])}); }
  static std::array<double, 2> extent(const NearCore& core, const Vector& n) {
    std::array<double, 2> found{NearSimplex::dot(n, core.corners[0]), NearSimplex::dot(n, core.corners[0])};
    for (std::size_t k = 1; k < core.count; ++k) {
      const double along = NearSimplex::dot(n, core.corners[k]);
      found = {std::min(found[0], along), std::max(found[1], along)};
    }
    return found;
  }

  std::array<NearAxis, 15> axes_{};
  std::size_t count_;
  std::array<Vector, 15> normal_{};
  std::array<double, 30> depth_{};
  std::array<double, 15> off_{};
};

/// Whether a set is a face or an edge that an axis is made of, or a vertex where it is of the other core.
[[nodiscard]] inline bool is_of(const CornerSet& set, const NearCore& core, const NearAxis& axis, bool is_a) {
  const auto is_parallel = [&](std::size_t from, std::size_t to, const std::array<std::size_t, 2>& way) {
    const std::size_t low = std::min(from, to);
    const std::size_t high = std::max(from, to);
    return core.count == 8 ? (low ^ high) == (way[0] ^ way[1]) : low == way[0] && high == way[1];
  };
  if (axis.of_a && axis.of_b) return set.size == 2 && is_parallel(set.at[0], set.at[1], is_a ? axis.u : axis.w);
  if (axis.of_a != is_a) return set.size == 1;
  if (core.count == 3) return set.size == 3;
  return set.size == 4 && is_parallel(set.at[0], set.at[1], axis.u) && is_parallel(set.at[0], set.at[2], axis.w);
}

/// The contact of cores that overlap.
[[nodiscard]] inline std::optional<EnclosedContact> contact_overlapping(const CornersOf& a, const CornersOf& b,
                                                                        const Lengths& lengths) {
  const NearDepths depths(a.near, b.near);
  const auto least = depths.least();
  if (!least) return std::nullopt;
  const NearSimplex::Vector about = depths.normal(*least);
  const auto f = farthest_set(a.near, about);
  const auto g = farthest_set(b.near, {-about[0], -about[1], -about[2]});
  const NearAxis& axis = depths.axis(*least);
  if (!f || !g || !is_of(*f, a.near, axis, true) || !is_of(*g, b.near, axis, false)) return std::nullopt;
  const TwoSets sets(a.corners, *f, b.corners, *g);
  Enclosures n = sets.normal();
  if (about[0] * n[0].high + about[1] * n[1].high + about[2] * n[2].high < 0) n = -n;
  const Enclosure N = dot(n, n);
  const NearWay along(n);
  if (!N.is_clear() || !are_others_before(a.near, *f, along, 1) || !are_others_before(b.near, *g, along, -1))
    return std::nullopt;
  const Enclosure height = dot(n, a.corners(f->at[0]) - b.corners(g->at[0]));
  const auto deepest = sets.deepest((height * reciprocal(N)) * n);
  if (!deepest) return std::nullopt;
  const Enclosure inverse = reciprocal(root(N));
  return EnclosedContact(deepest->p, deepest->q, inverse * n, -(height * inverse), lengths);
}

/// The contact of a core over a half-space, at the one vertex that is lowest.
[[nodiscard]] inline std::optional<EnclosedContact> contact_over(const CornersOf& a, const Plane& plane,
                                                                 const Lengths& lengths) {
  const Vector3& m = plane.normal;
  const auto lowest = farthest_set(a.near, {-m[0], -m[1], -m[2]});
  const Enclosures n = -enclosed(m);
  if (!lowest || lowest->size != 1 || !are_others_before(a.near, *lowest, NearWay(n), 1)) return std::nullopt;
  const Enclosures p = a.corners(lowest->at[0]);
  const Enclosure inverse = reciprocal(root(dot(n, n)));
  const Enclosure distance = -((dot(n, p) + Enclosure(plane.offset)) * inverse);
  const Enclosures normal = inverse * n;
  return EnclosedContact(p, p + distance * normal, normal, distance, lengths);
}

}  // namespace contact::kernel
