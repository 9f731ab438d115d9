// The families of questions about a sphere and a triangle.
#pragma once

#include "golden/capsules.hpp"
#include "golden/plain_triangles.hpp"

namespace contact::golden {

/// A question in the file's scalar, made as TwoSegments is. The second radius is a share of the sphere's.
template <class Real>
struct SphereTriangle {
  struct Radius {
    Real radius{};
  };
  Triple<Real> center{};
  Radius a{};
  Radius b{};
  Vertices<Real> vertices{};
  Real alarm{};
  Real contact{};

  [[nodiscard]] Query query(Pair pair) const {
    return {pair,
            BallAndTriangle{{widened(center), static_cast<double>(a.radius + b.radius)},
                            {{widened(vertices[0]), widened(vertices[1]), widened(vertices[2])}}},
            {static_cast<double>(alarm), static_cast<double>(contact)}};
  }
  [[nodiscard]] std::array<Triple<Real>*, 4> points() { return {&center, &vertices[0], &vertices[1], &vertices[2]}; }
  /// Between the centre and the triangle, in plain arithmetic.
  [[nodiscard]] Real distance() const {
    const Triple<Real> delta = moved(nearest_point(center, vertices), Real{-1}, center);
    return std::sqrt(dot(delta, delta));
  }
  void scale(int exponent) {
    for (Triple<Real>* v : points())
      for (Real& x : *v) x = std::ldexp(x, exponent);
    for (Real* x : {&a.radius, &b.radius, &alarm, &contact}) *x = std::ldexp(*x, exponent);
  }
};

/// Which part of a triangle is nearest; each vertex and each edge in turn.
enum class Part { vertex, edge, face };
struct PartOfTriangle {
  Part part;
  std::size_t first;  ///< the vertex, or the one that the edge begins at
};
inline PartOfTriangle turn_of_parts(Random& random) {
  const int turn = random.turn(7);
  const auto first = static_cast<std::size_t>(turn % 3);
  return {turn < 3 ? Part::vertex : turn < 6 ? Part::edge : Part::face, turn < 6 ? first : random.index(3)};
}

/// The three points so that the first one is the one of that number; the others in either order.
template <class Real>
Vertices<Real> numbered(Random& random, std::size_t first, const Vertices<Real>& v) {
  const bool turned = random.chance(2);
  Vertices<Real> made;
  made[first] = v[0];
  made[(first + 1) % 3] = v[turned ? 2 : 1];
  made[(first + 2) % 3] = v[turned ? 1 : 2];
  return made;
}
/// Of an edge, which is from the first point to the second.
template <class Real>
Vertices<Real> numbered(Random& random, const PartOfTriangle& which, const Vertices<Real>& v) {
  if (which.part != Part::edge) return numbered(random, which.first, v);
  const bool turned = random.chance(2);
  Vertices<Real> made;
  made[which.first] = v[turned ? 1 : 0];
  made[(which.first + 1) % 3] = v[turned ? 0 : 1];
  made[(which.first + 2) % 3] = v[2];
  return made;
}

/// A triangle of ordinary size, anywhere, with a part beside a sphere's centre.
template <class Real>
SphereTriangle<Real> beside_part(Random& random) {
  const PartOfTriangle which = turn_of_parts(random);
  SphereTriangle<Real> s;
  s.center = triple<Real>(random, -10, 10);
  const Triple<Real> delta = triple<Real>(random, -4, 4);
  const Triple<Real> q = moved(s.center, Real{1}, delta);
  const auto across = [&] { return cross(triple<Real>(random, -1, 1), delta); };
  const auto size = [&] { return random.uniform(Real{0.125}, Real{1.5}); };
  const auto away = [&] {
    const Triple<Real> way = triple<Real>(random, -4, 4);
    return moved({}, dot(way, delta) < 0 ? Real{-1} : Real{1}, way);
  };
  const Triple<Real> u = across();
  const Triple<Real> v = across();
  Vertices<Real> made{q, q, q};
  if (which.part == Part::face) {
    // Drawn one after the other: a call's arguments are in no order.
    const Triple<Real> first = moved(q, size(), u);
    const Triple<Real> second = moved(q, size(), v);
    const Real along_v = size();
    made = {first, second, moved(moved(q, -size(), u), -along_v, v)};
  } else if (which.part == Part::edge) {
    made = {moved(q, -size(), u), moved(q, size(), u), moved(q, Real{1}, away())};
  } else {
    made = {q, moved(q, Real{1}, away()), moved(q, Real{1}, away())};
  }
  s.vertices = numbered(random, which, made);
  return s;
}

template <class Real>
SphereTriangle<Real> generic_triangle(Random& random) {
  SphereTriangle<Real> s = beside_part<Real>(random);
  s.a.radius = random.uniform(Real{0.5}, Real{6});
  random_distances(s, random);
  return s;
}

/// How a triangle lies to the shortest way there: leaning away where it may, or all of it at right angles.
enum class TriangleLie { leaning, level };

template <class Real>
struct TriangleOnFrame {
  SphereTriangle<Real> shapes;
  Frame frame;
  std::int64_t distance;
};

/// A triangle on a grid and exactly an integer from a centre, along the third row of a frame; `meeting` makes it 0. The
/// nearest point is on the grid too, but half of those on a leaning edge or a face are fractions that no scalar holds.
template <class Real>
TriangleOnFrame<Real> triangle_on_frame(Random& random, const PartOfTriangle& which, TriangleLie lie,
                                        bool meeting = false) {
  const bool wide = sizeof(Real) == 8;
  const bool large = random.chance(2);
  const std::int64_t offset = wide ? 1 << 24 : 1 << 10;
  const std::int64_t steps = large ? (wide ? 64 : 6) : 3;
  TriangleOnFrame<Real> made{{}, frame(random, large ? (wide ? 1 << 9 : 9) : random.between(1, 3)), 0};
  const std::int64_t height = meeting ? 0 : random.between<std::int64_t>(1, wide && large ? 1 << 8 : 24);
  const std::int64_t length = made.frame.length;
  made.distance = height * length;
  const auto upward = [&] { return lie == TriangleLie::level ? 0 : random.between<std::int64_t>(0, steps); };
  const auto step = [&] { return random.between(-steps, steps); };
  const auto size = [&] { return random.between<std::int64_t>(1, wide ? 8 : 4); };
  // The vertices in steps along the rows, and where the last step is from: the nearest point, or one beside it.
  std::array<Triple<std::int64_t>, 3> at{};
  Triple<std::int64_t> from = made.frame.at({0, 0, height});
  // (n first + height third) / length where that is on the grid: the foot is height third / length.
  const auto between_grid_points = [&] {
    for (std::int64_t n = 1; n < std::min<std::int64_t>(length, 1000); ++n) {
      const Triple<std::int64_t> point = made.frame.at({n, 0, height});
      if (point[0] % length != 0 || point[1] % length != 0 || point[2] % length != 0) continue;
      from = {point[0] / length, point[1] / length, point[2] / length};
      made.distance = height;
      return true;
    }
    return false;
  };
  switch (which.part) {
    case Part::vertex:
      at = {Triple<std::int64_t>{}, {step(), step(), upward()}, {step(), step(), upward()}};
      break;
    case Part::edge: {
      const bool fraction = !meeting && random.chance(2) && between_grid_points();
      Triple<std::int64_t> along = {step(), fraction ? 0 : step(), 0};
      if (along[0] == 0) along[0] = 1;
      // The foot is less than a step from there.
      at = {moved({}, -size(), along), moved({}, size(), along), {step(), step(), upward()}};
      break;
    }
    case Part::face: {
      if (!meeting && random.chance(2)) between_grid_points();
      // Around all feet that there may be: those less than a step from there, on both rows.
      const auto more = [&] { return random.between<std::int64_t>(0, 3); };
      const std::int64_t x = more();
      const std::int64_t y = more();
      at = {
          Triple<std::int64_t>{-3 - more(), -3 - more(), 0}, {4 + y + more(), -2 - y, 0}, {-2 - x, 4 + x + more(), 0}};
      break;
    }
  }
  const Triple<std::int64_t> center = {random.between(-offset, offset), random.between(-offset, offset),
                                       random.between(-offset, offset)};
  const auto placed = [](const Triple<std::int64_t>& v) {
    return Triple<Real>{static_cast<Real>(v[0]), static_cast<Real>(v[1]), static_cast<Real>(v[2])};
  };
  made.shapes.center = placed(center);
  Vertices<Real> vertices;
  for (std::size_t k = 0; k < 3; ++k)
    vertices[k] = placed(moved(moved(center, std::int64_t{1}, from), std::int64_t{1}, made.frame.at(at[k])));
  made.shapes.vertices = numbered(random, which, vertices);
  return made;
}

constexpr Pair kOfTriangle = Pair::sphere_triangle;

/// One in five a radius too short by one ulp.
template <class Real>
SphereTriangle<Real> touching_triangle(Random& random) {
  const auto make = [&] {
    auto [s, frame, distance] = triangle_on_frame<Real>(random, turn_of_parts(random), TriangleLie::leaning);
    reach_exactly(s, random, distance);
    settle_radii<kOfTriangle>(s);
    return s;
  };
  SphereTriangle<Real> s = random.turn(2) == 0 ? make() : searched<SphereTriangle, Real>(random, kOfTriangle, make);
  s.scale(random.between(-40, 40));
  if (random.turn(5) == kMissing) s.a.radius = ulps_away(s.a.radius, -1);
  return s;
}

template <class Real>
SphereTriangle<Real> near_touching_triangle(Random& random) {
  const auto make = [&] {
    SphereTriangle<Real> s = beside_part<Real>(random);
    reach_nearly(s, random, kOfTriangle, false);
    return s;
  };
  return random.turn(4) == 0 ? make() : searched<SphereTriangle, Real>(random, kOfTriangle, make);
}

template <class Real>
SphereTriangle<Real> alarm_edge_of_triangle(Random& random) {
  if (random.turn(3, 7) == 0) {
    auto [s, frame, distance] = triangle_on_frame<Real>(random, turn_of_parts(random), TriangleLie::leaning);
    reach_exactly(s, random, distance, true);
    settle_radii<kOfTriangle>(s);
    s.scale(random.between(-40, 40));
    return s;
  }
  return searched<SphereTriangle, Real>(random, kOfTriangle, [&] {
    SphereTriangle<Real> s = beside_part<Real>(random);
    reach_nearly(s, random, kOfTriangle, true);
    return s;
  });
}

/// Where one region ends and the next begins: the foot on the face's plane exactly on a vertex or an edge, one
/// coordinate moved by an ulp or not.
template <class Real>
SphereTriangle<Real> region_edge_of_triangle(Random& random) {
  PartOfTriangle which = turn_of_parts(random);
  if (which.part == Part::face) which.part = Part::edge;
  SphereTriangle<Real> s = triangle_on_frame<Real>(random, which, TriangleLie::level).shapes;
  Real& x = (*s.points()[random.index(4)])[random.index(3)];
  x = ulps_away(x, random.between(-1, 1));
  reach_or_not(s, random);
  settle_radii<kOfTriangle>(s);
  return s;
}

/// The foot on the plane in line with a vertex, or with an edge, along an axis or a diagonal: who counts the edges that a
/// ray in the plane crosses counts two or none of them there. On a grid.
template <class Real>
SphereTriangle<Real> aligned_triangle(Random& random) {
  const int kind = random.turn(6);
  // Along `ahead` there is a vertex; one axis, or two of them.
  Triple<std::int64_t> ahead{};
  const std::size_t axis = random.index(3);
  ahead[axis] = random.with_sign(std::int64_t{1});
  if (random.turn(3, 6) == 0) ahead[(axis + 1) % 3] = random.with_sign(std::int64_t{1});
  Triple<std::int64_t> beside{};
  Triple<std::int64_t> normal{};
  while (normal == Triple<std::int64_t>{}) {
    for (std::int64_t& x : beside) x = random.between<std::int64_t>(-2, 2);
    normal = cross(ahead, beside);
  }
  const auto steps = [&] { return random.between<std::int64_t>(1, 6); };
  const auto any = [&] { return random.between<std::int64_t>(-6, 6); };
  // The vertices from the foot, in steps along `ahead` and `beside`.
  const std::int64_t distance = steps();
  std::array<std::array<std::int64_t, 2>, 3> at{{{distance, 0}, {0, 0}, {0, 0}}};
  const std::int64_t first = steps();
  const std::int64_t second = steps();
  const std::int64_t up = steps();
  const std::int64_t down = steps();
  switch (kind) {
    case 0:  // the foot inside, a vertex ahead
    case 1:  // or behind
      if (kind == 1) at[0][0] = -distance;
      at[1] = {kind == 1 ? first : -first, up};
      at[2] = {kind == 1 ? second : -second, -down};
      break;
    case 2:  // before a vertex, behind which is the inside
      at[1] = {distance + first, up};
      at[2] = {distance + second, -down};
      break;
    case 3:  // before an edge
      at[1] = {distance + first, 0};
      at[2] = {any(), up};
      break;
    case 4:  // before a vertex, and all else to one side
      at[1] = {any(), up};
      at[2] = {any(), up + down};
      break;
    default:  // inside, in the middle between a vertex and the edge behind it
      at[1] = {-distance, up};
      at[2] = {-distance, -up};
      break;
  }
  const auto placed = [](const Triple<std::int64_t>& v) {
    return Triple<Real>{static_cast<Real>(v[0]), static_cast<Real>(v[1]), static_cast<Real>(v[2])};
  };
  Triple<std::int64_t> foot{};
  for (std::int64_t& x : foot) x = random.between<std::int64_t>(-200, 200);
  Vertices<Real> made;
  for (std::size_t k = 0; k < 3; ++k) made[k] = placed(moved(moved(foot, at[k][0], ahead), at[k][1], beside));
  SphereTriangle<Real> s;
  s.vertices = numbered(random, random.index(3), made);
  const std::int64_t height = random.between<std::int64_t>(1, 3);
  const std::int64_t side = random.with_sign(height);
  s.center = placed(moved(foot, side, normal));
  reach_or_not(s, random);
  settle_radii<kOfTriangle>(s);
  return s;
}

/// Slivers an ulp wide, three points on a line, and triangles that are one or two points.
template <class Real>
SphereTriangle<Real> thin_triangle(Random& random) {
  const int kind = random.turn(5, 7);
  auto [s, frame, distance] = triangle_on_frame<Real>(random, turn_of_parts(random), TriangleLie::leaning);
  auto& [x, y, z] = s.vertices;
  const auto part = static_cast<Real>(random.between(-4, 12)) / Real{8};
  switch (kind) {
    case 0: {  // a sliver: the third vertex beside the line of the others
      z = moved(x, part, moved(y, Real{-1}, x));
      const int step = random.chance(2) ? 1 : -1;
      const std::size_t from = random.index(3);
      z[random.index(3)] = ulps_away(z[from], step);
      break;
    }
    case 1:  // on the line, in whichever order
      z = moved(x, part * Real{8}, moved(y, Real{-1}, x));
      break;
    case 2:
      z = random.chance(2) ? x : y;
      break;
    case 3:
      y = z = x;
      break;
    default:  // a needle: two vertices ulps apart
      z = x;
      for (Real& i : z) i = ulps_away(i, random.between(-1, 1));
      break;
  }
  s.vertices = numbered(random, random.index(3), s.vertices);
  if (random.turn(5) == 0) s.center = s.vertices[random.index(3)];
  s.contact = random.chance(2) ? random.uniform(Real{0}, Real{1}) : Real{0};
  if (s.distance() == 0)
    s.a.radius = random.uniform(Real{0.5}, Real{6});
  else if (kind != 0 && random.chance(2))
    reach_nearly(s, random, kOfTriangle, random.chance(2));
  else
    reach_or_not(s, random);
  settle_radii<kOfTriangle>(s);
  return s;
}

/// The centre on the face, an edge or a vertex. A fifth of them moved off it by an ulp of the largest coordinate,
/// without a radius.
template <class Real>
SphereTriangle<Real> on_triangle(Random& random) {
  const TriangleLie lie = random.chance(2) ? TriangleLie::level : TriangleLie::leaning;
  auto [s, frame, distance] = triangle_on_frame<Real>(random, turn_of_parts(random), lie, true);
  if (random.turn(5) == kMissing) {
    const Triple<std::int64_t>& normal = frame.rows[2];
    std::size_t axis = 0;
    for (const std::size_t i : {1U, 2U})
      if (std::abs(normal[i]) > std::abs(normal[axis])) axis = i;
    Real largest = 1;
    for (const Triple<Real>* v : s.points())
      for (const Real x : *v) largest = std::max(largest, std::abs(x));
    s.center[axis] += std::copysign(ulps_away(largest, 1) - largest, normal[axis] < 0 ? Real{1} : Real{-1});
    return s;
  }
  if (random.turn(4, 5) != 0) s.a.radius = random.uniform(Real{0.5}, Real{6});
  random_distances(s, random);
  if (random.chance(5))
    s.scale(random.between(std::numeric_limits<Real>::min_exponent + 8, std::numeric_limits<Real>::max_exponent - 36));
  return s;
}

/// Numbers half way between two neighbours, and beside that by the least there is: the value of an exact distance, or a
/// nearest point in the middle of an edge, which is a triangle without an inside.
template <class Real>
SphereTriangle<Real> ties_of_triangle(Random& random) {
  constexpr int kDigits = std::numeric_limits<Real>::digits;
  const Real least = random.chance(4) ? Real{0} : std::numeric_limits<Real>::denorm_min();
  const bool missing = random.turn(5) == kMissing;
  if (random.turn(2) == 0) {
    auto [s, frame, distance] = triangle_on_frame<Real>(random, turn_of_parts(random), TriangleLie::leaning);
    s.alarm = static_cast<Real>(distance);
    const Real half = std::ldexp(Real{1}, std::ilogb(s.alarm) - kDigits);
    s.a.radius = random.chance(3) ? ulps_away(half, -1) : half * static_cast<Real>(random.between(0, 3));
    s.contact = least;
    if (missing) s.alarm = ulps_away(s.alarm - s.a.radius, -1);
    return s;
  }
  // Along (1, 2, 0) from a coordinate so large that the middle does not fit, and away from the centre.
  const Real large = std::ldexp(Real{1}, kDigits - 1) + static_cast<Real>(random.between(100, 10000));
  const auto odd = static_cast<Real>(2 * random.between(0, 40) + 1);
  const auto off = static_cast<Real>(2 * random.between(-20, 20) + 1);
  const auto height = static_cast<Real>(random.between(1, 20));
  SphereTriangle<Real> s;
  s.center = {large + (odd + off) / 2, odd - off / 4, height};
  s.vertices = {Triple<Real>{large, 0, 0},
                {large + odd, 2 * odd, 0},
                moved({large, 0, 0}, Real{-2}, {off / 2, -off / 4, height})};
  s.a.radius =
      s.distance() * (missing ? random.uniform(Real{0.5}, Real{0.9375}) : random.uniform(Real{1.0625}, Real{2}));
  const std::array<std::size_t, 2> swapped{random.index(3), 1 + random.index(2)};
  const bool negative = random.chance(2);
  for (Triple<Real>* v : s.points()) {
    if (negative) (*v)[0] = -(*v)[0];
    std::swap((*v)[0], (*v)[swapped[0]]);
    std::swap((*v)[1], (*v)[swapped[1]]);
  }
  s.vertices = numbered(random, random.index(3), s.vertices);
  s.contact = random.chance(2) ? random.uniform(Real{0}, Real{1}) : Real{0};
  return s;
}

/// Near touching or far from it, and then moved away from the origin, so that the distance is another one.
template <class Real>
SphereTriangle<Real> far_triangle(Random& random) {
  const bool near = random.turn(3, 7) != 0;
  const auto make = [&] {
    SphereTriangle<Real> s = beside_part<Real>(random);
    const Real offset = std::ldexp(Real{1}, random.between(10, sizeof(Real) == 8 ? 40 : 16));
    for (std::size_t i = 0; i < 3; ++i) {
      const Real by = random.with_sign(offset);
      for (Triple<Real>* v : s.points()) (*v)[i] += by;
    }
    if (near)
      reach_nearly(s, random, kOfTriangle, random.chance(2));
    else
      reach_or_not(s, random);
    settle_radii<kOfTriangle>(s);
    return s;
  };
  return near ? searched<SphereTriangle, Real>(random, kOfTriangle, make) : make();
}

template <class Real>
SphereTriangle<Real> triangle_in_other_units(Random& random) {
  SphereTriangle<Real> s = generic_triangle<Real>(random);
  s.scale(random.between(-24, 24));
  return s;
}

template <class Real>
SphereTriangle<Real> extreme_triangle(Random& random) {
  SphereTriangle<Real> s = generic_triangle<Real>(random);
  switch (random.turn(3, 7)) {
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
      for (Triple<Real>* v : s.points())
        for (Real& x : *v) x = any();
      s.a.radius = std::abs(any());
      s.alarm = random.chance(2) ? std::abs(any()) : Real{0};
      s.contact = random.chance(2) ? std::abs(any()) : Real{0};
      return s;
    }
  }
}

}  // namespace contact::golden
