// The families of questions about capsules, about a sphere and a capsule, and about a ray and a sphere: a sphere is a
// capsule without length, a ray one without radius.
#include "golden/common_families.hpp"

namespace contact::golden {
namespace capsules_families {
namespace {

/// How segments lie to the shortest way between them, which is the third row of a frame: at right angles to it, their
/// ends leaning away or not; at right angles and parallel; or both in line with it.
enum class Lie { leaning, level, parallel, in_line };

/// The segment from `back` to `ahead` of a point that is to be nearest: whole, or from the point on; turned round where
/// the point is to be the end.
template <class Real>
Segment<Real> segment_through(Feature feature, const Triple<Real>& back, const Triple<Real>& point,
                              const Triple<Real>& ahead) {
  if (feature == Feature::side) return {back, ahead, 0};
  return feature == Feature::start ? Segment<Real>{point, ahead, 0} : Segment<Real>{ahead, point, 0};
}

/// Of a pair with a sphere `a` is that sphere, also where the question has it second.
template <class Real, Pair kPair>
struct TwoSegments : Described<Real, kPair> {
  using Shapes = TwoSegments;
  static constexpr bool kHasSphere = kPair != Pair::capsule_capsule;
  static constexpr int kClasses = 9;
  static constexpr int kAlarmClasses = 5;
  static constexpr int kDigits = std::numeric_limits<Real>::digits;

  Segment<Real> a;
  Segment<Real> b;
  /// How often a ray goes along its direction; 0 where that is as near to a unit vector as it may be.
  Real times{1};

  [[nodiscard]] Query query(Pair pair) const {
    const auto capsule = [](const Segment<Real>& s) {
      return Capsule{widened(s.start), widened(s.end), static_cast<double>(s.radius)};
    };
    if (kPair == Pair::sphere_capsule)
      return {pair, BallAndCapsule{ball(a.start, a.radius), capsule(b)}, this->distances()};
    if (kPair == Pair::ray_sphere)
      return {pair, RayAndBall{ray(), ball(a.start, a.radius + b.radius)}, this->distances()};
    return {pair, Capsules{capsule(a), capsule(b)}, this->distances()};
  }
  [[nodiscard]] Ray ray() const {
    Triple<Real> u = b.direction();
    for (std::size_t i = 0; i < 3; ++i)
      if (!std::isfinite(u[i])) u[i] = b.end[i];
    if (u == Triple<Real>{}) return {widened(b.start), {1, 2, -2}, 0};
    Real length = times == 0 ? std::sqrt(dot(u, u)) : times;
    const auto divided = [&] { return Triple<Real>{u[0] / length, u[1] / length, u[2] / length}; };
    if (!(length > 0 && std::isfinite(length)) || divided() == Triple<Real>{}) length = 1;
    return {widened(b.start), widened(divided()), static_cast<double>(length)};
  }
  [[nodiscard]] std::array<Triple<Real>*, 4> points() { return {&a.start, &a.end, &b.start, &b.end}; }
  /// Between the segments, in plain arithmetic.
  [[nodiscard]] Real distance() const {
    const NearestPoints<Real> nearest = nearest_points(a, b);
    const Triple<Real> delta = moved(nearest.q, -1, nearest.p);
    return std::sqrt(dot(delta, delta));
  }
  void scale(int e) { lift(e, a.start, a.end, b.start, b.end, a.radius, b.radius, this->alarm, this->contact); }
  void settle_sphere() {
    if (kHasSphere) a.end = a.start;
  }
  /// Of a ray: its whole way once, in steps that divide it exactly, or in unit vectors as engines have them.
  void choose_steps(Random& random, bool exactly) {
    if (kPair != Pair::ray_sphere) return;
    times = std::array<Real, 6>{1, 2, Real{0.125}, 3, 5, 7}[random.index(6)];
    for (const Real x : b.direction())
      if (std::fma(x / times, times, -x) != 0) times = 1;
    if (!exactly && random.chance(2)) times = 0;
  }

  /// The features of both take turns; a sphere has but one.
  static std::array<Feature, 2> turn_of_features(Random& random) {
    return {kHasSphere ? Feature::start : static_cast<Feature>(random.turn(3, 3)),
            static_cast<Feature>(random.turn(3))};
  }

