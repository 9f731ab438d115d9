// Two convex cores, in integers.
//
// Most decisions are proved in plain double, convexes_filter.hpp, and most contacts rounded from numbers that bound their error, convexes_enclosed.hpp. Else the
// vertices of both are integers on one grid, over one denominator: that of the rotations. Gilbert, Johnson and Keerthi's algorithm finds the
// point v of B - A that is nearest to 0: in plain double first, which only proposes corners to begin with, then in integers, where each step is exact and the
// distance falls, so that it ends, at
//   v.(b - a) >= v.v     for all vertices a of A and b of B
// which proves v. Where 0 lies in B - A, a polytope of corners of A - B grows around 0, expanding_polytope.hpp, until no vertex lies beyond its nearest faces: these are
// then the facets of A - B that are nearest to 0, and the depth is how far.
#include "contact/convexes.hpp"

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "contact/pair_functions.hpp"
#include "kernel/convexes_enclosed.hpp"
#include "kernel/core_pairs.hpp"
#include "kernel/cores.hpp"
#include "kernel/cores_stages.hpp"
#include "kernel/expanding_polytope.hpp"
#include "kernel/floating_point_environment.hpp"
#include "kernel/plane_cores.hpp"
#include "kernel/sphere_sphere_numbers.hpp"

namespace contact::inline CONTACT_ABI {
namespace {
namespace convexes {

using namespace kernel;

// ---- cores ----

/// A core: points that it is the convex hull of, none twice, over a denominator > 0.
struct Polytope {
  std::vector<IntegerVector> vertices;
  Integer over = 1;
};

IntegerVector sum(const IntegerVector& x, const IntegerVector& y) { return combined(1, x, 1, y); }
IntegerVector times(const Integer& k, const IntegerVector& x) { return {k * x[0], k * x[1], k * x[2]}; }

Polytope of_points(std::vector<IntegerVector> points) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return {std::move(points)};
}
/// To every vertex what a way adds.
void extend(Polytope& core, const IntegerVector& way) {
  if (way == kNowhere) return;
  for (std::size_t k = core.vertices.size(); k-- > 0;) core.vertices.push_back(sum(core.vertices[k], way));
}

template <class Shape>
Grid grid_of(const Shape& shape) {
  std::array<double, kNumbersOf<Shape>> numbers;
  std::size_t count = 0;
  for_each_field(shape, [&](const auto& field, const auto& value) {
    if (!has_free_length(field.kind)) for_each_number_in(value, [&](double x) { numbers[count++] = x; });
  });
  return Grid(std::span(numbers).first(count));
}

template <class Shape>
Polytope core_of(const Grid& grid, const Shape& shape) {
  std::vector<IntegerVector> points;
  for_each_point(shape, [&](const Vector3& x) { points.push_back(on_grid(grid, x)); });
  return of_points(std::move(points));
}
/// A box: its middle and half of its edges, over a denominator > 0.
struct ExactBox {
  IntegerVector middle;
  std::array<IntegerVector, 3> halves;
  Integer over;

  [[nodiscard]] bool has_volume() const { return std::find(halves.begin(), halves.end(), kNowhere) == halves.end(); }
};
ExactBox box_of(const Grid& grid, const Box& box) {
  const IntegerVector low = on_grid(grid, box.min);
  const IntegerVector high = on_grid(grid, box.max);
  ExactBox found{sum(low, high), {kNowhere, kNowhere, kNowhere}, 2};
  for (std::size_t axis = 0; axis < 3; ++axis) found.halves[axis][axis] = high[axis] - low[axis];
  return found;
}
ExactBox box_of(const Grid& grid, const Obb& box) {
  const Quaternion& q = box.orientation;
  const Grid of_rotation{q[0], q[1], q[2], q[3]};
  const Integer x = of_rotation(q[0]);
  const Integer y = of_rotation(q[1]);
  const Integer z = of_rotation(q[2]);
  const Integer w = of_rotation(q[3]);
  // |q|^2 times the rotation's columns.
  const std::array<IntegerVector, 3> columns{
      IntegerVector{w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)},
      IntegerVector{2 * (x * y - w * z), w * w - x * x + y * y - z * z, 2 * (y * z + w * x)},
      IntegerVector{2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z}};
  const Integer over = x * x + y * y + z * z + w * w;
  const auto half = [&](std::size_t axis) {
    return times(grid(box.extents[static_cast<Eigen::Index>(axis)]), columns[axis]);
  };
  return {times(over, on_grid(grid, box.center)), {half(0), half(1), half(2)}, over};
}
template <class AnyBox>
requires kIsOneOf<AnyBox, Box, Obb> Polytope core_of(const Grid& grid, const AnyBox& any_box) {
  const auto& [middle, halves, over] = box_of(grid, any_box);
  Polytope core{{middle}, over};
  for (const IntegerVector& half : halves) {
    for (IntegerVector& corner : core.vertices) corner = corner - half;
    extend(core, times(2, half));
  }
  return core;
}

/// Two cores over one denominator.
struct TwoCores {
  Polytope a;
  Polytope b;
  [[nodiscard]] const Integer& over() const { return a.over; }
};
TwoCores over_one_denominator(Polytope a, Polytope b) {
  const Integer by_a = b.over;
  const Integer by_b = a.over;
  for (IntegerVector& x : a.vertices) x = times(by_a, x);
  for (IntegerVector& x : b.vertices) x = times(by_b, x);
  a.over = b.over = by_a * by_b;
  return {std::move(a), std::move(b)};
}

// ---- nearest points ----

template <class Number>
using Vector = std::array<Number, 3>;
template <class Number>
Number product(const Vector<Number>& x, const Vector<Number>& y) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

/// A corner of B - A, by the places of the vertices.
struct Corner {
  std::size_t a;
  std::size_t b;
  friend bool operator==(const Corner&, const Corner&) = default;
};

/// A point of a simplex: the sum of parts[k] / whole corners[k]; it is `at` / whole.
template <class Number>
struct PointOf {
  std::vector<Corner> corners;
  std::vector<Number> parts;  ///< > 0
  Number whole;
  Vector<Number> at;
};

/// The vertices of A and of B, as integers, or nearly.
template <class Number>
class Difference {
 public:
  Difference(const std::vector<Vector<Number>>& a, const std::vector<Vector<Number>>& b) : a_(a), b_(b) {}

