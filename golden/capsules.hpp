// The families of questions about capsules, about a sphere and a capsule, and about a ray and a sphere: a sphere is a
// capsule without length, a ray one without radius.
#pragma once

#include <type_traits>

#include "golden/making.hpp"
#include "golden/plain_segments.hpp"

namespace contact::golden {

/// A question in the file's scalar; widening it to double is exact. Only + - * / sqrt, scaling by powers of two and
/// exact decisions make its numbers, so every platform makes the same. Of a pair with a sphere `a` is that sphere, also
/// where the question has it second.
template <class Real>
struct TwoSegments {
  Segment<Real> a;
  Segment<Real> b;
  Real alarm{};
  Real contact{};
  /// How often a ray goes along its direction; 0 where that is as near to a unit vector as it may be.
  Real times{1};

  [[nodiscard]] Query query(Pair pair) const {
    const auto capsule = [](const Segment<Real>& s) {
      return Capsule{widened(s.start), widened(s.end), static_cast<double>(s.radius)};
    };
    Query made{pair, Capsules{capsule(a), capsule(b)}, {static_cast<double>(alarm), static_cast<double>(contact)}};
    if (pair == Pair::sphere_capsule)
      made.shapes = BallAndCapsule{{widened(a.start), static_cast<double>(a.radius)}, capsule(b)};
    if (pair == Pair::ray_sphere)
      made.shapes = RayAndBall{ray(), {widened(a.start), static_cast<double>(a.radius + b.radius)}};
    return made;
  }
  [[nodiscard]] Ray ray() const {
    Triple<Real> u = b.direction();
    for (std::size_t i = 0; i < 3; ++i)
      if (!std::isfinite(u[i])) u[i] = b.end[i];
    if (u == Triple<Real>{}) return {widened(b.start), {1, 2, -2}, 0};
    Real length = times == 0 ? std::sqrt(dot(u, u)) : times;
    const auto divided = [&] { return Triple<Real>{u[0] / length, u[1] / length, u[2] / length}; };
    if (!(length > 0 && std::isfinite(length)) || divided() == Triple<Real>{}) length = 1;
    return {widened(b.start), widened(divided()), static_cast<double>(length)};
  }
  [[nodiscard]] std::array<Triple<Real>*, 4> ends() { return {&a.start, &a.end, &b.start, &b.end}; }
  /// Between the segments, in plain arithmetic.
  [[nodiscard]] Real distance() const {
    const NearestPoints<Real> nearest = nearest_points(a, b);
    const Triple<Real> delta = moved(nearest.q, Real{-1}, nearest.p);
    return std::sqrt(dot(delta, delta));
  }
  void scale(int exponent) {
    for (Triple<Real>* v : ends())
      for (Real& x : *v) x = std::ldexp(x, exponent);
    for (Real* x : {&a.radius, &b.radius, &alarm, &contact}) *x = std::ldexp(*x, exponent);
  }
};

/// Whether a sphere is one of the two shapes.
template <Pair kPair>
inline constexpr bool kHasSphere = kPair != Pair::capsule_capsule;

/// Whether one of the two shapes alone has a radius, or neither has.
constexpr bool has_one_radius(Pair pair) {
  return of_shapes(pair, []<class A, class B>() { return !(kHasRadius<A> && kHasRadius<B>); });
}

/// Of a pair with one radius it takes both.
template <Pair kPair, class Shapes>
void settle_radii(Shapes& s) {
  if (!has_one_radius(kPair)) return;
  s.a.radius += s.b.radius;
  s.b.radius = 0;
}

/// Which part of a segment is nearest to the other one.
enum class Feature { start, end, side };

/// The features of both take turns; a sphere has but one.
template <Pair kPair>
std::array<Feature, 2> turn_of_features(Random& random) {
  return {kHasSphere<kPair> ? Feature::start : static_cast<Feature>(random.turn(3, 3)),
          static_cast<Feature>(random.turn(3))};
}

/// The segment from `back` to `ahead` of a point that is to be nearest: whole, or from the point on; turned round where
/// the point is to be the end.
template <class Real>
Segment<Real> segment_through(Feature feature, const Triple<Real>& back, const Triple<Real>& point,
                              const Triple<Real>& ahead) {
  if (feature == Feature::side) return {back, ahead, 0};
  return feature == Feature::start ? Segment<Real>{point, ahead, 0} : Segment<Real>{ahead, point, 0};
}

template <class Shapes>
void random_distances(Shapes& s, Random& random) {
  using Real = decltype(s.alarm);
  s.alarm = random.chance(2) ? random.uniform(Real{0}, Real{2}) : Real{0};
  s.contact = random.chance(2) ? random.uniform(Real{0}, Real{1}) : Real{0};
}

/// Of a ray: its whole way once, in steps that divide it exactly, or in unit vectors as engines have them.
template <class Real, Pair kPair>
void choose_steps(TwoSegments<Real>& s, Random& random, bool exactly) {
  if (kPair != Pair::ray_sphere) return;
  s.times = std::array<Real, 6>{1, 2, Real{0.125}, 3, 5, 7}[random.index(6)];
  const Triple<Real> u = s.b.direction();
  for (const Real x : u)
    if (std::fma(x / s.times, s.times, -x) != 0) s.times = 1;
  if (!exactly && random.chance(2)) s.times = 0;
}

/// Segments of ordinary size, anywhere, each with a feature beside the other one.
template <class Real, Pair kPair>
TwoSegments<Real> beside(Random& random) {
  const std::array<Feature, 2> features = turn_of_features<kPair>(random);
  const Triple<Real> p = triple<Real>(random, -10, 10);
  const Triple<Real> delta = triple<Real>(random, -4, 4);
  const auto segment = [&](Feature feature, const Triple<Real>& point, Real away) {
    Triple<Real> u = triple<Real>(random, -4, 4);
    if (feature == Feature::side) u = cross(u, delta);
    const Real along = dot(u, delta) * away < 0 ? Real{-1} : Real{1};
    const Real size = random.uniform(Real{0.125}, Real{1.5});
    const Real back = -random.uniform(Real{0.125}, Real{1.5});
    return segment_through(feature, moved(point, along * back, u), point, moved(point, along * size, u));
  };
  TwoSegments<Real> s;
  s.a = segment(features[0], p, Real{-1});
  s.b = segment(features[1], moved(p, Real{1}, delta), Real{1});
  if (kHasSphere<kPair>) s.a.end = s.a.start = p;
  choose_steps<Real, kPair>(s, random, false);
  return s;
}

/// Radii that add up to a part of a length, the first one of them above 0.
template <class Real, template <class> class Shapes>
void share_radii(Shapes<Real>& s, Random& random, std::type_identity_t<Real> total) {
  s.a.radius = total * random.uniform(Real{0.0625}, Real{0.9375});
  s.b.radius = length(total - s.a.radius);
}

/// Each feature beside each, as often too far away.
template <class Real, Pair kPair>
TwoSegments<Real> generic(Random& random) {
  TwoSegments<Real> s = beside<Real, kPair>(random);
  share_radii(s, random, random.uniform(Real{0.5}, Real{6}));
  random_distances(s, random);
  return s;
}

/// The rows of a matrix of integers, orthogonal and of one integer length (Euler-Rodrigues), in random order and signs.
struct Frame {
  std::array<Triple<std::int64_t>, 3> rows;
  std::int64_t length;

