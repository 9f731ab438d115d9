// Two segments in pairs of doubles: the feet of both lines where they lie within, else the nearest end and its foot.
// Where that is not certain, where the segments meet and where they are parallel, there is no answer.
#include "oracle/truth/double_double_segments.hpp"

#include <algorithm>
#include <cstddef>

namespace contact::oracle {
namespace {

/// from + t along.
DoubleDoubles at(const Vector3& from, const DoubleDouble& t, const DoubleDoubles& along) {
  DoubleDoubles point = exactly(from);
  for (std::size_t i = 0; i < 3; ++i) point[i] = point[i] + t * along[i];
  return point;
}

/// Where n / d, d > 0, lies against 0 and 1: -1 below, 0 between, 1 above; nothing where it may be one of both.
std::optional<int> place(const DoubleDouble& n, const DoubleDouble& d) {
  const auto low = n.sign();
  const auto high = (n - d).sign();
  if (!low || !high) return std::nullopt;
  return *low <= 0 ? -1 : *high >= 0 ? 1 : 0;
}

bool same(const DoubleDoubles& x, const DoubleDoubles& y) {
  return std::equal(x.begin(), x.end(), y.begin(), [](const DoubleDouble& a, const DoubleDouble& b) {
    return a.high == b.high && a.low == b.low && a.radius == b.radius;
  });
}

/// The feet of two lines on each other, where they are not parallel and both feet lie within; `within` says whether.
std::optional<DoubleDoubleNearest> feet(const Ends& first, const Ends& second, bool& within) {
  const DoubleDoubles u = difference(first[1], first[0]);
  const DoubleDoubles v = difference(second[1], second[0]);
  const DoubleDoubles w = difference(second[0], first[0]);
  const DoubleDoubles n = cross(u, v);
  const DoubleDouble n2 = dot(n, n);
  if (!(n2.high > 0 && n2.radius < n2.high * 0x1p-20)) return std::nullopt;
  const DoubleDouble s = dot(cross(w, v), n);
  const DoubleDouble t = dot(cross(w, u), n);
  const auto s_place = place(s, n2);
  const auto t_place = place(t, n2);
  if (!s_place || !t_place) return std::nullopt;
  within = *s_place == 0 && *t_place == 0;
  const DoubleDouble over = reciprocal(n2);
  const DoubleDouble along = dot(w, n) * over;  // delta is the part of w along n
  return DoubleDoubleNearest{
      at(first[0], s * over, u), at(second[0], t * over, v), {along * n[0], along * n[1], along * n[2]}};
}

std::optional<DoubleDoubleNearest> nearest_of(const Ends& first, const Ends& second) {
  const DoubleDoubleSegment a = segment_between(first[0], first[1]);
  const DoubleDoubleSegment b = segment_between(second[0], second[1]);
  if (a.is_point) return foot(first[0], b);
  bool within = false;
  if (!b.is_point) {
    auto between = feet(first, second, within);
    if (!between || within) return between;
  }
  std::optional<DoubleDoubleNearest> best;
  for (std::size_t i = 0; i < 4; ++i) {
    auto found = i < 2 ? foot(first[i], b) : foot(second[i - 2], a);
    if (!found) return std::nullopt;
    if (i >= 2) found = turned_round(*found);
    if (!keep_nearer(best, *found)) return std::nullopt;
  }
  return best;
}

}  // namespace

std::optional<DoubleDoubleNearest> foot(const Vector3& c, const DoubleDoubleSegment& segment) {
  const DoubleDoubles& u = segment.along;
  const DoubleDoubles w = difference(c, segment.from);
  const auto start = [&] { return DoubleDoubleNearest{exactly(c), exactly(segment.from), {-w[0], -w[1], -w[2]}}; };
  if (segment.is_point) return start();
  const DoubleDouble n = dot(w, u);
  const DoubleDouble d = dot(u, u);
  const auto where = place(n, d);
  if (!where) return std::nullopt;
  if (*where < 0) return start();
  DoubleDoubleNearest nearest{exactly(c), segment.end, {}};
  if (*where > 0) {
    for (std::size_t i = 0; i < 3; ++i) nearest.delta[i] = u[i] - w[i];
    return nearest;
  }
  const DoubleDouble t = n * reciprocal(d);
  nearest.q = at(segment.from, t, u);
  for (std::size_t i = 0; i < 3; ++i) nearest.delta[i] = t * u[i] - w[i];
  return nearest;
}

bool keep_nearer(std::optional<DoubleDoubleNearest>& best, const DoubleDoubleNearest& other) {
  // Of two ends that face each other each is the other's foot.
  if (best && same(other.p, best->p) && same(other.q, best->q)) return true;
  if (best) {
    const auto nearer = (dot(other.delta, other.delta) - dot(best->delta, best->delta)).sign();
    if (!nearer) return false;
    if (*nearer >= 0) return true;
  }
  best = other;
  return true;
}

std::optional<RoundedAnswer> case_of_apart(const std::optional<DoubleDoubleNearest>& nearest, double radius1,
                                           double radius2, Distances distances, Scalar scalar) {
  for (const double length : {radius1, radius2, distances.alarm, distances.contact})
    if (!in_range(length, 80)) return std::nullopt;
  if (!nearest || dot(nearest->delta, nearest->delta).sign() != 1) return std::nullopt;
  return case_of_nearest(*nearest, radius1, radius2, distances, scalar);
}

std::optional<RoundedAnswer> case_of_segments(const Ends& first, const Ends& second, double radius1, double radius2,
                                              Distances distances, Scalar scalar) {
  if (!in_short_range(first) || !in_short_range(second)) return std::nullopt;
  return case_of_apart(nearest_of(first, second), radius1, radius2, distances, scalar);
}

}  // namespace contact::oracle
