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

/// The largest of the sizes of a crossing pair's shapes, from their first points.
Rational crossing_size(const Query& query) {
  Rational size(0);
  const auto add = [&](const Vector3& from, const Vector3& to) {
    for (int axis = 0; axis < 3; ++axis)
      size = std::max(size, Rational(CGAL::abs(Rational(to[axis]) - Rational(from[axis]))));
  };
  const auto add_triangle = [&](const Triangle& t) {
    add(t.vertices[0], t.vertices[1]), add(t.vertices[0], t.vertices[2]);
  };
  if (const auto* ray = std::get_if<RayAndTriangle>(&query.shapes)) {
    add_triangle(ray->b);
    for (int axis = 0; axis < 3; ++axis)
      size = std::max(size, Rational(CGAL::abs(Rational(ray->a.length) * Rational(ray->a.direction[axis]))));
  } else {
    const auto& line = std::get<TriangleAndLine>(query.shapes);
    add_triangle(line.a);
    add(line.b.start, line.b.end);
  }
  return size;
}

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

bool near_boundary(const Query& query, const Truth& truth, Scalar scalar) {
  if (truth.at_alarm == oracle::Side::at) return false;
  if (truth.crossing() != nullptr || truth.cast() != nullptr) return false;
  if (truth.has_distance())
    return oracle::is_within(Rational(0), truth.distance()->margin(scalar), Rational(kNearUlps));
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

bool result_overflows(const Truth& truth, Scalar scalar) {
  if (!truth.has_numbers() || !truth.hit()) return false;
  const Contact contact = *oracle::expectation(truth, scalar).contact;
  return !std::isfinite(contact.value) || !contact.point1.allFinite() || !contact.point2.allFinite();
}

template <class Predicate>
bool any_number(const Truth& truth, Scalar scalar, Predicate predicate) {
  if (!truth.has_numbers() || !truth.hit()) return false;
  const auto all = oracle::numbers(*truth.contact());
  return std::any_of(all.begin(), all.end(), [&](const auto& each) {
    return predicate(each.number, oracle::nearest_boundary(each.number, scalar));
  });
}

bool is_tie(const Exact& x, const oracle::Boundary& boundary) { return x.compare(boundary.at) == CGAL::EQUAL; }
bool is_hard_to_round(const Exact& x, const oracle::Boundary& boundary) {
  return !is_tie(x, boundary) && oracle::is_within(boundary.at, x, power_of_two(kHardExponent) * boundary.ulp);
}

bool is_flat(const Ball& /*ball*/) { return false; }
bool is_flat(const Box& box) { return (box.min.array() == box.max.array()).any(); }
bool is_flat(const Capsule& capsule) { return capsule.start == capsule.end; }
bool is_flat(const Triangle& triangle) {
  using oracle::operator-;
  using oracle::point_of;
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

/// When a flag holds.
struct Holds {
  std::string_view flag;
  bool (*holds)(const Query& query, const Truth& truth, Scalar scalar);
};

constexpr std::array kHolds{
    Holds{"Touching", [](const Query& q, const Truth& t,
                         Scalar) { return q.distances.alarm == 0 && t.at_alarm == oracle::Side::at; }},
    Holds{"AlarmEdge", [](const Query& q, const Truth& t,
                          Scalar) { return q.distances.alarm > 0 && t.at_alarm == oracle::Side::at; }},
    Holds{"NearBoundary", near_boundary},
    Holds{"PlainWrong", [](const Query& q, const Truth& t, Scalar s) { return plain_overlap(q, s) != t.hit(); }},
    Holds{"ContactEdge",
          [](const Query& q, const Truth& t, Scalar s) {
            return t.has_distance() && t.hit() && (q.distances.contact > 0 || t.at_alarm != oracle::Side::at) &&
                   is_near_zero(t.distance()->value(true), t.distance()->value_scale(), s);
          }},
    Holds{"Coincident", [](const Query&, const Truth& t, Scalar) { return t.coincident(); }},
    Holds{"NearlyCoincident",
          [](const Query&, const Truth& t, Scalar s) {
            if (!t.has_distance() || t.degenerate() || t.distance()->overlaps() || t.distance()->cores().half_space)
              return false;
            return t.distance()->distance2() < square(t.distance()->radii() * power_of_two(-20)) ||
                   t.distance()->distance2() < square(smallest_normal(s));
          }},
    Holds{"BelowPlane",
          [](const Query& q, const Truth& t, Scalar) {
            return has_plane(q.pair) && (t.distance()->below() || CGAL::is_zero(t.distance()->distance2()));
          }},
    Holds{"CrossingEdge",
          [](const Query& q, const Truth& t, Scalar) { return t.crossing() != nullptr && t.hit() && at_boundary(q); }},
    Holds{"FromInside", [](const Query&, const Truth& t, Scalar) { return t.cast() != nullptr && t.degenerate(); }},
    Holds{"Grazing",
          [](const Query& q, const Truth& t, Scalar) {
            return t.cast() != nullptr && t.hit() && !t.degenerate() && CGAL::is_zero(t.cast()->entry()->half2) &&
                   (std::holds_alternative<CastAt<Ball>>(q.shapes) ||
                    std::holds_alternative<CastAt<Capsule>>(q.shapes));
          }},
    Holds{"ManyNormals",
          [](const Query&, const Truth& t, Scalar) {
            return t.cast() != nullptr && t.hit() && t.contact()->cast()->against.has_value();
          }},
    Holds{"EndsAtSurface",
          [](const Query& q, const Truth& t, Scalar) {
            if (t.cast() == nullptr || !t.hit()) return false;
            double length = 0;
            std::visit(
                [&]<class A, class B>(const Two<A, B>& shapes) {
                  if constexpr (std::same_as<A, Cast>) length = shapes.a.length;
                },
                q.shapes);
            return t.cast()->entry()->first().compare(Rational(length)) == CGAL::EQUAL;
          }},
    Holds{"Containment",
          [](const Query& q, const Truth& t, Scalar) {
            if (const Boxes* b = q.boxes()) return contained(b->a, b->b) || contained(b->b, b->a);
            if (t.crossing() != nullptr || t.cast() != nullptr) return false;
            if (is_convex(q.pair)) return false;
            if (q.balls() == nullptr) return t.degenerate() && !t.coincident();
            return t.distance()->distance2() <= square(Rational(q.balls()->a.radius) - Rational(q.balls()->b.radius));
          }},
    Holds{"Overlap",
          [](const Query& q, const Truth& t, Scalar) { return is_convex(q.pair) && t.distance()->overlaps(); }},
    Holds{"ZeroRadius", [](const Query& q, const Truth&,
                           Scalar) { return any_shape(q, [](const auto& shape) { return is_point(shape); }); }},
    Holds{"Flat", [](const Query& q, const Truth&,
                     Scalar) { return any_shape(q, [](const auto& shape) { return is_flat(shape); }); }},
    Holds{"ManyNearest", [](const Query&, const Truth& t,
                            Scalar) { return t.has_distance() && t.hit() && !t.distance()->spread().empty(); }},
    Holds{"OneAxis",
          [](const Query& q, const Truth&, Scalar) {
            int apart = 0;
            any_delta(q, [&](const Rational& d) { return apart += CGAL::is_zero(d) ? 0 : 1, false; });
            return apart == 1;
          }},
    Holds{"FarFromOrigin",
          [](const Query& q, const Truth& t, Scalar) {
            if (t.crossing() != nullptr || t.cast() != nullptr) {
              const Rational size = t.cast() != nullptr ? size_of_shapes(q) : crossing_size(q);
              return largest_coordinate(q) >= power_of_two(8) * size && !CGAL::is_zero(size);
            }
            if (is_convex(q.pair)) {
              const Rational size = std::max(size_of_shapes(q), t.distance()->reach());
              return largest_coordinate(q) >= power_of_two(8) * size && !CGAL::is_zero(size);
            }
            if (t.has_distance())
              return largest_coordinate(q) >= power_of_two(8) * t.distance()->reach() &&
                     !CGAL::is_zero(t.distance()->reach());
            return largest_coordinate(q) >= power_of_two(8) * (CGAL::abs(largest_gap(t)) + t.gaps()->alarm()) &&
                   !CGAL::is_zero(largest_coordinate(q)) &&
                   !CGAL::is_zero(CGAL::abs(largest_gap(t)) + t.gaps()->alarm());
          }},
    Holds{"SquareOverflow",
          [](const Query&, const Truth& t, Scalar s) {
            return t.has_distance() &&
                   std::max(t.distance()->distance2(), square(t.distance()->reach())) >= first_beyond(s);
          }},
    Holds{"SquareUnderflow",
          [](const Query& q, const Truth&, Scalar s) {
            return any_delta(q, [&](const Rational& d) { return !CGAL::is_zero(d) && square(d) < smallest_normal(s); });
          }},
    Holds{"ReachOverflow",
          [](const Query& q, const Truth& t, Scalar s) {
            if (t.has_distance()) return t.distance()->reach() >= first_beyond(s);
            if (q.boxes() == nullptr) return false;
            Rational largest(0);
            for (int axis = 0; axis < 3; ++axis)
              largest = std::max({largest, Rational(q.boxes()->a.max[axis]), Rational(q.boxes()->b.max[axis])});
            return largest + t.gaps()->alarm() >= first_beyond(s);
          }},
    Holds{"ResultOverflow", [](const Query&, const Truth& t, Scalar s) { return result_overflows(t, s); }},
    Holds{"HardToRound", [](const Query&, const Truth& t, Scalar s) { return any_number(t, s, is_hard_to_round); }},
    Holds{"Tie", [](const Query&, const Truth& t, Scalar s) { return any_number(t, s, is_tie); }},
    Holds{"Subnormal", [](const Query& q, const Truth&, Scalar s) { return has_subnormal(q, s); }},
    Holds{kInvalidFlag, [](const Query&, const Truth&, Scalar) { return false; }},
};
static_assert(std::equal(kHolds.begin(), kHolds.end(), kFlags.begin(), kFlags.end(),
                         [](const Holds& x, const Flag& flag) { return x.flag == flag.name; }));

}  // namespace

std::vector<std::string> flags_of(const Query& query, const Truth& truth, Scalar scalar) {
  std::vector<std::string> names;
  for (const Holds& flag : kHolds)
    if (flag.holds(query, truth, scalar)) names.emplace_back(flag.flag);
  return names;
}

}  // namespace contact::golden
