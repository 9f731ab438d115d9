// Rays that are cast at shapes, exactly. The first point of the ray's line in a shape is one of some that can be named:
// where the line meets the surface of each of the shape's parts. All of them that lie in the shape are tried, and
// nobody asks in which part the line enters.
//   |w + t d|^2 = r^2 at t = m -+ sqrt(h)     m = -w.d / d.d     h = (r^2 - |w + m d|^2) / d.d
#include "oracle/truth/casts.hpp"

#include <algorithm>

#include "oracle/truth/cores.hpp"
#include "oracle/truth/crossings.hpp"

namespace contact::oracle {
namespace casts {
namespace {

const Rational kNone(0);
const Rational kOne(1);

/// The line of a ray.
struct RayLine {
  Point o;
  Point d;
  [[nodiscard]] Point at(const Rational& t) const { return o + t * d; }
  [[nodiscard]] RayLine reversed() const { return {o, Rational(-1) * d}; }
};

Rational square(const Rational& x) { return x * x; }

/// The sign of a.first() - b.first(), two different roots: of x + sqrt(p) - sqrt(q).
int order(const LineEnd& a, const LineEnd& b) {
  const Rational x = a.middle - b.middle;
  const Exact left(x, kOne, b.half2);
  if (left.sign() == CGAL::NEGATIVE) return -1;
  return static_cast<int>(Exact(square(x) + b.half2 - a.half2, Rational(2) * x, b.half2).sign());
}

/// Where a point is that moves along a line: of a coordinate, rational + slope t.
Exact moving(const Rational& rational, const Rational& slope, const LineEnd& t) {
  return {rational + slope * t.middle, -slope, t.half2};
}

// Of each shape: whether it has a point, where a line enters it first, the largest of its coordinates, and the normals
// there.

/// The reference's normal at a point, and which others are right.
struct Normals {
  std::array<Exact, 3> normal;
  Point along;
  bool either_side = false;
  std::optional<std::vector<Point>> against = {};
};
Normals along(const Point& n) {
  const Rational square = dot(n, n);
  const auto unit = [&](std::size_t i) { return Exact(kNone, n[i] / square, square); };
  return {{unit(0), unit(1), unit(2)}, n};
}
Normals rounded_along(std::array<Exact, 3> normal) {
  constexpr int kBits = 128;
  Point n;
  for (std::size_t i = 0; i < 3; ++i) n[i] = normal[i].enclosure(kBits).low;
  return {std::move(normal), n};
}

/// The normals at a point x of the hull of some points: those that point along no way from x to one of them. Divided by
/// the sums of the absolute values of their components they are polygons, whose corners lie across two ways or axes.
/// Of a box axes are enough.
Normals away_from(const Point& x, const std::vector<Point>& corners, bool is_box = false) {
  std::vector<Point> ways;
  for (const Point& corner : corners) ways.push_back(corner - x);
  const Rational times(common_denominator({&ways}));
  std::vector<Point> whole;
  for (const Point& way : ways) whole.push_back(times * way);
  std::vector<Point> planes = is_box ? std::vector<Point>() : whole;
  for (std::size_t i = 0; i < 3; ++i) planes.emplace_back()[i] = kOne;
  std::vector<Point> right;
  for (const Point& a : planes)
    for (const Point& b : planes) {
      const Point n = cross(a, b);
      const Rational size = CGAL::abs(n[0]) + CGAL::abs(n[1]) + CGAL::abs(n[2]);
      if (CGAL::is_zero(size)) continue;
      if (std::all_of(whole.begin(), whole.end(), [&](const Point& w) { return dot(n, w) <= kNone; }))
        right.push_back(kOne / size * n);
    }
  const auto ends = std::minmax_element(right.begin(), right.end());
  const Point greatest = *ends.second;
  Normals found = along(greatest);
  if (std::all_of(right.begin(), right.end(), [&](const Point& n) { return is_zero(cross(n, greatest)); }))
    found.either_side = *ends.first != greatest;
  else
    found.against = std::move(ways);
  return found;
}

template <class Shape>
Rational largest(const Shape& shape) {
  double most = radius_of(shape);
  for_each_point(shape, [&](const Vector3& p) { most = std::max(most, p.cwiseAbs().maxCoeff()); });
  return Rational(most);
}

/// A sphere, of a radius that may be 0.
struct Round {
  Point center;
  Rational radius;

