// Claims that are as good as a right answer. d is the distance of the cores, negative where one lies in the other.
#include "oracle/judge/near_optimal.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "oracle/judge/off.hpp"
#include "oracle/truth/cores.hpp"
#include "oracle/truth/crossings.hpp"
#include "oracle/truth/default_environment.hpp"

namespace contact::oracle {
namespace {

std::size_t place(int shape) { return static_cast<std::size_t>(shape); }
Rational squared(const Point& v) { return dot(v, v); }

// ---- cores ----

/// The square of the distance of a point from a core.
template <class Shape>
Rational squared_distance_from(const Shape& shape, const Point& x) {
  return squared_distance(exact_core({x}, features::kPoint), exact_core(shape));
}

Rational squared_distance_from(const Plane& plane, const Point& x) { return squared_height_over(plane, x); }

Rational squared_distance_from(const Convex& convex, const Point& x) {
  return std::visit([&](const auto& shape) { return squared_distance_from(shape, x); }, convex.shape);
}

template <class Shape>
std::vector<Point> vertices(const Shape& shape) {
  return exact_core(shape).vertices;
}
std::vector<Point> vertices(const Plane& /*plane*/) { return {}; }

/// The least and the largest n.x of a core.
struct Extent {
  Rational least;
  Rational most;
};
Extent extent(const std::vector<Point>& vertices, const Point& n) {
  Extent all{dot(n, vertices.front()), dot(n, vertices.front())};
  for (const Point& x : vertices) all = {std::min(all.least, dot(n, x)), std::max(all.most, dot(n, x))};
  return all;
}

std::pair<std::vector<Point>, std::vector<Point>> vertices_of_both(const Query& query) {
  return std::visit([](const auto& shapes) { return std::pair(vertices(shapes.a), vertices(shapes.b)); }, query.shapes);
}

}  // namespace

Rational squared_height_over(const Plane& plane, const Point& x) {
  const Point n = point_of(plane.normal);
  const Rational height = dot(n, x) - Rational(plane.offset);
  return height * height / squared(n);
}

Point of_length_one(const Point& n) {
  constexpr int kBits = 200;
  const Rational n2 = squared(n);
  return Exact(Rational(0), Rational(1) / n2, n2).enclosure(kBits).low * n;
}

NearOptimal::NearOptimal(const Query& query, const DistanceTruth& truth, const ClaimedContact& claim,
                         const std::optional<Tolerance>& tolerance, Scalar scalar)
    : query_(query),
      truth_(truth),
      claim_(claim),
      tolerance_(tolerance),
      scale_(larger_of(truth.point_scale(0), truth.point_scale(1))),
      noise_(scale_.scaled(Rational(8) * power_of_two(-format_of(scalar).precision))) {
  if (is_crossing(query.pair)) {
    const Point& N = truth.along();
    const Crossed of = crossed(query);
    const Point v0 = point_of(of.triangle.vertices[0]);
    is_flat_ = std::all_of(of.segment.vertices.begin(), of.segment.vertices.end(), [&](const Point& end) {
      const Rational height = dot(N, end - v0);
      return is_noise(height * height / squared(N));
    });
  }
  if (!truth.degenerate() || truth.coincident()) return;  // else a centre is in a box
  const Point& c = truth.cores().nearest[0];
  for (const WayOut& way : ways_out(c, exact_core(std::get<BallAndBox>(query.shapes).b)))
    faces_.push_back({way, dot(c - way.nearest, way.direction)});
  if (!claim.normal) return;
  const auto along = [&](const Face& face) { return dot(face.way.direction, *claim.normal); };
  Rational most = along(faces_.front());
  for (const Face& face : faces_) most = std::max(most, along(face));
  faces_.erase(std::remove_if(faces_.begin(), faces_.end(), [&](const Face& face) { return along(face) < most; }),
               faces_.end());
}

Off NearOptimal::length(const Exact& error, const Exact& scale) const { return length_off(error, scale, tolerance_); }
Off NearOptimal::root(const Rational& squared, const Exact& scale) const {
  return length({Rational(0), Rational(1), squared}, scale);
}

/// Whether a length is no more than what rounding makes.
bool NearOptimal::is_noise(const Rational& squared) const {
  return noise_.plus(Exact(Rational(0), Rational(-1), squared)).sign() != CGAL::NEGATIVE;
}

/// How far the tip of a vector of that direction and length must move to lie along another direction.
Off NearOptimal::turn(const Rational& length2, const Point& from, const Point& to) const {
  if (dot(from, to) <= Rational(0)) return root(length2, scale_);
  return root(length2 * squared(cross(from, to)) / (squared(from) * squared(to)), scale_);
}

/// What positions must move for a normal, other than 0, to be right: as far as it separates the cores less than the
/// best one does, and as far as it is turned.
Off NearOptimal::positions_turn(const Point& n) const {
  const Rational n2 = squared(n);
  if (is_crossing(query_.pair)) {
    // A triangle has no thickness along its normal, and turns over where a vertex comes to the opposite edge.
    const std::vector<Point> v = vertices(crossed(query_).triangle);
    const Point N = cross(v[1] - v[0], v[2] - v[0]);
    Rational longest(0);
    for (std::size_t i = 0; i < v.size(); ++i) longest = std::max(longest, squared(v[(i + 1) % v.size()] - v[i]));
    const Extent along = extent(v, n);
    Off off = length({Rational(0), (along.most - along.least) / n2, n2}, scale_);
    off.merge(turn(squared(N) / longest, truth_.along(), n));
    return off;
  }
  const auto [first, second] = vertices_of_both(query_);
  // max n.a - min n.b, whose least is -d
  const Exact reaches(Rational(0), (extent(first, n).most - extent(second, n).least) / n2, n2);
  const Exact distance = truth_.meets() ? truth_.core_distance() : Exact(Rational(0), Rational(1), truth_.distance2());
  Off off = length_off_sum(reaches, distance, scale_, tolerance_);
  if (truth_.overlaps()) {
    if (is_noise(truth_.meeting().depth2)) off.take_lesser(length(noise_, scale_));
    return off;
  }
  if (!truth_.degenerate()) off.merge(turn(truth_.distance2(), truth_.along(), n));
  if (faces_.empty() && is_noise(truth_.distance2())) off.take_lesser(length(noise_, scale_));
  if (faces_.empty()) return off;
  Off nearest = beyond_lengths(tolerance_);
  for (const Face& face : faces_) {
    Off to_face = length_off_sum(face.depth, truth_.core_distance(), scale_, tolerance_);
    to_face.merge(turn(face.depth * face.depth, face.way.direction, n));
    nearest.take_lesser(to_face);
  }
  off.merge(nearest);
  return off;
}

/// Where the core's point is that goes with a claimed point and a normal.
Point NearOptimal::core_point(int shape, const Point& unit) const {
  return *claim_.points[place(shape)] - (outward(shape, claim_.on[place(shape)]) * truth_.radius(shape)) * unit;
}
Rational NearOptimal::squared_distance(int shape, const Point& x) const {
  // Where such a segment crosses, rounding decides: all of it may be said to.
  if (is_flat_ && (shape == 0) == (query_.pair == Pair::triangle_line)) return Rational(0);
  return std::visit(
      [&](const auto& shapes) {
        return shape == 0 ? squared_distance_from(shapes.a, x) : squared_distance_from(shapes.b, x);
      },
      query_.shapes);
}
/// A claimed point lies on its shape, where the normal says.
Off NearOptimal::goes_with(int shape, const Point& unit) const {
  return root(squared_distance(shape, core_point(shape, unit)), truth_.point_scale(shape));
}

Off NearOptimal::normal() const {
  const DefaultEnvironment environment;
  const Point& n = *claim_.normal;
  if (has_plane(query_.pair)) return beyond_lengths(tolerance_);  // it is the plane's
  if (is_zero(n))
    return claim_.zero_where_cores_meet && faces_.empty() ? root(truth_.distance2(), scale_)
                                                          : beyond_lengths(tolerance_);
  Off off = positions_turn(n);
  for (const int shape : {0, 1})
    if (claim_.points[place(shape)] && !CGAL::is_zero(truth_.radius(shape)))
      off.merge(goes_with(shape, of_length_one(n)));
  if (claim_.midpoint && truth_.radius(0) != truth_.radius(1)) off.merge(middle_goes_with(of_length_one(n), delta()));
  return off;
}

/// From the first core's nearest point to the second's, or to the face that is left by.
Point NearOptimal::delta() const {
  if (truth_.overlaps()) return truth_.meeting().ways.front().nearest - truth_.meeting().ways.front().first;
  const auto& [p, q] = truth_.cores().nearest;
  return (faces_.empty() ? q : faces_.front().way.nearest) - p;
}

/// The same where cores overlap and are left along another normal.
Point NearOptimal::out_along(const Point& n) const {
  const auto [first, second] = vertices_of_both(query_);
  return ((extent(second, n).least - extent(first, n).most) / squared(n)) * n;
}

std::vector<NearOptimal::Reading> NearOptimal::readings() const {
  std::vector<Reading> all;
  if (!truth_.degenerate())
    all.push_back({is_flat_ ? length(noise_, scale_) : Off{}, of_length_one(truth_.along()), delta()});
  for (const Face& face : faces_)
    all.push_back({length_off_sum(face.depth, truth_.core_distance(), scale_, tolerance_), face.way.direction,
                   face.way.nearest - truth_.cores().nearest[0]});
  if (!claim_.normal || has_plane(query_.pair) || is_crossing(query_.pair)) return all;
  const Point& n = *claim_.normal;
  if (!is_zero(n))
    all.push_back({positions_turn(n), of_length_one(n), truth_.overlaps() ? out_along(n) : delta()});
  else if (claim_.zero_where_cores_meet && faces_.empty())
    all.push_back({root(truth_.distance2(), scale_), n, delta()});
  return all;
}

/// Where no normal is claimed and the cores nearly meet, any may be meant: a point lies on its own shape, and no
/// farther from the other core.
Off NearOptimal::beside_cores(int shape, const Point& x, const Rational& radius, const Exact& scale) const {
  if (claim_.normal || has_plane(query_.pair) || is_crossing(query_.pair) || !faces_.empty() || truth_.overlaps())
    return beyond_lengths(tolerance_);
  Off off = root(truth_.distance2(), scale_);
  off.merge(length({-radius, Rational(1), squared_distance(shape, x)}, scale));
  const Exact beyond(-radius, Rational(1), squared_distance(1 - shape, x));
  if (beyond.sign() == CGAL::POSITIVE) off.merge(length(beyond, scale));
  return off;
}

Off NearOptimal::point(int shape) const {
  const DefaultEnvironment environment;
  const int other = 1 - shape;
  const Exact scale = truth_.point_scale(shape);
  const Rational side(shape == 0 ? 1 : -1);
  const Rational radius = CGAL::abs(outward(shape, claim_.on[place(shape)])) * truth_.radius(shape);
  Off least = beside_cores(shape, *claim_.points[place(shape)], radius, scale);
  for (const Reading& reading : readings()) {
    Off off = reading.need;
    off.merge(goes_with(shape, reading.normal));
    const Point there = core_point(shape, reading.normal) + side * reading.delta;  // where the other core's point is
    if (claim_.points[place(other)]) {
      off.merge(goes_with(other, reading.normal));
      off.merge(root(squared(core_point(other, reading.normal) - there), scale_));
    } else {
      off.merge(root(squared_distance(other, there), scale));
    }
    least.take_lesser(off);
  }
  return least;
}

/// The middle of the two points of the cores goes with a normal and the way between them.
Off NearOptimal::middle_goes_with(const Point& unit, const Point& delta) const {
  const Rational half(1, 2);
  const Point middle = *claim_.midpoint - (half * (truth_.radius(0) - truth_.radius(1))) * unit;
  Off off = root(squared_distance(0, middle - half * delta), scale_);
  off.merge(root(squared_distance(1, middle + half * delta), scale_));
  return off;
}

Off NearOptimal::midpoint() const {
  const DefaultEnvironment environment;
  const Rational along = truth_.radius(0) - truth_.radius(1);
  const int larger = along < Rational(0) ? 1 : 0;
  Off least = beside_cores(larger, *claim_.midpoint, CGAL::abs(along) / Rational(2), scale_);
  for (const Reading& reading : readings()) {
    Off off = reading.need;
    off.merge(middle_goes_with(reading.normal, reading.delta));
    least.take_lesser(off);
  }
  return least;
}

}  // namespace contact::oracle
