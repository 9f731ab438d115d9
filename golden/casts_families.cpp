// The families of questions about rays that are cast.
#include "golden/common_families.hpp"

namespace contact::golden {
namespace casts_families {
namespace {

/// A vector that is not 0.
Integers direction_of(Random& random, std::int64_t most) {
  for (;;)
    if (const Integers x = integers(random, most); x != Integers{}) return x;
}
/// One across another.
Integers across(Random& random, const Integers& n) {
  for (;;)
    if (const Integers x = cross(n, integers(random, 4)); x != Integers{}) return x;
}
/// One into a shape, of which n points out.
Integers inward(Random& random, const Integers& n) {
  for (;;) {
    Integers d = direction_of(random, 6);
    if (dot(d, n) > 0) d = moved({}, -1, d);
    if (dot(d, n) < 0) return d;
  }
}

enum class Part { face, edge };  // the round or flat inside of a surface, or where it ends

/// `v` are the numbers of the shape that are vectors: a centre; corners; ends; vertices; the normal of a plane. `size` is
/// a radius, or an offset.
template <class Real, class Target>
struct CastIn : Described<Real, pair_of<Cast, Target>()> {
  static constexpr Pair kPair = pair_of<Cast, Target>();
  using Shapes = CastIn;
  using Limits = std::numeric_limits<Real>;
  static constexpr bool kIsRound = kPair == Pair::cast_sphere || kPair == Pair::cast_capsule;
  static constexpr bool kIsPlane = kPair == Pair::cast_plane;

  Triple<Real> start{};
  Triple<Real> direction{1, 0, 0};
  Real length{1};
  std::array<Triple<Real>, 3> v{};
  Real size{};

  [[nodiscard]] Query query(Pair pair) const {
    CastAt<Target> shapes{};
    shapes.a = {{widened(start), widened(direction), static_cast<double>(length)}};
    std::size_t k = 0;
    for_each_field(shapes.b, [&](const auto& /*field*/, auto& value) {
      if constexpr (std::same_as<std::remove_cvref_t<decltype(value)>, double>)
        value = static_cast<double>(size);
      else
        for_each_vector(value, [&](Vector3& x) { x = widened(v[k++]); });
    });
    return {pair, shapes, this->distances()};
  }
  /// What moves with the shapes; of a plane that is its offset.
  [[nodiscard]] std::vector<Triple<Real>*> points() {
    if (kIsPlane) return {&start};
    return {&start, &v[0], &v[1], &v[2]};
  }
  /// In another unit of length; of a plane the normal stays.
  void scale(int e) {
    for (Triple<Real>* x : points()) lift(e, *x);
    lift(e, direction, size);
  }

  /// Makes a shape of ordinary size, and says a point well inside it.
  Triple<Real> make_ordinary(Random& random) {
    for (Triple<Real>& x : v) x = triple<Real>(random, -4, 4);
    size = random.uniform(Real{0.5}, Real{3});
    switch (kPair) {
      case Pair::cast_cube:
        for (std::size_t i = 0; i < 3; ++i) v[1][i] = v[0][i] + random.uniform(Real{0.5}, Real{4});
        return moved(v[0], random.uniform(Real{0.25}, Real{0.75}), moved(v[1], -1, v[0]));
      case Pair::cast_capsule:
        return moved(v[0], random.uniform(Real{0}, Real{1}), moved(v[1], -1, v[0]));
      case Pair::cast_triangle: {
        const Real second = random.uniform(Real{0.125}, Real{0.75});
        const Real third = random.uniform(Real{0.0625}, Real{0.9375} - second);
        return moved(moved(v[0], second, moved(v[1], -1, v[0])), third, moved(v[2], -1, v[0]));
      }
      case Pair::cast_plane: {
        const Triple<Real> x = triple<Real>(random, -4, 4);
        size = dot(v[0], x) + random.uniform(Real{0.0625}, Real{1});
        return x;
      }
      default:
        return v[0];
    }
  }
  void turn_round() {
    for (Real& x : direction) x = -x;
  }

