// The families of questions about a sphere or a capsule over a plane: a sphere is a capsule without length.
#pragma once

#include "golden/capsules.hpp"

namespace contact::golden {

/// A question in the file's scalar, made as TwoSegments is. The second radius is a share of the first's.
template <class Real>
struct OverPlane {
  struct Radius {
    Real radius{};
  };
  Segment<Real> a{};
  Radius b{};
  Triple<Real> normal{0, 0, 1};
  Real offset{};
  Real alarm{};
  Real contact{};

  [[nodiscard]] Query query(Pair pair) const {
    const auto radius = static_cast<double>(a.radius + b.radius);
    const Plane plane{widened(normal), static_cast<double>(offset)};
    const Distances distances{static_cast<double>(alarm), static_cast<double>(contact)};
    if (pair == Pair::sphere_plane) return {pair, BallAndPlane{{widened(a.start), radius}, plane}, distances};
    return {pair, CapsuleAndPlane{{widened(a.start), widened(a.end), radius}, plane}, distances};
  }
  [[nodiscard]] std::array<Triple<Real>*, 2> ends() { return {&a.start, &a.end}; }
  /// The normal and the offset by the power of two that makes the normal's largest component be from 1 to 2.
  [[nodiscard]] std::pair<Triple<Real>, Real> ordinary_plane() const {
    const int exponent = -std::ilogb(std::max({std::abs(normal[0]), std::abs(normal[1]), std::abs(normal[2])}));
    Triple<Real> n = normal;
    for (Real& x : n) x = std::ldexp(x, exponent);
    return {n, std::ldexp(offset, exponent)};
  }
  /// Of the lower end over the plane, in plain arithmetic.
  [[nodiscard]] Real distance() const {
    const auto [n, o] = ordinary_plane();
    return (std::min(dot(n, a.start), dot(n, a.end)) - o) / std::sqrt(dot(n, n));
  }
  /// Puts the plane so far below the lower end, as near as its offset may be to that.
  void put_plane_below(Real height) {
    const int exponent = std::ilogb(std::max({std::abs(normal[0]), std::abs(normal[1]), std::abs(normal[2])}));
    const Triple<Real> n = ordinary_plane().first;
    offset = std::ldexp(std::min(dot(n, a.start), dot(n, a.end)) - height * std::sqrt(dot(n, n)), exponent);
  }
  /// Another unit of length.
  void scale(int exponent) {
    for (Triple<Real>* v : ends())
      for (Real& x : *v) x = std::ldexp(x, exponent);
    for (Real* x : {&a.radius, &b.radius, &offset, &alarm, &contact}) *x = std::ldexp(*x, exponent);
  }
  /// Another length of the normal; the plane stays.
  void lengthen_normal(int exponent) {
    for (Real& x : normal) x = std::ldexp(x, exponent);
    offset = std::ldexp(offset, exponent);
  }
};

template <Pair kPair>
inline constexpr bool kIsSphere = kPair == Pair::sphere_plane;

/// Which point of a segment is lowest: an end, each in turn, or with the last of three turns all of them.
template <Pair kPair>
Feature turn_of_lowest(Random& random, int turns) {
  return kIsSphere<kPair> ? Feature::start : static_cast<Feature>(random.turn(turns));
}

/// A unit vector as near as plain arithmetic makes it, a vector of any length, and an axis: a floor, or a wall.
template <class Real>
Triple<Real> any_normal(Random& random) {
  Triple<Real> n = triple<Real>(random, -4, 4);
  const std::size_t kind = random.index(3);
  if (kind == 0) {
    const Real length = std::sqrt(dot(n, n));
    for (Real& x : n) x /= length;
  } else if (kind == 1) {
    n = {};
    n[random.index(3)] = random.with_sign(random.chance(2) ? Real{1} : random.uniform(Real{0.125}, Real{8}));
  }
  return n == Triple<Real>{} ? Triple<Real>{1, 2, -2} : n;
}

/// A segment of ordinary size, anywhere, its start or its end lower than the other.
template <class Real, Pair kPair>
OverPlane<Real> over_plane(Random& random) {
  OverPlane<Real> s;
  s.normal = any_normal<Real>(random);
  const Triple<Real> p = triple<Real>(random, -10, 10);
  const Triple<Real> u = triple<Real>(random, -4, 4);
  const Triple<Real> other = moved(p, dot(u, s.normal) < 0 ? Real{-1} : Real{1}, u);
  s.a = turn_of_lowest<kPair>(random, 2) == Feature::start ? Segment<Real>{p, other, 0} : Segment<Real>{other, p, 0};
  if (kIsSphere<kPair>) s.a.end = s.a.start;
  s.put_plane_below(random.uniform(Real{0.5}, Real{6}));
  return s;
}

template <class Real, Pair kPair>
OverPlane<Real> generic_over_plane(Random& random) {
  OverPlane<Real> s = over_plane<Real, kPair>(random);
  s.put_plane_below(random.uniform(Real{-2}, Real{10}));
  s.a.radius = random.uniform(Real{0.5}, Real{6});
  random_distances(s, random);
  return s;
}

/// A segment on a grid and exactly an integer over a plane, whose normal is a row of a frame, some times. The foot is
/// on the grid too where the height is a multiple of the row's length, and else a fraction that no scalar holds.
template <class Real>
struct OverPlaneOnFrame {
  OverPlane<Real> shapes;
  std::int64_t height;
};

template <class Real, Pair kPair>
OverPlaneOnFrame<Real> over_plane_on_frame(Random& random, Feature lowest, bool meeting = false) {
  const bool wide = sizeof(Real) == 8;
  const bool large = random.chance(2);
  const std::int64_t offset = wide ? 1 << 20 : 1 << 8;
  const std::int64_t steps = large ? (wide ? 64 : 6) : 3;
  const Frame rows = frame(random, large ? (wide ? 1 << 12 : 16) : random.between(1, 3));
  const std::int64_t times = random.between<std::int64_t>(1, wide ? 8 : 2);
  OverPlaneOnFrame<Real> made{{}, meeting ? 0 : random.between<std::int64_t>(1, wide && large ? 1 << 12 : 24)};
  if (!meeting && !large && random.chance(3)) made.height = rows.length;
  const Triple<std::int64_t> p = {random.between(-offset, offset), random.between(-offset, offset),
                                  random.between(-offset, offset)};
  Triple<std::int64_t> way = {random.between(-steps, steps), random.between(-steps, steps),
                              lowest == Feature::side ? 0 : random.between<std::int64_t>(1, steps)};
  if (way[0] == 0 && way[1] == 0) way[0] = 1;
  const Triple<std::int64_t> normal = moved({}, times, rows.rows[2]);
  const auto placed = [](const Triple<std::int64_t>& v) {
    return Triple<Real>{static_cast<Real>(v[0]), static_cast<Real>(v[1]), static_cast<Real>(v[2])};
  };
  made.shapes.a = {placed(p), placed(moved(p, std::int64_t{1}, rows.at(way))), 0};
  if (lowest == Feature::end) std::swap(made.shapes.a.start, made.shapes.a.end);
  if (kIsSphere<kPair>) made.shapes.a.end = made.shapes.a.start;
  made.shapes.normal = placed(normal);
  made.shapes.offset = static_cast<Real>(dot(normal, p) - made.height * times * rows.length);
  return made;
}

/// One in five a radius too short by one ulp.
template <class Real, Pair kPair>
OverPlane<Real> touching_plane(Random& random) {
  const auto make = [&] {
    auto [s, height] = over_plane_on_frame<Real, kPair>(random, turn_of_lowest<kPair>(random, 3));
    reach_exactly(s, random, height);
    settle_radii<kPair>(s);
    return s;
  };
  OverPlane<Real> s = random.turn(2) == 0 ? make() : searched<OverPlane, Real>(random, kPair, make);
  s.scale(random.between(-20, 20));
  s.lengthen_normal(random.between(-20, 20));
  if (random.turn(5) == kMissing) s.a.radius = ulps_away(s.a.radius, -1);
  return s;
}

template <class Real, Pair kPair>
OverPlane<Real> near_touching_plane(Random& random) {
  const auto make = [&] {
    OverPlane<Real> s = over_plane<Real, kPair>(random);
    reach_nearly(s, random, kPair, false);
    return s;
  };
  return random.turn(4) == 0 ? make() : searched<OverPlane, Real>(random, kPair, make);
}

template <class Real, Pair kPair>
OverPlane<Real> alarm_edge_of_plane(Random& random) {
  if (random.turn(3, 7) == 0) {
    auto [s, height] = over_plane_on_frame<Real, kPair>(random, turn_of_lowest<kPair>(random, 3));
    reach_exactly(s, random, height, true);
    settle_radii<kPair>(s);
    s.scale(random.between(-20, 20));
    return s;
  }
  return searched<OverPlane, Real>(random, kPair, [&] {
    OverPlane<Real> s = over_plane<Real, kPair>(random);
    reach_nearly(s, random, kPair, true);
    return s;
  });
}

/// On the plane, and below it by anything up to more than all lengths. A fifth of them over it by an ulp of its offset,
/// without a radius.
template <class Real, Pair kPair>
OverPlane<Real> below_plane(Random& random) {
  const bool missing = random.turn(5) == kMissing;
  OverPlane<Real> s;
  if (missing || random.turn(2) == 0) {
    s = over_plane_on_frame<Real, kPair>(random, turn_of_lowest<kPair>(random, 3), true).shapes;
    if (missing) {
      s.offset = ulps_away(s.offset, -1);
      return s;
    }
  } else {
    s = over_plane<Real, kPair>(random);
    s.put_plane_below(-random.magnitude<Real>(-10, 6));
  }
  if (random.turn(4, 5) != 0) s.a.radius = random.uniform(Real{0.5}, Real{6});
  random_distances(s, random);
  return s;
}

/// Normals that are not of length 1, most of them so long or so short that the square of their length leaves the range.
template <class Real, Pair kPair>
OverPlane<Real> length_of_normal(Random& random) {
  using Limits = std::numeric_limits<Real>;
  OverPlane<Real> s = over_plane<Real, kPair>(random);
  int exponent = random.between(-3, 3);
  const int kind = random.turn(4);
  if (kind == 0) exponent = random.between(Limits::max_exponent / 2 + 2, Limits::max_exponent - 10);
  if (kind == 1) exponent = random.between(Limits::min_exponent + 4, Limits::min_exponent / 2 - 4);
  if (kind == 2) exponent = Limits::min_exponent - random.between(4, 12);  // subnormal
  for (Real& x : s.normal) x = std::ldexp(x, exponent);
  if (s.normal == Triple<Real>{}) s.normal[0] = Limits::denorm_min();
  s.put_plane_below(random.uniform(Real{0.5}, Real{6}));
  // Of a subnormal offset the height may be any.
  if (!(s.distance() > 0)) s.put_plane_below(random.uniform(Real{64}, Real{128}));
  if (s.distance() > 0 && random.turn(3, 4) == 0)
    reach_nearly(s, random, kPair, random.chance(2));
  else
    reach_or_not(s, random);
  settle_radii<kPair>(s);
  return s;
}

/// Segments along the plane, exactly and in whichever direction, an ulp off that, and off by what a cross product is
/// rounded by.
template <class Real, Pair kPair>
OverPlane<Real> along_plane(Random& random) {
  const int kind = random.turn(4);
  std::int64_t height = 0;
  OverPlane<Real> s;
  if (kind < 2) {
    const auto made = over_plane_on_frame<Real, kPair>(random, Feature::side);
    s = made.shapes;
    height = made.height;
    if (kind == 1) {
      Real& x = (*s.ends()[random.index(2)])[random.index(3)];
      x = ulps_away(x, random.chance(2) ? 1 : -1);
    }
  } else {
    s = over_plane<Real, kPair>(random);
    const std::size_t axis = random.index(3);
    if (kind == 2) {  // a floor or a wall, and ends that have one coordinate in common
      s.normal = {};
      s.normal[axis] = random.with_sign(random.chance(2) ? Real{1} : random.uniform(Real{0.125}, Real{8}));
      s.a.end[axis] = s.a.start[axis];
    } else {
      s.normal = triple<Real>(random, -4, 4);
      s.a.end = moved(s.a.start, Real{1}, cross(s.normal, triple<Real>(random, -1, 1)));
    }
    s.put_plane_below(random.uniform(Real{0.5}, Real{6}));
  }
  if (kind == 0 && random.turn(2, 4) == 0) {
    reach_exactly(s, random, height);
    settle_radii<kPair>(s);
    if (random.chance(5)) s.a.radius = ulps_away(s.a.radius, -1);
  } else {
    reach_or_not(s, random);
    settle_radii<kPair>(s);
  }
  return s;
}

/// Capsules that are spheres, and some whose ends are ulps apart, or subnormal numbers.
template <class Real, Pair kPair>
OverPlane<Real> no_length_over_plane(Random& random) {
  OverPlane<Real> s = over_plane<Real, kPair>(random);
  if (random.turn(2) == 0) {
    const auto made = over_plane_on_frame<Real, kPair>(random, Feature::start);
    s = made.shapes;
    s.a.end = s.a.start;
    reach_exactly(s, random, made.height);
    settle_radii<kPair>(s);
    if (random.chance(3)) s.a.radius = ulps_away(s.a.radius, -1);
    return s;
  }
  s.a.end = s.a.start;
  if (random.chance(3)) {
    if (random.chance(2)) s.a.start = s.a.end = {};
    for (Real& x : s.a.end) x = ulps_away(x, random.between(-1, 1));
  }
  s.put_plane_below(random.uniform(Real{0.5}, Real{6}));
  reach_or_not(s, random);
  settle_radii<kPair>(s);
  return s;
}

/// Numbers half way between two neighbours, and beside that by the least there is: the value of an exact distance, a
/// surface point along an axis, the middle of a capsule along the plane.
template <class Real, Pair kPair>
OverPlane<Real> ties_over_plane(Random& random) {
  constexpr int kDigits = std::numeric_limits<Real>::digits;
  const bool missing = random.turn(5) == kMissing;
  if (random.turn(2) == 0) {
    auto [s, height] = over_plane_on_frame<Real, kPair>(random, turn_of_lowest<kPair>(random, 3));
    s.alarm = static_cast<Real>(height);
    const Real half = std::ldexp(Real{1}, std::ilogb(s.alarm) - kDigits);
    s.a.radius = random.chance(3) ? ulps_away(half, -1) : half * static_cast<Real>(random.between(0, 3));
    s.contact = random.chance(2) ? std::numeric_limits<Real>::denorm_min() : Real{0};
    if (missing) s.alarm = ulps_away(s.alarm - s.a.radius, -1);
    return s;
  }
  // Along an axis, from a coordinate so large that half of an odd number beside it does not fit.
  const Real large = std::ldexp(Real{1}, kDigits - 1) + static_cast<Real>(random.between(100, 10000));
  const auto odd = static_cast<Real>(2 * random.between(0, 40) + 1);
  const auto height = static_cast<Real>(random.between(1, 20));
  const std::size_t up = random.index(3);
  const std::size_t beside = (up + 1) % 3;
  OverPlane<Real> s;
  s.normal = {};
  s.normal[up] = random.with_sign(std::ldexp(Real{1}, random.between(-3, 3)));
  const Real outward = s.normal[up] < 0 ? Real{-1} : Real{1};
  s.a.start[up] = random.with_sign(large);
  if (!kIsSphere<kPair> && random.turn(2, 2) == 0) {
    s.a.start[up] = outward * height;
    s.a.start[beside] = random.with_sign(large);
    s.a.end = s.a.start;
    s.a.end[beside] += s.a.start[beside] < 0 ? -odd : odd;
    if (random.chance(2)) std::swap(s.a.start, s.a.end);
    s.offset = 0;
    s.a.radius = height * (missing ? random.uniform(Real{0.5}, Real{0.9375}) : random.uniform(Real{1}, Real{2}));
    return s;
  }
  s.a.end = s.a.start;
  if (!kIsSphere<kPair>) s.a.end[up] += outward * static_cast<Real>(random.between(1, 9));
  s.offset = std::abs(s.normal[up]) * (outward * s.a.start[up] - height);
  s.a.radius = odd / 2 + height;
  if (missing) s.a.radius = height * random.uniform(Real{0.5}, Real{0.9375});
  // A normal that is not quite along the axis: r n is a little less than r.
  if (random.chance(2)) s.normal[beside] = std::ldexp(s.normal[up], -random.between(kDigits / 2 + 1, 100));
  return s;
}

template <class Real, Pair kPair>
OverPlane<Real> far_over_plane(Random& random) {
  const bool near = random.turn(3, 7) != 0;
  const auto make = [&] {
    OverPlane<Real> s = over_plane<Real, kPair>(random);
    const Real by = std::ldexp(Real{1}, random.between(10, sizeof(Real) == 8 ? 40 : 16));
    for (std::size_t i = 0; i < 3; ++i) {
      const Real step = random.with_sign(by);
      for (Triple<Real>* v : s.ends()) (*v)[i] += step;
    }
    const Real height = random.uniform(Real{0.5}, Real{6});
    s.put_plane_below(height);
    // The offset is as coarse as it is large.
    if (!(s.distance() > height / 2)) s.put_plane_below(height + by * std::numeric_limits<Real>::epsilon() * 16);
    if (near)
      reach_nearly(s, random, kPair, random.chance(2));
    else
      reach_or_not(s, random);
    settle_radii<kPair>(s);
    return s;
  };
  return near ? searched<OverPlane, Real>(random, kPair, make) : make();
}

template <class Real, Pair kPair>
OverPlane<Real> plane_in_other_units(Random& random) {
  OverPlane<Real> s = generic_over_plane<Real, kPair>(random);
  s.scale(random.between(-24, 24));
  return s;
}

template <class Real, Pair kPair>
OverPlane<Real> extreme_over_plane(Random& random) {
  using Limits = std::numeric_limits<Real>;
  OverPlane<Real> s = generic_over_plane<Real, kPair>(random);
  switch (random.turn(3, 7)) {
    case 0:  // products that overflow
      s.scale(random.between(Limits::max_exponent / 4, Limits::max_exponent - 10));
      return s;
    case 1:  // products that underflow, and subnormal numbers
      s.scale(random.between(Limits::min_exponent - Limits::digits, Limits::min_exponent / 4));
      s.lengthen_normal(random.between(Limits::min_exponent / 2, 0));
      return s;
    default: {  // magnitudes that have nothing to do with each other
      const auto any = [&] {
        return random.with_sign(random.magnitude<Real>(Limits::min_exponent + 2, Limits::max_exponent - 4));
      };
      for (Triple<Real>* v : {&s.a.start, &s.a.end, &s.normal})
        for (Real& x : *v) x = any();
      if (kIsSphere<kPair>) s.a.end = s.a.start;
      s.offset = any();
      s.a.radius = std::abs(any());
      s.alarm = random.chance(2) ? std::abs(any()) : Real{0};
      s.contact = random.chance(2) ? std::abs(any()) : Real{0};
      return s;
    }
  }
}

}  // namespace contact::golden
