// The derivatives of a contact's numbers, from both sides: one number of the question moves, and the features that may then be nearest are compared exactly.
//
// What a derivative is of, a distance of two lines or planes, is a quotient of polynomials in what moves. Nothing is said of which features are nearest but what
// comparing them says, so that ties, parallel edges and corners that coincide need no case of their own.
#include "oracle/gradient/gradient.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "oracle/gradient/germ.hpp"
#include "oracle/truth/core.hpp"
#include "oracle/truth/default_environment.hpp"
#include "oracle/truth/exact_truth.hpp"

namespace contact::oracle {
namespace gradients {
namespace {

constexpr std::string_view kEdge = "the number is at the edge of its domain, so it has one side";
constexpr std::string_view kKink = "the nearest features change here, and the derivatives from below and above differ";
constexpr std::string_view kMeetKink = "the cores meet, and the derivatives from below and above differ";
constexpr std::string_view kMany = "many pairs of points are nearest";
constexpr std::string_view kManyBeside = "many pairs of points are nearest where the number is changed";
constexpr std::string_view kMeet = "the cores meet, so the normal is by agreement";
constexpr std::string_view kWays = "several ways out are shortest";
constexpr std::string_view kTouch = "not told where cores with an inside touch";
constexpr std::string_view kSplit = "not told where a small change splits the features that face each other";
constexpr std::string_view kTies = "not told where so many features tie";

constexpr std::size_t kMostTries = 20000;  // of features, which take a second
constexpr std::size_t kMostTies = 600;

using GermPoint = std::array<Germ, 3>;
using JetPoint = std::array<Jet, 3>;
using Side = std::array<std::optional<Exact>, kOutputs>;

// ---- a question one of whose numbers moves ----

/// A core, times `over` where that is there.
struct Body {
  std::vector<GermPoint> vertices;
  std::optional<Germ> over = {};
  bool keeps_faces = false;  ///< those of a box are parallelograms however it changes
  Germ radius = {};
  // Of a half-space.
  GermPoint normal = {};
  Germ offset = {};
};

/// The numbers of both shapes. `core_of` reads a shape whose numbers say which they are.
class MovingNumbers {
 public:
  explicit MovingNumbers(const Query& query) : named_(query) {
    for_each_number_unnamed(query, [&](const double& x) { values_.emplace_back(x); });
    double name = kFirst;
    for_each_number_unnamed(named_, [&](double& x) { x = name++; });
  }

  /// With the `moving` one of them + t or - t.
  [[nodiscard]] std::array<Body, 2> bodies(std::size_t moving, int direction) const {
    const auto make = [&](double x) {
      const double name = std::abs(x);
      if (name < kFirst) return Germ(Rational(x));
      const auto k = static_cast<std::size_t>(name - kFirst);
      const Rational sign(x < 0 ? -1 : 1);
      return k == moving ? Germ(sign * values_[k], sign * Rational(direction)) : Germ(sign * values_[k]);
    };
    std::array<Body, 2> all;
    Body* body = all.data();
    for_each_shape(named_, [&](const auto& shape) { *body++ = body_of(make, shape); });
    for (std::size_t i = 0; i < 2; ++i)
      if (const auto& other = all[1 - i].over)
        for (GermPoint& x : all[i].vertices) x = *other * x;
    return all;
  }
  /// What all vertices of both are times.
  [[nodiscard]] static Germ scale(const std::array<Body, 2>& all) {
    Germ scale(Rational(1));
    for (const Body& body : all)
      if (body.over) scale = scale * *body.over;
    return scale;
  }

 private:
  static constexpr double kFirst = 16;  // above every number that `core_of` names itself

  template <class Make, class Shape>
  static Body body_of(const Make& make, const Shape& shape) {
    Body body;
    if constexpr (std::same_as<Shape, Plane>) {
      body.normal = vec(make, shape.normal);
      body.offset = make(shape.offset);
    } else if constexpr (HullOfVertices<Shape>) {
      body.vertices = points_of(make, shape);
    } else {
      auto core = core_of(make, shape);
      body.vertices = std::move(core.vertices);
      body.over = std::move(core.over);
      body.keeps_faces = kIsOneOf<Shape, Box, Obb>;
    }
    if constexpr (kHasRadius<Shape>) body.radius = make(shape.radius);
    return body;
  }

