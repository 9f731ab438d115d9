// Exact arithmetic for what the filters leave: integers on a common grid, and correct rounding in Q(sqrt D).
//
// A number is estimated in double arithmetic, and then verified: two exact expressions tell on which side of it lie the
// rounding boundaries beside the estimate. That takes products alone. Where the estimate fails, a division answers: a
// correctly rounded number needs its leading 54 bits and whether anything follows. With everything an integer, the
// leading bits of c + e / sqrt(D) at a scale 2^p are an integer square root, since floor(sqrt(N) / D) and
// floor(sqrt(floor(N / D^2))) are the same integer; what follows is the two remainders. The scale p comes from an
// exact lower bound on the magnitude, in which c^2 D - e^2 carries all of the cancellation, so nothing is guessed,
// nothing is repeated, and ties are seen as ties.
#include "kernel/exact.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

namespace contact::kernel {
namespace {

constexpr int kMinExponent = -1074;  // of the smallest subnormal
constexpr int kMaxExponent = 1023;   // of the largest finite number's leading bit
constexpr int kSignificandBits = 53;
constexpr int kMostSteps = 40;  // an estimate is a few units of the last place off, and a step is one
constexpr int kBitsForRounding = kSignificandBits + 1;  // the rounding bit; whether anything follows is told apart

/// |x| = significand 2^exponent, from the bits alone: no floating-point mode can change it.
struct Decoded {
  std::uint64_t significand;
  int exponent;
  bool negative;
};

Decoded decode(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const int biased = static_cast<int>((bits >> 52) & 0x7ff);
  const std::uint64_t fraction = bits & ((std::uint64_t{1} << 52) - 1);
  const bool negative = (bits >> 63) != 0;
  if (biased == 0) return {fraction, kMinExponent, negative};
  return {fraction | (std::uint64_t{1} << 52), biased + kMinExponent - 1, negative};
}

/// The least k with |n| < 2^k.
int bit_length(const Integer& n) { return n.is_zero() ? 0 : static_cast<int>(msb(abs(n))) + 1; }

/// +-(magnitude + f) 2^exponent rounded to binary64, where 0 <= f < 1 and `inexact` says f > 0.
/// Domain: magnitude has kBitsForRounding bits at least, or f = 0.
double round_magnitude(Integer magnitude, bool inexact, int exponent, bool negative) {
  if (magnitude.is_zero() && !inexact) return 0.0;
  const int dropped = std::max(bit_length(magnitude) - kSignificandBits, kMinExponent - exponent);
  if (dropped > 0) {
    const auto shift = static_cast<unsigned>(dropped);
    const Integer kept = magnitude >> shift;
    const Integer rest = magnitude - (kept << shift);
    const Integer half = Integer(1) << (shift - 1);
    const bool up = rest > half || (rest == half && (inexact || bit_test(kept, 0)));
    magnitude = up ? kept + 1 : kept;
    exponent += dropped;
  }
  // Rounding up may have carried into a 54th bit: 2^53 is then a power of two and shifting it loses nothing.
  if (bit_length(magnitude) > kSignificandBits) {
    magnitude >>= 1;
    ++exponent;
  }
  const std::uint64_t sign = negative ? std::uint64_t{1} << 63 : 0;
  if (bit_length(magnitude) + exponent - 1 > kMaxExponent)
    return std::bit_cast<double>(sign | std::bit_cast<std::uint64_t>(std::numeric_limits<double>::infinity()));
  auto significand = static_cast<std::uint64_t>(magnitude);
  if (significand == 0) return 0.0;
  const int room = std::min(std::countl_zero(significand) - (64 - kSignificandBits), exponent - kMinExponent);
  significand <<= room;
  exponent -= room;
  const std::uint64_t hidden = std::uint64_t{1} << 52;
  const auto biased = (significand & hidden) != 0 ? static_cast<std::uint64_t>(exponent - kMinExponent + 1) : 0;
  return std::bit_cast<double>(sign | (biased << 52) | (significand & (hidden - 1)));
}

/// floor(e / sqrt(D) 2^p) for e >= 0, and whether that is all of it.
struct Floor {
  Integer value;
  bool exact;
};

Floor floor_ratio(const Integer& e, const Integer& D, unsigned p) {
  Integer quotient, remainder;
  divide_qr(Integer(e * e) << (2 * p), D, quotient, remainder);
  Floor result{floor_sqrt(quotient), remainder.is_zero()};
  result.exact = result.exact && result.value * result.value == quotient;
  return result;
}

/// The scale at which a number known to be at least 2^lower_bound shows its leading bits, as many as rounding needs.
unsigned scale_for(int lower_bound) { return static_cast<unsigned>(std::max(0, kBitsForRounding - 1 - lower_bound)); }

/// (floor + f) / over 2^exponent rounded, where 0 <= f < 1 and `exact` says f = 0; floor may be negative.
/// With y = floor + f, the floors of y / over and of floor / over are the same integer.
double round_floor(Integer floor, bool exact, int exponent, const Integer& over) {
  if (over != 1) {
    Integer quotient, remainder;
    divide_qr(floor, over, quotient, remainder);
    if (remainder.sign() < 0) --quotient;
    exact = exact && remainder.is_zero();
    floor = std::move(quotient);
  }
  if (floor.sign() >= 0) return round_magnitude(floor, !exact, exponent, false);
  return round_magnitude(exact ? -floor : -floor - 1, !exact, exponent, true);
}

/// x 2^exponent, for estimates.
struct Estimate {
  double x;
  int exponent;
};

// What both kinds of integers need.
Estimate estimate(const FixedInteger& n) {
  Estimate of{};
  of.x = leading(n.limbs(), of.exponent);
  return of;
}
Estimate estimate(const Integer& n) {
  const auto& magnitude = n.backend();
  Estimate of{};
  of.x = leading(std::span(magnitude.limbs(), n.is_zero() ? 0 : magnitude.size()), of.exponent);
  return of;
}
FixedInteger shifted(const FixedInteger& n, int by) { return n << by; }
Integer shifted(const Integer& n, int by) { return n << static_cast<unsigned>(by); }
int compare_magnitudes(const Integer& a, const Integer& b) { return a.backend().compare_unsigned(b.backend()); }
/// significand 2^shift.
void make(std::uint64_t significand, int shift, FixedInteger& n) { n = FixedInteger(significand, shift, false); }
void make(std::uint64_t significand, int shift, Integer& n) { n = shifted(Integer(significand), shift); }

/// |c| + |e| / sqrt(D) within a few units of the last place.
template <class Number>
Estimate estimate_of_magnitudes(const Number& c, const Number& e, const Estimate& D) {
  const Estimate first = estimate(c);
  Estimate second = estimate(e);
  second.x /= std::sqrt(D.x);
  second.exponent -= D.exponent / 2;
  if (second.x == 0) return first;
  if (first.x == 0) return second;
  const int exponent = std::max(first.exponent, second.exponent);
  return {std::ldexp(first.x, first.exponent - exponent) + std::ldexp(second.x, second.exponent - exponent), exponent};
}

Integer integer(const FixedInteger& n) {
  Integer magnitude;
  const auto limbs = n.limbs();
  for (std::size_t i = limbs.size(); i-- > 0;)
    magnitude = (magnitude << static_cast<unsigned>(FixedInteger::kLimbBits)) + limbs[i];
  return n.sign() < 0 ? -magnitude : magnitude;
}

/// Half way between the positive number with these bits and the next: significand 2^exponent.
Decoded boundary_above(std::uint64_t bits) {
  const Decoded d = decode(std::bit_cast<double>(bits));
  return {2 * d.significand + 1, d.exponent - 1, false};
}

}  // namespace

Grid::Grid(std::span<const double> numbers)
    : exponent_(std::numeric_limits<int>::max()), end_(std::numeric_limits<int>::min()) {
  for (const double x : numbers) {
    const Decoded d = decode(x);
    if (d.significand == 0) continue;
    exponent_ = std::min(exponent_, d.exponent + std::countr_zero(d.significand));
    end_ = std::max(end_, d.exponent + kSignificandBits);
  }
  if (exponent_ == std::numeric_limits<int>::max()) exponent_ = end_ = 0;
}

Integer Grid::operator()(double x) const {
  const Decoded d = decode(x);
  if (d.significand == 0) return 0;
  const int shift = d.exponent - exponent_;
  Integer n = d.significand;
  if (shift >= 0)
    n <<= static_cast<unsigned>(shift);
  else
    n >>= static_cast<unsigned>(-shift);  // trailing zeros only: the grid holds x
  return d.negative ? -n : n;
}

Integer Grid::product(double x, double y) const {
  const Grid of_x{x};
  const Grid of_y{y};
  return (of_x(x) * of_y(y)) << static_cast<unsigned>(of_x.exponent_ + of_y.exponent_ - exponent_);
}

FixedInteger Grid::fixed(double x) const {
  const Decoded d = decode(x);
  if (d.significand == 0) return {};
  const int zeros = std::countr_zero(d.significand);
  return {d.significand >> zeros, d.exponent + zeros - exponent_, d.negative};
}

Integer floor_sqrt(const Integer& n) {
  if (n.is_zero()) return 0;
  // Newton from above: decreasing until it reaches the floor, and the first step that does not decrease proves it.
  // (Boost's own integer root works bit by bit.) The start is the root of the leading 64 bits, rounded up.
  const int length = bit_length(n);
  const unsigned shift = length > 62 ? static_cast<unsigned>(length - 62 + (length & 1)) : 0;
  Integer root = (boost::multiprecision::sqrt(Integer(n >> shift)) + 1) << (shift / 2);
  for (;;) {
    Integer next = (root + n / root) >> 1;
    if (next >= root) return root;
    root = std::move(next);
  }
}

double approximate_log2(const Integer& n) {
  const Estimate of = estimate(n);
  return std::log2(of.x) + of.exponent;
}

double round_integer(const Integer& n, int exponent) { return round_magnitude(abs(n), false, exponent, n.sign() < 0); }

double round_sum_by_division(const Integer& c, const Integer& e, const Integer& D, int exponent, const Integer& over) {
  if (e.is_zero() && (c.is_zero() || over == 1)) return round_integer(c, exponent);
  const int root_bits = (bit_length(D) + 1) / 2;  // sqrt(D) < 2^root_bits
  int lower_bound;
  if (c.sign() * e.sign() >= 0) {
    lower_bound = e.is_zero() ? bit_length(c) - 1 : bit_length(e) - 1 - root_bits;
    if (!c.is_zero()) lower_bound = std::max(lower_bound, bit_length(c) - 1);
  } else {
    // |c + e / s| = |c^2 D - e^2| / (s (|c| s + |e|))  with s = sqrt(D)
    const Integer difference = abs(Integer(c * c * D - e * e));
    if (difference.is_zero()) return 0.0;
    lower_bound = bit_length(difference) - 1 - root_bits - (std::max(bit_length(c) + root_bits, bit_length(e)) + 1);
  }
  const unsigned p = scale_for(lower_bound - bit_length(over));
  const Floor ratio = floor_ratio(abs(e), D, p);
  Integer floor = c << p;
  if (e.sign() > 0)
    floor += ratio.value;
  else
    floor -= ratio.exact ? ratio.value : ratio.value + 1;
  return round_floor(std::move(floor), ratio.exact, exponent - static_cast<int>(p), over);
}

namespace {

/// round_sum_near for numbers of either kind, over `over` where there is one; `give_up` answers after kMostSteps.
template <class Number, class GiveUp>
double round_near(double estimate, int sign, const Number& c, const Number& e, const Number& D, int exponent,
                  const Number* over, const GiveUp& give_up) {
  // The sign of X - m. With u = sign c - m and f = sign e: u^2 D against f^2 where their signs differ.
  const Number e2 = e * e;
  const Number u0 = sign < 0 ? -c : c;
  const int f = sign * e.sign();
  int steps = 0;
  const auto compare = [&](const Decoded& m) {
    ++steps;
    const int finer = std::max(0, exponent - m.exponent);
    Number u;
    make(m.significand, m.exponent - exponent + finer, u);
    if (over != nullptr) u = u * *over;
    u = shifted(u0, finer) - u;
    if (f == 0 || u.sign() * f >= 0) return f == 0 ? u.sign() : f;
    return u.sign() * compare_magnitudes(u * u * D, shifted(e2, 2 * finer));
  };
  constexpr auto kInfinite = std::bit_cast<std::uint64_t>(std::numeric_limits<double>::infinity());
  auto bits = std::bit_cast<std::uint64_t>(std::min(estimate, std::numeric_limits<double>::max()));
  int above = compare(boundary_above(bits));
  while (above > 0 && ++bits != kInfinite && steps < kMostSteps) above = compare(boundary_above(bits));
  if (above == 0) bits += bits & 1;
  while (above < 0 && bits != 0 && steps < kMostSteps) {
    const int below = compare(boundary_above(bits - 1));
    if (below > 0) break;
    if (below == 0) bits -= bits & 1;
    if (below == 0) break;
    --bits;
  }
  if (steps >= kMostSteps) return give_up();
  if (bits == 0) return 0.0;
  return std::bit_cast<double>(bits | (sign < 0 ? std::uint64_t{1} << 63 : 0));
}

// An estimate that is off costs steps, never the answer.
template <class Number, class GiveUp>
double round_by_products(const Number& c, const Number& e, const Number& D, int exponent, const Number* over,
                         const GiveUp& give_up) {
  // X = |c + e / sqrt(D)|. With s = sqrt(D), where the signs differ: X = |c^2 D - e^2| / (D (|c| + |e| / s)).
  const bool cancels = c.sign() * e.sign() < 0;
  Estimate root2 = estimate(D);
  if (root2.exponent % 2 != 0) root2 = {root2.x / 2, root2.exponent + 1};
  Estimate X = estimate_of_magnitudes(c, e, root2);
  int sign = c.sign() != 0 ? c.sign() : e.sign();
  if (cancels) {
    const Number difference = c * c * D - e * e;
    sign *= difference.sign();
    const Estimate of_difference = estimate(difference);
    X.x = of_difference.x / (root2.x * X.x);
    X.exponent = of_difference.exponent - root2.exponent - X.exponent;
  }
  if (sign == 0) return 0.0;
  if (over != nullptr) {
    const Estimate by = estimate(*over);
    X = {X.x / by.x, X.exponent - by.exponent};
  }
  return round_near(std::ldexp(X.x, X.exponent + exponent), sign, c, e, D, exponent, over, give_up);
}

}  // namespace

double round_sum(const Integer& c, const Integer& e, const Integer& D, int exponent, const Integer& over) {
  if (e.is_zero() && (c.is_zero() || over == 1)) return round_integer(c, exponent);
  return round_by_products(c, e, D, exponent, over == 1 ? nullptr : &over,
                           [&] { return round_sum_by_division(c, e, D, exponent, over); });
}

double round_sum(const FixedInteger& c, const FixedInteger& e, const FixedInteger& D, int exponent) {
  return round_by_products<FixedInteger>(
      c, e, D, exponent, nullptr, [&] { return round_sum_by_division(integer(c), integer(e), integer(D), exponent); });
}

double round_sum_near(double estimate, int sign, const FixedInteger& c, const FixedInteger& e, const FixedInteger& D,
                      int exponent) {
  return round_near<FixedInteger>(estimate, sign, c, e, D, exponent, nullptr,
                                  [&] { return round_sum_by_division(integer(c), integer(e), integer(D), exponent); });
}

double round_root_less(const Integer& D, const Integer& t, int exponent, const Integer& over) {
  return round_sum(-t, D, D, exponent, over);
}

}  // namespace contact::kernel