  [[nodiscard]] Vector<Number> operator()(const Corner& c) const {
    return {b_[c.b][0] - a_[c.a][0], b_[c.b][1] - a_[c.a][1], b_[c.b][2] - a_[c.a][2]};
  }
  /// The corner that lies farthest against a direction.
  [[nodiscard]] Corner farthest_against(const Vector<Number>& v) const {
    const auto first = [&](const std::vector<Vector<Number>>& of, bool against) {
      std::size_t best = 0;
      Number most = product(v, of[0]);
      for (std::size_t k = 1; k < of.size(); ++k)
        if (Number along = product(v, of[k]); against ? along < most : most < along) best = k, most = std::move(along);
      return best;
    };
    return {first(a_, false), first(b_, true)};
  }

  /// The point of a simplex of at most four corners that is nearest to 0: the one inside a part of it that is nearest to 0 in the
  /// part's space, plane, line or corner, where no other corner lies nearer along it. The largest part that has such a point
  /// answers; in plain double maybe none has, and a corner does.
  [[nodiscard]] PointOf<Number> nearest_of(const std::vector<Corner>& simplex) const {
    PointOf<Number> found;
    constexpr std::array<unsigned, 15> kLargestFirst{15, 14, 13, 11, 7, 12, 10, 9, 6, 5, 3, 8, 4, 2, 1};
    for (const unsigned part : kLargestFirst) {
      if (part >> simplex.size() != 0) continue;
      found.corners.clear();
      for (std::size_t k = 0; k < simplex.size(); ++k)
        if (part >> k & 1) found.corners.push_back(simplex[k]);
      if (!solve(found)) continue;
      if (std::none_of(simplex.begin(), simplex.end(), [&](const Corner& c) { return is_nearer_along(found, c); }))
        break;
    }
    return found;
  }
  /// Whether a corner lies nearer to 0 along v than v: all corners of v lie where it does.
  [[nodiscard]] bool is_nearer_along(const PointOf<Number>& v, const Corner& c) const {
    return std::find(v.corners.begin(), v.corners.end(), c) == v.corners.end() &&
           product(v.at, (*this)(c)) < product(v.at, (*this)(v.corners[0]));
  }

