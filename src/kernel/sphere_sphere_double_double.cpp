// The fast stage of sphere against sphere.
#include "kernel/sphere_sphere_double_double.hpp"

#include <bit>
#include <cstdint>

namespace contact::kernel {
namespace {

/// Whether sums round to nearest; asked of the arithmetic itself, since engines set the processor's mode behind the
/// back of the standard library.
bool rounds_to_nearest() {
  static const volatile double one = 1;
  static const volatile double tiny = 0x1p-60;
  const double x = one;
  const double t = tiny;
  return x + t == x && x - t == x;
}

/// Whether x is 0 or 2^-220 <= |x| <= 2^220. Asked of the bits: a comparison may take a subnormal number for 0.
bool in_range(double x) {
  constexpr std::uint64_t kLow = std::uint64_t{1023 - 220} << 52;
  constexpr std::uint64_t kHigh = std::uint64_t{1023 + 220} << 52;
  const std::uint64_t magnitude = std::bit_cast<std::uint64_t>(x) & ~(std::uint64_t{1} << 63);
  return magnitude == 0 || magnitude - kLow <= kHigh - kLow;
}

bool in_range(const Ball& ball) {
  return in_range(ball.center[0]) && in_range(ball.center[1]) && in_range(ball.center[2]) && in_range(ball.radius);
}

}  // namespace

std::optional<DoubleDoublePair> DoubleDoublePair::of(const Ball& a, const Ball& b, Distances distances) {
  if (!in_range(a) || !in_range(b) || !in_range(distances.contact) || !rounds_to_nearest()) return std::nullopt;

  std::array<DoubleDouble, 3> delta;
  std::array<double, 3> square;
  double residual = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    delta[i] = two_sum(b.center[axis], -a.center[axis]);
    const auto [high, low] = delta[i];
    square[i] = high * high;
    residual += std::fma(2 * high, low, std::fma(high, high, -square[i]));
  }
  const DoubleDouble xy = two_sum(square[0], square[1]);
  const DoubleDouble xyz = two_sum(xy.high, square[2]);
  if (xyz.high == 0) return std::nullopt;
  const DoubleDouble D = two_sum(xyz.high, (xy.low + xyz.low) + residual);

  DoubleDoublePair pair;
  const double root = std::sqrt(D.high);
  pair.root_ = {root, (std::fma(-root, root, D.high) + D.low) / (2 * root)};
  const DoubleDouble radii = two_sum(a.radius, b.radius);
  const DoubleDouble less = two_sum(radii.high, distances.contact);
  pair.less_ = {less.high, radii.low + less.low};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [high, low] = delta[i];
    const double q = high / root;
    const double remainder = std::fma(-q, root, high) + low;
    pair.normal_[i] = two_sum(q, std::fma(-q, pair.root_.low, remainder) / root);
  }
  return pair;
}

}  // namespace contact::kernel
