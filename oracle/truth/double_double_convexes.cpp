// Any two convex cores in pairs of doubles. Plain double proposes which features are nearest, or which facet of A - B is; the proof asks nothing of it.
//
//   apart     p and q lie inside a feature of each, every other vertex of A lies before p and every other one of B behind q, along q - p
//   overlap   0 lies below every facet of A - B, and nearest to one: facets are what faces and two edges make
//
// Where there are several nearest points or normals, and where something is not certain, there is no answer.
#include "oracle/truth/double_double_segments.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <variant>
#include <vector>

#include "oracle/truth/core.hpp"

namespace contact::oracle {
namespace {

constexpr int kMostOfCores = 80;  // what is of degree 10 in lengths stays in range
using NearCore = Core<DoubleDouble>;
using Plain = std::array<double, 3>;

// ---- arithmetic ----

/// x y, of which nothing is certain where its low parts might be lost.
DoubleDouble times(const DoubleDouble& x, const DoubleDouble& y) {
  const auto is_tiny = [](const DoubleDouble& z) { return z.high != 0 && std::abs(z.high) < 0x1p-300; };
  DoubleDouble both = x * y;
  if (is_tiny(x) || is_tiny(y)) both.radius = std::numeric_limits<double>::infinity();
  return both;
}
DoubleDoubles times(const DoubleDouble& k, const DoubleDoubles& x) {
  return {times(k, x[0]), times(k, x[1]), times(k, x[2])};
}
DoubleDoubles sum(const DoubleDoubles& x, const DoubleDoubles& y) { return {x[0] + y[0], x[1] + y[1], x[2] + y[2]}; }
DoubleDoubles minus(const DoubleDoubles& x, const DoubleDoubles& y) { return {x[0] - y[0], x[1] - y[1], x[2] - y[2]}; }
DoubleDouble product(const DoubleDoubles& x, const DoubleDoubles& y) {
  return times(x[0], y[0]) + times(x[1], y[1]) + times(x[2], y[2]);
}
DoubleDoubles across(const DoubleDoubles& x, const DoubleDoubles& y) {
  const auto at = [&](std::size_t i, std::size_t j) { return times(x[i], y[j]) - times(x[j], y[i]); };
  return {at(1, 2), at(2, 0), at(0, 1)};
}
bool is_clear(const DoubleDouble& x) { return x.radius < x.high * 0x1p-20; }  // above 0
bool is_positive(const DoubleDouble& x) { return x.sign() == 1; }
Plain plain(const DoubleDoubles& x) { return {x[0].high, x[1].high, x[2].high}; }
double plain_dot(const Plain& x, const Plain& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }

// ---- cores ----

template <class Shape>
bool is_in_range(const Shape& shape) {
  bool all = true;
  for_each_number(shape, [&](double x) { all = all && in_range(x, kMostOfCores); });
  return all;
}

/// Thrown where a sign is not known for certain.
struct Uncertain {};
template <class Shape>
NearCore core_in_doubles(const Shape& shape) {
  return core_of([](double x) { return DoubleDouble{x}; }, shape);
}
template <HullOfVertices Shape>
NearCore core_in_doubles(const Shape& hull) {
  const auto points = points_of([](double x) { return DoubleDouble{x}; }, hull);
  const auto sign = [&](const auto& ask) {
    const auto known = ask(points).sign();
    if (!known) throw Uncertain{};
    return *known;
  };
  return core_of_points(points, radius_of(hull), sign);
}

/// A rotated box as with_short_orientation has it, so that more of them are in range.
Obb of_unit_size(const Obb& box) { return with_short_orientation(box); }
template <class Shape>
const Shape& of_unit_size(const Shape& shape) {
  return shape;
}

/// Nothing where a number is out of range, or a sign of the hull's is not certain.
std::optional<NearCore> near_core(const Convex& convex) try {
  return std::visit(
      []<class Shape>(const Shape& given) -> std::optional<NearCore> {
        if constexpr (std::same_as<Shape, Plane>) {
          return std::nullopt;
        } else {
          const Shape& shape = of_unit_size(given);
          if (!is_in_range(shape)) return std::nullopt;
          NearCore core = core_in_doubles(shape);
          if (core.over) {
            if (!is_clear(*core.over)) return std::nullopt;
            const DoubleDouble inverse = reciprocal(*core.over);
            for (DoubleDoubles& x : core.vertices) x = times(inverse, x);
          }
          return core;
        }
      },
      convex.shape);
} catch (const Uncertain&) {
  return std::nullopt;
}

/// The vertex that plain double finds farthest along a direction.
std::size_t farthest(const NearCore& core, const Plain& way) {
  std::size_t best = 0;
  for (std::size_t k = 1; k < core.vertices.size(); ++k)
    if (plain_dot(way, plain(core.vertices[k])) > plain_dot(way, plain(core.vertices[best]))) best = k;
  return best;
}
/// The feature of the vertices that plain double finds farthest, or nearly.
const Feature* farthest_feature(const NearCore& core, const Plain& way) {
  const Plain first = plain(core.vertices[farthest(core, way)]);
  double size = 0;
  for (const DoubleDoubles& x : core.vertices)
    for (std::size_t i = 0; i < 3; ++i) size += std::abs(way[i] * (x[i].high - first[i]));
  const double least = plain_dot(way, first) - 0x1p-30 * size;
  const auto is_there = [&](std::size_t k) { return plain_dot(way, plain(core.vertices[k])) >= least; };
  std::size_t count = 0;
  for (std::size_t k = 0; k < core.vertices.size(); ++k) count += is_there(k) ? 1 : 0;
  for (const Feature& feature : core.features)
    if (feature.size == count && std::all_of(feature.corners().begin(), feature.corners().end(), is_there))
      return &feature;
  return nullptr;
}
/// Whether every vertex outside a feature is surely before `from` along a direction.
bool are_others_before(const NearCore& core, const Feature& feature, const DoubleDoubles& way,
                       const DoubleDoubles& from) {
  for (std::size_t k = 0; k < core.vertices.size(); ++k)
    if (!feature.has(k) && !is_positive(product(way, minus(from, core.vertices[k])))) return false;
  return true;
}

DoubleDoubles way_of(const NearCore& core, const Feature& feature, std::size_t corner) {
  return minus(core.vertices[feature.places[corner]], core.vertices[feature.places[0]]);
}
DoubleDoubles normal_of(const NearCore& core, const Feature& face) {
  return across(way_of(core, face, 1), way_of(core, face, 2));
}

/// Whether the foot of a point surely lies inside a face.
bool is_over(const NearCore& core, const Feature& face, const DoubleDoubles& x) {
  const DoubleDoubles u = way_of(core, face, 1);
  const DoubleDoubles w = way_of(core, face, 2);
  const DoubleDoubles r = minus(x, core.vertices[face.places[0]]);
  const DoubleDouble A = product(u, u);
  const DoubleDouble B = product(u, w);
  const DoubleDouble C = product(w, w);
  const DoubleDouble of_u = times(product(r, u), C) - times(product(r, w), B);
  const DoubleDouble of_w = times(product(r, w), A) - times(product(r, u), B);
  const DoubleDouble whole = times(A, C) - times(B, B);
  if (!is_positive(of_u) || !is_positive(of_w)) return false;
  return face.is_parallelogram() ? is_positive(whole - of_u) && is_positive(whole - of_w)
                                 : is_positive(whole - (of_u + of_w));
}

/// Two edges that are not parallel.
struct Crossing {
  DoubleDoubles n;  ///< across both
  DoubleDouble N;
  DoubleDoubles on_a;  ///< what lies on the line of the first nearest to the other, surely inside of both
  DoubleDoubles on_b;
};
std::optional<Crossing> crossing(const NearCore& a, const Feature& e, const NearCore& b, const Feature& f) {
  const DoubleDoubles u = way_of(a, e, 1);
  const DoubleDoubles w = way_of(b, f, 1);
  const DoubleDoubles& a0 = a.vertices[e.places[0]];
  const DoubleDoubles& b0 = b.vertices[f.places[0]];
  const DoubleDoubles d = minus(b0, a0);
  Crossing found{across(u, w), {}, {}, {}};
  found.N = product(found.n, found.n);
  if (!is_clear(found.N)) return std::nullopt;
  const DoubleDouble s = product(across(d, w), found.n);
  const DoubleDouble t = product(across(d, u), found.n);
  for (const DoubleDouble& x : {s, t})
    if (!is_positive(x) || !is_positive(found.N - x)) return std::nullopt;
  const DoubleDouble inverse = reciprocal(found.N);
  found.on_a = sum(a0, times(times(s, inverse), u));
  found.on_b = sum(b0, times(times(t, inverse), w));
  return found;
}

// ---- apart ----

/// What is nearest of a point and a feature that its foot surely lies inside of.
std::optional<DoubleDoubleNearest> from_point(const DoubleDoubles& p, const NearCore& b, const Feature& g) {
  const DoubleDoubles& o = b.vertices[g.places[0]];
  if (g.dimension() == 0) return DoubleDoubleNearest{p, o, minus(o, p)};
  const DoubleDoubles r = minus(p, o);
  if (g.dimension() == 1) {
    const DoubleDoubles u = way_of(b, g, 1);
    const DoubleDouble part = product(r, u);
    const DoubleDouble whole = product(u, u);
    if (!is_clear(whole) || !is_positive(part) || !is_positive(whole - part)) return std::nullopt;
    const DoubleDoubles on = times(times(part, reciprocal(whole)), u);
    return DoubleDoubleNearest{p, sum(o, on), minus(on, r)};
  }
  const DoubleDoubles n = normal_of(b, g);
  const DoubleDouble N = product(n, n);
  if (!is_clear(N) || !is_over(b, g, p)) return std::nullopt;
  const DoubleDoubles delta = times(-times(product(r, n), reciprocal(N)), n);
  return DoubleDoubleNearest{p, sum(p, delta), delta};
}

std::optional<DoubleDoubleNearest> nearest_of(const NearCore& a, const Feature& f, const NearCore& b,
                                              const Feature& g) {
  if (f.dimension() == 0) return from_point(a.vertices[f.places[0]], b, g);
  if (g.dimension() == 0) {
    auto found = from_point(b.vertices[g.places[0]], a, f);
    if (!found) return std::nullopt;
    return turned_round(*found);
  }
  if (f.dimension() + g.dimension() > 2) return std::nullopt;
  const auto found = crossing(a, f, b, g);
  if (!found) return std::nullopt;
  const DoubleDoubles d = minus(b.vertices[g.places[0]], a.vertices[f.places[0]]);
  return DoubleDoubleNearest{found->on_a, found->on_b,
                             times(times(product(d, found->n), reciprocal(found->N)), found->n)};
}

/// About the way from A to B that is shortest, by Gilbert, Johnson and Keerthi's algorithm in plain double; nothing where they seem to meet.
class Guess {
 public:
  Guess(const NearCore& a, const NearCore& b) : a_(a), b_(b) {}

