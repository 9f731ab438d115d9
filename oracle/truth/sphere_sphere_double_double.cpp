// Two spheres in pairs of doubles.
#include "oracle/truth/double_double_nearest.hpp"
#include "oracle/truth/grid.hpp"

namespace contact::oracle {
namespace {

/// n 2^exponent. The parts of n are cut off, not rounded: what is left of two is below 2^-104 of it.
DoubleDouble of_whole(mpz_ptr n, int exponent) {
  Scratch& s = scratch();
  const double high = mpz_get_d(n);
  mpz_set_d(s.x, high);
  mpz_sub(s.y, n, s.x);
  const double low = mpz_get_d(s.y);
  mpz_set_d(s.x, low);
  const DoubleDouble sum = fast_two_sum(std::ldexp(high, exponent), std::ldexp(low, exponent));
  return {sum.high, sum.low, mpz_cmp(s.x, s.y) == 0 ? 0 : std::abs(sum.high) * 0x1p-103};
}

/// In whole numbers. Nothing where a number is too small for a product of it.
std::optional<Excess> excess_of(const Balls& balls, Distances distances) {
  const Ball& a = balls.a;  // a lambda takes no part of a structured binding before clang 16
  const Ball& b = balls.b;
  Scratch& s = scratch();
  const Grid grid{
      std::min({last_exponent(a.center), last_exponent(b.center), last_exponent(a.radius), last_exponent(b.radius),
                last_exponent(distances.alarm), last_exponent(distances.contact)})};
  mpz_set_ui(s.sum, 0);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    grid.place(s.x, a.center[axis]);
    grid.place(s.y, b.center[axis]);
    mpz_sub(s.x, s.y, s.x);
    mpz_addmul(s.sum, s.x, s.x);
  }
  const auto past = [&](double distance) {
    grid.place(s.x, a.radius);
    grid.place(s.y, b.radius);
    mpz_add(s.x, s.x, s.y);
    grid.place(s.y, distance);
    mpz_add(s.x, s.x, s.y);
    mpz_mul(s.shifted, s.x, s.x);
    mpz_sub(s.shifted, s.sum, s.shifted);
    return of_whole(s.shifted, 2 * grid.unit);
  };
  const Excess excess{past(distances.alarm), past(0), past(distances.contact)};
  for (const DoubleDouble& x : {excess.at_alarm, excess.at_zero, excess.at_contact})
    if (!in_range(x.high, 450)) return std::nullopt;
  return excess;
}

}  // namespace

std::optional<RoundedAnswer> double_double_answer(const Balls& balls, Distances distances, Scalar scalar) {
  constexpr int kMost = 200;
  const auto& [a, b] = balls;
  if (!in_range(a.center, kMost) || !in_range(b.center, kMost) || !in_range(a.radius, kMost) ||
      !in_range(b.radius, kMost) || !in_range(distances.alarm, kMost) || !in_range(distances.contact, kMost))
    return std::nullopt;
  const DoubleDoubleNearest nearest{exactly(a.center), exactly(b.center), difference(b.center, a.center)};
  auto found = case_of_nearest(nearest, a.radius, b.radius, distances, scalar);
  if (found && found->margin.rounded()) return found;
  const auto excess = excess_of(balls, distances);
  return excess ? case_of_nearest(nearest, a.radius, b.radius, distances, scalar, excess) : found;
}

}  // namespace contact::oracle
