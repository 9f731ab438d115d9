// The families of questions about a sphere and a box.
#include "golden/common_families.hpp"

namespace contact::golden {
namespace sphere_cube_families {
namespace {

/// The features that a centre may face, by the number of axes on which it is beyond the box.
enum class Region { inside, face, edge, corner };

template <class Real>
struct SphereAndBox : Described<Real, Pair::sphere_cube> {
  using Shapes = SphereAndBox;
  using Limits = std::numeric_limits<Real>;
  static constexpr int kClasses = 1;
  static constexpr int kAlarmClasses = 1;
  static constexpr int kOverflow = 2;
  Triple<Real> c{};
  Radius<Real> a{};
  Triple<Real> min{};
  Triple<Real> max{};

  [[nodiscard]] Query query(Pair pair) const {
    return {pair, BallAndBox{ball(c, a.radius), {widened(min), widened(max)}}, this->distances()};
  }
  [[nodiscard]] std::array<Triple<Real>*, 3> points() { return {&c, &min, &max}; }
  /// From the centre to the box, in plain arithmetic.
  [[nodiscard]] Real distance() const {
    Real sum{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Real apart = c[i] < min[i] ? min[i] - c[i] : c[i] > max[i] ? c[i] - max[i] : Real{0};
      sum += apart * apart;
    }
    return std::sqrt(sum);
  }
  void scale(int e) {
    lift(e, c, min, max, a.radius, this->alarm, this->contact);
    for (std::size_t i = 0; i < 3; ++i) max[i] = std::max(min[i], max[i]);  // of two zeros the same
  }

  /// A box of ordinary size, anywhere, and a centre that faces a feature, or any from outside, at most `most` beyond
  /// the box on an axis.
  static Shapes facing(Random& random, std::optional<Region> region, Real most) {
    Shapes s;
    s.min = triple<Real>(random, -10, 5);
    for (std::size_t i = 0; i < 3; ++i) s.max[i] = s.min[i] + random.uniform(Real{0.5}, Real{8});
    const int beyond = region ? static_cast<int>(*region) : 1 + static_cast<int>(random.index(3));
    const std::size_t first = random.index(3);
    for (int k = 0; k < 3; ++k) {
      const std::size_t i = (first + static_cast<std::size_t>(k)) % 3;
      if (k < beyond)
        s.c[i] = random.chance(2) ? s.max[i] + random.uniform(Real{0}, most) : s.min[i] - random.uniform(Real{0}, most);
      else
        s.c[i] = s.min[i] + (s.max[i] - s.min[i]) * random.uniform(Real{0.0625}, Real{0.9375});
    }
    return s;
  }

  /// A sphere beside each feature in turn, as often too far away.
  static Shapes generic(Random& random) {
    Shapes s = facing(random, static_cast<Region>(random.turn(4)), 8);
    s.a.radius = random.uniform(Real{0.25}, Real{6});
    random_distances(s, random);
    return s;
  }

  /// A box on integers, and a centre exactly an integer away from a feature of it.
  static Exactly<Shapes> exactly_apart(Random& random) {
    const bool large = random.chance(2);
    const std::int64_t offset = kIsWide<Real> ? 1 << 24 : 1 << 10;
    Quadruple q = quadruple(random, kIsWide<Real> ? (large ? 1 << 18 : 48) : (large ? 120 : 12));
    if (const int region = random.turn(3); region != 2) {  // an edge or a face
      const auto m = random.between<std::int64_t>(1, kIsWide<Real> ? 1 << 20 : large ? 480 : 40);
      const auto n = random.between<std::int64_t>(1, m);
      q = region == 0 ? Quadruple{{m * m - n * n, 2 * m * n, 0}, m * m + n * n} : Quadruple{{m, 0, 0}, m};
      shuffle(q.delta, random);
    }
    Exactly<Shapes> made{{}, q.d};
    Shapes& s = made.shapes;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int64_t at = random.between(-offset, offset);
      const std::int64_t size = random.between<std::int64_t>(0, offset);
      const std::int64_t within = random.between<std::int64_t>(0, size);
      // The bound that faces the centre lies at `at`; without a way to go the centre is between both.
      const std::int64_t low = q.delta[i] > 0 ? at : q.delta[i] < 0 ? at - size : at - within;
      s.c[i] = static_cast<Real>(at - q.delta[i]);
      s.min[i] = static_cast<Real>(low);
      s.max[i] = static_cast<Real>(low + size);
    }
    return made;
  }

