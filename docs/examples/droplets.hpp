// Droplets: a model type derived from a built-in one.
#pragma once

#include "contact/discrete_intersection.hpp"

namespace example {

/// Spheres to every intersector but those that are added for Droplets.
class Droplets : public contact::ModelOf<Droplets, contact::SphereCollisionModel> {
 public:
  static constexpr std::string_view kName = "Droplets";
  using ModelOf::ModelOf;
};

}  // namespace example
