// What an engine declares: everything that its answers are judged by.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "oracle/judge/claim.hpp"
#include "oracle/judge/conventions.hpp"
#include "oracle/truth/query.hpp"

namespace contact::oracle {

/// What is rounded before the engine sees it, by the names of files: "rounds":["orientation"].
inline constexpr std::array<std::string_view, 1> kRoundsNames{"orientation"};

struct Declaration {
  Scalar scalar = Scalar::binary64;
  Conventions conventions;
  DeclaredBounds bounds;
  std::optional<Aspects> claims{};       ///< nothing: all that the conventions speak of
  std::optional<Tolerance> tolerance{};  ///< nothing: judged by level
  bool rounds_orientation = false;       ///< a rotated box is handed on with a matrix, or a unit quaternion

  /// What is judged of an answer, and what an answer to a hit of two spheres must have.
  [[nodiscard]] Aspects claimed() const {
    return claims ? claims->common(spoken_of(conventions)) : spoken_of(conventions);
  }
  friend bool operator==(const Declaration&, const Declaration&) = default;
};

}  // namespace contact::oracle