  /// At ordinary shapes; of five one passes by, and one ends too early.
  static Shapes generic(Random& random) {
    Shapes s;
    Triple<Real> aim = s.make_ordinary(random);
    s.direction = triple<Real>(random, -4, 4);
    // How far out of the shape is surely far enough.
    const Real around = kIsRound ? s.size + Real{0.25} : Real{12};
    const int kind = random.turn(5);
    if (kind == kMissing && !kIsPlane) {
      const Triple<Real> side = cross(s.direction, triple<Real>(random, -1, 1));
      aim = moved(aim, random.uniform(Real{1}, Real{2}) * around / std::sqrt(dot(side, side)), side);
    }
    if (kIsPlane && (kind == kMissing) == (dot(s.v[0], s.direction) < 0)) s.turn_round();
    // Far enough back to be outside.
    const Real times = 2 * (around + 4) / std::sqrt(dot(s.direction, s.direction));
    s.start = moved(aim, kIsPlane && kind == kMissing ? 2 * times : -times, s.direction);
    s.length = kind == 4          ? times / random.uniform(Real{16}, Real{64})
               : random.chance(4) ? Limits::max()
                                  : times * random.uniform(Real{1}, Real{4});
    random_distances(s, random, 4, 4);
    return s;
  }

  /// A shape in integers, a point on its surface, and a direction out of it there.
  struct OnSurface {
    Shapes shapes;
    Integers x{};
    Integers n{};