  Query named_;
  std::vector<Rational> values_;
};
constexpr auto kNoneMoves = static_cast<std::size_t>(-1);

/// Which of its vertices lie farthest along n, or against it.
std::vector<std::size_t> farthest(const Body& body, const Point& n, int sign) {
  std::vector<std::size_t> found;
  Rational most(0);
  for (std::size_t k = 0; k < body.vertices.size(); ++k) {
    const GermPoint& x = body.vertices[k];
    const Rational along = Rational(sign) * dot(n, Point{x[0][0], x[1][0], x[2][0]});
    if (!found.empty() && along < most) continue;
    if (found.empty() || along > most) found.clear();
    most = along;
    found.push_back(k);
  }
  return found;
}

/// The features between some vertices: those of a box; else each two and three of them, which all faces that a small change may make are among.
std::vector<Feature> features_between(const Body& body, const std::vector<std::size_t>& vertices) {
  std::vector<Feature> all;
  if (body.keeps_faces) {
    for (const Feature& feature : features::kBox)
      if (std::all_of(feature.corners().begin(), feature.corners().end(),
                      [&](std::size_t k) { return std::find(vertices.begin(), vertices.end(), k) != vertices.end(); }))
        all.push_back(feature);
    return all;
  }
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    all.push_back(features::vertex(vertices[i]));
    for (std::size_t j = 0; j < i; ++j) {
      all.push_back(features::edge(vertices[i], vertices[j]));
      for (std::size_t k = 0; k < j; ++k) all.push_back({3, {vertices[i], vertices[j], vertices[k]}});
    }
  }
  return all;
}

// ---- what is nearest ----

/// What is nearest of the lines and planes through two features: so much of each of their ways, over `over`, which is >= 0.
///   w = g's corner - f's     u_i the ways of f, and those of g turned round     q - p = w - sum s_i u_i, at right angles to every u_i
struct Foot {
  std::array<Germ, 2> parts;
  Germ over;
  Germ distance2;  ///< its square, times over
};
struct Try {
  Feature f;
  Feature g;
};
Foot foot(const std::array<Body, 2>& bodies, const Try& x) {
  const auto& [a, b] = bodies;
  const GermPoint& corner = a.vertices[x.f.places[0]];
  std::vector<GermPoint> u;
  for (std::size_t k = 0; k < x.f.dimension(); ++k) u.push_back(a.vertices[x.f.places[k + 1]] - corner);
  for (std::size_t k = 0; k < x.g.dimension(); ++k)
    u.push_back(b.vertices[x.g.places[0]] - b.vertices[x.g.places[k + 1]]);
  const GermPoint w = b.vertices[x.g.places[0]] - corner;
  Foot found{{}, Germ(Rational(1)), dot(w, w)};
  if (u.empty()) return found;
  const Germ along = dot(u[0], u[0]);
  const Germ h = dot(u[0], w);
  if (u.size() == 1) {
    found.over = along;
    found.parts[0] = h;
    found.distance2 = found.distance2 * along - h * h;
    return found;
  }
  const Germ across = dot(u[0], u[1]);
  const Germ along1 = dot(u[1], u[1]);
  const Germ h1 = dot(u[1], w);
  found.over = along * along1 - across * across;
  found.parts = {along1 * h - across * h1, along * h1 - across * h};
  found.distance2 = found.distance2 * found.over - found.parts[0] * h - found.parts[1] * h1;
  return found;
}

/// Whether it lies in both features.
bool is_within(const Foot& foot, const Try& x) {
  const Germ* part = foot.parts.data();
  for (const Feature& feature : {x.f, x.g}) {
    Germ rest = foot.over;
    for (std::size_t k = 0; k < feature.dimension(); ++k, ++part) {
      if (part->sign() < 0 || (foot.over - *part).sign() < 0) return false;
      rest = rest - *part;
    }
    if (!feature.is_parallelogram() && rest.sign() < 0) return false;
  }
  return true;
}

/// The point of one of them there, times over.
GermPoint point_of(const Body& body, const Feature& feature, const Germ* parts, const Germ& over) {
  const GermPoint& corner = body.vertices[feature.places[0]];
  GermPoint x = over * corner;
  for (std::size_t k = 0; k < feature.dimension(); ++k)
    x = x + parts[k] * (body.vertices[feature.places[k + 1]] - corner);
  return x;
}
GermPoint first_point(const std::array<Body, 2>& bodies, const Foot& foot, const Try& x) {
  return point_of(bodies[0], x.f, foot.parts.data(), foot.over);
}

bool is_same(const GermPoint& x, const Germ& over_x, const GermPoint& y, const Germ& over_y) {
  return std::equal(x.begin(), x.end(), y.begin(),
                    [&](const Germ& a, const Germ& b) { return (a * over_y - b * over_x).is_zero(); });
}

struct Nearest {
  Try at;
  Foot foot;
  bool unique = true;
};
/// Domain: what is nearest is among them.
Nearest nearest(const std::array<Body, 2>& bodies, const std::vector<Try>& tries) {
  std::optional<Nearest> least;
  for (const Try& x : tries) {
    const Foot there = foot(bodies, x);
    if (there.over.is_zero() || !is_within(there, x)) continue;
    const int order = least ? (there.distance2 * least->foot.over - least->foot.distance2 * there.over).sign() : -1;
    if (order > 0) continue;
    if (order < 0)
      least = Nearest{x, there};
    else if (!is_same(first_point(bodies, there, x), there.over, first_point(bodies, least->foot, least->at),
                      least->foot.over))
      least->unique = false;
  }
  if (!least) throw std::logic_error("no two features are nearest");
  return *least;
}

/// The features of which something may be nearest after a small change, of those between some vertices of each body.
struct Tries {
  std::vector<Try> all;
  bool is_smooth = false;  ///< it is one pair of them, whatever changes
  bool too_many = false;
};
Tries tries_between(const std::array<Body, 2>& bodies, const std::vector<std::size_t>& of_a,
                    const std::vector<std::size_t>& of_b, const Rational& distance2) {
  Tries found;
  const std::vector<Feature> all_f = features_between(bodies[0], of_a);
  const std::vector<Feature> all_g = features_between(bodies[1], of_b);
  if (all_f.size() * all_g.size() > kMostTries) return {{}, false, true};
  for (const Feature& f : all_f)
    for (const Feature& g : all_g) {
      if (f.dimension() + g.dimension() > 2) continue;
      const Try x{f, g};
      const Foot there = foot(bodies, x);
      if (!there.over.is_zero() && !is_within(there, x)) continue;
      if (there.distance2[0] == distance2 * there.over[0]) found.all.push_back(x);
    }
  // On the boundary of a feature it would lie in one of fewer corners too.
  found.is_smooth = found.all.size() == 1 && !CGAL::is_zero(distance2);
  found.too_many = found.all.size() > kMostTies;
  return found;
}

/// Those that are needed where one number moves: of those that stay as they are, which are all as near, one.
std::vector<Try> of_what_moves(const std::vector<Try>& tries, const std::array<Body, 2>& bodies) {
  const auto stays = [&](const Try& x) {
    for (const auto& [body, feature] : {std::pair(&bodies[0], &x.f), std::pair(&bodies[1], &x.g)})
      for (const std::size_t k : feature->corners())
        for (const Germ& number : body->vertices[k])
          if (!(number - Germ(number[0])).is_zero()) return false;
    return true;
  };
  std::vector<Try> needed;
  bool has_one = false;
  for (const Try& x : tries) {
    const bool is_still = stays(x) && !foot(bodies, x).over.is_zero();
    if (is_still && std::exchange(has_one, true)) continue;
    needed.push_back(x);
  }
  return needed;
}

// ---- from what is nearest to the numbers of a contact ----

/// The nearest points, and a vector along the normal.
struct Points {
  JetPoint p;
  JetPoint q;
  JetPoint along;
};
JetPoint quotients(const GermPoint& x, const Germ& over) {
  return {begin_of(x[0], over), begin_of(x[1], over), begin_of(x[2], over)};
}
Points points_at(const std::array<Body, 2>& bodies, const Nearest& at, bool overlap) {
  const Germ over = at.foot.over * MovingNumbers::scale(bodies);
  Points found{quotients(first_point(bodies, at.foot, at.at), over),
               quotients(point_of(bodies[1], at.at.g, at.foot.parts.data() + at.at.f.dimension(), at.foot.over), over),
               {}};
  found.along = overlap ? found.p - found.q : found.q - found.p;
  return found;
}

/// The derivatives of a contact's numbers. With L = along.along: value = along.(q - p) / sqrt L - r1 - r2, normal = along / sqrt L.
Side derivatives(const Points& at, const std::array<Body, 2>& bodies) {
  const Jet length2 = dot(at.along, at.along);
  // The derivative of x / sqrt L is this times sqrt L.
  const auto of_quotient = [&](const Jet& x) -> Rational {
    return x.by / length2.at - x.at * length2.by / (Rational(2) * length2.at * length2.at);
  };
  const Germ& r1 = bodies[0].radius;
  const Germ& r2 = bodies[1].radius;
  Side all;
  all[0] = Exact(-(r1[1] + r2[1]), of_quotient(dot(at.along, at.q - at.p)), length2.at);
  for (std::size_t i = 0; i < 3; ++i) {
    const Rational normal = at.along[i].at / length2.at;
    const Rational turned = of_quotient(at.along[i]);
    all[1 + i] = Exact(Rational(0), turned, length2.at);
    all[4 + i] = Exact(at.p[i].by, r1[1] * normal + r1[0] * turned, length2.at);
    all[7 + i] = Exact(at.q[i].by, -(r2[1] * normal + r2[0] * turned), length2.at);
  }
  return all;
}

/// What is said of a question from one side of a number.
struct FromSide {
  Side derivatives;
  bool unique = true;
};
/// The same of t that grows the other way, where nothing changes but that.
FromSide turned_round(FromSide side) {
  for (auto& x : side.derivatives)
    if (x) x = x->scaled(Rational(-1));
  return side;
}
enum class Output { value, normal, point };
constexpr Output kind_of_output(std::size_t output) {
  return output == 0 ? Output::value : output < 4 ? Output::normal : Output::point;
}

/// A question, asked from the side of each of its numbers.
class Asked {
 public:
  Asked(const Query& query, const DistanceTruth& truth) : numbers_(query), truth_(truth) {
    const auto still = numbers_.bodies(kNoneMoves, 0);
    const bool over_plane = truth.cores().half_space.has_value();
    const bool is_deep = truth.meets() && !CGAL::is_zero(truth.meeting().depth2);
    if (!truth.spread().empty()) undefined_[2] = kMany;
    if (over_plane) {
      lowest_ = farthest(still[0], oracle::point_of(plane_of(query).normal), -1);
      is_smooth_ = lowest_.size() == 1;
    } else if (is_deep) {
      settle_depth(still);
    } else if (truth.meets()) {
      meets_ = true;
      undefined_[1] = undefined_[2] = kMeet;
      const bool is_thin = !is_convex(query.pair) && !still[1].keeps_faces;
      if (!is_thin) undefined_[0] = kTouch;
      if (is_thin) settle_tries(still, all_of(still[0]), all_of(still[1]));
    } else {
      settle_tries(still, farthest(still[0], truth.along(), 1), farthest(still[1], truth.along(), -1));
    }
  }

