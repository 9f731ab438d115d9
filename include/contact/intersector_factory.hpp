// Creators of intersectors. Other translation units and shared libraries register them, and every DiscreteIntersection
// that is made afterwards has their intersectors.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "contact/version.h"

namespace contact::inline CONTACT_ABI {

class DiscreteIntersection;

/// The creators, in the order in which they were registered. A DiscreteIntersection adds its own intersectors first,
/// then each creator in this order adds its own. For the same two model types the later entry replaces the earlier one.
/// Threads     registering and making a DiscreteIntersection may happen at once.
class IntersectorFactory {
 public:
  /// Adds intersectors to a DiscreteIntersection and returns what it must keep alive.
  using Creator = std::function<std::shared_ptr<const void>(DiscreteIntersection&)>;

  /// Returns false and changes nothing if a creator of this name is registered already. Throws std::invalid_argument if
  /// `creator` is empty.
  bool registerCreator(std::string name, Creator creator);

  /// Has every creator add its intersectors; returns what the DiscreteIntersection must keep alive.
  [[nodiscard]] std::vector<std::shared_ptr<const void>> addIntersectors(DiscreteIntersection& object) const;

  [[nodiscard]] std::vector<std::string> names() const;

  /// The factory that a DiscreteIntersection uses unless it is given another.
  [[nodiscard]] static IntersectorFactory& getInstance();

 private:
  mutable std::mutex mutex_;
  std::vector<std::pair<std::string, Creator>> creators_;
};

/// A creator for a class T whose constructor takes the DiscreteIntersection and adds itself to its map.
template <class T>
[[nodiscard]] IntersectorFactory::Creator creator_of() {
  return [](DiscreteIntersection& object) { return std::make_shared<const T>(object); };
}

/// Registers T with the instance while the program starts: `const IntersectorCreator<Mine> registered("Mine");` at
/// namespace scope. A linker leaves such an object out of a static library unless something else in its file is used.
template <class T>
class IntersectorCreator {
 public:
  explicit IntersectorCreator(const std::string& name) {
    IntersectorFactory::getInstance().registerCreator(name, creator_of<T>());
  }
};

}  // namespace contact::inline CONTACT_ABI