  [[nodiscard]] Triple<std::int64_t> at(const Triple<std::int64_t>& v) const {
    return {v[0] * rows[0][0] + v[1] * rows[1][0] + v[2] * rows[2][0],
            v[0] * rows[0][1] + v[1] * rows[1][1] + v[2] * rows[2][1],
            v[0] * rows[0][2] + v[1] * rows[1][2] + v[2] * rows[2][2]};
  }
};

inline Frame frame(Random& random, std::int64_t largest) {
  for (;;) {
    const auto k = random.between(-largest, largest);
    const auto x = random.between(-largest, largest);
    const auto y = random.between(-largest, largest);
    const auto z = random.between(-largest, largest);
    Frame made{{{{k * k + x * x - y * y - z * z, 2 * (x * y - k * z), 2 * (x * z + k * y)},
                 {2 * (x * y + k * z), k * k - x * x + y * y - z * z, 2 * (y * z - k * x)},
                 {2 * (x * z - k * y), 2 * (y * z + k * x), k * k - x * x - y * y + z * z}}},
               k * k + x * x + y * y + z * z};
    if (made.length == 0) continue;
    std::swap(made.rows[0], made.rows[random.index(3)]);
    for (Triple<std::int64_t>& row : made.rows)
      if (random.chance(2))
        for (std::int64_t& i : row) i = -i;
    return made;
  }
}

/// How segments lie to the shortest way between them, which is the third row of a frame: at right angles to it, their
/// ends leaning away or not; at right angles and parallel; or both in line with it.
enum class Lie { leaning, level, parallel, in_line };

/// Segments with ends on a grid, and exactly an integer apart; `meeting` makes it 0. Nearest points are on the grid
/// too, but half of those on a side are fractions that no scalar holds.
template <class Real>
struct OnFrame {
  TwoSegments<Real> shapes;
  Frame frame;
  std::int64_t distance;
};

template <class Real, Pair kPair>
OnFrame<Real> on_frame(Random& random, std::array<Feature, 2> features, Lie lie, bool meeting = false) {
  const bool wide = sizeof(Real) == 8;
  const bool large = random.chance(2);
  const std::int64_t offset = wide ? 1 << 24 : 1 << 10;
  const std::int64_t steps = large ? (wide ? 64 : 6) : 3;
  // Of the smallest frames many lie along the axes, so that directions have zeros.
  OnFrame<Real> made{{}, frame(random, large ? (wide ? 1 << 9 : 9) : random.between(1, 3)), 0};
  const std::int64_t height = meeting ? 0 : random.between<std::int64_t>(1, wide && large ? 1 << 8 : 24);
  made.distance = height * made.frame.length;
  std::array<Triple<std::int64_t>, 2> ways{};
  for (std::size_t i = 0; i < 2; ++i) {
    const std::int64_t away = i == 0 ? -1 : 1;
    Triple<std::int64_t>& way = ways[i];
    way = {random.between(-steps, steps), random.between(-steps, steps), 0};
    if (way[0] == 0 && way[1] == 0) way[0] = 1;
    if (lie == Lie::leaning && features[i] != Feature::side) way[2] = away * random.between<std::int64_t>(0, steps);
    if (lie == Lie::parallel && i == 1) way = random.chance(2) ? ways[0] : moved({}, std::int64_t{-1}, ways[0]);
    if (lie == Lie::in_line) way = {0, 0, away * random.between<std::int64_t>(1, steps)};
  }
  std::array<Triple<std::int64_t>, 2> points{Triple<std::int64_t>{}, made.frame.at({0, 0, height})};
  const auto sides = std::count(features.begin(), features.end(), Feature::side);
  if (sides == 2 && (lie == Lie::leaning || lie == Lie::level)) {
    // The second line moved in its plane: both cross less than a step from where they did.
    const Triple<std::int64_t> by = {random.between(-steps, steps), random.between(-steps, steps), 0};
    const std::int64_t across = std::abs(cross(ways[0], ways[1])[2]);
    if (std::abs(cross(by, ways[0])[2]) < across && std::abs(cross(by, ways[1])[2]) < across)
      points[1] = moved(points[1], std::int64_t{1}, made.frame.at(by));
  } else if (sides == 1 && lie == Lie::leaning && random.chance(2)) {
    // The other one's end is at the origin. The side goes along the first row, through (n first + height third) /
    // length where that is on the grid, so that its foot is height third / length.
    const std::size_t side = features[0] == Feature::side ? 0 : 1;
    const std::int64_t up = side == 0 ? -height : height;
    const std::int64_t length = made.frame.length;
    for (std::int64_t n = 1; n < std::min<std::int64_t>(length, 1000); ++n) {
      const Triple<std::int64_t> through = made.frame.at({n, 0, up});
      if (through[0] % length != 0 || through[1] % length != 0 || through[2] % length != 0) continue;
      points[side] = {through[0] / length, through[1] / length, through[2] / length};
      points[1 - side] = {};
      ways[side] = {random.between<std::int64_t>(1, steps), 0, 0};
      made.distance = height;
      break;
    }
  }
  const Triple<std::int64_t> origin = {random.between(-offset, offset), random.between(-offset, offset),
                                       random.between(-offset, offset)};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto at = [&](std::int64_t n) {
      const Triple<std::int64_t> point = moved(moved(origin, std::int64_t{1}, points[i]), n, made.frame.at(ways[i]));
      return Triple<Real>{static_cast<Real>(point[0]), static_cast<Real>(point[1]), static_cast<Real>(point[2])};
    };
    const std::int64_t back = random.between<std::int64_t>(1, wide ? 8 : 4);
    const std::int64_t ahead = random.between<std::int64_t>(1, wide ? 8 : 4);
    (i == 0 ? made.shapes.a : made.shapes.b) = segment_through(features[i], at(-back), at(0), at(ahead));
  }
  if (kHasSphere<kPair>) made.shapes.a.end = made.shapes.a.start;
  choose_steps<Real, kPair>(made.shapes, random, true);
  return made;
}

