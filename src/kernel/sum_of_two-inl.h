// Sums that two numbers hold, written once over the lanes of the namespace that includes it, after double_double-inl.h.

/// The terms' sum as it comes, and the sum of what each of its steps loses: together all of it, as long as the second
/// sum loses nothing. So it is with terms of like size.
template <class V>
struct SumOfTwo {
  V high;
  V low;
  V lost;  ///< +0 where nothing is; no number where a sum overflows

  CONTACT_LANES SumOfTwo(V first, V second) : SumOfTwo(two_sum(first, second)) {}
  CONTACT_LANES explicit SumOfTwo(const DoubleDouble<V>& sum) : high(sum.high), low(sum.low), lost(hn::Sub(low, low)) {}

  CONTACT_LANES void add(V term) {
    const DoubleDouble<V> leading = two_sum(high, term);
    const DoubleDouble<V> rest = two_sum(low, leading.low);
    high = leading.high;
    low = rest.high;
    lost = hn::Add(lost, hn::Abs(rest.low));
  }
  /// The sum rounded once, where nothing is lost; every zero is +0.
  CONTACT_LANES V rounded() const { return hn::Add(hn::Add(high, low), lost); }
};
