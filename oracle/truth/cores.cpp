// Two cores, exactly: the least over all pairs of their features, which are vertices, edges and faces. The nearest points
// of each two of them, as points of the lines and planes through them, are tried where they lie in both, and nobody asks which features face
// each other. Intervals of doubles spare most of them.
#include "oracle/truth/cores.hpp"

#include <CGAL/FPU.h>

#include <algorithm>
#include <limits>

namespace contact::oracle {
namespace {

const Rational kNone(0);
const Rational kOne(1);
const Rational kHalf(1, 2);

struct NearestPair {
  Point p;
  Point q;
  [[nodiscard]] Rational distance2() const { return dot(q - p, q - p); }
};

/// A feature as one of its corners, and the ways from there to those next to it.
template <class Number>
struct Spanned {
  std::array<Number, 3> corner;
  std::vector<std::array<Number, 3>> ways;
  bool is_parallelogram;
};
template <class Number>
Spanned<Number> spanned(const Core<Number>& core, const Feature& feature) {
  const auto& corner = core.vertices[feature.places[0]];
  Spanned<Number> all{corner, {}, feature.is_parallelogram()};
  for (std::size_t k = 1; k <= feature.dimension(); ++k) all.ways.push_back(core.vertices[feature.places[k]] - corner);
  return all;
}

bool is_surely_zero(const Rational& x) { return CGAL::is_zero(x); }
bool is_surely_zero(const Enclosed& /*x*/) { return false; }

/// What is nearest of the lines and planes through two features: how much of each way leads there, of f's before g's. Nothing where that is
/// not unique.
template <class Number>
std::optional<std::vector<Number>> parts_of(const Spanned<Number>& f, const Spanned<Number>& g) {
  std::vector<std::array<Number, 3>> ways = f.ways;  // of p - q
  for (const auto& way : g.ways) ways.push_back(Number(-1) * way);
  const std::size_t n = ways.size();
  const auto w = g.corner - f.corner;
  // At right angles to every way. A Gram matrix has its pivots on the diagonal, or the ways depend on each other.
  std::vector<std::vector<Number>> m(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < n; ++k) m[i].push_back(k < i ? m[k][i] : dot(ways[i], ways[k]));
    m[i].push_back(dot(ways[i], w));
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (is_surely_zero(m[i][i])) return std::nullopt;
    for (std::size_t row = i + 1; row < n; ++row) {
      const Number by = m[row][i] / m[i][i];
      for (std::size_t column = i + 1; column <= n; ++column) m[row][column] -= by * m[i][column];
    }
  }
  std::vector<Number> parts(n);
  for (std::size_t i = n; i-- > 0;) {
    parts[i] = m[i][n];
    for (std::size_t column = i + 1; column < n; ++column) parts[i] -= m[i][column] * parts[column];
    parts[i] /= m[i][i];
  }
  return parts;
}

/// -1 where so much of each way surely leads out of the feature, 1 where it surely does not, else 0.
template <class Number>
int contains(const Spanned<Number>& feature, std::span<const Number> parts) {
  bool is_sure = true;
  const auto at_most = [&](const Number& x, const Number& y) {
    if (CGAL::certainly(y < x)) return false;
    is_sure = is_sure && CGAL::certainly(x <= y);
    return true;
  };
  Number sum(0);
  for (const Number& part : parts) {
    if (!at_most(Number(0), part) || !at_most(part, Number(1))) return -1;
    sum += part;
  }
  if (!feature.is_parallelogram && parts.size() == 2 && !at_most(sum, Number(1))) return -1;
  return is_sure ? 1 : 0;
}

/// What is nearest of two features, as points of the lines and planes through them, where it is unique and not surely outside.
template <class Number>
struct Feet {
  std::array<Number, 3> p;
  std::array<Number, 3> q;
  bool surely_inside;
};
template <class Number>
std::optional<Feet<Number>> feet(const Spanned<Number>& f, const Spanned<Number>& g) {
  const auto parts = parts_of(f, g);
  if (!parts) return std::nullopt;
  const auto of_f = std::span(*parts).first(f.ways.size());
  const auto of_g = std::span(*parts).subspan(f.ways.size());
  const int in_f = contains<Number>(f, of_f);
  const int in_g = in_f < 0 ? -1 : contains<Number>(g, of_g);
  if (in_g < 0) return std::nullopt;
  const auto at = [](const Spanned<Number>& feature, std::span<const Number> part) {
    auto x = feature.corner;
    for (std::size_t k = 0; k < part.size(); ++k) x = x + part[k] * feature.ways[k];
    return x;
  };
  return Feet<Number>{at(f, of_f), at(g, of_g), in_f > 0 && in_g > 0};
}

/// Whether a point lies in a core with an inside.
bool contains(const ExactCore& solid, const Point& x) {
  for (std::size_t k = 0; k < solid.outward.size(); ++k)
    if (dot(solid.outward[k], x - solid.vertices[solid.faces()[k].places[0]]) > kNone) return false;
  return !solid.outward.empty();
}

/// Two features of which what is nearest may be nearest of the cores.
struct Try {
  const Feature* f;
  const Feature* g;
  double least;  ///< a lower bound of the square of their distance
};
/// All of them, as intervals of doubles tell.
std::vector<Try> tries(const EnclosedCore& a, const EnclosedCore& b) {
  const CGAL::Protect_FPU_rounding<true> upward;
  std::vector<Try> all;
  double most = std::numeric_limits<double>::infinity();  // of the cores
  std::vector<Spanned<Enclosed>> of_b;
  for (const Feature& g : b.features) of_b.push_back(spanned(b, g));
  for (const Feature& f : a.features) {
    const Spanned<Enclosed> of_a = spanned(a, f);
    for (std::size_t k = 0; k < of_b.size(); ++k) {
      const auto found = feet(of_a, of_b[k]);
      if (!found) continue;
      const Enclosed distance2 = dot(found->q - found->p, found->q - found->p);
      all.push_back({&f, &b.features[k], distance2.inf()});
      if (found->surely_inside) most = std::min(most, distance2.sup());
    }
  }
  std::erase_if(all, [&](const Try& x) { return x.least > most; });
  return all;
}

/// Nearest pairs among which all ends are of what is nearest.
std::vector<NearestPair> candidates(const ExactCore& a, const ExactCore& b) {
  std::vector<NearestPair> all;
  for (const Point& x : a.vertices)
    if (contains(b, x)) all.push_back({x, x});
  for (const Try& x : tries(a.enclosed, b.enclosed))
    if (const auto found = feet(spanned<Rational>(a, *x.f), spanned<Rational>(b, *x.g)))
      all.push_back({found->p, found->q});
  return all;
}

/// The normal by agreement of cores that touch and have no inside: across the first ways of theirs that are not parallel, with a first
/// component above 0; across their line; or an axis.
Point agreed_normal(const ExactCore& a, const ExactCore& b) {
  std::vector<Point> ways;
  for (const auto* core : {&a, &b})
    for (const Point& vertex : core->vertices)
      if (vertex != core->vertices[0]) ways.push_back(vertex - core->vertices[0]);
  for (const Point& way : ways)
    if (const Point n = cross(ways[0], way); !is_zero(n)) {
      const Rational& first = *std::find_if(n.begin(), n.end(), [](const Rational& x) { return !CGAL::is_zero(x); });
      return Rational(first < kNone ? -1 : 1) * n;
    }
  const Point x{kOne, kNone, kNone};
  if (ways.empty()) return x;
  // What is left of an axis without its part along the line.
  const Point left = dot(ways[0], ways[0]) * x - dot(ways[0], x) * ways[0];
  return is_zero(left) ? Point{kNone, kOne, kNone} : left;
}

/// What is true of two cores with the point p in common.
Meeting meeting_at(const Point& p, const ExactCore& a, const ExactCore& b) {
  Meeting found{kNone, {}, {}};
  if (b.outward.empty()) {
    found.ways.push_back({agreed_normal(a, b), p});
  } else {
    const auto depth = [&](const WayOut& way) { return dot(p - way.nearest, way.direction); };
    found.ways = ways_out(p, b);
    const auto least = [&](const WayOut& x, const WayOut& y) { return depth(x) < depth(y); };
    found.depth = depth(*std::min_element(found.ways.begin(), found.ways.end(), least));
    std::erase_if(found.ways, [&](const WayOut& way) { return depth(way) != found.depth; });
    if (!CGAL::is_zero(found.depth)) return found;
    found.ways.resize(1);
  }
  for (const Point& x : a.vertices)
    for (const Point& y : b.vertices) found.apart.push_back(y - x);
  return found;
}

/// The middle between the lexicographically least and greatest of some points, and what leads from there to the greatest.
struct Middle {
  Point at;
  std::optional<Point> spread;
};
Middle middle_of(const std::vector<Point>& points) {
  const auto [low, high] = std::minmax_element(points.begin(), points.end());
  if (*low == *high) return {*low, std::nullopt};
  return {kHalf * (*low + *high), kHalf * (*high - *low)};
}

}  // namespace

