// Nearest points in long double, for formulas that only have to come near what an engine said.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "contact/pairs.hpp"

namespace contact::oracle {

using Real = long double;
using Numbers = std::array<Real, 3>;

/// The axis of a shape, from + t along for t from 0 to 1; of a sphere its centre.
struct AxisInReals {
  Numbers from{};
  Numbers along{};

  AxisInReals() = default;
  explicit AxisInReals(const Ball& ball) : from{ball.center[0], ball.center[1], ball.center[2]} {}
  explicit AxisInReals(const Capsule& capsule) : from{capsule.start[0], capsule.start[1], capsule.start[2]} {
    for (std::size_t i = 0; i < 3; ++i) along[i] = Real{capsule.end[static_cast<Eigen::Index>(i)]} - from[i];
  }

  [[nodiscard]] Numbers at(Real t) const {
    return {from[0] + t * along[0], from[1] + t * along[1], from[2] + t * along[2]};
  }
};

/// What is nearest to each other: the parameters on both axes. The middle where they are parallel side by side.
[[nodiscard]] inline std::array<Real, 2> nearest_parameters(const AxisInReals& first, const AxisInReals& second) {
  const auto dot = [](const Numbers& v, const Numbers& w) { return v[0] * w[0] + v[1] * w[1] + v[2] * w[2]; };
  const auto clamped = [](Real t) { return std::clamp(t, Real{0}, Real{1}); };
  const Numbers& u = first.along;
  const Numbers& v = second.along;
  const Numbers w{second.from[0] - first.from[0], second.from[1] - first.from[1], second.from[2] - first.from[2]};
  const Real A = dot(u, u);
  const Real B = dot(u, v);
  const Real E = dot(v, v);
  const Real C = dot(u, w);
  const Real F = dot(v, w);
  if (!(E > 0)) return {A > 0 ? clamped(C / A) : 0, 0};
  if (!(A > 0)) return {0, clamped(-F / E)};
  const Real det = A * E - B * B;
  Real s = clamped((C * E - B * F) / det);
  if (!(det > A * E * 1e-15L)) {  // as good as parallel
    const Real ends[2] = {C / A, (C + B) / A};
    const Real low = std::max(Real{0}, std::min(ends[0], ends[1]));
    const Real high = std::min(Real{1}, std::max(ends[0], ends[1]));
    s = clamped((low + high) / 2);
  }
  const Real free = (B * s - F) / E;
  const Real t = clamped(free);
  return {t == free ? s : clamped((B * t + C) / A), t};
}

}  // namespace contact::oracle
