// The families of questions about rays that are cast.
#include <vector>

#include "golden/making.hpp"
#include "golden/plain_segments.hpp"

namespace contact::golden {
namespace casts_families {
namespace {

using Integers = Triple<std::int64_t>;

/// A question in the file's scalar. `v` are the numbers of the shape that are vectors: a centre; corners; ends;
/// vertices; the normal of a plane. `size` is a radius, or an offset.
template <class Real>
struct CastIn {
  Triple<Real> origin{};
  Triple<Real> direction{1, 0, 0};
  Real length{1};
  std::array<Triple<Real>, 3> v{};
  Real size{};
  Real alarm{};
  Real contact{};

  [[nodiscard]] Query query(Pair pair) const {
    Query made = zero_query(pair);
    made.distances = {static_cast<double>(alarm), static_cast<double>(contact)};
    std::visit(
        [&]<class A, class B>(Two<A, B>& shapes) {
          if constexpr (std::same_as<A, Cast>) {
            shapes.a = {{widened(origin), widened(direction), static_cast<double>(length)}};
            std::size_t k = 0;
            for_each_field(shapes.b, [&](const auto& /*field*/, auto& value) {
              if constexpr (std::same_as<std::remove_cvref_t<decltype(value)>, double>)
                value = static_cast<double>(size);
              else
                for_each_vector(value, [&](Vector3& x) { x = widened(v[k++]); });
            });
          }
        },
        made.shapes);
    return made;
  }
  /// In another unit of length; of a plane the normal stays.
  template <Pair kPair>
  void scale(int exponent) {
    const auto by = [&](Triple<Real>& x) {
      for (Real& c : x) c = std::ldexp(c, exponent);
    };
    by(origin);
    by(direction);
    if (kPair != Pair::cast_plane)
      for (Triple<Real>& x : v) by(x);
    size = std::ldexp(size, exponent);
  }
};

template <class Real>
Triple<Real> placed(const Integers& x) {
  return {static_cast<Real>(x[0]), static_cast<Real>(x[1]), static_cast<Real>(x[2])};
}
Integers integers(Random& random, std::int64_t most) {
  Integers x{};
  for (std::int64_t& c : x) c = random.between(-most, most);
  return x;
}
/// A vector that is not 0.
Integers direction(Random& random, std::int64_t most) {
  for (;;)
    if (const Integers x = integers(random, most); x != Integers{}) return x;
}
/// One across another.
Integers across(Random& random, const Integers& n) {
  for (;;)
    if (const Integers x = cross(n, integers(random, 4)); x != Integers{}) return x;
}

template <class Real>
void any_distances(CastIn<Real>& s, Random& random) {
  s.alarm = random.chance(2) ? random.uniform(Real{0}, Real{4}) : Real{0};
  s.contact = random.chance(2) ? random.uniform(Real{0}, Real{4}) : Real{0};
}

/// A shape of ordinary size, and a point well inside it.
template <class Real, Pair kPair>
Triple<Real> ordinary_shape(CastIn<Real>& s, Random& random) {
  for (Triple<Real>& x : s.v) x = triple<Real>(random, -4, 4);
  s.size = random.uniform(Real{0.5}, Real{3});
  switch (kPair) {
    case Pair::cast_cube:
      for (std::size_t i = 0; i < 3; ++i) s.v[1][i] = s.v[0][i] + random.uniform(Real{0.5}, Real{4});
      return moved(s.v[0], random.uniform(Real{0.25}, Real{0.75}), moved(s.v[1], Real{-1}, s.v[0]));
    case Pair::cast_capsule:
      return moved(s.v[0], random.uniform(Real{0}, Real{1}), moved(s.v[1], Real{-1}, s.v[0]));
    case Pair::cast_triangle: {
      const Real second = random.uniform(Real{0.125}, Real{0.75});
      const Real third = random.uniform(Real{0.0625}, Real{0.9375} - second);
      return moved(moved(s.v[0], second, moved(s.v[1], Real{-1}, s.v[0])), third, moved(s.v[2], Real{-1}, s.v[0]));
    }
    case Pair::cast_plane: {
      const Triple<Real> x = triple<Real>(random, -4, 4);
      s.size = dot(s.v[0], x) + random.uniform(Real{0.0625}, Real{1});
      return x;
    }
    default:
      return s.v[0];
  }
}
/// How far out of the shape is surely far enough.
template <class Real, Pair kPair>
Real around(const CastIn<Real>& s) {
  return kPair == Pair::cast_capsule || kPair == Pair::cast_sphere ? s.size + Real{0.25} : Real{12};
}

/// At ordinary shapes; of five one passes by, and one ends too early.
template <class Real, Pair kPair>
CastIn<Real> generic_cast(Random& random) {
  CastIn<Real> s;
  Triple<Real> aim = ordinary_shape<Real, kPair>(s, random);
  s.direction = triple<Real>(random, -4, 4);
  const int kind = random.turn(5);
  if (kind == kMissing && kPair != Pair::cast_plane) {
    const Triple<Real> side = cross(s.direction, triple<Real>(random, -1, 1));
    aim = moved(aim, random.uniform(Real{1}, Real{2}) * around<Real, kPair>(s) / std::sqrt(dot(side, side)), side);
  }
  if (kPair == Pair::cast_plane && (kind == kMissing) == (dot(s.v[0], s.direction) < 0))
    for (Real& x : s.direction) x = -x;
  // Far enough back to be outside.
  const Real times = 2 * (around<Real, kPair>(s) + 4) / std::sqrt(dot(s.direction, s.direction));
  s.origin = moved(aim, -times, s.direction);
  if (kPair == Pair::cast_plane && kind == kMissing) s.origin = moved(aim, 2 * times, s.direction);
  s.length = kind == 4          ? times / random.uniform(Real{16}, Real{64})
             : random.chance(4) ? std::numeric_limits<Real>::max()
                                : times * random.uniform(Real{1}, Real{4});
  any_distances(s, random);
  return s;
}

/// A shape in integers, a point on its surface, and a direction out of it there.
template <class Real>
struct OnSurface {
  CastIn<Real> shapes;
  Integers x{};
  Integers n{};
};
enum class Part { face, edge };  // the round or flat inside of a surface, or where it ends

template <class Real, Pair kPair>
OnSurface<Real> on_surface(Random& random, Part part) {
  OnSurface<Real> made;
  CastIn<Real>& s = made.shapes;
  const auto corner = integers(random, sizeof(Real) == 8 ? 1 << 20 : 1 << 9);
  const auto set = [&](std::size_t k, const Integers& x) { s.v[k] = placed<Real>(x); };
  switch (kPair) {
    case Pair::cast_cube: {
      Integers size{};
      for (std::int64_t& c : size) c = 2 * random.between<std::int64_t>(1, 9);
      set(0, corner);
      set(1, moved(corner, std::int64_t{1}, size));
      const std::size_t first = random.index(3);
      const std::size_t faces = part == Part::face ? 1 : 2 + random.index(2);
      made.x = corner;
      for (std::size_t i = 0; i < 3; ++i) made.x[i] += random.between<std::int64_t>(1, size[i] - 1);
      for (std::size_t k = 0; k < faces; ++k) {
        const std::size_t i = (first + k) % 3;
        made.n[i] = random.chance(2) ? 1 : -1;
        made.x[i] = corner[i] + (made.n[i] > 0 ? size[i] : 0);
      }
      return made;
    }
    case Pair::cast_triangle: {
      Integers u{};
      Integers v{};
      do {
        u = integers(random, 9);
        v = integers(random, 9);
        made.n = cross(u, v);
      } while (made.n == Integers{});
      set(0, corner);
      set(1, moved(corner, std::int64_t{6}, u));
      set(2, moved(corner, std::int64_t{6}, v));
      std::int64_t second = random.between<std::int64_t>(1, 4);
      std::int64_t third = random.between<std::int64_t>(1, 5 - second);
      if (part == Part::edge) {
        const std::size_t where = random.index(4);
        if (where == 0) second = 0;
        if (where == 1) third = 0;
        if (where == 2) third = 6 - second;
        if (where == 3) second = 6, third = 0;
      }
      made.x = moved(moved(corner, second, u), third, v);
      if (random.chance(2)) made.n = {-made.n[0], -made.n[1], -made.n[2]};
      return made;
    }
    case Pair::cast_plane:
      made.n = direction(random, 9);
      made.x = corner;
      set(0, made.n);
      s.size = static_cast<Real>(made.n[0] * corner[0] + made.n[1] * corner[1] + made.n[2] * corner[2]);
      return made;
    default: {
      const Quadruple q = quadruple(random, 3);
      const auto times = random.between<std::int64_t>(2, 5);
      made.n = q.delta;
      made.x = moved(corner, times, q.delta);
      s.size = static_cast<Real>(times * q.d);
      set(0, corner);
      if (kPair == Pair::cast_capsule) {
        // Its side is at right angles to n; the point is beside an end on an edge, and else between.
        const Integers u = across(random, q.delta);
        const auto before = part == Part::edge ? 0 : random.between<std::int64_t>(1, 2);
        set(0, moved(corner, -before, u));
        set(1, moved(corner, 3 - before, u));
        if (random.chance(2)) std::swap(s.v[0], s.v[1]);
      }
      return made;
    }
  }
}

/// Moves the origin by a step of one coordinate so that the ray misses, where one does that; else far back.
template <class Real, Pair kPair>
void step_off(CastIn<Real>& s) {
  const Triple<Real> origin = s.origin;
  for (int steps = 1; steps <= 8; steps *= 2)
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const int step : {-steps, steps}) {
        s.origin = origin;
        s.origin[axis] = ulps_away(origin[axis], step);
        if (!is_hit(s.query(kPair))) return;
      }
  s.origin = moved(origin, -2 * s.length, s.direction);
}
/// So many directions before the point, so many in all.
template <class Real>
void lay(OnSurface<Real>& made, const Integers& d, std::int64_t before, std::int64_t all) {
  made.shapes.direction = placed<Real>(d);
  made.shapes.origin = placed<Real>(moved(made.x, -before, d));
  made.shapes.length = static_cast<Real>(all);
}
std::int64_t along(const Integers& d, const Integers& n) { return d[0] * n[0] + d[1] * n[1] + d[2] * n[2]; }
/// A direction into the shape.
Integers inward(Random& random, const Integers& n) {
  for (;;) {
    Integers d = direction(random, 6);
    if (along(d, n) > 0) d = {-d[0], -d[1], -d[2]};
    if (along(d, n) < 0) return d;
  }
}
template <class Real, Pair kPair>
CastIn<Real> finished(OnSurface<Real>& made, Random& random, bool misses) {
  CastIn<Real>& s = made.shapes;
  any_distances(s, random);
  s.template scale<kPair>(random.between(-20, 20));
  if (misses) step_off<Real, kPair>(s);
  return s;
}

/// Along the surface, exactly: a tangent of what is round, in the plane of what is flat. A fifth one step off.
template <class Real, Pair kPair>
CastIn<Real> grazing_cast(Random& random) {
  auto made = on_surface<Real, kPair>(random, random.turn(3) == 0 ? Part::edge : Part::face);
  if (kPair == Pair::cast_cube)  // along one face of an edge, or of a corner
    for (std::size_t i = 0, seen = 0; i < 3; ++i)
      if (made.n[i] != 0 && seen++ > 0) made.n[i] = 0;
  const Integers d = across(random, made.n);
  const auto before = random.between<std::int64_t>(8, 20);
  lay(made, d, before, before + random.between<std::int64_t>(0, 3));
  if (kPair == Pair::cast_plane) made.shapes.origin = placed<Real>(made.x);
  return finished<Real, kPair>(made, random, random.turn(5) == kMissing);
}

/// Through an edge or a corner, a fifth one step outside.
template <class Real, Pair kPair>
CastIn<Real> edge_cast(Random& random) {
  auto made = on_surface<Real, kPair>(random, Part::edge);
  const auto before = random.between<std::int64_t>(1, 3);
  // Some of them meet nothing but the edge.
  const Integers d = random.turn(3) == 0 ? direction(random, 6) : inward(random, made.n);
  lay(made, d, before, before + random.between<std::int64_t>(1, 3));
  return finished<Real, kPair>(made, random, random.turn(5) == kMissing);
}

/// From the surface, or from inside, outward or inward; two in five from a step outside.
template <class Real, Pair kPair>
CastIn<Real> inside_cast(Random& random) {
  auto made = on_surface<Real, kPair>(random, random.turn(3) == 0 ? Part::edge : Part::face);
  const bool is_solid = kPair != Pair::cast_triangle;
  if (is_solid && random.turn(2) == 0) made.x = moved(made.x, std::int64_t{-1}, made.n);
  const int kind = random.turn(5);
  if (kind >= 3) {
    // Outside by less than a direction, and away or not.
    made.x = moved(made.x, std::int64_t{2}, made.n);
    Integers d = inward(random, made.n);
    if (kind == 3) d = {-d[0], -d[1], -d[2]};
    lay(made, d, 0, 8);
    return finished<Real, kPair>(made, random, false);
  }
  const auto length = random.between<std::int64_t>(0, 3);  // drawn first: a call's arguments are in no order
  lay(made, direction(random, 6), 0, length);
  return finished<Real, kPair>(made, random, false);
}

/// Ends on the surface, a fifth a step before it.
template <class Real, Pair kPair>
CastIn<Real> ending_cast(Random& random) {
  auto made = on_surface<Real, kPair>(random, Part::face);
  const auto all = random.between<std::int64_t>(1, 7);
  lay(made, inward(random, made.n), all, all);
  CastIn<Real> s = finished<Real, kPair>(made, random, false);
  if (random.turn(5) == kMissing) s.length = ulps_away(s.length, -1);
  return s;
}

/// Past the edge of a shape, or up to it, by some steps; most of them searched for wrong decisions of plain arithmetic.
template <class Real, Pair kPair>
CastIn<Real> near_boundary(Random& random) {
  const auto make = [&] {
    CastIn<Real> s;
    const Triple<Real> inside = ordinary_shape<Real, kPair>(s, random);
    s.direction = triple<Real>(random, -4, 4);
    Triple<Real> aim = inside;
    const std::size_t k = random.index(3);
    if (kPair == Pair::cast_sphere || kPair == Pair::cast_capsule) {
      const Triple<Real> other =
          kPair == Pair::cast_sphere || k == 0 ? triple<Real>(random, -1, 1) : moved(s.v[1], Real{-1}, s.v[0]);
      const Triple<Real> side = cross(s.direction, other);
      aim = moved(k == 0 ? s.v[0] : inside, s.size / std::sqrt(dot(side, side)), side);
    } else if (kPair == Pair::cast_cube) {
      aim[k] = s.v[random.index(2)][k];
      aim[(k + 1) % 3] = s.v[random.index(2)][(k + 1) % 3];
    } else if (kPair == Pair::cast_triangle) {
      aim = moved(s.v[k], random.uniform(Real{0.125}, Real{0.875}), moved(s.v[(k + 1) % 3], Real{-1}, s.v[k]));
    } else {
      const Real height = s.size - dot(s.v[0], aim);
      aim = moved(aim, height / dot(s.v[0], s.v[0]), s.v[0]);
      if (dot(s.direction, s.v[0]) > 0)
        for (Real& x : s.direction) x = -x;
    }
    const Real before = random.uniform(Real{0.5}, Real{4});
    s.origin = moved(aim, -before, s.direction);
    s.length = kPair == Pair::cast_plane ? ulps_away(before, random.between(-2, 2)) : 2 * before;
    Real& c = s.origin[random.index(3)];
    c = ulps_away(c, random.between(-2, 2));
    return s;
  };
  CastIn<Real> s = random.turn(4) == 0 ? make() : searched<CastIn, Real>(random, kPair, make);
  any_distances(s, random);
  return s;
}

/// Shapes without a radius, an extent or an inside: hit exactly, a fifth one step beside.
template <class Real, Pair kPair>
CastIn<Real> thin_cast(Random& random) {
  auto made = on_surface<Real, kPair>(random, Part::face);
  CastIn<Real>& s = made.shapes;
  const int kind = random.turn(3);
  if (kPair == Pair::cast_cube) {
    for (int flat = 0; flat <= kind; ++flat) {
      const auto i = static_cast<std::size_t>(flat);
      s.v[0][i] = s.v[1][i] = static_cast<Real>(made.x[i]);
    }
  } else if (kPair == Pair::cast_triangle) {
    made.x = {static_cast<std::int64_t>(s.v[0][0]), static_cast<std::int64_t>(s.v[0][1]),
              static_cast<std::int64_t>(s.v[0][2])};
    const Triple<Real> along = moved(s.v[1], Real{-1}, s.v[0]);
    s.v[2] = kind == 0 ? s.v[1] : moved(s.v[0], kind == 1 ? Real{-0.5} : Real{2}, along);
    if (kind == 0 && random.chance(2)) s.v[1] = s.v[2] = s.v[0];
    std::swap(s.v[0], s.v[random.index(3)]);
  } else {
    // A point, the end of a segment, a place between its ends.
    s.size = 0;
    if (kPair == Pair::cast_capsule && kind == 0) s.v[1] = s.v[0];
    const Real part = kPair == Pair::cast_capsule && kind == 2 ? Real{1} : Real{0};
    for (std::size_t i = 0; i < 3; ++i)
      made.x[i] = static_cast<std::int64_t>(s.v[0][i] + part * ((s.v[1][i] - s.v[0][i]) / 3));
  }
  const auto before = random.between<std::int64_t>(1, 40);
  const auto all = before + random.between<std::int64_t>(0, 3);  // drawn first, as above
  lay(made, direction(random, 6), before, all);
  return finished<Real, kPair>(made, random, random.turn(5) == kMissing);
}

/// t, or a coordinate of the point, half way between two numbers or just beside: along an axis, or nearly.
template <class Real, Pair kPair>
CastIn<Real> ties_of_cast(Random& random) {
  constexpr int kDigits = std::numeric_limits<Real>::digits;
  const std::size_t i = random.index(3);
  const Real sign = random.chance(2) ? Real{1} : Real{-1};
  CastIn<Real> s;
  // The surface is at odd / 2 beside a large number, or t is an odd number beside one.
  const bool of_point = random.turn(2) == 0;
  const auto odd = static_cast<Real>(2 * random.between(1, 40) + 1);
  const Real large = std::ldexp(Real{1}, of_point ? kDigits - 1 : kDigits);
  s.origin[i] = of_point ? sign * (large + static_cast<Real>(random.between(50, 90))) : -sign * large;
  const Real surface = of_point ? sign * (large + 200) : sign * (odd + 200);  // of the shape's far part: a number
  const Real back = of_point ? odd / 2 : Real{200};
  s.direction = {};
  s.direction[i] = sign;
  s.length = std::numeric_limits<Real>::max();
  const auto with = [&](Real x) {
    Triple<Real> v{static_cast<Real>(0), static_cast<Real>(0), static_cast<Real>(0)};
    v[i] = x;
    return v;
  };
  switch (kPair) {
    case Pair::cast_sphere:
    case Pair::cast_capsule:
      s.v[0] = s.v[1] = with(surface);
      s.v[1][(i + 1) % 3] = 64;
      s.size = back;
      break;
    case Pair::cast_cube:
      // A corner is a number: only t can be a tie.
      s.origin[i] = -sign * std::ldexp(Real{1}, kDigits);
      s.v[0] = s.v[1] = with(sign * (odd + static_cast<Real>(2 * random.between(0, 4000))));
      (sign > 0 ? s.v[1] : s.v[0])[i] += sign * 50;
      for (const std::size_t k : {(i + 1) % 3, (i + 2) % 3}) s.v[0][k] = -8, s.v[1][k] = 8;
      break;
    case Pair::cast_triangle:
      // A sloping plane, half way between two of its corners.
      s.v[0] = with(surface - sign * 200);
      s.v[1] = with(surface - sign * 200 + sign * odd);
      s.v[2] = s.v[0];
      s.v[0][(i + 1) % 3] = -16;
      s.v[1][(i + 1) % 3] = 16;
      s.v[2][(i + 2) % 3] = 48;
      if (of_point) s.origin[i] = sign * (large - 4);
      break;
    default:
      s.v[0] = with(-2 * sign);
      s.v[0][(i + 1) % 3] = random.chance(2) ? Real{0} : std::ldexp(Real{1}, -random.between(kDigits / 2, 60));
      s.size = -(of_point ? odd : 2 * odd);
      s.origin[i] = of_point ? Real{0} : -sign * std::ldexp(Real{1}, kDigits);
  }
  // Nearly along the axis: a little beside the tie.
  if (random.turn(3, 2) == 0) s.direction[(i + 2) % 3] = std::ldexp(Real{1}, -random.between(kDigits / 2, 70));
  if (random.turn(5) == kMissing) s.direction[i] = -sign;
  any_distances(s, random);
  return s;
}

template <class Real, Pair kPair>
CastIn<Real> cast_in_other_units(Random& random) {
  CastIn<Real> s = generic_cast<Real, kPair>(random);
  s.template scale<kPair>(random.between(-24, 24));
  // And directions that are not as long as the shapes are large: t is large or small.
  const int longer = random.between(-30, 30);
  for (Real& x : s.direction) x = std::ldexp(x, longer);
  if (s.length < std::numeric_limits<Real>::max()) s.length = std::ldexp(s.length, -longer);
  return s;
}

template <class Real, Pair kPair>
CastIn<Real> far_cast(Random& random) {
  CastIn<Real> s = generic_cast<Real, kPair>(random);
  const Real by = std::ldexp(Real{1}, random.between(10, sizeof(Real) == 8 ? 36 : 14));
  Triple<Real> step{};
  for (Real& x : step) x = random.with_sign(by);
  s.origin = moved(s.origin, Real{1}, step);
  if (kPair == Pair::cast_plane) {
    s.size += dot(s.v[0], step);
  } else {
    for (Triple<Real>& x : s.v) x = moved(x, Real{1}, step);
  }
  return s;
}

template <class Real, Pair kPair>
CastIn<Real> extreme_cast(Random& random) {
  using Limits = std::numeric_limits<Real>;
  CastIn<Real> s = generic_cast<Real, kPair>(random);
  if (random.turn(2) == 0)  // products that overflow
    s.template scale<kPair>(random.between(Limits::max_exponent / 4, Limits::max_exponent - 12));
  else  // products that underflow, and subnormal numbers
    s.template scale<kPair>(random.between(Limits::min_exponent - Limits::digits + 12, Limits::min_exponent / 4));
  return s;
}

template <Pair kPair>
constexpr bool kIsRound = kPair == Pair::cast_sphere || kPair == Pair::cast_capsule;

template <Pair kPair>
std::vector<Family> table() {
  std::vector<Family> all{
      Family{"generic", "from outside at ordinary shapes; of five one passes by, and one ends too early",
             "ordinary numbers: what fails here fails its users, and other families do not say so",
             made<generic_cast<double, kPair>, generic_cast<float, kPair>>, false},
      Family{"from_inside", "from the surface or from inside, exactly, by integers; two in five from outside",
             "many engines see nothing from inside, or answer the way out",
             made<inside_cast<double, kPair>, inside_cast<float, kPair>>, false},
      Family{"ends_at_surface", "up to the surface exactly, by integers; a fifth one step less",
             "strict comparisons with the length, and lengths taken for distances",
             made<ending_cast<double, kPair>, ending_cast<float, kPair>>, false},
      Family{"near_boundary", "by some steps past the edge, or short of it, most of them searched for wrong decisions",
             "plain arithmetic decides most of it wrongly: how often is an engine's measure",
             made<near_boundary<double, kPair>, near_boundary<float, kPair>>, false},
      Family{"ties", "t or a coordinate half way between two numbers or just beside; a fifth turned away",
             "rounding twice, or away from even; and a result that no number of digits decides",
             made<ties_of_cast<double, kPair>, ties_of_cast<float, kPair>>, false},
      Family{"units", "ordinary questions in units from 2^-24 to 2^24, and directions of any length",
             "an absolute epsilon is small in one unit alone; t of a direction that is taken for a unit vector",
             made<cast_in_other_units<double, kPair>, cast_in_other_units<float, kPair>>, false},
      Family{"far_from_origin", "small shapes between large coordinates",
             "coordinates that a smaller format, or a tolerance that grows, cannot hold",
             made<far_cast<double, kPair>, far_cast<float, kPair>>, false},
      Family{"extreme_scale", "products that overflow or underflow, subnormal numbers",
             "overflow and underflow depend on an engine's own order of operations",
             made<extreme_cast<double, kPair>, extreme_cast<float, kPair>>, false},
  };
  if (kPair != Pair::cast_plane)
    all.push_back({"grazing",
                   "along the surface exactly, by integers: tangents, and in the plane of a face; a fifth one "
                   "step off",
                   "a discriminant or a determinant of 0, and a slab that a ray lies in: 0/0",
                   made<grazing_cast<double, kPair>, grazing_cast<float, kPair>>, false});
  if (kIsRound<kPair>)
    all.push_back({"zero_radius", "points and segments, hit exactly, by integers; a fifth one step beside",
                   "divisions by a radius, and a discriminant that rounding makes negative",
                   made<thin_cast<double, kPair>, thin_cast<float, kPair>>, false});
  else if (kPair != Pair::cast_plane)
    all.push_back({"thin", "without an extent or an inside, hit exactly, by integers; a fifth one step beside",
                   "divisions by a length, and normals of length 0",
                   made<thin_cast<double, kPair>, thin_cast<float, kPair>>, false});
  if (kPair != Pair::cast_plane && kPair != Pair::cast_sphere)
    all.push_back({"through_edge",
                   "through an edge or a corner exactly, by integers, where a capsule's side ends too; a "
                   "fifth one step outside",
                   "strict bounds, or any tolerance: an edge that two faces share belongs to both",
                   made<edge_cast<double, kPair>, edge_cast<float, kPair>>, false});
  all.push_back({kInvalidFamily,
                 "each number in turn NaN or infinite, a length negative, the direction 0: it must be refused",
                 "a direction of 0: a check of the numbers one by one forgets it",
                 spoiled<generic_cast<double, kPair>, generic_cast<float, kPair>>, false, true});
  return all;
}

template <Pair kPair>
std::span<const Family> families() {
  static const std::vector<Family> all = table<kPair>();
  return all;
}

}  // namespace
}  // namespace casts_families

std::span<const Family> families_of(const CastAt<Ball>* /*kind*/) {
  return casts_families::families<Pair::cast_sphere>();
}
std::span<const Family> families_of(const CastAt<Box>* /*kind*/) { return casts_families::families<Pair::cast_cube>(); }
std::span<const Family> families_of(const CastAt<Capsule>* /*kind*/) {
  return casts_families::families<Pair::cast_capsule>();
}
std::span<const Family> families_of(const CastAt<Triangle>* /*kind*/) {
  return casts_families::families<Pair::cast_triangle>();
}
std::span<const Family> families_of(const CastAt<Plane>* /*kind*/) {
  return casts_families::families<Pair::cast_plane>();
}

}  // namespace contact::golden
