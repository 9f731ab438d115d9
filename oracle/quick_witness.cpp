// The exact numbers that a golden file records, as integers on one grid: what `witness` says, without rationals.
#include "oracle/quick_witness.hpp"

#include <gmp.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "oracle/default_environment.hpp"

namespace contact::oracle {
namespace {

class Integer {
 public:
  Integer() { mpz_init(value_); }
  Integer(const Integer&) = delete;
  Integer& operator=(const Integer&) = delete;
  ~Integer() { mpz_clear(value_); }

  operator mpz_ptr() { return value_; }  // NOLINT(google-explicit-constructor): it stands for the number in every call

 private:
  mpz_t value_;
};

/// What a question needs; kept, so that nothing is allocated again.
struct Scratch {
  Integer x, y, sum, shifted;
  std::string digits;
};
Scratch& scratch() {
  static thread_local Scratch one;
  return one;
}

/// The exponent of the last of 53 bits; large for 0, which lies on every grid.
int last_exponent(double x) {
  if (x == 0) return std::numeric_limits<int>::max();
  return std::max(std::ilogb(x) - 52, -1074);
}
int last_exponent(const Vector3& v) {
  return std::min({last_exponent(v[0]), last_exponent(v[1]), last_exponent(v[2])});
}

/// A grid of the multiples of 2^unit that holds certain numbers.
struct Grid {
  int unit;

  /// x / 2^unit.
  void place(mpz_ptr out, double x) const {
    if (x == 0) return mpz_set_ui(out, 0);
    const int last = last_exponent(x);
    mpz_set_d(out, std::scalbn(x, -last));  // a whole number of at most 53 bits
    mpz_mul_2exp(out, out, static_cast<mp_bitcnt_t>(last - unit));
  }
};

/// n 2^exponent as dyadic_string writes it.
std::string text_of(mpz_ptr n, int exponent) {
  if (mpz_sgn(n) == 0) return "0x0p0";
  Scratch& s = scratch();
  const mp_bitcnt_t zeros = mpz_scan1(n, 0);
  mpz_tdiv_q_2exp(s.shifted, n, zeros);
  const bool negative = mpz_sgn(n) < 0;
  mpz_abs(s.shifted, s.shifted);
  s.digits.resize(mpz_sizeinbase(s.shifted, 16) + 2);
  mpz_get_str(s.digits.data(), 16, s.shifted);
  std::string text = negative ? "-0x" : "0x";
  text.append(s.digits.c_str());
  text += 'p';
  char power[16];
  text.append(power, std::to_chars(power, power + sizeof power, static_cast<long>(zeros) + exponent).ptr);
  return text;
}

Witness spheres(const Balls& balls, Distances distances) {
  Scratch& s = scratch();
  Witness w;
  const auto& [a, b] = balls;
  const Grid centers{std::min({last_exponent(a.center), last_exponent(b.center), 0})};
  mpz_set_ui(s.sum, 0);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    centers.place(s.x, a.center[axis]);
    centers.place(s.y, b.center[axis]);
    mpz_sub(s.x, s.x, s.y);
    mpz_addmul(s.sum, s.x, s.x);
  }
  w.distance2 = text_of(s.sum, 2 * centers.unit);
  const Grid lengths{std::min({last_exponent(a.radius), last_exponent(b.radius), last_exponent(distances.alarm), 0})};
  lengths.place(s.sum, distances.alarm);
  for (const double radius : {a.radius, b.radius}) {
    lengths.place(s.x, radius);
    mpz_add(s.sum, s.sum, s.x);
  }
  w.reach = text_of(s.sum, lengths.unit);
  return w;
}

Witness cubes(const Boxes& boxes) {
  Scratch& s = scratch();
  Witness w;
  const auto& [a, b] = boxes;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    const Grid grid{std::min({last_exponent(a.min[axis]), last_exponent(a.max[axis]), last_exponent(b.min[axis]),
                              last_exponent(b.max[axis]), 0})};
    grid.place(s.x, a.min[axis]);
    grid.place(s.y, b.max[axis]);
    mpz_sub(s.sum, s.x, s.y);
    grid.place(s.x, b.min[axis]);
    grid.place(s.y, a.max[axis]);
    mpz_sub(s.x, s.x, s.y);
    w.gap[i] = text_of(mpz_cmp(s.sum, s.x) < 0 ? s.x : s.sum, grid.unit);
  }
  return w;
}

}  // namespace

Witness quick_witness(const Query& query) {
  const DefaultEnvironment environment;
  return query.balls() != nullptr ? spheres(*query.balls(), query.distances) : cubes(*query.boxes());
}

}  // namespace contact::oracle
