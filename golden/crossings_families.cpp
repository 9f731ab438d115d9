// The families of questions about a ray or a line that crosses a triangle, or passes it.
#include "golden/common_families.hpp"
#include "golden/plain_triangles.hpp"

namespace contact::golden {
namespace crossings_families {
namespace {

enum class Where { vertex, edge, inside };

/// A segment from `start`, `length` times `direction`; a line ends at what that rounds to. The two distances have no
/// say.
template <class Real, Pair kPair>
struct Crossing : Described<Real, kPair> {
  using Shapes = Crossing;
  using Limits = std::numeric_limits<Real>;
  static constexpr int kRoom = 10;

  Triple<Real> start{};
  Triple<Real> direction{};
  Real length{1};
  Vertices<Real> vertices{};

  [[nodiscard]] Query query(Pair pair) const {
    if (kPair == Pair::triangle_line) {
      const Line line{widened(start), widened(moved(start, length, direction))};
      return {pair, TriangleAndLine{triangle(vertices), line}, this->distances()};
    }
    // A ray has a direction, also where its length is 0.
    const bool none = direction == Triple<Real>{};
    const Ray ray{widened(start), widened(none ? Triple<Real>{1, 2, -2} : direction),
                  none ? 0 : static_cast<double>(length)};
    return {pair, RayAndTriangle{ray, triangle(vertices)}, this->distances()};
  }
  [[nodiscard]] std::array<Triple<Real>*, 4> points() { return {&start, &vertices[0], &vertices[1], &vertices[2]}; }
  void scale(int e) { lift(e, start, vertices[0], vertices[1], vertices[2], direction, this->alarm, this->contact); }

  /// A point of the plane of the triangle by the weights of its second and third vertex.
  [[nodiscard]] Triple<Real> at_weights(Real second, Real third) const {
    const auto& [x, y, z] = vertices;
    return moved(moved(x, second, moved(y, -1, x)), third, moved(z, -1, x));
  }

  /// Through or beside an ordinary triangle: two in five miss it, past an edge or short of the plane.
  static Shapes generic(Random& random) {
    Shapes s;
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
    s.direction = triple<Real>(random, -4, 4);
    s.length = random.chance(2) ? random.uniform(Real{0.5}, Real{4}) : Real{1};
    Real part = random.uniform(Real{0.0625}, Real{0.9375});
    if (kind == 4) part = random.chance(2) ? -part : 1 + part;
    s.start = moved(s.at_weights(second, third), -part * s.length, s.direction);
    random_distances(s, random, 4, 4);
    return s;
  }

  /// Each axis in units of its own: what crosses still does.
  static Shapes mixed(Random& random) {
    Shapes s = generic(random);
    const auto stretch = [&] { return random.between(Limits::min_exponent / 2 + 8, Limits::max_exponent / 2 - 8); };
    const std::array<int, 3> exponents{stretch(), stretch(), stretch()};
    for (std::size_t i = 0; i < 3; ++i) {
      for (Triple<Real>* v : s.points()) lift(exponents[i], (*v)[i]);
      lift(exponents[i], s.direction[i]);
    }
    return s;
  }

  /// Integers: a point x of the plane of a triangle, and a direction across it. The edges from the first vertex are
  /// multiples of two vectors, so that points of the edges, of the inside and beyond are on the grid.
  struct OnGrid {
    Shapes shapes;
    Integers x{};
    Integers d{};

    /// From so many directions before x, so many in all.
    void lay(std::int64_t before, std::int64_t all) {
      shapes.start = placed<Real>(moved(x, -before, d));
      shapes.length = static_cast<Real>(all);
    }
  };
  static OnGrid on_grid(Random& random, Where where) {
    const std::int64_t size = kIsWide<Real> && random.chance(2) ? 1 << 19 : 12;
    OnGrid made;
    Integers u{};
    Integers v{};
    do {
      u = integers(random, size);
      v = integers(random, size);
      made.d = integers(random, size);
    } while (dot(cross(u, v), made.d) == 0);
    const std::int64_t times = 2 * random.between<std::int64_t>(2, 6);  // u and v are as long as that many steps
    const Integers corner = integers(random, kIsWide<Real> ? 1 << 24 : 1 << 10);
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
    Shapes& s = made.shapes;
    const std::size_t first = random.index(3);
    s.vertices[first] = placed<Real>(corner);
    s.vertices[(first + 1) % 3] = placed<Real>(moved(corner, times, u));
    s.vertices[(first + 2) % 3] = placed<Real>(moved(corner, times, v));
    if (random.chance(2)) std::swap(s.vertices[0], s.vertices[1]);
    s.direction = placed<Real>(made.d);
    random_distances(s, random, 4, 4);
    return made;
  }