  static Shapes beside(Random& random) {
    const std::array<Feature, 2> features = turn_of_features(random);
    const Triple<Real> p = triple<Real>(random, -10, 10);
    const Triple<Real> delta = triple<Real>(random, -4, 4);
    const auto segment = [&](Feature feature, const Triple<Real>& point, Real away) {
      Triple<Real> u = triple<Real>(random, -4, 4);
      if (feature == Feature::side) u = cross(u, delta);
      const Real along = dot(u, delta) * away < 0 ? Real{-1} : Real{1};
      const Real size = random.uniform(Real{0.125}, Real{1.5});
      const Real back = -random.uniform(Real{0.125}, Real{1.5});
      return segment_through(feature, moved(point, along * back, u), point, moved(point, along * size, u));
    };
    Shapes s;
    s.a = segment(features[0], p, -1);
    s.b = segment(features[1], moved(p, 1, delta), 1);
    if (kHasSphere) s.a.end = s.a.start = p;
    s.choose_steps(random, false);
    return s;
  }

  /// Each feature beside each, as often too far away.
  static Shapes generic(Random& random) {
    Shapes s = beside(random);
    share_radii(s, random, random.uniform(Real{0.5}, Real{6}));
    random_distances(s, random);
    return s;
  }

  static Shapes mixed(Random& random) {
    Shapes s = generic(random);
    any_magnitudes<Real>(random, {&s.a.start, &s.a.end, &s.b.start, &s.b.end}, {&s.a.radius, &s.b.radius});
    s.settle_sphere();
    any_distances(s, random);
    return s;
  }

  /// Segments with ends on a grid, and exactly an integer apart; `meeting` makes it 0. Nearest points are on the grid
  /// too, but half of those on a side are fractions that no scalar holds.
  static Exactly<Shapes> on_frame(Random& random, std::array<Feature, 2> features, Lie lie, bool meeting = false) {
    const Lattice<Real> grid(random, meeting);
    const Frame& frame = grid.frame;
    const std::int64_t steps = grid.steps;
    const std::int64_t height = grid.height;
    Exactly<Shapes> made{{}, height * frame.length, frame};
    std::array<Integers, 2> ways{};
    for (std::size_t i = 0; i < 2; ++i) {
      const std::int64_t away = i == 0 ? -1 : 1;
      Integers& way = ways[i];
      way = {random.between(-steps, steps), random.between(-steps, steps), 0};
      if (way[0] == 0 && way[1] == 0) way[0] = 1;
      if (lie == Lie::leaning && features[i] != Feature::side) way[2] = away * random.between<std::int64_t>(0, steps);
      if (lie == Lie::parallel && i == 1) way = random.chance(2) ? ways[0] : moved({}, -1, ways[0]);
      if (lie == Lie::in_line) way = {0, 0, away * random.between<std::int64_t>(1, steps)};
    }
    std::array<Integers, 2> points{Integers{}, frame.at({0, 0, height})};
    const auto sides = std::count(features.begin(), features.end(), Feature::side);
    if (sides == 2 && (lie == Lie::leaning || lie == Lie::level)) {
      // The second line moved in its plane: both cross less than a step from where they did.
      const Integers by = {random.between(-steps, steps), random.between(-steps, steps), 0};
      const std::int64_t across = std::abs(cross(ways[0], ways[1])[2]);
      if (std::abs(cross(by, ways[0])[2]) < across && std::abs(cross(by, ways[1])[2]) < across)
        points[1] = moved(points[1], 1, frame.at(by));
    } else if (sides == 1 && lie == Lie::leaning && random.chance(2)) {
      // The other one's end is at the origin, and the side goes along the first row.
      const std::size_t side = features[0] == Feature::side ? 0 : 1;
      if (const auto through = frame.between_grid_points(side == 0 ? -height : height)) {
        points[side] = *through;
        points[1 - side] = {};
        ways[side] = {random.between<std::int64_t>(1, steps), 0, 0};
        made.distance = height;
      }
    }
    const Integers origin = integers(random, kIsWide<Real> ? 1 << 24 : 1 << 10);
    for (std::size_t i = 0; i < 2; ++i) {
      const auto at = [&](std::int64_t n) {
        return placed<Real>(moved(moved(origin, 1, points[i]), n, frame.at(ways[i])));
      };
      const std::int64_t back = random.between<std::int64_t>(1, kIsWide<Real> ? 8 : 4);
      const std::int64_t ahead = random.between<std::int64_t>(1, kIsWide<Real> ? 8 : 4);
      (i == 0 ? made.shapes.a : made.shapes.b) = segment_through(features[i], at(-back), at(0), at(ahead));
    }
    made.shapes.settle_sphere();
    made.shapes.choose_steps(random, true);
    return made;
  }
  static Exactly<Shapes> exactly_apart(Random& random) {
    return on_frame(random, turn_of_features(random), Lie::leaning);
  }

