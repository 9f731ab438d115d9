// The families of questions about a sphere or a capsule over a plane: a sphere is a capsule without length.
#include "golden/common_families.hpp"

namespace contact::golden {
namespace planes_families {
namespace {

/// The second radius is a share of the first's.
template <class Real, Pair kPair>
struct OverPlane : Described<Real, kPair> {
  using Shapes = OverPlane;
  using Limits = std::numeric_limits<Real>;
  static constexpr bool kIsSphere = kPair == Pair::sphere_plane;
  static constexpr int kUnits = 20;
  static constexpr int kRoom = 10;

  Segment<Real> a{};
  Radius<Real> b{};
  Triple<Real> normal{0, 0, 1};
  Real offset{};

  [[nodiscard]] Query query(Pair pair) const {
    const Ball at_start = ball(a.start, a.radius + b.radius);
    const Plane plane{widened(normal), static_cast<double>(offset)};
    if (kIsSphere) return {pair, BallAndPlane{at_start, plane}, this->distances()};
    return {pair, CapsuleAndPlane{{at_start.center, widened(a.end), at_start.radius}, plane}, this->distances()};
  }
  [[nodiscard]] std::array<Triple<Real>*, 2> points() { return {&a.start, &a.end}; }
  /// The power of two that the normal's largest component is not below.
  [[nodiscard]] int exponent() const {
    return std::ilogb(std::max({std::abs(normal[0]), std::abs(normal[1]), std::abs(normal[2])}));
  }
  /// The normal with a largest component from 1 to 2.
  [[nodiscard]] Triple<Real> ordinary_normal() const {
    Triple<Real> n = normal;
    lift(-exponent(), n);
    return n;
  }
  /// Of the lower end over the plane, in plain arithmetic.
  [[nodiscard]] Real distance() const {
    const Triple<Real> n = ordinary_normal();
    return (std::min(dot(n, a.start), dot(n, a.end)) - std::ldexp(offset, -exponent())) / std::sqrt(dot(n, n));
  }
  /// Puts the plane so far below the lower end, as near as its offset may be to that.
  void put_plane_below(Real height) {
    const Triple<Real> n = ordinary_normal();
    offset = std::ldexp(std::min(dot(n, a.start), dot(n, a.end)) - height * std::sqrt(dot(n, n)), exponent());
  }
  /// Another unit of length.
  void scale(int e) { lift(e, a.start, a.end, a.radius, b.radius, offset, this->alarm, this->contact); }
  /// Another length of the normal; the plane stays.
  void lengthen_normal(int e) { lift(e, normal, offset); }
  void settle_sphere() {
    if (kIsSphere) a.end = a.start;
  }
  void after_moving(Random& random, const Triple<Real>& by) {
    const Real height = random.uniform(Real{0.5}, Real{6});
    put_plane_below(height);
    // The offset is as coarse as it is large.
    if (!(distance() > height / 2)) put_plane_below(height + std::abs(by[0]) * Limits::epsilon() * 16);
  }

  /// Which point of a segment is lowest: an end, each in turn, or with the last of three turns all of them.
  static Feature turn_of_lowest(Random& random, int turns) {
    return kIsSphere ? Feature::start : static_cast<Feature>(random.turn(turns));
  }

  /// Of a normal along an axis: either way, 1 or any length.
  static Real along_axis(Random& random) {
    return random.with_sign(random.chance(2) ? Real{1} : random.uniform(Real{0.125}, Real{8}));
  }
  /// A unit vector as near as plain arithmetic makes it, a vector of any length, and an axis: a floor, or a wall.
  static Triple<Real> any_normal(Random& random) {
    Triple<Real> n = triple<Real>(random, -4, 4);
    const std::size_t kind = random.index(3);
    if (kind == 0) {
      const Real length = std::sqrt(dot(n, n));
      for (Real& x : n) x /= length;
    } else if (kind == 1) {
      n = {};
      n[random.index(3)] = along_axis(random);
    }
    return n == Triple<Real>{} ? Triple<Real>{1, 2, -2} : n;
  }

