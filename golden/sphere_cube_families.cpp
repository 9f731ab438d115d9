// The families of questions about a sphere and a box.
#include "golden/making.hpp"

namespace contact::golden {
namespace sphere_cube_families {
namespace {

template <class Real>
using Triple = std::array<Real, 3>;

/// A question in the file's scalar; widening it to double is exact. Only + - * / sqrt and scaling by powers of two make
/// its numbers: each is one IEEE 754 rounding, so every platform makes the same.
template <class Real>
struct SphereAndBox {
  Triple<Real> c{};
  Real r{};
  Triple<Real> min{};
  Triple<Real> max{};
  Real alarm{};
  Real contact{};

  [[nodiscard]] Query query(Pair pair) const {
    const auto vector = [](const Triple<Real>& v) {
      return Vector3(static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2]));
    };
    return {pair,
            BallAndBox{{vector(c), static_cast<double>(r)}, {vector(min), vector(max)}},
            {static_cast<double>(alarm), static_cast<double>(contact)}};
  }
  /// From the centre to the box, in plain arithmetic.
  [[nodiscard]] Real distance() const {
    Real sum{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Real apart = c[i] < min[i] ? min[i] - c[i] : c[i] > max[i] ? c[i] - max[i] : Real{0};
      sum += apart * apart;
    }
    return std::sqrt(sum);
  }
  void scale(int exponent) {
    for (std::size_t i = 0; i < 3; ++i)
      for (Real* x : {&c[i], &min[i], &max[i]}) *x = std::ldexp(*x, exponent);
    for (Real* x : {&r, &alarm, &contact}) *x = std::ldexp(*x, exponent);
  }
};

template <class Real>
void random_distances(SphereAndBox<Real>& s, Random& random) {
  s.alarm = random.chance(2) ? random.uniform(Real{0}, Real{2}) : Real{0};
  s.contact = random.chance(2) ? random.uniform(Real{0}, Real{1}) : Real{0};
}

/// A box of ordinary size, anywhere.
template <class Real>
void random_box(SphereAndBox<Real>& s, Random& random) {
  s.min = triple<Real>(random, -10, 5);
  for (std::size_t i = 0; i < 3; ++i) s.max[i] = s.min[i] + random.uniform(Real{0.5}, Real{8});
}

/// The features that a centre may face, by the number of axes on which it is beyond the box.
enum class Region { inside, face, edge, corner };

/// A centre that faces a feature, at most `most` beyond the box on an axis.
template <class Real>
void place_center(SphereAndBox<Real>& s, Random& random, Region region, Real most) {
  const int beyond = static_cast<int>(region);
  const std::size_t first = random.index(3);
  for (int k = 0; k < 3; ++k) {
    const std::size_t i = (first + static_cast<std::size_t>(k)) % 3;
    if (k < beyond)
      s.c[i] = random.chance(2) ? s.max[i] + random.uniform(Real{0}, most) : s.min[i] - random.uniform(Real{0}, most);
    else
      s.c[i] = s.min[i] + (s.max[i] - s.min[i]) * random.uniform(Real{0.0625}, Real{0.9375});
  }
}

/// A sphere beside each feature in turn, as often too far away.
template <class Real>
SphereAndBox<Real> generic(Random& random) {
  SphereAndBox<Real> s;
  random_box(s, random);
  place_center(s, random, static_cast<Region>(random.turn(4)), Real{8});
  s.r = random.uniform(Real{0.25}, Real{6});
  random_distances(s, random);
  return s;
}

/// A box on integers, and a centre exactly an integer number of sixteenths away from a feature of it.
template <class Real>
struct Exactly {
  SphereAndBox<Real> shapes;
  std::int64_t sixteenths;
};

template <class Real>
Exactly<Real> exactly_apart(Random& random) {
  const bool wide = sizeof(Real) == 8;
  const bool large = random.chance(2);
  const std::int64_t offset = wide ? 1 << 24 : 1 << 10;
  Quadruple q = quadruple(random, wide ? (large ? 1 << 18 : 48) : (large ? 120 : 12));
  if (const int region = random.turn(3); region != 2) {  // an edge or a face
    const auto m = random.between<std::int64_t>(1, wide ? 1 << 20 : large ? 480 : 40);
    const auto n = random.between<std::int64_t>(1, m);
    q = region == 0 ? Quadruple{{m * m - n * n, 2 * m * n, 0}, m * m + n * n} : Quadruple{{m, 0, 0}, m};
    std::swap(q.delta[0], q.delta[random.index(3)]);
    std::swap(q.delta[1], q.delta[1 + random.index(2)]);
    for (std::int64_t& x : q.delta)
      if (random.chance(2)) x = -x;
  }
  Exactly<Real> made{{}, 16 * q.d};
  SphereAndBox<Real>& s = made.shapes;
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

/// One in five a radius too short by one ulp.
template <class Real>
SphereAndBox<Real> touching(Random& random) {
  const auto make = [&] {
    auto [s, total] = exactly_apart<Real>(random);
    s.r = sixteenths<Real>(total);
    s.contact = random.chance(2) ? sixteenths<Real>(random.between(0, 32)) : Real{0};
    return s;
  };
  SphereAndBox<Real> s = random.turn(2) == 0 ? make() : searched<SphereAndBox, Real>(random, Pair::sphere_cube, make);
  s.scale(random.between(-40, 40));
  if (random.turn(5) == kMissing) s.r = ulps_away(s.r, -1);
  return s;
}

/// A radius that leaves the sphere a few ulps from the box, beside an alarm distance or none.
template <class Real>
SphereAndBox<Real> near_reach(Random& random, bool alarmed) {
  SphereAndBox<Real> s;
  random_box(s, random);
  place_center(s, random, static_cast<Region>(1 + random.index(3)), Real{8});
  const Real d = s.distance();
  const int ulps = random.between(-4, 4);
  if (alarmed) {
    s.r = d * random.uniform(Real{0.125}, Real{0.875});
    s.alarm = length(ulps_away(d - s.r, ulps));
    s.contact = s.alarm * random.uniform(Real{0.125}, Real{0.875});
  } else {
    s.r = length(ulps_away(d, ulps));
    s.contact = random.chance(2) ? random.uniform(Real{0}, Real{1}) : Real{0};
  }
  return s;
}

/// Not all of them are searched: what plain arithmetic decides wrongly is mostly a miss.
template <class Real>
SphereAndBox<Real> near_touching(Random& random) {
  const auto make = [&] { return near_reach<Real>(random, false); };
  return random.turn(4) == 0 ? make() : searched<SphereAndBox, Real>(random, Pair::sphere_cube, make);
}

template <class Real>
SphereAndBox<Real> alarm_edge(Random& random) {
  if (random.turn(3) == 0) {
    auto [s, total] = exactly_apart<Real>(random);
    const std::int64_t first = random.between<std::int64_t>(1, total - 1);
    s.r = sixteenths<Real>(first);
    s.alarm = sixteenths<Real>(total - first);
    s.contact = s.alarm / Real{4};
    s.scale(random.between(-40, 40));
    return s;
  }
  return searched<SphereAndBox, Real>(random, Pair::sphere_cube, [&] { return near_reach<Real>(random, true); });
}

/// Where one region ends and the next begins: coordinates of the centre exactly on a bound, or one ulp beside it.
template <class Real>
SphereAndBox<Real> region_edge(Random& random) {
  SphereAndBox<Real> s;
  random_box(s, random);
  place_center(s, random, static_cast<Region>(1 + random.turn(3)), Real{4});
  const std::size_t first = random.index(3);
  for (std::size_t k = 0; k <= random.index(2); ++k) {
    const std::size_t i = (first + k) % 3;
    const auto step = random.between(-1, 1);  // drawn first: a call's arguments are in no order
    s.c[i] = ulps_away(random.chance(2) ? s.min[i] : s.max[i], step);
  }
  s.r =
      s.distance() * (random.turn(3) == 0 ? random.uniform(Real{0.5}, Real{0.9375}) : random.uniform(Real{1}, Real{2}));
  random_distances(s, random);
  if (random.turn(3) == 0) s.alarm = 0;
  return s;
}

/// A centre inside: anywhere, as far from two or three faces, or nearly so.
template <class Real>
SphereAndBox<Real> inside(Random& random) {
  SphereAndBox<Real> s;
  random_box(s, random);
  place_center(s, random, Region::inside, Real{0});
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
  s.r = random.turn(5) == 0 ? Real{0} : random.uniform(Real{0}, Real{6});
  random_distances(s, random);
  return s;
}

/// A centre on a face, an edge or a corner.
template <class Real>
SphereAndBox<Real> on_boundary(Random& random) {
  SphereAndBox<Real> s;
  random_box(s, random);
  place_center(s, random, Region::inside, Real{0});
  const std::size_t first = random.index(3);
  const int fixed = 1 + random.turn(3);
  for (int k = 0; k < fixed; ++k) {
    const std::size_t i = (first + static_cast<std::size_t>(k)) % 3;
    s.c[i] = random.chance(2) ? s.min[i] : s.max[i];
  }
  s.r = random.turn(4) == 0 ? Real{0} : random.uniform(Real{0}, Real{6});
  random_distances(s, random);
  if (random.turn(5) == 0)
    s.scale(random.between(std::numeric_limits<Real>::min_exponent + 8, std::numeric_limits<Real>::max_exponent - 8));
  return s;
}

/// In line with an edge or a corner of the box, or with the diagonal of a face, along an axis or a diagonal of space: who
/// counts the faces that a ray crosses counts two or none of them there. On a grid, half of the centres inside.
template <class Real>
SphereAndBox<Real> aligned(Random& random) {
  const int kind = random.turn(6);
  const bool inside = kind < 3;
  SphereAndBox<Real> s;
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
    s.r = random.turn(2, 6) == 0 ? Real{0} : random.uniform(Real{0}, Real{2});
  else
    s.r = s.distance() *
          (random.turn(2, 6) == 0 ? random.uniform(Real{0.5}, Real{0.9375}) : random.uniform(Real{1}, Real{2}));
  random_distances(s, random);
  if (random.turn(2, 6) == 0) s.alarm = 0;
  return s;
}

/// Boxes without thickness on one, two or three axes.
template <class Real>
SphereAndBox<Real> flat(Random& random) {
  SphereAndBox<Real> s;
  const bool exact = random.turn(4) == 0;
  if (exact) {
    auto [made, total] = exactly_apart<Real>(random);
    s = made;
    s.r = sixteenths<Real>(total);
  } else {
    random_box(s, random);
    place_center(s, random, static_cast<Region>(1 + random.index(3)), Real{8});
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
    s.r = s.distance() * random.uniform(Real{0.5}, Real{1.5});
    random_distances(s, random);
  }
  return s;
}

/// Near touching or far from it, and then moved away from the origin, so that the distance is another one.
template <class Real>
SphereAndBox<Real> far_from_origin(Random& random) {
  const bool near = random.turn(3) != 0;
  const auto make = [&] {
    SphereAndBox<Real> s = near_reach<Real>(random, random.chance(2));
    const Real offset = std::ldexp(Real{1}, random.between(10, sizeof(Real) == 8 ? 40 : 16));
    for (std::size_t i = 0; i < 3; ++i) {
      const Real by = random.with_sign(offset);
      s.c[i] += by;
      s.min[i] += by;
      s.max[i] = std::max(s.min[i], s.max[i] + by);
    }
    const Real left = length(s.distance() - s.alarm);
    s.r = near ? length(ulps_away(left, random.between(-4, 4))) : left * random.uniform(Real{0.75}, Real{1.25});
    return s;
  };
  return near ? searched<SphereAndBox, Real>(random, Pair::sphere_cube, make) : make();
}

template <class Real>
SphereAndBox<Real> extreme_scale(Random& random) {
  SphereAndBox<Real> s;
  switch (random.turn(3)) {
    case 0:  // squares that overflow
      s = generic<Real>(random);
      s.scale(random.between(std::numeric_limits<Real>::max_exponent / 2, std::numeric_limits<Real>::max_exponent - 8));
      return s;
    case 1:  // squares that underflow, and subnormal numbers
      s = generic<Real>(random);
      s.scale(random.between(std::numeric_limits<Real>::min_exponent - std::numeric_limits<Real>::digits,
                             std::numeric_limits<Real>::min_exponent / 2));
      for (std::size_t i = 0; i < 3; ++i) s.max[i] = std::max(s.min[i], s.max[i]);
      return s;
    default: {  // magnitudes that have nothing to do with each other
      const auto any = [&] {
        return random.with_sign(random.magnitude<Real>(std::numeric_limits<Real>::min_exponent + 2,
                                                       std::numeric_limits<Real>::max_exponent - 4));
      };
      for (std::size_t i = 0; i < 3; ++i) {
        s.c[i] = any();
        const Real x = any();
        const Real y = any();
        s.min[i] = std::min(x, y);
        s.max[i] = std::max(x, y);
      }
      s.r = std::abs(any());
      s.alarm = random.chance(2) ? std::abs(any()) : Real{0};
      s.contact = random.chance(2) ? std::abs(any()) : Real{0};
      return s;
    }
  }
}

constexpr std::array kFamilies{
    Family{"generic", "a sphere beside a face, an edge, a corner, and around its centre: each region in turn",
           "ordinary numbers: what fails here fails its users, and other families do not say so",
           made<generic<double>, generic<float>>, false},
    Family{"touching",
           "exactly touching a face, an edge or a corner, by Pythagorean numbers; half searched for squares that round "
           "apart; a fifth one ulp short",
           "a strict comparison, or any tolerance, shows in every case and not by chance",
           made<touching<double>, touching<float>>, false},
    Family{"near_touching", "up to 4 ulps from touching, most of them searched for wrong decisions of plain arithmetic",
           "plain arithmetic decides most of it wrongly: how often is an engine's measure",
           made<near_touching<double>, near_touching<float>>, false},
    Family{"alarm_edge", "exactly at the alarm distance and up to 4 ulps beside it",
           "alarm, contact and radius differ: no two of them can be confused unseen",
           made<alarm_edge<double>, alarm_edge<float>>, false},
    Family{"region_edge", "the centre exactly on a bound of the box on some axes, or one ulp beside it",
           "a comparison of the centre with a bound, strict or not, decides which formula is taken",
           made<region_edge<double>, region_edge<float>>, false},
    Family{"inside", "the centre inside: anywhere, as far from two or three faces, or nearly so",
           "a centre inside a solid box has a depth, and its way out jumps from face to face",
           made<inside<double>, inside<float>>, false, false, "a centre in a solid box is within every reach"},
    Family{"on_boundary", "the centre on a face, an edge or a corner: no distance, and a choice of directions",
           "no direction: what an engine does instead, under whichever convention it declares",
           made<on_boundary<double>, on_boundary<float>>, false, false, "a distance of 0 is within every reach"},
    Family{"aligned",
           "the centre in line with an edge or a corner of the box, or with the diagonal of a face, along an axis or a "
           "diagonal; half of them inside",
           "who counts the faces that a ray crosses, to tell inside from outside, counts two or none on an edge",
           made<aligned<double>, aligned<float>>, false},
    Family{"flat", "boxes without thickness on one, two or three axes: rectangles, segments and points",
           "a box without thickness is a rectangle, a segment or a point, which overlap tests by volume miss",
           made<flat<double>, flat<float>>, false},
    Family{"far_from_origin", "small distances between large coordinates: cancellation, coarse contact points",
           "coordinates that a smaller format, or a tolerance that grows, cannot hold",
           made<far_from_origin<double>, far_from_origin<float>>, false},
    Family{"extreme_scale", "squares that overflow or underflow, mixed magnitudes, subnormal numbers",
           "overflow and underflow depend on an engine's own order of operations",
           made<extreme_scale<double>, extreme_scale<float>>, false},
    Family{kInvalidFamily,
           "each number in turn NaN or infinite, the box inverted, a length negative: it must be refused",
           "two shapes with rules of their own: a check that knows one of them forgets the other",
           spoiled<generic<double>, generic<float>>, false, true},
};

}  // namespace
}  // namespace sphere_cube_families

std::span<const Family> families_of(const BallAndBox* /*kind*/) { return sphere_cube_families::kFamilies; }

}  // namespace contact::golden