  [[nodiscard]] std::optional<Plain> way() {
    y_[0] = corner_against({0, 0, 0});
    count_ = 1;
    constexpr int kMostSteps = 24;
    for (int step = 0; step < kMostSteps; ++step) {
      if (!nearest() || count_ == 4) return std::nullopt;
      const Plain next = corner_against(v_);
      const double square = plain_dot(v_, v_);
      if (!(square > 0)) return std::nullopt;
      if (!(square - plain_dot(v_, next) > 0x1p-46 * square) ||
          std::find(y_.begin(), y_.begin() + count_, next) != y_.begin() + count_)
        return v_;
      y_[static_cast<std::size_t>(count_++)] = next;
    }
    return v_;
  }

 private:
  [[nodiscard]] Plain corner_against(const Plain& v) const {
    const Plain p = plain(a_.vertices[farthest(a_, v)]);
    const Plain q = plain(b_.vertices[farthest(b_, {-v[0], -v[1], -v[2]})]);
    return {q[0] - p[0], q[1] - p[1], q[2] - p[2]};
  }

  /// Sets v to the point of the simplex that is nearest to 0, and leaves the corners that it lies between.
  bool nearest() {
    double least = std::numeric_limits<double>::infinity();
    unsigned best = 0;
    for (unsigned subset = 1; subset < 1U << count_; ++subset) {
      Plain found;
      if (!foot_in(subset, found) || !(plain_dot(found, found) < least)) continue;
      least = plain_dot(found, found);
      v_ = found;
      best = subset;
    }
    int left = 0;
    for (int k = 0; k < count_; ++k)
      if (best >> k & 1) y_[static_cast<std::size_t>(left++)] = y_[static_cast<std::size_t>(k)];
    count_ = left;
    return left > 0;
  }
  /// The foot of 0 on what some corners span, if it lies between them.
  bool foot_in(unsigned subset, Plain& found) const {
    std::array<Plain, 4> u{};
    std::size_t n = 0;
    for (int k = 0; k < count_; ++k)
      if (subset >> k & 1) u[n++] = y_[static_cast<std::size_t>(k)];
    const Plain y = u[--n];
    std::array<std::array<double, 4>, 3> m{};
    for (std::size_t i = 0; i < n; ++i) u[i] = {u[i][0] - y[0], u[i][1] - y[1], u[i][2] - y[2]};
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t k = 0; k < n; ++k) m[i][k] = plain_dot(u[i], u[k]);
      m[i][n] = -plain_dot(u[i], y);
    }
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t row = 0; row < n; ++row) {
        if (row == i) continue;
        if (!(m[i][i] > 0)) return false;
        const double by = m[row][i] / m[i][i];
        for (std::size_t k = i; k <= n; ++k) m[row][k] -= by * m[i][k];
      }
    double rest = 1;
    found = y;
    for (std::size_t i = 0; i < n; ++i) {
      const double part = m[i][n] / m[i][i];
      if (!(part > 0)) return false;
      rest -= part;
      for (std::size_t k = 0; k < 3; ++k) found[k] += part * u[i][k];
    }
    return rest > 0;
  }

  const NearCore& a_;
  const NearCore& b_;
  std::array<Plain, 4> y_{};
  int count_ = 0;
  Plain v_{};
};