  /// A segment of ordinary size, anywhere, its start or its end lower than the other.
  static Shapes beside(Random& random) {
    Shapes s;
    s.normal = any_normal(random);
    const Triple<Real> p = triple<Real>(random, -10, 10);
    const Triple<Real> u = triple<Real>(random, -4, 4);
    const Triple<Real> other = moved(p, dot(u, s.normal) < 0 ? Real{-1} : Real{1}, u);
    s.a = turn_of_lowest(random, 2) == Feature::start ? Segment<Real>{p, other, 0} : Segment<Real>{other, p, 0};
    s.settle_sphere();
    s.put_plane_below(random.uniform(Real{0.5}, Real{6}));
    return s;
  }

  static Shapes generic(Random& random) {
    Shapes s = beside(random);
    s.put_plane_below(random.uniform(Real{-2}, Real{10}));
    s.a.radius = random.uniform(Real{0.5}, Real{6});
    random_distances(s, random);
    return s;
  }

  static Shapes mixed(Random& random) {
    Shapes s = generic(random);
    for (Triple<Real>* v : {&s.a.start, &s.a.end, &s.normal})
      for (Real& x : *v) x = any_magnitude<Real>(random);
    s.settle_sphere();
    s.offset = any_magnitude<Real>(random);
    s.a.radius = std::abs(any_magnitude<Real>(random));
    any_distances(s, random);
    return s;
  }

  /// A segment on a grid and exactly an integer over a plane, whose normal is a row of a frame, some times. The foot is
  /// on the grid too where the height is a multiple of the row's length, and else a fraction that no scalar holds.
  static Exactly<Shapes> on_frame(Random& random, Feature lowest, bool meeting = false) {
    const bool large = random.chance(2);
    const std::int64_t steps = large ? (kIsWide<Real> ? 64 : 6) : 3;
    const Frame rows = frame(random, large ? (kIsWide<Real> ? 1 << 12 : 16) : random.between(1, 3));
    const std::int64_t times = random.between<std::int64_t>(1, kIsWide<Real> ? 8 : 2);
    Exactly<Shapes> made{
        {}, meeting ? 0 : random.between<std::int64_t>(1, kIsWide<Real> && large ? 1 << 12 : 24), rows};
    if (!meeting && !large && random.chance(3)) made.distance = rows.length;
    const Integers p = integers(random, kIsWide<Real> ? 1 << 20 : 1 << 8);
    Integers way = {random.between(-steps, steps), random.between(-steps, steps),
                    lowest == Feature::side ? 0 : random.between<std::int64_t>(1, steps)};
    if (way[0] == 0 && way[1] == 0) way[0] = 1;
    const Integers normal = moved({}, times, rows.rows[2]);
    Shapes& s = made.shapes;
    s.a = {placed<Real>(p), placed<Real>(moved(p, 1, rows.at(way))), 0};
    if (lowest == Feature::end) std::swap(s.a.start, s.a.end);
    s.settle_sphere();
    s.normal = placed<Real>(normal);
    s.offset = static_cast<Real>(dot(normal, p) - made.distance * times * rows.length);
    return made;
  }
  static Exactly<Shapes> exactly_apart(Random& random) { return on_frame(random, turn_of_lowest(random, 3)); }

  /// On the plane, and below it by anything up to more than all lengths. A fifth of them over it by an ulp of its
  /// offset, without a radius.
  static Shapes below_plane(Random& random) {
    const bool missing = random.turn(5) == kMissing;
    Shapes s;
    if (missing || random.turn(2) == 0) {
      s = on_frame(random, turn_of_lowest(random, 3), true).shapes;
      if (missing) {
        step(s.offset, -1);
        return s;
      }
    } else {
      s = beside(random);
      s.put_plane_below(-random.magnitude<Real>(-10, 6));
    }
    if (random.turn(4, 5) != 0) s.a.radius = random.uniform(Real{0.5}, Real{6});
    random_distances(s, random);
    return s;
  }

