// The numbers of a contact from one reciprocal root, written once over the lanes of the namespace that includes it:
// many pairs in Highway's vectors, or x, y and z of one pair in one vector.
//
//   d = c2 - c1 = dh + dl exactly     D = |d|^2     s = sqrt(D)     n = d / s     R = r1 + r2     T = R + contact
//
// One root serves all numbers: y = 1/sqrt(D) within 2 u, q = RN(dh y), q + e = d y, and rho = 1 - |q + e|^2 says what y
// lacks, so that n = q + (e + q rho / 2). Formulas and bounds: docs/error-bounds.md.
//
// The namespace has double_double-inl.h, and
//   Number, Axes, Delta, Mask    a number of each pair, its x, y and z, d on these, and which lanes
//   bounds                       FastBounds of these numbers
//   all<T>                       a constant in every lane
//   x_of, y_of, z_of             a Number of Axes
//   product                      RN(dh k) on each axis
//   product_rest                 d k less that
//   times_plus                   a k + c
//   reciprocal_root, masked_multiply_add, and_equal     as in batch_arithmetic-inl.h

/// The normal n = q + low and the length s, from d, its squared length in plain arithmetic, and one root.
struct Direction {
  Axes q;
  Axes low;
  Double2 root;
  Number reciprocal;  ///< 1 / s within 2 u

  CONTACT_LANES Direction(const Delta& d, Number d2) : Direction(d, d2, reciprocal_root(d2)) {}
  /// The same with 1 / s within 2 u.
  CONTACT_LANES Direction(const Delta& d, Number d2, Number y) {
    reciprocal = y;
    q = product(d, y);
    const Axes e = product_rest(d, y, q);
    const Number qx = x_of(q);
    const Number qy = y_of(q);
    const Number qz = z_of(q);
    // 1 - |q|^2: the leading parts of 1 + qx^2 and 1 + qx^2 + qy^2 are whole numbers of 2^-52, their differences exact.
    const Number one = all<Number>(1);
    const Number a1 = hn::MulAdd(qx, qx, one);
    const Number a2 = hn::MulAdd(qy, qy, a1);
    const Number rx = hn::MulSub(qx, qx, hn::Sub(a1, one));
    const Number ry = hn::MulSub(qy, qy, hn::Sub(a2, a1));
    const Number rz = hn::MulSub(qz, qz, hn::Sub(all<Number>(2), a2));
    const Number cross = hn::MulAdd(qx, x_of(e), hn::MulAdd(qy, y_of(e), hn::Mul(qz, z_of(e))));
    const Number half_rho = hn::NegMulSub(all<Number>(0.5), hn::Add(hn::Add(rx, ry), rz), cross);
    low = times_plus(q, half_rho, e);
    root.high = hn::Mul(y, d2);
    root.low = hn::Mul(root.high, hn::Sub(hn::NegMulAdd(y, root.high, one), half_rho));
  }
};

/// center + radius (q + low).
template <class V>
CONTACT_LANES DoubleDouble<V> point(V center, V radius, V q, V low) {
  const V w = hn::Mul(radius, q);
  const V high = hn::Add(center, w);
  const V w_part = hn::Sub(high, center);
  const V center_lost = hn::Sub(center, hn::Sub(high, w_part));  // exact, as in two_sum
  const V w_lost = hn::MulAdd(radius, low, hn::MulSub(radius, q, w_part));
  return {high, hn::Add(center_lost, w_lost)};
}

/// T = R + contact, whose low part is that of R and its own.
struct Less {
  Double2 radii;
  Double2 sum;

  CONTACT_LANES Less(const Double2& of_radii, Number contact) : radii(of_radii), sum(two_sum(radii.high, contact)) {}
};

/// s - T.
CONTACT_LANES Double2 value_of(const Double2& root, const Less& less) {
  const Double2 sum = two_difference(root.high, less.sum.high);
  return {sum.high, hn::Add(sum.low, hn::Sub(root.low, hn::Add(less.sum.low, less.radii.low)))};
}

/// What points and the value must be left with for kSumEta to hold.
CONTACT_LANES Number uncancelled_share(const Double2& root, const Less& less) {
  return hn::Max(hn::Mul(hn::Add(root.high, less.sum.high), all<Number>(bounds::kUncancelled)),
                 all<Number>(bounds::kLeast));
}

/// high + low rounded where `wanted`, else 0; `certain` loses the wanted lanes where an error of eta u / 4 |high| could
/// change it.
template <class V, class Wanted>
CONTACT_LANES V rounded(V high, V low, double eta, Wanted wanted, Mask& certain) {
  const V above = masked_multiply_add(wanted, low, all<V>(1 + eta), high);
  certain = and_equal(certain, above, hn::MulAdd(low, all<V>(1 - eta), high));
  return above;
}