 private:
  /// Sets the parts; whether all are above 0.
  [[nodiscard]] bool solve(PointOf<Number>& x) const {
    const std::size_t n = x.corners.size();
    const Vector<Number> y = (*this)(x.corners[0]);
    std::array<Vector<Number>, 3> u;
    for (std::size_t k = 1; k < n; ++k) {
      const Vector<Number> other = (*this)(x.corners[k]);
      u[k - 1] = {other[0] - y[0], other[1] - y[1], other[2] - y[2]};
    }
    x.parts.assign(n, Number(0));
    const auto against = [&](const Vector<Number>& v) { return Number(0) - product(y, v); };
    if (n == 1) {
      x.whole = Number(1);
    } else if (n == 2) {
      x.whole = product(u[0], u[0]);
      x.parts[1] = against(u[0]);
    } else if (n == 3) {
      const Number A = product(u[0], u[0]);
      const Number B = product(u[0], u[1]);
      const Number C = product(u[1], u[1]);
      const Number r = against(u[0]);
      const Number s = against(u[1]);
      x.whole = A * C - B * B;
      x.parts[1] = r * C - s * B;
      x.parts[2] = s * A - r * B;
    } else {
      const auto across = [](const Vector<Number>& v, const Vector<Number>& w) {
        return Vector<Number>{v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2], v[0] * w[1] - v[1] * w[0]};
      };
      for (std::size_t k = 0; k < 3; ++k) x.parts[k + 1] = against(across(u[(k + 1) % 3], u[(k + 2) % 3]));
      x.whole = product(u[0], across(u[1], u[2]));
      if (x.whole < 0) {
        x.whole = Number(0) - x.whole;
        for (Number& part : x.parts) part = Number(0) - part;
      }
    }
    x.parts[0] = x.whole;
    for (std::size_t k = 1; k < n; ++k) x.parts[0] -= x.parts[k];
    if (!(x.whole > 0) || !std::all_of(x.parts.begin(), x.parts.end(), [](const Number& part) { return part > 0; }))
      return false;
    x.at = {Number(0), Number(0), Number(0)};
    if (n < 4)
      for (std::size_t k = 0; k < n; ++k) {
        const Vector<Number> corner = (*this)(x.corners[k]);
        for (std::size_t i = 0; i < 3; ++i) x.at[i] += x.parts[k] * corner[i];
      }
    return true;
  }

  const std::vector<Vector<Number>>& a_;
  const std::vector<Vector<Number>>& b_;
};

/// The point of B - A nearest to 0, from some corners on.
PointOf<Integer> nearest_from(std::vector<Corner> corners, const Difference<Integer>& difference) {
  for (;;) {
    PointOf<Integer> v = difference.nearest_of(corners);
    if (v.at == kNowhere) return v;
    const Corner next = difference.farthest_against(v.at);
    if (!difference.is_nearer_along(v, next)) return v;
    corners = v.corners;
    corners.push_back(next);
  }
}

/// Corners that plain double takes for those of the nearest point.
std::vector<Corner> proposed(const TwoCores& cores) {
  using Nearly = std::vector<Vector<double>>;
  std::size_t bits = 0;
  for (const Polytope* core : {&cores.a, &cores.b})
    for (const IntegerVector& x : core->vertices)
      for (const Integer& each : x)
        if (!each.is_zero()) bits = std::max<std::size_t>(bits, msb(abs(each)) + 1);
  constexpr std::size_t kEnough = 50;  // products of many stay in the range of double
  const auto drop = static_cast<unsigned>(bits > kEnough ? bits - kEnough : 0);
  const auto nearly = [&](const Polytope& core) {
    Nearly all;
    for (const IntegerVector& x : core.vertices) {
      const auto at = [&](std::size_t i) {
        return (x[i].sign() < 0 ? -1 : 1) * Integer(abs(x[i]) >> drop).convert_to<double>();
      };
      all.push_back({at(0), at(1), at(2)});
    }
    return all;
  };
  const Nearly a = nearly(cores.a);
  const Nearly b = nearly(cores.b);
  const Difference<double> difference(a, b);
  std::vector<Corner> corners{{0, 0}};
  constexpr int kMostGuessSteps = 32;
  for (int step = 0; step < kMostGuessSteps; ++step) {
    const PointOf<double> v = difference.nearest_of(corners);
    const Corner next = difference.farthest_against(v.at);
    corners = v.corners;
    if (corners.size() == 4 || !difference.is_nearer_along(v, next)) break;
    corners.push_back(next);
  }
  return corners;
}

// ---- sets of nearest points ----

/// A point over a denominator > 0.
struct Quotient {
  IntegerVector at;
  Integer over;
};
bool is_less(const Quotient& x, const Quotient& y) {
  for (std::size_t i = 0; i < 3; ++i)
    if (const int order = Integer(x.at[i] * y.over).compare(y.at[i] * x.over)) return order < 0;
  return false;
}
/// The middle between the lexicographically least and greatest of some points, and whether they are one.
struct Middle {
  Quotient at;
  bool unique;
};
Middle middle_of(const std::vector<Quotient>& points) {
  const auto [low, high] = std::minmax_element(points.begin(), points.end(), is_less);
  if (!is_less(*low, *high)) return {*low, true};
  return {{combined(high->over, low->at, low->over, high->at), 2 * low->over * high->over}, false};
}

/// What two sets of points in a plane span in common, as points between which it lies: corners of each that lie in the other, and where edges cross.
class InPlane {
 public:
  InPlane(std::vector<IntegerVector> a, std::vector<IntegerVector> b, const IntegerVector& normal)
      : seen_along_(first_that_is_not_0(normal)), a_(polygon_of(std::move(a))), b_(polygon_of(std::move(b))) {}

