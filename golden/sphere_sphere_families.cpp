// The families of questions about two spheres.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "golden/making.hpp"

namespace contact::golden {
namespace {

/// A question in the file's scalar; widening it to double is exact. Only + - * / sqrt and scaling by powers of two make
/// its numbers: each is one IEEE 754 rounding, so every platform makes the same.
template <class Real>
struct Spheres {
  using Triple = std::array<Real, 3>;
  Triple c1{};
  Real r1{};
  Triple c2{};
  Real r2{};
  Real alarm{};
  Real contact{};

  [[nodiscard]] Query query(Pair pair) const {
    const auto ball = [](const Triple& c, Real r) {
      return Ball{{static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])},
                  static_cast<double>(r)};
    };
    return {pair, Balls{ball(c1, r1), ball(c2, r2)}, {static_cast<double>(alarm), static_cast<double>(contact)}};
  }
  [[nodiscard]] Real distance() const {
    const Real x = c2[0] - c1[0];
    const Real y = c2[1] - c1[1];
    const Real z = c2[2] - c1[2];
    return std::sqrt(x * x + y * y + z * z);
  }
  void scale(int exponent) {
    for (Real* x : {&c1[0], &c1[1], &c1[2], &r1, &c2[0], &c2[1], &c2[2], &r2, &alarm, &contact})
      *x = std::ldexp(*x, exponent);
  }
};

template <class Real>
std::array<Real, 3> triple(Random& random, Real low, Real high) {
  return {random.uniform(low, high), random.uniform(low, high), random.uniform(low, high)};
}

template <class Real>
void random_distances(Spheres<Real>& s, Random& random) {
  s.alarm = random.chance(2) ? random.uniform(Real{0}, Real{2}) : Real{0};
  s.contact = random.chance(2) ? random.uniform(Real{0}, Real{1}) : Real{0};
}

/// Full-precision numbers of ordinary size, about half of them hits.
template <class Real>
Spheres<Real> ordinary(Random& random) {
  Spheres<Real> s;
  s.c1 = triple<Real>(random, -10, 10);
  s.c2 = triple<Real>(random, -10, 10);
  s.r1 = random.uniform(Real{0.5}, Real{11});
  s.r2 = random.uniform(Real{0.5}, Real{11});
  random_distances(s, random);
  return s;
}

/// Integers with x^2 + y^2 + z^2 = d^2 (Lebesgue's parametrisation), axes and signs shuffled.
struct Quadruple {
  std::array<std::int64_t, 3> delta;
  std::int64_t d;
};

Quadruple quadruple(Random& random, std::int64_t largest) {
  for (;;) {
    const auto m = random.between<std::int64_t>(0, largest);
    const auto n = random.between<std::int64_t>(0, largest);
    const auto p = random.between<std::int64_t>(0, largest);
    const auto q = random.between<std::int64_t>(0, largest);
    Quadruple result{{m * m + n * n - p * p - q * q, 2 * (m * q + n * p), 2 * (n * q - m * p)},
                     m * m + n * n + p * p + q * q};
    if (result.d == 0) continue;
    std::swap(result.delta[0], result.delta[random.below(3)]);
    std::swap(result.delta[1], result.delta[1 + random.below(2)]);
    for (std::int64_t& x : result.delta)
      if (random.chance(2)) x = -x;
    return result;
  }
}

/// Two spheres whose centres are exactly an integer apart, in sixteenths of a unit; the caller shares out the distance.
/// The sizes leave room for sixteenths, an offset and their sums in the scalar's precision; the larger half of them
/// does not leave room for squares, so that plain arithmetic may miss what touches.
template <class Real>
struct ExactDistance {
  Spheres<Real> spheres;
  std::int64_t sixteenths;
};

