// What the families of spheres and of cubes share in making questions: steps by ulps, the search, both scalars.
#pragma once

#include <cmath>
#include <limits>

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

/// Whether plain arithmetic decides a question wrongly; the exact decision is production's.
inline bool fools_plain(const Query& query, Scalar scalar) {
  const bool hit = std::visit([&](const auto& shapes) { return is_hit(shapes, query.distances); }, query.shapes);
  return plain_overlap(query, scalar) != hit;
}

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
