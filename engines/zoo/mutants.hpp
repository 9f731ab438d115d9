// Engines with one mistake each: production's answers, or an arithmetic of their own, with one thing wrong.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string_view>

#include "engines/engine.hpp"
#include "oracle/judge/claim.hpp"
#include "oracle/truth/query.hpp"

namespace contact::engines {

/// Where a mistake comes from: another engine, where it was really made; our formulas, changed in one place; or an
/// arithmetic that is too coarse.
enum class Origin { real, own, precision };
inline constexpr std::array<std::string_view, 3> kOriginNames{"real", "own", "precision"};

struct Mutant {
  std::string_view id;
  std::string_view about;
  std::string_view cause;         ///< the diagnosis that it must get: an id of oracle/diagnosis/wrong_*.cpp
  void (*ask)(Query&) = nullptr;  ///< what production is asked instead
  void (*change)(const Query&, Claim&) = nullptr;  ///< what becomes of its answer
  std::string_view source{};                       ///< where the mistake was made, for real ones
  Origin origin = Origin::real;
  bool outside_domain = false;       ///< shows in the family `invalid` alone
  Scalar scalar = Scalar::binary64;  ///< that it computes in, and declares
};

/// Before the id in the name of an engine.
inline constexpr std::string_view kMutantPrefix = "mutant:";

/// Those that give one answer whatever they are asked, and are right where no other is: every committed file must
/// refute both, but those of families of hits alone (golden/families.hpp).
inline constexpr std::string_view kAlwaysHit = "always-hit";
inline constexpr std::string_view kAlwaysMiss = "always-miss";

/// All of them: the real ones, our own, those of precision.
[[nodiscard]] std::span<const Mutant> mutants();

[[nodiscard]] Claim answer_of(const Mutant& mutant, const Query& query);

/// The engine `mutant:ID`, or nullptr where there is none of that id. It knows the first convention of points alone.
[[nodiscard]] std::unique_ptr<Engine> make_mutant(std::string_view id);

}  // namespace contact::engines
