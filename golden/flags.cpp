// The flags of a case: facts about a question, derived from the exact answer, that say why it is worth asking.
#include "golden/flags.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "golden/plain.hpp"
#include "oracle/truth/cores.hpp"

namespace contact::golden {
namespace {

using oracle::DistanceTruth;
using oracle::Exact;
using oracle::operator+;
using oracle::operator-;
using oracle::operator*;
using oracle::Point;
using oracle::point_of;
using oracle::power_of_two;
using oracle::Rational;
using oracle::Truth;

constexpr int kNearUlps = 8;        // "near" a boundary: within this many ulps of it
constexpr int kHardExponent = -20;  // "hard to round": within 2 to this power ulps of a rounding boundary

Rational square(const Rational& x) { return x * x; }

bool is_near_zero(const Exact& x, const Exact& scale, Scalar scalar) {
  return oracle::is_within(Rational(0), x, Rational(kNearUlps) * oracle::ulp(scale, scalar));
}

const Rational& largest_gap(const Truth& truth) { return truth.gaps()->widest_gap(); }

Rational largest_coordinate(const Query& query) {
  Rational largest(0);
  for_each_field(query, [&](const std::string&, const auto& value, FieldKind kind) {
    if (kind != FieldKind::point) return;
    for_each_number_in(value, [&](double x) { largest = std::max(largest, Rational(std::abs(x))); });
  });
  return largest;
}

Rational smallest_normal(Scalar scalar) { return power_of_two(format_of(scalar).min_exponent); }
Rational first_beyond(Scalar scalar) { return power_of_two(format_of(scalar).max_exponent + 1); }

/// The largest size of a shape; 0 of a half-space.
template <class Shape>
Rational size_of(const Shape& shape) {
  Rational size(0);
  std::optional<Vector3> from;
  for_each_field(shape, [&](const auto& field, const auto& value) {
    if (field.kind == FieldKind::length)
      for_each_number_in(value, [&](double r) { size = std::max(size, Rational(r)); });
    if (field.kind != FieldKind::point) return;
    for_each_vector(value, [&](const Vector3& to) {
      if (!from) from = to;
      for (int axis = 0; axis < 3; ++axis)
        size = std::max(size, Rational(CGAL::abs(Rational(to[axis]) - Rational((*from)[axis]))));
    });
  });
  return size;
}
/// Of a ray the largest part of its way along an axis.
Rational size_of(const Ray& ray) {
  Rational size(0);
  for (int axis = 0; axis < 3; ++axis)
    size = std::max(size, Rational(CGAL::abs(Rational(ray.length) * Rational(ray.direction[axis]))));
  return size;
}
/// Of what a ray is cast at, or of both shapes.
Rational size_of_shapes(const Query& query) {
  std::vector<Rational> sizes;
  for_each_shape(query, [&](const auto& shape) { sizes.push_back(size_of(shape)); });
  return is_cast(query.pair) ? sizes[1] : std::max(sizes[0], sizes[1]);
}

/// Whether one of the coordinates of a crossing is 0 or 1, exactly.
bool at_boundary(const Query& query) {
  const auto is_at = [](const Point& start, const Point& along, const Triangle& triangle) {
    const Point v0 = point_of(triangle.vertices[0]);
    const Point u = point_of(triangle.vertices[1]) - v0;
    const Point v = point_of(triangle.vertices[2]) - v0;
    const Point n = oracle::cross(u, v);
    const Point w = start - v0;
    const Point turned = oracle::cross(w, along);
    const Rational s = oracle::dot(v, turned);
    const Rational t = oracle::dot(u, turned);
    return CGAL::is_zero(oracle::dot(n, w)) || CGAL::is_zero(oracle::dot(n, w + along)) || CGAL::is_zero(s) ||
           CGAL::is_zero(t) || CGAL::is_zero(oracle::dot(n, along) + s - t);
  };
  if (const auto* ray = std::get_if<RayAndTriangle>(&query.shapes))
    return is_at(point_of(ray->a.origin), Rational(ray->a.length) * point_of(ray->a.direction), ray->b);
  const auto& [triangle, line] = std::get<TriangleAndLine>(query.shapes);
  return is_at(point_of(line.start), point_of(line.end) - point_of(line.start), triangle);
}

bool near_boundary(const Query& query, const Truth& truth, Scalar scalar, double margin_ulps) {
  if (truth.at_alarm == oracle::Side::at) return false;
  if (truth.crossing() != nullptr || truth.cast() != nullptr) return false;
  if (truth.has_distance()) {
    // What rounds to a double above 8 is above 8, and so below. What rounds to 8 is compared exactly.
    if (const double size = std::abs(margin_ulps); size != kNearUlps) return size < kNearUlps;
    return oracle::is_within(Rational(0), truth.distance()->margin(scalar), Rational(kNearUlps));
  }
  const Rational off = largest_gap(truth) - truth.gaps()->alarm();
  return CGAL::abs(off) <=
         Rational(kNearUlps) * oracle::ulp(std::max(largest_coordinate(query), truth.gaps()->alarm()), scalar);
}

bool contained(const Box& inner, const Box& outer) {
  return (inner.min.array() >= outer.min.array()).all() && (inner.max.array() <= outer.max.array()).all();
}

bool has_subnormal(const Query& query, Scalar scalar) {
  bool found = false;
  const double least = std::ldexp(1.0, format_of(scalar).min_exponent);
  for_each_number(query, [&](const std::string&, double x) { found = found || (x != 0 && std::abs(x) < least); });
  return found;
}

bool overflows(const Expectation& right) {
  const auto& contact = right.contact;
  return contact && !(std::isfinite(contact->value) && contact->point1.allFinite() && contact->point2.allFinite());
}

/// Whether a number of the answer is a tie, or all but one.
struct OnBoundaries {
  bool tie = false;
  bool hard = false;
};
OnBoundaries on_boundaries(const Truth& truth, Scalar scalar) {
  OnBoundaries on;
  if (!truth.has_numbers() || !truth.hit()) return on;
  for (const auto& [field, x] : oracle::numbers(*truth.contact())) {
    if (!oracle::may_be_near_boundary(x, scalar, kHardExponent)) continue;
    const oracle::Boundary boundary = oracle::nearest_boundary(x, scalar);
    if (x.compare(boundary.at) == CGAL::EQUAL)
      on.tie = true;
    else
      on.hard = on.hard || oracle::is_within(boundary.at, x, power_of_two(kHardExponent) * boundary.ulp);
  }
  return on;
}

bool is_flat(const Ball& /*ball*/) { return false; }
bool is_flat(const Box& box) { return (box.min.array() == box.max.array()).any(); }
bool is_flat(const Capsule& capsule) { return capsule.start == capsule.end; }
bool is_flat(const Triangle& triangle) {
  const auto& [x, y, z] = triangle.vertices;
  return oracle::is_zero(oracle::cross(point_of(y) - point_of(x), point_of(z) - point_of(x)));
}
bool is_flat(const Plane& /*plane*/) { return false; }
bool is_flat(const Line& line) { return line.start == line.end; }
bool is_flat(const Ray& ray) { return ray.length == 0; }

bool is_flat(const Obb& box) { return (box.extents.array() == 0).any(); }
template <HullOfVertices Shape>
bool is_flat(const Shape& hull) {
  return oracle::exact_core(hull).outward.empty();
}
template <class Shape>
bool is_point(const Shape& shape) {
  if constexpr (kHasRadius<Shape>) return shape.radius == 0;
  return false;
}
bool is_point(const Hull& hull) {
  return hull.radius == 0 && std::all_of(hull.vertices.begin(), hull.vertices.end(),
                                         [&](const Vector3& v) { return v == hull.vertices[0]; });
}

template <class Predicate>
bool any_shape(const Query& query, Predicate predicate) {
  bool any = false;
  for_each_shape(query, [&](const auto& shape) { any = any || predicate(shape); });
  return any;
}

bool any_delta(const Query& query, auto&& predicate) {
  const Balls* balls = query.balls();
  if (balls == nullptr) return false;
  for (int axis = 0; axis < 3; ++axis)
    if (predicate(CGAL::abs(Rational(balls->b.center[axis]) - Rational(balls->a.center[axis])))) return true;
  return false;
}

/// A question with what is known of its answer.
struct Asked {
  const Query& query;
  const Truth& truth;
  Scalar scalar;
  const Expectation& right;
  double margin_ulps;
  OnBoundaries rounding;
};

/// When a flag holds.
struct Holds {
  std::string_view flag;
  bool (*holds)(const Asked& asked);
};

constexpr std::array kHolds{
    Holds{"Touching",
          [](const Asked& a) { return a.query.distances.alarm == 0 && a.truth.at_alarm == oracle::Side::at; }},
    Holds{"AlarmEdge",
          [](const Asked& a) { return a.query.distances.alarm > 0 && a.truth.at_alarm == oracle::Side::at; }},
    Holds{"NearBoundary", [](const Asked& a) { return near_boundary(a.query, a.truth, a.scalar, a.margin_ulps); }},
    Holds{"PlainWrong", [](const Asked& a) { return plain_overlap(a.query, a.scalar) != a.truth.hit(); }},
    Holds{"ContactEdge",
          [](const Asked& a) {
            return a.truth.has_distance() && a.truth.hit() &&
                   (a.query.distances.contact > 0 || a.truth.at_alarm != oracle::Side::at) &&
                   is_near_zero(a.truth.distance()->value(true), a.truth.distance()->value_scale(), a.scalar);
          }},
    Holds{"Coincident", [](const Asked& a) { return a.truth.coincident(); }},
    Holds{"NearlyCoincident",
          [](const Asked& a) {
            if (!a.truth.has_distance() || a.truth.degenerate() || a.truth.distance()->overlaps() ||
                a.truth.distance()->cores().half_space)
              return false;
            return a.truth.distance()->distance2() < square(a.truth.distance()->radii() * power_of_two(-20)) ||
                   a.truth.distance()->distance2() < square(smallest_normal(a.scalar));
          }},
    Holds{"BelowPlane",
          [](const Asked& a) {
            return has_plane(a.query.pair) &&
                   (a.truth.distance()->below() || CGAL::is_zero(a.truth.distance()->distance2()));
          }},
    Holds{"CrossingEdge",
          [](const Asked& a) { return a.truth.crossing() != nullptr && a.truth.hit() && at_boundary(a.query); }},
    Holds{"FromInside", [](const Asked& a) { return a.truth.cast() != nullptr && a.truth.degenerate(); }},
    Holds{"Grazing",
          [](const Asked& a) {
            return a.truth.cast() != nullptr && a.truth.hit() && !a.truth.degenerate() &&
                   CGAL::is_zero(a.truth.cast()->entry()->half2) &&
                   (std::holds_alternative<CastAt<Ball>>(a.query.shapes) ||
                    std::holds_alternative<CastAt<Capsule>>(a.query.shapes));
          }},
    Holds{"ManyNormals",
          [](const Asked& a) {
            return a.truth.cast() != nullptr && a.truth.hit() && a.truth.contact()->cast()->against.has_value();
          }},
    Holds{"EndsAtSurface",
          [](const Asked& a) {
            if (a.truth.cast() == nullptr || !a.truth.hit()) return false;
            double length = 0;
            std::visit(
                [&]<class A, class B>(const Two<A, B>& shapes) {
                  if constexpr (std::same_as<A, Cast>) length = shapes.a.length;
                },
                a.query.shapes);
            return a.truth.cast()->entry()->first().compare(Rational(length)) == CGAL::EQUAL;
          }},
    Holds{"Containment",
          [](const Asked& a) {
            if (const Boxes* b = a.query.boxes()) return contained(b->a, b->b) || contained(b->b, b->a);
            if (a.truth.crossing() != nullptr || a.truth.cast() != nullptr) return false;
            if (is_convex(a.query.pair)) return false;
            if (a.query.balls() == nullptr) return a.truth.degenerate() && !a.truth.coincident();
            return a.truth.distance()->distance2() <=
                   square(Rational(a.query.balls()->a.radius) - Rational(a.query.balls()->b.radius));
          }},
    Holds{"Overlap", [](const Asked& a) { return is_convex(a.query.pair) && a.truth.distance()->overlaps(); }},
    Holds{"ZeroRadius",
          [](const Asked& a) { return any_shape(a.query, [](const auto& shape) { return is_point(shape); }); }},
    Holds{"Flat", [](const Asked& a) { return any_shape(a.query, [](const auto& shape) { return is_flat(shape); }); }},
    Holds{"ManyNearest",
          [](const Asked& a) {
            return a.truth.has_distance() && a.truth.hit() && !a.truth.distance()->spread().empty();
          }},
    Holds{"OneAxis",
          [](const Asked& a) {
            int apart = 0;
            any_delta(a.query, [&](const Rational& d) { return apart += CGAL::is_zero(d) ? 0 : 1, false; });
            return apart == 1;
          }},
    Holds{"FarFromOrigin",
          [](const Asked& a) {
            Rational size(0);
            if (a.truth.has_distance()) size = a.truth.distance()->reach();
            if (a.truth.gaps() != nullptr) size = CGAL::abs(largest_gap(a.truth)) + a.truth.gaps()->alarm();
            if (is_crossing(a.query.pair) || is_cast(a.query.pair) || is_convex(a.query.pair))
              size = std::max(size, size_of_shapes(a.query));
            return !CGAL::is_zero(size) && largest_coordinate(a.query) >= power_of_two(8) * size;
          }},
    Holds{"SquareOverflow",
          [](const Asked& a) {
            return a.truth.has_distance() && std::max(a.truth.distance()->distance2(),
                                                      square(a.truth.distance()->reach())) >= first_beyond(a.scalar);
          }},
    Holds{"SquareUnderflow",
          [](const Asked& a) {
            return any_delta(
                a.query, [&](const Rational& d) { return !CGAL::is_zero(d) && square(d) < smallest_normal(a.scalar); });
          }},
    Holds{"ReachOverflow",
          [](const Asked& a) {
            if (a.truth.has_distance()) return a.truth.distance()->reach() >= first_beyond(a.scalar);
            if (a.query.boxes() == nullptr) return false;
            Rational largest(0);
            for (int axis = 0; axis < 3; ++axis)
              largest =
                  std::max({largest, Rational(a.query.boxes()->a.max[axis]), Rational(a.query.boxes()->b.max[axis])});
            return largest + a.truth.gaps()->alarm() >= first_beyond(a.scalar);
          }},
    Holds{"ResultOverflow", [](const Asked& a) { return overflows(a.right); }},
    Holds{"HardToRound", [](const Asked& a) { return a.rounding.hard; }},
    Holds{"Tie", [](const Asked& a) { return a.rounding.tie; }},
    Holds{"Subnormal", [](const Asked& a) { return has_subnormal(a.query, a.scalar); }},
    Holds{kInvalidFlag, [](const Asked& /*a*/) { return false; }},
};
static_assert(std::equal(kHolds.begin(), kHolds.end(), kFlags.begin(), kFlags.end(),
                         [](const Holds& x, const Flag& flag) { return x.flag == flag.name; }));

}  // namespace

std::vector<std::string> flags_of(const Query& query, const Truth& truth, Scalar scalar, const Expectation& right,
                                  double margin_ulps) {
  const Asked asked{query, truth, scalar, right, margin_ulps, on_boundaries(truth, scalar)};
  std::vector<std::string> names;
  for (const Holds& flag : kHolds)
    if (flag.holds(asked)) names.emplace_back(flag.flag);
  return names;
}

}  // namespace contact::golden
