// Two cores, exactly: the least over all pairs of their features, which are vertices, edges and faces. The nearest points
// of each two of them, as points of the lines and planes through them, are tried where they lie in both, and nobody asks which features face
// each other. Intervals of doubles spare most of them.
#include "oracle/truth/cores.hpp"

#include <CGAL/FPU.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace contact::oracle {
namespace {

const Rational kNone(0);
const Rational kOne(1);
const Rational kHalf(1, 2);

struct NearestPair {
  Point p;
  Point q;
};

std::array<Enclosed, 3> intervals_of(const Point& x) {
  const auto coordinate = [&](std::size_t i) { return Enclosed(CGAL::to_interval(x[i])); };
  return {coordinate(0), coordinate(1), coordinate(2)};
}

constexpr std::size_t kMostWays = 3;  // of two features together: two faces of three dimensions depend on each other

/// A feature as one of its corners, and the ways from there to those next to it.
template <class Number>
struct Spanned {
  std::array<Number, 3> corner;
  std::array<std::array<Number, 3>, 2> ways;
  std::size_t dimension;
  bool is_parallelogram;
};
template <class Number>
Spanned<Number> spanned(const Core<Number>& core, const Feature& feature) {
  const auto& corner = core.vertices[feature.places[0]];
  Spanned<Number> all{corner, {}, feature.dimension(), feature.is_parallelogram()};
  for (std::size_t k = 0; k < all.dimension; ++k) all.ways[k] = core.vertices[feature.places[k + 1]] - corner;
  return all;
}

/// How much of each way, times `over`, which is above 0.
template <class Number>
struct Parts {
  std::array<Number, kMostWays> of;
  Number over;
};

/// Equations: each row is what stands before the unknowns, and what they give. What is there before the unknowns is a Gram matrix, which
/// has its pivots on the diagonal, or the ways depend on each other.
template <class Number>
using Equations = std::array<std::array<Number, kMostWays + 1>, kMostWays>;

std::optional<Parts<Enclosed>> solution(Equations<Enclosed> m, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t row = i + 1; row < n; ++row) {
      const Enclosed by = m[row][i] / m[i][i];
      for (std::size_t column = i + 1; column <= n; ++column) m[row][column] -= by * m[i][column];
    }
  Parts<Enclosed> found{{}, Enclosed(1)};
  for (std::size_t i = n; i-- > 0;) {
    found.of[i] = m[i][n];
    for (std::size_t column = i + 1; column < n; ++column) found.of[i] -= m[i][column] * found.of[column];
    found.of[i] /= m[i][i];
  }
  return found;
}

/// By Bareiss's elimination, in which every quotient is whole. Nothing where the solution is not unique.
std::optional<Parts<Whole>> solution(Equations<Whole> m, std::size_t n) {
  Parts<Whole> found{{}, Whole(1)};
  for (std::size_t i = 0; i < n; ++i) {
    if (CGAL::is_zero(m[i][i])) return std::nullopt;
    for (std::size_t row = i + 1; row < n; ++row)
      for (std::size_t column = i + 1; column <= n; ++column)
        m[row][column] = CGAL::integral_division(m[row][column] * m[i][i] - m[row][i] * m[i][column], found.over);
    found.over = m[i][i];
  }
  for (std::size_t i = n; i-- > 0;) {
    found.of[i] = m[i][n] * found.over;
    for (std::size_t column = i + 1; column < n; ++column) found.of[i] -= m[i][column] * found.of[column];
    found.of[i] = CGAL::integral_division(found.of[i], m[i][i]);
  }
  return found;
}

/// What is nearest of the lines and planes through two features: how much of each way leads there, of f's before g's. Nothing where that is
/// not unique.
template <class Number>
std::optional<Parts<Number>> parts_of(const Spanned<Number>& f, const Spanned<Number>& g) {
  const std::size_t n = f.dimension + g.dimension;
  if (n > kMostWays) return std::nullopt;
  std::array<std::array<Number, 3>, kMostWays> ways;  // of p - q
  for (std::size_t k = 0; k < f.dimension; ++k) ways[k] = f.ways[k];
  for (std::size_t k = 0; k < g.dimension; ++k) ways[f.dimension + k] = Number(-1) * g.ways[k];
  const auto w = g.corner - f.corner;
  // At right angles to every way.
  Equations<Number> m;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < n; ++k) m[i][k] = k < i ? m[k][i] : dot(ways[i], ways[k]);
    m[i][n] = dot(ways[i], w);
  }
  return solution(m, n);
}

