// The families of pairs that have a distance: each idea once, over the description of a pair.
//
// A description S is Described, and says of its pair:
//   points(), distance(), scale(e)  the points that move with the shapes, the distance in plain arithmetic, another unit
//   a.radius, b.radius              radii; of a pair that has but one b's is a share of it
//   S::beside(random)               ordinary shapes, a feature of one beside a feature of the other
//   S::generic(random)              the same with ordinary radii and distances
//   S::exactly_apart(random)        shapes in integers, an integer from each other
//   S::mixed(random)                magnitudes that have nothing to do with each other
//   S::kClasses, S::kAlarmClasses   how many classes of features take turns, in families and at the alarm distance
//   S::kUnits                       the exponents of units that leave exact numbers exact
//   S::kOverflow, S::kRoom          of all exponents, after what part squares may overflow, and how many are left out
// It may say more, and then that is taken:
//   S::nearly(random, alarmed), S::exactly(random, alarmed)   how its shapes come to nearly reach each other, or exactly
//   s.lengthen_normal(e), s.after_moving(random, by)          what a plane needs
#pragma once

#include <initializer_list>

#include "golden/making.hpp"

namespace contact::golden {

/// Shapes, how far from each other they are, and the frame that they lie in.
template <class S>
struct Exactly {
  S shapes{};
  std::int64_t distance{};
  Frame frame{};
};

/// What shapes are laid out on in integers: so many steps along the rows of a frame, and a height along the third row, or
/// none. Of the smallest frames many lie along the axes, so that directions have zeros.
template <class Real>
struct Lattice {
  bool large;
  Frame frame;
  std::int64_t steps;
  std::int64_t height;

