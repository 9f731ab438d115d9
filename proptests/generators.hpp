// Generators of questions for the laws: RapidCheck's own doubles are never subnormal or one ulp from anything.
#pragma once

#include <rapidcheck.h>

#include <array>
#include <cstddef>
#include <functional>
#include <iosfwd>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "oracle/truth/query.hpp"

namespace contact {

/// How RapidCheck prints a question: as the line that `contact-oracle explain` reads.
void showValue(const Query& query, std::ostream& out);

}  // namespace contact

namespace contact::proptests {

/// The numbers that questions are made of: those of a scalar whose magnitude is 0 or from `least` to `most`.
struct Range {
  explicit Range(Scalar of = Scalar::binary64, double least_magnitude = 0,
                 double most_magnitude = std::numeric_limits<double>::infinity());

  [[nodiscard]] bool contains(double x) const;
  /// Whether a question is inside the domain and every number of it is one of these.
  [[nodiscard]] bool contains(const Query& query) const;
  /// x rounded to the scalar, at most the largest finite number.
  [[nodiscard]] double rounded(double x) const;
  /// The same of every coordinate; 0 in the place of what is no number.
  [[nodiscard]] Vector3 rounded(const Vector3& v) const;
  /// The same digits in a binade of the range, rounded.
  [[nodiscard]] double fitted(double x) const;
  /// x moved by a number of ulps, never past the largest finite number.
  [[nodiscard]] double moved(double x, int ulps) const;

  Scalar scalar;
  double least;
  double most;
  int bottom;  ///< the numbers of the binades from 2^bottom to 2^top are in the range
  int top;
};

/// A generator of full width whatever the case's size: RapidCheck's integers are small in its first cases.
template <class T>
rc::Gen<T> full_size(rc::Gen<T> gen) {
  return rc::gen::resize(rc::kNominalSize, std::move(gen));
}
[[nodiscard]] rc::Gen<int> integer(int least, int most);

// Numbers, each kind for a reason.

/// Any digits in any binade: every scale beside every other.
[[nodiscard]] rc::Gen<double> any_bits(const Range& range);
/// Subnormals, where plain products vanish; where the range has none, its lowest binade.
[[nodiscard]] rc::Gen<double> subnormal(const Range& range);
/// The ends of the range and of its parts, and both zeros.
[[nodiscard]] rc::Gen<double> extreme(const Range& range);
/// Numbers of the topmost binades, where sums of a few overflow.
[[nodiscard]] rc::Gen<double> huge(const Range& range);
/// A small integer times a power of two: sums, products and roots that are exact, and so ties.
[[nodiscard]] rc::Gen<double> small_dyadic(const Range& range);
/// A neighbour of such a number: one ulp from everything that it meets.
[[nodiscard]] rc::Gen<double> beside_dyadic(const Range& range);
/// A full significand of ordinary size.
[[nodiscard]] rc::Gen<double> ordinary(const Range& range);
[[nodiscard]] rc::Gen<double> any_number(const Range& range);
[[nodiscard]] rc::Gen<std::vector<double>> numbers(std::size_t count, rc::Gen<double> number);

// Questions. What is put together may leave the range; Range::contains tells.

// Questions of each kind of pairs, in files of their own; the pointer says which, and is nullptr.
#define CONTACT_DECLARE(A, B) [[nodiscard]] rc::Gen<Query> queries(const Two<A, B>* kind, const Range& range);
CONTACT_KINDS(CONTACT_DECLARE)
#undef CONTACT_DECLARE
/// Of any two convex shapes the pair says which.
[[nodiscard]] rc::Gen<Query> queries(Pair pair, const Convexes* kind, const Range& range);

/// A question of a pair from numbers in its order: a length takes their size, a direction of 0 becomes another, and the
/// corners of a box are put in order. Numbers that are not there are 0.
[[nodiscard]] Query query_of(Pair pair, const std::vector<double>& numbers);
/// Numbers of one kind, whatever they make.
[[nodiscard]] rc::Gen<Query> made_of(Pair pair, rc::Gen<double> number);
/// Lengths that put shapes with a distance at touching as double computes it, and up to 2 ulps off: exact decisions part
/// from rounded ones here. The first radius is what is left of the distance by the second one, or by the alarm distance.
[[nodiscard]] rc::Gen<Query> nearly_touching(const Range& range, rc::Gen<Query> laid);
/// Questions made of numbers of each kind, laid out by `laid` from such numbers, and of these nearly touching; and
/// those that touch exactly.
using LaidOut = std::function<rc::Gen<Query>(rc::Gen<double> number)>;
[[nodiscard]] rc::Gen<Query> at_every_scale(Pair pair, const Range& range, const LaidOut& laid,
                                            rc::Gen<Query> touching);
/// The radii of the shapes that have one.
[[nodiscard]] std::vector<double*> radii_of(Query& query);

/// Integers x^2 + y^2 + z^2 = d^2.
using Quadruple = std::array<int, 4>;
inline const std::vector<Quadruple> kQuadruples{{1, 2, 2, 3}, {2, 3, 6, 7},  {3, 4, 0, 5},  {1, 4, 8, 9},
                                                {0, 0, 1, 1}, {2, 6, 9, 11}, {8, 9, 12, 17}};
/// Pythagorean quadruples at any scale: the distance is an integer, so touching is exact and one ulp less is a miss.
[[nodiscard]] rc::Gen<Query> spheres_on_a_quadruple(const Range& range);
/// Coincident centres; and, unless `exactly`, centres that differ by the smallest number on one axis.
[[nodiscard]] rc::Gen<Query> spheres_coincident(const Range& range, rc::Gen<double> number, bool exactly);
/// Spheres that reach each other exactly, in small integers times a power of two, so that plain arithmetic is exact;
/// at alarm 0, or by a positive alarm distance.
[[nodiscard]] rc::Gen<Query> spheres_touching(const Range& range, bool by_alarm);
/// Boxes apart by exactly the alarm distance (0 unless `by_alarm`) on one axis, on one grid of integers.
[[nodiscard]] rc::Gen<Query> boxes_touching(const Range& range, bool by_alarm);
/// A sphere whose centre is on the surface of a box, or inside.
[[nodiscard]] rc::Gen<Query> sphere_on_box(const Range& range, rc::Gen<double> number);
[[nodiscard]] rc::Gen<Query> sphere_in_box(const Range& range, rc::Gen<double> number);
/// A sphere that reaches a face, an edge or a corner of a box exactly, as two spheres do.
[[nodiscard]] rc::Gen<Query> sphere_touching_box(const Range& range, bool by_alarm);
/// A question of a pair.
[[nodiscard]] rc::Gen<Query> queries(Pair pair, const Range& range);
/// The same spoiled: one number is NaN, infinite, negative where that is wrong, or a minimum above its maximum.
[[nodiscard]] rc::Gen<Query> bad_queries(Pair pair, const Range& range);

/// The point half way between two, where it is a point of doubles.
[[nodiscard]] std::optional<Vector3> exact_middle(const Vector3& start, const Vector3& end);

/// The first `count` questions of a generator for one fixed seed.
[[nodiscard]] std::vector<Query> sample(const rc::Gen<Query>& gen, int count);

}  // namespace contact::proptests