  [[nodiscard]] std::string_view undefined(std::size_t output) const {
    return undefined_[static_cast<std::size_t>(kind_of_output(output))];
  }
  [[nodiscard]] bool is_smooth() const { return is_smooth_; }
  /// What makes both sides differ.
  [[nodiscard]] std::string_view kink() const { return meets_ ? kMeetKink : kKink; }
  /// Where a number grows by t, or falls by it: the derivatives by t.
  [[nodiscard]] FromSide from(std::size_t moving, int direction) const {
    const auto bodies = numbers_.bodies(moving, direction);
    if (!undefined_[0].empty()) {  // a radius changes no core
      FromSide found;
      const Rational radii = bodies[0].radius[1] + bodies[1].radius[1];
      if (!CGAL::is_zero(radii)) found.derivatives[0] = Exact(-radii);
      return found;
    }
    if (truth_.cores().half_space) return over_plane(bodies);
    if (!ways_.empty()) return by_ways(bodies);
    const auto needed = is_smooth_ ? tries_ : of_what_moves(tries_, bodies);
    const Nearest at = is_smooth_ ? Nearest{needed[0], foot(bodies, needed[0])} : nearest(bodies, needed);
    if (!meets_) return {derivatives(points_at(bodies, at, false), bodies), at.unique};
    FromSide found;  // D = c t^2 and more, or 0
    const Germ& distance2 = at.foot.distance2;
    const std::size_t first = at.foot.over.order();
    const Rational scale = MovingNumbers::scale(bodies)[0];
    const Rational c = distance2[first + 2] / (at.foot.over[first] * scale * scale);
    found.derivatives[0] = Exact(-(bodies[0].radius[1] + bodies[1].radius[1]), Rational(1), c);
    return found;
  }

