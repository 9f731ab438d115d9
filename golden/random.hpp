// The counter-based random numbers behind every generated question: Philox4x64-10 (Random123).
#pragma once

// Where Random123 knows of no 128-bit product (32-bit processors, riscv64, s390x) it has no Philox4x64 unless it is
// asked to make the product of smaller ones.
#define R123_USE_MULHILO64_C99 1
#include <Random123/philox.h>

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace contact::golden {

/// The stream of one question. Nothing but its arguments enters, so any question of any file can be made alone.
///   key      the first 16 bytes of SHA-256("contact-oracle/1|pair|family|scalar|seed"), two little-endian words
///   counter  (block, index, 0, 0); each block gives four words, used in order
class Random {
 public:
  /// What all questions of a file share.
  struct Key {
    std::uint64_t word[2];
  };
  [[nodiscard]] static Key key(std::string_view pair, std::string_view family, std::string_view scalar,
                               std::uint64_t seed);
  /// The same from the bytes of the digest.
  [[nodiscard]] static Key key(std::span<const std::uint8_t, 16> bytes) {
    Key key{};
    for (std::size_t i = 0; i < bytes.size(); ++i)
      key.word[i / 8] |= static_cast<std::uint64_t>(bytes[i]) << (8 * (i % 8));
    return key;
  }

  Random(Key key, std::uint64_t index) : key_{{key.word[0], key.word[1]}}, counter_{{0, index, 0, 0}} {}

  /// 64 random bits.
  std::uint64_t bits() {
    if (used_ == 4) {
      block_ = philox4x64_R(10, counter_, key_);
      ++counter_.v[0];
      used_ = 0;
    }
    return block_.v[used_++];
  }
  /// Uniform in 0 .. n - 1 (the bias of a remainder of 64 bits does not matter here).
  std::uint64_t below(std::uint64_t n) { return bits() % n; }
  std::size_t index(std::size_t n) { return static_cast<std::size_t>(below(n)); }
  /// A whole number, uniform in low .. high.
  template <std::signed_integral Int>
  Int between(Int low, Int high) {
    return low + static_cast<Int>(below(static_cast<std::uint64_t>(high - low) + 1));
  }
  bool chance(unsigned one_in) { return below(one_in) == 0; }
  /// The question's index modulo n: classes that take turns are all present in any run of n questions.
  [[nodiscard]] int turn(int n) const { return static_cast<int>(counter_.v[1] % static_cast<std::uint64_t>(n)); }
  /// The next digit of the index in a mixed radix, for classes within classes.
  [[nodiscard]] int turn(int n, int within) const {
    return static_cast<int>(counter_.v[1] / static_cast<std::uint64_t>(within) % static_cast<std::uint64_t>(n));
  }

  /// Uniform in [0, 1) on the grid of the scalar's precision.
  template <class Real>
  Real unit() {
    if constexpr (sizeof(Real) == 4) return static_cast<float>(bits() >> 40) * 0x1p-24F;
    return static_cast<Real>(bits() >> 11) * static_cast<Real>(0x1p-53);
  }
  template <class Real>
  Real uniform(Real low, Real high) {
    return low + (high - low) * unit<Real>();
  }
  /// Uniform in [1, 2) times a power of two, the exponent uniform in low .. high.
  template <class Real>
  Real magnitude(int low, int high) {
    const int exponent = between(low, high);
    return std::ldexp(uniform<Real>(1, 2), exponent);
  }
  /// x or -x. (Two draws in one expression would leave their order to the compiler: draw inside functions.)
  template <class Real>
  Real with_sign(Real x) {
    return chance(2) ? -x : x;
  }

 private:
  philox4x64_key_t key_;
  philox4x64_ctr_t counter_;
  philox4x64_ctr_t block_{};
  int used_ = 4;
};

}  // namespace contact::golden