  [[nodiscard]] std::vector<Quotient> common() const {
    std::vector<Quotient> all;
    for (const IntegerVector& x : a_)
      if (holds(b_, x)) all.push_back({x, 1});
    for (const IntegerVector& x : b_)
      if (holds(a_, x)) all.push_back({x, 1});
    for (std::size_t i = 0; i < a_.size(); ++i)
      for (std::size_t k = 0; k < b_.size(); ++k) cross_at(a_[i], next(a_, i) - a_[i], b_[k], next(b_, k) - b_[k], all);
    return all;
  }

 private:
  /// Its corners, counterclockwise as it is seen; of a segment its ends, or one point.
  using Polygon = std::vector<IntegerVector>;
  [[nodiscard]] static const IntegerVector& next(const Polygon& of, std::size_t k) { return of[(k + 1) % of.size()]; }
  static std::size_t first_that_is_not_0(const IntegerVector& n) {
    return n[0].sign() != 0 ? 0 : n[1].sign() != 0 ? 1 : 2;
  }
  /// n.(u x v), but for a factor that is the same for all: u x v lies along n, and one component says how far. Where the factor is below 0 the plane is seen from behind.
  [[nodiscard]] Integer turn(const IntegerVector& u, const IntegerVector& v) const {
    const std::size_t i = (seen_along_ + 1) % 3;
    const std::size_t k = (seen_along_ + 2) % 3;
    return u[i] * v[k] - u[k] * v[i];
  }

  /// What points span, by Andrew's chains: from the least to the greatest, and back.
  [[nodiscard]] Polygon polygon_of(std::vector<IntegerVector> points) const {
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) return points;
    Polygon corners;
    const auto add = [&](std::size_t chain, const IntegerVector& x) {
      while (corners.size() > chain + 1 &&
             turn(corners.back() - corners[corners.size() - 2], x - corners.back()).sign() <= 0)
        corners.pop_back();
      corners.push_back(x);
    };
    for (const IntegerVector& x : points) add(0, x);
    const std::size_t greatest = corners.size() - 1;
    for (std::size_t k = points.size() - 1; k-- > 0;) add(greatest, points[k]);
    corners.pop_back();
    return corners;
  }
  [[nodiscard]] bool holds(const Polygon& of, const IntegerVector& x) const {
    for (std::size_t k = 0; k < of.size(); ++k)
      if (turn(next(of, k) - of[k], x - of[k]).sign() < 0) return false;
    return of.size() > 2 || dot(of.front() - x, of.back() - x).sign() <= 0;
  }
  void cross_at(const IntegerVector& a, const IntegerVector& u, const IntegerVector& b, const IntegerVector& w,
                std::vector<Quotient>& all) const {
    Integer whole = turn(u, w);
    if (whole.is_zero()) return;
    Integer of_u = turn(b - a, w);
    Integer of_w = turn(b - a, u);
    if (whole.sign() < 0) whole = -whole, of_u = -of_u, of_w = -of_w;
    if (of_u.sign() < 0 || of_u > whole || of_w.sign() < 0 || of_w > whole) return;
    all.push_back({combined(whole, a, of_u, u), whole});
  }

  std::size_t seen_along_;
  Polygon a_;
  Polygon b_;
};

/// The vertices that lie farthest along a direction.
std::vector<IntegerVector> farthest(const std::vector<IntegerVector>& of, const IntegerVector& along) {
  std::vector<IntegerVector> found;
  Integer most;
  for (const IntegerVector& x : of) {
    Integer here = dot(along, x);
    if (!found.empty() && here < most) continue;
    if (!found.empty() && here > most) found.clear();
    if (found.empty()) most = std::move(here);
    found.push_back(x);
  }
  return found;
}

std::vector<IntegerVector> moved(std::vector<IntegerVector> points, const Integer& times_each,
                                 const IntegerVector& way) {
  for (IntegerVector& x : points) x = combined(times_each, x, 1, way);
  return points;
}

/// The nearest points of cores that are apart.
ExactNearest nearest_apart(const TwoCores& cores, const PointOf<Integer>& v) {
  std::vector<IntegerVector> a = farthest(cores.a.vertices, v.at);
  std::vector<IntegerVector> b = farthest(cores.b.vertices, kNowhere - v.at);
  Middle middle{{kNowhere, 1}, true};
  if (a.size() == 1) {
    middle.at.at = times(v.whole, a[0]);
  } else if (b.size() == 1) {
    middle.at.at = times(v.whole, b[0]) - v.at;
  } else {
    middle = middle_of(
        InPlane(moved(std::move(a), v.whole, kNowhere), moved(std::move(b), v.whole, kNowhere - v.at), v.at).common());
  }
  const auto& [p, over] = middle.at;
  return {p, combined(1, p, over, v.at), over * v.whole * cores.over(), middle.unique, kNowhere};
}

// ---- cores that meet ----