/// Radii whose sum is exactly an integer; with `alarmed` an alarm distance takes its part.
template <class Real, template <class> class Shapes>
void reach_exactly(Shapes<Real>& s, Random& random, std::int64_t distance, bool alarmed = false) {
  std::int64_t left = 16 * distance;
  if (alarmed) {
    const std::int64_t alarm = random.between<std::int64_t>(1, left - 2);
    s.alarm = sixteenths<Real>(alarm);
    s.contact = s.alarm / Real{4};
    left -= alarm;
  } else {
    s.contact = random.chance(2) ? sixteenths<Real>(random.between(0, 32)) : Real{0};
  }
  const std::int64_t first = random.between<std::int64_t>(1, left);
  s.a.radius = sixteenths<Real>(first);
  s.b.radius = sixteenths<Real>(left - first);
}

/// One in five a radius too short by one ulp.
template <class Real, Pair kPair>
TwoSegments<Real> touching(Random& random) {
  const auto make = [&] {
    auto [s, frame, distance] = on_frame<Real, kPair>(random, turn_of_features<kPair>(random), Lie::leaning);
    reach_exactly(s, random, distance);
    settle_radii<kPair>(s);
    return s;
  };
  TwoSegments<Real> s = random.turn(2) == 0 ? make() : searched<TwoSegments, Real>(random, kPair, make);
  s.scale(random.between(-40, 40));
  if (random.turn(5) == kMissing) s.a.radius = ulps_away(s.a.radius, -1);
  return s;
}

