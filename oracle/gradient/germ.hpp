// Numbers beside a question: how they begin when one number of it begins to move.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "oracle/truth/exact.hpp"

namespace contact::oracle::gradients {

/// A polynomial in t, which is above 0 and smaller than any number that is: its sign is that of its first term. So what is true of germs is true of all t from 0
/// to some t, and no limit is taken.
class Germ {
 public:
  static constexpr bool kIsCoordinate = true;  ///< vectors of them are added and multiplied

  Germ() = default;
  Germ(const Rational& x) : terms_{x} { trim(); }  // NOLINT(google-explicit-constructor): a number that does not move
  /// x + by t
  Germ(const Rational& x, const Rational& by) : terms_{x, by} { trim(); }

  [[nodiscard]] Rational operator[](std::size_t k) const { return k < terms_.size() ? terms_[k] : Rational(0); }
  [[nodiscard]] bool is_zero() const { return terms_.empty(); }
  /// The power of t in the first term. Domain: not 0.
  [[nodiscard]] std::size_t order() const {
    return static_cast<std::size_t>(
        std::find_if(terms_.begin(), terms_.end(), [](const Rational& x) { return !CGAL::is_zero(x); }) -
        terms_.begin());
  }
  [[nodiscard]] int sign() const { return is_zero() ? 0 : static_cast<int>(CGAL::sign(terms_[order()])); }

  friend Germ operator+(const Germ& a, const Germ& b) { return sum(a, b, 1); }
  friend Germ operator-(const Germ& a, const Germ& b) { return sum(a, b, -1); }
  friend Germ operator*(const Germ& a, const Germ& b) {
    Germ product;
    if (a.is_zero() || b.is_zero()) return product;
    product.terms_.resize(a.terms_.size() + b.terms_.size() - 1);
    for (std::size_t i = 0; i < a.terms_.size(); ++i) {
      if (CGAL::is_zero(a.terms_[i])) continue;
      for (std::size_t k = 0; k < b.terms_.size(); ++k) product.terms_[i + k] += a.terms_[i] * b.terms_[k];
    }
    return product;
  }

 private:
  static Germ sum(const Germ& a, const Germ& b, int sign) {
    Germ all = a;
    all.terms_.resize(std::max(a.terms_.size(), b.terms_.size()));
    for (std::size_t k = 0; k < b.terms_.size(); ++k) {
      if (sign > 0) all.terms_[k] += b.terms_[k];
      if (sign < 0) all.terms_[k] -= b.terms_[k];
    }
    all.trim();
    return all;
  }
  void trim() {
    while (!terms_.empty() && CGAL::is_zero(terms_.back())) terms_.pop_back();
  }

  std::vector<Rational> terms_;  ///< the last one is not 0
};

/// A number and its derivative.
struct Jet {
  static constexpr bool kIsCoordinate = true;

  Rational at;
  Rational by;

  friend Jet operator+(const Jet& a, const Jet& b) { return {a.at + b.at, a.by + b.by}; }
  friend Jet operator-(const Jet& a, const Jet& b) { return {a.at - b.at, a.by - b.by}; }
  friend Jet operator*(const Jet& a, const Jet& b) { return {a.at * b.at, a.at * b.by + a.by * b.at}; }
  friend Jet operator/(const Jet& a, const Jet& b) {
    return {a.at / b.at, (a.by * b.at - a.at * b.by) / (b.at * b.at)};
  }
};

/// How a quotient begins. Domain: it does not grow beyond all bounds as t falls.
inline Jet begin_of(const Germ& numerator, const Germ& denominator) {
  const std::size_t first = denominator.order();
  return Jet{numerator[first], numerator[first + 1]} / Jet{denominator[first], denominator[first + 1]};
}

}  // namespace contact::oracle::gradients
