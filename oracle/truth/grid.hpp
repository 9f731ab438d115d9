// Numbers of a question as integers on one grid of multiples of a power of two (GMP): sums and products without
// rationals.
#pragma once

#include <gmp.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>

#include "oracle/truth/truth.hpp"

namespace contact::oracle {

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
inline Scratch& scratch() {
  static thread_local Scratch one;
  return one;
}

/// The exponent of the last of 53 bits; large for 0, which lies on every grid.
inline int last_exponent(double x) {
  if (x == 0) return std::numeric_limits<int>::max();
  return std::max(std::ilogb(x) - 52, -1074);
}
inline int last_exponent(const Vector3& v) {
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

/// n 2^exponent as exact_string writes it.
inline std::string text_of(mpz_ptr n, int exponent) {
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

// What quick_witness says of each pair, in files of its own.
#define CONTACT_DECLARE(A, B) [[nodiscard]] Witness quick_witness(const Two<A, B>& shapes, Distances distances);
CONTACT_KINDS(CONTACT_DECLARE)
#undef CONTACT_DECLARE

}  // namespace contact::oracle