  /// Through an edge or a vertex, exactly; a fifth one step outside.
  static Shapes through_boundary(Random& random) {
    OnGrid made = on_grid(random, random.turn(3) == 0 ? Where::vertex : Where::edge);
    const auto before = random.between<std::int64_t>(1, 3);
    made.lay(before, before + random.between<std::int64_t>(1, 3));
    return scaled_or_missed(made.shapes, random);
  }

  /// A start or an end on the triangle, exactly; a fifth one step short of it.
  static Shapes end_on_triangle(Random& random) {
    OnGrid made = on_grid(random, random.turn(3) == 0 ? Where::edge : Where::inside);
    const auto all = random.between<std::int64_t>(1, 4);
    made.lay(random.turn(2) == 0 ? 0 : all, all);
    return scaled_or_missed(made.shapes, random);
  }

  /// Within some steps of the boundary, most of them searched for wrong decisions of plain arithmetic.
  static Shapes near_boundary(Random& random) {
    const auto make = [&] {
      Shapes s;
      for (Triple<Real>& v : s.vertices) v = triple<Real>(random, -4, 4);
      Real second = random.uniform(Real{0.0625}, Real{0.9375});
      Real third = 0;
      const std::size_t edge = random.index(4);
      if (edge == 1) std::swap(second, third);
      if (edge == 2) third = 1 - second;
      if (edge == 3) third = (1 - second) / 2;  // an end on the plane
      s.direction = triple<Real>(random, -4, 4);
      const bool starts = random.chance(2);
      const Real before = edge == 3 ? (starts ? Real{0} : Real{-1}) : random.uniform(Real{-0.9375}, Real{-0.0625});
      s.start = moved(s.at_weights(second, third), before, s.direction);
      Real& c = s.start[random.index(3)];
      step(c, random.between(-2, 2));
      random_distances(s, random, 4, 4);
      return s;
    };
    return random.turn(4) == 0 ? make() : searched(random, make);
  }

  /// In the plane of the triangle, exactly, which is no crossing; most of them with ends a step above and below it.
  static Shapes along_plane(Random& random) {
    const OnGrid made = on_grid(random, Where::inside);
    Shapes s = made.shapes;
    // Along an edge, through the point inside.
    const std::size_t k = random.index(3);
    s.direction = moved(s.vertices[(k + 1) % 3], -1, s.vertices[k]);
    s.length = 2;
    s.start = moved(placed<Real>(made.x), -1, s.direction);
    s.scale(random.between(-20, 20));
    if (random.turn(5) < 2) return s;
    const Shapes level = s;
    for (const int steps : {1, 2, 4, 8, 64})
      for (std::size_t axis = 0; axis < 3; ++axis)
        for (const int sign : {-1, 1}) {
          s = level;
          step(s.start[axis], sign * steps);
          s.direction[axis] -= s.start[axis] - level.start[axis];  // the end is as far on the other side
          if (is_hit(s.query(kPair))) return s;
        }
    return s;
  }

  /// Triangles without an inside and segments without length, which nothing crosses; half of them slivers.
  static Shapes thin(Random& random) {
    if (random.turn(2) == 0) {
      OnGrid made = on_grid(random, Where::inside);
      made.lay(1, 2);
      Shapes& s = made.shapes;
      switch (random.turn(3, 2)) {
        case 0:
          s.vertices[2] = s.vertices[random.index(2)];
          if (random.chance(4)) s.vertices[0] = s.vertices[1];
          break;
        case 1:
          for (std::size_t i = 0; i < 3; ++i) s.vertices[2][i] = (s.vertices[0][i] + s.vertices[1][i]) / 2;
          break;
        default:
          s.start = placed<Real>(made.x);
          s.direction = {};
          s.length = 0;
      }
      return s;
    }
    // The third vertex some steps beside the line of the others, and a segment across.
    Shapes s;
    auto& [x, y, z] = s.vertices;
    x = triple<Real>(random, -4, 4);
    y = triple<Real>(random, -4, 4);
    const Real part = random.uniform(Real{0.25}, Real{0.75});
    const Triple<Real> u = moved(y, -1, x);
    const Triple<Real> aside = cross(u, triple<Real>(random, -1, 1));
    const Real width = random.magnitude<Real>(kIsWide<Real> ? -40 : -16, -8);
    const Triple<Real> on_line = moved(x, part, u);
    z = moved(on_line, width, aside);
    const Triple<Real> crossed = moved(on_line, width * random.uniform(Real{0.125}, Real{0.75}), aside);
    s.direction = cross(u, aside);
    s.start = moved(crossed, random.uniform(Real{-0.75}, Real{-0.25}), s.direction);
    random_distances(s, random, 4, 4);
    return s;
  }