  /// Axes along the coordinate axes, on a grid that holds their middles and half lengths too; up to 4 ulps from
  /// touching, or an ordinary reach.
  static Shapes along_axes(Random& random) {
    const bool ordinary = random.turn(3) == 0;
    const auto make = [&] {
      constexpr Real kCoarse = 96;  // a sum with it, between 64 and 128, loses the last digits
      Shapes s;
      for (Segment<Real>* segment : {&s.a, &s.b}) {
        segment->start = triple<Real>(random, -10, 5);
        for (Real& x : segment->start) x = (x + kCoarse) - kCoarse;
        segment->end = segment->start;
        const std::size_t axis = random.index(3);
        segment->end[axis] += (random.uniform(Real{0.5}, Real{8}) + kCoarse) - kCoarse;
        if (random.chance(2)) std::swap(segment->start, segment->end);
      }
      s.settle_sphere();
      if (ordinary) {
        share_radii(s, random, random.uniform(Real{0.5}, Real{1.5}) * s.distance());
        random_distances(s, random);
      } else {
        reach_nearly(s, random, random.chance(2));
      }
      return s;
    };
    return ordinary ? make() : searched(random, make);
  }

  /// Where one region ends and the next begins: an end at right angles to the way, one of its coordinates moved by an
  /// ulp or not; on the grid of a frame, or along an axis.
  static Shapes region_edge(Random& random) {
    Shapes s;
    if (random.turn(2) == 0) {
      std::array<Feature, 2> features = turn_of_features(random);
      if (features[0] == Feature::side || kHasSphere) features[1] = static_cast<Feature>(random.index(2));
      s = on_frame(random, features, Lie::level).shapes;
      Triple<Real>& end = *s.points()[random.index(4)];
      Real& x = end[random.index(3)];
      step(x, random.between(-1, 1));
    } else {
      s = beside(random);
      const std::size_t along = random.index(3);
      for (std::size_t i = 0; i < 3; ++i) {
        if (i == along) continue;
        s.b.end[i] = s.b.start[i];
        s.a.end[i] = s.a.start[i] + (s.a.start[i] - s.b.start[i]) * random.uniform(Real{0}, Real{1});
      }
      if (kPair == Pair::ray_sphere) s.times = 1;
      const auto ulps = random.between(-1, 1);  // drawn first: a call's arguments are in no order
      s.a.start[along] = ulps_away(random.chance(2) ? s.b.start[along] : s.b.end[along], ulps);
    }
    s.settle_sphere();
    reach_or_not(s, random);
    return s;
  }

  /// Capsules that are spheres, and some whose ends are ulps apart, or subnormal numbers; a fifth of them on one point.
  static Shapes zero_length(Random& random) {
    const int which = kHasSphere ? 1 : random.turn(3, 9);
    std::array<Feature, 2> features = turn_of_features(random);
    if (which != 0) features[1] = Feature::start;
    if (which != 1) features[0] = Feature::start;
    const bool exact = random.turn(2) == 0;
    auto [s, distance, frame] = on_frame(random, features, Lie::leaning);
    if (!exact) s = beside(random);
    for (Segment<Real>* segment : {&s.a, &s.b}) {
      if (which == (segment == &s.a ? 1 : 0)) continue;
      segment->end = segment->start;
      if (exact || random.chance(3)) continue;
      if (random.chance(3)) segment->start = segment->end = {};
      for (Real& x : segment->end) step(x, random.between(-1, 1));
    }
    if (random.turn(5) == 0) {
      s.a = s.b;
      s.settle_sphere();
      share_radii(s, random, random.uniform(Real{0.5}, Real{6}));
      random_distances(s, random);
    } else if (exact) {
      reach_exactly(s, random, distance);
      if (random.chance(3)) step(s.a.radius, -1);
    } else {
      reach_or_not(s, random);
    }
    return s;
  }