/// -1 where so much of each way surely leads out of the feature, 1 where it surely does not, else 0.
template <class Number>
int contains(const Spanned<Number>& feature, std::span<const Number> parts, const Number& over) {
  bool is_sure = true;
  const auto at_most = [&](const Number& x, const Number& y) {
    if (CGAL::certainly(y < x)) return false;
    is_sure = is_sure && CGAL::certainly(x <= y);
    return true;
  };
  Number sum(0);
  for (const Number& part : parts) {
    if (!at_most(Number(0), part) || !at_most(part, over)) return -1;
    sum += part;
  }
  if (!feature.is_parallelogram && parts.size() == 2 && !at_most(sum, over)) return -1;
  return is_sure ? 1 : 0;
}

/// What is nearest of two features, as points of the lines and planes through them, times `over`, where it is unique and not surely outside.
template <class Number>
struct Feet {
  std::array<Number, 3> p;
  std::array<Number, 3> q;
  Number over;
  bool surely_inside;
};
template <class Number>
std::optional<Feet<Number>> feet(const Spanned<Number>& f, const Spanned<Number>& g) {
  const auto parts = parts_of(f, g);
  if (!parts) return std::nullopt;
  const auto of_f = std::span(parts->of).first(f.dimension);
  const auto of_g = std::span(parts->of).subspan(f.dimension, g.dimension);
  const int in_f = contains<Number>(f, of_f, parts->over);
  const int in_g = in_f < 0 ? -1 : contains<Number>(g, of_g, parts->over);
  if (in_g < 0) return std::nullopt;
  const auto at = [&](const Spanned<Number>& feature, std::span<const Number> part) {
    auto x = parts->over * feature.corner;
    for (std::size_t k = 0; k < part.size(); ++k) x = x + part[k] * feature.ways[k];
    return x;
  };
  return Feet<Number>{at(f, of_f), at(g, of_g), parts->over, in_f > 0 && in_g > 0};
}

/// Where a point lies of a face of a core: beyond it, in its plane or within.
template <class Number>
auto side_of(const Core<Number>& solid, std::size_t face, const std::array<Number, 3>& x) {
  return CGAL::sign(dot(solid.outward[face], x - solid.vertices[solid.faces()[face].places[0]]));
}
/// Whether a vertex of another core lies in a core with an inside.
bool contains(const ExactCore& solid, const ExactCore& other, std::size_t vertex) {
  std::vector<std::size_t> open;  // what intervals of doubles do not tell
  {
    const CGAL::Protect_FPU_rounding<true> upward;
    for (std::size_t k = 0; k < solid.outward.size(); ++k) {
      const auto side = side_of(solid.enclosed, k, other.enclosed.vertices[vertex]);
      if (CGAL::certainly(side == CGAL::POSITIVE)) return false;
      if (!CGAL::certainly(side == CGAL::NEGATIVE)) open.push_back(k);
    }
  }
  const auto is_beyond = [&](std::size_t k) { return side_of(solid, k, other.vertices[vertex]) == CGAL::POSITIVE; };
  return !solid.outward.empty() && std::none_of(open.begin(), open.end(), is_beyond);
}

/// Two features of which what is nearest may be nearest of the cores.
struct Try {
  std::size_t f;  ///< its place in a core's features
  std::size_t g;
  double least;  ///< a lower bound of the square of their distance
};
/// All of them, as intervals of doubles tell.
std::vector<Try> tries(const EnclosedCore& a, const EnclosedCore& b) {
  const CGAL::Protect_FPU_rounding<true> upward;
  std::vector<Try> all;
  double most = std::numeric_limits<double>::infinity();  // of the cores
  std::vector<Spanned<Enclosed>> of_b;
  for (const Feature& g : b.features) of_b.push_back(spanned(b, g));
  for (std::size_t i = 0; i < a.features.size(); ++i) {
    const Spanned<Enclosed> of_a = spanned(a, a.features[i]);
    for (std::size_t k = 0; k < of_b.size(); ++k) {
      const auto found = feet(of_a, of_b[k]);
      if (!found) continue;
      const Enclosed distance2 = dot(found->q - found->p, found->q - found->p);
      all.push_back({i, k, distance2.inf()});
      if (found->surely_inside) most = std::min(most, distance2.sup());
    }
  }
  std::erase_if(all, [&](const Try& x) { return x.least > most; });
  return all;
}

