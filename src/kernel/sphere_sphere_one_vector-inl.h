// The contact of one pair of balls in one vector of four numbers, (x, y, z) and one more: sphere_sphere_formula-inl.h,
// and whether every number is certain. Included after the lanes: production's are four doubles, those of tests four
// numbers so short that all of them can be tried.

#include "kernel/double_double-inl.h"

using Double2 = DoubleDouble<Number>;
using Delta = DoubleDouble<Axes>;

CONTACT_LANES Axes product(const Delta& d, Number k) { return hn::Mul(d.high, all<Axes>(k)); }
CONTACT_LANES Axes product_rest(const Delta& d, Number k, const Axes& q) {
  return hn::MulAdd(d.low, all<Axes>(k), hn::MulSub(d.high, all<Axes>(k), q));
}
CONTACT_LANES Axes times_plus(const Axes& a, Number k, const Axes& c) { return hn::MulAdd(a, all<Axes>(k), c); }

#include "kernel/sphere_sphere_formula-inl.h"

/// The contact of a hit. D' is |b - a|^2 in plain arithmetic, a normal number of 2^-900 at least; point k is
/// c + signed_radius n. False where some number is not certain; what `contact` holds then is not specified.
/// Domain      to nearest, subnormals kept.
CONTACT_LANES bool contact_of_hit(Axes first, Axes second, Number d2, const Double2& radii, Number contact_distance,
                                  Number signed_radius1, Number signed_radius2, Contact& contact) {
  const Delta delta = two_difference(second, first);
  const Direction n(delta, d2);
  const Less less(radii, contact_distance);
  const Axes uncancelled = all<Axes>(uncancelled_share(n.root, less));

  // A component that is 0 is exactly so, and what follows from it.
  Mask certain = hn::Or(hn::Ge(hn::Abs(n.q), all<Axes>(bounds::kLeastComponent)), hn::Eq(delta.high, all<Axes>(0)));
  const Axes normal = rounded(n.q, n.low, bounds::kNormalEta, Every(), certain);

  const DoubleDouble<Axes> point1 = point(first, all<Axes>(signed_radius1), n.q, n.low);
  certain = hn::And(certain, hn::Ge(hn::Abs(point1.high), uncancelled));
  const Axes rounded1 = rounded(point1.high, point1.low, bounds::kSumEta, Every(), certain);

  // The value is rounded in the second point's last lane.
  const Double2 value = value_of(n.root, less);
  const DoubleDouble<Axes> point2 = point(second, all<Axes>(signed_radius2), n.q, n.low);
  const Axes high = with_last(point2.high, value.high);
  Mask last_certain = hn::Ge(hn::Abs(high), uncancelled);
  const Axes rounded2 = rounded(high, with_last(point2.low, value.low), bounds::kSumEta, Every(), last_certain);
  store(hn::Add(normal, all<Axes>(0)), rounded1, rounded2, false, contact);  // every zero is +0
  return ((bits_of(certain) | 0b1000) & bits_of(last_certain)) == 0b1111;
}
CONTACT_LANES bool contact_of_hit(const Ball& a, const Ball& b, Number d2, Number contact_distance,
                                  Number signed_radius1, Number signed_radius2, Contact& contact) {
  return contact_of_hit(load(a), load(b), d2, two_sum(a.radius, b.radius), contact_distance, signed_radius1,
                        signed_radius2, contact);
}
