// The families of questions about a ray or a line that crosses a triangle, or passes it.
#pragma once

#include "golden/capsules.hpp"
#include "golden/plain_triangles.hpp"

namespace contact::golden {

/// A question in the file's scalar: a segment from `start`, `length` times `direction`; a line ends at what that rounds
/// to. The two distances have no say.
template <class Real>
struct Crossing {
  Triple<Real> start{};
  Triple<Real> direction{};
  Real length{1};
  Vertices<Real> vertices{};
  Real alarm{};
  Real contact{};

  [[nodiscard]] Triple<Real> end() const { return moved(start, length, direction); }
  [[nodiscard]] Query query(Pair pair) const {
    const Triangle triangle{{widened(vertices[0]), widened(vertices[1]), widened(vertices[2])}};
    const Distances distances{static_cast<double>(alarm), static_cast<double>(contact)};
    if (pair == Pair::triangle_line)
      return {pair, TriangleAndLine{triangle, {widened(start), widened(end())}}, distances};
    Triple<Real> d = direction;
    if (d == Triple<Real>{}) d = {1, 2, -2};  // a ray has one, also where its length is 0
    const Real times = direction == Triple<Real>{} ? Real{0} : length;
    return {pair, RayAndTriangle{{widened(start), widened(d), static_cast<double>(times)}, triangle}, distances};
  }
  [[nodiscard]] std::array<Triple<Real>*, 4> points() { return {&start, &vertices[0], &vertices[1], &vertices[2]}; }
  void scale(int exponent) {
    for (Triple<Real>* v : points())
      for (Real& x : *v) x = std::ldexp(x, exponent);
    for (Real& x : direction) x = std::ldexp(x, exponent);
    for (Real* x : {&alarm, &contact}) *x = std::ldexp(*x, exponent);
  }
};

template <class Real>
void any_distances(Crossing<Real>& s, Random& random) {
  s.alarm = random.chance(2) ? random.uniform(Real{0}, Real{4}) : Real{0};
  s.contact = random.chance(2) ? random.uniform(Real{0}, Real{4}) : Real{0};
}

/// A point of the plane of a triangle by the weights of its second and third vertex.
template <class Real>
Triple<Real> at_weights(const Vertices<Real>& v, Real second, Real third) {
  return moved(moved(v[0], second, moved(v[1], Real{-1}, v[0])), third, moved(v[2], Real{-1}, v[0]));
}

/// Through or beside an ordinary triangle: two in five miss it, past an edge or short of the plane.
template <class Real, Pair kPair>
Crossing<Real> generic_crossing(Random& random) {
  Crossing<Real> s;
  for (Triple<Real>& v : s.vertices) v = triple<Real>(random, -4, 4);
  const int kind = random.turn(5);
  Real second = random.uniform(Real{0.0625}, Real{0.875});
  Real third = random.uniform(Real{0.0625}, Real{0.9375} - second);
  if (kind == 3) {
    const Real beyond = random.uniform(Real{0.125}, Real{1});
    const std::size_t edge = random.index(3);
    if (edge == 0) second = -beyond;
    if (edge == 1) third = -beyond;
    if (edge == 2) third = 1 - second + beyond;
  }
  const Triple<Real> x = at_weights(s.vertices, second, third);
  s.direction = triple<Real>(random, -4, 4);
  s.length = random.chance(2) ? random.uniform(Real{0.5}, Real{4}) : Real{1};
  Real part = random.uniform(Real{0.0625}, Real{0.9375});
  if (kind == 4) part = random.chance(2) ? -part : 1 + part;
  s.start = moved(x, -part * s.length, s.direction);
  any_distances(s, random);
  return s;
}

/// Integers: a point x of the plane of a triangle, and a direction across it. The edges from the first vertex are
/// multiples of two vectors, so that points of the edges, of the inside and beyond are on the grid.
template <class Real>
struct OnGrid {
  Crossing<Real> shapes;
  Triple<std::int64_t> x{};
  Triple<std::int64_t> d{};
};
enum class Where { vertex, edge, inside };

template <class Real>
OnGrid<Real> crossing_on_grid(Random& random, Where where) {
  const bool wide = sizeof(Real) == 8;
  const std::int64_t size = wide && random.chance(2) ? 1 << 19 : 12;
  const std::int64_t offset = wide ? 1 << 24 : 1 << 10;
  const auto vector = [&](std::int64_t most) {
    return Triple<std::int64_t>{random.between(-most, most), random.between(-most, most), random.between(-most, most)};
  };
  OnGrid<Real> made;
  Triple<std::int64_t> u{};
  Triple<std::int64_t> v{};
  for (;;) {
    u = vector(size);
    v = vector(size);
    made.d = vector(size);
    const auto n = [&](std::size_t i) { return u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3]; };
    if (n(0) * made.d[0] + n(1) * made.d[1] + n(2) * made.d[2] != 0) break;
  }
  const std::int64_t times = 2 * random.between<std::int64_t>(2, 6);  // u and v are as long as that many steps
  const Triple<std::int64_t> corner = vector(offset);
  std::int64_t second = 0;
  std::int64_t third = 0;
  if (where == Where::edge) {
    second = random.between<std::int64_t>(1, times - 1);
    const std::size_t edge = random.index(3);
    if (edge == 1) std::swap(second, third);
    if (edge == 2) third = times - second;
  } else if (where == Where::inside) {
    second = random.between<std::int64_t>(1, times - 2);
    third = random.between<std::int64_t>(1, times - 1 - second);
  }
  made.x = moved(moved(corner, second, u), third, v);
  Vertices<Real> vertices;
  const auto placed = [](const Triple<std::int64_t>& p) {
    return Triple<Real>{static_cast<Real>(p[0]), static_cast<Real>(p[1]), static_cast<Real>(p[2])};
  };
  vertices = {placed(corner), placed(moved(corner, times, u)), placed(moved(corner, times, v))};
  const std::size_t first = random.index(3);
  for (std::size_t k = 0; k < 3; ++k) made.shapes.vertices[(first + k) % 3] = vertices[k];
  if (random.chance(2)) std::swap(made.shapes.vertices[0], made.shapes.vertices[1]);
  made.shapes.direction = placed(made.d);
  any_distances(made.shapes, random);
  return made;
}