using WholePoint = std::array<Whole, 3>;
bool is_none(const WholePoint& x) {
  return std::all_of(x.begin(), x.end(), [](const Whole& each) { return CGAL::is_zero(each); });
}

/// Domain: the products are whole.
std::vector<WholePoint> in_whole_numbers(const std::vector<Point>& points, const Whole& times) {
  std::vector<WholePoint> all;
  for (const Point& x : points) {
    auto& whole = all.emplace_back();
    for (std::size_t i = 0; i < 3; ++i)
      whole[i] = CGAL::integral_division(times, x[i].denominator()) * x[i].numerator();
  }
  return all;
}

/// The numbers of a feature's ways among the different ones of its core.
using WayNumbers = std::array<std::size_t, 2>;
/// The features of a core, each spanned where it is first asked for.
class SpannedOnce {
 public:
  explicit SpannedOnce(const Core<Whole>& core) : core_(core), found_(core.features.size()) {}

  struct Numbered {
    Spanned<Whole> spanned;
    WayNumbers ways;
  };
  const Numbered& of(std::size_t feature) {
    auto& found = found_[feature];
    if (found) return *found;
    found.emplace(Numbered{spanned(core_, core_.features[feature]), {}});
    for (std::size_t k = 0; k < found->spanned.dimension; ++k) {
      const auto place = std::find(different_.begin(), different_.end(), found->spanned.ways[k]);
      found->ways[k] = 1 + static_cast<std::size_t>(place - different_.begin());
      if (place == different_.end()) different_.push_back(found->spanned.ways[k]);
    }
    return *found;
  }

 private:
  const Core<Whole>& core_;
  std::vector<std::optional<Numbered>> found_;
  std::vector<WholePoint> different_;
};
/// Whether a way of two features is made of the others.
bool depend_on_each_other(const Spanned<Whole>& f, const Spanned<Whole>& g) {
  std::vector<WholePoint> ways;
  for (const auto* feature : {&f, &g})
    for (std::size_t k = 0; k < feature->dimension; ++k) ways.push_back(feature->ways[k]);
  if (ways.size() == 1) return is_none(ways[0]);
  if (ways.size() == 2) return is_none(cross(ways[0], ways[1]));
  return ways.size() == 3 && CGAL::is_zero(dot(cross(ways[0], ways[1]), ways[2]));
}

/// Its last word, of which that of a product is made.
mp_limb_t last_word(const Whole& x) {
  const mp_limb_t last = mpz_getlimbn(x.mpz(), 0);
  return CGAL::is_negative(x) ? 0 - last : last;
}
/// Whether two quotients are the same: most are told apart by a word.
bool is_same(const Whole& x, const Whole& over_x, const Whole& y, const Whole& over_y) {
  return last_word(x) * last_word(over_y) == last_word(y) * last_word(over_x) && x * over_y == y * over_x;
}

