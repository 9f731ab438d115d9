// Numbers of a question as integers on one grid of multiples of a power of two (GMP): sums and products without
// rationals.
#pragma once

#include <gmp.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
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

__extension__ using TwoWords = unsigned __int128;

/// Domain: x has at most 63 bits.
inline TwoWords square(std::int64_t x) {
  const auto length = static_cast<std::uint64_t>(x < 0 ? -x : x);
  return static_cast<TwoWords>(length) * length;
}

/// n 2^exponent as exact_string writes it. Domain: n is positive.
inline std::string text_of(TwoWords n, int exponent) {
  while ((n & 0xffff) == 0) n >>= 16, exponent += 16;
  for (; (n & 1) == 0; n >>= 1) ++exponent;
  std::array<char, 64> text;
  char* at = text.data();
  *at++ = '0';
  *at++ = 'x';
  const auto high = static_cast<std::uint64_t>(n >> 64);
  if (high != 0) at = std::to_chars(at, text.data() + text.size(), high, 16).ptr;
  const auto low = static_cast<std::uint64_t>(n);
  if (high == 0) {
    at = std::to_chars(at, text.data() + text.size(), low, 16).ptr;
  } else {
    for (int shift = 60; shift >= 0; shift -= 4) *at++ = "0123456789abcdef"[low >> shift & 15];
  }
  *at++ = 'p';
  at = std::to_chars(at, text.data() + text.size(), exponent).ptr;
  return {text.data(), at};
}

/// Numbers over one power of two, which as whole numbers have at most kBits bits: most questions have such numbers, and
/// need no GMP.
template <std::size_t N>
class OnWords {
 public:
  static constexpr int kBits = 61;

  explicit OnWords(const std::array<double, N>& numbers) {
    int least = kNormal;
    int greatest = 0;
    for (const double x : numbers) {
      if (x == 0) continue;
      const int biased = static_cast<int>(std::bit_cast<std::uint64_t>(x) >> 52 & 0x7ff);
      least = std::min(least, biased);
      greatest = std::max(greatest, biased);
    }
    // The last bit of the smallest is the unit.
    const int unit = least - 1023 - 52;
    fits_ = greatest != 0 && least != 0 && greatest - least + 53 <= kBits && unit > -1000 && unit < 1000;
    if (!fits_) return;
    unit_ = unit;
    const double scale = std::bit_cast<double>(static_cast<std::uint64_t>(1023 - unit) << 52);
    for (std::size_t i = 0; i < N; ++i) whole_[i] = static_cast<std::int64_t>(numbers[i] * scale);
  }

  /// Whether they have so few, and not all of them are 0.
  [[nodiscard]] bool fit() const { return fits_; }
  [[nodiscard]] int unit() const { return unit_; }
  [[nodiscard]] std::int64_t operator[](std::size_t i) const { return whole_[i]; }

 private:
  static constexpr int kNormal = 2046;
  bool fits_ = false;
  int unit_ = 0;
  std::array<std::int64_t, N> whole_{};
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

}  // namespace contact::oracle