/// From so many directions before x, so many in all.
template <class Real>
void lay(OnGrid<Real>& made, std::int64_t before, std::int64_t all) {
  for (std::size_t i = 0; i < 3; ++i) made.shapes.start[i] = static_cast<Real>(made.x[i] - before * made.d[i]);
  made.shapes.length = static_cast<Real>(all);
}

/// Moves a start by one step of one coordinate so that the segment misses, where one does that.
template <class Real, Pair kPair>
void step_off(Crossing<Real>& s) {
  const Triple<Real> start = s.start;
  for (int steps = 1; steps <= 8; steps *= 2)
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const int step : {-steps, steps}) {
        s.start = start;
        s.start[axis] = ulps_away(start[axis], step);
        if (!is_hit(s.query(kPair))) return;
      }
  s.start = moved(start, Real{-2} * s.length, s.direction);
}

/// Through an edge or a vertex, exactly; a fifth one step outside.
template <class Real, Pair kPair>
Crossing<Real> boundary_crossing(Random& random) {
  auto made = crossing_on_grid<Real>(random, random.turn(3) == 0 ? Where::vertex : Where::edge);
  const auto before = random.between<std::int64_t>(1, 3);
  lay(made, before, before + random.between<std::int64_t>(1, 3));
  Crossing<Real>& s = made.shapes;
  s.scale(random.between(-20, 20));
  if (random.turn(5) == kMissing) step_off<Real, kPair>(s);
  return s;
}

/// A start or an end on the triangle, exactly; a fifth one step short of it.
template <class Real, Pair kPair>
Crossing<Real> end_on_triangle(Random& random) {
  auto made = crossing_on_grid<Real>(random, random.turn(3) == 0 ? Where::edge : Where::inside);
  const auto all = random.between<std::int64_t>(1, 4);
  lay(made, random.turn(2) == 0 ? 0 : all, all);
  Crossing<Real>& s = made.shapes;
  s.scale(random.between(-20, 20));
  if (random.turn(5) == kMissing) step_off<Real, kPair>(s);
  return s;
}

