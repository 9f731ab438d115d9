// The second oracle: MPFR intervals with outward rounding.
#include "oracle/interval_oracle.hpp"

#include <mpfi.h>
#include <mpfi_io.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "oracle/default_environment.hpp"

namespace contact::oracle {
namespace {

constexpr mpfr_prec_t kFirstPrecision = 192;

/// An interval that contains the real number it stands for. The operations round outward.
class Interval {
 public:
  explicit Interval(mpfr_prec_t precision) { mpfi_init2(value_, precision); }
  Interval(mpfr_prec_t precision, double exact) : Interval(precision) { mpfi_set_d(value_, exact); }
  Interval(const Interval& other) : Interval(mpfi_get_prec(other.value_)) { mpfi_set(value_, other.value_); }
  Interval& operator=(const Interval& other) = delete;
  ~Interval() { mpfi_clear(value_); }

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

  /// The rounding of the real number to the scalar, where both ends round to it.
  [[nodiscard]] std::optional<double> rounded(Scalar scalar) const {
    const double low = to_nearest(&value_->left, scalar);
    const double high = to_nearest(&value_->right, scalar);
    if (low != high) return std::nullopt;
    return low == 0 ? 0.0 : low;
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

  mpfi_t value_;
};

/// Thrown by `settled` to ask for more precision; never leaves this file.
struct Undecided {};

template <class T>
T settled(const std::optional<T>& answer) {
  if (!answer) throw Undecided{};
  return *answer;
}

using Triple = std::array<Interval, 3>;

Triple triple(mpfr_prec_t precision, const Vector3& v) {
  return {Interval(precision, v[0]), Interval(precision, v[1]), Interval(precision, v[2])};
}

RoundedAnswer spheres(const Balls& balls, Distances distances, Scalar scalar, mpfr_prec_t precision) {
  const Triple c1 = triple(precision, balls.a.center);
  const Triple c2 = triple(precision, balls.b.center);
  const Triple delta{c2[0] - c1[0], c2[1] - c1[1], c2[2] - c1[2]};
  const Interval r1(precision, balls.a.radius);
  const Interval r2(precision, balls.b.radius);
  const Interval D = delta[0].squared() + delta[1].squared() + delta[2].squared();
  const Interval reach = Interval(precision, distances.alarm) + r1 + r2;

  RoundedAnswer answer{settled((D - reach.squared()).sign()), settled((D - (r1 + r2).squared()).sign()), {}};
  answer.expected.hit = answer.at_alarm <= 0;
  if (!answer.expected.hit) return answer;

  Contact contact{};
  contact.degenerate = settled(D.sign()) == 0;
  const Interval root = D.root();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Interval n = contact.degenerate ? Interval(precision, axis == 0 ? 1.0 : 0.0) : delta[axis] / root;
    // (r delta) / root and not r (delta / root): the product is exact at some precision, so a tie can be seen.
    const Interval along1 = contact.degenerate ? r1 * n : (r1 * delta[axis]) / root;
    const Interval along2 = contact.degenerate ? r2 * n : (r2 * delta[axis]) / root;
    const auto i = static_cast<Eigen::Index>(axis);
    contact.normal[i] = settled(n.rounded(scalar));
    contact.point1[i] = settled((c1[axis] + along1).rounded(scalar));
    contact.point2[i] = settled((c2[axis] - along2).rounded(scalar));
  }
  contact.value = settled((root - (r1 + r2) - Interval(precision, distances.contact)).rounded(scalar));
  answer.expected.contact = contact;
  return answer;
}

RoundedAnswer cubes(const Boxes& boxes, Distances distances, mpfr_prec_t precision) {
  const Triple min1 = triple(precision, boxes.a.min);
  const Triple max1 = triple(precision, boxes.a.max);
  const Triple min2 = triple(precision, boxes.b.min);
  const Triple max2 = triple(precision, boxes.b.max);
  const Interval alarm(precision, distances.alarm);
  RoundedAnswer answer{-1, -1, {}};
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const Interval& gap : {min1[axis] - max2[axis], min2[axis] - max1[axis]}) {
      answer.at_alarm = std::max(answer.at_alarm, settled((gap - alarm).sign()));
      answer.at_zero = std::max(answer.at_zero, settled(gap.sign()));
    }
  answer.expected.hit = answer.at_alarm <= 0;
  return answer;
}

}  // namespace

std::optional<RoundedAnswer> interval_answer_within(int most, const Query& query, Scalar scalar) {
  const DefaultEnvironment environment;
  for (mpfr_prec_t precision = kFirstPrecision; precision <= most; precision *= 2) {
    try {
      return query.balls() != nullptr ? spheres(*query.balls(), query.distances, scalar, precision)
                                      : cubes(*query.boxes(), query.distances, precision);
    } catch (const Undecided&) {
    }
  }
  return std::nullopt;
}

RoundedAnswer interval_answer(const Query& query, Scalar scalar) {
  return *interval_answer_within(std::numeric_limits<int>::max(), query, scalar);
}

}  // namespace contact::oracle