/// Corners of A - B that span all of it, and 0 lies in what they span: four, three of what lies in a plane, and so on.
std::vector<IntegerVector> spanning(const Difference<Integer>& difference, const PointOf<Integer>& v) {
  std::vector<IntegerVector> corners;
  for (const Corner& corner : v.corners) corners.push_back(kNowhere - difference(corner));
  const std::array<IntegerVector, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const auto add_one_across = [&](const IntegerVector& n) {
    for (const IntegerVector& way : {n, kNowhere - n}) {
      const IntegerVector corner = kNowhere - difference(difference.farthest_against(way));
      if (dot(way, corner - corners[0]).is_zero()) continue;
      corners.push_back(corner);
      return true;
    }
    return false;
  };
  const auto from_first = [&](std::size_t k) { return corners[k] - corners[0]; };
  const auto cross_axis = [&](const IntegerVector& axis) { return add_one_across(cross(axis, from_first(1))); };
  if (corners.size() == 1) std::any_of(axes.begin(), axes.end(), add_one_across);
  if (corners.size() == 2) std::any_of(axes.begin(), axes.end(), cross_axis);
  if (corners.size() == 3) add_one_across(cross(from_first(1), from_first(2)));
  return corners;
}

/// The nearest points of cores that meet in a line that holds both, or in the one point of both.
ExactNearest nearest_in_line(const TwoCores& cores, const IntegerVector& u) {
  const auto [low_a, high_a] = std::minmax_element(cores.a.vertices.begin(), cores.a.vertices.end());
  const auto [low_b, high_b] = std::minmax_element(cores.b.vertices.begin(), cores.b.vertices.end());
  const auto [at, unique] = middle_of({{std::max(*low_a, *low_b), 1}, {std::min(*high_a, *high_b), 1}});
  IntegerVector agreed{u[1] * u[1] + u[2] * u[2], -u[0] * u[1], -u[0] * u[2]};
  if (agreed == kNowhere) agreed = u == kNowhere ? IntegerVector{1, 0, 0} : IntegerVector{0, 1, 0};
  return {at.at, at.at, at.over * cores.over(), unique, agreed};
}

/// A facet of A - B: the way that it faces, and how far max N.a lies above min N.b.
struct Facet {
  IntegerVector normal;
  Integer height;
};
/// The logarithm of height^2 / square, off by less than 2^-34.
struct Nearness {
  static constexpr double kCertain = 0x1p-32;
  static double of(const Integer& height, const Integer& square) {
    return 2 * approximate_log2(height) - approximate_log2(square);
  }
};
using Expanding = ExpandingPolytope<Integer, Nearness>;
/// The one that is nearest to 0, and of several the preferred one.
///   What no vertex lies beyond is a facet's plane. Where that holds for all faces of the least depth, there is no other facet of that depth: a ball of that radius lies in the polytope, so that
///   each touches it, and at depth 0 the polytope fills all of A - B that is near 0.
Facet nearest_facet(const Difference<Integer>& difference, const std::vector<IntegerVector>& corners) {
  Expanding polytope({corners[0], corners[1], corners[2], corners[3]});
  std::optional<Expanding::Face> best;
  while (!polytope.faces().empty()) {
    const Expanding::Face& face = polytope.nearest();
    if (best && best->is_nearer_than(face)) break;
    if (polytope.insert(kNowhere - difference(difference.farthest_against(face.normal)))) continue;
    Expanding::Face facet = polytope.finished(face);
    if (!best || is_preferred(facet.normal, best->normal)) best = std::move(facet);
  }
  return {best->normal, best->height};
}

/// The directions of facets of A - B of two boxes with a volume, as NearBoxes counts them: any two edges that are not along each other, of one box or of both, make a facet.
class BoxDirections {
 public:
  BoxDirections(const ExactBox& a, const ExactBox& b) : between_(times(a.over, b.middle) - times(b.over, a.middle)) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      halves_[axis] = times(b.over, a.halves[axis]);
      halves_[3 + axis] = times(a.over, b.halves[axis]);
    }
  }
  /// That of two facets which is nearer to 0, or preferred; nothing where there is none. Its height is below 0 where the boxes are apart along it.
  [[nodiscard]] std::optional<Facet> facet(std::size_t k) const {
    Facet found{k < 6 ? halves_[k] : cross(halves_[(k - 6) / 3], halves_[3 + (k - 6) % 3]), 0};
    if (found.normal == kNowhere) return std::nullopt;
    found.height = -dot(found.normal, between_);
    if (found.height.sign() > 0 || (found.height.is_zero() && !is_preferred(found.normal, kNowhere - found.normal)))
      found.normal = kNowhere - found.normal, found.height = -found.height;
    for (const IntegerVector& half : halves_) found.height += abs(dot(found.normal, half));
    return found;
  }

 private:
  IntegerVector between_;
  std::array<IntegerVector, 6> halves_;
};
/// The facet of A - B that is nearest to 0, or nothing where the boxes are apart. Those are tried that `directions` has.
std::optional<Facet> nearest_facet_of_boxes(const BoxDirections& boxes, unsigned directions) {
  std::optional<Expanding::Face> best;
  for (std::size_t k = 0; k < 15; ++k) {
    if ((directions >> k & 1) == 0) continue;
    const std::optional<Facet> facet = boxes.facet(k);
    if (!facet) continue;
    if (facet->height.sign() < 0) return std::nullopt;
    Expanding::Face face{{}, facet->normal, dot(facet->normal, facet->normal), facet->height, 0};
    face.nearness = Nearness::of(face.height, face.square);
    if (!best || face.is_nearer_than(*best) || (!best->is_nearer_than(face) && is_preferred(face.normal, best->normal)))
      best = std::move(face);
  }
  return Facet{best->normal, best->height};
}
/// Whether boxes with a volume meet.
bool do_meet(const BoxDirections& boxes, unsigned directions) {
  for (std::size_t k = 0; k < 15; ++k)
    if (directions >> k & 1)
      if (const auto facet = boxes.facet(k); facet && facet->height.sign() < 0) return false;
  return true;
}

