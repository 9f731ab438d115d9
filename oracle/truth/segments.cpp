// The nearest points of two segments, exactly: the best of all their features. A nearest pair is two ends, an end and
// the foot of it on the other line, or the feet of both lines on each other. All of these that lie on the segments are
// tried, and nobody asks which face each other.
#include "oracle/truth/segments.hpp"

#include <algorithm>
#include <cstddef>

#include "oracle/truth/double_double_segments.hpp"

namespace contact::oracle {
namespace {

Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point operator+(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Point operator*(const Rational& k, const Point& a) { return {k * a[0], k * a[1], k * a[2]}; }
Rational dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
bool is_zero(const Point& a) { return CGAL::is_zero(dot(a, a)); }
bool is_parameter(const Rational& t) { return t >= Rational(0) && t <= Rational(1); }

struct Line {
  Point from;
  Point along;
  [[nodiscard]] std::array<Point, 2> ends() const { return {from, from + along}; }
};

struct NearestPair {
  Point p;
  Point q;
  [[nodiscard]] Rational distance2() const { return dot(q - p, q - p); }
};

/// The foot of a point on a line, where it lies on the segment.
std::optional<Point> foot(const Point& c, const Line& line) {
  if (is_zero(line.along)) return std::nullopt;
  const Rational t = dot(c - line.from, line.along) / dot(line.along, line.along);
  return is_parameter(t) ? std::optional(line.from + t * line.along) : std::nullopt;
}

std::vector<NearestPair> candidates(const Line& first, const Line& second) {
  std::vector<NearestPair> all;
  for (const Point& p : first.ends()) {
    for (const Point& q : second.ends()) all.push_back({p, q});
    if (const auto q = foot(p, second)) all.push_back({p, *q});
  }
  for (const Point& q : second.ends())
    if (const auto p = foot(q, first)) all.push_back({*p, q});
  // Lines that are not parallel: w + t v - s u is a multiple of n = u x v, so s = (w x v).n / n.n, t = (w x u).n / n.n.
  const Point n = cross(first.along, second.along);
  if (!is_zero(n)) {
    const Point w = second.from - first.from;
    const Rational s = dot(cross(w, second.along), n) / dot(n, n);
    const Rational t = dot(cross(w, first.along), n) / dot(n, n);
    if (is_parameter(s) && is_parameter(t))
      all.push_back({first.from + s * first.along, second.from + t * second.along});
  }
  return all;
}

/// The normal by agreement of segments that meet.
Point agreed_normal(const Point& u, const Point& v) {
  const Rational none(0);
  if (const Point n = cross(u, v); !is_zero(n)) {
    const Rational& first = CGAL::is_zero(n[0]) ? CGAL::is_zero(n[1]) ? n[2] : n[1] : n[0];
    return Rational(first < none ? -1 : 1) * n;
  }
  const Point& along = is_zero(u) ? v : u;
  const Point x{Rational(1), none, none};
  const Point y{none, Rational(1), none};
  if (is_zero(along)) return x;
  // What is left of an axis without its part along the direction.
  const Point across = dot(along, along) * x - dot(along, x) * along;
  return is_zero(across) ? y : across;
}

}  // namespace

ExactTruth truth_of_segments(const Segment& first, const Segment& second, Distances distances) {
  const Line a{point_of(first.start), point_of(first.end) - point_of(first.start)};
  const Line b{point_of(second.start), point_of(second.end) - point_of(second.start)};
  const std::vector<NearestPair> all = candidates(a, b);
  Rational least = all.front().distance2();
  for (const NearestPair& pair : all) least = std::min(least, pair.distance2());
  // The nearest points of the first core are a point or a segment, whose ends are among the candidates.
  std::vector<Point> nearest;
  Point delta;
  for (const NearestPair& pair : all)
    if (pair.distance2() == least) {
      nearest.push_back(pair.p);
      delta = pair.q - pair.p;
    }
  const auto [low, high] = std::minmax_element(nearest.begin(), nearest.end());
  const Rational half(1, 2);
  const Point p = half * (*low + *high);

  const auto farthest = [](const Vector3& v) { return v.cwiseAbs().maxCoeff(); };
  const Rational scale(
      std::max({farthest(first.start), farthest(first.end), farthest(second.start), farthest(second.end)}));
  Cores cores{{p, p + delta}, {Rational(first.radius), Rational(second.radius)}, {scale, scale}};
  if (*low != *high) cores.spread = half * (*high - *low);
  if (CGAL::is_zero(least)) {
    cores.meeting = Meeting{Rational(0), {{agreed_normal(a.along, b.along), p}}, {}};
    for (const Point& x : a.ends())
      for (const Point& y : b.ends()) cores.meeting->apart.push_back(y - x);
  }
  return {DistanceTruth(std::move(cores), distances)};
}

Witness witness_of_segments(const Segment& first, const Segment& second, Distances distances) {
  const ExactTruth truth = truth_of_segments(first, second, distances);
  const auto& numbers = std::get<DistanceTruth>(truth.numbers);
  Witness w;
  w.distance2 = exact_string(numbers.distance2());
  w.reach = exact_string(numbers.reach());
  return w;
}

Meet segments_meet(const Segment& first, const Segment& second) {
  const auto low = [](const Segment& s) { return s.start.cwiseMin(s.end).eval(); };
  const auto high = [](const Segment& s) { return s.start.cwiseMax(s.end).eval(); };
  const bool boxes_meet =
      (low(first).array() <= high(second).array()).all() && (low(second).array() <= high(first).array()).all();
  if (!boxes_meet || surely_apart({first.start, first.end}, {second.start, second.end})) return Meet::no;
  const Distances none{0, 0};
  const ExactTruth truth = truth_of_segments(first, second, none);
  return std::get<DistanceTruth>(truth.numbers).degenerate() ? Meet::touching : Meet::no;
}

}  // namespace contact::oracle