  [[nodiscard]] bool contains(const Point& x) const { return dot(x - center, x - center) <= square(radius); }
  [[nodiscard]] std::optional<LineEnd> enter(const RayLine& line) const {
    const Rational d2 = dot(line.d, line.d);
    const Rational m = dot(center - line.o, line.d) / d2;
    const Point there = line.at(m) - center;
    const Rational h = (square(radius) - dot(there, there)) / d2;
    if (h < kNone) return std::nullopt;
    return LineEnd{m, h};
  }
  [[nodiscard]] Normals normals(const RayLine& line, const LineEnd& t) const {
    const auto component = [&](std::size_t i) {
      return moving((line.o[i] - center[i]) / radius, line.d[i] / radius, t);
    };
    return rounded_along({component(0), component(1), component(2)});
  }
};

bool contains(const Ball& ball, const Point& x) { return Round{point_of(ball.center), ball.radius}.contains(x); }
std::optional<LineEnd> enter(const Ball& ball, const RayLine& line) {
  return Round{point_of(ball.center), ball.radius}.enter(line);
}
Normals normals(const Ball& ball, const RayLine& line, const LineEnd& t) {
  const Round round{point_of(ball.center), ball.radius};
  return ball.radius == 0 ? away_from(round.center, {round.center}) : round.normals(line, t);
}

/// The core of a capsule: a point, and the way from there to the other end.
struct Segment {
  Point from;
  Point along;
  [[nodiscard]] std::array<Point, 2> ends() const { return {from, from + along}; }
};
Segment axis_of(const Capsule& capsule) {
  const Point start = point_of(capsule.start);
  return {start, point_of(capsule.end) - start};
}
/// The point of a segment nearest to a point, as a part of it.
Rational part_of(const Segment& axis, const Point& x) {
  const Rational length2 = dot(axis.along, axis.along);
  return CGAL::is_zero(length2) ? kNone : dot(x - axis.from, axis.along) / length2;
}
bool contains(const Capsule& capsule, const Point& x) {
  const Segment axis = axis_of(capsule);
  const Rational part = std::clamp(part_of(axis, x), kNone, kOne);
  return Round{axis.from + part * axis.along, capsule.radius}.contains(x);
}
/// Of the cylinder around the axis: the sphere in the plane across it. Nothing where the line goes along it, or enters
/// beside an end.
std::optional<LineEnd> enter_cylinder(const Capsule& capsule, const RayLine& line) {
  const Segment axis = axis_of(capsule);
  const auto across = [&](const Point& v) { return v - dot(v, axis.along) / dot(axis.along, axis.along) * axis.along; };
  if (is_zero(axis.along) || is_zero(across(line.d))) return std::nullopt;
  const RayLine flat{across(line.o - axis.from), across(line.d)};
  const auto t = Round{{}, capsule.radius}.enter(flat);
  if (!t) return std::nullopt;
  const Exact part = moving(part_of(axis, line.o), part_of({{}, axis.along}, line.d), *t);
  const bool beside = part.sign() != CGAL::NEGATIVE && part.compare(kOne) != CGAL::LARGER;
  return beside ? t : std::nullopt;
}
std::optional<LineEnd> enter(const Capsule& capsule, const RayLine& line) {
  std::optional<LineEnd> first = enter_cylinder(capsule, line);
  for (const Point& end : axis_of(capsule).ends())
    if (const auto t = Round{end, capsule.radius}.enter(line); t && (!first || order(*t, *first) < 0)) first = t;
  return first;
}
Normals normals(const Capsule& capsule, const RayLine& line, const LineEnd& t) {
  const Segment axis = axis_of(capsule);
  const auto [start, end] = axis.ends();
  if (capsule.radius == 0) return away_from(line.at(t.middle), {start, end});
  const Exact part = moving(part_of(axis, line.o), part_of({{}, axis.along}, line.d), t);
  if (part.sign() == CGAL::NEGATIVE) return Round{start, capsule.radius}.normals(line, t);
  if (part.compare(kOne) == CGAL::LARGER) return Round{end, capsule.radius}.normals(line, t);
  const Rational r(capsule.radius);
  const Point from = line.o - start - part_of(axis, line.o) * axis.along;
  const Point way = line.d - part_of({{}, axis.along}, line.d) * axis.along;
  const auto component = [&](std::size_t i) { return moving(from[i] / r, way[i] / r, t); };
  return rounded_along({component(0), component(1), component(2)});
}

bool contains(const Box& box, const Point& x) {
  const Point low = point_of(box.min);
  const Point high = point_of(box.max);
  return x[0] >= low[0] && x[1] >= low[1] && x[2] >= low[2] && x[0] <= high[0] && x[1] <= high[1] && x[2] <= high[2];
}
/// Whether it has the point x / over, over > 0.
bool contains(const Triangle& triangle, const Point& x, const Rational& over = kOne) {
  const std::vector<Point> v = exact_core(triangle).vertices;
  const Point n = cross(v[1] - v[0], v[2] - v[0]);
  bool inside = !is_zero(n) && CGAL::is_zero(dot(n, x - over * v[0]));
  for (std::size_t k = 0; k < 3; ++k) {
    const Point edge = v[(k + 1) % 3] - v[k];
    const Point w = x - over * v[k];
    const Point turned = cross(edge, w);
    if (is_zero(turned) && dot(edge, w) >= kNone && dot(w, w) <= square(over) * dot(edge, edge))
      return true;  // on the edge
    inside = inside && dot(n, turned) > kNone;
  }
  return inside;
}

bool contains_at(const Box& box, const RayLine& line, const Rational& t) { return contains(box, line.at(t)); }
bool contains_at(const Triangle& triangle, const RayLine& line, const Rational& t) {
  const Rational over(t.denominator());
  return contains(triangle, over * line.o + Rational(t.numerator()) * line.d, over);
}

/// Where a line may enter: through each face of a box; through the face of a triangle, past an edge, at a vertex.
std::vector<Rational> tries(const Box& box, const RayLine& line) {
  std::vector<Rational> all;
  for (const Point& side : {point_of(box.min), point_of(box.max)})
    for (std::size_t i = 0; i < 3; ++i)
      if (!CGAL::is_zero(line.d[i])) all.push_back((side[i] - line.o[i]) / line.d[i]);
  return all;
}
std::vector<Rational> tries(const Triangle& triangle, const RayLine& line) {
  std::vector<Rational> all;
  const std::vector<Point> v = exact_core(triangle).vertices;
  const Point n = cross(v[1] - v[0], v[2] - v[0]);
  if (const Rational through = dot(n, line.d); !CGAL::is_zero(through)) all.push_back(dot(n, v[0] - line.o) / through);
  for (std::size_t k = 0; k < 3; ++k) {
    all.push_back(dot(v[k] - line.o, line.d) / dot(line.d, line.d));
    const Point edge = v[(k + 1) % 3] - v[k];
    const Point common = cross(line.d, edge);
    if (!is_zero(common)) all.push_back(dot(cross(v[k] - line.o, edge), common) / dot(common, common));
  }
  return all;
}
template <class Polytope>
requires kIsOneOf<Polytope, Box, Triangle> std::optional<LineEnd> enter(const Polytope& shape, const RayLine& line) {
  std::optional<LineEnd> first;
  for (const Rational& t : tries(shape, line))
    if (contains_at(shape, line, t) && (!first || t < first->middle)) first = LineEnd{t, kNone};
  return first;
}
template <class Polytope>
requires kIsOneOf<Polytope, Box, Triangle> Normals normals(const Polytope& shape, const RayLine& line,
                                                           const LineEnd& t) {
  return away_from(line.at(t.middle), exact_core(shape).vertices, std::same_as<Polytope, Box>);
}

bool contains(const Plane& plane, const Point& x) { return dot(point_of(plane.normal), x) <= Rational(plane.offset); }
std::optional<LineEnd> enter(const Plane& plane, const RayLine& line) {
  const Rational rise = dot(point_of(plane.normal), line.d);
  if (rise >= kNone) return std::nullopt;
  return LineEnd{(Rational(plane.offset) - dot(point_of(plane.normal), line.o)) / rise, kNone};
}
Normals normals(const Plane& plane, const RayLine& /*line*/, const LineEnd& /*t*/) {
  return along(point_of(plane.normal));
}
/// How far it is from the origin, in the largest component of its foot.
Rational largest(const Plane& plane) {
  return CGAL::abs(Rational(plane.offset)) * Rational(plane.normal.cwiseAbs().maxCoeff()) /
         dot(point_of(plane.normal), point_of(plane.normal));
}

template <class Target>
CastTruth truth_of(const CastAt<Target>& shapes) {
  const auto& [ray, shape] = shapes;
  const RayLine line{point_of(ray.origin), point_of(ray.direction)};
  const bool inside = contains(shape, line.o);
  const auto entry = inside ? LineEnd{kNone, kNone} : enter(shape, line);
  if (!inside && (!entry || entry->first().sign() == CGAL::NEGATIVE)) return {};
  if (entry->first().compare(Rational(ray.length)) == CGAL::LARGER) return {};
  std::optional<LineEnd> exit = enter(shape, line.reversed());
  if (exit) exit->middle = -exit->middle;
  Normals at = inside ? along(Rational(-1) * line.d) : normals(shape, line, *entry);
  const auto coordinate = [&](std::size_t i) { return moving(line.o[i], line.d[i], *entry); };
  CastHit hit{entry->first(),
              {coordinate(0), coordinate(1), coordinate(2)},
              std::move(at.normal),
              at.along,
              inside,
              at.either_side,
              std::move(at.against),
              std::max(Rational(ray.origin.cwiseAbs().maxCoeff()), largest(shape)),
              kNone};
  for (const Exact& x : hit.at) hit.point_scale = larger_of(hit.point_scale, magnitude(x));
  hit.value_scale = larger_of(hit.t, hit.point_scale.scaled(kOne / Rational(ray.direction.cwiseAbs().maxCoeff())));
  return {*entry, exit, std::move(hit)};
}

/// The square of the distance of a box from a segment that begins at t = 0: on each axis it grows from a side on, and
/// between those places it is a parabola, which three values tell.
Rational distance2(const Box& box, const RayLine& line, const Rational& length) {
  const auto square_at = [&](const Rational& t) {
    Rational sum(0);
    const Point x = line.at(t);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      sum += square(x[i] - std::clamp(x[i], Rational(box.min[axis]), Rational(box.max[axis])));
    }
    return sum;
  };
  std::vector<Rational> places{kNone, length};
  for (const Rational& t : tries(box, line))
    if (t > kNone && t < length) places.push_back(t);
  std::sort(places.begin(), places.end());
  Rational least = square_at(length);
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const Rational& low = places[i];
    const Rational width = places[i + 1] - low;
    const Rational f = square_at(low);
    const Rational g = square_at(low + width / Rational(2));
    const Rational h = square_at(places[i + 1]);
    least = std::min(least, f);
    const Rational bend = f - Rational(2) * g + h;
    if (CGAL::is_zero(bend)) continue;
    const Rational part = (Rational(3) * f - Rational(4) * g + h) / (Rational(4) * bend);
    least = std::min(least, square_at(low + width * std::clamp(part, kNone, kOne)));
  }
  return least;
}
/// How deep a segment comes into a box: the least of linear functions, which is greatest where two of them meet, or at
/// an end. In a flat box it is the depth in its plane, and the height of its ends over that.
Rational depth(const Box& box, const RayLine& line, const Rational& length) {
  struct Linear {
    Rational at_0;
    Rational slope;
    [[nodiscard]] Rational at(const Rational& t) const { return at_0 + slope * t; }
  };
  std::vector<Linear> depths;
  std::vector<Linear> heights;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    const Linear below{line.o[i] - Rational(box.min[axis]), line.d[i]};
    if (box.min[axis] == box.max[axis]) {
      heights.push_back(below);
      continue;
    }
    depths.push_back(below);
    depths.push_back({Rational(box.max[axis]) - line.o[i], -line.d[i]});
  }
  const auto least = [&](const Rational& t) {
    Rational all = depths.front().at(t);
    for (const Linear& f : depths) all = std::min(all, f.at(t));
    return all;
  };
  if (heights.size() > 1 || (heights.size() == 1 && CGAL::is_zero(heights[0].slope))) return kNone;
  if (heights.size() == 1) {
    const Rational ends = std::min(Rational(CGAL::abs(heights[0].at_0)), Rational(CGAL::abs(heights[0].at(length))));
    return std::min(ends, least(-heights[0].at_0 / heights[0].slope));
  }
  Rational deepest = std::max(least(kNone), least(length));
  for (const Linear& f : depths)
    for (const Linear& g : depths) {
      if (f.slope == g.slope) continue;
      const Rational t = (g.at_0 - f.at_0) / (f.slope - g.slope);
      if (t > kNone && t < length) deepest = std::max(deepest, least(t));
    }
  return deepest;
}