/// The nearest points of cores that meet, at the facet of A - B that is nearest to 0.
ExactNearest nearest_at(const TwoCores& cores, const Facet& facet) {
  // All that follows is as long as the normal, which often has a long factor: of a rotation's denominator.
  const Integer factor = gcd(gcd(facet.normal[0], facet.normal[1]), facet.normal[2]);
  const auto& [n, height] =
      Facet{{facet.normal[0] / factor, facet.normal[1] / factor, facet.normal[2] / factor}, facet.height / factor};
  const Integer N = dot(n, n);
  // B, moved out: q + (height / N) n.
  const auto [at, unique] = middle_of(InPlane(moved(farthest(cores.a.vertices, n), N, kNowhere),
                                              moved(farthest(cores.b.vertices, kNowhere - n), N, times(height, n)), n)
                                          .common());
  ExactNearest nearest{at.at, combined(1, at.at, -at.over * height, n), at.over * N * cores.over(), unique, n};
  nearest.overlap = !height.is_zero();
  return nearest;
}
/// The same of cores that meet in a point that is known.
ExactNearest nearest_meeting(const TwoCores& cores, const PointOf<Integer>& v) {
  const Difference<Integer> difference(cores.a.vertices, cores.b.vertices);
  const std::vector<IntegerVector> corners = spanning(difference, v);
  if (corners.size() < 3) return nearest_in_line(cores, corners.back() - corners[0]);
  if (corners.size() == 4) return nearest_at(cores, nearest_facet(difference, corners));
  const IntegerVector n = cross(corners[1] - corners[0], corners[2] - corners[0]);
  return nearest_at(cores, {is_preferred(n, kNowhere - n) ? n : kNowhere - n, 0});
}

// ---- the exact stage ----

/// A question about two cores, on a grid of its points and lengths.
struct Asked {
  Grid grid;
  Lengths lengths;
  TwoCores cores;
};
template <class A, class B>
Asked asked(const A& a, const B& b, Distances distances) {
  const Grid grid({distances.alarm, distances.contact}, std::min(grid_of(a).exponent(), grid_of(b).exponent()));
  return {grid, lengths_of(a, b, distances), over_one_denominator(core_of(grid, a), core_of(grid, b))};
}

/// The directions among which plain double is sure that the nearest facet of two boxes is, as NearBoxes counts them.
unsigned directions_of_facet(const NearCore& a, const NearCore& b) {
  constexpr unsigned kAll = (1U << 15) - 1;
  const NearScale scale(a, b, 0);
  if (!scale.holds()) return kAll;
  NearBoxes depths(a, b, scale);
  return depths.side(0) == NearSide::miss ? kAll : depths.candidates();
}
/// A question about two cores, and the point of B - A that is nearest to 0, or of boxes that meet the facet of A - B.
struct ExactCores {
  Asked asked;
  PointOf<Integer> v;
  std::optional<Facet> facet = {};
};
template <class A, class B>
constexpr bool kAreBoxes = kIsOneOf<A, Box, Obb>&& kIsOneOf<B, Box, Obb>;
template <class A, class B>
[[gnu::noinline]] ExactCores exactly(const A& a, const B& b, Distances distances, bool wants_numbers = false) {
  Asked of = asked(a, b, distances);
  if constexpr (kAreBoxes<A, B>)
    if (wants_numbers && of.cores.a.vertices.size() == 8 && of.cores.b.vertices.size() == 8) {
      const BoxDirections boxes(box_of(of.grid, a), box_of(of.grid, b));
      auto facet = nearest_facet_of_boxes(boxes, directions_of_facet(near_core(a), near_core(b)));
      if (facet) return {std::move(of), {}, std::move(facet)};
    }
  PointOf<Integer> v = nearest_from(proposed(of.cores), Difference<Integer>(of.cores.a.vertices, of.cores.b.vertices));
  return {std::move(of), std::move(v)};
}
bool is_hit(const ExactCores& of) {
  return of.facet || is_hit({kNowhere, of.v.at, of.v.whole * of.asked.cores.over(), true, kNowhere}, of.asked.grid,
                            of.asked.lengths);
}
/// The numbers that are open, exactly.
void round_open(const ExactCores& of, ContactPoints points, unsigned open, Contact& contact) {
  const auto& [grid, lengths, cores] = of.asked;
  round_exactly(of.facet              ? nearest_at(cores, *of.facet)
                : of.v.at == kNowhere ? nearest_meeting(cores, of.v)
                                      : nearest_apart(cores, of.v),
                grid, lengths, points, open, contact);
}

