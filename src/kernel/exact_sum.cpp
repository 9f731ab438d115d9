// Sums of doubles, exactly.
#include "contact/exact_sum.hpp"

#include <algorithm>
#include <optional>

#include "kernel/exact.hpp"
#include "kernel/floating_point_environment.hpp"
#include "kernel/sum_of_two.hpp"

namespace contact::inline CONTACT_ABI {
namespace {

struct Sum {
  explicit Sum(std::initializer_list<double> terms) : grid(terms) {
    for (const double term : terms) total += grid(term);
  }
  kernel::Grid grid;
  kernel::Integer total = 0;
};

/// The sum rounded once, where two doubles hold all of it, and its sign.
struct QuickSum {
  double rounded = 0;
  int sign = 0;
};

// Behind a call: what RoundToNearest sets must be set before anything is computed.
[[gnu::noinline]] std::optional<QuickSum> sum_of_two_doubles(std::initializer_list<double> terms) {
  kernel::one_number::SumOfTwo<double> sum(0, 0);
  for (const double term : terms) sum.add(term);
  if (!(sum.lost == 0)) return std::nullopt;
  const double rounded = sum.rounded();
  return QuickSum{rounded, (rounded > 0 ? 1 : 0) - (rounded < 0 ? 1 : 0)};
}

std::optional<QuickSum> quick_sum(std::initializer_list<double> terms) {
  const kernel::RoundToNearest environment;
  return sum_of_two_doubles(terms);
}

}  // namespace

int sign_of_sum(std::initializer_list<double> terms) {
  if (const auto sum = quick_sum(terms)) return sum->sign;
  return Sum(terms).total.sign();
}

double rounded_sum(std::initializer_list<double> terms, int exponent) {
  if (exponent == 0)
    if (const auto sum = quick_sum(terms)) return sum->rounded;
  // Beyond this every sum is 0 or infinite, whatever its terms; nearer, no shift is long and no exponent overflows.
  constexpr int kBeyond = 1 << 13;
  const Sum sum(terms);
  return kernel::round_integer(sum.total, sum.grid.exponent() + std::clamp(exponent, -kBeyond, kBeyond));
}

}  // namespace contact::inline CONTACT_ABI