template <class Real>
ExactDistance<Real> exact_distance(Random& random) {
  const bool wide = sizeof(Real) == 8;
  const bool large = random.chance(2);
  const Quadruple q = quadruple(random, wide ? (large ? 1 << 18 : 48) : (large ? 120 : 12));
  const std::int64_t offset = wide ? 1 << 24 : 1 << 10;
  ExactDistance<Real> result{{}, 16 * q.d};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::int64_t c = random.between(-offset, offset);
    result.spheres.c1[i] = static_cast<Real>(c);
    result.spheres.c2[i] = static_cast<Real>(c + q.delta[i]);
  }
  return result;
}

template <class Real>
Real sixteenths(std::int64_t n) {
  return static_cast<Real>(n) / Real{16};
}

template <class Real>
Spheres<Real> exactly_touching(Random& random) {
  auto [s, total] = exact_distance<Real>(random);
  const std::int64_t first = random.between<std::int64_t>(0, total);
  s.r1 = sixteenths<Real>(first);
  s.r2 = sixteenths<Real>(total - first);
  s.contact = random.chance(2) ? sixteenths<Real>(random.between(0, 32)) : Real{0};
  return s;
}

template <class Real>
Spheres<Real> touching(Random& random) {
  const auto make = [&] { return exactly_touching<Real>(random); };
  Spheres<Real> s = random.turn(2) == 0 ? make() : searched<Spheres, Real>(random, Pair::sphere_sphere, make);
  s.scale(random.between(-40, 40));
  return s;
}

/// A radius or a distance: not below 0, whatever the steps beside it did.
template <class Real>
Real length(Real x) {
  return std::max(x, Real{0});
}

/// Radii that leave the surfaces a few ulps apart, beside an alarm distance or none.
template <class Real>
Spheres<Real> near_reach(Random& random, Spheres<Real> s, bool alarmed) {
  const Real d = s.distance();
  s.r1 = d * random.uniform(Real{0.125}, Real{0.625});
  const int ulps = random.between(-4, 4);
  if (alarmed) {
    s.r2 = d * random.uniform(Real{0.0625}, Real{0.3125});
    s.alarm = length(ulps_away((d - s.r1) - s.r2, ulps));
    s.contact = s.alarm * random.uniform(Real{0.125}, Real{0.875});
  } else {
    s.alarm = 0;
    s.r2 = length(ulps_away(d - s.r1, ulps));
    s.contact = random.chance(2) ? random.uniform(Real{0}, Real{1}) : Real{0};
  }
  return s;
}

template <class Real>
Spheres<Real> near_touching(Random& random) {
  return searched<Spheres, Real>(random, Pair::sphere_sphere,
                                 [&] { return near_reach(random, ordinary<Real>(random), false); });
}

template <class Real>
Spheres<Real> alarm_edge(Random& random) {
  if (random.turn(3) == 0) {
    auto [s, total] = exact_distance<Real>(random);
    const std::int64_t first = random.between<std::int64_t>(1, total / 2);
    const std::int64_t second = random.between<std::int64_t>(0, total - first - 1);
    s.r1 = sixteenths<Real>(first);
    s.r2 = sixteenths<Real>(second);
    s.alarm = sixteenths<Real>(total - first - second);
    s.contact = s.alarm / Real{4};
    s.scale(random.between(-40, 40));
    return s;
  }
  return searched<Spheres, Real>(random, Pair::sphere_sphere,
                                 [&] { return near_reach(random, ordinary<Real>(random), true); });
}

template <class Real>
Spheres<Real> contact_edge(Random& random) {
  if (random.turn(4) == 0) {  // value exactly 0 at a contact distance other than 0
    auto [s, total] = exact_distance<Real>(random);
    const std::int64_t first = random.between<std::int64_t>(0, total / 2);
    const std::int64_t second = random.between<std::int64_t>(0, total - first - 1);
    s.r1 = sixteenths<Real>(first);
    s.r2 = sixteenths<Real>(second);
    s.contact = sixteenths<Real>(total - first - second);
    s.alarm = s.contact * Real{2};
    return s;
  }
  Spheres<Real> s = ordinary<Real>(random);
  const Real d = s.distance();
  s.r1 = d * random.uniform(Real{0.125}, Real{0.5});
  s.r2 = d * random.uniform(Real{0.125}, Real{0.375});
  s.contact = length(ulps_away((d - s.r1) - s.r2, random.between(-6, 6)));
  s.alarm = s.contact * random.uniform(Real{1.5}, Real{3});
  return s;
}

