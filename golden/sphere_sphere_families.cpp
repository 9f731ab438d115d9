// The families of questions about two spheres.
#include <bit>
#include <boost/multiprecision/cpp_int.hpp>

#include "contact/sphere_sphere.hpp"
#include "golden/common_families.hpp"

namespace contact::golden {
namespace sphere_sphere_families {
namespace {

template <class Real>
struct Spheres : Described<Real, Pair::sphere_sphere> {
  using Shapes = Spheres;
  using Limits = std::numeric_limits<Real>;
  static constexpr int kAlarmClasses = 1;
  static constexpr int kDigits = Limits::digits;
  static constexpr std::int64_t kTwoToDigits = std::int64_t{1} << kDigits;
  static constexpr Real kTiny = Limits::denorm_min();
  Triple<Real> c1{};
  Real r1{};
  Triple<Real> c2{};
  Real r2{};

  [[nodiscard]] Query query(Pair pair) const { return {pair, Balls{ball(c1, r1), ball(c2, r2)}, this->distances()}; }
  [[nodiscard]] std::array<Triple<Real>*, 2> points() { return {&c1, &c2}; }
  [[nodiscard]] std::array<Real*, 6> coordinates() { return {&c1[0], &c1[1], &c1[2], &c2[0], &c2[1], &c2[2]}; }
  [[nodiscard]] std::array<Real*, 4> lengths() { return {&r1, &r2, &this->alarm, &this->contact}; }
  [[nodiscard]] Real distance() const {
    const Triple<Real> delta = moved(c2, -1, c1);
    return std::sqrt(dot(delta, delta));
  }
  void scale(int e) { lift(e, c1, c2, r1, r2, this->alarm, this->contact); }

