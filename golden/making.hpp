// What the families share in making questions: steps by ulps, exact distances, the search, both scalars, and what their
// tables say more than once.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "contact/pair_functions.hpp"
#include "golden/families.hpp"
#include "golden/plain_segments.hpp"

namespace contact::golden {

/// x moved by that many numbers of its format.
template <class Real>
Real ulps_away(Real x, int ulps) {
  for (; ulps > 0; --ulps) x = std::nextafter(x, std::numeric_limits<Real>::infinity());
  for (; ulps < 0; ++ulps) x = std::nextafter(x, -std::numeric_limits<Real>::infinity());
  return x;
}
template <class Real>
void step(Real& x, int ulps) {
  x = ulps_away(x, ulps);
}
/// Numbers and vectors times a power of two.
template <class... Numbers>
void lift(int exponent, Numbers&... numbers) {
  const auto one = [&]<class Number>(Number& x) {
    if constexpr (std::is_floating_point_v<Number>)
      x = std::ldexp(x, exponent);
    else
      for (auto& component : x) component = std::ldexp(component, exponent);
  };
  (one(numbers), ...);
}

/// The exact decision, which is production's.
inline bool is_hit(const Query& query) {
  return std::visit([&](const auto& shapes) { return is_hit(shapes, query.distances); }, query.shapes);
}

/// Whether plain arithmetic decides a question wrongly.
inline bool fools_plain(const Query& query, Scalar scalar) { return plain_overlap(query, scalar) != is_hit(query); }

template <class Real>
Ball ball(const Triple<Real>& center, Real radius) {
  return {widened(center), static_cast<double>(radius)};
}
template <class Real>
Triangle triangle(const std::array<Triple<Real>, 3>& v) {
  return {{widened(v[0]), widened(v[1]), widened(v[2])}};
}

/// The first pair of two shapes, for the others too.
template <class A, class B>
constexpr Pair pair_of() {
  return *std::find_if(kPairs.begin(), kPairs.end(), [](Pair pair) {
    return of_shapes(pair, []<class X, class Y>() { return std::same_as<X, A> && std::same_as<Y, B>; });
  });
}

template <class Real>
inline constexpr bool kIsWide = sizeof(Real) == 8;

/// Two shapes in a file's scalar; widening it to double is exact. Only + - * / sqrt, scaling by powers of two and exact
/// decisions make their numbers, so every platform makes the same. The first pair of a kind stands for all.
template <class Of, Pair kOf>
struct Described {
  using Real = Of;
  static constexpr Pair kPair = kOf;
  // What golden/common_families.hpp asks; most are like this.
  static constexpr int kClasses = 7;
  static constexpr int kAlarmClasses = 7;
  static constexpr int kUnits = 40;
  static constexpr int kOverflow = 4;
  static constexpr int kRoom = 8;
  Real alarm{};
  Real contact{};

  [[nodiscard]] Distances distances() const { return {static_cast<double>(alarm), static_cast<double>(contact)}; }
};

/// Three of four times searched for a question that plain arithmetic decides wrongly, else the first one made.
template <class Make>
auto searched(Random& random, Make make) {
  using Shapes = decltype(make());
  constexpr int kTries = 256;
  constexpr Scalar kScalar = kIsWide<typename Shapes::Real> ? Scalar::binary64 : Scalar::binary32;
  Shapes first = make();
  if (random.chance(4)) return first;
  Shapes shapes = first;
  for (int tries = 0; tries < kTries; ++tries, shapes = make())
    if (fools_plain(shapes.query(Shapes::kPair), kScalar)) return shapes;
  return first;
}

template <class Real>
Triple<Real> triple(Random& random, Real low, Real high) {
  return {random.uniform(low, high), random.uniform(low, high), random.uniform(low, high)};
}

/// A number up to so much, or as often 0.
template <class Real>
Real any_or_none(Random& random, std::type_identity_t<Real> most) {
  return random.chance(2) ? random.uniform(Real{0}, most) : Real{0};
}
template <class Shapes, class Real = typename Shapes::Real>
void random_distances(Shapes& s, Random& random, std::type_identity_t<Real> alarm = 2,
                      std::type_identity_t<Real> contact = 1) {
  s.alarm = any_or_none<Real>(random, alarm);
  s.contact = any_or_none<Real>(random, contact);
}

using Integers = Triple<std::int64_t>;

inline Integers integers(Random& random, std::int64_t most) {
  Integers x{};
  for (std::int64_t& c : x) c = random.between(-most, most);
  return x;
}
template <class Real>
Triple<Real> placed(const Integers& x) {
  return {static_cast<Real>(x[0]), static_cast<Real>(x[1]), static_cast<Real>(x[2])};
}

/// Integers with x^2 + y^2 + z^2 = d^2 (Lebesgue's parametrisation), axes and signs shuffled.
struct Quadruple {
  Integers delta;
  std::int64_t d;
};

/// Axes in another order, and signs.
inline void shuffle(Integers& x, Random& random) {
  std::swap(x[0], x[random.index(3)]);
  std::swap(x[1], x[1 + random.index(2)]);
  for (std::int64_t& c : x)
    if (random.chance(2)) c = -c;
}

inline Quadruple quadruple(Random& random, std::int64_t largest) {
  for (;;) {
    const auto m = random.between<std::int64_t>(0, largest);
    const auto n = random.between<std::int64_t>(0, largest);
    const auto p = random.between<std::int64_t>(0, largest);
    const auto q = random.between<std::int64_t>(0, largest);
    Quadruple result{{m * m + n * n - p * p - q * q, 2 * (m * q + n * p), 2 * (n * q - m * p)},
                     m * m + n * n + p * p + q * q};
    if (result.d == 0) continue;
    shuffle(result.delta, random);
    return result;
  }
}

/// The rows of a matrix of integers, orthogonal and of one integer length (Euler-Rodrigues), in random order and signs.
struct Frame {
  std::array<Integers, 3> rows{};
  std::int64_t length{};