/// The first radius that is the least to hit, found by bisection.
template <class Real, template <class> class Shapes>
Real least_radius(Shapes<Real> s, Pair pair) {
  const auto hits = [&](Real radius) {
    s.a.radius = radius;
    return is_hit(s.query(pair));
  };
  Real high = length(s.distance() - s.b.radius - s.alarm);
  Real step = std::max(std::ldexp(s.distance(), -std::numeric_limits<Real>::digits), std::numeric_limits<Real>::min());
  for (; !hits(high); step *= 2) high += step;
  Real low = high;
  for (; low > 0 && hits(low); step *= 2) {
    high = low;
    low = length(low - step);
  }
  if (hits(low)) return low;
  for (;;) {
    const Real middle = low + (high - low) / 2;
    if (middle <= low || middle >= high) return high;
    (hits(middle) ? high : low) = middle;
  }
}

/// A few ulps from the reach, with an alarm distance or none.
template <class Real, template <class> class Shapes>
void reach_nearly(Shapes<Real>& s, Random& random, Pair pair, bool alarmed) {
  const Real d = s.distance();
  s.b.radius = d * random.uniform(Real{0.0625}, Real{0.5});
  if (has_one_radius(pair)) s.b.radius = 0;
  s.alarm = alarmed ? d * random.uniform(Real{0.125}, Real{0.375}) : Real{0};
  s.contact = random.chance(2) ? random.uniform(Real{0}, Real{1}) : Real{0};
  s.a.radius = length(ulps_away(least_radius(s, pair), random.between(-4, 3)));
}

/// Not all of them are searched: what plain arithmetic decides wrongly may be of one kind.
template <class Real, Pair kPair>
TwoSegments<Real> near_touching(Random& random) {
  const auto make = [&] {
    TwoSegments<Real> s = beside<Real, kPair>(random);
    reach_nearly(s, random, kPair, false);
    return s;
  };
  return random.turn(4) == 0 ? make() : searched<TwoSegments, Real>(random, kPair, make);
}

