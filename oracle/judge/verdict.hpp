// What is found of a claim: decisions, grades and errors by field, and the level that all of them reach.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "oracle/judge/claim.hpp"
#include "oracle/judge/conventions.hpp"

namespace contact::oracle {

/// Strictest first; each level includes those after it.
enum class Level { correctly_rounded, faithful, bounded, decisions, conservative, none };
inline constexpr std::array<std::string_view, 6> kLevelNames{"correctly-rounded", "faithful",     "bounded",
                                                             "decisions",         "conservative", "none"};
[[nodiscard]] constexpr std::string_view name(Level level) { return kLevelNames[static_cast<std::size_t>(level)]; }

/// How right one claimed field is: the worst of its components.
enum class Grade { correctly_rounded, faithful, bounded, beyond_bound, not_finite };
inline constexpr std::array<std::string_view, 5> kGradeNames{"correctly-rounded", "faithful", "bounded", "beyond bound",
                                                             "not finite"};
[[nodiscard]] constexpr std::string_view name(Grade grade) { return kGradeNames[static_cast<std::size_t>(grade)]; }

/// What a tolerance speaks of.
enum class Measure { length, angle, decision };
inline constexpr std::array kMeasures{Measure::length, Measure::angle, Measure::decision};
inline constexpr std::array<std::string_view, kMeasures.size()> kMeasureNames{"length", "angle", "decision"};

enum class Field { normal, point1, point2, point, points, value };
inline constexpr std::array kFields{Field::normal, Field::point1, Field::point2,
                                    Field::point,  Field::points, Field::value};
/// Fields are the aspects that are numbers, in their order.
[[nodiscard]] constexpr Aspect aspect(Field field) {
  return static_cast<Aspect>(static_cast<int>(field) + static_cast<int>(Aspect::normal));
}
[[nodiscard]] constexpr Measure measure_of(Field field) {
  return field == Field::normal ? Measure::angle : Measure::length;
}
[[nodiscard]] constexpr std::string_view name(Field field) {
  return kAspectNames[static_cast<std::size_t>(aspect(field))];
}
static_assert(aspect(Field::value) == Aspect::value);

/// One of the two yes-or-no claims: `overlap` or the existence of a contact.
enum class Decision { unclaimed, right, missed_hit, false_hit };

/// How far a claim is off in the question's own units, a normal in radians; 0 where it is right, a correctly rounded
/// number included.
struct Off {
  double most = 0;      ///< rounded up
  double relative = 0;  ///< the same over the field's scale, or over the reach, rounded up; 0 for a normal
  bool within = true;   ///< the declared tolerance allows it; true where none is declared

  void merge(const Off& other);
  /// The lesser of what two ways need, either of which will do.
  void take_lesser(const Off& other);
  friend bool operator==(const Off&, const Off&) = default;
};

struct FieldVerdict {
  Grade grade = Grade::correctly_rounded;
  /// Upper bound of the error in ulps of the field's scale; 0 where correctly rounded (not measured there).
  double error = 0;
  Off off{};  ///< beside the right answer, or the nearest of those that are
  /// What a tolerance must allow by Measure: `off`, or less where the claim is as good as a right one. Of a normal that
  /// is a length then, and what its own length is off.
  std::array<Off, kMeasures.size()> needs{};
  bool last_bit = false;  ///< beyond the bound, and no worse than the inputs' last bit: mark_last_bit
  bool too_many = false;  ///< more points than the engine declares, each wherever it is

  friend bool operator==(const FieldVerdict&, const FieldVerdict&) = default;
};

struct Verdict {
  Claim::Status status = Claim::Status::answered;
  std::string text;  ///< for every status but answered: why
  Decision overlap = Decision::unclaimed;
  Decision contact = Decision::unclaimed;
  bool answered_outside_domain = false;  ///< gave an answer where there is no question
  bool refused_outside_domain = false;   ///< gave none there, which is right
  Aspects missing;                       ///< declared, asked for by this hit, and not in the answer
  // What a right answer says, for the decisions that are judged.
  std::optional<bool> overlap_expected;
  std::optional<bool> contact_expected;
  bool has_numbers = false;        ///< whether a right answer has numbers, claimed or not
  bool decision_last_bit = false;  ///< a wrong decision is no worse than the inputs' last bit: mark_last_bit
  bool decision_rounded = false;   ///< it is worse, and within the rounding of orientations that is declared
  std::array<std::optional<FieldVerdict>, kFields.size()> fields;
  bool no_number_beside = false;  ///< a contact that should not be claimed has a number that is not finite
  /// The worst need by Measure: of the fields, also of a contact that should not be claimed, and of a wrong decision.
  std::array<Off, kMeasures.size()> off;

  [[nodiscard]] const Off& at(Measure measure) const { return off[static_cast<std::size_t>(measure)]; }
  /// The same but for what is no worse than the inputs' last bit, or than their rounding that is declared.
  [[nodiscard]] Off beyond_last_bit(Measure measure) const;
  /// Wrong by every tolerance: no answer, a field missing, or no number.
  [[nodiscard]] bool beyond_any() const;
  /// Whether the declared tolerance allows the whole answer.
  [[nodiscard]] bool within() const;
  [[nodiscard]] const std::optional<FieldVerdict>& at(Field field) const {
    return fields[static_cast<std::size_t>(field)];
  }
  [[nodiscard]] bool missed_hit() const { return overlap == Decision::missed_hit || contact == Decision::missed_hit; }
  [[nodiscard]] bool false_hit() const { return overlap == Decision::false_hit || contact == Decision::false_hit; }
  [[nodiscard]] bool not_finite() const;
  /// The strictest level that every claim of the answer reaches.
  [[nodiscard]] Level level() const;
};

}  // namespace contact::oracle