std::optional<RoundedAnswer> case_apart(const NearCore& a, const NearCore& b, const Plain& way, Distances distances,
                                        Scalar scalar) {
  const Feature* f = farthest_feature(a, way);
  const Feature* g = farthest_feature(b, {-way[0], -way[1], -way[2]});
  if (f == nullptr || g == nullptr) return std::nullopt;
  const auto nearest = nearest_of(a, *f, b, *g);
  if (!nearest || !is_positive(product(nearest->delta, nearest->delta))) return std::nullopt;
  const DoubleDoubles back{-nearest->delta[0], -nearest->delta[1], -nearest->delta[2]};
  if (!are_others_before(a, *f, nearest->delta, nearest->p) || !are_others_before(b, *g, back, nearest->q))
    return std::nullopt;
  return case_of_nearest(*nearest, a.radius, b.radius, distances, scalar);
}

// ---- overlap ----

/// A direction that facets of A - B may face, this way or the other: across a face of one of them, or across an edge of each.
struct Axis {
  DoubleDoubles n;
  DoubleDouble N;
  const Feature* of_a;  ///< a face or an edge
  const Feature* of_b;
};
/// What makes such a direction.
struct Makers {
  const Feature* of_a;
  const Feature* of_b;
};
std::vector<Makers> makers(const NearCore& a, const NearCore& b) {
  std::vector<Makers> all;
  for (const Feature* face : a.features_of(2)) all.push_back({face, nullptr});
  for (const Feature* face : b.features_of(2)) all.push_back({nullptr, face});
  for (const Feature* e : a.features_of(1))
    for (const Feature* f : b.features_of(1)) all.push_back({e, f});
  return all;
}