/// The square of the least distance, and pairs of points that are so far apart, among which all ends are of what is nearest.
struct NearestPairs {
  Rational distance2;
  std::vector<NearestPair> all;
};
/// In whole numbers: of quotients most of the time would go into common divisors.
NearestPairs nearest_pairs(const ExactCore& a, const ExactCore& b) {
  const Whole times = common_denominator({&a.vertices, &b.vertices});
  const Core<Whole> whole_a{in_whole_numbers(a.vertices, times), a.features};
  const Core<Whole> whole_b{in_whole_numbers(b.vertices, times), b.features};
  std::vector<Feet<Whole>> least;
  Whole distance2;  // times over2
  Whole over2;
  const auto add = [&](Feet<Whole> found) {
    const auto way = found.q - found.p;
    const Whole of_found = dot(way, way);
    const Whole over2_of_found = found.over * found.over;
    const auto order = least.empty() ? CGAL::SMALLER : CGAL::compare(of_found * over2, distance2 * over2_of_found);
    if (order == CGAL::LARGER) return;
    if (order == CGAL::SMALLER) least.clear();
    // Many features share what is nearest. What leads from p to q is the same of all such pairs, so that p tells them apart.
    const auto is_found = [&](const Feet<Whole>& x) {
      return is_same(x.p[0], x.over, found.p[0], found.over) && is_same(x.p[1], x.over, found.p[1], found.over) &&
             is_same(x.p[2], x.over, found.p[2], found.over);
    };
    if (std::any_of(least.begin(), least.end(), is_found)) return;
    distance2 = of_found;
    over2 = over2_of_found;
    least.push_back(std::move(found));
  };
  const auto add_contained = [&](const ExactCore& solid, const ExactCore& core, const Core<Whole>& whole) {
    for (std::size_t k = 0; k < core.vertices.size(); ++k)
      if (contains(solid, core, k)) add({whole.vertices[k], whole.vertices[k], Whole(1), true});
  };
  add_contained(b, a, whole_a);
  add_contained(a, b, whole_b);
  SpannedOnce of_a(whole_a);
  SpannedOnce of_b(whole_b);
  std::map<std::pair<WayNumbers, WayNumbers>, bool> depend;  // of features with parallel ways nothing is unique
  for (const Try& x : tries(a.enclosed, b.enclosed)) {
    const auto& [f, ways_of_f] = of_a.of(x.f);
    const auto& [g, ways_of_g] = of_b.of(x.g);
    const auto [known, is_new] = depend.try_emplace({ways_of_f, ways_of_g});
    if (is_new) known->second = depend_on_each_other(f, g);
    if (known->second) continue;
    if (auto found = feet(f, g)) add(*std::move(found));
  }
  NearestPairs pairs{{distance2, over2 * times * times}, {}};
  for (const auto& [p, q, over, is_inside] : least) {
    const auto divided = [by = over * times](const auto& x) {
      return Point{Rational(x[0], by), Rational(x[1], by), Rational(x[2], by)};
    };
    pairs.all.push_back({divided(p), divided(q)});
  }
  return pairs;
}

/// b - a for all vertices.
std::vector<Point> differences(const ExactCore& a, const ExactCore& b) {
  std::vector<Point> all;
  for (const Point& x : a.vertices)
    for (const Point& y : b.vertices) all.push_back(y - x);
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
    found.ways.push_back({agreed_normal(a, b), p, p});
  } else {
    const auto depth2 = [&](const WayOut& way) { return dot(p - way.nearest, p - way.nearest); };
    found.ways = ways_out(p, b);
    const auto least = [&](const WayOut& x, const WayOut& y) { return depth2(x) < depth2(y); };
    found.depth2 = depth2(*std::min_element(found.ways.begin(), found.ways.end(), least));
    std::erase_if(found.ways, [&](const WayOut& way) { return depth2(way) != found.depth2; });
    if (!CGAL::is_zero(found.depth2)) return found;
    found.ways.resize(1);
  }
  found.apart = differences(a, b);
  return found;
}

/// The middle between the lexicographically least and greatest of some points, and what leads from there to each of them.
struct Middle {
  Point at;
  Spread spread;
};
Middle middle_of(const std::vector<Point>& points) {
  const auto [low, high] = std::minmax_element(points.begin(), points.end());
  if (*low == *high) return {*low, {}};
  Middle middle{kHalf * (*low + *high), {}};
  for (const Point& x : points) middle.spread.push_back(x - middle.at);
  std::sort(middle.spread.begin(), middle.spread.end());
  middle.spread.erase(std::unique(middle.spread.begin(), middle.spread.end()), middle.spread.end());
  return middle;
}

// ---- any two cores that meet ----