  /// Cuts the alarm distance and the radii, one after another, until the spheres just miss each other: the last one cut
  /// is the greatest length that leaves them apart. Spheres of one centre, and those that miss already, stay as they are.
  static void just_miss(Shapes& s, Random& random) {
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

  static Shapes or_just_missed(Shapes s, Random& random) {
    if (random.turn(5) == kMissing) just_miss(s, random);
    return s;
  }

  /// Full-precision numbers of ordinary size, about half of them hits.
  static Shapes generic(Random& random) {
    Shapes s;
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
  static Exactly<Shapes> exact_distance(Random& random) {
    const bool large = random.chance(2);
    const Quadruple q = quadruple(random, kIsWide<Real> ? (large ? 1 << 18 : 48) : (large ? 120 : 12));
    const Integers c = integers(random, kIsWide<Real> ? 1 << 24 : 1 << 10);
    return {between(c, q.delta), 16 * q.d};
  }
  /// Spheres about a point and another one so far from it.
  static Shapes between(const Integers& c, const Integers& delta) {
    Shapes s;
    s.c1 = placed<Real>(c);
    s.c2 = placed<Real>(moved(c, 1, delta));
    return s;
  }
  /// Radii in sixteenths, the first one no less than that; what they leave of a distance.
  static Real share_most(Shapes& s, std::int64_t total, std::int64_t least, Random& random) {
    const std::int64_t first = random.between(least, total / 2);
    const std::int64_t second = random.between<std::int64_t>(0, total - first - 1);
    s.r1 = sixteenths<Real>(first);
    s.r2 = sixteenths<Real>(second);
    return sixteenths<Real>(total - first - second);
  }

  /// Radii that are whole numbers of that sum, or of a unit.
  static void share_out(Shapes& s, std::int64_t sum, Random& random, Real unit = 1) {
    const std::int64_t first = random.between<std::int64_t>(0, sum);
    s.r1 = static_cast<Real>(first) * unit;
    s.r2 = static_cast<Real>(sum - first) * unit;
  }

  static Shapes exactly(Random& random, bool alarmed) {
    auto [s, total, frame] = exact_distance(random);
    if (alarmed) {
      s.alarm = share_most(s, total, 1, random);
      s.contact = s.alarm / Real{4};
      return s;
    }
    share_out(s, total, random, Real{0.0625});
    s.contact = random.chance(2) ? sixteenths<Real>(random.between(0, 32)) : Real{0};
    return s;
  }

  static Shapes touching(Random& random) {
    Shapes s = exactly_touching<Shapes>(random);
    // A coordinate one ulp farther, else a radius one ulp shorter.
    if (random.turn(5) == kMissing && random.chance(2)) {
      const std::size_t axis = random.index(3);
      step(s.c2[axis], s.c2[axis] < s.c1[axis] ? -1 : 1);
    }
    return or_just_missed(s, random);
  }

  /// Radii that leave the surfaces a few ulps apart, beside an alarm distance or none.
  static Shapes near_reach(Random& random, Shapes s, bool alarmed) {
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
      s.contact = any_or_none<Real>(random, 1);
    }
    return s;
  }

  static Shapes nearly(Random& random, bool alarmed) { return near_reach(random, generic(random), alarmed); }

  static Shapes near_touching(Random& random) {
    return searched(random, [&] { return nearly(random, false); });
  }

  static Shapes on_contact_edge(Random& random) {
    if (random.turn(4) == 0) {  // value exactly 0 at a contact distance other than 0
      auto [s, total, frame] = exact_distance(random);
      s.contact = share_most(s, total, 0, random);
      s.alarm = s.contact * Real{2};
      return s;
    }
    Shapes s = generic(random);
    const Real d = s.distance();
    s.r1 = d * random.uniform(Real{0.125}, Real{0.5});
    s.r2 = d * random.uniform(Real{0.125}, Real{0.375});
    s.contact = length(ulps_away((d - s.r1) - s.r2, random.between(-6, 6)));
    s.alarm = s.contact * random.uniform(Real{1.5}, Real{3});
    return s;
  }

  static Shapes contact_edge(Random& random) { return or_just_missed(on_contact_edge(random), random); }

  static Shapes coincident(Random& random) {
    Shapes s = generic(random);
    if (random.turn(8) == 0) s.r1 = 0;
    if (random.turn(8) == 1) s.r2 = 0;
    if (random.turn(8) == 2) s.r1 = s.r2 = 0;
    if (random.turn(8) == 3) s.c1 = {};
    if (random.turn(8) == 4) s.scale(random.between(Limits::min_exponent, Limits::max_exponent - 8));
    s.c2 = s.c1;
    return s;
  }

  static Shapes beside_each_other(Random& random) {
    Shapes s = generic(random);
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
          s.c2[i] = random.with_sign(random.magnitude<Real>(Limits::min_exponent - 10, -20));
    }
    return s;
  }

  static Shapes near_coincident(Random& random) { return or_just_missed(beside_each_other(random), random); }