/// Those of which plain double does not prove that the cores are deeper in each other along them than along another.
///   With C the largest coordinate, S the largest less that of a vertex, and d = 2^-51 C + the radii: a way is off by 3 d in each coordinate, a product of two, of
///   numbers up to 8 S^2, by 64 (S + d) (d + 2^-50 S) = e, and a height by 8 (S + d) (e + 8 S d + 2^-45 S^2). What is used of this is twice as wide.
class Shallow {
 public:
  Shallow(const NearCore& a, const NearCore& b) {
    double largest = 0;
    double radius = 0;
    const Plain base = plain(a.vertices[0]);
    for (const auto& [core, points] : {std::pair(&a, &a_), std::pair(&b, &b_)})
      for (const DoubleDoubles& x : core->vertices) {
        Plain here{};
        for (std::size_t i = 0; i < 3; ++i) {
          here[i] = x[i].high - base[i];
          largest = std::max(largest, std::abs(x[i].high));
          size_ = std::max(size_, std::abs(here[i]));
          radius = std::max(radius, x[i].radius);
        }
        points->push_back(here);
      }
    const double off = 0x1p-51 * largest + radius;
    off_normal_ = 128 * (size_ + off) * (off + 0x1p-50 * size_);
    off_height_ = 16 * (size_ + off) * (off_normal_ + 8 * size_ * off + 0x1p-45 * size_ * size_);
  }

