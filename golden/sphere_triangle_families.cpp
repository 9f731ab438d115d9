// The families of questions about a sphere and a triangle.
#include "golden/common_families.hpp"
#include "golden/plain_triangles.hpp"

namespace contact::golden {
namespace sphere_triangle_families {
namespace {

/// Which part of a triangle is nearest; each vertex and each edge in turn.
enum class Part { vertex, edge, face };
struct PartOfTriangle {
  Part part;
  std::size_t first;  ///< the vertex, or the one that the edge begins at
};
PartOfTriangle turn_of_parts(Random& random) {
  const int turn = random.turn(7);
  const auto first = static_cast<std::size_t>(turn % 3);
  return {turn < 3 ? Part::vertex : turn < 6 ? Part::edge : Part::face, turn < 6 ? first : random.index(3)};
}

/// The three points so that the first one is the one of that number; the others in either order. Of an edge, which is
/// from the first point to the second, these two are.
template <class Real>
Vertices<Real> numbered(Random& random, PartOfTriangle which, Vertices<Real> v) {
  const std::size_t turned = which.part == Part::edge ? 0 : 1;
  if (random.chance(2)) std::swap(v[turned], v[turned + 1]);
  std::rotate(v.begin(), v.end() - static_cast<std::ptrdiff_t>(which.first), v.end());
  return v;
}

/// How a triangle lies to the shortest way there: leaning away where it may, or all of it at right angles.
enum class Lie { leaning, level };

/// The second radius is a share of the sphere's.
template <class Real>
struct SphereTriangle : Described<Real, Pair::sphere_triangle> {
  using Shapes = SphereTriangle;
  static constexpr int kDigits = std::numeric_limits<Real>::digits;

  Triple<Real> center{};
  Radius<Real> a{};
  Radius<Real> b{};
  Vertices<Real> vertices{};

  [[nodiscard]] Query query(Pair pair) const {
    return {pair, BallAndTriangle{ball(center, a.radius + b.radius), triangle(vertices)}, this->distances()};
  }
  [[nodiscard]] std::array<Triple<Real>*, 4> points() { return {&center, &vertices[0], &vertices[1], &vertices[2]}; }
  /// Between the centre and the triangle, in plain arithmetic.
  [[nodiscard]] Real distance() const {
    const Triple<Real> delta = moved(nearest_point(center, vertices), -1, center);
    return std::sqrt(dot(delta, delta));
  }
  void scale(int e) {
    lift(e, center, vertices[0], vertices[1], vertices[2], a.radius, b.radius, this->alarm, this->contact);
  }

  static Shapes beside(Random& random) {
    const PartOfTriangle which = turn_of_parts(random);
    Shapes s;
    s.center = triple<Real>(random, -10, 10);
    const Triple<Real> delta = triple<Real>(random, -4, 4);
    const Triple<Real> q = moved(s.center, 1, delta);
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
      made = {moved(q, -size(), u), moved(q, size(), u), moved(q, 1, away())};
    } else {
      made = {q, moved(q, 1, away()), moved(q, 1, away())};
    }
    s.vertices = numbered(random, which, made);
    return s;
  }

  static Shapes generic(Random& random) {
    Shapes s = beside(random);
    s.a.radius = random.uniform(Real{0.5}, Real{6});
    random_distances(s, random);
    return s;
  }

  static Shapes mixed(Random& random) {
    Shapes s = generic(random);
    any_magnitudes<Real>(random, {&s.center, &s.vertices[0], &s.vertices[1], &s.vertices[2]}, {&s.a.radius});
    any_distances(s, random);
    return s;
  }