  /// A radius of that distance, or what an alarm distance leaves of it.
  static Shapes exactly(Random& random, bool alarmed) {
    Exactly<Shapes> made = exactly_apart(random);
    Shapes& s = made.shapes;
    const std::int64_t total = 16 * made.distance;
    const std::int64_t radius = alarmed ? random.between<std::int64_t>(1, total - 1) : total;
    s.a.radius = sixteenths<Real>(radius);
    s.alarm = sixteenths<Real>(total - radius);
    s.contact = alarmed ? s.alarm / Real{4} : random.chance(2) ? sixteenths<Real>(random.between(0, 32)) : Real{0};
    return s;
  }

  /// A radius that leaves the sphere a few ulps from the box, beside an alarm distance or none.
  static Shapes nearly(Random& random, bool alarmed) {
    Shapes s = facing(random, std::nullopt, 8);
    const Real d = s.distance();
    const int ulps = random.between(-4, 4);
    if (alarmed) {
      s.a.radius = d * random.uniform(Real{0.125}, Real{0.875});
      s.alarm = length(ulps_away(d - s.a.radius, ulps));
      s.contact = s.alarm * random.uniform(Real{0.125}, Real{0.875});
    } else {
      s.a.radius = length(ulps_away(d, ulps));
      s.contact = any_or_none<Real>(random, 1);
    }
    return s;
  }

  /// Where one region ends and the next begins: coordinates of the centre exactly on a bound, or one ulp beside it.
  static Shapes region_edge(Random& random) {
    Shapes s = facing(random, static_cast<Region>(1 + random.turn(3)), 4);
    const std::size_t first = random.index(3);
    for (std::size_t k = 0; k <= random.index(2); ++k) {
      const std::size_t i = (first + k) % 3;
      const auto step = random.between(-1, 1);  // drawn first: a call's arguments are in no order
      s.c[i] = ulps_away(random.chance(2) ? s.min[i] : s.max[i], step);
    }
    reach(s, random, random.turn(3) != 0);
    return s;
  }

  /// A centre inside: anywhere, as far from two or three faces, or nearly so.
  static Shapes inside(Random& random) {
    Shapes s = facing(random, Region::inside, 0);
    const int kind = random.turn(4);
    if (kind != 0) {  // on a grid, so that depths are exact
      const std::size_t first = random.index(3);
      const auto depth = static_cast<Real>(random.between(1, 40)) / Real{8};
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (first + k) % 3;
        s.c[i] = static_cast<Real>(random.between(-80, 80)) / Real{8};
        const bool tied = k == 0 || static_cast<int>(k) <= kind - (kind == 3 ? 2 : 0);
        const Real near = tied ? depth : depth + static_cast<Real>(random.between(1, 16)) / Real{8};
        const Real far = random.chance(3) ? near : near + static_cast<Real>(random.between(1, 16)) / Real{8};
        const bool at_min = random.chance(2);
        s.min[i] = s.c[i] - (at_min ? near : far);
        s.max[i] = s.c[i] + (at_min ? far : near);
      }
      if (kind == 3) s.c[first] = ulps_away(s.c[first], random.between(-2, 2));
    }
    s.a.radius = random.turn(5) == 0 ? Real{0} : random.uniform(Real{0}, Real{6});
    random_distances(s, random);
    return s;
  }