/// How far a core lies along a direction: the largest n.x, and whether each vertex is there.
struct Support {
  Whole most;
  std::vector<bool> is_there;
};
Support support(const Core<Whole>& core, const WholePoint& n) {
  std::vector<Whole> along;
  for (const WholePoint& x : core.vertices) along.push_back(dot(n, x));
  Support found{*std::max_element(along.begin(), along.end()), {}};
  for (const Whole& x : along) found.is_there.push_back(x == found.most);
  return found;
}

/// The part of a core that is there, moved.
struct Face {
  std::vector<Feature> features;
  ExactCore core;
};
Face face_of(const ExactCore& core, const Support& at, const Point& moved) {
  Face face;
  for (const Feature& feature : core.features)
    if (std::all_of(feature.corners().begin(), feature.corners().end(), [&](std::size_t k) { return at.is_there[k]; }))
      face.features.push_back(feature);
  std::vector<Point> vertices;
  for (const Point& x : core.vertices) vertices.push_back(x + moved);
  face.core = exact_core(vertices, {});
  return face;
}

/// A direction that a facet of A - B may face. The two cores overlap by height / |normal| along it.
struct Facing {
  WholePoint normal;
  Whole square;  ///< of its length
  Whole height;
  Support of_a;
  Support of_b;
  [[nodiscard]] Rational depth2() const { return {height * height, square}; }
};
Facing facing(const Core<Whole>& a, const Core<Whole>& b, const WholePoint& n) {
  Facing found{n, dot(n, n), Whole(0), support(a, n), support(b, Whole(-1) * n)};
  found.height = found.of_a.most + found.of_b.most;
  return found;
}
/// Whether what lies farthest along it is a facet of A - B, and no edge or corner.
bool is_facet(const Core<Whole>& a, const Core<Whole>& b, const Facing& along) {
  std::vector<WholePoint> ways;
  for (const auto& [core, at] : {std::pair(&a, &along.of_a), std::pair(&b, &along.of_b)}) {
    const WholePoint* first = nullptr;
    for (std::size_t k = 0; k < core->vertices.size(); ++k) {
      if (!at->is_there[k]) continue;
      if (first == nullptr) first = &core->vertices[k];
      if (core->vertices[k] != *first) ways.push_back(core->vertices[k] - *first);
    }
  }
  return std::any_of(ways.begin(), ways.end(), [&](const WholePoint& way) { return !is_none(cross(ways[0], way)); });
}

/// How deep one is beside another.
CGAL::Comparison_result compare_depths(const Facing& x, const Facing& y) {
  return CGAL::compare(x.height * x.height * y.square, y.height * y.height * x.square);
}
/// Whether a normal comes before another: each divided by the sum of the absolute values of its components.
bool is_preferred(const Facing& x, const Facing& y) {
  const auto size = [](const WholePoint& n) { return CGAL::abs(n[0]) + CGAL::abs(n[1]) + CGAL::abs(n[2]); };
  return size(y.normal) * x.normal > size(x.normal) * y.normal;
}

/// The edges of both, each two of which a facet may lie across.
template <class Number>
std::vector<std::array<Number, 3>> edges_of(const Core<Number>& a, const Core<Number>& b) {
  std::vector<std::array<Number, 3>> ways;
  for (const auto* core : {&a, &b})
    for (const Feature* edge : core->features_of(1))
      ways.push_back(core->vertices[edge->places[1]] - core->vertices[edge->places[0]]);
  return ways;
}

