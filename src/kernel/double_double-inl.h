// Double-double arithmetic, written once. Included in a namespace that has `hn`, which is Highway or does the same to
// the numbers of one pair, and CONTACT_LANES, which stands before what is inlined there.

/// high + low, unevaluated: |low| <= u |high| after two_sum, u = 2^-53 for double. (A constructor that the compiler
/// makes is not compiled for the instruction set of a namespace, and cannot call those of NEON's vectors.)
template <class V>
struct DoubleDouble {
  V high;
  V low;

  CONTACT_LANES DoubleDouble() {}
  CONTACT_LANES DoubleDouble(V h, V l) : high(h), low(l) {}
};

/// a + b exactly (Knuth). Domain: to nearest; no overflow, and no subnormal number.
template <class V>
CONTACT_LANES DoubleDouble<V> two_sum(V a, V b) {
  const V high = hn::Add(a, b);
  const V b_part = hn::Sub(high, a);
  return {high, hn::Add(hn::Sub(a, hn::Sub(high, b_part)), hn::Sub(b, b_part))};
}

/// b - a exactly; +0 where they are equal, but for 0 - -0 and such: zeros of either sign are told apart nowhere here.
template <class V>
CONTACT_LANES DoubleDouble<V> two_difference(V b, V a) {
  const V high = hn::Sub(b, a);
  const V a_part = hn::Sub(high, b);
  return {high, hn::Sub(hn::Sub(b, hn::Sub(high, a_part)), hn::Add(a, a_part))};
}