  Lattice(Random& random, bool meeting)
      : large(random.chance(2)),
        frame(golden::frame(random, large ? (kIsWide<Real> ? 1 << 9 : 9) : random.between(1, 3))),
        steps(large ? (kIsWide<Real> ? 64 : 6) : 3),
        height(meeting ? 0 : random.between<std::int64_t>(1, kIsWide<Real> && large ? 1 << 8 : 24)) {}
};

/// Which part of a segment is nearest to the other one.
enum class Feature { start, end, side };

/// What a description has of a radius.
template <class Real>
struct Radius {
  Real radius{};
};

/// Whether one of the two shapes alone has a radius, or neither has.
constexpr bool has_one_radius(Pair pair) {
  return of_shapes(pair, []<class A, class B>() { return !(kHasRadius<A> && kHasRadius<B>); });
}
/// Of a pair with one radius it takes both.
template <class S>
void settle_radii(S& s) {
  if (!has_one_radius(S::kPair)) return;
  s.a.radius += s.b.radius;
  s.b.radius = 0;
}

/// Radii that add up to a part of a length, the first one of them above 0.
template <class S, class Real = typename S::Real>
void share_radii(S& s, Random& random, std::type_identity_t<Real> total) {
  s.a.radius = total * random.uniform(Real{0.0625}, Real{0.9375});
  s.b.radius = length(total - s.a.radius);
}

/// A part of a length: enough for a hit, or not.
template <class Real>
Real enough(Random& random, bool hit, Real least = 1) {
  return hit ? random.uniform(least, Real{2}) : random.uniform(Real{0.5}, Real{0.9375});
}
/// Radii and distances that hit, or not.
template <class S, class Real = typename S::Real>
void reach(S& s, Random& random, bool hit) {
  const Real total = s.distance() * enough<Real>(random, hit);
  if constexpr (requires { s.b.radius; })
    share_radii(s, random, total);
  else
    s.a.radius = total;
  random_distances(s, random);
  if (!hit) s.alarm = 0;
  if constexpr (requires { s.b.radius; }) settle_radii(s);
}
template <class S>
void reach_or_not(S& s, Random& random) {
  reach(s, random, !random.chance(3));
}

/// Radii whose sum is exactly an integer; with `alarmed` an alarm distance takes its part.
template <class S, class Real = typename S::Real>
void reach_exactly(S& s, Random& random, std::int64_t distance, bool alarmed = false) {
  std::int64_t left = 16 * distance;
  if (alarmed) {
    const std::int64_t alarm = random.between<std::int64_t>(1, left - 2);
    s.alarm = sixteenths<Real>(alarm);
    s.contact = s.alarm / Real{4};
    left -= alarm;
  } else {
    s.contact = random.chance(2) ? sixteenths<Real>(random.between(0, 32)) : Real{0};
  }
  const std::int64_t first = random.between<std::int64_t>(1, left);
  s.a.radius = sixteenths<Real>(first);
  s.b.radius = sixteenths<Real>(left - first);
  settle_radii(s);
}
template <class S>
S exactly(Random& random, bool alarmed) {
  if constexpr (requires { S::exactly(random, alarmed); }) {
    return S::exactly(random, alarmed);
  } else {
    Exactly<S> made = S::exactly_apart(random);
    reach_exactly(made.shapes, random, made.distance, alarmed);
    return made.shapes;
  }
}

/// The first radius that is the least to hit, found by bisection.
template <class S, class Real = typename S::Real>
Real least_radius(S s) {
  const auto hits = [&](Real radius) {
    s.a.radius = radius;
    return is_hit(s.query(S::kPair));
  };
  Real high = length(s.distance() - s.b.radius - s.alarm);
  Real step = std::max(std::ldexp(s.distance(), -std::numeric_limits<Real>::digits), std::numeric_limits<Real>::min());
  for (; !hits(high); step *= 2) high += step;
  Real low = high;
  for (; low > 0 && hits(low); step *= 2) {
    high = low;
    low = length(low - step);
  }
  if (hits(low)) return low;
  for (;;) {
    const Real middle = low + (high - low) / 2;
    if (middle <= low || middle >= high) return high;
    (hits(middle) ? high : low) = middle;
  }
}
/// A few ulps from the reach, with an alarm distance or none.
template <class S, class Real = typename S::Real>
void reach_nearly(S& s, Random& random, bool alarmed) {
  const Real d = s.distance();
  s.b.radius = d * random.uniform(Real{0.0625}, Real{0.5});
  if (has_one_radius(S::kPair)) s.b.radius = 0;
  s.alarm = alarmed ? d * random.uniform(Real{0.125}, Real{0.375}) : Real{0};
  s.contact = any_or_none<Real>(random, 1);
  s.a.radius = length(ulps_away(least_radius(s), random.between(-4, 3)));
}
/// Nearly, with an alarm distance or none, or by any length.
template <class S>
void reach_somehow(S& s, Random& random, bool near) {
  if (near)
    reach_nearly(s, random, random.chance(2));
  else
    reach_or_not(s, random);
}
template <class S>
S nearly(Random& random, bool alarmed) {
  if constexpr (requires { S::nearly(random, alarmed); }) {
    return S::nearly(random, alarmed);
  } else {
    S s = S::beside(random);
    reach_nearly(s, random, alarmed);
    return s;
  }
}

/// Exactly, half of them searched.
template <class S>
S exactly_touching(Random& random) {
  const auto make = [&] { return exactly<S>(random, false); };
  S s = random.turn(2) == 0 ? make() : searched(random, make);
  s.scale(random.between(-S::kUnits, S::kUnits));
  return s;
}
/// One in five a radius too short by one ulp.
template <class S>
S touching(Random& random) {
  S s = exactly_touching<S>(random);
  if constexpr (requires { s.lengthen_normal(0); }) s.lengthen_normal(random.between(-20, 20));
  if (random.turn(5) == kMissing) step(s.a.radius, -1);
  return s;
}

/// Not all of them are searched: what plain arithmetic decides wrongly may be of one kind.
template <class S>
S near_touching(Random& random) {
  const auto make = [&] { return nearly<S>(random, false); };
  return random.turn(4) == 0 ? make() : searched(random, make);
}

/// A third exactly, the others searched.
template <class S>
S alarm_edge(Random& random) {
  if (random.turn(3, S::kAlarmClasses) != 0) return searched(random, [&] { return nearly<S>(random, true); });
  S s = exactly<S>(random, true);
  s.scale(random.between(-S::kUnits, S::kUnits));
  return s;
}

/// The value of an exact distance half way between two neighbours, or beside that.
template <class S, class Real = typename S::Real>
S tie_of_value(Random& random, bool missing) {
  Exactly<S> made = S::exactly_apart(random);
  S& s = made.shapes;
  s.alarm = static_cast<Real>(made.distance);
  const Real half = std::ldexp(Real{1}, std::ilogb(s.alarm) - std::numeric_limits<Real>::digits);
  s.b.radius = random.chance(3) ? ulps_away(half, -1) : half * static_cast<Real>(random.between(0, 3));
  if (missing) s.alarm = ulps_away(s.alarm - s.b.radius, -1);
  return s;
}

/// The axes of points in another order, the first one mirrored or not.
template <class S>
void turn_axes(S& s, Random& random) {
  const std::array<std::size_t, 2> swapped{random.index(3), 1 + random.index(2)};
  const bool negative = random.chance(2);
  for (auto* v : s.points()) {
    if (negative) (*v)[0] = -(*v)[0];
    std::swap((*v)[0], (*v)[swapped[0]]);
    std::swap((*v)[1], (*v)[swapped[1]]);
  }
}

/// The axis nearest to a vector.
inline std::size_t main_axis(const Integers& v) {
  std::size_t axis = 0;
  for (const std::size_t i : {1U, 2U})
    if (std::abs(v[i]) > std::abs(v[axis])) axis = i;
  return axis;
}
/// An ulp of the largest coordinate.
template <class S, class Real = typename S::Real>
Real largest_ulp(S& s) {
  Real largest = 1;
  for (const Triple<Real>* v : s.points())
    for (const Real x : *v) largest = std::max(largest, std::abs(x));
  return ulps_away(largest, 1) - largest;
}

/// Moves the shapes by a power of two on each axis, and says by what.
template <class S, class Real = typename S::Real>
Triple<Real> move_far(S& s, Random& random, int most) {
  const Real far = std::ldexp(Real{1}, random.between(10, most));
  Triple<Real> by{};
  for (Real& x : by) x = random.with_sign(far);
  for (Triple<Real>* v : s.points()) *v = moved(*v, 1, by);
  return by;
}
/// How far away, and by so much at most on each axis.
template <class Real>
Real far_away(Random& random) {
  return std::ldexp(Real{1}, kIsWide<Real> ? random.between(20, 40) : random.between(12, 16));
}
template <class S, class Real = typename S::Real>
void move_anywhere(S& s, Random& random, std::type_identity_t<Real> most) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Real by = random.uniform(-most, most);
    for (Triple<Real>* v : s.points()) (*v)[i] += by;
  }
}
/// Near touching or far from it, and then moved away from the origin, so that the distance is another one.
template <class S>
S far_from_origin(Random& random) {
  const bool near = random.turn(3, S::kClasses) != 0;
  const auto make = [&] {
    S s = S::beside(random);
    const auto by = move_far(s, random, kIsWide<typename S::Real> ? 40 : 16);
    if constexpr (requires { s.after_moving(random, by); }) s.after_moving(random, by);
    reach_somehow(s, random, near);
    return s;
  };
  return near ? searched(random, make) : make();
}