  [[nodiscard]] std::vector<Makers> of(const std::vector<Makers>& all) {
    std::vector<double> least;
    double most = std::numeric_limits<double>::infinity();
    for (const Makers& makers : all) {
      const Plain n = normal(makers);
      const double length = std::sqrt(plain_dot(n, n));
      const auto [low_a, high_a] = extent(a_, n);
      const auto [low_b, high_b] = extent(b_, n);
      const double height = std::min(high_a - low_b, high_b - low_a);
      const bool is_sure = length > 4 * off_normal_;
      least.push_back(is_sure ? (height - off_height_) / (length + 2 * off_normal_) : 0);
      if (is_sure) most = std::min(most, (height + off_height_) / (length - 2 * off_normal_) * (1 + 0x1p-48));
    }
    std::vector<Makers> left;
    for (std::size_t k = 0; k < all.size(); ++k)
      if (!(least[k] * (1 - 0x1p-48) > most)) left.push_back(all[k]);
    return left;
  }

 private:
  [[nodiscard]] static Plain way(const std::vector<Plain>& points, const Feature& feature, std::size_t corner) {
    const Plain& from = points[feature.places[0]];
    const Plain& to = points[feature.places[corner]];
    return {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
  }
  [[nodiscard]] Plain normal(const Makers& makers) const {
    const auto& [f, g] = makers;
    const Plain u = f != nullptr ? way(a_, *f, 1) : way(b_, *g, 1);
    const Plain v = g == nullptr ? way(a_, *f, 2) : f == nullptr ? way(b_, *g, 2) : way(b_, *g, 1);
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  }
  [[nodiscard]] static std::pair<double, double> extent(const std::vector<Plain>& points, const Plain& n) {
    double low = plain_dot(n, points[0]);
    double high = low;
    for (const Plain& x : points) {
      const double here = plain_dot(n, x);
      low = std::min(low, here);
      high = std::max(high, here);
    }
    return {low, high};
  }

  std::vector<Plain> a_;
  std::vector<Plain> b_;
  double size_ = 0;
  double off_normal_ = 0;
  double off_height_ = 0;
};

/// All that may be of the least depth; nothing where one may be 0.
std::optional<std::vector<Axis>> axes(const NearCore& a, const NearCore& b) {
  std::vector<Axis> all;
  for (const auto& [of_a, of_b] : Shallow(a, b).of(makers(a, b))) {
    const DoubleDoubles n = of_b == nullptr   ? normal_of(a, *of_a)
                            : of_a == nullptr ? normal_of(b, *of_b)
                                              : across(way_of(a, *of_a, 1), way_of(b, *of_b, 1));
    all.push_back({n, product(n, n), of_a, of_b});
    if (!is_clear(all.back().N)) return std::nullopt;
  }
  return all;
}

/// The least and the greatest n.x of a core.
struct Extent {
  DoubleDouble least;
  DoubleDouble most;
};
Extent extent(const NearCore& core, const DoubleDoubles& n) {
  // What is least of all midpoints is as near to the least of all as the widest radius says.
  Extent found{product(n, core.vertices[0]), {}};
  found.most = found.least;
  double radius = found.least.radius;
  const auto is_less = [](const DoubleDouble& x, const DoubleDouble& y) {
    return x.high < y.high || (x.high == y.high && x.low < y.low);
  };
  for (std::size_t k = 1; k < core.vertices.size(); ++k) {
    const DoubleDouble here = product(n, core.vertices[k]);
    // What is no number stays none.
    if (!std::isnan(radius) && !(here.radius <= radius)) radius = here.radius;
    if (is_less(here, found.least)) found.least = here;
    if (is_less(found.most, here)) found.most = here;
  }
  found.least.radius = found.most.radius = radius;
  return found;
}

/// The feature parallel to another that lies farthest along a direction, as plain double finds it.
const Feature& farthest_like(const NearCore& core, const Feature& like, const Plain& way) {
  const Feature* best = &like;
  if (!core.features.back().is_parallelogram()) return like;
  const std::size_t turned = farthest(core, way);  // a corner of it
  const auto directions = [](const Feature& feature) {
    std::size_t bits = 0;
    for (const std::size_t corner : feature.corners()) bits |= corner ^ feature.places[0];
    return bits;
  };
  for (const Feature& feature : core.features)
    if (feature.size == like.size && directions(feature) == directions(like) && feature.has(turned)) best = &feature;
  return *best;
}

std::optional<RoundedAnswer> case_meeting(const NearCore& a, const NearCore& b, Distances distances, Scalar scalar) {
  const auto all = axes(a, b);
  if (!all || all->empty()) return std::nullopt;
  struct Facing {
    const Axis* axis;
    bool turned;
    DoubleDouble height;
  };
  std::vector<Facing> facings;
  for (const Axis& axis : *all) {
    const Extent of_a = extent(a, axis.n);
    const Extent of_b = extent(b, axis.n);
    facings.push_back({&axis, false, of_a.most - of_b.least});
    facings.push_back({&axis, true, of_b.most - of_a.least});
  }
  const auto is_nearer = [](const Facing& x, const Facing& y) {
    return x.height.high * x.height.high * y.axis->N.high < y.height.high * y.height.high * x.axis->N.high;
  };
  const Facing& least = *std::min_element(facings.begin(), facings.end(), is_nearer);
  const DoubleDouble least2 = times(least.height, least.height);
  for (const Facing& other : facings) {
    if (!is_positive(other.height)) return std::nullopt;
    if (&other != &least &&
        !is_positive(times(times(other.height, other.height), least.axis->N) - times(least2, other.axis->N)))
      return std::nullopt;
  }

  const auto& [n, N, of_a, of_b] = *least.axis;
  const DoubleDoubles m = least.turned ? DoubleDoubles{-n[0], -n[1], -n[2]} : n;
  const DoubleDoubles back{-m[0], -m[1], -m[2]};
  const DoubleDoubles out = times(times(least.height, reciprocal(N)), m);
  DoubleDoubles p;
  DoubleDoubles q;
  if (of_b == nullptr) {
    const Feature& face = farthest_like(a, *of_a, plain(m));
    const Feature vertex = features::vertex(farthest(b, plain(back)));
    q = b.vertices[vertex.places[0]];
    p = sum(q, out);
    if (!are_others_before(a, face, m, a.vertices[face.places[0]]) || !are_others_before(b, vertex, back, q) ||
        !is_over(a, face, q))
      return std::nullopt;
  } else if (of_a == nullptr) {
    const Feature& face = farthest_like(b, *of_b, plain(back));
    const Feature vertex = features::vertex(farthest(a, plain(m)));
    p = a.vertices[vertex.places[0]];
    q = minus(p, out);
    if (!are_others_before(b, face, back, b.vertices[face.places[0]]) || !are_others_before(a, vertex, m, p) ||
        !is_over(b, face, p))
      return std::nullopt;
  } else {
    const Feature& e = farthest_like(a, *of_a, plain(m));
    const Feature& f = farthest_like(b, *of_b, plain(back));
    if (!are_others_before(a, e, m, a.vertices[e.places[0]]) || !are_others_before(b, f, back, b.vertices[f.places[0]]))
      return std::nullopt;
    const auto found = crossing(a, e, b, f);
    if (!found) return std::nullopt;
    p = found->on_a;
    q = found->on_b;
  }
  const DoubleDouble inverse = reciprocal(root(N));
  return case_along({p, q, times(inverse, m), -times(least.height, inverse), -1, -1, false, true}, a.radius, b.radius,
                    distances, scalar);
}

}  // namespace

