// Which models of a scene are put to each other: those that may meet, and are near.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "contact/intersection.hpp"
#include "tool/run/scene.hpp"

namespace contact::tool {

/// Two models by their places in the scene, the first not behind the second; a model with itself where they are one.
struct ModelPair {
  std::uint32_t first;
  std::uint32_t second;

  friend auto operator<=>(const ModelPair&, const ModelPair&) = default;
};

struct NearModels {
  /// Models of a scene with up to so many are listed pair by pair, whether or not they are near.
  static constexpr std::size_t kFew = 64;
  /// So many pairs without an intersector are listed.
  static constexpr std::size_t kMostWithout = 100;

  std::vector<ModelPair> near;  ///< that may meet, have an intersector, and lie within the alarm distance on every axis
  std::vector<ModelPair> listed;   ///< of few models all that may meet and have an intersector, otherwise near
  std::vector<ModelPair> without;  ///< the first that may meet and have no intersector
  std::uint64_t without_all = 0;   ///< how many there are
};

/// The pairs of a scene, each list in the order of the models; with `self` each model meets itself too. Boxes around
/// models decide what is near, as in SOFA's broad phase. A scene of many models, of which few are near each other or
/// whose rules are few, takes nearly linear time, and memory for the pairs that are near. Throws InputError where these
/// are too many to keep.
[[nodiscard]] NearModels near_models(const Scene& scene, const Intersection& intersection, bool self);

}  // namespace contact::tool
