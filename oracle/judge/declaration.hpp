// What an engine declares: everything that its answers are judged by.
#pragma once

#include <optional>

#include "oracle/judge/claim.hpp"
#include "oracle/judge/conventions.hpp"
#include "oracle/truth/query.hpp"

namespace contact::oracle {

struct Declaration {
  Scalar scalar = Scalar::binary64;
  Conventions conventions;
  DeclaredBounds bounds;
  std::optional<Aspects> claims{};       ///< nothing: all that the conventions speak of
  std::optional<Tolerance> tolerance{};  ///< nothing: judged by level

  /// What is judged of an answer, and what an answer to a hit of two spheres must have.
  [[nodiscard]] Aspects claimed() const {
    return claims ? claims->common(spoken_of(conventions)) : spoken_of(conventions);
  }
  friend bool operator==(const Declaration&, const Declaration&) = default;
};

}  // namespace contact::oracle