  /// A centre on a face, an edge or a corner.
  static Shapes on_boundary(Random& random) {
    Shapes s = facing(random, Region::inside, 0);
    const std::size_t first = random.index(3);
    const int fixed = 1 + random.turn(3);
    for (int k = 0; k < fixed; ++k) {
      const std::size_t i = (first + static_cast<std::size_t>(k)) % 3;
      s.c[i] = random.chance(2) ? s.min[i] : s.max[i];
    }
    s.a.radius = random.turn(4) == 0 ? Real{0} : random.uniform(Real{0}, Real{6});
    random_distances(s, random);
    if (random.turn(5) == 0) s.scale(random.between(Limits::min_exponent + 8, Limits::max_exponent - 8));
    return s;
  }

  /// In line with an edge or a corner of the box, or with the diagonal of a face, along an axis or a diagonal of space: who
  /// counts the faces that a ray crosses counts two or none of them there. On a grid, half of the centres inside.
  static Shapes aligned(Random& random) {
    const int kind = random.turn(6);
    const bool inside = kind < 3;
    Shapes s;
    const std::size_t first = random.index(3);
    const auto part = static_cast<Real>(random.between(1, 7));    // in eighths of a side
    const auto steps = static_cast<Real>(random.between(1, 12));  // in eighths
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = (first + k) % 3;
      // All of them a number of eighths.
      const auto side = static_cast<Real>(random.between(1, 9));
      const Real low = static_cast<Real>(random.between(-80, 80)) / Real{8};
      s.min[i] = low;
      s.max[i] = low + (inside ? Real{4} + side : side);
      const bool at_min = random.chance(2);
      const Real size = s.max[i] - low;
      const Real on_diagonal = low + size * (at_min ? part : 8 - part) / Real{8};
      const Real anywhere = low + size * static_cast<Real>(random.between(1, 7)) / Real{8};
      const auto beyond = [&](Real by) { return at_min ? low - by : s.max[i] + by; };
      switch (kind) {
        case 0:  // on a diagonal of the box, and so of every face that an axis leads to
          s.c[i] = on_diagonal;
          break;
        case 1:  // in front of the diagonal of two faces, within
          s.c[i] = k == 0 ? anywhere : on_diagonal;
          break;
        case 2:  // as far from two faces or three: a diagonal of space leads to their edge or corner
          s.c[i] = k == 0 && random.chance(2) ? anywhere : beyond(-steps / Real{8});
          break;
        case 3:  // the same from outside
          s.c[i] = k == 0 && random.chance(2) ? anywhere : beyond(steps / Real{8});
          break;
        case 4:  // before a face, in line with its diagonal
          s.c[i] = k == 0 ? beyond(steps / Real{8}) : on_diagonal;
          break;
        default:  // in the plane of a face or two, which the ray grazes
          s.c[i] = k == 0 ? beyond(steps / Real{8}) : k == 1 || random.chance(2) ? beyond(Real{0}) : anywhere;
          break;
      }
    }
    if (inside)
      s.a.radius = random.turn(2, 6) == 0 ? Real{0} : random.uniform(Real{0}, Real{2});
    else
      s.a.radius = s.distance() * enough<Real>(random, random.turn(2, 6) != 0);
    random_distances(s, random);
    if (random.turn(2, 6) == 0) s.alarm = 0;
    return s;
  }

  /// Boxes without thickness on one, two or three axes.
  static Shapes flat(Random& random) {
    Shapes s;
    const bool exact = random.turn(4) == 0;
    if (exact) {
      const Exactly<Shapes> made = exactly_apart(random);
      s = made.shapes;
      s.a.radius = static_cast<Real>(made.distance);
    } else {
      s = facing(random, std::nullopt, 8);
    }
    const std::size_t first = random.index(3);
    const int thin = 1 + random.turn(3);
    for (int k = 0; k < thin; ++k) {
      const std::size_t i = (first + static_cast<std::size_t>(k)) % 3;
      if (s.c[i] < s.min[i]) s.max[i] = s.min[i];
      if (s.c[i] > s.max[i]) s.min[i] = s.max[i];
      if (s.min[i] < s.max[i]) s.min[i] = s.max[i] = s.c[i];
    }
    if (!exact) {
      s.a.radius = s.distance() * random.uniform(Real{0.5}, Real{1.5});
      random_distances(s, random);
    }
    return s;
  }