  /// A triangle on a grid and exactly an integer from a centre, along the third row of a frame; `meeting` makes it 0.
  /// The nearest point is on the grid too, but half of those on a leaning edge or a face are fractions that no scalar
  /// holds.
  static Exactly<Shapes> on_frame(Random& random, const PartOfTriangle& which, Lie lie, bool meeting = false) {
    const Lattice<Real> grid(random, meeting);
    Exactly<Shapes> made{{}, grid.height * grid.frame.length, grid.frame};
    const auto upward = [&] { return lie == Lie::level ? 0 : random.between<std::int64_t>(0, grid.steps); };
    const auto any = [&] { return random.between(-grid.steps, grid.steps); };
    const auto size = [&] { return random.between<std::int64_t>(1, kIsWide<Real> ? 8 : 4); };
    // The vertices in steps along the rows, and where the last step is from: the nearest point, or one beside it.
    std::array<Integers, 3> at{};
    Integers from = grid.frame.at({0, 0, grid.height});
    const auto at_a_fraction = [&] {
      const auto found = grid.frame.between_grid_points(grid.height);
      if (found) from = *found, made.distance = grid.height;
      return found.has_value();
    };
    if (which.part == Part::vertex) {
      at = {Integers{}, {any(), any(), upward()}, {any(), any(), upward()}};
    } else if (which.part == Part::edge) {
      const bool fraction = !meeting && random.chance(2) && at_a_fraction();
      Integers along = {any(), fraction ? 0 : any(), 0};
      if (along[0] == 0) along[0] = 1;
      // The foot is less than a step from there.
      at = {moved({}, -size(), along), moved({}, size(), along), {any(), any(), upward()}};
    } else {
      if (!meeting && random.chance(2)) at_a_fraction();
      // Around all feet that there may be: those less than a step from there, on both rows.
      const auto more = [&] { return random.between<std::int64_t>(0, 3); };
      const std::int64_t x = more();
      const std::int64_t y = more();
      at = {Integers{-3 - more(), -3 - more(), 0}, {4 + y + more(), -2 - y, 0}, {-2 - x, 4 + x + more(), 0}};
    }
    const Integers center = integers(random, kIsWide<Real> ? 1 << 24 : 1 << 10);
    made.shapes.center = placed<Real>(center);
    Vertices<Real> vertices;
    for (std::size_t k = 0; k < 3; ++k)
      vertices[k] = placed<Real>(moved(moved(center, 1, from), 1, grid.frame.at(at[k])));
    made.shapes.vertices = numbered(random, which, vertices);
    return made;
  }
  static Exactly<Shapes> exactly_apart(Random& random) { return on_frame(random, turn_of_parts(random), Lie::leaning); }

  /// Where one region ends and the next begins: the foot on the face's plane exactly on a vertex or an edge, one
  /// coordinate moved by an ulp or not.
  static Shapes region_edge(Random& random) {
    PartOfTriangle which = turn_of_parts(random);
    if (which.part == Part::face) which.part = Part::edge;
    Shapes s = on_frame(random, which, Lie::level).shapes;
    Real& x = (*s.points()[random.index(4)])[random.index(3)];
    step(x, random.between(-1, 1));
    reach_or_not(s, random);
    return s;
  }