/// Within some steps of the boundary, most of them searched for wrong decisions of plain arithmetic.
template <class Real, Pair kPair>
Crossing<Real> near_boundary(Random& random) {
  const auto make = [&] {
    Crossing<Real> s;
    for (Triple<Real>& v : s.vertices) v = triple<Real>(random, -4, 4);
    Real second = random.uniform(Real{0.0625}, Real{0.9375});
    Real third = 0;
    const std::size_t edge = random.index(4);
    if (edge == 1) std::swap(second, third);
    if (edge == 2) third = 1 - second;
    if (edge == 3) third = (1 - second) / 2;  // an end on the plane
    const Triple<Real> x = at_weights(s.vertices, second, third);
    s.direction = triple<Real>(random, -4, 4);
    const bool starts = random.chance(2);
    s.start =
        moved(x, edge == 3 ? (starts ? Real{0} : Real{-1}) : random.uniform(Real{-0.9375}, Real{-0.0625}), s.direction);
    Real& c = s.start[random.index(3)];
    c = ulps_away(c, random.between(-2, 2));
    any_distances(s, random);
    return s;
  };
  return random.turn(4) == 0 ? make() : searched<Crossing, Real>(random, kPair, make);
}

/// In the plane of the triangle, exactly, which is no crossing; most of them with ends a step above and below it.
template <class Real, Pair kPair>
Crossing<Real> along_triangle(Random& random) {
  auto made = crossing_on_grid<Real>(random, Where::inside);
  Crossing<Real>& s = made.shapes;
  const auto& v = s.vertices;
  // Along an edge, through the point inside.
  const std::size_t k = random.index(3);
  s.direction = moved(v[(k + 1) % 3], Real{-1}, v[k]);
  s.length = 2;
  s.start = moved({static_cast<Real>(made.x[0]), static_cast<Real>(made.x[1]), static_cast<Real>(made.x[2])}, Real{-1},
                  s.direction);
  s.scale(random.between(-20, 20));
  if (random.turn(5) < 2) return s;
  const Crossing<Real> level = s;
  for (const int steps : {1, 2, 4, 8, 64})
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const int sign : {-1, 1}) {
        s = level;
        s.start[axis] = ulps_away(s.start[axis], sign * steps);
        s.direction[axis] -= s.start[axis] - level.start[axis];  // the end is as far on the other side
        if (is_hit(s.query(kPair))) return s;
      }
  return s;
}

/// Triangles without an inside and segments without length, which nothing crosses; half of them slivers.
template <class Real, Pair kPair>
Crossing<Real> thin_crossing(Random& random) {
  if (random.turn(2) == 0) {
    auto made = crossing_on_grid<Real>(random, Where::inside);
    lay(made, 1, 2);
    Crossing<Real>& s = made.shapes;
    switch (random.turn(3, 2)) {
      case 0:
        s.vertices[2] = s.vertices[random.index(2)];
        if (random.chance(4)) s.vertices[0] = s.vertices[1];
        break;
      case 1:
        for (std::size_t i = 0; i < 3; ++i) s.vertices[2][i] = (s.vertices[0][i] + s.vertices[1][i]) / 2;
        break;
      default:
        s.start = {static_cast<Real>(made.x[0]), static_cast<Real>(made.x[1]), static_cast<Real>(made.x[2])};
        s.direction = {};
        s.length = 0;
    }
    return s;
  }
  // The third vertex some steps beside the line of the others, and a segment across.
  Crossing<Real> s;
  s.vertices[0] = triple<Real>(random, -4, 4);
  s.vertices[1] = triple<Real>(random, -4, 4);
  const Real part = random.uniform(Real{0.25}, Real{0.75});
  const Triple<Real> u = moved(s.vertices[1], Real{-1}, s.vertices[0]);
  const Triple<Real> aside = cross(u, triple<Real>(random, -1, 1));
  const Real width = random.magnitude<Real>(sizeof(Real) == 8 ? -40 : -16, -8);
  s.vertices[2] = moved(moved(s.vertices[0], part, u), width, aside);
  const Triple<Real> x = moved(moved(s.vertices[0], part, u), width * random.uniform(Real{0.125}, Real{0.75}), aside);
  s.direction = cross(u, aside);
  s.start = moved(x, random.uniform(Real{-0.75}, Real{-0.25}), s.direction);
  any_distances(s, random);
  return s;
}