  /// Normals that are not of length 1, most of them so long or so short that the square of their length leaves the
  /// range.
  static Shapes length_of_normal(Random& random) {
    Shapes s = beside(random);
    int exponent = random.between(-3, 3);
    const int kind = random.turn(4);
    if (kind == 0) exponent = random.between(Limits::max_exponent / 2 + 2, Limits::max_exponent - 10);
    if (kind == 1) exponent = random.between(Limits::min_exponent + 4, Limits::min_exponent / 2 - 4);
    if (kind == 2) exponent = Limits::min_exponent - random.between(4, 12);  // subnormal
    lift(exponent, s.normal);
    if (s.normal == Triple<Real>{}) s.normal[0] = Limits::denorm_min();
    s.put_plane_below(random.uniform(Real{0.5}, Real{6}));
    // Of a subnormal offset the height may be any.
    if (!(s.distance() > 0)) s.put_plane_below(random.uniform(Real{64}, Real{128}));
    reach_somehow(s, random, s.distance() > 0 && random.turn(3, 4) == 0);
    return s;
  }

  /// Segments along the plane, exactly and in whichever direction, an ulp off that, and off by what a cross product is
  /// rounded by.
  static Shapes along_plane(Random& random) {
    const int kind = random.turn(4);
    std::int64_t height = 0;
    Shapes s;
    if (kind < 2) {
      const auto made = on_frame(random, Feature::side);
      s = made.shapes;
      height = made.distance;
      if (kind == 1) {
        Real& x = (*s.points()[random.index(2)])[random.index(3)];
        step(x, random.chance(2) ? 1 : -1);
      }
    } else {
      s = beside(random);
      const std::size_t axis = random.index(3);
      if (kind == 2) {  // a floor or a wall, and ends that have one coordinate in common
        s.normal = {};
        s.normal[axis] = along_axis(random);
        s.a.end[axis] = s.a.start[axis];
      } else {
        s.normal = triple<Real>(random, -4, 4);
        s.a.end = moved(s.a.start, 1, cross(s.normal, triple<Real>(random, -1, 1)));
      }
      s.put_plane_below(random.uniform(Real{0.5}, Real{6}));
    }
    if (kind == 0 && random.turn(2, 4) == 0) {
      reach_exactly(s, random, height);
      if (random.chance(5)) step(s.a.radius, -1);
    } else {
      reach_or_not(s, random);
    }
    return s;
  }

  /// Capsules that are spheres, and some whose ends are ulps apart, or subnormal numbers.
  static Shapes zero_length(Random& random) {
    Shapes s = beside(random);
    if (random.turn(2) == 0) {
      const auto made = on_frame(random, Feature::start);
      s = made.shapes;
      s.a.end = s.a.start;
      reach_exactly(s, random, made.distance);
      if (random.chance(3)) step(s.a.radius, -1);
      return s;
    }
    s.a.end = s.a.start;
    if (random.chance(3)) {
      if (random.chance(2)) s.a.start = s.a.end = {};
      for (Real& x : s.a.end) step(x, random.between(-1, 1));
    }
    s.put_plane_below(random.uniform(Real{0.5}, Real{6}));
    reach_or_not(s, random);
    return s;
  }