template <class S>
S other_units(Random& random) {
  S s = S::generic(random);
  s.scale(random.between(-24, 24));
  return s;
}

template <class S>
S extreme_scale(Random& random) {
  using Limits = std::numeric_limits<typename S::Real>;
  const int kind = random.turn(3, S::kClasses);
  if (kind == 2) return S::mixed(random);
  S s = S::generic(random);
  if (kind == 0) {  // squares or products that overflow
    s.scale(random.between(Limits::max_exponent / S::kOverflow, Limits::max_exponent - S::kRoom));
  } else {  // that underflow, and subnormal numbers
    s.scale(random.between(Limits::min_exponent - Limits::digits, Limits::min_exponent / S::kOverflow));
    if constexpr (requires { s.lengthen_normal(0); }) s.lengthen_normal(random.between(Limits::min_exponent / 2, 0));
  }
  return s;
}
/// A number of any magnitude whose sums with others do not overflow.
template <class Real>
Real any_magnitude(Random& random) {
  using Limits = std::numeric_limits<Real>;
  return random.with_sign(random.magnitude<Real>(Limits::min_exponent + 2, Limits::max_exponent - 4));
}
template <class Real>
void any_magnitudes(Random& random, std::initializer_list<Triple<Real>*> vectors,
                    std::initializer_list<Real*> lengths) {
  for (Triple<Real>* v : vectors)
    for (Real& x : *v) x = any_magnitude<Real>(random);
  for (Real* x : lengths) *x = std::abs(any_magnitude<Real>(random));
}
template <class S, class Real = typename S::Real>
void any_distances(S& s, Random& random) {
  s.alarm = random.chance(2) ? std::abs(any_magnitude<Real>(random)) : Real{0};
  s.contact = random.chance(2) ? std::abs(any_magnitude<Real>(random)) : Real{0};
}

