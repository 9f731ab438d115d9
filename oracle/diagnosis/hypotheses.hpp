// The causes of wrong answers: mistakes that engines make, each as a formula for what an engine with it would answer.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <variant>

#include "oracle/diagnosis/nearest_in_reals.hpp"
#include "oracle/judge/claim.hpp"
#include "oracle/truth/query.hpp"
#include "oracle/truth/truth.hpp"

namespace contact::oracle {

// In Real squares of doubles neither overflow nor vanish, where the platform has a type wider than double. Nothing is
// judged with it: a formula only has to come near what an engine said.

/// Where the two shapes of a question lie: each region exercises another part of the right formula.
enum class Region { coincident, inside, core_inside, overlapping, touching, near, at_alarm, beyond };
inline constexpr std::array<std::string_view, 8> kRegionNames{"where the centres coincide",
                                                              "where one shape lies inside the other",
                                                              "where a centre lies inside the other shape",
                                                              "where the shapes overlap",
                                                              "where the shapes just touch",
                                                              "short of the alarm distance",
                                                              "exactly at the alarm distance",
                                                              "beyond the alarm distance"};

/// The numbers of one question that formulas use. A cause may change any of them and compute the rest anew.
///
/// Two shapes with a distance are two cores, each blown up by a radius, and their formulas speak of the nearest points
/// of the cores: whichever shapes these are, the exact truth says where they lie. Two boxes without one have gaps.
struct Facts {
  Facts(const Query& query, const Truth& truth, Scalar scalar, std::optional<Numbers> said_normal);

  /// Reads another question in the place of this one. What was really asked keeps its truth and its region.
  void ask(Query other);
  /// Computes what follows from the nearest points.
  void settle();
  /// Computes what follows from `delta`.
  void settle_from_delta();

  Query query;
  const Truth* truth;
  Scalar scalar;
  Region region;
  Real alarm;
  Real contact;
  // Of two shapes with a distance.
  std::array<Numbers, 2> nearest{};  ///< of the cores, such as centres; inside, the ends of the way out
  std::array<Real, 2> radius{};
  std::array<Real, 2> scale{};  ///< of which the bound of each contact point counts ulps
  Real depth = 0;               ///< how deep one core is inside the other
  Numbers delta{};
  std::optional<Numbers> inward;  ///< of length 1, where the second core is a half-space
  Real D = 0;                     ///< delta.delta
  Real distance = 0;              ///< sqrt(D), or -depth; delta.inward
  Numbers n{};  ///< delta / sqrt(D), or the way out or inward; the engine's normal where there is no direction
  // The bounds of the cores, for boxes their corners.
  std::array<Numbers, 2> min{};
  std::array<Numbers, 2> max{};
  std::optional<Numbers> said_normal;  ///< first to second
  /// Of any two convex shapes that overlap: how much longer the way out along the engine's normal is than the shortest.
  Real detour = 0;
  // Of a shape that crosses another.
  bool crosses = false;
  Real slack = 0;  ///< CrossingInReals::slack
  Real sine = 1;   ///< CrossingInReals::sine
  /// How much the shapes may enlarge a rounding on its way into a nearest point, or a crossing: axes that are nearly
  /// parallel, a triangle that is thin, a line that nearly goes along a plane. At least 1.
  Real condition = 1;
  // Of a ray that is cast.
  Real t = 0;           ///< where it hits
  Real per_length = 1;  ///< how much of t a length is, along the ray

  [[nodiscard]] bool has_distance() const { return query.has_distance(); }
  [[nodiscard]] bool has_numbers() const { return query.has_numbers(); }
  /// Whether one direction is right, or several that are as good.
  [[nodiscard]] bool has_direction() const { return D > 0 || depth > 0 || inward; }

  [[nodiscard]] Real radii() const { return radius[0] + radius[1]; }
  [[nodiscard]] Real gap(std::size_t axis) const;
  [[nodiscard]] Real widest_gap() const;

 private:
  void read(const Truth& of_query);
  void read_crossing(bool hit);
  /// What a ray that is cast grows a rounding by, where it meets a surface at an angle of this cosine to its normal.
  void settle_cast(Real cosine);
};

/// What an engine with a mistake would say about one aspect.
struct Said {
  enum class Kind { no_opinion, numbers, anything };
  Said(std::nullopt_t) : kind(Kind::no_opinion) {}  // NOLINT(google-explicit-constructor)
  Said(Real x) : numbers{x, 0, 0} {}                // NOLINT(google-explicit-constructor)
  Said(const Numbers& v) : numbers(v) {}            // NOLINT(google-explicit-constructor)
  Said(const Numbers& v, Real off, Real at_least = 0) : numbers(v), tolerance(off), least(at_least) {}
  static Said hit(bool yes) { return yes ? Real{1} : Real{0}; }
  /// Whether x <= y; no opinion where the last bits decide of them, or of what they were made of, up to `size`.
  static Said at_most(Real x, Real y, Real size = 0);
  static Said anything() {
    Said said(std::nullopt);
    said.kind = Kind::anything;
    return said;
  }

  Kind kind = Kind::numbers;
  Numbers numbers{};   ///< decisions and values use the first; NaN stands for any number that is not finite
  Real tolerance = 0;  ///< of formulas that are vaguer than the engine's own bound
  Real least = 0;      ///< an error below it is not explained: of an arithmetic, whose errors have a size
};

/// The `kind` of a cause that concerns shapes of every kind.
inline constexpr std::size_t kEveryKind = std::variant_npos;

/// A mistake, and formulas for the aspects that it changes; without `edit`, it has no opinion on the others.
struct Cause {
  std::string_view id;
  std::string_view sentence;
  /// Changes the question. The right formulas then give every aspect, and the functions below are not used.
  std::function<void(Facts&)> edit{};
  std::function<Said(const Facts&)> hit{};
  std::function<Said(const Facts&)> normal{};
  std::function<Said(const Facts&, std::size_t shape)> point{};
  std::function<Said(const Facts&)> value{};
  /// How much an explained claim counts. A vague formula says only that something is off, and counts for less than 1,
  /// so that a formula that says what is off goes before it.
  double weight = 1;
  std::size_t kind = kEveryKind;  ///< of the two shapes that it can be made about; it has no opinion on others
  /// It speaks of the arithmetic. `own` is that of the engine's own format, which every engine without a mistake has:
  /// what it may do is no evidence for a formula.
  enum class Arithmetic { none, own, coarse };
  Arithmetic arithmetic = Arithmetic::none;
};

/// A set of causes has so many bits, in memory and in files.
inline constexpr std::size_t kMostCauses = 512;

/// All causes. Order is priority: of several that say the same the simplest stands first. Throws std::length_error
/// where there are more than kMostCauses.
[[nodiscard]] std::span<const Cause> causes();
/// The index of a cause in `causes()`. Throws std::out_of_range where there is none.
[[nodiscard]] std::size_t cause_index(std::string_view id);

/// What a cause says about each aspect of a question.
struct Predictions {
  Said hit = std::nullopt;
  Said normal = std::nullopt;
  std::array<Said, 2> point{std::nullopt, std::nullopt};
  Said midpoint = std::nullopt;  ///< of both contact points
  Said value = std::nullopt;
};
[[nodiscard]] Predictions predict(const Cause& cause, const Facts& facts);

}  // namespace contact::oracle