/// A coordinate of the crossing half way between two numbers, or just beside that.
template <class Real, Pair kPair>
Crossing<Real> ties_of_crossing(Random& random) {
  constexpr int kDigits = std::numeric_limits<Real>::digits;
  const Real large = std::ldexp(Real{1}, kDigits - 1) + static_cast<Real>(random.between(100, 10000));
  const auto odd = static_cast<Real>(2 * random.between(0, 40) + 1);
  const std::size_t up = random.index(3);
  const std::size_t along = (up + 1) % 3;
  const std::size_t aside = (up + 2) % 3;
  const Real sign = random.chance(2) ? Real{1} : Real{-1};
  const auto height = static_cast<Real>(random.between(1, 20));
  Crossing<Real> s;
  s.start[along] = sign * large;
  s.start[up] = height;
  s.start[aside] = static_cast<Real>(random.between(-3, 3));
  s.direction[along] = sign * odd;
  s.direction[up] = -2 * height;  // through the plane half way
  const bool missing = random.turn(5) == kMissing;
  const Real away = missing ? Real{400} : Real{0};
  const auto vertex = [&](Real x, Real y) {
    Triple<Real> v{};
    v[along] = sign * (large + x + away);
    v[aside] = y;
    return v;
  };
  s.vertices = {vertex(-90, -200), vertex(-90, 300), vertex(200, 0)};
  // A plane that is not quite level: the crossing is a little off the middle.
  if (random.chance(2)) s.vertices[2][up] = std::ldexp(Real{1}, -random.between(kDigits / 2, 100));
  std::swap(s.vertices[0], s.vertices[random.index(3)]);
  any_distances(s, random);
  return s;
}

template <class Real, Pair kPair>
Crossing<Real> far_crossing(Random& random) {
  Crossing<Real> s = generic_crossing<Real, kPair>(random);
  const Real by = std::ldexp(Real{1}, random.between(10, sizeof(Real) == 8 ? 40 : 16));
  for (std::size_t i = 0; i < 3; ++i) {
    const Real step = random.with_sign(by);
    for (Triple<Real>* v : s.points()) (*v)[i] += step;
  }
  return s;
}

template <class Real, Pair kPair>
Crossing<Real> crossing_in_other_units(Random& random) {
  Crossing<Real> s = generic_crossing<Real, kPair>(random);
  s.scale(random.between(-24, 24));
  return s;
}

template <class Real, Pair kPair>
Crossing<Real> extreme_crossing(Random& random) {
  using Limits = std::numeric_limits<Real>;
  Crossing<Real> s = generic_crossing<Real, kPair>(random);
  switch (random.turn(3, 7)) {
    case 0:  // products that overflow
      s.scale(random.between(Limits::max_exponent / 4, Limits::max_exponent - 10));
      return s;
    case 1:  // products that underflow, and subnormal numbers
      s.scale(random.between(Limits::min_exponent - Limits::digits, Limits::min_exponent / 4));
      return s;
    default: {  // magnitudes that have nothing to do with each other
      const auto stretch = [&] { return random.between(Limits::min_exponent / 2 + 8, Limits::max_exponent / 2 - 8); };
      const std::array<int, 3> exponents{stretch(), stretch(), stretch()};  // of each axis: what crosses still does
      for (std::size_t i = 0; i < 3; ++i) {
        for (Triple<Real>* v : s.points()) (*v)[i] = std::ldexp((*v)[i], exponents[i]);
        s.direction[i] = std::ldexp(s.direction[i], exponents[i]);
      }
      return s;
    }
  }
}

}  // namespace contact::golden