  /// Segments that meet: in their middles, at ends, end to end, in part. A fifth of them is moved off each other by an
  /// ulp of the largest coordinate, without radii.
  static Shapes on_axis(Random& random) {
    const int kind = random.turn(4);
    const Lie lie = kind == 2 ? Lie::parallel : kind == 3 ? Lie::in_line : Lie::level;
    auto [s, distance, frame] = on_frame(random, turn_of_features(random), lie, true);
    if (random.turn(5) == kMissing) {
      // Along the axis nearest to the frame's third row, at right angles to level segments; in line, to its first.
      const std::size_t axis = main_axis(frame.rows[lie == Lie::in_line ? 0 : 2]);
      const Real ulp = largest_ulp(s);
      for (Triple<Real>* v : {&s.b.start, &s.b.end}) (*v)[axis] += ulp;
      return s;
    }
    if (random.turn(4, 5) != 0) share_radii(s, random, random.uniform(Real{0.5}, Real{6}));
    random_distances(s, random);
    sometimes_extreme(s, random);
    return s;
  }

  /// Parallel segments: beside each other, in one point or in a line, meeting or not; some of them nearly.
  static Shapes parallel(Random& random) {
    enum class Kind { beside, nearly, in_a_point, in_line, overlapping, along_an_axis };
    const auto kind = static_cast<Kind>(random.turn(6));
    std::array<Feature, 2> features{Feature::side, Feature::side};
    if (kind == Kind::in_a_point || kind == Kind::in_line)
      features = {static_cast<Feature>(random.turn(2, 6)), static_cast<Feature>(random.turn(2, 12))};
    auto [s, distance, frame] =
        on_frame(random, features, kind == Kind::in_line ? Lie::in_line : Lie::parallel, kind == Kind::overlapping);
    if (kind == Kind::nearly) {
      Real& x = (*s.points()[random.index(4)])[random.index(3)];
      step(x, random.chance(2) ? 1 : -1);
    }
    if (kind == Kind::along_an_axis) {
      s = beside(random);
      const std::size_t along = random.index(3);
      for (Segment<Real>* segment : {&s.a, &s.b})
        for (std::size_t i = 0; i < 3; ++i)
          if (i != along) segment->end[i] = segment->start[i];
    }
    if (kind == Kind::overlapping) {
      share_radii(s, random, random.uniform(Real{0.5}, Real{6}));
    } else if (kind == Kind::along_an_axis || random.chance(2)) {
      reach_or_not(s, random);
    } else {
      reach_exactly(s, random, distance);
      if (random.turn(5) == kMissing) step(s.a.radius, -1);
    }
    return s;
  }

