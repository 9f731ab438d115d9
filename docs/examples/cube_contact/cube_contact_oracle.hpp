// The exact contact of two boxes, for judging the plug-in cube_contact: another way to it, and other arithmetic.
#pragma once

#include <optional>

#include "oracle/truth/exact.hpp"
#include "oracle/truth/query.hpp"

namespace example {

/// What is exactly true of two boxes, and its correct rounding.
struct CubeContactTruth {
  enum class Kind { gap_vector, penetrating, miss };

  Kind kind;
  bool tied;  ///< penetrating along an axis on which both boxes have the same centre: the direction is a choice
  contact::Vector3 normal, point1, point2;
  double value;
};

/// With centres m = (min + max) / 2 and half sizes h: gap_k = |m2_k - m1_k| - h1_k - h2_k.
/// Domain      as the query's.
[[nodiscard]] CubeContactTruth cube_contact_truth(const contact::Query& query);

}  // namespace example
