// Real numbers within a radius of high + low: arithmetic that bounds its own error.
// Included by convexes_enclosed.hpp, once for each kind of processor.

namespace contact::kernel {
namespace CONTACT_TARGET {
constexpr double kTiny = 0x1p-1000;

/// A real number within `radius` of high + low, where |low| <= u |high|.
/// Errors of an operation on the midpoints are below 3 u^2 of the magnitudes of a sum, 20 u^2 of those of three products that are added, 9 u^2 of a reciprocal and
/// 5 u^2 of a root (one Newton step on the rounded one); what is taken is wider. The radii themselves are rounded a few times: kWider.
/// Domain      to nearest; no overflow. What underflows is below kTiny, and nothing does where a factor is 0.
struct Enclosure {
  double high;
  double low;
  double radius;

  static constexpr double kSquaredUnit = 0x1p-106;
  static constexpr double kWider = 1 + 0x1p-48;

  Enclosure() = default;
  explicit Enclosure(double x) : high(x), low(0), radius(0) {}
  Enclosure(DoubleDouble<double> x, double off) : high(x.high), low(x.low), radius(off * kWider) {}

  [[nodiscard]] bool is_positive() const { return high * (1 - 0x1p-50) > radius; }
  /// Whether it is above 0 by far more than the radius.
  [[nodiscard]] bool is_clear() const { return high * 0x1p-20 > radius; }
  /// The real number, for what rounds it once.
  [[nodiscard]] Approximation approximation() const {
    return {high, low, radius * kWider + 4 * kSquaredUnit * std::abs(high)};
  }
};

[[gnu::always_inline]] inline Enclosure operator-(const Enclosure& x) { return {{-x.high, -x.low}, x.radius}; }
/// The low parts, at most u of the magnitudes, are added, that of the sum too, which is as large, and 3 u^2 are rounded.
[[gnu::always_inline]] inline Enclosure operator+(const Enclosure& x, const Enclosure& y) {
  const DoubleDouble<double> sum = two_sum(x.high, y.high);
  return {two_sum(sum.high, sum.low + (x.low + y.low)),
          x.radius + y.radius + 8 * Enclosure::kSquaredUnit * (std::abs(x.high) + std::abs(y.high))};
}
[[gnu::always_inline]] inline Enclosure operator-(const Enclosure& x, const Enclosure& y) { return x + -y; }
/// The sum of x[i] y[i]. Of each product 3 u^2 is rounded, its smallest part (1) left out, and its low parts, at most 3 u, added (3); those of the products are added
/// to each other (3 + 3), those of the sums too (2), and both (5).
template <std::size_t kCount>
[[gnu::always_inline]] inline Enclosure sum_of_products(const std::array<Enclosure, kCount>& x,
                                                        const std::array<Enclosure, kCount>& y) {
  DoubleDouble<double> sum{0, 0};
  double size = 0;
  double low = 0;
  double off = 0;
  double tiny = 0;
#pragma GCC unroll 3
  for (std::size_t i = 0; i < kCount; ++i) {
    const double p = x[i].high * y[i].high;
    const double rest = std::fma(x[i].high, y[i].high, -p) + std::fma(x[i].low, y[i].high, x[i].high * y[i].low);
    const DoubleDouble<double> next = i == 0 ? DoubleDouble<double>{p, 0} : two_sum(sum.high, p);
    sum = {next.high, i < 2 ? next.low : sum.low + next.low};
    low = i == 0 ? rest : low + rest;
    size += std::abs(p);
    tiny = x[i].high != 0 && y[i].high != 0 ? kTiny : tiny;
    off += std::abs(x[i].high) * y[i].radius + (std::abs(y[i].high) + y[i].radius) * x[i].radius;
  }
  return {two_sum(sum.high, sum.low + low), off + 24 * Enclosure::kSquaredUnit * size + tiny};
}
[[gnu::always_inline]] inline Enclosure operator*(const Enclosure& x, const Enclosure& y) {
  return sum_of_products<1>({x}, {y});
}
/// The sum of x[i] y[i], of numbers that are given. Each product is held by two; the low parts of these are added (k - 1), those of the sums (k - 2 times at most k - 1), and both (k).
/// Domain: in_short_range of all numbers.
template <std::size_t kCount>
[[gnu::always_inline]] inline Enclosure sum_of_given_products(const std::array<double, kCount>& x,
                                                              const std::array<double, kCount>& y) {
  double sum = x[0] * y[0];
  double size = std::abs(sum);
  double low = std::fma(x[0], y[0], -sum);
  double rest = 0;
#pragma GCC unroll 4
  for (std::size_t i = 1; i < kCount; ++i) {
    const double p = x[i] * y[i];
    const DoubleDouble<double> next = two_sum(sum, p);
    sum = next.high;
    rest = i == 1 ? next.low : rest + next.low;
    low += std::fma(x[i], y[i], -p);
    size += std::abs(p);
  }
  return {two_sum(sum, rest + low), 6 * static_cast<double>(kCount) * Enclosure::kSquaredUnit * size};
}
/// The sum of k[i] x[i], k being given: no worse than sum_of_products.
template <std::size_t kCount>
[[gnu::always_inline]] inline Enclosure sum_of_multiples(const std::array<double, kCount>& k,
                                                         const std::array<Enclosure, kCount>& x) {
  double sum = 0;
  double size = 0;
  double low = 0;
  double rest = 0;
  double off = 0;
#pragma GCC unroll 3
  for (std::size_t i = 0; i < kCount; ++i) {
    const double p = k[i] * x[i].high;
    const DoubleDouble<double> next = i == 0 ? DoubleDouble<double>{p, 0} : two_sum(sum, p);
    sum = next.high;
    rest = i < 2 ? next.low : rest + next.low;
    const double of_product = std::fma(k[i], x[i].low, std::fma(k[i], x[i].high, -p));
    low = i == 0 ? of_product : low + of_product;
    size += std::abs(p);
    off += std::abs(k[i]) * x[i].radius + (k[i] != 0 && x[i].high != 0 ? kTiny : 0);
  }
  return {two_sum(sum, rest + low), off + 24 * Enclosure::kSquaredUnit * size};
}
[[gnu::always_inline]] inline Enclosure operator*(double k, const Enclosure& x) {
  const double p = k * x.high;
  return {two_sum(p, std::fma(k, x.low, std::fma(k, x.high, -p))),
          std::abs(k) * x.radius + 4 * Enclosure::kSquaredUnit * std::abs(p) + (x.high != 0 ? kTiny : 0)};
}
[[gnu::always_inline]] inline Enclosure twice(const Enclosure& x) { return {{2 * x.high, 2 * x.low}, 2 * x.radius}; }
/// 1 / x. Domain: is_clear().
[[gnu::always_inline]] inline Enclosure reciprocal(const Enclosure& x) {
  const double t = 1 / x.high;
  const DoubleDouble<double> y = two_sum(t, t * std::fma(-x.low, t, std::fma(-x.high, t, 1.0)));
  return {y, 2 * x.radius * (t * t) + 16 * Enclosure::kSquaredUnit * t};
}
/// sqrt(x). Domain: is_clear().
[[gnu::always_inline]] inline Enclosure root(const Enclosure& x) {
  const double s = std::sqrt(x.high);
  const DoubleDouble<double> y = two_sum(s, (std::fma(-s, s, x.high) + x.low) / (2 * s));
  return {y, x.radius / s + 16 * Enclosure::kSquaredUnit * s};
}

using Enclosures = std::array<Enclosure, 3>;
/// x - y of points that are given, exactly.
[[gnu::always_inline]] inline Enclosures given_difference(const Vector3& x, const Vector3& y) {
  const auto each = [&](Eigen::Index i) { return Enclosure(two_sum(x[i], -y[i]), 0); };
  return {each(0), each(1), each(2)};
}
[[gnu::always_inline]] inline Enclosures operator+(const Enclosures& x, const Enclosures& y) {
  return {x[0] + y[0], x[1] + y[1], x[2] + y[2]};
}
[[gnu::always_inline]] inline Enclosures operator-(const Enclosures& x, const Enclosures& y) {
  return {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
}
[[gnu::always_inline]] inline Enclosures operator-(const Enclosures& x) { return {-x[0], -x[1], -x[2]}; }
[[gnu::always_inline]] inline Enclosures operator*(const Enclosure& k, const Enclosures& x) {
  return {k * x[0], k * x[1], k * x[2]};
}
[[gnu::always_inline]] inline Enclosures operator*(double k, const Enclosures& x) {
  return {k * x[0], k * x[1], k * x[2]};
}
[[gnu::always_inline]] inline Enclosure dot(const Enclosures& x, const Enclosures& y) { return sum_of_products(x, y); }
/// x y - z w
[[gnu::always_inline]] inline Enclosure difference_of_products(const Enclosure& x, const Enclosure& y,
                                                               const Enclosure& z, const Enclosure& w) {
  return sum_of_products<2>({x, -z}, {y, w});
}
[[gnu::always_inline]] inline Enclosures cross(const Enclosures& x, const Enclosures& y) {
  return {difference_of_products(x[1], y[2], x[2], y[1]), difference_of_products(x[2], y[0], x[0], y[2]),
          difference_of_products(x[0], y[1], x[1], y[0])};
}

}  // namespace CONTACT_TARGET
}  // namespace contact::kernel