/// Two of them, and whether what lies across is turned round.
struct Across {
  std::size_t i;
  std::size_t j;
  bool turned;
};
/// How far vertices lie along a direction, in intervals.
struct AlongNormal {
  Enclosed least;
  Enclosed most;
  AlongNormal(const std::array<Enclosed, 3>& n, const std::array<Enclosed, 3>& x) : least(dot(n, x)), most(least) {}
  void add(const std::array<Enclosed, 3>& n, const std::array<Enclosed, 3>& x) {
    const Enclosed along = dot(n, x);
    least = {std::min(least.inf(), along.inf()), std::min(least.sup(), along.sup())};
    most = {std::max(most.inf(), along.inf()), std::max(most.sup(), along.sup())};
  }
};
/// Those that may be of the least depth, as intervals of doubles tell.
std::vector<Across> may_be_least(const EnclosedCore& a, const EnclosedCore& b) {
  const CGAL::Protect_FPU_rounding<true> upward;
  std::vector<std::pair<Across, double>> all;
  double most = std::numeric_limits<double>::infinity();
  const auto edges = edges_of(a, b);
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const auto n = cross(edges[i], edges[j]);
      const Enclosed length2 = dot(n, n);
      // The largest n.a less the least n.b, and the other way round: of the vertices looked at so far, no more than of all.
      const auto depth2 = [&](const Enclosed& height) {
        const bool is_sure = length2.inf() > 0 && height.inf() > 0;
        return is_sure ? CGAL::square(height) / length2 : Enclosed(0, std::numeric_limits<double>::infinity());
      };
      const auto least = [&](const Enclosed& height) {
        const double low = depth2(height).inf();
        return std::isnan(low) ? 0 : low;
      };
      std::array<AlongNormal, 2> of{AlongNormal(n, a.vertices[0]), AlongNormal(n, b.vertices[0])};
      const auto heights = [&] { return std::array{of[0].most - of[1].least, of[1].most - of[0].least}; };
      bool is_deeper = false;  // surely, both ways
      for (std::size_t k = 1; !is_deeper && k < std::max(a.vertices.size(), b.vertices.size()); ++k) {
        if (k < a.vertices.size()) of[0].add(n, a.vertices[k]);
        if (k < b.vertices.size()) of[1].add(n, b.vertices[k]);
        const auto [there, back] = heights();
        is_deeper = least(there) > most && least(back) > most;
      }
      if (is_deeper) continue;
      for (const bool turned : {false, true}) {
        const Enclosed height = heights()[turned ? 1 : 0];
        const double low = least(height);
        if (!(low > most)) all.push_back({{i, j, turned}, low});
        const double high = depth2(height).sup();
        if (high < most) most = high;
      }
    }
  std::vector<Across> may;
  for (const auto& [across, least] : all)
    if (!(least > most)) may.push_back(across);
  return may;
}

Point in_quotients(const WholePoint& x) { return {Rational(x[0]), Rational(x[1]), Rational(x[2])}; }

/// What is true of any two cores with some points in common, those that all others lie between: a depth is an ordinary hit. Domain: every
/// vertex is whole.
Meeting meeting_of(const std::vector<Point>& common, const ExactCore& a, const ExactCore& b) {
  const Core<Whole> whole_a{in_whole_numbers(a.vertices, Whole(1)), a.features};
  const Core<Whole> whole_b{in_whole_numbers(b.vertices, Whole(1)), b.features};
  const std::vector<WholePoint> edges = edges_of<Whole>(whole_a, whole_b);
  std::vector<Facing> least;
  bool is_flat = false;
  for (const auto& [i, j, turned_round] : may_be_least(a.enclosed, b.enclosed)) {
    if (is_flat) break;
    const WholePoint n = cross(edges[i], edges[j]);
    if (is_none(n)) continue;
    Facing found = facing(whole_a, whole_b, Whole(turned_round ? -1 : 1) * n);
    if (CGAL::is_zero(found.height)) {
      const Facing turned = facing(whole_a, whole_b, Whole(-1) * found.normal);
      is_flat = CGAL::is_zero(turned.height);
      if (is_flat) least = {turned};
      if (!is_flat && !is_facet(whole_a, whole_b, found)) continue;
    }
    if (!is_flat && !least.empty()) {
      const auto order = compare_depths(found, least[0]);
      if (order == CGAL::LARGER) continue;
      if (order == CGAL::SMALLER) least.clear();
    }
    const auto is_same = [&](const Facing& x) { return !is_preferred(x, found) && !is_preferred(found, x); };
    if (std::none_of(least.begin(), least.end(), is_same)) least.push_back(std::move(found));
  }
  std::sort(least.begin(), least.end(), is_preferred);
  if (least.empty() || CGAL::is_zero(least[0].height)) {
    const Point p = middle_of(common).at;
    return {kNone, {{least.empty() ? agreed_normal(a, b) : in_quotients(least[0].normal), p, p}}, differences(a, b)};
  }
  Meeting found{least[0].depth2(), {}, {}, true};
  for (const Facing& way : least) {
    // B is moved out, so that the faces that face each other have in common what is nearest.
    const Point normal = in_quotients(way.normal);
    const Point out = Rational(way.height, way.square) * normal;
    Face of_a = face_of(a, way.of_a, {kNone, kNone, kNone});
    Face of_b = face_of(b, way.of_b, out);
    of_a.core.features = of_a.core.enclosed.features = of_a.features;
    of_b.core.features = of_b.core.enclosed.features = of_b.features;
    std::vector<Point> points;
    for (const NearestPair& pair : nearest_pairs(of_a.core, of_b.core).all) points.push_back(pair.p);
    auto [p, spread] = middle_of(points);
    found.ways.push_back({normal, p, p - out, std::move(spread)});
  }
  return found;
}