Rational largest_coordinate(const std::vector<Point>& points) {
  const Rational* low = &points[0][0];
  const Rational* high = low;
  for (const Point& point : points)
    for (const Rational& x : point) {
      if (x < *low) low = &x;
      if (x > *high) high = &x;
    }
  return std::max(Rational(-*low), *high);
}

ExactCore exact_core(const std::vector<Point>& vertices, std::span<const Feature> features) {
  ExactCore core{{vertices, features}, {{}, features}};
  for (const Point& x : vertices) {
    const auto enclosed = [&](std::size_t i) { return Enclosed(CGAL::to_interval(x[i])); };
    core.enclosed.vertices.push_back({enclosed(0), enclosed(1), enclosed(2)});
  }
  return core;
}

bool are_surely_apart(const EnclosedCore& first, const EnclosedCore& second) {
  const std::vector<Try> all = tries(first, second);
  return std::all_of(all.begin(), all.end(), [](const Try& x) { return x.least > 0; });
}

Rational squared_distance(const ExactCore& first, const ExactCore& second) {
  const std::vector<NearestPair> all = candidates(first, second);
  Rational least = all.front().distance2();
  for (const NearestPair& pair : all) least = std::min(least, pair.distance2());
  return least;
}

std::vector<WayOut> ways_out(const Point& inside, const ExactCore& solid) {
  std::vector<WayOut> all;
  for (std::size_t k = 0; k < solid.outward.size(); ++k) {
    const Point& n = solid.outward[k];
    const Point& corner = solid.vertices[solid.faces()[k].places[0]];
    all.push_back({Rational(-1) * n, inside + (dot(n, corner - inside) / dot(n, n)) * n});
  }
  return all;
}