  [[nodiscard]] Integers at(const Integers& v) const {
    return moved(moved(moved({}, v[0], rows[0]), v[1], rows[1]), v[2], rows[2]);
  }
  /// (n first + height third) / length where that is on the grid for some n: the foot on the first row is height third /
  /// length, a fraction.
  [[nodiscard]] std::optional<Integers> between_grid_points(std::int64_t height) const {
    for (std::int64_t n = 1; n < std::min<std::int64_t>(length, 1000); ++n)
      if (const auto [x, y, z] = at({n, 0, height}); x % length == 0 && y % length == 0 && z % length == 0)
        return Integers{x / length, y / length, z / length};
    return std::nullopt;
  }
};

inline Frame frame(Random& random, std::int64_t largest) {
  for (;;) {
    const auto k = random.between(-largest, largest);
    const auto [x, y, z] = integers(random, largest);
    Frame made{{{{k * k + x * x - y * y - z * z, 2 * (x * y - k * z), 2 * (x * z + k * y)},
                 {2 * (x * y + k * z), k * k - x * x + y * y - z * z, 2 * (y * z - k * x)},
                 {2 * (x * z - k * y), 2 * (y * z + k * x), k * k - x * x - y * y + z * z}}},
               k * k + x * x + y * y + z * z};
    if (made.length == 0) continue;
    std::swap(made.rows[0], made.rows[random.index(3)]);
    for (Integers& row : made.rows)
      if (random.chance(2)) row = moved({}, -1, row);
    return made;
  }
}

template <class Real>
Real sixteenths(std::int64_t n) {
  return static_cast<Real>(n) / Real{16};
}

/// A radius or a distance: not below 0, whatever the steps beside it did.
template <class Real>
Real length(Real x) {
  return std::max(x, Real{0});
}

/// One question in five of a family about contacts misses, so that nobody is right who always says hit: that one of
/// five. Classes take turns by other primes, so each of them has its misses.
inline constexpr int kMissing = 3;

/// A family's function of both scalars, made of its instances for double and float.
template <auto Wide, auto Narrow>
Query made(Pair pair, Scalar scalar, Random& random) {
  return scalar == Scalar::binary32 ? Narrow(random).query(pair) : Wide(random).query(pair);
}

/// The family `invalid` on top of an ordinary one.
template <auto Wide, auto Narrow>
Query spoiled(Pair pair, Scalar scalar, Random& random) {
  Query query = made<Wide, Narrow>(pair, scalar, random);
  spoil(query, random);
  return query;
}

/// A row of a table that not every pair has; where it is not there it has no name.
inline Family where(bool is_there, const Family& family) { return is_there ? family : Family{}; }
inline std::vector<Family> without_gaps(std::vector<Family> all) {
  std::erase_if(all, [](const Family& family) { return family.name.empty(); });
  return all;
}

// What tables say of a family of more than one pair: why it is there.
inline constexpr std::string_view kOrdinary =
    "ordinary numbers: what fails here fails its users, and other families do not say so";
inline constexpr std::string_view kInEveryCase =
    "a strict comparison, or any tolerance, shows in every case and not by chance";
inline constexpr std::string_view kOftenWrong =
    "plain arithmetic decides most of it wrongly: how often is an engine's measure";
inline constexpr std::string_view kNoDirection =
    "no direction: what an engine does instead, under whichever convention it declares";
inline constexpr std::string_view kRoundingTwice =
    "rounding twice, or away from even; and a result that no number of digits decides";
inline constexpr std::string_view kTooCoarse =
    "coordinates that a smaller format, or a tolerance that grows, cannot hold";
inline constexpr std::string_view kOrderOfOperations =
    "overflow and underflow depend on an engine's own order of operations";

}  // namespace contact::golden
