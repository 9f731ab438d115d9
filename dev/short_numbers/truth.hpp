// The exact truth about a pair of spheres, in integers, and whether a number is it rounded once.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "dev/short_numbers/harness.hpp"

namespace contact::kernel::tiny {

/// The pair as integers over 2^scale.  X = c + e / sqrt(D) is every number of a contact.
/// Domain      all numbers finite, and few enough bits between the largest and the last of the smallest for Integer.
template <class Integer>
class Truth {
 public:
  Truth(const Question& question, int scale) : scale_(scale) {
    const auto on_grid = [scale](double x) {
      int exponent = 0;
      const auto significand = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
      const int shift = exponent - 53 - scale;
      return shift >= 0 ? Integer(Integer(significand) << shift)
                        : Integer(significand / (std::int64_t{1} << std::min(-shift, 62)));
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
      center_[0][axis] = on_grid(question.balls[axis]);
      center_[1][axis] = on_grid(question.balls[4 + axis]);
      delta_[axis] = center_[1][axis] - center_[0][axis];
      D_ += delta_[axis] * delta_[axis];
    }
    const Integer r1 = on_grid(question.balls[3]);
    const Integer r2 = on_grid(question.balls[7]);
    reach_ = r1 + r2 + on_grid(question.alarm);
    T_ = r1 + r2 + on_grid(question.contact);
    moved_[0] = question.signs[0] < 0 ? Integer(-r1) : question.signs[0] > 0 ? r1 : Integer(0);
    moved_[1] = question.signs[1] < 0 ? Integer(-r2) : question.signs[1] > 0 ? r2 : Integer(0);
  }

  [[nodiscard]] bool hit() const { return D_ <= reach_ * reach_; }
  [[nodiscard]] bool touching() const { return D_ == reach_ * reach_; }
  [[nodiscard]] bool coincident() const { return D_ == 0; }
  [[nodiscard]] bool value_is_zero() const { return D_ == T_ * T_; }

  /// Whether y is number k rounded once to `bits` bits, to nearest and ties to even, with a zero +0.
  [[nodiscard]] bool is_rounded(std::size_t k, double y, int bits) const {
    Integer c = 0;
    Integer e = 0;
    if (k < 3) {
      if (coincident()) return y == (k == 0 ? 1 : 0) && !std::signbit(y);
      return is_rounded(c, delta_[k], 0, y, bits);
    }
    if (k == 9) return is_rounded(Integer(-T_), D_, scale_, y, bits);
    const std::size_t sphere = k < 6 ? 0 : 1;
    const std::size_t axis = k % 3;
    c = center_[sphere][axis];
    if (!coincident()) return is_rounded(c, Integer(moved_[sphere] * delta_[axis]), scale_, y, bits);
    return is_rounded(axis == 0 ? Integer(c + moved_[sphere]) : c, e, scale_, y, bits);
  }

 private:
  /// The sign of X - m.
  [[nodiscard]] int compare(const Integer& c, const Integer& e, int scale, double m) const {
    int exponent = 0;
    const auto significand = static_cast<std::int64_t>(std::ldexp(std::frexp(m, &exponent), 53));
    const int zeros = significand == 0 ? 0 : std::countr_zero(static_cast<std::uint64_t>(significand));
    const int shift = significand == 0 ? 0 : exponent - 53 + zeros - scale;
    const std::int64_t odd = significand / (std::int64_t{1} << zeros);
    const Integer rest = shift >= 0 ? Integer(c - (Integer(odd) << shift)) : Integer((c << -shift) - odd);
    const int sign = rest.sign();
    const int other = D_ == 0 ? 0 : e.sign();
    if (sign == other || other == 0) return sign;
    if (sign == 0) return other;
    const Integer scaled = shift >= 0 ? e : Integer(e << -shift);
    const Integer left = rest * rest * D_;
    const Integer right = scaled * scaled;
    return left == right ? 0 : left > right ? sign : other;
  }

  [[nodiscard]] bool is_rounded(const Integer& c, const Integer& e, int scale, double y, int bits) const {
    if (std::isnan(y)) return false;
    if (y == 0) return !std::signbit(y) && compare(c, e, scale, 0) == 0;
    // Numbers below 2^L on the grid make no X between 0 and 2^-(3L + 7) (docs/error-bounds.md, "Exact arithmetic"), and
    // a fixed integer has room for what is not smaller by far.
    if (std::numeric_limits<Integer>::is_bounded && std::ilogb(y) < scale - 300) return false;
    const double most = std::ldexp(2 - std::ldexp(1, 1 - bits), 1023);
    const double magnitude = std::min(std::abs(y), most);
    int exponent = 0;
    const double significand = std::frexp(magnitude, &exponent);
    const double half = std::ldexp(0.5, exponent - bits);  // of a unit in the last place
    const bool even = std::fmod(std::ldexp(significand, bits), 2) == 0;
    const double sign = y < 0 ? -1 : 1;
    const int beyond = (y < 0 ? -1 : 1) * compare(c, e, scale, sign * (magnitude + half));
    if (std::isinf(y)) return beyond >= 0;
    const double down = significand == 0.5 ? half / 2 : half;
    const int below = (y < 0 ? -1 : 1) * compare(c, e, scale, sign * (magnitude - down));
    return (beyond < 0 || (beyond == 0 && even)) && (below > 0 || (below == 0 && even));
  }

  int scale_;
  std::array<std::array<Integer, 3>, 2> center_;
  std::array<Integer, 3> delta_;
  Integer D_ = 0;
  Integer reach_;
  Integer T_;
  std::array<Integer, 2> moved_;
};

}  // namespace contact::kernel::tiny
