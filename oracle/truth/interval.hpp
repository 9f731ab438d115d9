// Intervals of MPFI with outward rounding, and the answer for nearest points in them.
#pragma once

#include <mpfi.h>
#include <mpfi_io.h>

#include <array>
#include <climits>
#include <cstddef>
#include <optional>

#include "oracle/truth/query.hpp"
#include "oracle/truth/rounded_answer.hpp"

namespace contact::oracle {

/// An interval that contains the real number it stands for. The operations round outward.
class Interval {
 public:
  explicit Interval(mpfr_prec_t precision) {
    if (precision > kMostInside) {
      mpfi_init2(value_, precision);
      return;
    }
    mpfr_custom_init_set(&value_->left, MPFR_NAN_KIND, 0, precision, inside_[0].data());
    mpfr_custom_init_set(&value_->right, MPFR_NAN_KIND, 0, precision, inside_[1].data());
  }
  Interval(mpfr_prec_t precision, double exact) : Interval(precision) { mpfi_set_d(value_, exact); }
  Interval(const Interval& other) : Interval(mpfi_get_prec(other.value_)) { mpfi_set(value_, other.value_); }
  /// Domain: one precision.
  Interval& operator=(const Interval& other) {
    mpfi_set(value_, other.value_);
    return *this;
  }
  ~Interval() {
    if (mpfi_get_prec(value_) > kMostInside) mpfi_clear(value_);
  }

  friend Interval operator+(const Interval& x, const Interval& y) { return apply(mpfi_add, x, y); }
  friend Interval operator-(const Interval& x, const Interval& y) { return apply(mpfi_sub, x, y); }
  friend Interval operator*(const Interval& x, const Interval& y) { return apply(mpfi_mul, x, y); }
  friend Interval operator/(const Interval& x, const Interval& y) { return apply(mpfi_div, x, y); }
  /// Both ends are squared again and moved out where they lie inside: mpn_sqrtrem of GMP 6.2.1, asked for no remainder,
  /// takes some numbers of 14 limbs and more for perfect squares, and mpfr_sqrt then calls a root exact that is too
  /// low.
  [[nodiscard]] Interval root() const {
    const mpfr_prec_t precision = mpfi_get_prec(value_);
    Interval result(precision);
    mpfi_sqrt(result.value_, value_);
    const auto squared_end = [&](mpfr_srcptr end) {
      Interval square(2 * precision);  // holds every digit of it
      mpfr_sqr(&square.value_->left, end, MPFR_RNDN);
      return square;
    };
    mpfr_ptr left = &result.value_->left;
    mpfr_ptr right = &result.value_->right;
    while (mpfr_greater_p(&squared_end(left).value_->left, &value_->left) != 0) mpfr_nextbelow(left);
    while (mpfr_less_p(&squared_end(right).value_->left, &value_->right) != 0) mpfr_nextabove(right);
    return result;
  }
  [[nodiscard]] Interval squared() const {
    Interval result(mpfi_get_prec(value_));
    mpfi_sqr(result.value_, value_);
    return result;
  }

  /// The sign, where the whole interval has it.
  [[nodiscard]] std::optional<int> sign() const {
    if (mpfi_is_zero(value_) != 0) return 0;
    if (mpfi_is_strictly_pos(value_) != 0) return 1;
    if (mpfi_is_strictly_neg(value_) != 0) return -1;
    return std::nullopt;
  }

  /// The e with 2^e <= |x| < 2^(e+1), where both ends have it.
  [[nodiscard]] std::optional<long> exponent() const {
    const auto of = [](mpfr_srcptr end) { return mpfr_zero_p(end) != 0 ? LONG_MIN : mpfr_get_exp(end) - 1; };
    const long low = of(&value_->left);
    return low == of(&value_->right) ? std::optional(low) : std::nullopt;
  }
  /// x 2^power.
  [[nodiscard]] Interval scaled(long power) const {
    Interval result(mpfi_get_prec(value_));
    mpfi_mul_2si(result.value_, value_, power);
    return result;
  }

