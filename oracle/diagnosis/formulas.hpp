// The formulas that the tables of causes share, and the tables.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "oracle/diagnosis/hypotheses.hpp"

namespace contact::oracle::formulas {

using F = const Facts&;
inline constexpr std::size_t kX = 0;
inline constexpr std::size_t kY = 1;
inline constexpr std::size_t kZ = 2;
inline constexpr std::array kAxes{kX, kY, kZ};
inline constexpr Real kNaN = std::numeric_limits<Real>::quiet_NaN();
inline constexpr Real kInfinity = std::numeric_limits<Real>::infinity();

inline Numbers numbers_of(const Vector3& v) { return {v[0], v[1], v[2]}; }
inline Numbers along(const Numbers& from, Real factor, const Numbers& v) {
  return {from[0] + factor * v[0], from[1] + factor * v[1], from[2] + factor * v[2]};
}
inline Numbers times(Real factor, const Numbers& v) { return along({}, factor, v); }
inline Real dot(const Numbers& v, const Numbers& w) { return v[0] * w[0] + v[1] * w[1] + v[2] * w[2]; }
inline Real sum_of(const Numbers& v) { return std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2]); }
inline Real largest_of(const Numbers& v) { return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])}); }
inline Real narrow(Real x) { return static_cast<Real>(static_cast<float>(x)); }

inline std::size_t other(std::size_t shape) { return 1 - shape; }
/// The direction along the normal in which a contact point lies from the centre of its sphere.
inline Real side(std::size_t sphere) { return sphere == 0 ? 1 : -1; }
inline Numbers surface(F f, std::size_t sphere) {
  return along(f.center[sphere], side(sphere) * f.radius[sphere], f.n);
}
inline Real signed_distance(F f) { return f.distance - f.depth - f.radii(); }
inline Real right_value(F f) { return signed_distance(f) - f.contact; }

/// Whether the shapes are within `alarm` of each other: boxes are if the gap of each axis is.
inline Said within(F f, Real alarm) {
  return f.spheres ? Said::at_most(f.distance, f.radii() + alarm) : Said::at_most(f.widest_gap(), alarm);
}
/// `said` in some places, and no opinion elsewhere.
inline Said where(bool there, const Said& said) { return there ? said : Said(std::nullopt); }
/// A decision about boxes that has no opinion on spheres.
inline std::function<Said(F)> boxes(std::function<Said(F)> hit) {
  return [hit = std::move(hit)](F f) { return f.spheres ? Said(std::nullopt) : hit(f); };
}
/// A cause that changes the normal only. Where the centres coincide every unit normal is right, so it has no opinion.
inline Cause normal(std::string_view id, std::string_view sentence, std::function<Said(F)> said) {
  return {.id = id, .sentence = sentence, .normal = [said = std::move(said)](F f) {
            return where(f.region != Region::coincident, said(f));
          }};
}

// The tables, in the order of `causes()`.
[[nodiscard]] std::vector<Cause> wrong_inputs();
[[nodiscard]] std::vector<Cause> wrong_decisions();
[[nodiscard]] std::vector<Cause> wrong_box_decisions();
[[nodiscard]] std::vector<Cause> wrong_features();
[[nodiscard]] std::vector<Cause> wrong_normals();
[[nodiscard]] std::vector<Cause> wrong_points();
[[nodiscard]] std::vector<Cause> wrong_values();
[[nodiscard]] std::vector<Cause> wrong_arithmetic();

}  // namespace contact::oracle::formulas