  /// Numbers half way between two neighbours, and beside that by the least there is: the value of an exact distance, or
  /// the middle of an axis as nearest point, of a radius 0 or nearly so.
  static Shapes ties(Random& random) {
    const Real least = random.chance(2) ? std::numeric_limits<Real>::denorm_min() : Real{0};
    const bool missing = random.turn(5) == kMissing;
    Shapes s;
    if (random.turn(2) == 0) {
      s = tie_of_value<Shapes>(random, missing);
      s.contact = least;
      return s;
    }
    // An axis along (1, 2, 0) or (1, 0, 0), the first coordinate so large that its middle does not fit.
    const bool beside_each_other = !kHasSphere && random.turn(2, 2) == 0;
    const Real large = std::ldexp(Real{1}, kDigits - 1) + static_cast<Real>(random.between(100, 10000));
    const auto odd = static_cast<Real>(2 * random.between(0, 40) + 1);
    const auto off = static_cast<Real>(2 * random.between(-20, 20) + 1);
    const auto height = static_cast<Real>(random.between(-20, 20));
    s.b.start = {large, 0, 0};
    s.b.end = {large + odd, beside_each_other ? 0 : 2 * odd, 0};
    if (beside_each_other) {
      s.a.start = {large + odd + static_cast<Real>(random.between(0, 9)), off, height};
      s.a.end = {large - static_cast<Real>(random.between(0, 9)), off, height};
    } else {
      s.a.start = {large + (odd + off) / 2, odd - off / 4, height};
      s.a.end = kHasSphere ? s.a.start : moved(s.a.start, 4, {off / 2, -off / 4, height});
    }
    s.a.radius = s.distance() * enough<Real>(random, !missing, Real{1.0625});
    s.b.radius = least;
    if (!kHasSphere && random.chance(2)) std::swap(s.a, s.b);
    turn_axes(s, random);
    s.contact = any_or_none<Real>(random, 1);
    return s;
  }
};

template <class A, class B>
std::span<const Family> families(const Two<A, B>* /*kind*/) {
  constexpr Pair kPair = pair_of<A, B>();
  using D = TwoSegments<double, kPair>;
  using F = TwoSegments<float, kPair>;
  using Rows = CommonRows<D, F>;
  constexpr bool kOfCapsules = kPair == Pair::capsule_capsule;
  constexpr bool kOfRay = kPair == Pair::ray_sphere;
  const auto of = [](std::string_view capsules, std::string_view sphere_and_capsule, std::string_view ray) {
    return kOfCapsules ? capsules : kOfRay ? ray : sphere_and_capsule;
  };
  static const std::vector<Family> all = without_gaps({
      {"generic",
       of("two capsules, each end and the side of one beside each of the other in turn",
          "a sphere beside either end of the axis and beside its side, each in turn",
          "a sphere beside the origin, beside the end and beside the side, each in turn; half of the directions unit "
          "vectors"),
       kOrdinary, made<D::generic, F::generic>},
      {"touching",
       kOfCapsules ? "exactly touching at ends and sides in every combination, by integers on orthogonal frames; half "
                     "searched for squares that round apart; a fifth one ulp short"
                   : "exactly touching at an end or the side, by integers on orthogonal frames; half searched for "
                     "squares that round apart; a fifth one ulp short",
       kInEveryCase, made<touching<D>, touching<F>>},
      Rows::kNearTouching,
      {"alarm_edge",
       kOfRay ? "exactly at the alarm distance and up to 4 ulps beside it; ours, since a ray of SOFA has none"
              : "exactly at the alarm distance and up to 4 ulps beside it",
       kOfRay ? "alarm, contact and radius differ: no two of them can be confused unseen"
              : "alarm, contact and radii differ: no two of them can be confused unseen",
       made<alarm_edge<D>, alarm_edge<F>>},
      {"region_edge",
       of("an end at right angles to the way between two axes, exactly or one ulp beside",
          "the foot of the centre exactly on an end of the axis, or one ulp beside it",
          "the foot of the centre exactly on an end of the ray, or one ulp beside it"),
       "where a foot is clamped, or one ulp before it, decides which formula is taken",
       made<D::region_edge, F::region_edge>},
      {"zero_length",
       of("one capsule or both spheres, ulps long or of subnormal length; a fifth with one axis for both",
          "capsules that are spheres, ulps long or of subnormal length; a fifth with one centre for both",
          "rays of length 0, ulps long or of subnormal length; a fifth from the centre"),
       kOfRay ? "a direction that is taken for where the ray ends; a division of 0 by 0"
              : "a division of 0 by 0, or by what is added to avoid it",
       made<D::zero_length, F::zero_length>},
      {"on_axis",
       of("axes that meet in their middles, at ends or in a part of their length; a fifth one ulp apart, without radii",
          "the centre on the axis, inside it or at an end; a fifth one ulp beside it, without radii",
          "the centre on the ray, inside it or at an end; a fifth one ulp beside it, without a radius"),
       kNoDirection, made<D::on_axis, F::on_axis>},
      where(kOfCapsules,
            {"parallel",
             "parallel axes beside each other, in one point or in a line, either way round; a sixth of them nearly so",
             "more than one nearest point, or a division by nearly 0 where there is but one",
             made<D::parallel, F::parallel>}),
      {"ties",
       kOfRay ? "the value, or a nearest point in the middle of a ray, half way between two numbers or just beside"
              : "the value, or a nearest point in the middle of an axis, half way between two numbers or just beside",
       kRoundingTwice, made<D::ties, F::ties>},
      where(!kOfRay,
            {"along_axes",
             "capsules along the coordinate axes, their middles and half lengths numbers too; two of three near "
             "touching, most of these searched",
             "engines that take a capsule by middle, direction and length can be asked no other without rounding",
             made<D::along_axes, F::along_axes>}),
      Rows::units("an absolute epsilon, of a length, a squared length or a determinant, is small in one unit alone"),
      Rows::kFarFromOrigin,
      Rows::extreme_scale(),
      Rows::invalid(kOfRay
                        ? "each number in turn NaN or infinite, a length negative, the direction 0: it must be refused"
                        : "each number in turn NaN or infinite, a length negative: it must be refused",
                    of("four points and two radii: a check of one shape forgets the other",
                       "an axis of two points: a check of one of them forgets the other",
                       "a direction of 0: a check of the numbers one by one forgets it")),
  });
  return all;
}

}  // namespace
}  // namespace capsules_families

std::span<const Family> families_of(const BallAndCapsule* kind) { return capsules_families::families(kind); }
std::span<const Family> families_of(const Capsules* kind) { return capsules_families::families(kind); }
std::span<const Family> families_of(const RayAndBall* kind) { return capsules_families::families(kind); }

}  // namespace contact::golden