/// The lowest point of a core over a plane.
struct OverPlane {
  PlaneGrids grids;
  Lengths lengths;
  ExactLowest lowest;
};
template <class A>
[[gnu::noinline]] OverPlane exactly(const A& a, const Plane& plane, Distances distances,
                                    bool /*wants_numbers*/ = false) {
  const Grid normal{plane.normal[0], plane.normal[1], plane.normal[2]};
  const Grid of_offset{plane.offset};
  const Grid points({distances.alarm, distances.contact},
                    std::min(grid_of(a).exponent(), of_offset.exponent() - normal.exponent()));
  const Polytope core = core_of(points, a);
  const IntegerVector n = on_grid(normal, plane.normal);
  std::vector<Quotient> lowest;
  for (const IntegerVector& x : farthest(core.vertices, kNowhere - n)) lowest.push_back({x, 1});
  auto [at, unique] = middle_of(lowest);
  ExactLowest found{at.at, at.over * core.over, unique, n, 0};
  const int finer = of_offset.exponent() - (points.exponent() + normal.exponent());
  const Integer offset = of_offset(plane.offset) << static_cast<unsigned>(finer);
  found.height = dot(n, found.p) - found.over * offset;
  return {{points, normal}, lengths_of(a, plane, distances), std::move(found)};
}
bool is_hit(const OverPlane& of) { return is_hit(of.lowest, of.grids, of.lengths); }
void round_open(const OverPlane& of, ContactPoints points, unsigned open, Contact& contact) {
  round_exactly(of.lowest, of.grids, of.lengths, points, open, contact);
}

/// Whether two cores are within the alarm distance and their radii. Boxes that meet, or that are apart where they have to meet, are told by a few directions.
template <class A, class B>
[[gnu::noinline]] bool decide_exactly_of(const A& a, const B& b, double alarm) {
  if constexpr (kAreBoxes<A, B>) {
    const Grid grid({0}, std::min(grid_of(a).exponent(), grid_of(b).exponent()));
    const ExactBox of_a = box_of(grid, a);
    const ExactBox of_b = box_of(grid, b);
    if (of_a.has_volume() && of_b.has_volume()) {
      const bool meet = do_meet({of_a, of_b}, directions_of_facet(near_core(a), near_core(b)));
      if (meet || alarm == 0) return meet;
    }
  }
  return is_hit(exactly(a, b, {alarm, 0}));
}

// ---- answers ----

#if defined(__x86_64__) && !defined(__FMA__)
#define CONTACT_BY_FMA(ask) \
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return by_fma::ask
#else
#define CONTACT_BY_FMA(ask)
#endif
template <class... Arguments>
Certain certain_of(Arguments&&... arguments) {
  CONTACT_BY_FMA(certain(arguments...));
  return plain::certain(arguments...);
}
template <class A, class B>
NearSide nearly(const A& a, const B& b, double alarm) {
  CONTACT_BY_FMA(side_of(a, b, alarm));
  return plain::side_of(a, b, alarm);
}
#undef CONTACT_BY_FMA

NearSide near_side_of(const Obb& a, const Plane& b, double alarm) {
  return NearLowest(near_core(a), near::vector(b.normal)).side(b, 0, alarm);
}
template <class A, class B>
NearSide near_side_of(const A& a, const B& b, double alarm) {
  return nearly(near_core(a), near_core(b), alarm);
}
Certain certain_contact(const Obb& a, const Plane& b, bool in_range, const Lengths& lengths, ContactPoints points,
                        Contact& contact) {
  return certain_of(near_core(a), GivenCorners(a), b, in_range, lengths, points, contact);
}
template <class A, class B>
Certain certain_contact(const A& a, const B& b, bool in_range, const Lengths& lengths, ContactPoints points,
                        Contact& contact) {
  return certain_of(near_core(a), GivenCorners(a), near_core(b), GivenCorners(b), in_range, lengths, points, contact);
}