Exact root(const Rational& square) { return {kNone, kOne, square}; }
template <class Solid>
Exact to_surface(const Ray& ray, const Solid& shape) {
  return root(squared_distance(exact_core(ray), exact_core(shape))).plus(Rational(-shape.radius));
}
Exact to_change(const Ray& ray, const Ball& ball, bool /*is_hit*/) { return to_surface(ray, ball); }
Exact to_change(const Ray& ray, const Capsule& capsule, bool /*is_hit*/) { return to_surface(ray, capsule); }
Exact to_change(const Ray& ray, const Box& box, bool is_hit) {
  const RayLine line{point_of(ray.origin), point_of(ray.direction)};
  const Rational length(ray.length);
  return is_hit ? Exact(depth(box, line, length)) : root(distance2(box, line, length));
}
Exact to_change(const Ray& ray, const Triangle& triangle, bool /*is_hit*/) {
  return root(distance2_to_change(exact_core(ray), triangle));
}
Exact to_change(const Ray& ray, const Plane& plane, bool /*is_hit*/) {
  const Point n = point_of(plane.normal);
  const std::vector<Point> ends = exact_core(ray).vertices;
  const Rational lowest = std::min(dot(n, ends[0]), dot(n, ends[1])) - Rational(plane.offset);
  return {kNone, lowest / dot(n, n), dot(n, n)};
}

}  // namespace
}  // namespace casts

template <class Target>
Exact distance_to_change(const CastAt<Target>& shapes, bool is_hit) {
  return magnitude(casts::to_change(shapes.a, shapes.b, is_hit));
}
template <class Target>
CastTruth truth_of_cast(const CastAt<Target>& shapes) {
  return casts::truth_of(shapes);
}
template <class Target>
bool starts_inside(const CastAt<Target>& shapes) {
  return casts::contains(shapes.b, point_of(shapes.a.origin));
}

#define CONTACT_CAST(Cast, Target)                                \
  template Exact distance_to_change(const CastAt<Target>&, bool); \
  template CastTruth truth_of_cast(const CastAt<Target>&);        \
  template bool starts_inside(const CastAt<Target>&);
CONTACT_CASTS(CONTACT_CAST)
#undef CONTACT_CAST

}  // namespace contact::oracle