ExactTruth truth_of_cores(const ExactCore& first, const ExactCore& second, Distances distances) {
  const std::vector<NearestPair> all = candidates(first, second);
  Rational least = all.front().distance2();
  std::vector<Point> nearest;
  Point delta;
  for (const NearestPair& pair : all) {
    const Rational distance2 = pair.distance2();
    if (distance2 > least) continue;
    if (distance2 < least) nearest.clear();
    least = distance2;
    nearest.push_back(pair.p);
    delta = pair.q - pair.p;
  }
  const auto [p, spread] = middle_of(nearest);
  const Rational scale = std::max(largest_coordinate(first.vertices), largest_coordinate(second.vertices));
  Cores cores{{p, p + delta}, {Rational(first.radius), Rational(second.radius)}, {scale, scale}};
  cores.spread = spread;
  if (CGAL::is_zero(least)) cores.meeting = meeting_at(p, first, second);
  return {DistanceTruth(std::move(cores), distances)};
}

// No point of a core is lower than all of its vertices.
ExactTruth truth_of_cores(const ExactCore& first, const Plane& second, Distances distances) {
  const Point n = point_of(second.normal);
  const Rational offset(second.offset);
  std::vector<Point> lowest;
  for (const Point& x : first.vertices) {
    if (!lowest.empty() && dot(n, x) > dot(n, lowest[0])) continue;
    if (!lowest.empty() && dot(n, x) < dot(n, lowest[0])) lowest.clear();
    lowest.push_back(x);
  }
  const auto [p, spread] = middle_of(lowest);
  const Rational scale = largest_coordinate(first.vertices);
  const Rational height = (dot(n, p) - offset) / dot(n, n);  // in normals
  Cores cores{{p, p - height * n}, {Rational(first.radius), kNone}, {scale, scale}};
  cores.half_space = HalfSpace{Rational(-1) * n, offset * offset / dot(n, n)};
  cores.spread = spread;
  return {DistanceTruth(std::move(cores), distances)};
}

}  // namespace contact::oracle