/// Axes along the coordinate axes, on a grid that holds their middles and half lengths too; up to 4 ulps from touching,
/// or an ordinary reach.
template <class Real, Pair kPair>
TwoSegments<Real> along_axes(Random& random) {
  const bool ordinary = random.turn(3) == 0;
  const auto make = [&] {
    constexpr Real kCoarse = 96;  // a sum with it, between 64 and 128, loses the last digits
    TwoSegments<Real> s;
    for (Segment<Real>* segment : {&s.a, &s.b}) {
      segment->start = triple<Real>(random, -10, 5);
      for (Real& x : segment->start) x = (x + kCoarse) - kCoarse;
      segment->end = segment->start;
      const std::size_t axis = random.index(3);
      segment->end[axis] += (random.uniform(Real{0.5}, Real{8}) + kCoarse) - kCoarse;
      if (random.chance(2)) std::swap(segment->start, segment->end);
    }
    if (kHasSphere<kPair>) s.a.end = s.a.start;
    if (ordinary) {
      share_radii(s, random, random.uniform(Real{0.5}, Real{1.5}) * s.distance());
      random_distances(s, random);
    } else {
      reach_nearly(s, random, kPair, random.chance(2));
    }
    return s;
  };
  return ordinary ? make() : searched<TwoSegments, Real>(random, kPair, make);
}

template <class Real, Pair kPair>
TwoSegments<Real> alarm_edge(Random& random) {
  if (random.turn(3, 5) == 0) {
    auto [s, frame, distance] = on_frame<Real, kPair>(random, turn_of_features<kPair>(random), Lie::leaning);
    reach_exactly(s, random, distance, true);
    settle_radii<kPair>(s);
    s.scale(random.between(-40, 40));
    return s;
  }
  return searched<TwoSegments, Real>(random, kPair, [&] {
    TwoSegments<Real> s = beside<Real, kPair>(random);
    reach_nearly(s, random, kPair, true);
    return s;
  });
}

/// Radii and distances that hit in two of three.
template <class Real, template <class> class Shapes>
void reach_or_not(Shapes<Real>& s, Random& random) {
  const bool hit = !random.chance(3);
  share_radii(s, random,
              s.distance() * (hit ? random.uniform(Real{1}, Real{2}) : random.uniform(Real{0.5}, Real{0.9375})));
  random_distances(s, random);
  if (!hit) s.alarm = 0;
}

/// Where one region ends and the next begins: an end at right angles to the way, one of its coordinates moved by an ulp
/// or not; on the grid of a frame, or along an axis.
template <class Real, Pair kPair>
TwoSegments<Real> region_edge(Random& random) {
  TwoSegments<Real> s;
  if (random.turn(2) == 0) {
    std::array<Feature, 2> features = turn_of_features<kPair>(random);
    if (features[0] == Feature::side || kHasSphere<kPair>) features[1] = static_cast<Feature>(random.index(2));
    s = on_frame<Real, kPair>(random, features, Lie::level).shapes;
    Triple<Real>& end = *s.ends()[random.index(4)];
    Real& x = end[random.index(3)];
    x = ulps_away(x, random.between(-1, 1));
  } else {
    s = beside<Real, kPair>(random);
    const std::size_t along = random.index(3);
    for (std::size_t i = 0; i < 3; ++i) {
      if (i == along) continue;
      s.b.end[i] = s.b.start[i];
      s.a.end[i] = s.a.start[i] + (s.a.start[i] - s.b.start[i]) * random.uniform(Real{0}, Real{1});
    }
    if (kPair == Pair::ray_sphere) s.times = 1;
    const auto step = random.between(-1, 1);  // drawn first: a call's arguments are in no order
    s.a.start[along] = ulps_away(random.chance(2) ? s.b.start[along] : s.b.end[along], step);
  }
  if (kHasSphere<kPair>) s.a.end = s.a.start;
  reach_or_not(s, random);
  return s;
}

