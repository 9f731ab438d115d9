// Mistakes that engines make, each as a formula that says what an engine with that mistake would answer.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>

#include "oracle/claim.hpp"
#include "oracle/truth.hpp"

namespace contact::oracle {

/// Wide enough that squares of doubles neither overflow nor vanish, where the platform has such a type. Nothing is
/// judged with it: a hypothesis only has to come near what an engine said.
using Real = long double;
using Numbers = std::array<Real, 3>;

/// Where a question lies: the part of the formula that it exercises.
enum class Region { coincident, inside, overlapping, touching, near, at_alarm, beyond };
inline constexpr std::array<std::string_view, 7> kRegionNames{
    "where the centres coincide",  "where one shape lies inside the other", "where the shapes overlap",
    "where the shapes just touch", "short of the alarm distance",           "exactly at the alarm distance",
    "beyond the alarm distance"};

/// One question, as the formulas see it. A hypothesis may change any number and have the rest computed anew.
struct Facts {
  Facts(const Query& query, const Truth& truth, Scalar scalar, std::optional<Numbers> said_normal);

  /// Everything that follows from centres and radii, or from boxes.
  void settle();
  /// The same from `delta` on.
  void settle_from_delta();

  const Truth* truth;
  Scalar scalar;
  bool spheres;
  Region region;
  Real alarm;
  Real contact;
  // Spheres.
  std::array<Numbers, 2> center{};
  std::array<Real, 2> radius{};
  Numbers delta{};
  Real D = 0;         ///< delta.delta
  Real distance = 0;  ///< sqrt(D)
  Numbers n{};        ///< delta / sqrt(D); where the centres coincide, what the engine said it was
  // Boxes.
  std::array<Numbers, 2> min{};
  std::array<Numbers, 2> max{};
  std::optional<Numbers> said_normal;  ///< first to second

  [[nodiscard]] Real radii() const { return radius[0] + radius[1]; }
  [[nodiscard]] Real gap(std::size_t axis) const;
  [[nodiscard]] Real widest_gap() const;
};

/// What an engine with some mistake would say.
struct Said {
  enum class Kind { no_opinion, numbers, anything };
  Said(std::nullopt_t) : kind(Kind::no_opinion) {}  // NOLINT(google-explicit-constructor)
  Said(Real x) : numbers{x, 0, 0} {}                // NOLINT(google-explicit-constructor)
  Said(const Numbers& v) : numbers(v) {}            // NOLINT(google-explicit-constructor)
  Said(const Numbers& v, Real off) : numbers(v), tolerance(off) {}
  static Said hit(bool yes) { return yes ? Real{1} : Real{0}; }
  /// x <= y, but no opinion where that hangs on the last bits.
  static Said at_most(Real x, Real y);
  static Said anything() {
    Said said(std::nullopt);
    said.kind = Kind::anything;
    return said;
  }

  Kind kind = Kind::numbers;
  Numbers numbers{};   ///< a decision or a value in the first; NaN stands for anything that is not finite
  Real tolerance = 0;  ///< where the hypothesis is vaguer than the engine's own bound
};

/// A mistake. What it says nothing about it leaves as it is.
struct Cause {
  std::string_view id;
  std::string_view sentence;
  /// Changes the question; every field then follows by the right formulas.
  std::function<void(Facts&)> edit{};
  std::function<Said(const Facts&)> hit{};
  std::function<Said(const Facts&)> normal{};
  std::function<Said(const Facts&, std::size_t sphere)> point{};
  std::function<Said(const Facts&)> value{};
  /// What an explained answer counts. Less than 1 where the hypothesis says no more than "something is off here": a
  /// formula that says what goes before it.
  double weight = 1;
};

/// The rule base, the simplest of several that say the same first.
[[nodiscard]] std::span<const Cause> causes();
/// The place of a cause in it. Throws std::out_of_range where there is none.
[[nodiscard]] std::size_t cause_index(std::string_view id);

/// What a cause says of each aspect of a question; shared by its caller over all causes.
struct Predictions {
  Said hit = std::nullopt;
  Said normal = std::nullopt;
  std::array<Said, 2> point{std::nullopt, std::nullopt};
  Said value = std::nullopt;
};
[[nodiscard]] Predictions predict(const Cause& cause, const Facts& facts);

}  // namespace contact::oracle
