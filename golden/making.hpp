// What the families share in making questions: steps by ulps, exact distances, the search, both scalars.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "contact/pair_functions.hpp"
#include "golden/families.hpp"
#include "golden/plain.hpp"

namespace contact::golden {

/// x moved by that many numbers of its format.
template <class Real>
Real ulps_away(Real x, int ulps) {
  for (; ulps > 0; --ulps) x = std::nextafter(x, std::numeric_limits<Real>::infinity());
  for (; ulps < 0; ++ulps) x = std::nextafter(x, -std::numeric_limits<Real>::infinity());
  return x;
}

/// The exact decision, which is production's.
inline bool is_hit(const Query& query) {
  return std::visit([&](const auto& shapes) { return is_hit(shapes, query.distances); }, query.shapes);
}

/// Whether plain arithmetic decides a question wrongly.
inline bool fools_plain(const Query& query, Scalar scalar) { return plain_overlap(query, scalar) != is_hit(query); }

/// Three of four times searched for a question that plain arithmetic decides wrongly, else the first one made.
/// Shapes<Real> is what `make` makes.
template <template <class> class Shapes, class Real, class Make>
Shapes<Real> searched(Random& random, Pair pair, Make make) {
  constexpr int kTries = 256;
  constexpr Scalar kScalar = sizeof(Real) == 4 ? Scalar::binary32 : Scalar::binary64;
  Shapes<Real> first = make();
  if (random.chance(4)) return first;
  Shapes<Real> shapes = first;
  for (int tries = 0; tries < kTries; ++tries, shapes = make())
    if (fools_plain(shapes.query(pair), kScalar)) return shapes;
  return first;
}

template <class Real>
std::array<Real, 3> triple(Random& random, Real low, Real high) {
  return {random.uniform(low, high), random.uniform(low, high), random.uniform(low, high)};
}

/// Integers with x^2 + y^2 + z^2 = d^2 (Lebesgue's parametrisation), axes and signs shuffled.
struct Quadruple {
  std::array<std::int64_t, 3> delta;
  std::int64_t d;
};

inline Quadruple quadruple(Random& random, std::int64_t largest) {
  for (;;) {
    const auto m = random.between<std::int64_t>(0, largest);
    const auto n = random.between<std::int64_t>(0, largest);
    const auto p = random.between<std::int64_t>(0, largest);
    const auto q = random.between<std::int64_t>(0, largest);
    Quadruple result{{m * m + n * n - p * p - q * q, 2 * (m * q + n * p), 2 * (n * q - m * p)},
                     m * m + n * n + p * p + q * q};
    if (result.d == 0) continue;
    std::swap(result.delta[0], result.delta[random.index(3)]);
    std::swap(result.delta[1], result.delta[1 + random.index(2)]);
    for (std::int64_t& x : result.delta)
      if (random.chance(2)) x = -x;
    return result;
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

}  // namespace contact::golden
