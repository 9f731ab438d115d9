// The questions: products of sets of numbers, of full significands where these are few, elsewhere of those that round
// worst.
#include <algorithm>
#include <cmath>
#include <utility>

#include "dev/short_numbers/harness.hpp"

namespace contact::kernel::tiny {
namespace {

using Numbers = std::vector<double>;

/// All numbers of `bits` bits in [2^low, 2^high).
Numbers all(int bits, int low, int high) {
  Numbers numbers;
  for (int exponent = low; exponent < high; ++exponent)
    for (int i = 1 << (bits - 1); i < 1 << bits; ++i) numbers.push_back(std::ldexp(i, exponent - bits + 1));
  return numbers;
}

/// Numbers of `bits` bits in [1, 2) beside what matters to rounding, `count` of them at most: powers of two, ties,
/// thirds.
Numbers edges(int bits, std::size_t count) {
  const double unit = std::ldexp(1, 1 - bits);
  const auto near = [unit](double x) { return std::nearbyint(x / unit) * unit; };
  Numbers numbers{1,
                  2 - unit,
                  1 + unit,
                  1.5,
                  near(4.0 / 3),
                  near(std::sqrt(2)),
                  2 - 2 * unit,
                  near(1.75) - unit,
                  1 + 2 * unit,
                  1.5 + unit,
                  near(1.6180339),
                  near(1.1547005)};
  numbers.resize(std::min(count, numbers.size()));
  return numbers;
}

Numbers times(const Numbers& numbers, int low, int high, int step = 1) {
  Numbers products;
  for (int exponent = low; exponent < high; exponent += step)
    for (const double x : numbers) products.push_back(std::ldexp(x, exponent));
  return products;
}

Numbers joined(Numbers a, const Numbers& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Numbers of_both_signs(const Numbers& numbers) {
  Numbers both = numbers;
  for (const double x : numbers) both.push_back(-x);
  return both;
}

}  // namespace

std::vector<Grid> grids(int bits, bool whole) {
  const bool few = bits <= 8;  // significands: all of them can be tried
  const Numbers zero{0};
  const double far = 1024;  // an alarm distance that makes hits
  const std::array<double, 2> nearest{1, -1};
  const std::array<double, 2> center{0, 0};
  const std::array<double, 2> published{-1, 1};
  const auto or_zero = [&](const Numbers& numbers) { return joined(zero, numbers); };
  std::vector<Grid> all_grids;
  const auto grid = [&](const char* name, std::array<Numbers, 8> balls, Numbers alarms, Numbers contacts,
                        std::vector<std::array<double, 2>> signs) {
    all_grids.push_back({name, std::move(balls), std::move(alarms), std::move(contacts), std::move(signs)});
  };

  const Numbers places = whole ? Numbers{-2, -1, 0, 1, 2, 3, 4} : Numbers{-1, 0, 3, 4};
  const Numbers radii = whole ? Numbers{0, 1, 2, 3} : Numbers{0, 2, 3};
  Numbers places_x = places;
  std::replace(places_x.begin(), places_x.end(), 0.0, -0.0);
  grid("integers", {Numbers{0, 1}, {-0.0, 1}, {0, 1}, radii, places_x, places, places, radii}, {0, 1, far}, {0, 1},
       whole ? std::vector{nearest, center, published} : std::vector{nearest, published});

  if (few) {
    const int low = whole ? (bits <= 6 ? -8 : bits == 7 ? -1 : 0) : 0;
    const int shown = whole ? bits : 5;
    const Numbers first = whole ? bits >= 7 ? edges(bits, 12) : all(bits, 0, 1) : edges(bits, 4);
    grid("directions",
         {zero, zero, zero, {1}, all(shown, 0, 1), or_zero(all(bits, low, 1)), or_zero(all(shown, low, 1)), {1}}, {far},
         zero, {nearest});
    grid("rounded differences",
         {first,
          {1},
          zero,
          {1},
          of_both_signs(times(whole ? all(bits, 0, 1) : edges(bits, 6), -bits - 2, bits + 2)),
          of_both_signs(times(edges(bits, 4), -bits, 1, whole ? 4 : 2)),
          or_zero(edges(bits, 2)),
          {1}},
         {far}, zero, {nearest});
    grid("points",
         {of_both_signs(whole ? all(bits, -3, 3) : times(edges(bits, 8), -3, 3)),
          {0, 1},
          zero,
          whole && bits < 8 ? all(bits, -2, 2) : times(edges(bits, whole ? 12 : 8), -2, 2),
          {3},
          {0, 2},
          {0, 1},
          {0.75}},
         {far}, zero, {nearest, published});
  } else {
    grid("directions",
         {zero,
          zero,
          zero,
          {1},
          whole ? all(5, 0, 1) : edges(bits, 4),
          whole ? all(12, -1, 1) : times(all(9, 0, 1), -2, 1),
          or_zero(times(edges(bits, whole ? 5 : 4), whole ? -3 : 0, 1)),
          {1}},
         {far}, zero, {nearest});
    grid("rounded differences",
         {edges(bits, whole ? 12 : 4),
          edges(bits, 2),
          zero,
          {1},
          of_both_signs(times(edges(bits, whole ? 12 : 4), -bits - 2, bits + 2, whole ? bits / 8 : 3)),
          of_both_signs(times(edges(bits, whole ? 5 : 2), -bits, 1, whole ? 3 : 5)),
          or_zero(edges(bits, 2)),
          {1}},
         {far}, zero, {nearest});
    grid("points",
         {of_both_signs(whole ? all(12, 0, 1) : times(edges(bits, 12), -3, 3)),
          {0, 1},
          zero,
          times(edges(bits, whole ? 8 : 4), -2, 1),
          {3},
          {0, 2},
          {0, 1},
          {0.75}},
         {far}, zero, {nearest, published});
  }
  // Nothing cancels below what the quick tests ask for: with short significands they ask for much.
  const auto far_out = [&](const Numbers& numbers) { return times(numbers, bits / 2, bits / 2 + 1); };
  grid("far away",
       {far_out({1, 1.5}),
        far_out({-1.25}),
        far_out({1.75}),
        times(edges(bits, whole ? 12 : 3), -3, 2),
        far_out(times(edges(bits, whole ? 12 : 3), 0, 4, 2)),
        far_out(of_both_signs(edges(bits, whole ? 12 : 3))),
        far_out({-1.5}),
        {0, 0.75}},
       {std::ldexp(1, bits)}, {0, 0.5}, {nearest, published});

  grid("values",
       {zero,
        zero,
        zero,
        whole && bits < 8 ? all(bits, -2, 3) : times(edges(bits, whole ? 12 : 6), -2, 3),
        {1, 3},
        {0, 2, 4},
        {0, 1},
        or_zero(times(edges(bits, whole ? 12 : 4), -2 * bits, 2, whole ? 2 : 4))},
       {far}, or_zero(times(edges(bits, 3), -bits - 2, 1, bits)), {nearest});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<Numbers, 8> balls{zero, zero, zero, times(edges(bits, whole ? 4 : 2), -2, 3, 2), zero, zero, zero, {}};
    balls[axis] = edges(bits, 4);
    balls[4 + axis] = of_both_signs(times(edges(bits, whole ? 6 : 2), -bits - 2, bits + 2, whole ? 3 : 6));
    balls[7] = or_zero(times(edges(bits, whole ? 4 : 2), -bits - 2, 0, whole ? bits / 4 + 2 : 6));
    grid("along an axis", balls, {far}, or_zero(times(edges(bits, 3), -bits - 2, 1, bits)), {nearest});
  }
  grid("near touching",
       {or_zero({std::ldexp(1.5, -bits - 1)}), zero, zero, all(std::min(bits, whole ? 13 : 6), 0, bits < 16 ? 2 : 1),
        edges(bits, 3), or_zero(edges(bits, bits < 16 ? 2 : 1)), or_zero({edges(bits, 2)[1]}),
        or_zero(times(edges(bits, 2), -bits - 1, -bits + 4, 4))},
       {0, std::ldexp(1, 2 - bits)}, {0, std::ldexp(1, 2 - bits)}, {nearest});
  grid("short distances",
       {zero,
        {0, 1},
        zero,
        or_zero(times(edges(bits, whole ? 8 : 4), 0, 2, whole ? 1 : 2)),
        or_zero(times(edges(bits, 2), -3 * bits, -1, whole ? bits / 2 : bits)),
        {0, 1},
        or_zero({std::ldexp(-1.5, -2 * bits)}),
        or_zero(times(edges(bits, whole ? 5 : 3), -bits - 2, 1, whole ? bits / 6 + 2 : 3))},
       {far}, or_zero(times(edges(bits, whole ? 5 : 3), -2 * bits - 2, -bits + 2, whole ? bits / 6 + 2 : 4)),
       {nearest});
  const Numbers sizes =
      whole ? Numbers{-1000, -700, -455, -440, -230, 0, 500, 1000, 1022} : Numbers{-700, -445, 0, 505, 1022};
  Numbers extreme{0};
  for (const double exponent : sizes)
    for (const double x : edges(bits, 2)) extreme.push_back(std::ldexp(x, static_cast<int>(exponent)));
  grid("sizes",
       {zero,
        {0, std::ldexp(-1.5, 1023)},
        zero,
        joined(extreme, {std::ldexp(1.5, 1023)}),
        extreme,
        joined(extreme, {std::ldexp(1.5, 1023)}),
        {0, 3},
        {0, std::ldexp(1, 1023)}},
       {0, std::ldexp(1, -700), 1}, {0, 1}, {nearest});
  return all_grids;
}

}  // namespace contact::kernel::tiny