  /// The rounding of the real number to the scalar, where both ends round to it.
  [[nodiscard]] std::optional<double> rounded(Scalar scalar) const {
    const double low = to_nearest(&value_->left, scalar);
    const double high = to_nearest(&value_->right, scalar);
    if (low != high) return std::nullopt;
    return low == 0 ? 0.0 : low;
  }
  /// Both ends rounded to binary64: the rounding of the real number lies between them.
  [[nodiscard]] MarginBounds ends() const {
    return {to_nearest(&value_->left, Scalar::binary64), to_nearest(&value_->right, Scalar::binary64)};
  }

 private:
  using Operation = int (*)(mpfi_ptr, mpfi_srcptr, mpfi_srcptr);
  static Interval apply(Operation operation, const Interval& x, const Interval& y) {
    Interval result(mpfi_get_prec(x.value_));
    operation(result.value_, x.value_, y.value_);
    return result;
  }
  static double to_nearest(mpfr_srcptr x, Scalar scalar) {
    return scalar == Scalar::binary32 ? static_cast<double>(mpfr_get_flt(x, MPFR_RNDN)) : mpfr_get_d(x, MPFR_RNDN);
  }

  /// The digits of the first precision lie in the object, and those of a root's square: a call of malloc for each end
  /// costs more than most operations. MPFI and MPFR change the precision of no operand, so they leave them there.
  static constexpr mpfr_prec_t kMostInside = 384;

  mpfi_t value_;
  std::array<std::array<mp_limb_t, kMostInside / GMP_NUMB_BITS>, 2> inside_;
};

/// Thrown by `settled` to ask for more precision; never leaves the interval oracle.
struct Undecided {};

template <class T>
T settled(const std::optional<T>& answer) {
  if (!answer) throw Undecided{};
  return *answer;
}
[[nodiscard]] inline int sign_of(const Interval& x) { return settled(x.sign()); }

using Triple = std::array<Interval, 3>;

/// The vector whose components component(i) encloses, rounded.
template <class Component>
[[nodiscard]] Vector3 rounded(Scalar scalar, const Component& component) {
  const auto at = [&](std::size_t i) { return settled(component(i).rounded(scalar)); };
  return {at(0), at(1), at(2)};
}

inline Triple triple(mpfr_prec_t precision, const Vector3& v) {
  return {Interval(precision, v[0]), Interval(precision, v[1]), Interval(precision, v[2])};
}

inline Triple difference(const Triple& x, const Triple& y) { return {x[0] - y[0], x[1] - y[1], x[2] - y[2]}; }
inline Triple sum(const Triple& x, const Triple& y) { return {x[0] + y[0], x[1] + y[1], x[2] + y[2]}; }
inline Triple scaled(const Interval& k, const Triple& x) { return {k * x[0], k * x[1], k * x[2]}; }
[[nodiscard]] inline bool is_zero(const Triple& x) {
  return sign_of(x[0]) == 0 && sign_of(x[1]) == 0 && sign_of(x[2]) == 0;
}
inline Interval dot(const Triple& x, const Triple& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }
inline Triple cross(const Triple& x, const Triple& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

/// The nearest points of two cores: p / over and q / over.
struct IntervalNearest {
  Triple p;
  Triple q;
  Interval over;
  Triple agreed;  ///< the normal where they are one point, of any length above 0
  bool unique;
};

/// off / ulp(reach) in the scalar.
[[nodiscard]] MarginBounds margin_of(const Interval& off, const Interval& reach, Scalar scalar);

/// The answer for two cores blown up by r1 and r2.
[[nodiscard]] RoundedAnswer answer_of_nearest(const IntervalNearest& nearest, const Interval& r1, const Interval& r2,
                                              Distances distances, Scalar scalar, mpfr_prec_t precision);

}  // namespace contact::oracle
