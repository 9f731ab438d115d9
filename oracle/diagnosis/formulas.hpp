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

/// Whether a nearest point was found again, but for roundings: between cores that meet they would make a direction.
inline bool is_same_point(const Numbers& x, const Numbers& y) {
  return largest_of(along(x, -1, y)) <= 1e-17L * std::max(largest_of(x), largest_of(y));
}

inline std::size_t other(std::size_t shape) { return 1 - shape; }
/// The direction along the normal in which a contact point lies from the core of its shape.
inline Real side(std::size_t shape) { return shape == 0 ? 1 : -1; }
inline Numbers surface(F f, std::size_t shape) { return along(f.nearest[shape], side(shape) * f.radius[shape], f.n); }
inline Real signed_distance(F f) { return f.distance - f.radii(); }
inline Real right_value(F f) { return is_cast(f.query.pair) ? f.t : signed_distance(f) - f.contact; }

/// Whether no distance decides, but a point that both shapes have.
inline bool is_decided_by_a_point(F f) { return is_crossing(f.query.pair) || is_cast(f.query.pair); }
/// Whether the shapes are within `alarm` of each other: boxes are if the gap of each axis is.
inline Said within(F f, Real alarm) {
  if (is_decided_by_a_point(f)) return Said::hit(f.crosses);
  if (!f.has_distance()) return Said::at_most(f.widest_gap(), alarm);
  // The difference of large coordinates is as coarse as they are.
  return Said::at_most(f.distance, f.radii() + alarm, std::max(largest_of(f.nearest[0]), largest_of(f.nearest[1])));
}
inline Said right_decision(F f) { return Said::hit(f.truth->hit()); }
/// A miss in some places, and right elsewhere.
inline Said missed_where(bool there, F f) { return there ? Said::hit(false) : right_decision(f); }
/// `said` in some places, and no opinion elsewhere.
inline Said where(bool there, const Said& said) { return there ? said : Said(std::nullopt); }
/// A decision about two shapes with a distance that has no opinion on others.
inline std::function<Said(F)> of_distance(std::function<Said(F)> hit) {
  return [hit = std::move(hit)](F f) { return f.has_distance() ? hit(f) : Said(std::nullopt); };
}
/// A cause that decides whether two shapes are within the alarm distance.
inline Cause decision(std::string_view id, std::string_view sentence, std::function<Said(F)> said) {
  return {.id = id, .sentence = sentence, .hit = std::move(said)};
}
/// Causes that change one number of the contact.
inline Cause points(std::string_view id, std::string_view sentence, std::function<Said(F, std::size_t)> said) {
  return {.id = id, .sentence = sentence, .point = std::move(said)};
}
inline Cause value(std::string_view id, std::string_view sentence, std::function<Said(F)> said) {
  return {.id = id, .sentence = sentence, .value = std::move(said)};
}
/// A cause that changes the question.
inline Cause edit(std::string_view id, std::string_view sentence, std::function<void(Facts&)> change) {
  return {.id = id, .sentence = sentence, .edit = std::move(change)};
}
/// A cause that changes the normal only, between cores that are apart: where they meet, there is no delta. A ray that
/// is cast has a normal all the same.
inline Cause normal(std::string_view id, std::string_view sentence, std::function<Said(F)> said) {
  return {.id = id, .sentence = sentence, .normal = [said = std::move(said)](F f) {
            return where(f.D > 0 || (is_cast(f.query.pair) && f.crosses), said(f));
          }};
}
/// A normal or a point that is NaN or infinite.
inline constexpr Numbers kNotFinite{kNaN, kNaN, kNaN};

// What roundings to so many bits do to the numbers of a question; 0 bits stand for the engine's own format. Defined in
// wrong_arithmetic.cpp.
/// By how much a coordinate is off.
[[nodiscard]] Real loss(F f, int bits);
/// A normal.
[[nodiscard]] Real turned(F f, int bits);
/// The distance of the shapes.
[[nodiscard]] Real apart(F f, int bits);
/// How far the pair is from the edge of the decision.
[[nodiscard]] Real from_edge(F f);

// The tables, in the order of `causes()`.
[[nodiscard]] std::vector<Cause> wrong_inputs();
[[nodiscard]] std::vector<Cause> wrong_decisions();
[[nodiscard]] std::vector<Cause> wrong_features();
[[nodiscard]] std::vector<Cause> wrong_planes();
[[nodiscard]] std::vector<Cause> wrong_crossings();
[[nodiscard]] std::vector<Cause> wrong_casts();
[[nodiscard]] std::vector<Cause> wrong_normals();
[[nodiscard]] std::vector<Cause> wrong_points();
[[nodiscard]] std::vector<Cause> wrong_values();
[[nodiscard]] std::vector<Cause> wrong_arithmetic();

// What each kind of shapes says of itself, in a file of its own, as cube_cube.cpp, or in pairs.cpp.
#define CONTACT_DECLARE(A, B)                                                           \
  /* Whether one of the two shapes lies inside the other. */                            \
  [[nodiscard]] bool one_inside_the_other(F f, const Two<A, B>& shapes);                \
  /* The mistakes that can be made about these shapes alone; the argument is unused. */ \
  [[nodiscard]] std::vector<Cause> wrong_about(const Two<A, B>* kind);
CONTACT_KINDS(CONTACT_DECLARE)
#undef CONTACT_DECLARE

}  // namespace contact::oracle::formulas