  static Shapes containment(Random& random) {
    Shapes s = generic(random);
    const Real d = s.distance();
    if (random.turn(4) == 0) {  // touching from inside
      const auto [exact, total, frame] = exact_distance(random);
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

  static Shapes zero_radius(Random& random) {
    const int kind = random.turn(4);
    if (kind < 2) {  // a point exactly on a sphere, two points exactly at the alarm distance
      auto [s, total, frame] = exact_distance(random);
      (kind == 0 ? s.r1 : s.alarm) = sixteenths<Real>(total);
      if (kind == 0 && random.chance(2)) std::swap(s.r1, s.r2);
      return s;
    }
    if (kind == 2)  // a point a few ulps from a sphere
      return searched(random, [&] {
        Shapes s = generic(random);
        s.alarm = 0;
        s.r1 = 0;
        s.r2 = length(ulps_away(s.distance(), random.between(-3, 3)));
        if (random.chance(2)) std::swap(s.r1, s.r2);
        return s;
      });
    Shapes s = generic(random);
    s.r1 = 0;
    if (random.chance(4)) s.r2 = 0;
    return s;
  }

  static Shapes far_from_origin(Random& random) {
    const Real most = far_away<Real>(random);
    const auto make = [&] {
      Shapes s = generic(random);
      move_anywhere(s, random, most);
      return s;
    };
    if (random.turn(2) == 0) return make();
    const bool alarmed = random.chance(2);
    return searched(random, [&] { return near_reach(random, make(), alarmed); });
  }

  static Shapes extreme_scale(Random& random) {
    constexpr int kHalf = Limits::max_exponent / 2;
    Shapes s;
    switch (random.turn(8)) {
      case 0:  // squares overflow
        s = generic(random);
        s.scale(random.between(kHalf, 2 * kHalf - 6));
        return s;
      case 1:  // squares underflow
        s = generic(random);
        s.scale(-random.between(kHalf, 2 * kHalf - 2));
        return s;
      case 2:  // subnormal numbers throughout
        for (Real* x : s.coordinates()) *x = static_cast<Real>(random.between(-200, 200)) * kTiny;
        for (Real* x : s.lengths()) *x = static_cast<Real>(random.between(0, 100)) * kTiny;
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
        for (Real* x : s.coordinates()) *x = random.with_sign(huge());
        for (Real* x : {&s.r1, &s.r2, &s.alarm}) *x = random.chance(3) ? Real{0} : huge();
        s.contact = random.chance(2) ? Real{0} : huge();
        return s;
      }
      case 5: {  // every number of a magnitude of its own
        const auto any = [&] { return random.magnitude<Real>(Limits::min_exponent, Limits::max_exponent - 2); };
        for (Real* x : s.coordinates()) *x = random.with_sign(any());
        for (Real* x : s.lengths()) *x = random.chance(4) ? Real{0} : any();
        return s;
      }
      case 6:  // exactly touching where squares overflow or underflow
        s = exactly(random, false);
        s.scale(random.chance(2) ? 2 * kHalf - 48 : -(2 * kHalf - 16));
        return s;
      default: {  // nearly touching there
        const int exponent =
            random.chance(2) ? random.between(kHalf, 2 * kHalf - 8) : -random.between(kHalf, 2 * kHalf - 30);
        const bool alarmed = random.chance(2);
        s = nearly(random, alarmed);
        s.scale(exponent);
        return s;
      }
    }
  }

  static Shapes one_axis(Random& random) {
    const auto axis = static_cast<std::size_t>(random.turn(3));
    const Real direction = static_cast<Real>(random.turn(2, 3) == 0 ? 1 : -1);
    const auto make = [&] {
      Shapes s = generic(random);
      s.c2 = s.c1;
      s.c2[axis] += direction * random.uniform<Real>(1, 12);
      return s;
    };
    switch (random.turn(3, 6)) {
      case 0:
        return make();
      case 1: {  // exactly touching: the distance is a difference that two radii can share
        Shapes s = make();
        s.alarm = 0;
        s.c1[axis] = static_cast<Real>(random.between(-64, 64));
        const int distance = random.between(1, 64);
        s.c2[axis] = s.c1[axis] + direction * static_cast<Real>(distance);
        share_out(s, 16 * distance, random, Real{0.0625});
        return s;
      }
      default: {
        const bool alarmed = random.chance(2);
        return searched(random, [&] { return near_reach(random, make(), alarmed); });
      }
    }
  }

  // The family hard_to_round. Whole numbers of up to p bits are exact, p being the precision, and everything is made of
  // such: no search but for normals, and no luck.

  /// Two points that differ by whole numbers; each coordinate of the first lies between 0 and minus the difference.
  static Shapes apart_by(const Integers& delta, Random& random) {
    Integers c{};
    for (std::size_t i = 0; i < 3; ++i)
      c[i] = random.between(std::min<std::int64_t>(0, -delta[i]), std::max<std::int64_t>(0, -delta[i]));
    return between(c, delta);
  }

  /// A value beside the middle of two neighbours, 2^-k apart, where k bits cancelled. A reflection keeps D.
  ///   q = y^2 + z^2, x = 2^k q        sqrt(x^2 + q) = x + h - h^2 / 2x + ..    h = 2^-(k+1), short of x + h
  ///   one less: x = 2^k q - 1         sqrt(x^2 + q) = x + h + h / x - ..       beyond it
  static Shapes hard_value(int k, Random& random) {
    const std::int64_t most = kTwoToDigits >> k;  // q in most / 2 + 2 .. most - 1, and x has p bits
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
    Shapes s = apart_by(delta, random);
    // value = v 2^-k + h
    const std::int64_t largest = k == 0 ? x - 1 : kTwoToDigits - 1;
    const std::int64_t v = random.between(kTwoToDigits / 2, largest);
    s.contact = std::ldexp(static_cast<Real>((std::int64_t{1} << k) - v % (std::int64_t{1} << k)), -k);
    share_out(s, x - (v >> k) - 1, random);
    return s;
  }

  /// A component x / sqrt(x^2 + y^2) beside m / 2^s, the middle of two neighbours: y / x is a convergent of
  /// sqrt(4^s - m^2) / m, the best of those for 32 m.
  /// None is exactly in the middle: no normal has a component m / 2^s with m odd and s > 0 (docs/golden.md).
  static Shapes hard_normal(Random& random) {
    // Room for 2 s + 2 kMore bits and a sign, without memory of their own.
    using Backend = boost::multiprecision::cpp_int_backend<640, 640, boost::multiprecision::signed_magnitude,
                                                           boost::multiprecision::unchecked, void>;
    using Whole = boost::multiprecision::number<Backend, boost::multiprecision::et_off>;
    constexpr int kTries = 32;
    constexpr int kMore = 4 * kDigits;  // bits that the convergents do not see
    static_assert(2 * (kDigits + 3) + 2 * kMore <= 640);
    Integers delta{};
    Whole closest = 0;
    for (int tries = 0; tries < kTries; ++tries) {
      const Whole m = kTwoToDigits + 2 * random.between<std::int64_t>(0, kTwoToDigits / 2 - 1) + 1;
      const int s = kDigits + random.between(1, 3);
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
        if (next_y >= kTwoToDigits || next_x >= kTwoToDigits) {
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
    Shapes s = apart_by(delta, random);
    s.r1 = s.distance() * random.uniform(Real{0.125}, Real{0.75});
    s.r2 = s.distance() * random.uniform(Real{0.125}, Real{0.75});
    return s;
  }

  /// A point beside the middle of two neighbours.
  ///   a = (y^2 + z^2 + 3) / 2, x = a - 1, r = (a + 1) / 4      D = a^2 - 2
  ///   r x / sqrt(D) = sqrt(a^2 + 1 / D) / 4 = a / 4 + 1 / 8a^3 - ..      a / 2 odd
  static Shapes hard_point(Random& random) {
    const auto root = static_cast<std::int64_t>(std::sqrt(static_cast<double>(kTwoToDigits)));
    const std::int64_t y = 2 * random.between(root / 4, root / 2 - 1) + 1;
    const std::int64_t z = 4 * random.between(root / 8, root / 4 - 1);
    const std::int64_t a = (y * y + z * z + 3) / 2;
    Shapes s = apart_by({0, y, z}, random);
    const std::int64_t c = random.between(kTwoToDigits / 2 + a / 4 + 1, kTwoToDigits);
    s.c1[0] = static_cast<Real>(-c);
    s.c2[0] = static_cast<Real>(a - 1 - c);
    s.r1 = static_cast<Real>(a + 1) / Real{4};
    s.r2 = s.r1 * random.uniform(Real{0.125}, Real{1});
    return s;
  }

  /// Makes the value of spheres a whole number d >= 3 apart a tie: an odd number less one half or three halves of its
  /// ulp.
  static void tie_value(Shapes& s, std::int64_t d, Random& random) {
    const std::int64_t odd = 2 * random.between<std::int64_t>(1, (d - 1) / 2) + 1;
    share_out(s, d - odd, random);
    const auto bits = static_cast<int>(std::bit_width(static_cast<std::uint64_t>(odd)));
    s.contact = std::ldexp(random.chance(2) ? Real{1} : Real{3}, bits - kDigits - 1);
  }

  /// Makes a coordinate of the first point of spheres a whole number d <= 16 apart a tie: the centre is so far out that
  /// the last bit of r n = delta 2^-shift is half an ulp of it.
  static void tie_point(Shapes& s, const Integers& delta, std::int64_t d, Random& random) {
    const auto axis = static_cast<std::size_t>(delta[0] != 0 ? 0 : delta[1] != 0 ? 1 : 2);
    const int shift = random.between(1, 3);
    const int grid = std::countr_zero(static_cast<std::uint64_t>(std::abs(delta[axis]))) + 1 - shift;
    const std::int64_t c = random.between(kTwoToDigits / 2 + 256, kTwoToDigits - 256);
    s.c1[axis] = random.with_sign(std::ldexp(static_cast<Real>(c), grid));
    s.c2[axis] = s.c1[axis] + static_cast<Real>(delta[axis]);
    s.r1 = std::ldexp(static_cast<Real>(d), -shift);
  }

  /// A tie spoiled by a number so small that only its square enters: how far, nothing bounds but the range.
  static Shapes spoiled_tie(int field, Random& random) {
    if (field == 0) {  // a normal: an odd m of p + 1 bits beside 2^s is m / 2^s less a little
      const std::int64_t m = kTwoToDigits + 2 * random.between<std::int64_t>(0, kTwoToDigits / 2 - 1) + 1;
      const std::int64_t c = random.between(m - kTwoToDigits, kTwoToDigits);
      const int exponent = random.between(2 * kDigits, Limits::max_exponent - 2);
      Shapes s;
      s.c1[0] = static_cast<Real>(-c);
      s.c2[0] = static_cast<Real>(m - c);
      s.c2[1] = std::ldexp(Real{1}, exponent);
      s.r1 = random.uniform(Real{0}, Real{8});
      s.r2 = random.uniform(Real{0}, Real{8});
      s.alarm = s.c2[1] + s.c2[1];
      return s;
    }
    const std::int64_t d = field == 1 ? random.between(std::int64_t{3}, kTwoToDigits >> 10)
                                      : random.between(std::int64_t{1}, std::int64_t{16});
    Shapes s = apart_by({d, 0, 0}, random);
    if (field == 1)
      tie_value(s, d, random);
    else
      tie_point(s, {d, 0, 0}, d, random);
    s.alarm = static_cast<Real>(d) + Real{1};
    s.scale(random.between(0, Limits::max_exponent - kDigits - 16));
    s.c2[1] = std::ldexp(Real{1}, -random.between(kDigits, kDigits - Limits::min_exponent));
    return s;
  }

  /// The axes in another order, some of them mirrored: the numbers of the answer keep their magnitudes.
  static void turn_about(Shapes& s, Random& random) {
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

  static Shapes hard_to_round(Random& random) {
    const int moved = random.turn(3, 7) - 1;  // ties: a number's last bit less, none, more
    Shapes s;
    bool swapped = random.chance(2);
    switch (random.turn(7)) {
      case 0:  // value, as it is or after cancellation
        s = hard_value(random.turn(2, 7) == 0 ? 0 : random.between(2, kDigits - 4), random);
        break;
      case 1:
        s = hard_normal(random);
        break;
      case 2:
      case 3:  // the first point, the second
        s = hard_point(random);
        swapped = random.turn(7) == 3;
        break;
      case 4: {
        Quadruple q = quadruple(random, kIsWide<Real> ? 1 << 18 : 120);
        while (q.d < 3) q = quadruple(random, kIsWide<Real> ? 1 << 18 : 120);
        s = apart_by(q.delta, random);
        tie_value(s, q.d, random);
        s.contact = ulps_away(s.contact, moved);
        break;
      }
      case 5: {
        const Quadruple q = quadruple(random, 2);
        s = apart_by(q.delta, random);
        tie_point(s, q.delta, q.d, random);
        s.r1 = ulps_away(s.r1, moved);
        break;
      }
      default:
        s = spoiled_tie(moved + 1, random);
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
};

using D = Spheres<double>;
using F = Spheres<float>;
using Rows = CommonRows<D, F>;

constexpr Family kFamilies[] = {
    {"generic", "ordinary numbers with full significands: the bulk of what an engine meets", kOrdinary,
     made<D::generic, F::generic>, true},
    {"touching",
     "exactly touching, by Pythagorean quadruples: closed or open; half searched for squares that round apart; "
     "a fifth one ulp apart",
     kInEveryCase, made<D::touching, F::touching>, true},
    {"near_touching", "up to 4 ulps from touching, searched for wrong decisions of plain arithmetic", kOftenWrong,
     made<D::near_touching, F::near_touching>},
    {"alarm_edge", "exactly at the alarm distance and up to 4 ulps beside it; radii, alarm and contact all differ",
     "alarm, contact and both radii differ: no two of them can be confused unseen", made<alarm_edge<D>, alarm_edge<F>>,
     true},
    {"contact_edge",
     "the value changes sign: exactly zero, or what is left after cancellation; a fifth just "
     "beyond the alarm distance",
     "the sign of the value is at stake in every case, and in few others", made<D::contact_edge, F::contact_edge>},
    {"coincident", "one centre for both: no direction, 0/0 in plain arithmetic", kNoDirection,
     made<D::coincident, F::coincident>, true, false, "a distance of 0 is within every reach"},
    {"near_coincident",
     "centres a few ulps or a subnormal number apart: the direction is all that is left; a fifth too small to touch",
     "an absolute epsilon of any size; the mutants have a few sizes", made<D::near_coincident, F::near_coincident>},
    {"containment", "one sphere inside the other, touching from inside included",
     "depths greater than a radius, for engines that stop at a surface", made<D::containment, F::containment>, false,
     false, "a sphere and what is inside it overlap"},
    {"zero_radius", "points: on a surface, beside it, and two of them at the alarm distance",
     "points are spheres: special cases for a radius of zero, which no mutant has in full",
     made<D::zero_radius, F::zero_radius>},
    {"far_from_origin", "small distances between large coordinates: cancellation in delta, coarse contact points",
     kTooCoarse, made<D::far_from_origin, F::far_from_origin>},
    {"extreme_scale", "squares that overflow or underflow, mixed magnitudes, subnormal and the largest finite numbers",
     kOrderOfOperations, made<D::extreme_scale, F::extreme_scale>},
    {"one_axis", "two components of the difference are zero: every axis and direction, zeros must be zeros",
     "the answer is known at sight, on every axis and side: the first questions for a new engine",
     made<D::one_axis, F::one_axis>},
    {"hard_to_round",
     "numbers beside the middle of two neighbours, 2^-20 ulp and much less; exact ties, and ties spoiled; "
     "a fifth just out of reach",
     "one rounding too many shows here and hardly anywhere else; mutants are wrong by more",
     made<D::hard_to_round, F::hard_to_round>},
    Rows::invalid("each number in turn NaN, infinite or negative: it must be refused, not answered", ""),
};

}  // namespace
}  // namespace sphere_sphere_families

std::span<const Family> families_of(const Balls* /*kind*/) { return sphere_sphere_families::kFamilies; }

}  // namespace contact::golden