/// Capsules that are spheres, and some whose ends are ulps apart, or subnormal numbers; a fifth of them on one point.
template <class Real, Pair kPair>
TwoSegments<Real> zero_length(Random& random) {
  const int which = kHasSphere<kPair> ? 1 : random.turn(3, 9);
  std::array<Feature, 2> features = turn_of_features<kPair>(random);
  if (which != 0) features[1] = Feature::start;
  if (which != 1) features[0] = Feature::start;
  const bool exact = random.turn(2) == 0;
  auto [s, frame, distance] = on_frame<Real, kPair>(random, features, Lie::leaning);
  if (!exact) s = beside<Real, kPair>(random);
  for (Segment<Real>* segment : {&s.a, &s.b}) {
    if (which == (segment == &s.a ? 1 : 0)) continue;
    segment->end = segment->start;
    if (exact || random.chance(3)) continue;
    if (random.chance(3)) segment->start = segment->end = {};
    for (Real& x : segment->end) x = ulps_away(x, random.between(-1, 1));
  }
  if (random.turn(5) == 0) {
    s.a = s.b;
    if (kHasSphere<kPair>) s.a.end = s.a.start;
    share_radii(s, random, random.uniform(Real{0.5}, Real{6}));
    random_distances(s, random);
  } else if (exact) {
    reach_exactly(s, random, distance);
    settle_radii<kPair>(s);
    if (random.chance(3)) s.a.radius = ulps_away(s.a.radius, -1);
  } else {
    reach_or_not(s, random);
  }
  return s;
}

/// Segments that meet: in their middles, at ends, end to end, in part. A fifth of them is moved off each other by an
/// ulp of the largest coordinate, without radii.
template <class Real, Pair kPair>
TwoSegments<Real> on_axis(Random& random) {
  const int kind = random.turn(4);
  const Lie lie = kind == 2 ? Lie::parallel : kind == 3 ? Lie::in_line : Lie::level;
  auto [s, frame, distance] = on_frame<Real, kPair>(random, turn_of_features<kPair>(random), lie, true);
  if (random.turn(5) == kMissing) {
    // Along the axis nearest to the frame's third row, at right angles to level segments; in line, to its first.
    const Triple<std::int64_t>& normal = frame.rows[lie == Lie::in_line ? 0 : 2];
    std::size_t axis = 0;
    for (const std::size_t i : {1U, 2U})
      if (std::abs(normal[i]) > std::abs(normal[axis])) axis = i;
    Real largest = 1;
    for (const Triple<Real>* v : s.ends())
      for (const Real x : *v) largest = std::max(largest, std::abs(x));
    const Real step = ulps_away(largest, 1) - largest;
    for (Triple<Real>* v : {&s.b.start, &s.b.end}) (*v)[axis] += step;
    return s;
  }
  if (random.turn(4, 5) != 0) share_radii(s, random, random.uniform(Real{0.5}, Real{6}));
  random_distances(s, random);
  if (random.chance(5))
    s.scale(random.between(std::numeric_limits<Real>::min_exponent + 8, std::numeric_limits<Real>::max_exponent - 36));
  return s;
}