/// The same in whole numbers.
Meeting meeting_of_whole(std::vector<Point> common, ExactCore first, ExactCore second) {
  const Rational times(common_denominator({&first.vertices, &second.vertices}));
  for (Point& x : common) x = times * x;
  for (ExactCore* core : {&first, &second}) {
    for (Point& x : core->vertices) x = times * x;
    const Rational of_normals(common_denominator({&core->outward}));
    for (Point& n : core->outward) n = of_normals * n;
  }
  Meeting meeting = meeting_of(common, first, second);
  const Rational by = kOne / times;
  meeting.depth2 *= by * by;
  for (WayOut& way : meeting.ways) {
    way.first = by * way.first;
    way.nearest = by * way.nearest;
    for (Point& x : way.spread) x = by * x;
  }
  return meeting;
}

/// What is true of two cores, radii left out.
Cores nearest_of(const ExactCore& first, const ExactCore& second, Rules rules) {
  const auto [distance2, pairs] = nearest_pairs(first, second);
  std::vector<Point> nearest;
  for (const NearestPair& pair : pairs) nearest.push_back(pair.p);
  auto [p, spread] = middle_of(nearest);
  const Rational scale = std::max(largest_coordinate(first.vertices), largest_coordinate(second.vertices));
  Cores cores{{p, p + (pairs.front().q - pairs.front().p)}, {kNone, kNone}, {scale, scale}};
  cores.spread = std::move(spread);
  if (CGAL::is_zero(distance2))
    cores.meeting.emplace(rules == Rules::of_all ? meeting_of_whole(nearest, first, second)
                                                 : meeting_at(p, first, second));
  return cores;
}

}  // namespace

Whole common_denominator(std::initializer_list<const std::vector<Point>*> all) {
  Whole found(1);
  for (const std::vector<Point>* points : all)
    for (const Point& point : *points)
      for (const Rational& x : point)
        if (mpz_divisible_p(found.mpz(), mpq_denref(x.mpq())) == 0)
          mpz_lcm(found.mpz(), found.mpz(), mpq_denref(x.mpq()));
  return found;
}

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

ExactCore exact_core(const Obb& box) {
  // Numbers near 1 are short.
  auto core = core_of([](double x) { return Rational(x); }, with_short_orientation(box));
  for (Point& x : core.vertices) x = (kOne / *core.over) * x;
  return exact_core(core.vertices, core.features, core.outward);
}
EnclosedCore enclosed_core(const Obb& box) { return exact_core(box).enclosed; }
ExactCore exact_core(const Hull& hull) {
  // Questions about the last bit of one of two hulls ask for the other one each time. A thread keeps two.
  struct Kept {
    Hull hull;
    ExactCore core;
  };
  thread_local std::array<std::optional<Kept>, 2> kept;
  thread_local std::size_t oldest = 0;
  for (std::size_t k = 0; k < kept.size(); ++k)
    if (kept[k] && kept[k]->hull.radius == hull.radius && kept[k]->hull.vertices == hull.vertices) {
      oldest = 1 - k;
      return kept[k]->core;
    }
  auto& place = kept[std::exchange(oldest, 1 - oldest)];
  place = Kept{hull, exact_hull(points_of([](double x) { return Rational(x); }, hull), hull.radius)};
  return place->core;
}
ExactCore exact_core(const Convex& convex) {
  return std::visit(
      []<class Shape>(const Shape& shape) {
        if constexpr (std::same_as<Shape, Plane>)
          return ExactCore{};
        else
          return exact_core(shape);
      },
      convex.shape);
}