  /// A coordinate of the crossing half way between two numbers, or just beside that.
  static Shapes ties(Random& random) {
    const Real large = std::ldexp(Real{1}, Limits::digits - 1) + static_cast<Real>(random.between(100, 10000));
    const auto odd = static_cast<Real>(2 * random.between(0, 40) + 1);
    const std::size_t up = random.index(3);
    const std::size_t along = (up + 1) % 3;
    const std::size_t aside = (up + 2) % 3;
    const Real sign = random.chance(2) ? Real{1} : Real{-1};
    const auto height = static_cast<Real>(random.between(1, 20));
    Shapes s;
    s.start[along] = sign * large;
    s.start[up] = height;
    s.start[aside] = static_cast<Real>(random.between(-3, 3));
    s.direction[along] = sign * odd;
    s.direction[up] = -2 * height;  // through the plane half way
    const Real away = random.turn(5) == kMissing ? Real{400} : Real{0};
    const auto vertex = [&](Real x, Real y) {
      Triple<Real> v{};
      v[along] = sign * (large + x + away);
      v[aside] = y;
      return v;
    };
    s.vertices = {vertex(-90, -200), vertex(-90, 300), vertex(200, 0)};
    // A plane that is not quite level: the crossing is a little off the middle.
    if (random.chance(2)) s.vertices[2][up] = std::ldexp(Real{1}, -random.between(Limits::digits / 2, 100));
    std::swap(s.vertices[0], s.vertices[random.index(3)]);
    random_distances(s, random, 4, 4);
    return s;
  }

  static Shapes far_from_origin(Random& random) {
    Shapes s = generic(random);
    move_far(s, random, kIsWide<Real> ? 40 : 16);
    return s;
  }
};

template <class A, class B>
std::span<const Family> families(const Two<A, B>* /*kind*/) {
  constexpr Pair kPair = pair_of<A, B>();
  using D = Crossing<double, kPair>;
  using F = Crossing<float, kPair>;
  using Rows = CommonRows<D, F>;
  constexpr bool kOfRay = kPair == Pair::ray_triangle;
  static constexpr Family kFamilies[] = {
      {"generic", "through a triangle, and two in five past an edge or short of the plane", kOrdinary,
       made<D::generic, F::generic>},
      {"through_boundary", "through an edge or a vertex exactly, by integers; a fifth one step outside",
       "strict bounds, or any tolerance: an edge that two triangles share belongs to both",
       made<D::through_boundary, F::through_boundary>},
      {"end_on_triangle", "a start or an end on the triangle exactly, by integers; a fifth one step short",
       "what just reaches the plane, which a strict comparison misses", made<D::end_on_triangle, F::end_on_triangle>},
      {"near_boundary", "some steps from the boundary, most of them searched for wrong decisions of plain arithmetic",
       kOftenWrong, made<D::near_boundary, F::near_boundary>},
      {"along_plane", "in the plane of the triangle exactly, and most with ends a step above and below it",
       "a determinant of 0, or nearly: parallel is no crossing, and one step off it may be",
       made<D::along_plane, F::along_plane>},
      {"thin", "triangles without an inside and segments without length, which nothing crosses; half of them slivers",
       "a normal of length 0, or of rounding errors alone", made<D::thin, F::thin>},
      {"ties", "a coordinate of the crossing half way between two numbers or just beside", kRoundingTwice,
       made<D::ties, F::ties>},
      Rows::units("an absolute epsilon of a determinant is small in one unit alone"),
      {"far_from_origin", "small triangles between large coordinates", kTooCoarse,
       made<D::far_from_origin, F::far_from_origin>},
      Rows::extreme_scale(
          "products that overflow or underflow, an axis much longer than the others, subnormal numbers"),
      kOfRay ? Rows::invalid("each number in turn NaN or infinite, a length negative, the direction 0: it must be "
                             "refused",
                             "a direction of 0: a check of the numbers one by one forgets it")
             : Rows::invalid("each number in turn NaN or infinite, a distance negative: it must be refused",
                             "fifteen numbers of five points: a check of one of them forgets the others"),
  };
  return kFamilies;
}

}  // namespace
}  // namespace crossings_families

std::span<const Family> families_of(const RayAndTriangle* kind) { return crossings_families::families(kind); }
std::span<const Family> families_of(const TriangleAndLine* kind) { return crossings_families::families(kind); }

}  // namespace contact::golden
