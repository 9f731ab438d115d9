// The decision of one pair in plain arithmetic, where its error bound allows.
#pragma once

#include <limits>

#include "kernel/proved_bounds.hpp"

namespace contact::kernel {

enum class Filtered { hit, miss, undecided };

template <class Real>
struct PlainBounds {
  static constexpr double kUnit = static_cast<double>(std::numeric_limits<Real>::epsilon()) / 2;  // u
  // To nearest, D and reach^2 are each within 5.0001 u of the reals (three roundings of squares that carry two or three
  // more), and the product below adds 1 u: a relative gap of 11.1 u decides. A directed rounding mode doubles every one
  // of them, 22.2 u, so 32 u decides in every mode.
  static constexpr double kGap = 32 * kUnit;
  // Between these bounds no square, product or sum leaves the normal range in a way that matters: what an underflowing
  // or flushed square of a component loses is at most 3 * 2^-1022, below 2^-100 of a D of at least 2^-900.
  static constexpr double kLeast = 0x1p-900;
  static constexpr double kMost = 0x1p1000;
};
static_assert(PlainBounds<double>::kGap >= proved::kScalarGap);  // proofs, scalar_filter.g
static_assert(PlainBounds<double>::kLeast >= proved::kLeast);

template <class AnyBall>
auto squared_distance(const AnyBall& a, const AnyBall& b) {
  const auto dx = b.center[0] - a.center[0];
  const auto dy = b.center[1] - a.center[1];
  const auto dz = b.center[2] - a.center[2];
  return dx * dx + dy * dy + dz * dz;
}

/// D is squared_distance(a, b).
template <class AnyBall, class Real>
Filtered filter(const AnyBall& a, const AnyBall& b, Real D, Real alarm) {
  using Limits = PlainBounds<Real>;
  const Real reach = (a.radius + b.radius) + alarm;
  const Real reach2 = reach * reach;
  if (!(D > Limits::kLeast && D < Limits::kMost && reach2 > Limits::kLeast && reach2 < Limits::kMost))
    return alarm == std::numeric_limits<double>::infinity() ? Filtered::hit : Filtered::undecided;
  if (D < reach2 * (1 - Limits::kGap)) return Filtered::hit;
  if (D > reach2 * (1 + Limits::kGap)) return Filtered::miss;
  return Filtered::undecided;
}

}  // namespace contact::kernel