/// Numbers half way between two neighbours, and beside that by the least there is: the value of an exact distance, or
/// the middle of an axis as nearest point, of a radius 0 or nearly so.
template <class Real, Pair kPair>
TwoSegments<Real> ties(Random& random) {
  constexpr int kDigits = std::numeric_limits<Real>::digits;
  const Real least = random.chance(2) ? std::numeric_limits<Real>::denorm_min() : Real{0};
  const bool missing = random.turn(5) == kMissing;
  if (random.turn(2) == 0) {
    auto [s, frame, distance] = on_frame<Real, kPair>(random, turn_of_features<kPair>(random), Lie::leaning);
    s.alarm = static_cast<Real>(distance);
    const Real half = std::ldexp(Real{1}, std::ilogb(s.alarm) - kDigits);
    s.b.radius = random.chance(3) ? ulps_away(half, -1) : half * static_cast<Real>(random.between(0, 3));
    s.contact = least;
    if (missing) s.alarm = ulps_away(s.alarm - s.b.radius, -1);
    return s;
  }
  // An axis along (1, 2, 0) or (1, 0, 0), the first coordinate so large that its middle does not fit.
  const bool beside_each_other = kPair == Pair::capsule_capsule && random.turn(2, 2) == 0;
  const Real large = std::ldexp(Real{1}, kDigits - 1) + static_cast<Real>(random.between(100, 10000));
  const auto odd = static_cast<Real>(2 * random.between(0, 40) + 1);
  const auto off = static_cast<Real>(2 * random.between(-20, 20) + 1);
  const auto height = static_cast<Real>(random.between(-20, 20));
  TwoSegments<Real> s;
  s.b.start = {large, 0, 0};
  s.b.end = {large + odd, beside_each_other ? 0 : 2 * odd, 0};
  if (beside_each_other) {
    s.a.start = {large + odd + static_cast<Real>(random.between(0, 9)), off, height};
    s.a.end = {large - static_cast<Real>(random.between(0, 9)), off, height};
  } else {
    s.a.start = {large + (odd + off) / 2, odd - off / 4, height};
    s.a.end = kHasSphere<kPair> ? s.a.start : moved(s.a.start, Real{4}, {off / 2, -off / 4, height});
  }
  s.a.radius =
      s.distance() * (missing ? random.uniform(Real{0.5}, Real{0.9375}) : random.uniform(Real{1.0625}, Real{2}));
  s.b.radius = least;
  if (kPair == Pair::capsule_capsule && random.chance(2)) std::swap(s.a, s.b);
  const std::array<std::size_t, 2> swapped{random.index(3), 1 + random.index(2)};
  const bool negative = random.chance(2);
  for (Triple<Real>* v : s.ends()) {
    if (negative) (*v)[0] = -(*v)[0];
    std::swap((*v)[0], (*v)[swapped[0]]);
    std::swap((*v)[1], (*v)[swapped[1]]);
  }
  s.contact = random.chance(2) ? random.uniform(Real{0}, Real{1}) : Real{0};
  return s;
}

/// Near touching or far from it, and then moved away from the origin, so that the distance is another one.
template <class Real, Pair kPair>
TwoSegments<Real> far_from_origin(Random& random) {
  const bool near = random.turn(3, 9) != 0;
  const auto make = [&] {
    TwoSegments<Real> s = beside<Real, kPair>(random);
    const Real offset = std::ldexp(Real{1}, random.between(10, sizeof(Real) == 8 ? 40 : 16));
    for (std::size_t i = 0; i < 3; ++i) {
      const Real by = random.with_sign(offset);
      for (Triple<Real>* v : s.ends()) (*v)[i] += by;
    }
    if (near)
      reach_nearly(s, random, kPair, random.chance(2));
    else
      reach_or_not(s, random);
    return s;
  };
  return near ? searched<TwoSegments, Real>(random, kPair, make) : make();
}

template <class Real, Pair kPair>
TwoSegments<Real> other_units(Random& random) {
  TwoSegments<Real> s = generic<Real, kPair>(random);
  s.scale(random.between(-24, 24));
  return s;
}

template <class Real, Pair kPair>
TwoSegments<Real> extreme_scale(Random& random) {
  TwoSegments<Real> s = generic<Real, kPair>(random);
  switch (random.turn(3, 9)) {
    case 0:  // squares that overflow
      s.scale(random.between(std::numeric_limits<Real>::max_exponent / 4, std::numeric_limits<Real>::max_exponent - 8));
      return s;
    case 1:  // squares that underflow, and subnormal numbers
      s.scale(random.between(std::numeric_limits<Real>::min_exponent - std::numeric_limits<Real>::digits,
                             std::numeric_limits<Real>::min_exponent / 4));
      return s;
    default: {  // magnitudes that have nothing to do with each other
      const auto any = [&] {
        return random.with_sign(random.magnitude<Real>(std::numeric_limits<Real>::min_exponent + 2,
                                                       std::numeric_limits<Real>::max_exponent - 4));
      };
      for (Triple<Real>* v : s.ends())
        for (Real& x : *v) x = any();
      if (kHasSphere<kPair>) s.a.end = s.a.start;
      s.a.radius = std::abs(any());
      s.b.radius = std::abs(any());
      s.alarm = random.chance(2) ? std::abs(any()) : Real{0};
      s.contact = random.chance(2) ? std::abs(any()) : Real{0};
      return s;
    }
  }
}

}  // namespace contact::golden