    /// So many directions before the point, so many in all.
    void lay(const Integers& d, std::int64_t before, std::int64_t all) {
      shapes.direction = placed<Real>(d);
      shapes.start = placed<Real>(moved(x, -before, d));
      shapes.length = static_cast<Real>(all);
    }
    Shapes finished(Random& random, bool misses) {
      Shapes& s = shapes;
      random_distances(s, random, 4, 4);
      s.scale(random.between(-20, 20));
      if (misses) step_off(s);
      return s;
    }
  };
  static OnSurface on_surface(Random& random, Part part) {
    OnSurface made;
    Shapes& s = made.shapes;
    const auto corner = integers(random, kIsWide<Real> ? 1 << 20 : 1 << 9);
    const auto set = [&](std::size_t k, const Integers& x) { s.v[k] = placed<Real>(x); };
    switch (kPair) {
      case Pair::cast_cube: {
        Integers size{};
        for (std::int64_t& c : size) c = 2 * random.between<std::int64_t>(1, 9);
        set(0, corner);
        set(1, moved(corner, 1, size));
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
        set(1, moved(corner, 6, u));
        set(2, moved(corner, 6, v));
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
        if (random.chance(2)) made.n = moved({}, -1, made.n);
        return made;
      }
      case Pair::cast_plane:
        made.n = direction_of(random, 9);
        made.x = corner;
        set(0, made.n);
        s.size = static_cast<Real>(dot(made.n, corner));
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

  /// Along the surface, exactly: a tangent of what is round, in the plane of what is flat. A fifth one step off.
  static Shapes grazing(Random& random) {
    OnSurface made = on_surface(random, random.turn(3) == 0 ? Part::edge : Part::face);
    if (kPair == Pair::cast_cube)  // along one face of an edge, or of a corner
      for (std::size_t i = 0, seen = 0; i < 3; ++i)
        if (made.n[i] != 0 && seen++ > 0) made.n[i] = 0;
    const Integers d = across(random, made.n);
    const auto before = random.between<std::int64_t>(8, 20);
    made.lay(d, before, before + random.between<std::int64_t>(0, 3));
    return made.finished(random, random.turn(5) == kMissing);
  }

  /// Through an edge or a corner, a fifth one step outside.
  static Shapes through_edge(Random& random) {
    OnSurface made = on_surface(random, Part::edge);
    const auto before = random.between<std::int64_t>(1, 3);
    // Some of them meet nothing but the edge.
    const Integers d = random.turn(3) == 0 ? direction_of(random, 6) : inward(random, made.n);
    made.lay(d, before, before + random.between<std::int64_t>(1, 3));
    return made.finished(random, random.turn(5) == kMissing);
  }

  /// From the surface, or from inside, outward or inward; two in five from a step outside.
  static Shapes from_inside(Random& random) {
    OnSurface made = on_surface(random, random.turn(3) == 0 ? Part::edge : Part::face);
    const bool is_solid = kPair != Pair::cast_triangle;
    if (is_solid && random.turn(2) == 0) made.x = moved(made.x, -1, made.n);
    const int kind = random.turn(5);
    if (kind >= 3) {
      // Outside by less than a direction, and away or not.
      made.x = moved(made.x, 2, made.n);
      made.lay(moved({}, kind == 3 ? -1 : 1, inward(random, made.n)), 0, 8);
    } else {
      const auto length = random.between<std::int64_t>(0, 3);  // drawn first: a call's arguments are in no order
      made.lay(direction_of(random, 6), 0, length);
    }
    return made.finished(random, false);
  }

  /// Ends on the surface, a fifth a step before it.
  static Shapes ends_at_surface(Random& random) {
    OnSurface made = on_surface(random, Part::face);
    const auto all = random.between<std::int64_t>(1, 7);
    made.lay(inward(random, made.n), all, all);
    Shapes s = made.finished(random, false);
    if (random.turn(5) == kMissing) step(s.length, -1);
    return s;
  }

  /// Past the edge of a shape, or up to it, by some steps; most of them searched for wrong decisions of plain
  /// arithmetic.
  static Shapes near_boundary(Random& random) {
    const auto make = [&] {
      Shapes s;
      const Triple<Real> inside = s.make_ordinary(random);
      s.direction = triple<Real>(random, -4, 4);
      Triple<Real> aim = inside;
      const std::size_t k = random.index(3);
      if (kIsRound) {
        const Triple<Real> other =
            kPair == Pair::cast_sphere || k == 0 ? triple<Real>(random, -1, 1) : moved(s.v[1], -1, s.v[0]);
        const Triple<Real> side = cross(s.direction, other);
        aim = moved(k == 0 ? s.v[0] : inside, s.size / std::sqrt(dot(side, side)), side);
      } else if (kPair == Pair::cast_cube) {
        aim[k] = s.v[random.index(2)][k];
        aim[(k + 1) % 3] = s.v[random.index(2)][(k + 1) % 3];
      } else if (kPair == Pair::cast_triangle) {
        aim = moved(s.v[k], random.uniform(Real{0.125}, Real{0.875}), moved(s.v[(k + 1) % 3], -1, s.v[k]));
      } else {
        const Real height = s.size - dot(s.v[0], aim);
        aim = moved(aim, height / dot(s.v[0], s.v[0]), s.v[0]);
        if (dot(s.direction, s.v[0]) > 0) s.turn_round();
      }
      const Real before = random.uniform(Real{0.5}, Real{4});
      s.start = moved(aim, -before, s.direction);
      s.length = kIsPlane ? ulps_away(before, random.between(-2, 2)) : 2 * before;
      Real& c = s.start[random.index(3)];
      step(c, random.between(-2, 2));
      return s;
    };
    Shapes s = random.turn(4) == 0 ? make() : searched(random, make);
    random_distances(s, random, 4, 4);
    return s;
  }

  /// Shapes without a radius, an extent or an inside: hit exactly, a fifth one step beside.
  static Shapes thin(Random& random) {
    OnSurface made = on_surface(random, Part::face);
    Shapes& s = made.shapes;
    const auto aim_at = [&](const Triple<Real>& x) {
      for (std::size_t i = 0; i < 3; ++i) made.x[i] = static_cast<std::int64_t>(x[i]);
    };
    const int kind = random.turn(3);
    if (kPair == Pair::cast_cube) {
      for (int flat = 0; flat <= kind; ++flat) {
        const auto i = static_cast<std::size_t>(flat);
        s.v[0][i] = s.v[1][i] = static_cast<Real>(made.x[i]);
      }
    } else if (kPair == Pair::cast_triangle) {
      aim_at(s.v[0]);
      const Triple<Real> along = moved(s.v[1], -1, s.v[0]);
      s.v[2] = kind == 0 ? s.v[1] : moved(s.v[0], kind == 1 ? Real{-0.5} : Real{2}, along);
      if (kind == 0 && random.chance(2)) s.v[1] = s.v[2] = s.v[0];
      std::swap(s.v[0], s.v[random.index(3)]);
    } else {
      // A point, the end of a segment, a place between its ends.
      s.size = 0;
      if (kPair == Pair::cast_capsule && kind == 0) s.v[1] = s.v[0];
      Triple<Real> third = moved(s.v[1], -1, s.v[0]);
      for (Real& x : third) x /= 3;
      aim_at(kPair == Pair::cast_capsule && kind == 2 ? moved(s.v[0], 1, third) : s.v[0]);
    }
    const auto before = random.between<std::int64_t>(1, 40);
    const auto all = before + random.between<std::int64_t>(0, 3);  // drawn first, as above
    made.lay(direction_of(random, 6), before, all);
    return made.finished(random, random.turn(5) == kMissing);
  }

  /// t, or a coordinate of the point, half way between two numbers or just beside: along an axis, or nearly.
  static Shapes ties(Random& random) {
    constexpr int kDigits = Limits::digits;
    const std::size_t i = random.index(3);
    const Real sign = random.chance(2) ? Real{1} : Real{-1};
    Shapes s;
    // The surface is at odd / 2 beside a large number, or t is an odd number beside one.
    const bool of_point = random.turn(2) == 0;
    const auto odd = static_cast<Real>(2 * random.between(1, 40) + 1);
    const Real large = std::ldexp(Real{1}, of_point ? kDigits - 1 : kDigits);
    s.start[i] = of_point ? sign * (large + static_cast<Real>(random.between(50, 90))) : -sign * large;
    const Real surface = of_point ? sign * (large + 200) : sign * (odd + 200);  // of the shape's far part: a number
    const Real back = of_point ? odd / 2 : Real{200};
    s.direction = {};
    s.direction[i] = sign;
    s.length = Limits::max();
    const auto with = [&](Real x) {
      Triple<Real> vector{};
      vector[i] = x;
      return vector;
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
        s.start[i] = -sign * std::ldexp(Real{1}, kDigits);
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
        if (of_point) s.start[i] = sign * (large - 4);
        break;
      default:
        s.v[0] = with(-2 * sign);
        s.v[0][(i + 1) % 3] = random.chance(2) ? Real{0} : std::ldexp(Real{1}, -random.between(kDigits / 2, 60));
        s.size = -(of_point ? odd : 2 * odd);
        s.start[i] = of_point ? Real{0} : -sign * std::ldexp(Real{1}, kDigits);
    }
    // Nearly along the axis: a little beside the tie.
    if (random.turn(3, 2) == 0) s.direction[(i + 2) % 3] = std::ldexp(Real{1}, -random.between(kDigits / 2, 70));
    if (random.turn(5) == kMissing) s.direction[i] = -sign;
    random_distances(s, random, 4, 4);
    return s;
  }

  static Shapes units(Random& random) {
    Shapes s = other_units<Shapes>(random);
    // And directions that are not as long as the shapes are large: t is large or small.
    const int longer = random.between(-30, 30);
    lift(longer, s.direction);
    if (s.length < Limits::max()) lift(-longer, s.length);
    return s;
  }

  static Shapes far_from_origin(Random& random) {
    Shapes s = generic(random);
    const Triple<Real> by = move_far(s, random, kIsWide<Real> ? 36 : 14);
    if (kIsPlane) s.size += dot(s.v[0], by);
    return s;
  }

  static Shapes extreme_scale(Random& random) {
    Shapes s = generic(random);
    if (random.turn(2) == 0)  // products that overflow
      s.scale(random.between(Limits::max_exponent / 4, Limits::max_exponent - 12));
    else  // products that underflow, and subnormal numbers
      s.scale(random.between(Limits::min_exponent - Limits::digits + 12, Limits::min_exponent / 4));
    return s;
  }
};

template <class Target>
std::span<const Family> families(const CastAt<Target>* /*kind*/) {
  using D = CastIn<double, Target>;
  using F = CastIn<float, Target>;
  static const std::vector<Family> all = without_gaps({
      {"generic", "from outside at ordinary shapes; of five one passes by, and one ends too early", kOrdinary,
       made<D::generic, F::generic>},
      {"from_inside", "from the surface or from inside, exactly, by integers; two in five from outside",
       "many engines see nothing from inside, or answer the way out", made<D::from_inside, F::from_inside>},
      {"ends_at_surface", "up to the surface exactly, by integers; a fifth one step less",
       "strict comparisons with the length, and lengths taken for distances",
       made<D::ends_at_surface, F::ends_at_surface>},
      {"near_boundary", "by some steps past the edge, or short of it, most of them searched for wrong decisions",
       kOftenWrong, made<D::near_boundary, F::near_boundary>},
      {"ties", "t or a coordinate half way between two numbers or just beside; a fifth turned away", kRoundingTwice,
       made<D::ties, F::ties>},
      {"units", "ordinary questions in units from 2^-24 to 2^24, and directions of any length",
       "an absolute epsilon is small in one unit alone; t of a direction that is taken for a unit vector",
       made<D::units, F::units>},
      {"far_from_origin", "small shapes between large coordinates", kTooCoarse,
       made<D::far_from_origin, F::far_from_origin>},
      {"extreme_scale", "products that overflow or underflow, subnormal numbers", kOrderOfOperations,
       made<D::extreme_scale, F::extreme_scale>},
      where(!D::kIsPlane,
            {"grazing",
             "along the surface exactly, by integers: tangents, and in the plane of a face; a fifth one step off",
             "a discriminant or a determinant of 0, and a slab that a ray lies in: 0/0", made<D::grazing, F::grazing>}),
      where(!D::kIsPlane,
            {D::kIsRound ? "zero_radius" : "thin",
             D::kIsRound ? "points and segments, hit exactly, by integers; a fifth one step beside"
                         : "without an extent or an inside, hit exactly, by integers; a fifth one step beside",
             D::kIsRound ? "divisions by a radius, and a discriminant that rounding makes negative"
                         : "divisions by a length, and normals of length 0",
             made<D::thin, F::thin>}),
      where(!D::kIsPlane && D::kPair != Pair::cast_sphere,
            {"through_edge",
             "through an edge or a corner exactly, by integers, where a capsule's side ends too; a fifth one step "
             "outside",
             "strict bounds, or any tolerance: an edge that two faces share belongs to both",
             made<D::through_edge, F::through_edge>}),
      CommonRows<D, F>::invalid(
          "each number in turn NaN or infinite, a length negative, the direction 0: it must be refused",
          "a direction of 0: a check of the numbers one by one forgets it"),
  });
  return all;
}

}  // namespace
}  // namespace casts_families

std::span<const Family> families_of(const CastAt<Ball>* kind) { return casts_families::families(kind); }
std::span<const Family> families_of(const CastAt<Box>* kind) { return casts_families::families(kind); }
std::span<const Family> families_of(const CastAt<Capsule>* kind) { return casts_families::families(kind); }
std::span<const Family> families_of(const CastAt<Triangle>* kind) { return casts_families::families(kind); }
std::span<const Family> families_of(const CastAt<Plane>* kind) { return casts_families::families(kind); }

}  // namespace contact::golden
