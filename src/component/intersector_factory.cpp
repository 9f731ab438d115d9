// Creators of intersectors.
#include "contact/intersector_factory.hpp"

#include <algorithm>
#include <stdexcept>

namespace contact::inline CONTACT_ABI {

bool IntersectorFactory::registerCreator(std::string name, Creator creator) {
  const std::lock_guard lock(mutex_);
  if (std::any_of(creators_.begin(), creators_.end(), [&](const auto& c) { return c.first == name; })) return false;
  if (!creator) throw std::invalid_argument("creator " + name + ": there is nothing to call");
  creators_.emplace_back(std::move(name), std::move(creator));
  return true;
}

std::vector<std::shared_ptr<const void>> IntersectorFactory::addIntersectors(DiscreteIntersection& object) const {
  // A copy, so that a creator may itself register or make a DiscreteIntersection.
  const auto creators = [&] {
    const std::lock_guard lock(mutex_);
    return creators_;
  }();
  std::vector<std::shared_ptr<const void>> created;
  for (const auto& [name, create] : creators) created.push_back(create(object));
  return created;
}

std::vector<std::string> IntersectorFactory::names() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> names;
  for (const auto& creator : creators_) names.push_back(creator.first);
  return names;
}

IntersectorFactory& IntersectorFactory::getInstance() {
  static IntersectorFactory instance;
  return instance;
}

}  // namespace contact::inline CONTACT_ABI