 private:
  static const Plane& plane_of(const Query& query) {
    const Plane* found = nullptr;
    for_each_shape(query, [&]<class Shape>(const Shape& shape) {
      if constexpr (std::same_as<Shape, Plane>) found = &shape;
    });
    return *found;
  }
  static std::vector<std::size_t> all_of(const Body& body) {
    std::vector<std::size_t> all(body.vertices.size());
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = k;
    return all;
  }

  void settle_tries(const std::array<Body, 2>& still, const std::vector<std::size_t>& of_a,
                    const std::vector<std::size_t>& of_b) {
    const Rational scale = MovingNumbers::scale(still)[0];
    Tries found = tries_between(still, of_a, of_b, truth_.distance2() * scale * scale);
    if (found.too_many) undefined_.fill(kTies);
    is_smooth_ = found.is_smooth;
    tries_ = std::move(found.all);
  }

  /// Of cores that overlap, the features that each of the shortest ways out parts: one feature of each core, whatever changes.
  void settle_depth(const std::array<Body, 2>& still) {
    for (const WayOut& way : truth_.meeting().ways) {
      const auto facing = [&](std::size_t shape) -> std::optional<Feature> {
        const auto vertices = farthest(still[shape], way.direction, shape == 0 ? 1 : -1);
        if (vertices.size() > 4) return std::nullopt;
        for (const Feature& feature : features_between(still[shape], vertices))
          if (feature.size == vertices.size()) return feature;
        return std::nullopt;
      };
      const auto f = facing(0);
      const auto g = facing(1);
      if (!f || !g || f->dimension() + g->dimension() != 2 || foot(still, {*f, *g}).over.is_zero())
        return undefined_.fill(kSplit);
      ways_.push_back({*f, *g});
    }
    is_smooth_ = ways_.size() == 1;
    if (!is_smooth_) undefined_[1] = undefined_[2] = kWays;
  }
  /// The least depth of some: the greatest value.
  [[nodiscard]] FromSide by_ways(const std::array<Body, 2>& bodies) const {
    FromSide found;
    for (const Try& way : ways_) {
      const Side other = derivatives(points_at(bodies, {way, foot(bodies, way)}, true), bodies);
      if (!found.derivatives[0])
        found.derivatives = other;
      else
        found.derivatives[0] = larger_of(*found.derivatives[0], *other[0]);  // of one root: the depth is one
    }
    return found;
  }
  [[nodiscard]] FromSide over_plane(const std::array<Body, 2>& bodies) const {
    const auto& [body, plane] = bodies;
    FromSide found;
    const GermPoint* low = nullptr;
    for (const std::size_t k : lowest_) {
      const GermPoint& x = body.vertices[k];
      const int order = low == nullptr ? -1 : dot(plane.normal, x - *low).sign();
      if (order == 0 && !is_same(x, Rational(1), *low, Rational(1))) found.unique = false;
      if (order >= 0) continue;
      low = &x;
      found.unique = true;
    }
    const Germ one{Rational(1)};
    const JetPoint n = quotients(plane.normal, one);
    const JetPoint p = quotients(*low, MovingNumbers::scale(bodies));
    const Jet height = (dot(n, p) - begin_of(plane.offset, one)) / dot(n, n);
    const JetPoint q = p - height * n;
    found.derivatives = derivatives({p, q, Jet{Rational(-1), Rational(0)} * n}, bodies);
    return found;
  }