  /// The foot on the plane in line with a vertex, or with an edge, along an axis or a diagonal: who counts the edges
  /// that a ray in the plane crosses counts two or none of them there. On a grid.
  static Shapes aligned(Random& random) {
    const int kind = random.turn(6);
    // Along `ahead` there is a vertex; one axis, or two of them.
    Integers ahead{};
    const std::size_t axis = random.index(3);
    ahead[axis] = random.with_sign(std::int64_t{1});
    if (random.turn(3, 6) == 0) ahead[(axis + 1) % 3] = random.with_sign(std::int64_t{1});
    Integers beside{};
    Integers normal{};
    while (normal == Integers{}) {
      beside = integers(random, 2);
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
    const Integers foot = integers(random, 200);
    Vertices<Real> made;
    for (std::size_t k = 0; k < 3; ++k) made[k] = placed<Real>(moved(moved(foot, at[k][0], ahead), at[k][1], beside));
    Shapes s;
    s.vertices = numbered(random, {Part::vertex, random.index(3)}, made);
    const std::int64_t height = random.between<std::int64_t>(1, 3);
    s.center = placed<Real>(moved(foot, random.with_sign(height), normal));
    reach_or_not(s, random);
    return s;
  }

  /// Slivers an ulp wide, three points on a line, and triangles that are one or two points.
  static Shapes thin(Random& random) {
    const int kind = random.turn(5, 7);
    Shapes s = exactly_apart(random).shapes;
    auto& [x, y, z] = s.vertices;
    const auto part = static_cast<Real>(random.between(-4, 12)) / Real{8};
    switch (kind) {
      case 0: {  // a sliver: the third vertex beside the line of the others
        z = moved(x, part, moved(y, -1, x));
        const int ulps = random.chance(2) ? 1 : -1;
        const std::size_t from = random.index(3);
        z[random.index(3)] = ulps_away(z[from], ulps);
        break;
      }
      case 1:  // on the line, in whichever order
        z = moved(x, part * Real{8}, moved(y, -1, x));
        break;
      case 2:
        z = random.chance(2) ? x : y;
        break;
      case 3:
        y = z = x;
        break;
      default:  // a needle: two vertices ulps apart
        z = x;
        for (Real& i : z) step(i, random.between(-1, 1));
        break;
    }
    s.vertices = numbered(random, {Part::vertex, random.index(3)}, s.vertices);
    if (random.turn(5) == 0) s.center = s.vertices[random.index(3)];
    s.contact = any_or_none<Real>(random, 1);
    if (s.distance() == 0)
      s.a.radius = random.uniform(Real{0.5}, Real{6});
    else
      reach_somehow(s, random, kind != 0 && random.chance(2));
    return s;
  }

  /// The centre on the face, an edge or a vertex. A fifth of them moved off it by an ulp of the largest coordinate,
  /// without a radius.
  static Shapes on_triangle(Random& random) {
    const Lie lie = random.chance(2) ? Lie::level : Lie::leaning;
    auto [s, distance, frame] = on_frame(random, turn_of_parts(random), lie, true);
    if (random.turn(5) == kMissing) {
      const Integers& normal = frame.rows[2];
      const std::size_t axis = main_axis(normal);
      s.center[axis] += std::copysign(largest_ulp(s), normal[axis] < 0 ? Real{1} : Real{-1});
      return s;
    }
    if (random.turn(4, 5) != 0) s.a.radius = random.uniform(Real{0.5}, Real{6});
    random_distances(s, random);
    sometimes_extreme(s, random);
    return s;
  }

  /// Numbers half way between two neighbours, and beside that by the least there is: the value of an exact distance, or
  /// a nearest point in the middle of an edge, which is a triangle without an inside.
  static Shapes ties(Random& random) {
    const Real least = random.chance(4) ? Real{0} : std::numeric_limits<Real>::denorm_min();
    const bool missing = random.turn(5) == kMissing;
    Shapes s;
    if (random.turn(2) == 0) {
      s = tie_of_value<Shapes>(random, missing);
      s.contact = least;
      return s;
    }
    // Along (1, 2, 0) from a coordinate so large that the middle does not fit, and away from the centre.
    const Real large = std::ldexp(Real{1}, kDigits - 1) + static_cast<Real>(random.between(100, 10000));
    const auto odd = static_cast<Real>(2 * random.between(0, 40) + 1);
    const auto off = static_cast<Real>(2 * random.between(-20, 20) + 1);
    const auto height = static_cast<Real>(random.between(1, 20));
    s.center = {large + (odd + off) / 2, odd - off / 4, height};
    const Triple<Real> start{large, 0, 0};
    s.vertices = {start, {large + odd, 2 * odd, 0}, moved(start, -2, {off / 2, -off / 4, height})};
    s.a.radius = s.distance() * enough<Real>(random, !missing, Real{1.0625});
    turn_axes(s, random);
    s.vertices = numbered(random, {Part::vertex, random.index(3)}, s.vertices);
    s.contact = any_or_none<Real>(random, 1);
    return s;
  }
};

using D = SphereTriangle<double>;
using F = SphereTriangle<float>;
using Rows = CommonRows<D, F>;

constexpr Family kFamilies[] = {
    {"generic", "a sphere beside each vertex, each edge and the face in turn, on either side", kOrdinary,
     made<D::generic, F::generic>},
    {"touching",
     "exactly touching at a vertex, an edge or the face, by integers on orthogonal frames; half searched for "
     "squares that round apart; a fifth one ulp short",
     kInEveryCase, made<touching<D>, touching<F>>},
    Rows::kNearTouching,
    Rows::alarm_edge("alarm, contact and radius differ: no two of them can be confused unseen"),
    {"region_edge", "the foot on the plane exactly on a vertex or an edge, or one ulp beside it",
     "which feature is nearest is decided by a sign that is 0 or nearly so", made<D::region_edge, F::region_edge>},
    {"aligned",
     "the foot on the plane in line with a vertex or an edge, along an axis or a diagonal; half of them inside",
     "who counts the edges that a ray in the plane crosses, to find the face, counts two or none at a vertex",
     made<D::aligned, F::aligned>},
    {"thin", "slivers, needles, three points on a line, two points and one; a fifth of the centres on a vertex",
     "a normal of length 0, or of rounding errors alone", made<D::thin, F::thin>},
    {"on_triangle", "the centre on the face, an edge or a vertex; a fifth one ulp beside it, without a radius",
     kNoDirection, made<D::on_triangle, F::on_triangle>},
    {"ties", "the value, or a nearest point in the middle of an edge, half way between two numbers or just beside",
     kRoundingTwice, made<D::ties, F::ties>},
    Rows::units("an absolute epsilon, of a length, an area or a determinant, is small in one unit alone"),
    Rows::kFarFromOrigin,
    Rows::extreme_scale(),
    Rows::invalid("each number in turn NaN or infinite, the radius negative: it must be refused",
                  "nine numbers of three points: a check of one of them forgets the others"),
};

}  // namespace
}  // namespace sphere_triangle_families

std::span<const Family> families_of(const BallAndTriangle* /*kind*/) { return sphere_triangle_families::kFamilies; }

}  // namespace contact::golden