  /// Near touching or far from it, and then moved away from the origin, so that the distance is another one.
  static Shapes far_from_origin(Random& random) {
    const bool near = random.turn(3) != 0;
    const auto make = [&] {
      Shapes s = nearly(random, random.chance(2));
      move_far(s, random, kIsWide<Real> ? 40 : 16);
      const Real left = length(s.distance() - s.alarm);
      s.a.radius =
          near ? length(ulps_away(left, random.between(-4, 4))) : left * random.uniform(Real{0.75}, Real{1.25});
      return s;
    };
    return near ? searched(random, make) : make();
  }

  static Shapes mixed(Random& random) {
    Shapes s;
    for (std::size_t i = 0; i < 3; ++i) {
      s.c[i] = any_magnitude<Real>(random);
      const Real x = any_magnitude<Real>(random);
      const Real y = any_magnitude<Real>(random);
      s.min[i] = std::min(x, y);
      s.max[i] = std::max(x, y);
    }
    s.a.radius = std::abs(any_magnitude<Real>(random));
    any_distances(s, random);
    return s;
  }
};

using D = SphereAndBox<double>;
using F = SphereAndBox<float>;
using Rows = CommonRows<D, F>;

constexpr Family kFamilies[] = {
    {"generic", "a sphere beside a face, an edge, a corner, and around its centre: each region in turn", kOrdinary,
     made<D::generic, F::generic>},
    {"touching",
     "exactly touching a face, an edge or a corner, by Pythagorean numbers; half searched for squares that round "
     "apart; a fifth one ulp short",
     kInEveryCase, made<touching<D>, touching<F>>},
    Rows::kNearTouching,
    Rows::alarm_edge("alarm, contact and radius differ: no two of them can be confused unseen"),
    {"region_edge", "the centre exactly on a bound of the box on some axes, or one ulp beside it",
     "a comparison of the centre with a bound, strict or not, decides which formula is taken",
     made<D::region_edge, F::region_edge>},
    {"inside", "the centre inside: anywhere, as far from two or three faces, or nearly so",
     "a centre inside a solid box has a depth, and its way out jumps from face to face", made<D::inside, F::inside>,
     false, false, "a centre in a solid box is within every reach"},
    {"on_boundary", "the centre on a face, an edge or a corner: no distance, and a choice of directions", kNoDirection,
     made<D::on_boundary, F::on_boundary>, false, false, "a distance of 0 is within every reach"},
    {"aligned",
     "the centre in line with an edge or a corner of the box, or with the diagonal of a face, along an axis or a "
     "diagonal; half of them inside",
     "who counts the faces that a ray crosses, to tell inside from outside, counts two or none on an edge",
     made<D::aligned, F::aligned>},
    {"flat", "boxes without thickness on one, two or three axes: rectangles, segments and points",
     "a box without thickness is a rectangle, a segment or a point, which overlap tests by volume miss",
     made<D::flat, F::flat>},
    {"far_from_origin", "small distances between large coordinates: cancellation, coarse contact points", kTooCoarse,
     made<D::far_from_origin, F::far_from_origin>},
    Rows::extreme_scale(),
    Rows::invalid("each number in turn NaN or infinite, the box inverted, a length negative: it must be refused",
                  "two shapes with rules of their own: a check that knows one of them forgets the other"),
};

}  // namespace
}  // namespace sphere_cube_families

std::span<const Family> families_of(const BallAndBox* /*kind*/) { return sphere_cube_families::kFamilies; }

}  // namespace contact::golden
