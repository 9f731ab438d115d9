// Whether a component answers by its own methods alone.
#pragma once

#include <typeinfo>

#include "contact/discrete_intersection.hpp"

namespace contact::component {

/// Its class is one of ours: nobody has overridden a method of it.
[[nodiscard]] inline bool is_built_in(const DiscreteIntersection& object) {
  return typeid(object) == typeid(DiscreteIntersection) || typeid(object) == typeid(ProximityIntersection);
}

}  // namespace contact::component
