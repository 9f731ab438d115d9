// The clamped centre, for whatever the exact truth checks: the double-double stage, the witness, plain arithmetic, mutants. The
// truth, the interval oracle and production each find the nearest point in their own way.
#pragma once

#include "contact/pairs.hpp"

namespace contact {

/// The sphere, and the nearest point of the box as a sphere without extent.
[[nodiscard]] inline Balls at_clamped(const BallAndBox& shapes) {
  const auto& [ball, box] = shapes;
  return {ball, {ball.center.cwiseMax(box.min).cwiseMin(box.max), 0}};
}

}  // namespace contact