// Not compiled again for processors with fma, where all of it would be one function twice: that takes longer than the time it saves.
[[gnu::noinline]] std::optional<RoundedAnswer> case_of_convexes(const Convexes& shapes, Distances distances,
                                                                Scalar scalar) {
  if (!in_range(distances.alarm, kMostOfCores) || !in_range(distances.contact, kMostOfCores)) return std::nullopt;
  const auto a = near_core(shapes.a);
  if (!a) return std::nullopt;
  if (const auto* plane = std::get_if<Plane>(&shapes.b.shape)) {
    const DoubleDoubles n = exactly(plane->normal);
    const DoubleDoubles down{-n[0], -n[1], -n[2]};
    const std::size_t lowest = farthest(*a, plain(down));
    const DoubleDoubles& p = a->vertices[lowest];
    if (!in_range(plane->normal, kMostOfCores) || !are_others_before(*a, features::vertex(lowest), down, p))
      return std::nullopt;
    return case_over_plane({p, product(n, p), true}, a->radius, *plane, distances, scalar);
  }
  const auto b = near_core(shapes.b);
  if (!b) return std::nullopt;
  if (const auto way = Guess(*a, *b).way()) return case_apart(*a, *b, *way, distances, scalar);
  return case_meeting(*a, *b, distances, scalar);
}

}  // namespace contact::oracle