Vector3 given_corner(const Box& box, std::size_t k) {
  return {(k & 1 ? box.max : box.min)[0], (k & 2 ? box.max : box.min)[1], (k & 4 ? box.max : box.min)[2]};
}
template <class Shape>
Vector3 given_corner(const Shape& shape, std::size_t k) {
  return shape.vertices[k];
}

// Behind calls that are not inlined: what RoundToNearest sets must be set before anything is computed.

template <class A, class B>
[[gnu::noinline]] bool decide(const A& a, const B& b, double alarm) {
  const NearSide side = near_side_of(a, b, alarm);
  return side == NearSide::unknown ? decide_exactly_of(a, b, alarm) : side == NearSide::hit;
}
template <class A, class B>
[[gnu::noinline]] std::optional<Contact> compute(const A& a, const B& b, Distances distances, ContactPoints points) {
  const Lengths lengths = lengths_of(a, b, distances);
  const bool in_range = in_short_range(a) && in_short_range(b) && in_short_range(lengths);
  Contact contact{};
  const Certain known = certain_contact(a, b, in_range, lengths, points, contact);
  if (known.side == NearSide::miss) return std::nullopt;
  if (known.side == NearSide::unknown || known.open != 0) {
    const auto exact = exactly(a, b, distances, true);
    if (known.side == NearSide::unknown && !is_hit(exact)) return std::nullopt;
    round_open(exact, points, known.open, contact);
  }
  return contact;
}
// A core of given points over a half-space: where one of them surely is the lowest, it alone answers what is open, as the core of a sphere does.

template <class A>
requires(!std::same_as<A, Obb>) [[gnu::noinline]] bool decide(const A& a, const Plane& b, double alarm) {
  const NearLowest lowest(near_core(a), near::vector(b.normal));
  const NearSide side = lowest.side(b, radius_of(a), alarm);
  if (side != NearSide::unknown) return side == NearSide::hit;
  if (const auto corner = lowest.corner())
    return kernel::decide(given_corner(a, *corner), kernel::core_of(b), lengths_of(a, b, {alarm, 0}));
  return is_hit(exactly(a, b, {alarm, 0}));
}
template <class A>
requires(!std::same_as<A, Obb>)
    [[gnu::noinline]] std::optional<Contact> compute(const A& a, const Plane& b, Distances distances,
                                                     ContactPoints points) {
  const NearLowest lowest(near_core(a), near::vector(b.normal));
  const NearSide side = lowest.side(b, radius_of(a), distances.alarm);
  if (side == NearSide::miss) return std::nullopt;
  if (const auto corner = lowest.corner())
    return contact_between(given_corner(a, *corner), kernel::core_of(b), lengths_of(a, b, distances), points);
  const auto exact = exactly(a, b, distances);
  if (side == NearSide::unknown && !is_hit(exact)) return std::nullopt;
  Contact contact{};
  round_open(exact, points, kAllNumbers, contact);
  return contact;
}

}  // namespace convexes
}  // namespace

#define CONTACT_CONVEX(name, A, B, ...)                                                                      \
  bool test_##name(const A& a, const B& b, double alarm) {                                                   \
    const kernel::RoundToNearest environment;                                                                \
    return convexes::decide(a, b, alarm);                                                                    \
  }                                                                                                          \
  std::optional<Contact> compute_##name(const A& a, const B& b, Distances distances, ContactPoints points) { \
    const kernel::RoundToNearest environment;                                                                \
    return convexes::compute(a, b, distances, points);                                                       \
  }
CONTACT_CONVEX_PAIRS(CONTACT_CONVEX)
#undef CONTACT_CONVEX

namespace {

/// Calls ask(test, compute, a, b) of the pair that two shapes are of.
template <class Ask>
auto of_pair(const Convexes& shapes, Ask ask) {
#define CONTACT_ASK(name, A, B, ...)                   \
  if (const auto* a = std::get_if<A>(&shapes.a.shape)) \
    if (const auto* b = std::get_if<B>(&shapes.b.shape)) return ask(&test_##name, &compute_##name, *a, *b);
  CONTACT_CONVEX_PAIRS(CONTACT_ASK)
#undef CONTACT_ASK
  __builtin_unreachable();  // no pair has such shapes
}

}  // namespace

bool is_hit(const Convexes& shapes, Distances distances) {
  return of_pair(
      shapes, [&](auto test, auto /*compute*/, const auto& a, const auto& b) { return test(a, b, distances.alarm); });
}
std::optional<Contact> contact_of(const Convexes& shapes, Distances distances, ContactPoints points) {
  return of_pair(shapes, [&](auto /*test*/, auto compute, const auto& a, const auto& b) {
    return compute(a, b, distances, points);
  });
}

}  // namespace contact::inline CONTACT_ABI