template <class Real>
Spheres<Real> coincident(Random& random) {
  Spheres<Real> s = ordinary<Real>(random);
  if (random.turn(8) == 0) s.r1 = 0;
  if (random.turn(8) == 1) s.r2 = 0;
  if (random.turn(8) == 2) s.r1 = s.r2 = 0;
  if (random.turn(8) == 3) s.c1 = {};
  if (random.turn(8) == 4)
    s.scale(random.between(std::numeric_limits<Real>::min_exponent, std::numeric_limits<Real>::max_exponent - 8));
  s.c2 = s.c1;
  return s;
}

template <class Real>
Spheres<Real> near_coincident(Random& random) {
  Spheres<Real> s = ordinary<Real>(random);
  constexpr Real kTiny = std::numeric_limits<Real>::denorm_min();
  switch (random.turn(3)) {
    case 0:  // a few ulps apart
      s.c2 = s.c1;
      for (Real& x : s.c2) {
        const int ulps = random.between(-3, 3);
        for (int i = 0; i < std::abs(ulps); ++i) x = std::nextafter(x, ulps > 0 ? Real{100} : Real{-100});
      }
      break;
    case 1:  // subnormal differences around the origin
      for (std::size_t i = 0; i < 3; ++i) {
        s.c1[i] = static_cast<Real>(random.between(-40, 40)) * kTiny;
        s.c2[i] = static_cast<Real>(random.between(-40, 40)) * kTiny;
      }
      break;
    default:  // any small difference, from ulps of the radius down to the subnormal range
      s.c1 = {};
      for (std::size_t i = 0; i < 3; ++i)
        s.c2[i] = random.with_sign(random.magnitude<Real>(std::numeric_limits<Real>::min_exponent - 10, -20));
  }
  return s;
}

template <class Real>
Spheres<Real> containment(Random& random) {
  Spheres<Real> s = ordinary<Real>(random);
  const Real d = s.distance();
  if (random.turn(4) == 0) {  // touching from inside
    auto [exact, total] = exact_distance<Real>(random);
    s = exact;
    s.r2 = sixteenths<Real>(random.between(0, 160));
    s.r1 = s.r2 + sixteenths<Real>(total);
  } else {
    s.r1 = d + s.r2 + random.uniform<Real>(0, 5);
  }
  random_distances(s, random);
  if (random.chance(2)) std::swap(s.r1, s.r2);
  return s;
}

template <class Real>
Spheres<Real> zero_radius(Random& random) {
  switch (random.turn(4)) {
    case 0: {  // a point exactly on a sphere
      auto [s, total] = exact_distance<Real>(random);
      s.r1 = sixteenths<Real>(total);
      if (random.chance(2)) std::swap(s.r1, s.r2);
      return s;
    }
    case 1: {  // two points exactly at the alarm distance
      auto [s, total] = exact_distance<Real>(random);
      s.alarm = sixteenths<Real>(total);
      return s;
    }
    case 2:  // a point a few ulps from a sphere
      return searched<Spheres, Real>(random, Pair::sphere_sphere, [&] {
        Spheres<Real> s = ordinary<Real>(random);
        s.alarm = 0;
        s.r1 = 0;
        s.r2 = length(ulps_away(s.distance(), random.between(-3, 3)));
        if (random.chance(2)) std::swap(s.r1, s.r2);
        return s;
      });
    default: {
      Spheres<Real> s = ordinary<Real>(random);
      s.r1 = 0;
      if (random.chance(4)) s.r2 = 0;
      return s;
    }
  }
}

