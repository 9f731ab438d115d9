// The families of questions about two spheres.
#include <algorithm>
#include <array>
#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

#include "contact/sphere_sphere.hpp"
#include "golden/making.hpp"

namespace contact::golden {
namespace sphere_sphere_families {
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

/// Cuts the alarm distance and the radii, one after another, until the spheres just miss each other: the last one cut
/// is the greatest length that leaves them apart. Spheres of one centre, and those that miss already, stay as they are.
template <class Real>
void just_miss(Spheres<Real>& s, Random& random) {
  using Bits = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;
  const auto hit = [&] {
    const Query query = s.query(Pair::sphere_sphere);
    return test_sphere_sphere(query.balls()->a, query.balls()->b, query.distances.alarm);
  };
  std::array lengths{&s.alarm, &s.r1, &s.r2};
  if (random.chance(2)) std::swap(lengths[1], lengths[2]);
  if (s.c1 == s.c2 || !hit()) return;
  for (Real* length : lengths) {
    auto hits = std::bit_cast<Bits>(std::exchange(*length, Real{0}));
    if (hit()) continue;
    for (Bits misses = 0; hits - misses > 1;) {  // numbers from 0 on are in the order of their bits
      const Bits middle = misses + (hits - misses) / 2;
      *length = std::bit_cast<Real>(middle);
      (hit() ? hits : misses) = middle;
    }
    *length = std::bit_cast<Real>(hits - 1);
    return;
  }
}

template <class Real>
Spheres<Real> or_just_missed(Spheres<Real> s, Random& random) {
  if (random.turn(5) == kMissing) just_miss(s, random);
  return s;
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
  if (random.turn(5) == kMissing && random.chance(2)) {  // a coordinate one ulp farther, else a radius one ulp shorter
    const std::size_t axis = random.index(3);
    s.c2[axis] = ulps_away(s.c2[axis], s.c2[axis] < s.c1[axis] ? -1 : 1);
  }
  return or_just_missed(s, random);
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
Spheres<Real> on_contact_edge(Random& random) {
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
Spheres<Real> contact_edge(Random& random) {
  return or_just_missed(on_contact_edge<Real>(random), random);
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
Spheres<Real> beside_each_other(Random& random) {
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
Spheres<Real> near_coincident(Random& random) {
  return or_just_missed(beside_each_other<Real>(random), random);
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
      const auto axis = random.index(3);
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

// The family hard_to_round. Whole numbers of up to p bits are exact, p being the precision, and everything is made of
// such: no search but for normals, and no luck.

using Integers = std::array<std::int64_t, 3>;

template <class Real>
constexpr int kDigits = std::numeric_limits<Real>::digits;
template <class Real>
constexpr std::int64_t kTwoToDigits = std::int64_t{1} << kDigits<Real>;

/// Two points that differ by whole numbers; each coordinate of the first lies between 0 and minus the difference.
template <class Real>
Spheres<Real> apart_by(const Integers& delta, Random& random) {
  Spheres<Real> s;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::int64_t c = random.between(std::min<std::int64_t>(0, -delta[i]), std::max<std::int64_t>(0, -delta[i]));
    s.c1[i] = static_cast<Real>(c);
    s.c2[i] = static_cast<Real>(c + delta[i]);
  }
  return s;
}

/// Radii that are whole numbers of that sum.
template <class Real>
void share_out(Spheres<Real>& s, std::int64_t sum, Random& random) {
  const std::int64_t first = random.between<std::int64_t>(0, sum);
  s.r1 = static_cast<Real>(first);
  s.r2 = static_cast<Real>(sum - first);
}

/// A value beside the middle of two neighbours, 2^-k apart, where k bits cancelled. A reflection keeps D.
///   q = y^2 + z^2, x = 2^k q        sqrt(x^2 + q) = x + h - h^2 / 2x + ..    h = 2^-(k+1), short of x + h
///   one less: x = 2^k q - 1         sqrt(x^2 + q) = x + h + h / x - ..       beyond it
template <class Real>
Spheres<Real> hard_value(int k, Random& random) {
  const std::int64_t most = kTwoToDigits<Real> >> k;  // q in most / 2 + 2 .. most - 1, and x has p bits
  const auto root = static_cast<std::int64_t>(std::sqrt(static_cast<double>(most)));
  std::int64_t y = 0;
  std::int64_t z = 0;
  do {
    y = random.between<std::int64_t>(0, root);
    z = random.between<std::int64_t>(0, root);
  } while (y * y + z * z < most / 2 + 2 || y * y + z * z >= most);
  const std::int64_t x = ((y * y + z * z) << k) - (random.chance(2) ? 1 : 0);
  Integers delta{x, y, z};
  if ((x + y + z) % 3 == 0 && random.chance(2))
    for (std::int64_t& component : delta) component -= (x + y + z) / 3 * 2;
  Spheres<Real> s = apart_by<Real>(delta, random);
  // value = v 2^-k + h
  const std::int64_t largest = k == 0 ? x - 1 : kTwoToDigits<Real> - 1;
  const std::int64_t v = random.between(kTwoToDigits<Real> / 2, largest);
  s.contact = std::ldexp(static_cast<Real>((std::int64_t{1} << k) - v % (std::int64_t{1} << k)), -k);
  share_out(s, x - (v >> k) - 1, random);
  return s;
}

/// A component x / sqrt(x^2 + y^2) beside m / 2^s, the middle of two neighbours: y / x is a convergent of
/// sqrt(4^s - m^2) / m, the best of those for 32 m.
/// None is exactly in the middle: no normal has a component m / 2^s with m odd and s > 0 (docs/golden.md).
template <class Real>
Spheres<Real> hard_normal(Random& random) {
  // Room for 2 s + 2 kMore bits and a sign, without memory of their own.
  using Backend = boost::multiprecision::cpp_int_backend<640, 640, boost::multiprecision::signed_magnitude,
                                                         boost::multiprecision::unchecked, void>;
  using Whole = boost::multiprecision::number<Backend, boost::multiprecision::et_off>;
  constexpr int kTries = 32;
  constexpr int kMore = 4 * kDigits<Real>;  // bits that the convergents do not see
  static_assert(2 * (kDigits<Real> + 3) + 2 * kMore <= 640);
  Integers delta{};
  Whole closest = 0;
  for (int tries = 0; tries < kTries; ++tries) {
    const Whole m = kTwoToDigits<Real> + 2 * random.between<std::int64_t>(0, kTwoToDigits<Real> / 2 - 1) + 1;
    const int s = kDigits<Real> + random.between(1, 3);
    Whole over = sqrt(Whole(((Whole(1) << 2 * s) - m * m) << 2 * kMore));
    Whole under = m << kMore;
    Whole y = 1;
    Whole x = 0;
    Whole last_y = 0;
    Whole last_x = 1;
    for (;;) {
      const Whole quotient = over / under;
      const Whole next_y = quotient * y + last_y;
      const Whole next_x = quotient * x + last_x;
      if (next_y >= kTwoToDigits<Real> || next_x >= kTwoToDigits<Real>) {
        if (x * next_x > closest) {  // it is off by less than 1 / (x next_x)
          closest = x * next_x;
          delta = {static_cast<std::int64_t>(x), static_cast<std::int64_t>(y), 0};
        }
        break;
      }
      last_y = std::exchange(y, next_y);
      last_x = std::exchange(x, next_x);
      over = std::exchange(under, Whole(over % under));
    }
  }
  Spheres<Real> s = apart_by<Real>(delta, random);
  s.r1 = s.distance() * random.uniform(Real{0.125}, Real{0.75});
  s.r2 = s.distance() * random.uniform(Real{0.125}, Real{0.75});
  return s;
}

/// A point beside the middle of two neighbours.
///   a = (y^2 + z^2 + 3) / 2, x = a - 1, r = (a + 1) / 4      D = a^2 - 2
///   r x / sqrt(D) = sqrt(a^2 + 1 / D) / 4 = a / 4 + 1 / 8a^3 - ..      a / 2 odd
template <class Real>
Spheres<Real> hard_point(Random& random) {
  const auto root = static_cast<std::int64_t>(std::sqrt(static_cast<double>(kTwoToDigits<Real>)));
  const std::int64_t y = 2 * random.between(root / 4, root / 2 - 1) + 1;
  const std::int64_t z = 4 * random.between(root / 8, root / 4 - 1);
  const std::int64_t a = (y * y + z * z + 3) / 2;
  Spheres<Real> s = apart_by<Real>({0, y, z}, random);
  const std::int64_t c = random.between(kTwoToDigits<Real> / 2 + a / 4 + 1, kTwoToDigits<Real>);
  s.c1[0] = static_cast<Real>(-c);
  s.c2[0] = static_cast<Real>(a - 1 - c);
  s.r1 = static_cast<Real>(a + 1) / Real{4};
  s.r2 = s.r1 * random.uniform(Real{0.125}, Real{1});
  return s;
}

/// Makes the value of spheres a whole number d >= 3 apart a tie: an odd number less one half or three halves of its
/// ulp.
template <class Real>
void tie_value(Spheres<Real>& s, std::int64_t d, Random& random) {
  const std::int64_t odd = 2 * random.between<std::int64_t>(1, (d - 1) / 2) + 1;
  share_out(s, d - odd, random);
  const auto bits = static_cast<int>(std::bit_width(static_cast<std::uint64_t>(odd)));
  s.contact = std::ldexp(random.chance(2) ? Real{1} : Real{3}, bits - kDigits<Real> - 1);
}

/// Makes a coordinate of the first point of spheres a whole number d <= 16 apart a tie: the centre is so far out that
/// the last bit of r n = delta 2^-shift is half an ulp of it.
template <class Real>
void tie_point(Spheres<Real>& s, const Integers& delta, std::int64_t d, Random& random) {
  const auto axis = static_cast<std::size_t>(delta[0] != 0 ? 0 : delta[1] != 0 ? 1 : 2);
  const int shift = random.between(1, 3);
  const int grid = std::countr_zero(static_cast<std::uint64_t>(std::abs(delta[axis]))) + 1 - shift;
  const std::int64_t c = random.between(kTwoToDigits<Real> / 2 + 256, kTwoToDigits<Real> - 256);
  s.c1[axis] = random.with_sign(std::ldexp(static_cast<Real>(c), grid));
  s.c2[axis] = s.c1[axis] + static_cast<Real>(delta[axis]);
  s.r1 = std::ldexp(static_cast<Real>(d), -shift);
}

/// A tie spoiled by a number so small that only its square enters: how far, nothing bounds but the range.
template <class Real>
Spheres<Real> spoiled_tie(int field, Random& random) {
  using Limits = std::numeric_limits<Real>;
  if (field == 0) {  // a normal: an odd m of p + 1 bits beside 2^s is m / 2^s less a little
    const std::int64_t m = kTwoToDigits<Real> + 2 * random.between<std::int64_t>(0, kTwoToDigits<Real> / 2 - 1) + 1;
    const std::int64_t c = random.between(m - kTwoToDigits<Real>, kTwoToDigits<Real>);
    const int exponent = random.between(2 * kDigits<Real>, Limits::max_exponent - 2);
    Spheres<Real> s;
    s.c1[0] = static_cast<Real>(-c);
    s.c2[0] = static_cast<Real>(m - c);
    s.c2[1] = std::ldexp(Real{1}, exponent);
    s.r1 = random.uniform(Real{0}, Real{8});
    s.r2 = random.uniform(Real{0}, Real{8});
    s.alarm = s.c2[1] + s.c2[1];
    return s;
  }
  const std::int64_t d = field == 1 ? random.between(std::int64_t{3}, kTwoToDigits<Real> >> 10)
                                    : random.between(std::int64_t{1}, std::int64_t{16});
  Spheres<Real> s = apart_by<Real>({d, 0, 0}, random);
  if (field == 1)
    tie_value(s, d, random);
  else
    tie_point(s, {d, 0, 0}, d, random);
  s.alarm = static_cast<Real>(d) + Real{1};
  s.scale(random.between(0, Limits::max_exponent - kDigits<Real> - 16));
  s.c2[1] = std::ldexp(Real{1}, -random.between(kDigits<Real>, kDigits<Real> - Limits::min_exponent));
  return s;
}

/// The axes in another order, some of them mirrored: the numbers of the answer keep their magnitudes.
template <class Real>
void turn_about(Spheres<Real>& s, Random& random) {
  const auto swap_axes = [&](std::size_t i, std::size_t j) {
    std::swap(s.c1[i], s.c1[j]);
    std::swap(s.c2[i], s.c2[j]);
  };
  swap_axes(0, random.index(3));
  swap_axes(1, 1 + random.index(2));
  for (std::size_t i = 0; i < 3; ++i)
    if (random.chance(2)) {
      s.c1[i] = -s.c1[i];
      s.c2[i] = -s.c2[i];
    }
}

template <class Real>
Spheres<Real> hard_to_round(Random& random) {
  const bool wide = sizeof(Real) == 8;
  const int moved = random.turn(3, 7) - 1;  // ties: a number's last bit less, none, more
  Spheres<Real> s;
  bool swapped = random.chance(2);
  switch (random.turn(7)) {
    case 0:  // value, as it is or after cancellation
      s = hard_value<Real>(random.turn(2, 7) == 0 ? 0 : random.between(2, kDigits<Real> - 4), random);
      break;
    case 1:
      s = hard_normal<Real>(random);
      break;
    case 2:
    case 3:  // the first point, the second
      s = hard_point<Real>(random);
      swapped = random.turn(7) == 3;
      break;
    case 4: {
      Quadruple q = quadruple(random, wide ? 1 << 18 : 120);
      while (q.d < 3) q = quadruple(random, wide ? 1 << 18 : 120);
      s = apart_by<Real>(q.delta, random);
      tie_value(s, q.d, random);
      s.contact = ulps_away(s.contact, moved);
      break;
    }
    case 5: {
      const Quadruple q = quadruple(random, 2);
      s = apart_by<Real>(q.delta, random);
      tie_point(s, q.delta, q.d, random);
      s.r1 = ulps_away(s.r1, moved);
      break;
    }
    default:
      s = spoiled_tie<Real>(moved + 1, random);
  }
  if (s.alarm == 0) {
    s.alarm = s.distance() * random.uniform(Real{1.25}, Real{2});
    s.scale(random.between(-40, 40));
  }
  if (swapped) {
    std::swap(s.c1, s.c2);
    std::swap(s.r1, s.r2);
  }
  turn_about(s, random);
  return or_just_missed(s, random);
}

constexpr std::array kFamilies{
    Family{"generic", "ordinary numbers with full significands: the bulk of what an engine meets",
           "ordinary numbers: what fails here fails its users, and other families do not say so",
           made<ordinary<double>, ordinary<float>>, true},
    Family{"touching",
           "exactly touching, by Pythagorean quadruples: closed or open; half searched for squares that round apart; "
           "a fifth one ulp apart",
           "a strict comparison, or any tolerance, shows in every case and not by chance",
           made<touching<double>, touching<float>>, true},
    Family{"near_touching", "up to 4 ulps from touching, searched for wrong decisions of plain arithmetic",
           "plain arithmetic decides most of it wrongly: how often is an engine's measure",
           made<near_touching<double>, near_touching<float>>, false},
    Family{"alarm_edge",
           "exactly at the alarm distance and up to 4 ulps beside it; radii, alarm and contact all differ",
           "alarm, contact and both radii differ: no two of them can be confused unseen",
           made<alarm_edge<double>, alarm_edge<float>>, true},
    Family{"contact_edge",
           "the value changes sign: exactly zero, or what is left after cancellation; a fifth just "
           "beyond the alarm distance",
           "the sign of the value is at stake in every case, and in few others",
           made<contact_edge<double>, contact_edge<float>>, false},
    Family{"coincident", "one centre for both: no direction, 0/0 in plain arithmetic",
           "no direction: what an engine does instead, under whichever convention it declares",
           made<coincident<double>, coincident<float>>, true, false, "a distance of 0 is within every reach"},
    Family{
        "near_coincident",
        "centres a few ulps or a subnormal number apart: the direction is all that is left; a fifth too small to touch",
        "an absolute epsilon of any size; the mutants have a few sizes",
        made<near_coincident<double>, near_coincident<float>>, false},
    Family{"containment", "one sphere inside the other, touching from inside included",
           "depths greater than a radius, for engines that stop at a surface",
           made<containment<double>, containment<float>>, false, false, "a sphere and what is inside it overlap"},
    Family{"zero_radius", "points: on a surface, beside it, and two of them at the alarm distance",
           "points are spheres: special cases for a radius of zero, which no mutant has in full",
           made<zero_radius<double>, zero_radius<float>>, false},
    Family{"far_from_origin", "small distances between large coordinates: cancellation in delta, coarse contact points",
           "coordinates that a smaller format, or a tolerance that grows, cannot hold",
           made<far_from_origin<double>, far_from_origin<float>>, false},
    Family{"extreme_scale",
           "squares that overflow or underflow, mixed magnitudes, subnormal and the largest finite numbers",
           "overflow and underflow depend on an engine's own order of operations",
           made<extreme_scale<double>, extreme_scale<float>>, false},
    Family{"one_axis", "two components of the difference are zero: every axis and direction, zeros must be zeros",
           "the answer is known at sight, on every axis and side: the first questions for a new engine",
           made<one_axis<double>, one_axis<float>>, false},
    Family{"hard_to_round",
           "numbers beside the middle of two neighbours, 2^-20 ulp and much less; exact ties, and ties spoiled; "
           "a fifth just out of reach",
           "one rounding too many shows here and hardly anywhere else; mutants are wrong by more",
           made<hard_to_round<double>, hard_to_round<float>>, false},
    Family{kInvalidFamily, "each number in turn NaN, infinite or negative: it must be refused, not answered", "",
           spoiled<ordinary<double>, ordinary<float>>, false, true},
};

}  // namespace
}  // namespace sphere_sphere_families

std::span<const Family> families_of(const Balls* /*kind*/) { return sphere_sphere_families::kFamilies; }

}  // namespace contact::golden
