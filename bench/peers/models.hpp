// The peers' broad and narrow phases on one set of balls: every contact of the set with itself.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "contact/geometry.hpp"

namespace contact::bench {

/// A library's world with the balls in it; its objects are made once, outside of what is measured.
class World {
 public:
  World() = default;
  World(const World&) = delete;
  World& operator=(const World&) = delete;
  virtual ~World() = default;

  /// Builds the broad phase anew and finds all contacts: how many?
  virtual std::size_t from_nothing() = 0;
  /// The same where the broad phase is there already, brought up to date, and no ball has moved.
  virtual std::size_t again() = 0;
  [[nodiscard]] virtual bool is_built() const = 0;
  /// Takes the broad phase down where there is one; not measured.
  virtual void forget() = 0;
};

struct WorldPeer {
  std::string name;
  std::unique_ptr<World> (*make)(std::span<const Ball> balls);
};

[[nodiscard]] WorldPeer fcl_world();
[[nodiscard]] WorldPeer bullet_world();

}  // namespace contact::bench