template <class Real>
Spheres<Real> far_from_origin(Random& random) {
  const bool wide = sizeof(Real) == 8;
  const Real offset = std::ldexp(Real{1}, wide ? random.between(20, 40) : random.between(12, 16));
  const auto moved = [&] {
    Spheres<Real> s = ordinary<Real>(random);
    for (std::size_t i = 0; i < 3; ++i) {
      const Real o = random.uniform(-offset, offset);
      s.c1[i] += o;
      s.c2[i] += o;
    }
    return s;
  };
  if (random.turn(2) == 0) return moved();
  const bool alarmed = random.chance(2);
  return searched<Spheres, Real>(random, Pair::sphere_sphere, [&] { return near_reach(random, moved(), alarmed); });
}

template <class Real>
Spheres<Real> extreme_scale(Random& random) {
  using Limits = std::numeric_limits<Real>;
  constexpr int kHalf = Limits::max_exponent / 2;
  constexpr Real kTiny = Limits::denorm_min();
  Spheres<Real> s;
  switch (random.turn(8)) {
    case 0:  // squares overflow
      s = ordinary<Real>(random);
      s.scale(random.between(kHalf, 2 * kHalf - 6));
      return s;
    case 1:  // squares underflow
      s = ordinary<Real>(random);
      s.scale(-random.between(kHalf, 2 * kHalf - 2));
      return s;
    case 2:  // subnormal numbers throughout
      for (Real* x : {&s.c1[0], &s.c1[1], &s.c1[2], &s.c2[0], &s.c2[1], &s.c2[2]})
        *x = static_cast<Real>(random.between(-200, 200)) * kTiny;
      for (Real* x : {&s.r1, &s.r2, &s.alarm, &s.contact}) *x = static_cast<Real>(random.between(0, 100)) * kTiny;
      return s;
    case 3: {  // delta = (1, tiny, 0): a square that underflows decides, on every axis
      const auto axis = random.below(3);
      const Real scale = std::ldexp(Real{1}, random.between(-20, 20));
      s.c2[axis] = random.with_sign(scale);
      s.c2[(axis + 1) % 3] = random.with_sign(std::ldexp(scale, -random.between(kHalf + kHalf / 8, 2 * kHalf - 32)));
      if (random.chance(2)) s.c2[(axis + 2) % 3] = s.c2[(axis + 1) % 3];
      s.r1 = scale * sixteenths<Real>(random.between(0, 16));
      s.r2 = scale - s.r1;
      if (random.chance(3)) s.alarm = kTiny;
      return s;
    }
    case 4: {  // the largest finite numbers
      const auto huge = [&] {
        return Limits::max() * (random.chance(2) ? Real{1} : random.uniform(Real{0.25}, Real{1}));
      };
      for (Real* x : {&s.c1[0], &s.c1[1], &s.c1[2], &s.c2[0], &s.c2[1], &s.c2[2]}) *x = random.with_sign(huge());
      for (Real* x : {&s.r1, &s.r2, &s.alarm}) *x = random.chance(3) ? Real{0} : huge();
      s.contact = random.chance(2) ? Real{0} : huge();
      return s;
    }
    case 5: {  // every number of a magnitude of its own
      const auto any = [&] { return random.magnitude<Real>(Limits::min_exponent, Limits::max_exponent - 2); };
      for (Real* x : {&s.c1[0], &s.c1[1], &s.c1[2], &s.c2[0], &s.c2[1], &s.c2[2]}) *x = random.with_sign(any());
      for (Real* x : {&s.r1, &s.r2, &s.alarm, &s.contact}) *x = random.chance(4) ? Real{0} : any();
      return s;
    }
    case 6:  // exactly touching where squares overflow or underflow
      s = exactly_touching<Real>(random);
      s.scale(random.chance(2) ? 2 * kHalf - 48 : -(2 * kHalf - 16));
      return s;
    default: {  // nearly touching there
      const int exponent =
          random.chance(2) ? random.between(kHalf, 2 * kHalf - 8) : -random.between(kHalf, 2 * kHalf - 30);
      const bool alarmed = random.chance(2);
      s = near_reach(random, ordinary<Real>(random), alarmed);
      s.scale(exponent);
      return s;
    }
  }
}