  MovingNumbers numbers_;
  const DistanceTruth& truth_;
  std::array<std::string_view, 3> undefined_;  ///< why, whichever number moves: of the value, the normal, the points
  bool meets_ = false;
  bool is_smooth_ = false;
  std::vector<Try> tries_;
  std::vector<Try> ways_;
  std::vector<std::size_t> lowest_;
};

/// Which numbers may not fall, and which may not grow.
std::vector<std::array<bool, 2>> edges_of_domain(const Query& query) {
  std::vector<std::array<bool, 2>> all;
  for_each_shape(query, [&]<class Shape>(const Shape& shape) {
    const std::size_t first = all.size();
    for_each_field(shape, [&](const auto& field, const auto& value) {
      for_each_number_in(value, [&](const double& x) {
        all.push_back({field.kind == FieldKind::length && x == 0, false});
      });
    });
    if constexpr (std::same_as<Shape, Box>)
      for (std::size_t i = 0; i < 3; ++i)
        all[first + i][1] = all[first + 3 + i][0] =
            shape.min[static_cast<Eigen::Index>(i)] == shape.max[static_cast<Eigen::Index>(i)];
  });
  return all;
}

/// Whether both sides say the same. Where cores meet each has a root of its own, the one above 0, the other below.
bool are_equal(const Exact& x, const Exact& y) {
  return x.sign() == y.sign() && x.plus(y.scaled(Rational(-1))).sign() == CGAL::ZERO;
}

/// Both sides of one number of a contact. A side that is not there is outside the domain.
Derivative derivative(std::string_view undefined, std::string_view kink, std::size_t output,
                      const std::optional<FromSide>& below, const std::optional<FromSide>& above) {
  const auto from = [&](const std::optional<FromSide>& side) {
    return side ? side->derivatives[output] : std::nullopt;
  };
  const auto x = from(below) ? std::optional(from(below)->scaled(Rational(-1))) : std::nullopt;
  const auto y = from(above);
  const auto rounded = [](const std::optional<Exact>& side) {
    return side ? std::optional(round_to_nearest(*side, Scalar::binary64)) : std::nullopt;
  };
  if (kind_of_output(output) == Output::point && undefined.empty() &&
      ((below && !below->unique) || (above && !above->unique)))
    undefined = kManyBeside;
  const bool is_told = undefined.empty() || (output == 0 && (x || y));
  if (!is_told) return {std::nullopt, undefined};
  if (!below || !above) return {std::nullopt, kEdge, {rounded(x), rounded(y)}};
  if (!are_equal(*x, *y)) return {std::nullopt, kink, {rounded(x), rounded(y)}};
  return {rounded(y)};
}

}  // namespace
}  // namespace gradients

std::optional<Gradient> gradient(const Query& query, const Truth& truth) {
  using namespace gradients;
  if (!query.has_distance()) return std::nullopt;
  const DefaultEnvironment environment;
  const Asked asked(query, *truth.distance());
  const auto edges = edges_of_domain(query);
  Gradient found;
  for_each_number(query, [&](const std::string& field, const double&) {
    if (found.by.size() < edges.size()) found.by.push_back(field);
  });
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const auto [no_below, no_above] = edges[k];
    std::optional<FromSide> above;
    std::optional<FromSide> below;
    if (!no_above) above = asked.from(k, 1);
    if (!no_below) below = asked.is_smooth() && above ? turned_round(*above) : asked.from(k, -1);
    auto& of = found.derivatives.emplace_back();
    for (std::size_t output = 0; output < kOutputs; ++output)
      of[output] = derivative(asked.undefined(output), asked.kink(), output, below, above);
  }
  return found;
}

}  // namespace contact::oracle