/// Moved now and then to where coordinates are nearly as large or as small as they may be.
template <class S>
void sometimes_extreme(S& s, Random& random) {
  using Limits = std::numeric_limits<typename S::Real>;
  if (random.chance(5)) s.scale(random.between(Limits::min_exponent + 8, Limits::max_exponent - 36));
}

// Of what crosses a shape, from `start` by `length` directions:

/// Moves the start by one step of one coordinate so that it misses, where one does that, else far back.
template <class S, class Real = typename S::Real>
void step_off(S& s) {
  const Triple<Real> start = s.start;
  for (int steps = 1; steps <= 8; steps *= 2)
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const int by : {-steps, steps}) {
        s.start = start;
        step(s.start[axis], by);
        if (!is_hit(s.query(S::kPair))) return;
      }
  s.start = moved(start, -2 * s.length, s.direction);
}
/// In other units; a fifth misses.
template <class S>
S scaled_or_missed(S s, Random& random) {
  s.scale(random.between(-20, 20));
  if (random.turn(5) == kMissing) step_off(s);
  return s;
}

/// The rows of tables that say the same of many pairs, of a description in both scalars.
template <class D, class F>
struct CommonRows {
  static constexpr Family kNearTouching{
      "near_touching", "up to 4 ulps from touching, most of them searched for wrong decisions of plain arithmetic",
      kOftenWrong, made<near_touching<D>, near_touching<F>>};
  static constexpr Family alarm_edge(std::string_view kept_for) {
    return {"alarm_edge", "exactly at the alarm distance and up to 4 ulps beside it", kept_for,
            made<golden::alarm_edge<D>, golden::alarm_edge<F>>};
  }
  static constexpr Family units(std::string_view kept_for) {
    return {"units", "ordinary questions in units from 2^-24 to 2^24: metres, inches, micrometres", kept_for,
            made<other_units<D>, other_units<F>>};
  }
  static constexpr Family kFarFromOrigin{
      "far_from_origin", "small distances between large coordinates: cancellation, coarse contact points", kTooCoarse,
      made<far_from_origin<D>, far_from_origin<F>>};
  static constexpr Family extreme_scale(
      std::string_view reason = "squares that overflow or underflow, mixed magnitudes, subnormal numbers") {
    return {"extreme_scale", reason, kOrderOfOperations, made<golden::extreme_scale<D>, golden::extreme_scale<F>>};
  }
  static constexpr Family invalid(std::string_view reason, std::string_view kept_for) {
    return {kInvalidFamily, reason, kept_for, spoiled<D::generic, F::generic>, false, true};
  }
};

}  // namespace contact::golden