ExactCore exact_core(const std::vector<Point>& vertices, std::span<const Feature> features,
                     const std::vector<Point>& outward) {
  ExactCore core{{vertices, features, 0, outward}, {{}, features}};
  std::transform(vertices.begin(), vertices.end(), std::back_inserter(core.enclosed.vertices), intervals_of);
  std::transform(outward.begin(), outward.end(), std::back_inserter(core.enclosed.outward), intervals_of);
  return core;
}

ExactCore exact_hull(const std::vector<Point>& points, double radius) {
  const ExactCore all = exact_core(points, {});
  const auto whole = in_whole_numbers(points, common_denominator({&points}));
  const auto sign = [&](const auto& ask) -> int {
    {
      const CGAL::Protect_FPU_rounding<true> upward;
      if (const auto known = CGAL::sign(ask(all.enclosed.vertices)); CGAL::is_certain(known))
        return CGAL::get_certain(known);
    }
    return CGAL::sign(ask(whole));
  };
  Core<Rational> core = core_of_points(points, radius, sign);
  ExactCore found = exact_core(core.vertices, core.features, core.outward);
  found.radius = radius;
  found.own = std::move(core.own);
  return found;
}

void enclose_in_range(ExactCore& first, ExactCore& second) {
  constexpr int kFar = 100;
  const double largest =
      CGAL::to_double(std::max(largest_coordinate(first.vertices), largest_coordinate(second.vertices)));
  const int exponent = largest > 0 && std::isfinite(largest) ? std::ilogb(largest) : 0;
  if (std::abs(exponent) < kFar) return;
  const Rational scale = power_of_two(-exponent);
  for (ExactCore* core : {&first, &second})
    for (std::size_t k = 0; k < core->vertices.size(); ++k)
      core->enclosed.vertices[k] = intervals_of(scale * core->vertices[k]);
}

bool are_surely_apart(const EnclosedCore& first, const EnclosedCore& second) {
  const std::vector<Try> all = tries(first, second);
  return std::all_of(all.begin(), all.end(), [](const Try& x) { return x.least > 0; });
}

Rational squared_distance(const ExactCore& first, const ExactCore& second) {
  return nearest_pairs(first, second).distance2;
}

std::vector<WayOut> ways_out(const Point& inside, const ExactCore& solid) {
  std::vector<WayOut> all;
  for (std::size_t k = 0; k < solid.outward.size(); ++k) {
    const Point& n = solid.outward[k];
    const Point& corner = solid.vertices[solid.faces()[k].places[0]];
    all.push_back({Rational(-1) * n, inside, inside + (dot(n, corner - inside) / dot(n, n)) * n});
  }
  return all;
}

ExactTruth truth_of_cores(const ExactCore& first, const ExactCore& second, Distances distances, Rules rules) {
  Cores cores = nearest_of(first, second, rules);
  cores.radius = {Rational(first.radius), Rational(second.radius)};
  return {DistanceTruth(std::move(cores), distances)};
}

// No point of a core is lower than all of its vertices.
ExactTruth truth_of_cores(const ExactCore& first, const Point& n, const Rational& offset, Distances distances) {
  std::vector<Point> lowest;
  for (const Point& x : first.vertices) {
    if (!lowest.empty() && dot(n, x) > dot(n, lowest[0])) continue;
    if (!lowest.empty() && dot(n, x) < dot(n, lowest[0])) lowest.clear();
    lowest.push_back(x);
  }
  auto [p, spread] = middle_of(lowest);
  const Rational scale = largest_coordinate(first.vertices);
  const Rational height = (dot(n, p) - offset) / dot(n, n);  // in normals
  Cores cores{{p, p - height * n}, {Rational(first.radius), kNone}, {scale, scale}};
  cores.half_space = HalfSpace{Rational(-1) * n, offset * offset / dot(n, n)};
  cores.spread = std::move(spread);
  return {DistanceTruth(std::move(cores), distances)};
}

}  // namespace contact::oracle
