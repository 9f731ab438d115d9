// The nearest points of two segments, exactly: the best of all their features. A nearest pair is two ends, an end and
// the foot of it on the other line, or the feet of both lines on each other. All of these that lie on the segments are
// tried, and nobody asks which face each other.
#include "oracle/truth/segments.hpp"

#include <CGAL/FPU.h>
#include <CGAL/Interval_nt.h>

#include <algorithm>

namespace contact::oracle {
namespace {

bool is_parameter(const Rational& t) { return t >= Rational(0) && t <= Rational(1); }

struct NearestPair {
  Point p;
  Point q;
  [[nodiscard]] Rational distance2() const { return dot(q - p, q - p); }
};

std::vector<NearestPair> candidates(const Segment& first, const Segment& second) {
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

// In intervals of doubles, which are right while the processor rounds upward.
using Interval = CGAL::Interval_nt<false>;
using RoundUpward = CGAL::Protect_FPU_rounding<true>;
using Intervals = std::array<Interval, 3>;

Intervals difference(const Vector3& b, const Vector3& a) {
  return {Interval(b[0]) - a[0], Interval(b[1]) - a[1], Interval(b[2]) - a[2]};
}
Intervals cross(const Intervals& x, const Intervals& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}
bool is_surely_not_zero(const Interval& x) { return x.inf() > 0 || x.sup() < 0; }
bool is_surely_not_zero(const Intervals& v) {
  return std::any_of(v.begin(), v.end(), [](const Interval& x) { return is_surely_not_zero(x); });
}

}  // namespace

Segment segment_of(const Ball& ball) { return {point_of(ball.center), {}, ball.radius}; }
Segment segment_of(const Capsule& capsule) {
  const Point start = point_of(capsule.start);
  return {start, point_of(capsule.end) - start, capsule.radius};
}
Segment segment_of(const Ray& ray) { return {point_of(ray.origin), Rational(ray.length) * point_of(ray.direction), 0}; }

std::optional<Point> foot(const Point& c, const Segment& segment) {
  if (is_zero(segment.along)) return std::nullopt;
  const Rational t = dot(c - segment.from, segment.along) / dot(segment.along, segment.along);
  return is_parameter(t) ? std::optional(segment.from + t * segment.along) : std::nullopt;
}

Point agreed_normal(const Point& across, const Point& along) {
  const Rational none(0);
  if (!is_zero(across)) {
    const Rational& first = CGAL::is_zero(across[0]) ? CGAL::is_zero(across[1]) ? across[2] : across[1] : across[0];
    return Rational(first < none ? -1 : 1) * across;
  }
  const Point x{Rational(1), none, none};
  const Point y{none, Rational(1), none};
  if (is_zero(along)) return x;
  // What is left of an axis without its part along the direction.
  const Point left = dot(along, along) * x - dot(along, x) * along;
  return is_zero(left) ? y : left;
}

ExactTruth truth_of_segments(const Segment& first, const Segment& second, Distances distances) {
  const std::vector<NearestPair> all = candidates(first, second);
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

  Rational scale(0);
  for (const Segment* segment : {&first, &second})
    for (const Point& end : segment->ends())
      for (const Rational& x : end) scale = std::max(scale, Rational(CGAL::abs(x)));
  Cores cores{{p, p + delta}, {Rational(first.radius), Rational(second.radius)}, {scale, scale}};
  if (*low != *high) cores.spread = half * (*high - *low);
  if (CGAL::is_zero(least)) {
    const Point& u = first.along;
    const Point& v = second.along;
    cores.meeting = Meeting{Rational(0), {{agreed_normal(cross(u, v), is_zero(u) ? v : u), p}}, {}};
    for (const Point& x : first.ends())
      for (const Point& y : second.ends()) cores.meeting->apart.push_back(y - x);
  }
  return {DistanceTruth(std::move(cores), distances)};
}

Witness witness_of(const ExactTruth& truth) {
  const auto& numbers = std::get<DistanceTruth>(truth.numbers);
  Witness w;
  w.distance2 = exact_string(numbers.distance2());
  w.reach = exact_string(numbers.reach());
  w.below = numbers.below();
  return w;
}

bool boxes_meet(std::initializer_list<Vector3> first, std::initializer_list<Vector3> second) {
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const auto less = [axis](const Vector3& x, const Vector3& y) { return x[axis] < y[axis]; };
    const auto [low1, high1] = std::minmax(first, less);
    const auto [low2, high2] = std::minmax(second, less);
    if (less(high1, low2) || less(high2, low1)) return false;
  }
  return true;
}

bool surely_off_plane(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  const RoundUpward mode;
  const Intervals w = difference(b, a);
  const Intervals area = cross(difference(c, a), difference(d, a));
  return is_surely_not_zero(w[0] * area[0] + w[1] * area[1] + w[2] * area[2]);
}
bool surely_off_line(const Vector3& a, const Vector3& b, const Vector3& c) {
  const RoundUpward mode;
  return is_surely_not_zero(cross(difference(b, a), difference(c, a)));
}
bool surely_beside_line(const Vector3& a, const Vector3& b, const Vector3& direction) {
  const RoundUpward mode;
  return is_surely_not_zero(cross(difference(b, a), {direction[0], direction[1], direction[2]}));
}

Meet segments_meet(const Segment& first, const Segment& second) {
  const ExactTruth truth = truth_of_segments(first, second, {0, 0});
  return std::get<DistanceTruth>(truth.numbers).degenerate() ? Meet::touching : Meet::no;
}

}  // namespace contact::oracle