  /// Numbers half way between two neighbours, and beside that by the least there is: the value of an exact distance, a
  /// surface point along an axis, the middle of a capsule along the plane.
  static Shapes ties(Random& random) {
    const bool missing = random.turn(5) == kMissing;
    Shapes s;
    if (random.turn(2) == 0) {
      s = tie_of_value<Shapes>(random, missing);
      s.contact = random.chance(2) ? Limits::denorm_min() : Real{0};
      return s;
    }
    // Along an axis, from a coordinate so large that half of an odd number beside it does not fit.
    const Real large = std::ldexp(Real{1}, Limits::digits - 1) + static_cast<Real>(random.between(100, 10000));
    const auto odd = static_cast<Real>(2 * random.between(0, 40) + 1);
    const auto height = static_cast<Real>(random.between(1, 20));
    const std::size_t up = random.index(3);
    const std::size_t beside = (up + 1) % 3;
    s.normal = {};
    s.normal[up] = random.with_sign(std::ldexp(Real{1}, random.between(-3, 3)));
    const Real outward = s.normal[up] < 0 ? Real{-1} : Real{1};
    s.a.start[up] = random.with_sign(large);
    if (!kIsSphere && random.turn(2, 2) == 0) {
      s.a.start[up] = outward * height;
      s.a.start[beside] = random.with_sign(large);
      s.a.end = s.a.start;
      s.a.end[beside] += s.a.start[beside] < 0 ? -odd : odd;
      if (random.chance(2)) std::swap(s.a.start, s.a.end);
      s.offset = 0;
      s.a.radius = height * enough<Real>(random, !missing);
      return s;
    }
    s.a.end = s.a.start;
    if (!kIsSphere) s.a.end[up] += outward * static_cast<Real>(random.between(1, 9));
    s.offset = std::abs(s.normal[up]) * (outward * s.a.start[up] - height);
    s.a.radius = missing ? height * enough<Real>(random, false) : odd / 2 + height;
    // A normal that is not quite along the axis: r n is a little less than r.
    if (random.chance(2)) s.normal[beside] = std::ldexp(s.normal[up], -random.between(Limits::digits / 2 + 1, 100));
    return s;
  }
};

template <class A, class B>
std::span<const Family> families(const Two<A, B>* /*kind*/) {
  constexpr Pair kPair = pair_of<A, B>();
  using D = OverPlane<double, kPair>;
  using F = OverPlane<float, kPair>;
  using Rows = CommonRows<D, F>;
  constexpr bool kIsSphere = D::kIsSphere;
  static const std::vector<Family> all = without_gaps({
      {"generic",
       kIsSphere ? "a sphere over a plane, some of them below it; normals of length 1, of any length, along an axis"
                 : "a capsule over a plane, its start and its end lower in turn, some of them below it; normals of "
                   "length 1, of any length, along an axis",
       kOrdinary, made<D::generic, F::generic>},
      {"touching",
       kIsSphere ? "exactly touching, by integers on orthogonal frames; half searched for what plain arithmetic "
                   "decides wrongly; a fifth one ulp short"
                 : "exactly touching with the start, the end, and all along, by integers on orthogonal frames; half "
                   "searched for what plain arithmetic decides wrongly; a fifth one ulp short",
       kInEveryCase, made<touching<D>, touching<F>>},
      Rows::kNearTouching,
      Rows::alarm_edge("alarm, contact and radius differ: no two of them can be confused unseen"),
      {"below_plane", "on the plane and below it; a fifth over it by an ulp of the offset, without a radius",
       "the distance is signed: who takes its size, or a plane for a sheet with two sides, is right above it",
       made<D::below_plane, F::below_plane>},
      {"normal_length",
       "normals that are not of length 1, along axes too; most so long or so short that the squared length leaves the "
       "range",
       "a normal taken for a unit vector; a length of 0 or infinity where the plane is an ordinary one",
       made<D::length_of_normal, F::length_of_normal>},
      where(!kIsSphere,
            {"parallel",
             "along the plane exactly and in whichever direction, an ulp off, and off by what a cross product is "
             "rounded by",
             "which end is lower is decided by a sign that is 0 or nearly so, and the contact jumps with it",
             made<D::along_plane, F::along_plane>}),
      where(!kIsSphere, {"zero_length", "capsules of length 0, ulps long or of subnormal length",
                         "a direction of 0, and a middle that is none", made<D::zero_length, F::zero_length>}),
      {"ties",
       kIsSphere ? "the value, a surface point half way between two numbers or just beside"
                 : "the value, a surface point or the middle of a capsule along the plane half way between two numbers "
                   "or just beside",
       kRoundingTwice, made<D::ties, F::ties>},
      Rows::units("an absolute epsilon is small in one unit alone"),
      {"far_from_origin", "small distances between large coordinates and a large offset",
       "cancellation in the product less the offset; coarse contact points",
       made<far_from_origin<D>, far_from_origin<F>>},
      Rows::extreme_scale("products that overflow or underflow, mixed magnitudes, subnormal numbers"),
      Rows::invalid("each number in turn NaN or infinite, a length negative, the normal 0: it must be refused",
                    "a normal of 0: a check of the numbers one by one forgets it"),
  });
  return all;
}

}  // namespace
}  // namespace planes_families

std::span<const Family> families_of(const BallAndPlane* kind) { return planes_families::families(kind); }
std::span<const Family> families_of(const CapsuleAndPlane* kind) { return planes_families::families(kind); }

}  // namespace contact::golden