template <class Real>
Spheres<Real> one_axis(Random& random) {
  const auto axis = static_cast<std::size_t>(random.turn(3));
  const Real direction = static_cast<Real>(random.turn(2, 3) == 0 ? 1 : -1);
  const auto make = [&] {
    Spheres<Real> s = ordinary<Real>(random);
    s.c2 = s.c1;
    s.c2[axis] += direction * random.uniform<Real>(1, 12);
    return s;
  };
  switch (random.turn(3, 6)) {
    case 0:
      return make();
    case 1: {  // exactly touching: the distance is a difference that two radii can share
      Spheres<Real> s = make();
      s.alarm = 0;
      s.c1[axis] = static_cast<Real>(random.between(-64, 64));
      const int total = 16 * random.between(1, 64);
      s.c2[axis] = s.c1[axis] + direction * sixteenths<Real>(total);
      const int first = random.between(0, total);
      s.r1 = sixteenths<Real>(first);
      s.r2 = sixteenths<Real>(total - first);
      return s;
    }
    default: {
      const bool alarmed = random.chance(2);
      return searched<Spheres, Real>(random, Pair::sphere_sphere, [&] { return near_reach(random, make(), alarmed); });
    }
  }
}

constexpr std::array kFamilies{
    Family{"generic", "ordinary numbers with full significands: the bulk of what an engine meets",
           made<ordinary<double>, ordinary<float>>, true, true},
    Family{"touching",
           "exactly touching, by Pythagorean quadruples: closed or open; half searched for squares that round apart",
           made<touching<double>, touching<float>>, true, true},
    Family{"near_touching", "up to 4 ulps from touching, searched for wrong decisions of plain arithmetic",
           made<near_touching<double>, near_touching<float>>, true, false},
    Family{"alarm_edge",
           "exactly at the alarm distance and up to 4 ulps beside it; radii, alarm and contact all differ",
           made<alarm_edge<double>, alarm_edge<float>>, true, true},
    Family{"contact_edge", "the value changes sign: exactly zero, or what is left after cancellation",
           made<contact_edge<double>, contact_edge<float>>, true, false},
    Family{"coincident", "one centre for both: no direction, 0/0 in plain arithmetic",
           made<coincident<double>, coincident<float>>, true, true},
    Family{"near_coincident", "centres a few ulps or a subnormal number apart: the direction is all that is left",
           made<near_coincident<double>, near_coincident<float>>, true, false},
    Family{"containment", "one sphere inside the other, touching from inside included",
           made<containment<double>, containment<float>>, true, false},
    Family{"zero_radius", "points: on a surface, beside it, and two of them at the alarm distance",
           made<zero_radius<double>, zero_radius<float>>, true, false},
    Family{"far_from_origin", "small distances between large coordinates: cancellation in delta, coarse contact points",
           made<far_from_origin<double>, far_from_origin<float>>, true, false},
    Family{"extreme_scale",
           "squares that overflow or underflow, mixed magnitudes, subnormal and the largest finite numbers",
           made<extreme_scale<double>, extreme_scale<float>>, true, false},
    Family{"one_axis", "two components of the difference are zero: every axis and direction, zeros must be zeros",
           made<one_axis<double>, one_axis<float>>, true, false},
    Family{kInvalidFamily, "each number in turn NaN, infinite or negative: it must be refused, not answered",
           spoiled<ordinary<double>, ordinary<float>>, true, false, true},
};

}  // namespace

std::span<const Family> sphere_families() { return kFamilies; }

}  // namespace contact::golden
